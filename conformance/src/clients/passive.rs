//! Judges the requests of a client that is not told what to do.

use ads_cnc::operation::Function;

use super::findings::Findings;
use super::requests;
use super::script::ScenarioScript;
use super::test_server::{TestServer, Turn};
use crate::judge::{Body, CLIENT, Case, CaseOutcome, CaseSubject, Needs, Stop};
use crate::simulator::{Cnc, ModelError};

/// The case of all requests; its requirements are those that the requests touch.
pub fn requests_case() -> Case {
    let functions = Function::ALL.iter().map(|function| function.spec().clause);
    let mut requirements: Vec<&'static str> =
        ["ADS-1", "ADS-2", "ADS-3", "ADS-5", "GEN-4"].into_iter().chain(functions).collect();
    requirements.sort_unstable();
    requirements.dedup();
    Case {
        id: "client-requests".to_owned(),
        title: "Every request is one that a CNC knows".to_owned(),
        subject: CaseSubject::Client,
        requirements,
        needs: Needs::Queries,
        body: Body::Client,
    }
}

/// Serves the default model to every client until all connections are closed again or
/// `go_on` returns false, and judges every request. Returns the number of requests too.
///
/// # Errors
/// None: a test builds the model.
pub fn listen(
    server: &TestServer,
    mut go_on: impl FnMut() -> bool,
) -> Result<(CaseOutcome, usize), ModelError> {
    server.begin(ScenarioScript::new(Cnc::with_default_model()?));
    let (mut findings, mut before, mut count) = (Findings::default(), None, 0_usize);
    let mut judge = |turns: &[Turn]| {
        count = count.saturating_add(turns.len());
        requests::judge(turns, &mut before, &mut findings);
    };
    server.watch(|| {
        judge(&server.turns());
        go_on()
    });
    let (turns, beyond, _) = server.end();
    judge(&turns);
    let mut requirements = Vec::new();
    for judgement in &findings.record.judgements {
        if !requirements.contains(&judgement.requirement) {
            requirements.push(judgement.requirement);
        }
    }
    let stop = requirements.is_empty().then(|| {
        requirements.push(CLIENT);
        Stop::Inconclusive("no client has sent a request".to_owned())
    });
    let stop = stop.or(beyond.stop());
    let count = count.saturating_add(beyond.requests);
    let case = Case { requirements, ..requests_case() };
    Ok((CaseOutcome::tried(case, findings.record.judgements, findings.record.checks, stop), count))
}
