//! The Service Interface: all parties together, and each machine alone.

use std::time::Duration;

use ads_cnc::service::{HostStep, ServiceId, ServiceVariable};
use ads_cnc_conformance::simulator::program::service::{Clears, ServiceInterface};

use super::input::Input;
use crate::common::machines::{CheckedHost, HostMutation, service_ids};
use crate::machines::{CheckedCall, CheckedVariables};
use crate::world::{Action, ServiceMutation, StepOutcome, TestRequest, World};
use crate::{Defect, Outcome};

/// Input: the settings (1 byte): one host for both services (bit 0); the interface never clears
/// REQUEST_STATE (bit 1); chaos (bit 2): the program may give up, the CNC be reset and a host
/// restart. Then the number of requests and a byte for each; with chaos, the same again for the
/// requests after the chaos. Then one byte for each action, see [`actions`].
///
/// Without chaos, every request is served once, by the service to which it is sent, and gets its
/// own answer, whichever steps fail (with two hosts, [`World::luck_of_two`] replaces some actions).
/// With chaos, this holds for the requests after it, once all parties have become idle.
pub(crate) fn world(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let what = input.byte();
    let (together, chaos) = (what & 1 != 0, what & 4 != 0);
    let clears = if what & 2 != 0 { Clears::Never } else { Clears::OnResponseState };
    let (requests, after) =
        (requests(&mut input), if chaos { requests(&mut input) } else { vec![] });

    let ids = service_ids();
    let mut world = World::new(&ids, together, clears, !chaos, world_bend(defect));
    let mut next = requests.into_iter();
    for action in input.take(200).flat_map(|byte| actions(byte, chaos)) {
        let action = if together || chaos { action } else { world.luck_of_two(action) };
        world.act(action, &mut next);
    }
    if chaos {
        world.settle();
        next = after.into_iter();
    }
    world.finish(&mut next);
    Outcome::accepted((what, format!("{:?}", world.served())))
}

/// Reads requests: their number, and a byte for each with the service to which the request is sent (bit 0)
/// and one of two texts (bit 1).
fn requests(input: &mut Input<'_>) -> Vec<TestRequest> {
    let count = input.byte() % 8;
    (0..count).map(|_| input.byte()).map(|byte| (usize::from(byte & 1), byte >> 1 & 1)).collect()
}

/// The actions of a byte. Bits 0 to 2: the program makes steps (0, 1), a host makes steps (2 to 4) or a
/// step that fails (5, 6), or an action of chaos (7; without chaos a step of the program). Bit 3
/// selects the host. Bits 4 to 6 have the number of steps less 1; bits 4 to 7 select the action of
/// chaos.
fn actions(byte: u8, chaos: bool) -> impl Iterator<Item = Action> {
    let (place, more) = (usize::from(byte >> 3 & 1), byte >> 4);
    let (action, times) = match byte & 7 {
        0..2 => (Action::Program, more % 8 + 1),
        2..5 => (Action::Host(place, StepOutcome::Fine), more % 8 + 1),
        5 => (Action::Host(place, StepOutcome::Fails), 1),
        6 => (Action::Host(place, StepOutcome::FailsLate), 1),
        _ if !chaos => (Action::Program, 1),
        _ => match more {
            0..4 => (Action::GiveUp, 1),
            4..8 => (Action::ResetCnc, 1),
            _ => (Action::Restart(place), 1),
        },
    };
    std::iter::repeat_n(action, times.into())
}

pub(crate) const WORLD_DEFECTS: &[&str] = &[
    "a write that failed counts as done",
    "a failed step restarts the host",
    "RESPONSE_STATE is not reset when REQUEST_STATE is written",
    "a restarted host has no services",
    "a request with the second text is attributed to the other service",
    "a response loses its last character if it has six",
];

fn world_bend(defect: Defect) -> ServiceMutation {
    let mut mutation = ServiceMutation::NONE;
    if defect.is(1) {
        mutation.failed = |host| host.written();
    }
    if defect.is(2) {
        mutation.failed = |host| host.restart();
    }
    if defect.is(3) {
        mutation.write = |interface, variable, value| {
            let before = interface.read(ServiceVariable::ResponseState).to_vec();
            interface.write(variable, value).unwrap();
            if variable == ServiceVariable::RequestState && value != [0; 4] && before != [0; 4] {
                let asked = Clears::Never;
                let mut other = ServiceInterface::with(asked);
                for variable in ServiceVariable::ALL {
                    other.write(variable, interface.read(variable)).unwrap();
                }
                other.write(ServiceVariable::ResponseState, &before).unwrap();
                *interface = other;
            }
        };
    }
    if defect.is(4) {
        mutation.restart = |host| *host = ads_cnc::service::Host::new(&[]);
    }
    if defect.is(5) {
        mutation.asked = |service, text| if text.ends_with('1') { 1 - service } else { service };
    }
    if defect.is(6) {
        mutation.write = |interface, variable, value| {
            let long = variable == ServiceVariable::Response && value.len() == 7;
            interface.write(variable, if long { &value[..5] } else { value }).unwrap();
        };
    }
    mutation
}

/// Input: the machine (1 byte, modulo 3: [`host`], [`call`], [`variables`]). For `call`, the
/// service, the request state, the parameters and the request follow; for `variables`, when
/// REQUEST_STATE is cleared. The rest is the events. [`value`] reads the value of an event.
///
/// A host serves a request only after it has read the request twice, answers it only after it has
/// read the same request once more, and writes in the required order. The request of a program and
/// the five variables behave as a simple model of the manual does.
pub(crate) fn machines(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    match input.byte() % 3 {
        0 => host(input, defect),
        1 => call(input, defect),
        _ => variables(input, defect),
    }
}

/// Maximum number of events in an input; the rest of the input is ignored.
const EVENTS: usize = 300;

fn host(mut input: Input<'_>, defect: Defect) -> Outcome {
    let ids = service_ids();
    let mut host = CheckedHost::new(&ids, host_bend(defect));
    let (mut steps, mut last) = (Vec::new(), Vec::new());
    while !input.is_empty() && steps.len() < EVENTS {
        match input.byte() % 16 {
            0..9 => host.read(value(&mut input, &mut last)),
            9..11 => host.written(),
            11 => host.failed(),
            12..14 => host.poll(),
            14 => {
                let state = input.byte().into();
                host.answer(value(&mut input, &mut last), state);
            }
            _ => host.restart(),
        }
        steps.push(format!("{:?}", host.step()));
    }
    Outcome::accepted(steps)
}

fn call(mut input: Input<'_>, defect: Defect) -> Outcome {
    let mut last = Vec::new();
    let id = *input.choose(&service_ids());
    let (asked, given) = (input.byte().into(), input.byte());
    let parameters = [0, 1, 2].map(|bit| (given >> bit & 1 != 0).then(|| u32::from(input.byte())));
    let request = value(&mut input, &mut last).to_vec();
    let mut call = match CheckedCall::new(id, &request, asked, parameters) {
        Ok(call) => call,
        Err(error) => return Outcome::rejected(error.to_string()),
    };
    let (mut now, mut events) = (Duration::ZERO, 0);
    while !input.is_empty() && events < EVENTS {
        events += 1;
        let event = input.byte();
        now += Duration::from_millis((event >> 4).into());
        match event % 8 {
            0..3 => call.written(now),
            3 => call.poll(),
            _ => {
                let value = value(&mut input, &mut last);
                let told = match value {
                    [first, ..] if defect.is(5) && value.len() == 4 => &[*first & 0x0F, 0, 0, 0],
                    _ => value,
                };
                call.read(value, now, (told, if defect.is(6) { now * 2 } else { now }));
            }
        }
    }
    Outcome::accepted((events, now))
}

fn variables(mut input: Input<'_>, defect: Defect) -> Outcome {
    let clears = *input.choose(&[Clears::OnResponseState, Clears::Never]);
    let mut variables = CheckedVariables::new(clears);
    let (mut events, mut last) = (0, Vec::new());
    while !input.is_empty() && events < EVENTS {
        events += 1;
        match input.byte() {
            0xFF => variables.reset(),
            variable => {
                let variable = ServiceVariable::ALL[usize::from(variable % 5)];
                let value = value(&mut input, &mut last);
                let told = if defect.is(7) && value.len() == 5 { &value[..4] } else { value };
                variables.write(variable, value, told);
            }
        }
    }
    Outcome::accepted(events)
}

/// Reads a value: its form is in the lower three bits of a byte, a parameter of the form in the upper five
/// bits. Form 0 is the last value again.
fn value<'v>(input: &mut Input<'_>, last: &'v mut Vec<u8>) -> &'v [u8] {
    let ids: [ServiceId; 2] = service_ids();
    let pick = input.byte();
    match pick & 7 {
        0 => {}
        1 => *last = vec![0; 4],
        2 => *last = vec![pick >> 3, 0, 0, 0],
        3 => *last = ids[usize::from(pick >> 3 & 1)].to_string().to_lowercase().into_bytes(),
        4 => *last = [ids[usize::from(pick >> 3 & 1)].to_string().as_bytes(), b"\0"].concat(),
        5 => *last = vec![b'0' + (pick >> 3), 0],
        6 => *last = vec![b'x'; 112 + usize::from(pick >> 3)],
        _ => *last = input.bytes((pick >> 3).into()).to_vec(),
    }
    last
}

pub(crate) const MACHINES_DEFECTS: &[&str] = &[
    "a changed text is taken for the previous one",
    "a response state of 0 is accepted",
    "a write that failed counts as done",
    "every poll restarts the host",
    "a response state loses its upper four bits",
    "the time runs twice as fast",
    "the fifth byte of a state is ignored",
    "REQUEST_STATE is not cleared after a response",
    "an invalid value restarts the host",
];

fn host_bend(defect: Defect) -> HostMutation {
    let mut mutation = HostMutation::NONE;
    if defect.is(1) {
        mutation.read = |value, last| match last {
            Some(last) if value.len() != 4 => last,
            _ => value,
        };
    }
    if defect.is(2) {
        mutation.state = |state| state.max(1);
    }
    if defect.is(3) {
        mutation.failed = |host| host.written();
    }
    if defect.is(4) {
        mutation.poll = |host| host.restart();
    }
    if defect.is(8) {
        mutation.written = |host| {
            if matches!(host.step(), HostStep::Write(ServiceVariable::Response, _)) {
                host.written();
            }
            host.written();
        };
    }
    if defect.is(9) {
        mutation.rejected = |host| host.restart();
    }
    mutation
}
