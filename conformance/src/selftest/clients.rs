//! Clients with a defect, and valid variants.

use std::net::SocketAddr;

use super::tried::{Candidate, SelfTestGroup};
use crate::clients::{ClientDefect, TestServer, defects, habits, trial};
use crate::judge::CaseOutcome;
use crate::session::Trouble;

pub(super) fn candidates() -> Vec<Candidate> {
    let one = |defect: &'static ClientDefect, group| Candidate {
        id: defect.id.to_owned(),
        group,
        what: defect.to_string(),
        targets: Some(defect.requirement).into_iter().filter(|id| !id.is_empty()).collect(),
        run: Box::new(move || run(defect).map(Some)),
    };
    let wrong = defects().iter().map(|defect| one(defect, SelfTestGroup::Client));
    wrong.chain(habits().iter().map(|habit| one(habit, SelfTestGroup::Different))).collect()
}

fn run(defect: &ClientDefect) -> Result<Vec<CaseOutcome>, Trouble> {
    let server = TestServer::new(SocketAddr::from(([127, 0, 0, 1], 0)))
        .map_err(|error| Trouble::Internal(format!("the test server does not start: {error}")))?;
    Ok(trial(defect, &server))
}
