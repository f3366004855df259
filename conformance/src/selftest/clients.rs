//! Tests the suite with clients that have a defect, and with valid variants of a client.

use std::net::SocketAddr;

use super::trial::{Candidate, SelfTestGroup};
use crate::client_suite::{ClientDefect, TestServer, defects, trial, variants};
use crate::judge::CaseOutcome;
use crate::session::ToolError;

pub(super) fn candidates() -> Vec<Candidate> {
    let one = |defect: &'static ClientDefect, group| Candidate {
        id: defect.id.to_owned(),
        group,
        what: defect.to_string(),
        targets: Some(defect.requirement).into_iter().filter(|id| !id.is_empty()).collect(),
        run: Box::new(move || run(defect).map(Some)),
    };
    let wrong = defects().iter().map(|defect| one(defect, SelfTestGroup::Client));
    wrong.chain(variants().iter().map(|variant| one(variant, SelfTestGroup::Different))).collect()
}

fn run(defect: &ClientDefect) -> Result<Vec<CaseOutcome>, ToolError> {
    let server = TestServer::new(SocketAddr::from(([127, 0, 0, 1], 0)))
        .map_err(|error| ToolError::Internal(format!("cannot start the test server: {error}")))?;
    Ok(trial(defect, &server))
}
