//! Plays the steps of a sequence of the Service Interface as the NC program, the services and another
//! client.

use std::collections::BTreeMap;
use std::time::Duration;

use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
use ads_cnc::{CncStr, CncString, ErrorKind, VariableType};
use ads_cnc_conformance::simulator::program::service::{CallError, CallStep, ServiceInterface};
use ads_cnc_conformance::simulator::program::{
    Repeat, Script, ScriptConfig, ServiceOutcome, ServiceRequest, Wait,
};
use ads_cnc_vectors::{ServiceAction, ServiceSequence, ServiceStep};

use super::{Fault, bytes, differs, lacks};
use crate::services::{read_variable, write_variable};
use crate::square_root::square_root;
use crate::target::{CheckResult, TestCnc};

/// Plays the steps of a sequence up to the first error, after the interfaces of all channels are reset.
pub(super) fn play<'c>(target: &TestCnc, given: &'c ServiceSequence) -> CheckResult<Fault<'c>> {
    let channels = target.channels();
    for &channel in &channels {
        target.cnc().set_script(channel, None)?;
        target.cnc().with_service(channel, |service| service.reset())?;
    }
    let mut ids: BTreeMap<&str, [ServiceId; 1]> = BTreeMap::new();
    for (name, service) in &given.services {
        ids.insert(name, [ServiceId::new(&service.uuid)?]);
    }
    let hosts = ids.iter().map(|(name, ids)| (*name, Host::new(ids))).collect();
    let now = Duration::ZERO;
    let mut player = Player { target, channels, given, hosts, program: None, now };
    for step in &given.steps {
        if let Some(at) = step.at {
            player.now = Duration::from_millis(at);
        }
        if let Some(fault) = player.step(step)? {
            return Ok(Some((fault, &step.id)));
        }
    }
    Ok(None)
}

struct Player<'s, 'c> {
    target: &'s TestCnc,
    /// The numbers of the CNC's channels: channel n of a sequence is the nth of them.
    channels: Vec<u8>,
    given: &'c ServiceSequence,
    hosts: BTreeMap<&'c str, Host<'s>>,
    /// The NC program, with one request.
    program: Option<Script>,
    now: Duration,
}

impl Player<'_, '_> {
    fn step(&mut self, step: &ServiceStep) -> CheckResult<Option<&'static str>> {
        match step.action {
            ServiceAction::Read => {
                let value = bytes(step.bytes.as_ref(), "bytes")?;
                let read = self.read(step, variable(step)?)?;
                if step.actor == "program" {
                    self.program_step(step)?;
                }
                Ok((read != value).then_some("outcome"))
            }
            ServiceAction::Write => self.write(step),
            ServiceAction::Ask => match request(step)?.and_then(script) {
                Ok(script) => {
                    self.program = Some(self.target.cnc().as_run(script));
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
                Some(ServiceOutcome::Response { state, text }) => {
                    let stated = response(step)?;
                    Ok(((text.as_bytes().to_vec(), state) != stated).then_some("outcome"))
                }
                Some(other) => differs("an answer", format!("{other:?}")),
            },
            ServiceAction::Serve => match self.next_action(step)? {
                HostAction::Nothing => Ok(Some("not-asked")),
                HostAction::Serve(request, state) => {
                    let text = bytes(step.request.as_ref(), "request")?;
                    let stated = (text, number(step.request_state.as_ref())?);
                    Ok(((request.as_bytes().to_vec(), state) != stated).then_some("outcome"))
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

    fn channel(&self, step: &ServiceStep) -> CheckResult<u8> {
        let place = usize::try_from(step.channel.unwrap_or(1))?;
        let channel = place.checked_sub(1).and_then(|place| self.channels.get(place));
        channel.copied().ok_or_else(|| lacks("channel"))
    }

    /// The value of a variable; for a text, without the NULs that pad it, but with one NUL.
    fn read(&self, step: &ServiceStep, variable: ServiceVariable) -> CheckResult<Vec<u8>> {
        let mut value = read_variable(self.target, self.channel(step)?, variable)?;
        if variable.var_type() == VariableType::STRING {
            let filled = value.iter().rposition(|&byte| byte != 0);
            value.truncate(filled.map_or(1, |last| last + 2));
        }
        Ok(value)
    }

    /// Executes one step of the program.
    fn program_step(&mut self, step: &ServiceStep) -> CheckResult<&Script> {
        let channel = self.channel(step)?;
        let program = self.program.as_mut().ok_or_else(|| lacks("program"))?;
        let now = self.now;
        self.target.cnc().with_service(channel, |interface| program.step(now, interface))?;
        Ok(program)
    }

    /// The outcome of the program's request, after the program has executed two more steps; `None`
    /// if the program still waits.
    fn outcome(&mut self, step: &ServiceStep) -> CheckResult<Option<ServiceOutcome>> {
        self.program_step(step)?;
        let answers = self.program_step(step)?.answers().next();
        Ok(answers.map(|answer| answer.outcome.clone()))
    }

    /// The next action of the service, after the service has read all variables that it needs.
    fn next_action(&mut self, step: &ServiceStep) -> CheckResult<HostAction> {
        let channel = self.channel(step)?;
        let host = self.hosts.get_mut(step.actor.as_str()).ok_or_else(|| lacks("service"))?;
        host.poll();
        loop {
            match host.step() {
                HostStep::Read(variable) => {
                    let value = read_variable(self.target, channel, variable)?;
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

    fn write(&mut self, step: &ServiceStep) -> CheckResult<Option<&'static str>> {
        let (variable, value) = (variable(step)?, bytes(step.bytes.as_ref(), "bytes")?);
        let channel = self.channel(step)?;
        match step.actor.as_str() {
            "other" => {
                let is_taken = write_variable(self.target, channel, variable, &value)?;
                // The error number does not determine the class of the error, so the class is derived
                // from the written bytes.
                let error = ServiceInterface::new().write(variable, &value).err();
                let fault = error.map_or("outcome", |error| fault_class(error.kind()));
                Ok((!is_taken).then_some(fault))
            }
            "program" => {
                let program = self.program.as_ref().ok_or_else(|| lacks("program"))?;
                if program.next_step() != Some(CallStep::Write(variable, &value)) {
                    return Ok(Some("order"));
                }
                self.program_step(step)?;
                let read = self.read(step, variable)?;
                if read != value {
                    return differs(format!("{value:02x?} in {}", step.id), format!("{read:02x?}"));
                }
                Ok(None)
            }
            service => {
                if self.next_action(step)? != HostAction::Write(variable, value.clone()) {
                    return Ok(Some("order"));
                }
                if !write_variable(self.target, channel, variable, &value)? {
                    return differs(format!("{} takes {value:02x?}", variable.name()), "an error");
                }
                let host = self.hosts.get_mut(service).ok_or_else(|| lacks("service"))?;
                host.written();
                Ok(None)
            }
        }
    }

    fn answer(&mut self, step: &ServiceStep) -> CheckResult<Option<&'static str>> {
        let (text, state) = response(step)?;
        let HostAction::Serve(request, _) = self.next_action(step)? else {
            return differs("a request to answer", "none");
        };
        let host = self.hosts.get_mut(step.actor.as_str()).ok_or_else(|| lacks("service"))?;
        if let Err(error) = host.answer(CncStr::from_bytes(&text)?, state) {
            return Ok(Some(fault_class(error.kind())));
        }
        let service = self.given.services.get(&step.actor);
        let does = service.and_then(|service| service.does.as_deref());
        let stated = (String::from_utf8_lossy(&text).into_owned(), state);
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

fn request(step: &ServiceStep) -> CheckResult<Result<ServiceRequest, CallError>> {
    let parameter =
        |value: &Option<String>| value.as_ref().map(|_| number(value.as_ref())).transpose();
    let wait = match &step.wait {
        None => Wait::Loop,
        Some(wait) => Wait::Cycle {
            p1: parameter(&wait.p1)?,
            p2: parameter(&wait.p2)?,
            p3: parameter(&wait.p3)?,
        },
    };
    let state = parameter(&step.request_state)?.unwrap_or(1);
    let asked = bytes(step.request.as_ref(), "request")?;
    let asked = CncStr::from_bytes(&asked).map(CncString::from);
    let uuid = ServiceId::new(step.uuid.as_deref().ok_or_else(|| lacks("UUID"))?);
    Ok(match (uuid, asked) {
        (Ok(uuid), Ok(text)) => Ok(ServiceRequest { uuid, text, state, wait }),
        (Err(error), _) | (_, Err(error)) => Err(error.into()),
    })
}

/// The response and the response state that a step states.
fn response(step: &ServiceStep) -> CheckResult<(Vec<u8>, u32)> {
    Ok((bytes(step.response.as_ref(), "response")?, number(step.response_state.as_ref())?))
}

/// An NC program with one request.
fn script(request: ServiceRequest) -> Result<Script, CallError> {
    let config = ScriptConfig {
        requests: vec![request],
        repeat: Repeat::Times(1),
        pause: Duration::ZERO,
        cycle: Duration::ZERO,
    };
    Script::new(config).map_err(|error| error.error)
}

fn variable(step: &ServiceStep) -> CheckResult<ServiceVariable> {
    let name = step.variable.as_deref().and_then(ServiceVariable::by_name);
    name.ok_or_else(|| lacks("variable"))
}

fn number(value: Option<&String>) -> CheckResult<u32> {
    let number = value.and_then(|value| value.parse().ok());
    number.ok_or_else(|| lacks("number"))
}

/// The class by which sequences name an error.
fn fault_class(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::Truncated => "truncated",
        ErrorKind::Trailing => "trailing",
        ErrorKind::TooLong => "too-long",
        ErrorKind::OutOfRange => "out-of-range",
        ErrorKind::Missing => "missing",
        _ => "another fault",
    }
}
