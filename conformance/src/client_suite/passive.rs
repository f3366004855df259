//! Judges the requests of a client that is not controlled by the suite.

use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::requests::RequestJudge;
use super::scenario_checks::ScenarioChecks;
use super::script::ScenarioScript;
use super::test_server::{RecordedExchange, TestServer};
use crate::judge::{Body, CLIENT, Case, CaseOutcome, CaseSubject, Needs, Stop};
use crate::simulator::{Cnc, ModelError};

/// The case that judges all requests of a client that is not controlled by the suite. It has the
/// requirements of all functions, of the services, of the headers and of the ports.
pub fn requests_case() -> Case {
    let functions = Function::ALL.iter().map(|function| function.spec().clause);
    let mut requirements: Vec<&'static str> =
        [ADS_1, ADS_2, ADS_3, ADS_5, GEN_4].iter().map(|id| id.as_str()).chain(functions).collect();
    requirements.sort_unstable();
    requirements.dedup();
    Case {
        id: "client-requests".to_owned(),
        title: "Every request addresses a function of the CNC".to_owned(),
        subject: CaseSubject::Client,
        requirements,
        needs: Needs::Queries,
        body: Body::Client,
    }
}

/// Serves the default model to every client until all connections are closed or `go_on` returns
/// false, and judges every request that the server has recorded. Returns the outcome, which has the
/// checked requirements, and the number of requests.
///
/// # Errors
/// An error in the default model, which a test excludes.
pub fn listen(
    server: &TestServer,
    mut go_on: impl FnMut() -> bool,
) -> Result<(CaseOutcome, usize), ModelError> {
    server.begin(ScenarioScript::new(Cnc::with_default_model()?));
    let (mut scenario_checks, mut requests) = (ScenarioChecks::default(), RequestJudge::passive());
    let mut count = 0_usize;
    let mut judge = |exchanges: &[RecordedExchange]| {
        count = count.saturating_add(exchanges.len());
        requests.judge(exchanges, &mut scenario_checks);
    };
    server.watch(|| {
        judge(&server.exchanges());
        go_on()
    });
    let (exchanges, beyond, _) = server.end();
    judge(&exchanges);
    requests.finish(&mut scenario_checks);
    let mut requirements = Vec::new();
    for judgement in &scenario_checks.record.judgements {
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
    Ok((CaseOutcome::tried(case, scenario_checks.record, stop), count))
}
