//! Runs a client through its scenarios and judges it.

use std::fs;
use std::io::{self, Write as _};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Instant;

use ads_cnc_vectors::Level;
use serde_json::Value;

use super::message::{ActionResult, ClientHello, ClientReaction, CncAddress};
use super::requests::RequestJudge;
use super::result::same;
use super::scenario::{ExpectedAnswer, Scenario};
use super::scenario_checks::ScenarioChecks;
use super::script::ScenarioScript;
use super::test_server::{RecordedExchange, TestServer};
use super::{ClientDefect, ClientUnderTest, ReferenceClient, ordering, request_match, scenarios};
use crate::judge::{
    Body, CLIENT, Case, CaseOutcome, CaseSubject, ENOUGH, HELLO, Needs, Record, Rule, Stop,
    Verdict, caught,
};
use crate::process::{interrupt, progress};
use crate::simulator::Cnc;

/// After this many consecutive scenarios without a valid answer, the remaining scenarios are not
/// run.
const UNANSWERED_MAX: usize = 12;

#[derive(Debug)]
pub struct JudgedClient {
    pub hello: Option<ClientHello>,
    /// The outcomes of the scenarios and, unless a signal or the deadline ended the wait for hello,
    /// of the case about the client protocol.
    pub outcomes: Vec<CaseOutcome>,
    pub requests: usize,
}

/// Runs a client through scenarios in order, and judges it. After `most` failed scenarios, the
/// remaining scenarios are not run.
pub fn judge(
    actor: &mut dyn ClientUnderTest,
    server: &TestServer,
    scenarios: &[Scenario],
    most: Option<usize>,
) -> JudgedClient {
    let mut protocol = ScenarioChecks::default();
    let mut requests = 0_usize;
    let cnc_address = |port| CncAddress { addr: server.addr(), net_id: server.net_id(), port };
    let hello = match actor.hello(&cnc_address(552)) {
        Ok(hello) => hello,
        Err(_) if interrupt::is_requested() => {
            let all = scenarios.iter().map(Scenario::case);
            let outcomes = all.map(CaseOutcome::interrupted).collect();
            return JudgedClient { hello: None, outcomes, requests };
        }
        Err(reaction) => {
            // After the deadline the suite no longer waits, so a missing answer is not a failure.
            let over = actor.over();
            let (verdict, why) = match &over {
                Some(why) => (Verdict::Inconclusive, why.as_str()),
                None => (Verdict::NotRun, "hello was not answered"),
            };
            let untried =
                |one: &Scenario| CaseOutcome::untried(one.case(), verdict, why.to_owned());
            let mut outcomes: Vec<CaseOutcome> = scenarios.iter().map(untried).collect();
            if over.is_none() {
                protocol.check(Rule::CLIENT, false, None, HELLO, || reaction);
                outcomes.push(protocol_outcome(protocol));
            }
            return JudgedClient { hello: None, outcomes, requests };
        }
    };
    protocol.check(Rule::CLIENT, true, None, "", "");
    let mut outcomes: Vec<CaseOutcome> = Vec::new();
    let mut lost = 0_usize;
    progress::begin(scenarios.len());
    for scenario in scenarios {
        progress::step(outcomes.last().is_some_and(|last| last.verdict().fails_run()));
        let case = scenario.case();
        if interrupt::is_requested() {
            outcomes.push(CaseOutcome::interrupted(case));
            continue;
        }
        let failed = outcomes.iter().filter(|one| one.verdict().is_failure()).count();
        if most.is_some_and(|most| failed >= most) {
            outcomes.push(CaseOutcome::untried(case, Verdict::NotRun, ENOUGH));
            continue;
        }
        let word = scenario.action.split(' ').next().unwrap_or_default();
        if !hello.actions.iter().any(|one| one == word) {
            let note = format!("the client has no {word}");
            outcomes.push(CaseOutcome::untried(case, Verdict::NotApplicable, note));
            continue;
        }
        if let Some(why) = actor.over() {
            outcomes.push(CaseOutcome::untried(case, Verdict::Inconclusive, why));
            continue;
        }
        if lost >= UNANSWERED_MAX {
            let note = format!(
                "the client no longer answers: {UNANSWERED_MAX} consecutive actions without an answer"
            );
            outcomes.push(CaseOutcome::untried(case, Verdict::Inconclusive, note));
            continue;
        }
        let port = match scenario.asks.first() {
            Some(ask) => ask.port,
            None if word.ends_with("-objects") || word == "stream" => 553,
            None => 552,
        };
        let begin = Instant::now();
        let played =
            caught(|| play(actor, server, scenario, &cnc_address(port))).and_then(|played| played);
        if interrupt::is_requested() {
            // A signal interrupted the action, so the scenario is not judged.
            outcomes.push(CaseOutcome::interrupted(case));
            continue;
        }
        let (outcome, is_lost, count) = match played {
            Ok(played) => played,
            Err(error) => {
                let stop = Stop::Harness(error);
                outcomes.push(CaseOutcome::tried(case, Record::default(), Some(stop)));
                continue;
            }
        };
        if let (true, Some(why)) = (is_lost, actor.over()) {
            outcomes.push(CaseOutcome::untried(outcome.case, Verdict::Inconclusive, why));
            continue;
        }
        lost = if is_lost { lost.saturating_add(1) } else { 0 };
        requests = requests.saturating_add(count);
        outcomes.push(CaseOutcome { time: Some(begin.elapsed()), ..outcome });
        one_line(actor, &mut protocol);
    }
    if lost < UNANSWERED_MAX && actor.over().is_none() && !interrupt::is_requested() {
        let bye = actor.bye();
        let passed = bye.is_ok();
        // The deadline also ends the wait for the exit.
        if passed || actor.over().is_none() {
            let found = || bye.err().unwrap_or_default();
            protocol.check(Rule::CLIENT, passed, None, "exit code 0 after bye", found);
        }
    }
    if interrupt::is_requested() {
        outcomes.push(CaseOutcome::interrupted(protocol_outcome(protocol).case));
        return JudgedClient { hello: Some(hello), outcomes, requests };
    }
    one_line(actor, &mut protocol);
    outcomes.push(protocol_outcome(protocol));
    JudgedClient { hello: Some(hello), outcomes, requests }
}

/// Records a failure for each line that [`ClientUnderTest::unasked`] returns.
fn one_line(actor: &mut dyn ClientUnderTest, protocol: &mut ScenarioChecks) {
    for line in actor.unasked() {
        protocol.check(Rule::CLIENT, false, None, "one line for each action", || {
            format!("the additional line {line}")
        });
    }
}

/// Runs this project's client with a defect through the scenarios that test the violated
/// requirement, until this requirement fails. All scenarios test the requirement `CLIENT`. A valid
/// variant runs through all scenarios.
pub fn trial(defect: &ClientDefect, server: &TestServer) -> Vec<CaseOutcome> {
    let mut own = ReferenceClient { fault: Some(defect.fault) };
    let wanted = Rule::of(defect.requirement).id;
    let judges = |scenario: &Scenario| {
        let whole = wanted.is_empty() || wanted == CLIENT;
        whole || scenario.case().requirements.contains(&wanted)
    };
    let mut outcomes: Vec<CaseOutcome> = Vec::new();
    for scenario in scenarios().into_iter().filter(judges) {
        outcomes.extend(judge(&mut own, server, std::slice::from_ref(&scenario), None).outcomes);
        let mut verdicts = outcomes.iter().flat_map(|outcome| &outcome.verdicts);
        if verdicts.any(|one| one.requirement == wanted && one.verdict == Verdict::Fail) {
            break;
        }
    }
    outcomes
}

/// Runs one scenario. Returns its outcome, whether the client gave no valid answer, and the number
/// of recorded requests.
fn play(
    actor: &mut dyn ClientUnderTest,
    server: &TestServer,
    scenario: &Scenario,
    cnc_address: &CncAddress,
) -> Result<(CaseOutcome, bool, usize), String> {
    let file = scenario.program.as_deref().map(ProgramFile::new).transpose();
    let file = file.map_err(|error| format!("the NC program could not be written: {error}"))?;
    let name = file.as_ref().and_then(|file| file.0.to_str());
    let action = scenario.action_with(name).ok_or("the action is not in the vocabulary")?;
    let cnc = Cnc::with_default_model().map_err(|error| error.to_string())?;
    let mut script = ScenarioScript::new(cnc);
    script.tamper = scenario.tamper;
    script.rejections.clone_from(&scenario.rejections);
    script.literal.clone_from(&scenario.literal);
    script.response = scenario.response;
    if let Some(prepare) = scenario.prepare {
        prepare(&script);
    }
    server.begin(script);
    let reaction = actor.act(cnc_address, &scenario.id, &action);
    let (exchanges, beyond, script) = server.end();
    let script = script.ok_or("the CNC of the scenario is still in use")?;
    let mut scenario_checks = ScenarioChecks::default();
    let mut requests = RequestJudge::of_scenario();
    requests.judge(&exchanges, &mut scenario_checks);
    requests.finish(&mut scenario_checks);
    // `asks` is empty for example if the scenario is about replies, the Service Interface or the
    // streaming of a program.
    request_match::judge(&scenario.asks, &exchanges, may_write(scenario), &mut scenario_checks);
    if let Some(watch) = scenario.watch {
        ordering::judge(watch, scenario, &script, &exchanges, &mut scenario_checks);
    }
    let stop = judge_reaction(scenario, &script, &reaction, exchanges.last(), &mut scenario_checks);
    let stop = stop.or(beyond.stop());
    progress::requests(exchanges.len());
    let is_lost = !matches!(reaction, ClientReaction::Answer(_));
    let mut case = scenario.case();
    // The client may send more requests than the scenario expects: the case then also has the
    // requirements by which those requests were judged.
    for judgement in &scenario_checks.record.judgements {
        if !case.requirements.contains(&judgement.requirement) {
            case.requirements.push(judgement.requirement);
        }
    }
    Ok((CaseOutcome::tried(case, scenario_checks.record, stop), is_lost, exchanges.len()))
}

fn may_write(scenario: &Scenario) -> bool {
    let word = scenario.action.split(' ').next().unwrap_or_default();
    word.starts_with("write") || ["stream", "serve-echo", "ask-service"].contains(&word)
}

/// Judges the client's answer to the action. Returns why the answer is not judged by the rules of
/// the scenario; `None` if it is.
fn judge_reaction(
    scenario: &Scenario,
    script: &ScenarioScript,
    reaction: &ClientReaction,
    last: Option<&RecordedExchange>,
    scenario_checks: &mut ScenarioChecks,
) -> Option<Stop> {
    let Some(expected) = Expected::of(scenario, script) else {
        let why = "the simulated CNC rejects the request for the expected answer";
        return Some(Stop::Harness(why.to_owned()));
    };
    let rules = scenario.rules();
    let passed = match reaction {
        ClientReaction::Answer(ActionResult::Unsupported(what)) => {
            // The client listed this action in its hello, so it must support the action.
            let found = || format!("unsupported: {what}");
            scenario_checks.check(
                Rule::CLIENT,
                false,
                last,
                "support for the action, which its hello claims",
                found,
            );
            scenario_checks.follow_all(CLIENT);
            return Some(Stop::NotApplicable(format!("the client has no {what}")));
        }
        ClientReaction::Answer(ActionResult::Result(value)) => {
            let value = if scenario.action.starts_with("find-instance") {
                logical(value)
            } else {
                value.clone()
            };
            expected.any || expected.result.as_ref().is_some_and(|right| same(right, &value))
        }
        ClientReaction::Answer(ActionResult::Error(_)) => expected.error,
        _ => false,
    };
    let (rules, cause): (Vec<Rule>, _) = match reaction {
        ClientReaction::Answer(_) => (rules, scenario_checks.first_failed()),
        // A crash is a failure at level *must*, even if the scenario's rules are assumptions.
        ClientReaction::Died(_) => {
            let must = rules.into_iter().map(|rule| rule.at(Level::Must));
            (must.chain([Rule::CLIENT]).collect(), None)
        }
        ClientReaction::Silent(_) | ClientReaction::Garbled(_) => {
            // The missing or unreadable answer is taken as the cause of the other failed checks.
            scenario_checks.follow_all(CLIENT);
            (rules.into_iter().chain([Rule::CLIENT]).collect(), Some(CLIENT))
        }
        ClientReaction::Broken(why) => return Some(Stop::Inconclusive(why.clone())),
    };
    match cause {
        Some(cause) if !passed => {
            scenario_checks.follow(
                &rules,
                cause,
                last,
                &expected.to_string(),
                &reaction.to_string(),
            );
        }
        _ => scenario_checks.check(&rules[..], passed, last, || &expected, || reaction),
    }
    None
}

/// Converts an object address, index group and offset in JSON, to logical addressing.
fn logical(cnc_address: &Value) -> Value {
    let parts = cnc_address.as_array().map(Vec::as_slice).unwrap_or_default();
    match (parts, parts.first().and_then(Value::as_u64).and_then(|group| group.try_into().ok())) {
        ([_, offset], Some(group)) => {
            vec![request_match::logical(group).into(), offset.clone()].into()
        }
        _ => cnc_address.clone(),
    }
}

/// The expected answer of a client.
struct Expected {
    result: Option<Value>,
    any: bool,
    error: bool,
}

impl Expected {
    /// The expected answer of a scenario; `None` if it is that of the simulated CNC, which rejects
    /// the request.
    fn of(scenario: &Scenario, script: &ScenarioScript) -> Option<Self> {
        let (result, any, error) = match &scenario.expect {
            ExpectedAnswer::Result(value) => (Some(value.clone()), false, scenario.or_error),
            ExpectedAnswer::Asked(ask) => (Some(ask(script)?), false, scenario.or_error),
            ExpectedAnswer::Done => (None, true, scenario.or_error),
            ExpectedAnswer::Error => (None, false, true),
        };
        Some(Self { result, any, error })
    }
}

impl std::fmt::Display for Expected {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (&self.result, self.any, self.error) {
            (Some(value), _, true) => write!(f, "the result {value}, or an error"),
            (Some(value), ..) => write!(f, "the result {value}"),
            (None, true, true) => f.write_str("a result, or an error"),
            (None, true, _) => f.write_str("a result"),
            (None, ..) => f.write_str("an error"),
        }
    }
}

/// The outcome of the case about the client protocol.
fn protocol_outcome(mut scenario_checks: ScenarioChecks) -> CaseOutcome {
    let case = Case {
        id: "client-manners".to_owned(),
        title: "It answers hello, prints one line for each action, and exits after bye".to_owned(),
        subject: CaseSubject::Client,
        requirements: vec![CLIENT],
        needs: Needs::Queries,
        body: Body::Client,
    };
    scenario_checks.record.checks = scenario_checks.record.checks.max(1);
    CaseOutcome::tried(case, scenario_checks.record, None)
}

/// A temporary file with an NC program, which is removed on drop.
struct ProgramFile(PathBuf);

impl ProgramFile {
    fn new(text: &[u8]) -> io::Result<Self> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        // Another user, or an ended process, may have created a file or a link with this name.
        let (mut file, path) = loop {
            let count = COUNT.fetch_add(1, Ordering::Relaxed);
            let name = format!("ads-cnc-client-{}-{count}.nc", std::process::id());
            let path = std::env::temp_dir().join(name);
            match fs::File::create_new(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                created => break (created?, path),
            }
        };
        let program = Self(path);
        file.write_all(text)?;
        Ok(program)
    }
}

impl Drop for ProgramFile {
    fn drop(&mut self) {
        let _gone = fs::remove_file(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Action;
    use super::*;

    /// A client that panics at its first action.
    #[derive(Default)]
    struct PanickingClient(ReferenceClient, usize);

    impl ClientUnderTest for PanickingClient {
        fn hello(&mut self, cnc_address: &CncAddress) -> Result<ClientHello, ClientReaction> {
            ClientUnderTest::hello(&mut self.0, cnc_address)
        }

        fn act(
            &mut self,
            cnc_address: &CncAddress,
            scenario: &str,
            action: &Action,
        ) -> ClientReaction {
            self.1 += 1;
            assert_ne!(self.1, 1, "the first action");
            self.0.act(cnc_address, scenario, action)
        }

        fn bye(&mut self) -> Result<(), String> {
            self.0.bye()
        }
    }

    #[test]
    fn a_panic_is_a_harness_error_of_its_scenario_only() {
        let server = TestServer::new(([127, 0, 0, 1], 0).into()).unwrap();
        let scenarios = scenarios();
        let judged = judge(&mut PanickingClient::default(), &server, &scenarios[..2], None);
        let verdicts: Vec<_> = judged.outcomes.iter().map(CaseOutcome::verdict).collect();
        assert_eq!(verdicts, [Verdict::HarnessError, Verdict::Pass, Verdict::Pass]);
        let note = judged.outcomes[0].note.as_deref().unwrap();
        assert!(note.starts_with("the case panicked: ") && note.contains("the first action"));
    }

    /// A scenario whose expected answer is unknown has the verdict *harness error*.
    #[test]
    fn an_unknown_expected_answer_is_a_harness_error() {
        let server = TestServer::new(([127, 0, 0, 1], 0).into()).unwrap();
        let scenario = Scenario::new("client-unknown", "Unknown", "count-objects 1");
        let scenario = scenario.expect(ExpectedAnswer::Asked(|_| None));
        let judged = judge(&mut ReferenceClient::default(), &server, &[scenario], None);
        assert_eq!(judged.outcomes[0].verdict(), Verdict::HarnessError);
    }
}
