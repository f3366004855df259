//! The golden sequences of the Service Interface, with `Script` as the program.

use std::collections::BTreeMap;
use std::time::Duration;

use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
use ads_cnc::{CncStr, CncString, ErrorKind};
use ads_cnc_conformance::simulator::program::service::{CallError, CallStep, ServiceInterface};
use ads_cnc_conformance::simulator::program::{
    Outcome, Repeat, Request, Script, ScriptConfig, ScriptState, Wait,
};
use ads_cnc_vectors::{Given, Pieces, ServiceAction, ServiceSequence, ServiceStep};

use crate::{cases, stated_fault};

#[test]
fn services_go_as_stated() {
    for case in cases("service", 50) {
        let Given::Service(given) = &case.given else { unreachable!() };
        assert_eq!(run(given, &case.id), stated_fault(case), "{}", case.id);
    }
}

type Fault = Option<&'static str>;

/// Goes through the steps up to the first at fault.
fn run<'c>(given: &'c ServiceSequence, id: &str) -> Option<(&'static str, &'c str)> {
    let ids: BTreeMap<&str, [ServiceId; 1]> = given
        .services
        .iter()
        .map(|(name, service)| (name.as_str(), [ServiceId::new(&service.uuid).expect(name)]))
        .collect();
    let mut scene = Scene {
        given,
        channels: BTreeMap::new(),
        hosts: ids.iter().map(|(name, ids)| (*name, Host::new(ids))).collect(),
        script: None,
        now: Duration::ZERO,
    };
    for step in &given.steps {
        if let Some(at) = step.at {
            scene.now = Duration::from_millis(at);
        }
        if let Some(fault) = scene.step(step, &format!("{id}: {}", step.id)) {
            return Some((fault, &step.id));
        }
    }
    None
}

struct Scene<'c> {
    given: &'c ServiceSequence,
    channels: BTreeMap<u32, ServiceInterface>,
    hosts: BTreeMap<&'c str, Host<'c>>,
    script: Option<Script>,
    now: Duration,
}

impl Scene<'_> {
    fn step(&mut self, step: &ServiceStep, at: &str) -> Fault {
        match step.action {
            ServiceAction::Read => {
                let value = step.bytes.as_ref().expect(at).bytes();
                let read = self.channel(step).read(variable(step)) == value;
                if step.actor == "program" {
                    self.script_step(step);
                }
                (!read).then_some("outcome")
            }
            ServiceAction::Write => self.write(step, at),
            ServiceAction::Ask => match ask(step) {
                Ok(script) => {
                    self.script = Some(script);
                    None
                }
                Err(error) => Some(class(error.kind())),
            },
            ServiceAction::Wait => {
                let script = self.script_step(step);
                assert_eq!(script.state(), ScriptState::Waiting(0), "{at}");
                assert!(matches!(script.next_step(), Some(CallStep::Wait { .. })), "{at}");
                None
            }
            ServiceAction::Timeout => match self.outcome(step) {
                None => Some("too-early"),
                other => {
                    assert_eq!(other, Some(Outcome::TimedOut), "{at}");
                    None
                }
            },
            ServiceAction::Done => match self.outcome(step) {
                None => Some("too-early"),
                Some(Outcome::Response { state, text: response }) => {
                    let stated = (text(&step.response), number(&step.response_state));
                    ((response.as_bytes().to_vec(), state) != stated).then_some("outcome")
                }
                other => panic!("{at}: {other:?}"),
            },
            ServiceAction::Serve => match self.host_step(step) {
                HostStep::Wait => Some("not-asked"),
                HostStep::Serve { request, request_state, .. } => {
                    let stated = (text(&step.request), number(&step.request_state));
                    ((request.bytes().collect(), request_state) != stated).then_some("outcome")
                }
                other => panic!("{at}: {other:?}"),
            },
            ServiceAction::Answer => self.answer(step, at),
            ServiceAction::Idle => {
                let step = self.host_step(step);
                assert_eq!(step, HostStep::Wait, "{at}");
                None
            }
        }
    }

    fn channel(&mut self, step: &ServiceStep) -> &mut ServiceInterface {
        self.channels.entry(step.channel.unwrap_or(1)).or_default()
    }

    /// The program does one step.
    fn script_step(&mut self, step: &ServiceStep) -> &Script {
        let interface = self.channels.entry(step.channel.unwrap_or(1)).or_default();
        let script = self.script.as_mut().expect("a program that asks");
        script.step(self.now, interface);
        script
    }

    /// What came of the request, once the program has looked.
    fn outcome(&mut self, step: &ServiceStep) -> Option<Outcome> {
        for _ in 0..2 {
            self.script_step(step);
        }
        let script = self.script.as_ref().expect("a program that asks");
        assert!(script.answer_count() <= 1);
        script.answers().next().map(|answer| answer.outcome.clone())
    }

    /// What the service wants next, once it has read what it wants to read.
    fn host_step(&mut self, step: &ServiceStep) -> HostStep<'_> {
        let interface = self.channel(step).clone();
        let host = self.hosts.get_mut(step.actor.as_str()).expect("a service");
        host.poll();
        while let HostStep::Read(variable) = host.step() {
            host.read(interface.read(variable)).expect("a value that fits");
        }
        host.step()
    }

    fn write(&mut self, step: &ServiceStep, at: &str) -> Fault {
        let (variable, value) = (variable(step), step.bytes.as_ref().expect(at).bytes());
        match step.actor.as_str() {
            "other" => {
                self.channel(step).write(variable, &value).err().map(|error| class(error.kind()))
            }
            "program" => {
                let script = self.script.as_ref().expect("a program that asks");
                if script.next_step() != Some(CallStep::Write(variable, &value)) {
                    return Some("order");
                }
                self.script_step(step);
                assert_eq!(self.channel(step).read(variable), value, "{at}");
                None
            }
            service => {
                if self.host_step(step) != HostStep::Write(variable, &value) {
                    return Some("order");
                }
                self.channel(step).write(variable, &value).expect(at);
                self.hosts.get_mut(service).expect("a service").written();
                None
            }
        }
    }

    fn answer(&mut self, step: &ServiceStep, at: &str) -> Fault {
        let (response, state) = (text(&step.response), number(&step.response_state));
        let HostStep::Serve { request, .. } = self.host_step(step) else { panic!("{at}") };
        let request = request.to_string();
        let host = self.hosts.get_mut(step.actor.as_str()).expect("a service");
        if let Err(error) = host.answer(CncStr::from_bytes(&response).expect(at), state) {
            return Some(class(error.kind()));
        }
        let does = self.given.services[&step.actor].does.as_deref();
        let stated = (String::from_utf8_lossy(&response).into_owned(), state);
        (does == Some("square-root") && square_root(&request) != stated).then_some("outcome")
    }
}

fn ask(step: &ServiceStep) -> Result<Script, CallError> {
    let parameter = |value: &Option<String>| value.as_ref().map(|_| number(value));
    let wait = step.wait.as_ref().map_or(Wait::Loop, |wait| Wait::Cycle {
        p1: parameter(&wait.p1),
        p2: parameter(&wait.p2),
        p3: parameter(&wait.p3),
    });
    let request = Request {
        uuid: ServiceId::new(step.uuid.as_deref().expect("a UUID"))?,
        text: CncString::from(CncStr::from_bytes(&text(&step.request))?),
        state: parameter(&step.request_state).unwrap_or(1),
        wait,
    };
    let config = ScriptConfig {
        requests: vec![request],
        repeat: Repeat::Times(1),
        pause: Duration::ZERO,
        cycle: Duration::ZERO,
    };
    Script::new(config).map_err(|error| error.error)
}

/// The example's service, which the manuals have in C: `atof`, `sqrt` and `%f`.
pub(crate) fn square_root(request: &str) -> (String, u32) {
    let digits = request.trim_start();
    let x = (0..=digits.len()).rev().find_map(|len| digits.get(..len)?.parse().ok());
    let x: f64 = x.unwrap_or(0.0);
    if x >= 0.0 {
        return (format!("{:.6}", x.sqrt()), 1);
    }
    (format!("ERROR: cannot calc square root of negative number {x:.6}"), 99)
}

fn variable(step: &ServiceStep) -> ServiceVariable {
    let name = step.variable.as_deref().expect("a variable");
    ServiceVariable::by_name(name).expect(name)
}

fn text(pieces: &Option<Pieces>) -> Vec<u8> {
    pieces.as_ref().expect("a text").bytes()
}

fn number(value: &Option<String>) -> u32 {
    value.as_deref().expect("a number").parse().expect("a number")
}

fn class(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::Truncated => "truncated",
        ErrorKind::Trailing => "trailing",
        ErrorKind::TooLong => "too-long",
        ErrorKind::OutOfRange => "out-of-range",
        ErrorKind::Missing => "missing",
        other => panic!("no case is refused as {other:?}"),
    }
}
