//! The steps of a sequence of the Service Interface, by NC program, services and other clients.

use std::collections::BTreeMap;
use std::time::Duration;

use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
use ads_cnc::{CncStr, CncString, ErrorKind};
use ads_cnc_vectors::{Pieces, ServiceAction, ServiceSequence, ServiceStep};

use super::outcome::{Fault, StepResult, differs, lacks};
use crate::simulator::program::service::{CallError, CallStep, ServiceInterface};
use crate::simulator::program::{
    Repeat, Script, ScriptConfig, ServiceOutcome, ServiceRequest, Wait,
};

/// The interfaces of a CNC's channels, by number, and the NC program.
pub trait ServiceActor {
    type Program: RequestingProgram;

    /// An NC program with one request.
    fn ask(&self, request: ServiceRequest) -> Result<Self::Program, CallError>;

    /// The value of a variable; a text without its padding.
    fn read(&mut self, channel: u32, variable: ServiceVariable) -> StepResult<Vec<u8>>;

    /// Writes a value. Returns the class of the fault if it is rejected.
    fn write(
        &mut self,
        channel: u32,
        variable: ServiceVariable,
        value: &[u8],
    ) -> StepResult<Option<&'static str>>;

    /// Changes an interface directly.
    fn with(&mut self, channel: u32, then: impl FnOnce(&mut ServiceInterface)) -> StepResult<()>;
}

/// An NC program that sends a request.
pub trait RequestingProgram {
    /// Executes one step.
    fn step(&mut self, now: Duration, interface: &mut ServiceInterface);

    /// The next step.
    fn next_step(&self) -> Option<CallStep<'_>>;

    /// The outcome of its request.
    fn outcome(&self) -> Option<ServiceOutcome>;
}

impl RequestingProgram for Script {
    fn step(&mut self, now: Duration, interface: &mut ServiceInterface) {
        Script::step(self, now, interface);
    }

    fn next_step(&self) -> Option<CallStep<'_>> {
        Script::next_step(self)
    }

    fn outcome(&self) -> Option<ServiceOutcome> {
        self.answers().next().map(|answer| answer.outcome.clone())
    }
}

/// Plays the steps up to the first fault.
pub fn play<'c>(
    actor: &mut impl ServiceActor,
    given: &'c ServiceSequence,
) -> StepResult<Fault<'c>> {
    let mut ids: BTreeMap<&str, [ServiceId; 1]> = BTreeMap::new();
    for (name, service) in &given.services {
        ids.insert(name, [ServiceId::new(&service.uuid)?]);
    }
    let hosts = ids.iter().map(|(name, ids)| (*name, Host::new(ids))).collect();
    let mut replay = ServiceReplay { actor, given, hosts, program: None, now: Duration::ZERO };
    for step in &given.steps {
        if let Some(at) = step.at {
            replay.now = Duration::from_millis(at);
        }
        if let Some(fault) = replay.step(step)? {
            return Ok(Some((fault, &step.id)));
        }
    }
    Ok(None)
}

struct ServiceReplay<'s, 'c, A: ServiceActor> {
    actor: &'s mut A,
    given: &'c ServiceSequence,
    hosts: BTreeMap<&'c str, Host<'s>>,
    program: Option<A::Program>,
    now: Duration,
}

impl<A: ServiceActor> ServiceReplay<'_, '_, A> {
    fn step(&mut self, step: &ServiceStep) -> StepResult<Option<&'static str>> {
        match step.action {
            ServiceAction::Read => {
                let value = bytes(step)?;
                let read = self.actor.read(channel(step), variable(step)?)?;
                if step.actor == "program" {
                    self.program_step(step)?;
                }
                Ok((read != value).then_some("outcome"))
            }
            ServiceAction::Write => self.write(step),
            ServiceAction::Ask => match request(step)?.and_then(|one| self.actor.ask(one)) {
                Ok(program) => {
                    self.program = Some(program);
                    Ok(None)
                }
                Err(error) => Ok(Some(fault_class(error.kind()))),
            },
            ServiceAction::Wait => match self.program_step(step)?.next_step() {
                Some(CallStep::Wait { .. }) => Ok(None),
                other => differs("the program waits", format!("{other:?}")),
            },
            ServiceAction::Timeout => match self.outcome(step)? {
                None => Ok(Some("too-early")),
                Some(ServiceOutcome::TimedOut) => Ok(None),
                Some(other) => differs("no answer in time", format!("{other:?}")),
            },
            ServiceAction::Done => match self.outcome(step)? {
                None => Ok(Some("too-early")),
                Some(ServiceOutcome::Response { state, text: response }) => {
                    let stated = (text(&step.response)?, number(&step.response_state)?);
                    let same = (response.as_bytes().to_vec(), state) == stated;
                    Ok((!same).then_some("outcome"))
                }
                Some(other) => differs("an answer", format!("{other:?}")),
            },
            ServiceAction::Serve => match self.next_action(step)? {
                HostAction::Nothing => Ok(Some("not-asked")),
                HostAction::Serve(request, state) => {
                    let stated = (text(&step.request)?, number(&step.request_state)?);
                    let same = (request.as_bytes().to_vec(), state) == stated;
                    Ok((!same).then_some("outcome"))
                }
                other => differs("a request", format!("{other:?}")),
            },
            ServiceAction::Answer => self.answer(step),
            ServiceAction::Idle => match self.next_action(step)? {
                HostAction::Nothing => Ok(None),
                other => differs("nothing to do", format!("{other:?}")),
            },
        }
    }

    /// Executes one step of the program.
    fn program_step(&mut self, step: &ServiceStep) -> StepResult<&A::Program> {
        let program = self.program.as_mut().ok_or_else(|| lacks("program"))?;
        let now = self.now;
        self.actor.with(channel(step), |interface| program.step(now, interface))?;
        Ok(program)
    }

    /// The outcome of the request, after the program has polled.
    fn outcome(&mut self, step: &ServiceStep) -> StepResult<Option<ServiceOutcome>> {
        self.program_step(step)?;
        Ok(self.program_step(step)?.outcome())
    }

    /// The next action of the service, after it has read all variables it needs.
    fn next_action(&mut self, step: &ServiceStep) -> StepResult<HostAction> {
        let host = self.hosts.get_mut(step.actor.as_str()).ok_or_else(|| lacks("service"))?;
        host.poll();
        loop {
            match host.step() {
                HostStep::Read(variable) => {
                    let value = self.actor.read(channel(step), variable)?;
                    if let Err(error) = host.read(&value) {
                        return differs(format!("a value of {}", variable.name()), error);
                    }
                }
                HostStep::Write(variable, value) => {
                    return Ok(HostAction::Write(variable, value.to_vec()));
                }
                HostStep::Serve { request, request_state, .. } => {
                    return Ok(HostAction::Serve(request.into(), request_state));
                }
                _ => return Ok(HostAction::Nothing),
            }
        }
    }

    fn write(&mut self, step: &ServiceStep) -> StepResult<Option<&'static str>> {
        let (variable, value) = (variable(step)?, bytes(step)?);
        match step.actor.as_str() {
            "other" => self.actor.write(channel(step), variable, &value),
            "program" => {
                let program = self.program.as_ref().ok_or_else(|| lacks("program"))?;
                if program.next_step() != Some(CallStep::Write(variable, &value)) {
                    return Ok(Some("order"));
                }
                self.program_step(step)?;
                let read = self.actor.read(channel(step), variable)?;
                if read != value {
                    return differs(format!("{value:02x?} in {}", step.id), format!("{read:02x?}"));
                }
                Ok(None)
            }
            service => {
                if self.next_action(step)? != HostAction::Write(variable, value.clone()) {
                    return Ok(Some("order"));
                }
                if self.actor.write(channel(step), variable, &value)?.is_some() {
                    return differs(format!("{} takes {value:02x?}", variable.name()), "an error");
                }
                let host = self.hosts.get_mut(service).ok_or_else(|| lacks("service"))?;
                host.written();
                Ok(None)
            }
        }
    }

    fn answer(&mut self, step: &ServiceStep) -> StepResult<Option<&'static str>> {
        let (response, state) = (text(&step.response)?, number(&step.response_state)?);
        let HostAction::Serve(request, _) = self.next_action(step)? else {
            return differs("a request to answer", "none");
        };
        let host = self.hosts.get_mut(step.actor.as_str()).ok_or_else(|| lacks("service"))?;
        let answer = CncStr::from_bytes(&response)?;
        if let Err(error) = host.answer(answer, state) {
            return Ok(Some(fault_class(error.kind())));
        }
        let service = self.given.services.get(&step.actor);
        let does = service.and_then(|service| service.does.as_deref());
        let stated = (String::from_utf8_lossy(&response).into_owned(), state);
        let wrong = does == Some("square-root") && square_root(&request.to_string()) != stated;
        Ok(wrong.then_some("outcome"))
    }
}

/// The next action of a service, other than reading.
#[derive(Debug, PartialEq)]
enum HostAction {
    Nothing,
    Write(ServiceVariable, Vec<u8>),
    Serve(CncString, u32),
}

fn channel(step: &ServiceStep) -> u32 {
    step.channel.unwrap_or(1)
}

fn request(step: &ServiceStep) -> StepResult<Result<ServiceRequest, CallError>> {
    let parameter = |value: &Option<String>| value.as_ref().map(|_| number(value)).transpose();
    let wait = match &step.wait {
        None => Wait::Loop,
        Some(wait) => Wait::Cycle {
            p1: parameter(&wait.p1)?,
            p2: parameter(&wait.p2)?,
            p3: parameter(&wait.p3)?,
        },
    };
    let state = parameter(&step.request_state)?.unwrap_or(1);
    let asked = text(&step.request)?;
    let asked = CncStr::from_bytes(&asked).map(CncString::from);
    let uuid = ServiceId::new(step.uuid.as_deref().ok_or_else(|| lacks("UUID"))?);
    Ok(match (uuid, asked) {
        (Ok(uuid), Ok(text)) => Ok(ServiceRequest { uuid, text, state, wait }),
        (Err(error), _) | (_, Err(error)) => Err(error.into()),
    })
}

/// A script with one request.
pub fn script(request: ServiceRequest) -> Result<Script, CallError> {
    let config = ScriptConfig {
        requests: vec![request],
        repeat: Repeat::Times(1),
        pause: Duration::ZERO,
        cycle: Duration::ZERO,
    };
    Script::new(config).map_err(|error| error.error)
}

/// The service of the manual's example, there in C: `atof`, `sqrt` and `%f`.
pub fn square_root(request: &str) -> (String, u32) {
    let digits = request.trim_start();
    let x = (0..=digits.len()).rev().find_map(|len| digits.get(..len)?.parse().ok());
    let x: f64 = x.unwrap_or(0.0);
    if x >= 0.0 {
        return (format!("{:.6}", x.sqrt()), 1);
    }
    (format!("ERROR: cannot calc square root of negative number {x:.6}"), 99)
}

fn variable(step: &ServiceStep) -> StepResult<ServiceVariable> {
    let name = step.variable.as_deref().and_then(ServiceVariable::by_name);
    name.ok_or_else(|| lacks("variable"))
}

fn bytes(step: &ServiceStep) -> StepResult<Vec<u8>> {
    Ok(step.bytes.as_ref().ok_or_else(|| lacks("bytes"))?.bytes())
}

fn text(pieces: &Option<Pieces>) -> StepResult<Vec<u8>> {
    Ok(pieces.as_ref().ok_or_else(|| lacks("text"))?.bytes())
}

fn number(value: &Option<String>) -> StepResult<u32> {
    let number = value.as_deref().and_then(|value| value.parse().ok());
    number.ok_or_else(|| lacks("number"))
}

/// The class of an error in sequences.
pub fn fault_class(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::Truncated => "truncated",
        ErrorKind::Trailing => "trailing",
        ErrorKind::TooLong => "too-long",
        ErrorKind::OutOfRange => "out-of-range",
        ErrorKind::Missing => "missing",
        _ => "another fault",
    }
}
