//! The steps of data streaming.

use std::time::Duration;

use ads_cnc::streaming::{Ack, CheckEvent, Checker, DiagnosticKind, NcText, Sender};
use ads_cnc_vectors::{Pieces, StreamAck, StreamAction, StreamError, StreamStep, Streaming};

use super::outcome::{Fault, StepResult, differs, lacks};
use crate::simulator::program::{Message, Pace, State, StreamingProgram};

/// A CNC with a streaming program.
pub trait StreamActor {
    /// Starts the streaming program.
    fn start(&mut self, now: Duration) -> StepResult<()>;

    /// Resets the channel.
    fn reset(&mut self, now: Duration) -> StepResult<()>;

    /// Number of bytes in the buffer.
    fn held(&mut self) -> StepResult<usize>;

    /// Writes the packet of a step.
    ///
    /// # Errors
    /// A reply that is neither the stated one nor that of a full buffer.
    fn write(
        &mut self,
        data: &[u8],
        stated: StreamAck,
        step: &StreamStep,
        now: Duration,
    ) -> StepResult<Ack>;

    /// Lets the decoder read the buffer; returns the class of a fault.
    fn take(&mut self, step: &StreamStep, now: Duration) -> StepResult<Option<&'static str>>;
}

/// Plays the steps up to the first fault.
pub fn play<'c>(actor: &mut impl StreamActor, given: &'c Streaming) -> StepResult<Fault<'c>> {
    let text = given.text.as_ref().map(Pieces::bytes);
    let sender = text.as_deref().map(|text| NcText::new(text).map(Sender::new));
    let mut sender = sender.transpose()?;
    let mut now = Duration::ZERO;
    for step in &given.steps {
        now = step.at.map_or(now, Duration::from_millis);
        let fault = match step.action {
            StreamAction::Start => actor.start(now).map(|()| None)?,
            StreamAction::Reset => actor.reset(now).map(|()| None)?,
            StreamAction::Write => write(actor, &mut sender, step, now)?,
            StreamAction::Take => actor.take(step, now)?,
        };
        if !matches!(fault, Some("outcome" | "overfull" | "not-started")) {
            let held = actor.held()?;
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
    actor: &mut impl StreamActor,
    sender: &mut Option<Sender<'_>>,
    step: &StreamStep,
    now: Duration,
) -> StepResult<Option<&'static str>> {
    let data = step.bytes.as_ref().ok_or_else(|| lacks("bytes"))?.bytes();
    let stated = step.ack.ok_or_else(|| lacks("answer"))?;
    let own = match sender {
        Some(sender) => sender.packet() == Some(&data),
        None => true,
    };
    let ack = actor.write(&data, stated, step, now)?;
    match (stated, ack) {
        (StreamAck::Accepted, Ack::Busy) => return Ok(Some("overfull")),
        (StreamAck::Accepted, Ack::Accepted)
        | (StreamAck::Later, Ack::Busy)
        | (StreamAck::Refused, Ack::Rejected) => {}
        _ => return differs(format!("{stated:?} in {}", step.id), format!("{ack:?}")),
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

/// Lets the decoder read the buffer and execute the lines in zero time.
pub fn take(
    program: &mut StreamingProgram,
    step: &StreamStep,
    now: Duration,
) -> StepResult<Option<&'static str>> {
    if !matches!(program.state(), State::Running | State::Dry) {
        return Ok(Some("not-started"));
    }
    let stated = step.bytes.as_ref().ok_or_else(|| lacks("bytes"))?.bytes();
    program.forget_executed();
    program.set_pace(Pace::Fast, now);
    program.set_pace(Pace::Hold, now);
    let executed = program.executed().recent();
    let Some(behind) = stated.strip_prefix(executed) else { return Ok(Some("outcome")) };
    match program.state() {
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
