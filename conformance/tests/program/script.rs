//! Programs that send requests to services, with their timing.

use std::time::Duration;

use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
use ads_cnc::{CncStr, CncString, ErrorKind};
use ads_cnc_conformance::simulator::program::service::{CallStep, ServiceInterface};
use ads_cnc_conformance::simulator::program::{
    Repeat, Script, ScriptConfig, ScriptState, ServiceOutcome, ServiceRequest, Wait,
};
use proptest::prelude::*;

use crate::kept;
use crate::square_root::square_root;

const ZERO: Duration = Duration::ZERO;
const SET: [u8; 4] = [1, 0, 0, 0];

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

fn request(wait: Wait) -> ServiceRequest {
    ServiceRequest {
        uuid: ServiceId::new("19719079-BA06-4740-BC02-DE5215211751").unwrap(),
        text: CncString::from(CncStr::new("some-command").unwrap()),
        state: 1,
        wait,
    }
}

/// The wait of the example printed in `service-en` 3: at most 5 s, with timer 1.
const PRINTED: Wait = Wait::Cycle { p1: None, p2: Some(5000), p3: Some(1) };

fn config(wait: Wait, repeat: Repeat, pause: Duration) -> ScriptConfig {
    ScriptConfig { requests: vec![request(wait)], repeat, pause, cycle: ms(1) }
}

fn script(wait: Wait, repeat: Repeat, pause: Duration) -> Script {
    Script::new(config(wait, repeat, pause)).unwrap()
}

/// Runs the built-in script and the manual's service for a minute of simulated time.
#[test]
fn square_roots_are_requested_repeatedly() {
    let config = ScriptConfig::square_root().unwrap();
    let ids = [config.requests[0].uuid];
    let mut script = Script::new(config).unwrap();
    let (mut interface, mut host) = (ServiceInterface::new(), Host::new(&ids));
    for now in 0..60_000 {
        script.advance(ms(now), &mut interface);
        let answer = match host.step() {
            HostStep::Read(variable) => {
                host.read(interface.read(variable)).unwrap();
                continue;
            }
            HostStep::Write(variable, value) => {
                interface.write(variable, value).unwrap();
                host.written();
                continue;
            }
            HostStep::Serve { request, .. } => square_root(&request.to_string()),
            HostStep::Wait => {
                host.poll();
                continue;
            }
        };
        host.answer(CncStr::new(&answer.0).unwrap(), answer.1).unwrap();
    }
    assert!(script.answer_count() > 50, "{}", script.answer_count());
    assert_eq!(script.timed_out(), 0);
    for (at, answer) in script.answers().enumerate() {
        let (text, state) =
            [("1.732051", 1), ("ERROR: cannot calc square root of negative number -3.000000", 99)]
                [at % 2];
        let text = CncString::from(CncStr::new(text).unwrap());
        assert_eq!(answer.request, at % 2);
        assert_eq!(answer.outcome, ServiceOutcome::Response { state, text });
    }
}

/// The script writes one variable per cycle, in the order of the manual.
#[test]
fn each_cycle_executes_one_step() {
    let mut script = script(Wait::Loop, Repeat::Times(1), ZERO);
    let mut interface = ServiceInterface::new();
    let mut seen = Vec::new();
    for now in 0..5 {
        let step = script.next_step();
        seen.push(match step {
            Some(CallStep::Write(variable, _)) => variable.to_string(),
            other => format!("{other:?}"),
        });
        script.advance(ms(now), &mut interface);
    }
    assert_eq!(
        seen,
        [
            "V.G.SERVICE.UUID",
            "V.G.SERVICE.REQUEST",
            "V.G.SERVICE.REQUEST_STATE",
            "Some(Read(ResponseState))",
            "Some(Wait { until: None })"
        ]
    );
    assert_eq!(script.state(), ScriptState::Waiting(0));
    interface.write(ServiceVariable::Response, b"done\0").unwrap();
    interface.write(ServiceVariable::ResponseState, &SET).unwrap();
    script.advance(ms(5), &mut interface);
    assert_eq!((script.state(), script.answer_count()), (ScriptState::Waiting(0), 0));
    script.advance(ms(6), &mut interface);
    assert_eq!((script.state(), script.answer_count()), (ScriptState::Finished, 1));
    let answer = script.answers().next().unwrap();
    assert_eq!((answer.number, answer.request, answer.at), (1, 0, ms(6)));
    script.advance(ms(9999), &mut interface);
    assert_eq!((script.next_step(), script.answer_count()), (None, 1));
    script.restart();
    script.advance(ms(10_000), &mut interface);
    assert_eq!(script.state(), ScriptState::Asking(0));
}

/// Without a response, a wait by the cycle times out, and a wait by a loop does not.
#[test]
fn only_the_cycle_times_out() {
    let mut interface = ServiceInterface::new();
    let mut by_cycle = script(PRINTED, Repeat::Times(3), ms(10));
    by_cycle.advance(ZERO, &mut interface);
    by_cycle.advance(ms(3_600_000), &mut interface);
    // REQUEST_STATE is written in the third cycle of 1 ms, and the wait of 5 s begins there. The
    // next request begins 10 ms after the end of the wait.
    let ends: Vec<_> = by_cycle.answers().map(|answer| (answer.at, &answer.outcome)).collect();
    let timed_out = &ServiceOutcome::TimedOut;
    assert_eq!(ends, [(ms(5002), timed_out), (ms(10_014), timed_out), (ms(15_026), timed_out)]);
    assert_eq!((by_cycle.state(), by_cycle.timed_out()), (ScriptState::Finished, 3));

    let mut by_loop = script(Wait::Loop, Repeat::Times(1), ZERO);
    by_loop.advance(ZERO, &mut interface);
    by_loop.advance(Duration::from_secs(u64::MAX / 4), &mut interface);
    assert_eq!((by_loop.state(), by_loop.answer_count()), (ScriptState::Waiting(0), 0));
}

/// The number of stored outcomes and of overdue steps is limited.
#[test]
fn a_long_time_is_processed_quickly() {
    let mut interface = ServiceInterface::new();
    let at_once = Wait::Cycle { p1: Some(5), p2: None, p3: None };
    let mut script =
        Script::new(ScriptConfig { cycle: ZERO, ..config(at_once, Repeat::Endless, ZERO) })
            .unwrap();
    for year in 0..3 {
        script.advance(Duration::from_secs(year * 31_556_952), &mut interface);
    }
    assert!(script.answer_count() > 1000);
    assert_eq!(script.answers().count(), Script::ANSWERS_MAX);
    assert_eq!(script.answers().next_back().unwrap().number, script.answer_count());
}

#[test]
fn a_script_may_have_no_requests() {
    let mut interface = ServiceInterface::new();
    for (requests, repeat) in
        [(vec![], Repeat::Endless), (vec![request(Wait::Loop)], Repeat::Times(0))]
    {
        let config = ScriptConfig { requests, repeat, pause: ZERO, cycle: ms(1) };
        let mut script = Script::new(config).unwrap();
        script.advance(ms(100), &mut interface);
        assert_eq!(script.state(), ScriptState::Finished);
    }
    assert_eq!(interface, ServiceInterface::new());
}

#[test]
fn invalid_requests_are_rejected_with_their_index() {
    let good = request(Wait::Loop);
    let long = "x".repeat(128);
    let rejected = |request: ServiceRequest, kind: ErrorKind, text: &str| {
        let requests = vec![good.clone(), request];
        let config = ScriptConfig { requests, ..config(PRINTED, Repeat::Endless, ZERO) };
        let error = Script::new(config).unwrap_err();
        assert_eq!((error.request, error.error.kind()), (1, kind));
        assert!(error.to_string().starts_with(text), "{error}");
    };
    rejected(
        request(Wait::Cycle { p1: None, p2: Some(1), p3: None }),
        ErrorKind::Missing,
        "request 2 of the script: sys-service-wait: @P3",
    );
    rejected(ServiceRequest { state: 0, ..good.clone() }, ErrorKind::OutOfRange, "request 2");
    let text = CncString::from(CncStr::new(&long).unwrap());
    rejected(ServiceRequest { text, ..good.clone() }, ErrorKind::TooLong, "request 2");
}

fn any_wait() -> impl Strategy<Value = Wait> {
    prop_oneof![
        Just(Wait::Loop),
        (prop::option::of(0..3_u32), prop::option::of(0..80_u32))
            .prop_map(|(p1, p2)| Wait::Cycle { p1, p2, p3: Some(1) }),
    ]
}

proptest! {
#![proptest_config(kept::cases(300, file!()))]

/// The result does not depend on the number of calls of `advance` in which the same time passes.
#[test]
fn the_result_does_not_depend_on_advances(
    wait in any_wait(),
    pause in 0..50_u64,
    cycle in 1..5_000_u64,
    accesses in prop::collection::vec((0..100_u64, 0..4_u32, 1..2000_u64), 1..60),
) {
    let config = ScriptConfig {
        cycle: Duration::from_micros(cycle),
        ..config(wait, Repeat::Endless, ms(pause))
    };
    let (mut busy, mut lazy) = (Script::new(config.clone()).unwrap(), Script::new(config).unwrap());
    let (mut busy_at, mut lazy_at) = (ServiceInterface::new(), ServiceInterface::new());
    let mut now = ZERO;
    lazy.advance(now, &mut lazy_at);
    for (wait, state, ticks) in accesses {
        let next = now + ms(wait);
        while now < next {
            busy.advance(now, &mut busy_at);
            now += Duration::from_micros(ticks * 10);
        }
        now = next;
        busy.advance(now, &mut busy_at);
        lazy.advance(now, &mut lazy_at);
        prop_assert_eq!(&busy_at, &lazy_at);
        prop_assert_eq!(busy.state(), lazy.state());
        prop_assert!(busy.answers().eq(lazy.answers()));
        for interface in [&mut busy_at, &mut lazy_at] {
            interface.write(ServiceVariable::ResponseState, &state.to_le_bytes()).unwrap();
        }
    }
}
}
