//! The actor of the suite: the simulated CNC of this process, over the wire.

use std::sync::Arc;
use std::time::Duration;

use ads_cnc::VariableType;
use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, WriteByName};
use ads_cnc::service::ServiceVariable;
use ads_cnc::streaming::Ack;
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Requirement, ServiceSequence, StreamAck, StreamStep, Streaming};

use super::outcome::{Fault, StepResult, differs};
use super::service::{ServiceActor, fault_class, script};
use super::streaming::StreamActor;
use super::{service, streaming};
use crate::judge::{Checks as _, Step, Stop, assumed};
use crate::simulator::Cnc;
use crate::simulator::program::service::{CallError, ServiceInterface};
use crate::simulator::program::{
    Pace, ProgramConfig, Script, ServiceRequest, Start, StreamingProgram,
};
use crate::suite::kit::{
    Probe, STREAM_BUFFER_LEN, StreamWrite, send, send_until_taken, service_channels, with_reply,
};

/// Replays a sequence of the Service Interface, and resets the interfaces before and after it.
pub(super) fn service<'c>(
    probe: &mut Probe<'_>,
    given: &'c ServiceSequence,
) -> StepResult<Fault<'c>> {
    let (cnc, channels) = (probe.cnc()?, service_channels(probe)?);
    let mut actor = ServicePlayer { probe, cnc, channels };
    for step in &given.steps {
        actor.channel(step.channel.unwrap_or(1))?;
    }
    actor.reset()?;
    let done = service::play(&mut actor, given);
    actor.reset()?;
    done
}

struct ServicePlayer<'s, 'p> {
    probe: &'s mut Probe<'p>,
    cnc: Arc<Cnc>,
    channels: Vec<Channel>,
}

impl ServicePlayer<'_, '_> {
    fn reset(&self) -> StepResult<()> {
        let mut all = self.channels.iter();
        let reset = |one: &Channel| self.cnc.with_service(one.number(), |service| service.reset());
        Ok(all.try_for_each(reset)?)
    }

    /// The channel of a step: 1 is the first channel with a Service Interface, independent of its number.
    fn channel(&self, place: u32) -> Step<Channel> {
        let before = usize::try_from(place).ok().and_then(|place| place.checked_sub(1));
        let channel = before.and_then(|before| self.channels.get(before)).copied();
        let why = || format!("there are not {place} channels with a Service Interface");
        channel.ok_or_else(|| Stop::not_applicable(why()))
    }
}

impl ServiceActor for ServicePlayer<'_, '_> {
    type Program = Script;

    fn ask(&self, request: ServiceRequest) -> Result<Script, CallError> {
        Ok(self.cnc.as_run(script(request)?))
    }

    fn read(&mut self, channel: u32, variable: ServiceVariable) -> StepResult<Vec<u8>> {
        let channel = self.channel(channel)?;
        let request = ReadByName::new(channel, variable.name())?;
        let exchange = with_reply(self.probe.send(request)?)?;
        let value = exchange.success();
        let mut value = value.unwrap_or_default().to_vec();
        if variable.var_type() == VariableType::STRING {
            let filled = value.iter().rposition(|&byte| byte != 0);
            value.truncate(filled.map_or(1, |last| last + 2));
        }
        Ok(value)
    }

    fn write(
        &mut self,
        channel: u32,
        variable: ServiceVariable,
        value: &[u8],
    ) -> StepResult<Option<&'static str>> {
        let channel = self.channel(channel)?;
        let request = WriteByName::new(channel, variable.name(), value)?;
        let exchange = with_reply(self.probe.send(request)?)?;
        let taken = exchange.success().is_some();
        // The error number does not show the class of the fault, so it is derived from the bytes.
        let error = || ServiceInterface::new().write(variable, value).err();
        let fault = || error().map_or("outcome", |error| fault_class(error.kind()));
        Ok((!taken).then(fault))
    }

    fn with(&mut self, channel: u32, then: impl FnOnce(&mut ServiceInterface)) -> StepResult<()> {
        Ok(self.cnc.with_service(self.channel(channel)?.number(), then)?)
    }
}

/// Replays a sequence of data streaming, and restores the configuration of the program.
pub(super) fn stream<'c>(
    probe: &mut Probe<'_>,
    given: &'c Streaming,
    rules: &[&'static Requirement],
) -> StepResult<Fault<'c>> {
    let (cnc, channel) = (probe.cnc()?, probe.channel()?);
    let mut actor = StreamPlayer { probe, cnc, channel, rules };
    let config = actor.with(|program| program.config().clone())?;
    if config.name.is_empty() {
        let why = format!("streaming is off in channel {}", channel.number());
        return Err(Stop::NotApplicable(why).into());
    }
    actor.set(ProgramConfig { start: Start::ByHand, pace: Pace::Hold, ..config.clone() })?;
    let done = streaming::play(&mut actor, given);
    actor.set(config)?;
    done
}

struct StreamPlayer<'s, 'p> {
    probe: &'s mut Probe<'p>,
    cnc: Arc<Cnc>,
    channel: Channel,
    /// The requirements of the sequence.
    rules: &'s [&'static Requirement],
}

impl StreamPlayer<'_, '_> {
    fn with<T>(&self, then: impl FnOnce(&mut StreamingProgram) -> T) -> StepResult<T> {
        Ok(self.cnc.with_program(self.channel.number(), then)?)
    }

    fn set(&self, config: ProgramConfig) -> StepResult<()> {
        Ok(self.cnc.set_program(self.channel.number(), config)?)
    }

    /// Judges the error number of a rejected write.
    fn number(&mut self, rule: ClauseId, ack: Ack, sent: &StreamWrite) {
        if self.rules.iter().any(|one| one.id == rule.as_str()) {
            let expected = || format!("{ack:?} by its number");
            self.probe.check(assumed(rule), sent.assumed() == ack, expected, sent);
        }
    }
}

/// Time does not advance: the program is on hold.
impl StreamActor for StreamPlayer<'_, '_> {
    fn start(&mut self, _: Duration) -> StepResult<()> {
        match self.with(|one| one.start(Duration::ZERO))? {
            Ok(()) => Ok(()),
            Err(error) => differs("the program starts", error),
        }
    }

    fn reset(&mut self, _: Duration) -> StepResult<()> {
        self.with(|program| program.reset(Duration::ZERO))
    }

    fn held(&mut self) -> StepResult<usize> {
        self.with(|program| program.buffered())
    }

    /// Whether a write is accepted is certain. Whether a rejection means "busy" or "rejected" is
    /// taken from the sequence: that the error number shows it is assumed.
    fn write(
        &mut self,
        data: &[u8],
        stated: StreamAck,
        step: &StreamStep,
        _: Duration,
    ) -> StepResult<Ack> {
        let held = self.held()?;
        let sent = match stated {
            StreamAck::Accepted => send_until_taken(self.probe, self.channel, data)?,
            StreamAck::Later | StreamAck::Refused => send(self.probe, self.channel, data)?,
        };
        match (stated, sent.is_taken()) {
            (StreamAck::Accepted, true) => Ok(Ack::Accepted),
            (StreamAck::Accepted, false) if held + data.len() > STREAM_BUFFER_LEN => Ok(Ack::Busy),
            (StreamAck::Later, false) => {
                self.number(STM_6, Ack::Busy, &sent);
                Ok(Ack::Busy)
            }
            (StreamAck::Refused, false) => {
                self.number(STM_2, Ack::Rejected, &sent);
                Ok(Ack::Rejected)
            }
            _ => differs(format!("{stated:?} in {}", step.id), sent),
        }
    }

    fn take(&mut self, step: &StreamStep, _: Duration) -> StepResult<Option<&'static str>> {
        self.with(|program| streaming::take(program, step, Duration::ZERO))?
    }
}
