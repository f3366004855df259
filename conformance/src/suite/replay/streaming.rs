//! The steps of data streaming, over the wire.

use std::sync::Arc;
use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::operation::{Call, Request, WriteProgramStream};
use ads_cnc::streaming::{Ack, Checker, FindingKind, Found, NcText, Sender};
use ads_cnc_vectors::{Pieces, StreamAck, StreamAction, StreamError, StreamStep, Streaming};

use super::{CHANNEL, Done, Fault, differs, lacks, within};
use crate::cnc::Cnc;
use crate::cnc::program::{Message, Pace, ProgramConfig, Start, State};
use crate::suite::case::Step;
use crate::suite::probe::{Probe, harness};

/// Goes through the steps up to the first at fault, and leaves the program as it was set up.
pub(super) fn run<'c>(probe: &mut Probe<'_>, given: &'c Streaming) -> Done<Fault<'c>> {
    let cnc = probe.cnc()?;
    let config = within(cnc.with_program(CHANNEL, |program| program.config().clone()))?;
    let held = ProgramConfig { start: Start::ByHand, pace: Pace::Hold, ..config.clone() };
    within(cnc.set_program(CHANNEL, held))?;
    let done = steps(probe, &cnc, given);
    within(cnc.set_program(CHANNEL, config))?;
    done
}

fn steps<'c>(probe: &mut Probe<'_>, cnc: &Arc<Cnc>, given: &'c Streaming) -> Done<Fault<'c>> {
    let text = given.text.as_ref().map(Pieces::bytes);
    let sender = text.as_deref().map(|text| NcText::new(text).map(Sender::new));
    let mut sender = sender.transpose().map_err(harness)?;
    for step in &given.steps {
        let fault = match step.action {
            StreamAction::Start => {
                let started = within(cnc.with_program(CHANNEL, |one| one.start(Duration::ZERO)))?;
                if let Err(error) = started {
                    return differs("the program starts", error);
                }
                None
            }
            StreamAction::Reset => {
                within(cnc.with_program(CHANNEL, |program| program.reset(Duration::ZERO)))?;
                None
            }
            StreamAction::Write => write(probe, &mut sender, step)?,
            StreamAction::Take => take(cnc, step)?,
        };
        if !matches!(fault, Some("outcome" | "overfull")) {
            let held = within(cnc.with_program(CHANNEL, |program| program.held()))?;
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

/// Sends bytes to the stream as they are, whether a client may or not.
pub(in crate::suite) fn send(probe: &mut Probe<'_>, channel: Channel, data: &[u8]) -> Step<Ack> {
    let request = Request::from(WriteProgramStream::new(channel, b"\r\n"));
    let mut buf = [0; 2];
    let whole = request.encode(&mut buf).map_err(harness)?;
    let exchange = probe.call(&Call { data, ..whole })?;
    Ok(exchange.answer().map_or(Ack::Refused, |answer| Ack::of(answer.result)))
}

fn write(
    probe: &mut Probe<'_>,
    sender: &mut Option<Sender<'_>>,
    step: &StreamStep,
) -> Done<Option<&'static str>> {
    let data = step.bytes.as_ref().ok_or_else(|| lacks("bytes"))?.bytes();
    let own = match sender {
        Some(sender) => sender.packet() == Some(&data),
        None => true,
    };
    let ack = send(probe, Channel::new(CHANNEL.into()).map_err(harness)?, &data)?;
    if let Some(sender) = sender.as_mut().filter(|_| own) {
        sender.acknowledge(ack).map_err(harness)?;
    }
    let found = match ack {
        Ack::Accepted => StreamAck::Accepted,
        Ack::Later => StreamAck::Later,
        Ack::Refused => StreamAck::Refused,
    };
    match (found, step.ack.ok_or_else(|| lacks("answer"))?) {
        (StreamAck::Later, StreamAck::Accepted) => return Ok(Some("overfull")),
        (found, stated) if found != stated => {
            return differs(format!("{stated:?} in {}", step.id), format!("{found:?}"));
        }
        _ => {}
    }
    Ok(match (own, ack) {
        (false, _) => Some("order"),
        (true, Ack::Refused) => Some("too-long"),
        _ => None,
    })
}

/// Lets the decoder run for no time at all, in which it reads and runs what is there.
fn take(cnc: &Arc<Cnc>, step: &StreamStep) -> Done<Option<&'static str>> {
    let state = within(cnc.with_program(CHANNEL, |program| program.state()))?;
    if !matches!(state, State::Running | State::Dry) {
        return Ok(Some("not-started"));
    }
    let stated = step.bytes.as_ref().ok_or_else(|| lacks("bytes"))?.bytes();
    let (executed, state) = within(cnc.with_program(CHANNEL, |program| {
        program.forget_executed();
        program.set_pace(Pace::Fast, Duration::ZERO);
        program.set_pace(Pace::Hold, Duration::ZERO);
        (program.executed().kept().to_vec(), program.state())
    }))?;
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
            let is_lost = |found: Found| {
                matches!(found, Found::Finding(found)
                    if matches!(found.kind, FindingKind::BehindEnd { .. }))
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
