//! The steps at the Service Interface: program within, services and anybody else over the wire.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, WriteByName};
use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
use ads_cnc::{CncStr, CncString, ErrorKind, VariableType};
use ads_cnc_vectors::{Pieces, ServiceAction, ServiceSequence, ServiceStep};

use super::{Done, Fault, differs, lacks};
use crate::judge::{Step, Stop};
use crate::simulator::Cnc;
use crate::simulator::program::service::{CallError, CallStep, ServiceInterface};
use crate::simulator::program::{
    Outcome, Repeat, Request, Script, ScriptConfig, ScriptState, Wait,
};
use crate::suite::kit::{Probe, heard, service_channels};

/// Goes through the steps up to the first at fault, and leaves the interfaces as at the start.
pub(super) fn run<'c>(probe: &mut Probe<'_>, given: &'c ServiceSequence) -> Done<Fault<'c>> {
    let cnc = probe.cnc()?;
    let channels = service_channels(probe)?;
    for step in &given.steps {
        channel_of(&channels, step)?;
    }
    let reset = || {
        let mut all = channels.iter();
        all.try_for_each(|one| cnc.with_service(one.number(), |service| service.reset()))
    };
    reset()?;
    let done = steps(probe, &cnc, given, &channels);
    reset()?;
    done
}

/// The channel of a step: the first is the first that has the interface, whatever its number.
fn channel_of(channels: &[Channel], step: &ServiceStep) -> Step<Channel> {
    let place = step.channel.unwrap_or(1);
    let before = usize::try_from(place).ok().and_then(|place| place.checked_sub(1));
    let channel = before.and_then(|before| channels.get(before)).copied();
    let why = || format!("there are not {place} channels with a Service Interface");
    channel.ok_or_else(|| Stop::not_applicable(why()))
}

fn steps<'c>(
    probe: &mut Probe<'_>,
    cnc: &Arc<Cnc>,
    given: &'c ServiceSequence,
    channels: &[Channel],
) -> Done<Fault<'c>> {
    let mut ids: BTreeMap<&str, [ServiceId; 1]> = BTreeMap::new();
    for (name, service) in &given.services {
        ids.insert(name, [ServiceId::new(&service.uuid)?]);
    }
    let hosts = ids.iter().map(|(name, ids)| (*name, Host::new(ids))).collect();
    let (script, now) = (None, Duration::ZERO);
    let mut player = ServicePlayer { probe, cnc, given, channels, hosts, script, now };
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

struct ServicePlayer<'s, 'p, 'c> {
    probe: &'s mut Probe<'p>,
    cnc: &'s Arc<Cnc>,
    given: &'c ServiceSequence,
    channels: &'s [Channel],
    hosts: BTreeMap<&'c str, Host<'s>>,
    script: Option<Script>,
    now: Duration,
}

impl ServicePlayer<'_, '_, '_> {
    fn step(&mut self, step: &ServiceStep) -> Done<Option<&'static str>> {
        match step.action {
            ServiceAction::Read => {
                let value = bytes(step)?;
                let read = self.read(step, variable(step)?)?;
                if step.actor == "program" {
                    self.script_step(step)?;
                }
                Ok((read != value).then_some("outcome"))
            }
            ServiceAction::Write => self.write(step),
            ServiceAction::Ask => match ask(step)? {
                Ok(script) => {
                    self.script = Some(self.cnc.as_run(script));
                    Ok(None)
                }
                Err(error) => Ok(Some(class(error.kind()))),
            },
            ServiceAction::Wait => {
                let state = self.script_step(step)?;
                let script = self.script.as_ref().ok_or_else(|| lacks("program"))?;
                let waits = matches!(script.next_step(), Some(CallStep::Wait { .. }));
                match (state, waits) {
                    (ScriptState::Waiting(0), true) => Ok(None),
                    (state, _) => differs("the program waits", format!("{state:?}")),
                }
            }
            ServiceAction::Timeout => match self.outcome(step)? {
                None => Ok(Some("too-early")),
                Some(Outcome::TimedOut) => Ok(None),
                Some(other) => differs("no answer in time", format!("{other:?}")),
            },
            ServiceAction::Done => match self.outcome(step)? {
                None => Ok(Some("too-early")),
                Some(Outcome::Response { state, text: response }) => {
                    let stated = (text(&step.response)?, number(&step.response_state)?);
                    let same = (response.as_bytes().to_vec(), state) == stated;
                    Ok((!same).then_some("outcome"))
                }
                Some(other) => differs("an answer", format!("{other:?}")),
            },
            ServiceAction::Serve => match self.wants(step)? {
                Wants::Nothing => Ok(Some("not-asked")),
                Wants::Serve(request, state) => {
                    let stated = (text(&step.request)?, number(&step.request_state)?);
                    let same = (request.as_bytes().to_vec(), state) == stated;
                    Ok((!same).then_some("outcome"))
                }
                other => differs("a request", format!("{other:?}")),
            },
            ServiceAction::Answer => self.answer(step),
            ServiceAction::Idle => match self.wants(step)? {
                Wants::Nothing => Ok(None),
                other => differs("nothing to do", format!("{other:?}")),
            },
        }
    }

    /// The value over the wire: of a text what the interface holds, without what fills it up.
    fn read(&mut self, step: &ServiceStep, variable: ServiceVariable) -> Step<Vec<u8>> {
        let channel = channel_of(self.channels, step)?;
        let request = ReadByName::new(channel, variable.name())?;
        let exchange = heard(self.probe.send(request)?)?;
        let value = exchange.success();
        let mut value = value.unwrap_or_default().to_vec();
        if variable.var_type() == VariableType::STRING {
            let filled = value.iter().rposition(|&byte| byte != 0);
            value.truncate(filled.map_or(1, |last| last.saturating_add(2)));
        }
        Ok(value)
    }

    /// Whether the value was taken over the wire.
    fn put(&mut self, step: &ServiceStep, variable: ServiceVariable, value: &[u8]) -> Step<bool> {
        let channel = channel_of(self.channels, step)?;
        let request = WriteByName::new(channel, variable.name(), value)?;
        let exchange = heard(self.probe.send(request)?)?;
        Ok(exchange.success().is_some())
    }

    /// The program does one step.
    fn script_step(&mut self, step: &ServiceStep) -> Done<ScriptState> {
        let script = self.script.as_mut().ok_or_else(|| lacks("program"))?;
        let (now, channel) = (self.now, channel_of(self.channels, step)?);
        Ok(self.cnc.with_service(channel.number(), |service| {
            script.step(now, service);
            script.state()
        })?)
    }

    /// What came of the request, once the program has looked.
    fn outcome(&mut self, step: &ServiceStep) -> Done<Option<Outcome>> {
        for _ in 0..2 {
            self.script_step(step)?;
        }
        let script = self.script.as_ref().ok_or_else(|| lacks("program"))?;
        Ok(script.answers().next().map(|answer| answer.outcome.clone()))
    }

    /// What the service wants next, once it has read what it wants to read.
    fn wants(&mut self, step: &ServiceStep) -> Done<Wants> {
        let actor = step.actor.as_str();
        let host = |hosts: &mut BTreeMap<&str, Host<'_>>| -> Done<HostWants> {
            let host = hosts.get_mut(actor).ok_or_else(|| lacks("service"))?;
            Ok(match host.step() {
                HostStep::Read(variable) => HostWants::Read(variable),
                HostStep::Write(variable, value) => {
                    HostWants::Other(Wants::Write(variable, value.to_vec()))
                }
                HostStep::Serve { request, request_state, .. } => {
                    HostWants::Other(Wants::Serve(request.into(), request_state))
                }
                _ => HostWants::Other(Wants::Nothing),
            })
        };
        if let Some(host) = self.hosts.get_mut(actor) {
            host.poll();
        }
        loop {
            match host(&mut self.hosts)? {
                HostWants::Other(wants) => return Ok(wants),
                HostWants::Read(variable) => {
                    let value = self.read(step, variable)?;
                    let host = self.hosts.get_mut(actor).ok_or_else(|| lacks("service"))?;
                    if let Err(error) = host.read(&value) {
                        return differs(format!("a value of {}", variable.name()), error);
                    }
                }
            }
        }
    }

    fn write(&mut self, step: &ServiceStep) -> Done<Option<&'static str>> {
        let (variable, value) = (variable(step)?, bytes(step)?);
        match step.actor.as_str() {
            "other" => {
                let taken = self.put(step, variable, &value)?;
                // Which of the faults it is, an error number does not tell: the bytes do.
                let error = || ServiceInterface::new().write(variable, &value).err();
                let odd = || error().map_or("outcome", |error| class(error.kind()));
                Ok((!taken).then(odd))
            }
            "program" => {
                let script = self.script.as_ref().ok_or_else(|| lacks("program"))?;
                if script.next_step() != Some(CallStep::Write(variable, &value)) {
                    return Ok(Some("order"));
                }
                self.script_step(step)?;
                let read = self.read(step, variable)?;
                if read == value {
                    return Ok(None);
                }
                differs(format!("{value:02x?} in {}", step.id), format!("{read:02x?}"))
            }
            service => {
                if self.wants(step)? != Wants::Write(variable, value.clone()) {
                    return Ok(Some("order"));
                }
                if !self.put(step, variable, &value)? {
                    return differs(format!("{} takes {value:02x?}", variable.name()), "an error");
                }
                let host = self.hosts.get_mut(service).ok_or_else(|| lacks("service"))?;
                host.written();
                Ok(None)
            }
        }
    }

    fn answer(&mut self, step: &ServiceStep) -> Done<Option<&'static str>> {
        let (response, state) = (text(&step.response)?, number(&step.response_state)?);
        let Wants::Serve(request, _) = self.wants(step)? else {
            return differs("a request to answer", "none");
        };
        let host = self.hosts.get_mut(step.actor.as_str()).ok_or_else(|| lacks("service"))?;
        let answer = CncStr::from_bytes(&response)?;
        if let Err(error) = host.answer(answer, state) {
            return Ok(Some(class(error.kind())));
        }
        let service = self.given.services.get(&step.actor);
        let does = service.and_then(|service| service.does.as_deref());
        let stated = (String::from_utf8_lossy(&response).into_owned(), state);
        let wrong = does == Some("square-root") && square_root(&request.to_string()) != stated;
        Ok(wrong.then_some("outcome"))
    }
}

enum HostWants {
    Read(ServiceVariable),
    Other(Wants),
}

/// What a service does next, apart from reading.
#[derive(Debug, PartialEq)]
enum Wants {
    Nothing,
    Write(ServiceVariable, Vec<u8>),
    Serve(CncString, u32),
}

fn ask(step: &ServiceStep) -> Done<Result<Script, CallError>> {
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
    let request = match (uuid, asked) {
        (Ok(uuid), Ok(text)) => Request { uuid, text, state, wait },
        (Err(error), _) | (_, Err(error)) => return Ok(Err(error.into())),
    };
    let config = ScriptConfig {
        requests: vec![request],
        repeat: Repeat::Times(1),
        pause: Duration::ZERO,
        cycle: Duration::ZERO,
    };
    Ok(Script::new(config).map_err(|error| error.error))
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

fn variable(step: &ServiceStep) -> Done<ServiceVariable> {
    let name = step.variable.as_deref().and_then(ServiceVariable::by_name);
    name.ok_or_else(|| lacks("variable"))
}

fn bytes(step: &ServiceStep) -> Done<Vec<u8>> {
    Ok(step.bytes.as_ref().ok_or_else(|| lacks("bytes"))?.bytes())
}

fn text(pieces: &Option<Pieces>) -> Done<Vec<u8>> {
    Ok(pieces.as_ref().ok_or_else(|| lacks("text"))?.bytes())
}

fn number(value: &Option<String>) -> Done<u32> {
    let number = value.as_deref().and_then(|value| value.parse().ok());
    number.ok_or_else(|| lacks("number"))
}

fn class(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::Truncated => "truncated",
        ErrorKind::Trailing => "trailing",
        ErrorKind::TooLong => "too-long",
        ErrorKind::OutOfRange => "out-of-range",
        ErrorKind::Missing => "missing",
        _ => "another fault",
    }
}
