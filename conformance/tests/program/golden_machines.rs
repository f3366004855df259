//! The golden sequences of the Service Interface with single requests instead of a script.

use std::collections::BTreeMap;
use std::time::Duration;

use ads_cnc::service::*;
use ads_cnc::{CncStr, ErrorKind};
use ads_cnc_conformance::simulator::program::service::*;
use ads_cnc_vectors::{Given, Pieces, ServiceAction, ServiceSequence, ServiceStep};

use crate::{cases, stated_fault};

/// The cases that say when the interface sets REQUEST_STATE to 0 of itself.
const ABOUT_CLEARING: [&str; 2] = ["interface-clears", "interface-clears-not"];

#[test]
fn services_go_as_stated() {
    for case in cases("service", 50) {
        let Given::Service(given) = &case.given else { unreachable!() };
        for clears in [Clears::OnResponseState, Clears::Never] {
            if clears == Clears::Never && ABOUT_CLEARING.contains(&case.id.as_str()) {
                continue;
            }
            let fault = run(given, clears, &case.id);
            assert_eq!(fault, stated_fault(case), "{}, {clears:?}", case.id);
        }
    }
}

type Fault = Option<&'static str>;

/// Goes through the steps up to the first at fault.
fn run<'c>(
    given: &'c ServiceSequence,
    clears: Clears,
    id: &str,
) -> Option<(&'static str, &'c str)> {
    let ids: BTreeMap<&str, [ServiceId; 1]> = given
        .services
        .iter()
        .map(|(name, service)| (name.as_str(), [ServiceId::new(&service.uuid).expect(name)]))
        .collect();
    let mut scene = Scene {
        given,
        clears,
        channels: BTreeMap::new(),
        hosts: ids.iter().map(|(name, ids)| (*name, Host::new(ids))).collect(),
        call: None,
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
    clears: Clears,
    channels: BTreeMap<u32, ServiceInterface>,
    hosts: BTreeMap<&'c str, Host<'c>>,
    call: Option<ServiceCall>,
    now: Duration,
}

impl Scene<'_> {
    fn step(&mut self, step: &ServiceStep, at: &str) -> Fault {
        match step.action {
            ServiceAction::Read => {
                let variable = variable(step);
                let value = step.bytes.as_ref().expect(at).bytes();
                (self.channel(step).read(variable) != value).then_some("outcome")
            }
            ServiceAction::Write => self.write(step, at),
            ServiceAction::Ask => match ask(step) {
                Ok(call) => {
                    self.call = Some(call);
                    None
                }
                Err(error) => Some(class(error.kind())),
            },
            ServiceAction::Wait => {
                let step = self.call_step(step);
                assert!(matches!(step, CallStep::Wait { .. }), "{at}: {step:?}");
                None
            }
            ServiceAction::Timeout => match self.call_step(step) {
                CallStep::Wait { .. } => Some("too-early"),
                other => {
                    assert_eq!(other, CallStep::TimedOut, "{at}");
                    None
                }
            },
            ServiceAction::Done => match self.call_step(step) {
                CallStep::Wait { .. } => Some("too-early"),
                CallStep::Done { state, response } => {
                    let stated = (text(&step.response), number(&step.response_state));
                    ((response.bytes().collect(), state) != stated).then_some("outcome")
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
        let clears = self.clears;
        let new = || ServiceInterface::with(clears);
        self.channels.entry(step.channel.unwrap_or(1)).or_insert_with(new)
    }

    /// What the program wants next, once it has read what it wants to read.
    fn call_step(&mut self, step: &ServiceStep) -> CallStep<'_> {
        let (interface, now) = (self.channel(step).clone(), self.now);
        let call = self.call.as_mut().expect("a program that asks");
        call.poll();
        while let CallStep::Read(variable) = call.step() {
            call.read(interface.read(variable), now).expect("a value that fits");
        }
        call.step()
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
        let own = match step.actor.as_str() {
            "other" => true,
            "program" => {
                let call = self.call.as_ref().expect("a program that asks");
                call.step() == CallStep::Write(variable, &value)
            }
            _ => self.host_step(step) == HostStep::Write(variable, &value),
        };
        if !own {
            return Some("order");
        }
        if let Err(error) = self.channel(step).write(variable, &value) {
            return Some(class(error.kind()));
        }
        match step.actor.as_str() {
            "other" => {}
            "program" => self.call.as_mut().expect("a program that asks").written(self.now),
            service => self.hosts.get_mut(service).expect("a service").written(),
        }
        None
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

fn ask(step: &ServiceStep) -> Result<ServiceCall, CallError> {
    let id = ServiceId::new(step.uuid.as_deref().expect("a UUID"))?;
    let wait = step.wait.clone().unwrap_or_default();
    let parameter = |value: &Option<String>| value.as_ref().map(|_| number(value));
    let [p1, p2, p3] = [&wait.p1, &wait.p2, &wait.p3].map(parameter);
    let wait = SysServiceWait::from_parameters(p1, p2, p3)?;
    let request = text(&step.request);
    let request = CncStr::from_bytes(&request)?;
    match &step.request_state {
        Some(_) => ServiceCall::with_state(id, request, number(&step.request_state), wait),
        None => ServiceCall::new(id, request, wait),
    }
}

/// The example's service, which the manuals have in C: `atof`, `sqrt` and `%f`.
fn square_root(request: &str) -> (String, u32) {
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
