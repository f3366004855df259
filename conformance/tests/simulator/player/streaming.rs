//! Plays the steps of a sequence of data streaming.

use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::streaming::{Ack, CheckEvent, Checker, DiagnosticKind, NcText, Sender};
use ads_cnc_conformance::simulator::program::{
    Message, Pace, ProgramConfig, ProgramState, Start, StreamingProgram,
};
use ads_cnc_vectors::{
    Pieces, Streaming, StreamingAck, StreamingAction, StreamingFault, StreamingStep,
};

use super::{Fault, bytes, differs, lacks};
use crate::streams::{BUFFER_LEN, send, send_until_taken};
use crate::target::{CheckResult, TestCnc};

/// The number of the channel whose stream the sequence uses.
const CHANNEL: u8 = 1;

/// Plays the steps of a sequence up to the first error. The program of the channel does not start by
/// itself; a step of the sequence starts it.
pub(super) fn play<'c>(target: &TestCnc, given: &'c Streaming) -> CheckResult<Fault<'c>> {
    let config =
        ProgramConfig { start: Start::ByHand, pace: Pace::Hold, ..ProgramConfig::default() };
    target.cnc().set_program(CHANNEL, config)?;
    let with =
        |then: &mut dyn FnMut(&mut StreamingProgram)| target.cnc().with_program(CHANNEL, then);
    let text = given.text.as_ref().map(Pieces::bytes);
    let sender = text.as_deref().map(|text| NcText::new(text).map(Sender::new));
    let mut sender = sender.transpose()?;
    let mut now = Duration::ZERO;
    for step in &given.steps {
        now = step.at.map_or(now, Duration::from_millis);
        let fault = match step.action {
            StreamingAction::Start => {
                target.cnc().with_program(CHANNEL, |program| program.start(now))??;
                None
            }
            StreamingAction::Reset => {
                with(&mut |program| program.reset(now))?;
                None
            }
            StreamingAction::Write => write(target, &mut sender, step)?,
            StreamingAction::Take => {
                target.cnc().with_program(CHANNEL, |one| take(one, step, now))??
            }
        };
        if !matches!(fault, Some("outcome" | "overfull" | "not-started")) {
            let found = buffered(target)?;
            if found != step.buffered {
                let stated = format!("{} bytes buffered after {}", step.buffered, step.id);
                return differs(stated, found);
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

/// Number of bytes in the streaming interface.
fn buffered(target: &TestCnc) -> CheckResult<usize> {
    Ok(target.cnc().with_program(CHANNEL, |program| program.buffered())?)
}

fn write(
    target: &TestCnc,
    sender: &mut Option<Sender<'_>>,
    step: &StreamingStep,
) -> CheckResult<Option<&'static str>> {
    let data = bytes(step.bytes.as_ref(), "bytes")?;
    let stated = step.ack.ok_or_else(|| lacks("answer"))?;
    let own = match sender {
        Some(sender) => sender.packet() == Some(&data),
        None => true,
    };
    let ack = acknowledged(target, &data, stated, step)?;
    if (stated, ack) == (StreamingAck::Accepted, Ack::Busy) {
        return Ok(Some("overfull"));
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

/// Sends a packet and interprets the reply. The sequence states whether a rejection means "busy" or
/// "rejected", because the meanings of error numbers are only assumed.
fn acknowledged(
    target: &TestCnc,
    data: &[u8],
    stated: StreamingAck,
    step: &StreamingStep,
) -> CheckResult<Ack> {
    let channel = Channel::new(CHANNEL.into())?;
    let buffered = buffered(target)?;
    let sent = match stated {
        StreamingAck::Accepted => send_until_taken(target, channel, data)?,
        StreamingAck::Later | StreamingAck::Rejected => send(target, channel, data)?,
    };
    match (stated, sent) {
        (StreamingAck::Accepted, Ok(())) => Ok(Ack::Accepted),
        (StreamingAck::Accepted, Err(_)) if buffered + data.len() > BUFFER_LEN => Ok(Ack::Busy),
        (StreamingAck::Later, Err(_)) => Ok(Ack::Busy),
        (StreamingAck::Rejected, Err(_)) => Ok(Ack::Rejected),
        _ => differs(format!("{stated:?} in {}", step.id), format!("{sent:?}")),
    }
}

/// Lets the decoder read the streaming interface and execute the lines in zero time, and compares the
/// executed lines with the step.
fn take(
    program: &mut StreamingProgram,
    step: &StreamingStep,
    now: Duration,
) -> CheckResult<Option<&'static str>> {
    if !matches!(program.state(), ProgramState::Running | ProgramState::Dry) {
        return Ok(Some("not-started"));
    }
    let stated = bytes(step.bytes.as_ref(), "bytes")?;
    program.forget_executed();
    program.set_pace(Pace::Fast, now);
    program.set_pace(Pace::Hold, now);
    let executed = program.executed().recent();
    let Some(rest) = stated.strip_prefix(executed) else { return Ok(Some("outcome")) };
    match program.state() {
        ProgramState::Aborted(Message { number, line, column, text, .. }) => {
            let found = Some(StreamingFault { number, line, column });
            if step.error != found {
                return differs(format!("{:?} in {}", step.error, step.id), format!("{found:?}"));
            }
            Ok(Some(match number {
                Some(_) => "line-end",
                None if text.starts_with("$GOTO") => "backward-jump",
                None => "loop",
            }))
        }
        ProgramState::Ended(end) => {
            let discarded = step.discarded.as_ref().map_or(Vec::new(), Pieces::bytes);
            let stated_end = (step.error, step.ends.clone(), discarded);
            let found = (None, Some(end.to_string()), rest.to_vec());
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
            if state != ProgramState::Dry || !none {
                let stated = format!("{:?}, {:?} in {}", step.error, step.ends, step.id);
                return differs(stated, format!("{state:?}"));
            }
            Ok((!rest.is_empty()).then_some("outcome"))
        }
    }
}
