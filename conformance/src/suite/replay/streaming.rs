//! The steps of data streaming, over the wire.

use std::sync::Arc;
use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::streaming::{Ack, CheckEvent, Checker, DiagnosticKind, NcText, Sender};
use ads_cnc_vectors::{
    Pieces, Requirement, StreamAck, StreamAction, StreamError, StreamStep, Streaming,
};

use super::{Done, Fault, differs, lacks};
use crate::judge::{Stop, assumed};
use crate::simulator::Cnc;
use crate::simulator::program::{Message, Pace, Program, ProgramConfig, Start, State};
use crate::suite::kit::{HELD_MAX, Probe, StreamWrite, send, send_until_taken};

/// Who plays, and before whom.
struct StreamingPlayer<'s, 'p> {
    probe: &'s mut Probe<'p>,
    cnc: Arc<Cnc>,
    channel: Channel,
    /// What the sequence is about.
    rules: &'s [&'static Requirement],
}

impl StreamingPlayer<'_, '_> {
    fn with<T>(&self, then: impl FnOnce(&mut Program) -> T) -> Done<T> {
        Ok(self.cnc.with_program(self.channel.number(), then)?)
    }

    fn set(&self, config: ProgramConfig) -> Done<()> {
        Ok(self.cnc.set_program(self.channel.number(), config)?)
    }

    /// Judges what the error number of a refusal says.
    fn number(&mut self, rule: &'static str, ack: Ack, sent: &StreamWrite) {
        if self.rules.iter().any(|one| one.id == rule) {
            let expected = || format!("{ack:?} by its number");
            self.probe.check(assumed(rule), sent.assumed() == ack, expected, sent);
        }
    }
}

/// Goes through the steps up to the first at fault, and leaves the program as it was set up.
pub(super) fn run<'c>(
    probe: &mut Probe<'_>,
    given: &'c Streaming,
    rules: &[&'static Requirement],
) -> Done<Fault<'c>> {
    let (cnc, channel) = (probe.cnc()?, probe.channel()?);
    let mut player = StreamingPlayer { probe, cnc, channel, rules };
    let config = player.with(|program| program.config().clone())?;
    if config.name.is_empty() {
        let why = format!("streaming is off in channel {}", channel.number());
        return Err(Stop::NotApplicable(why).into());
    }
    player.set(ProgramConfig { start: Start::ByHand, pace: Pace::Hold, ..config.clone() })?;
    let done = steps(&mut player, given);
    player.set(config)?;
    done
}

fn steps<'c>(player: &mut StreamingPlayer<'_, '_>, given: &'c Streaming) -> Done<Fault<'c>> {
    let text = given.text.as_ref().map(Pieces::bytes);
    let sender = text.as_deref().map(|text| NcText::new(text).map(Sender::new));
    let mut sender = sender.transpose()?;
    for step in &given.steps {
        let fault = match step.action {
            StreamAction::Start => {
                if let Err(error) = player.with(|one| one.start(Duration::ZERO))? {
                    return differs("the program starts", error);
                }
                None
            }
            StreamAction::Reset => {
                player.with(|program| program.reset(Duration::ZERO))?;
                None
            }
            StreamAction::Write => write(player, &mut sender, step)?,
            StreamAction::Take => take(player, step)?,
        };
        if !matches!(fault, Some("outcome" | "overfull" | "not-started")) {
            let held = player.with(|program| program.held())?;
            if held != step.held {
                return differs(format!("{} bytes held after {}", step.held, step.id), held);
            }
        }
        if let Some(fault) = fault {
            return Ok(Some((fault, &step.id)));
        }
    }
    match sender.as_mut().and_then(Sender::packet) {
        Some(packet) => differs("every packet sent", format!("{} bytes left", packet.len())),
        None => Ok(None),
    }
}

fn write(
    player: &mut StreamingPlayer<'_, '_>,
    sender: &mut Option<Sender<'_>>,
    step: &StreamStep,
) -> Done<Option<&'static str>> {
    let data = step.bytes.as_ref().ok_or_else(|| lacks("bytes"))?.bytes();
    let stated = step.ack.ok_or_else(|| lacks("answer"))?;
    let own = match sender {
        Some(sender) => sender.packet() == Some(&data),
        None => true,
    };
    let held = player.with(|program| program.held())?;
    let sent = match stated {
        StreamAck::Accepted => send_until_taken(player.probe, player.channel, &data)?,
        StreamAck::Later | StreamAck::Refused => send(player.probe, player.channel, &data)?,
    };
    // Whether it is taken, everybody sees. Whether a refusal is one for now or for good only what
    // was stated says: that its number tells is assumed.
    let ack = match stated {
        _ if sent.is_taken() => Ack::Accepted,
        StreamAck::Later => Ack::Busy,
        StreamAck::Accepted | StreamAck::Refused => Ack::Rejected,
    };
    match (stated, ack) {
        (StreamAck::Accepted, Ack::Accepted) => {}
        (StreamAck::Accepted, _) if held.saturating_add(data.len()) > HELD_MAX => {
            return Ok(Some("overfull"));
        }
        (StreamAck::Later, Ack::Busy) => player.number("STM-6", Ack::Busy, &sent),
        (StreamAck::Refused, Ack::Rejected) => player.number("STM-2", Ack::Rejected, &sent),
        _ => return differs(format!("{stated:?} in {}", step.id), sent),
    }
    if let Some(sender) = sender.as_mut().filter(|_| own) {
        sender.acknowledge(ack)?;
    }
    Ok(match (own, ack) {
        (false, _) => Some("order"),
        (true, Ack::Rejected) => Some("too-long"),
        _ => None,
    })
}

/// Lets the decoder run for no time at all, in which it reads and runs what is there.
fn take(player: &StreamingPlayer<'_, '_>, step: &StreamStep) -> Done<Option<&'static str>> {
    let state = player.with(|program| program.state())?;
    if !matches!(state, State::Running | State::Dry) {
        return Ok(Some("not-started"));
    }
    let stated = step.bytes.as_ref().ok_or_else(|| lacks("bytes"))?.bytes();
    let (executed, state) = player.with(|program| {
        program.forget_executed();
        program.set_pace(Pace::Fast, Duration::ZERO);
        program.set_pace(Pace::Hold, Duration::ZERO);
        (program.executed().kept().to_vec(), program.state())
    })?;
    let Some(behind) = stated.strip_prefix(&executed[..]) else { return Ok(Some("outcome")) };
    match state {
        State::Aborted(Message { number, line, column, text, .. }) => {
            let found = Some(StreamError { number, line, column });
            if step.error != found {
                return differs(format!("{:?} in {}", step.error, step.id), format!("{found:?}"));
            }
            Ok(Some(match number {
                Some(_) => "line-end",
                None if text.starts_with("$GOTO") => "backward-jump",
                None => "loop",
            }))
        }
        State::Ended(end) => {
            let discarded = step.discarded.as_ref().map_or(Vec::new(), Pieces::bytes);
            let stated_end = (step.error, step.ends.clone(), discarded);
            let found = (None, Some(end.to_string()), behind.to_vec());
            if stated_end != found {
                return differs(format!("{stated_end:?} in {}", step.id), format!("{found:?}"));
            }
            let is_lost = |found: CheckEvent| {
                matches!(found, CheckEvent::Diagnostic(found)
                    if matches!(found.kind, DiagnosticKind::AfterEnd { .. }))
            };
            Ok(Checker::new().check(&stated).any(is_lost).then_some("lost"))
        }
        state => {
            let none = step.error.is_none() && step.ends.is_none();
            if state != State::Dry || !none {
                let stated = format!("{:?}, {:?} in {}", step.error, step.ends, step.id);
                return differs(stated, format!("{state:?}"));
            }
            Ok((!behind.is_empty()).then_some("outcome"))
        }
    }
}
