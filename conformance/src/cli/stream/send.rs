//! Sends the packets of a program until the CNC has accepted all of them, or an error or a signal
//! ends the sending.

use std::fmt::Write as _;
use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::ads::AdsError;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::{Ack, Sender};

use super::progress::{StreamProgress, byte_count, rate};
use crate::process::interrupt::Interrupt;
use crate::session::{Session, ToolError};
use crate::text::plural;

/// How often a packet that the CNC rejected as busy is sent again, and the time before it is sent
/// again.
pub(super) struct Retry {
    pub(super) after: Duration,
    pub(super) times: u32,
}

/// Why sending has ended.
pub(super) enum SendEnd {
    /// The CNC has accepted all packets.
    Done,
    /// A signal interrupted sending.
    Interrupted,
    /// A packet was rejected as busy more often than `Retry::times`.
    GivenUp(AdsError),
    /// A packet was rejected with another error or not sent, or an internal error occurred.
    Stopped(ToolError),
    /// Without a valid reply, it is unknown whether the CNC accepted a packet.
    Unknown(ToolError),
}

/// The state of sending a program.
pub(super) struct Sending<'a> {
    pub(super) sender: Sender<'a>,
    pub(super) channel: Channel,
    pub(super) retry: Retry,
    /// Total number of times that the CNC rejected a packet as busy.
    pub(super) busy_rejections: u64,
    /// Number of lines in the last packet that was sent or was to be sent.
    pub(super) out: usize,
}

impl Sending<'_> {
    /// Sends until all packets are accepted or an error or signal ends it.
    pub(super) fn run(
        &mut self,
        session: &mut Session,
        interrupt: &Interrupt,
        progress: &mut StreamProgress,
    ) -> SendEnd {
        loop {
            if interrupt.is_requested() {
                return SendEnd::Interrupted;
            }
            let Some(packet) = self.sender.packet() else { return SendEnd::Done };
            self.out = packet.iter().filter(|&&byte| byte == b'\n').count();
            let write = WriteProgramStream::new(self.channel, packet);
            let error = session.call(&write).err();
            // An error without an ADS error number does not mean busy, so the packet is not
            // repeated.
            let ack = match &error {
                None => Ack::Accepted,
                Some(error) => error.ads_error().map_or(Ack::Rejected, Ack::from_result),
            };
            if let Err(error) = acknowledge(&mut self.sender, ack) {
                return SendEnd::Stopped(error);
            }
            match error {
                None => progress.show(self.sender.sent(), None),
                Some(ToolError::Ads { error, .. }) if ack == Ack::Busy => {
                    self.busy_rejections = self.busy_rejections.saturating_add(1);
                    let times = self.sender.busy_count();
                    if times > self.retry.times {
                        return SendEnd::GivenUp(error);
                    }
                    let waits = format!("rejected {} with {error:#x}", plural(times, "time"));
                    progress.show(self.sender.sent(), Some(&waits));
                    if interrupt.sleep(self.retry.after) {
                        return SendEnd::Interrupted;
                    }
                }
                // The CNC may have received and accepted the packet.
                Some(
                    error @ (ToolError::NoReply(_) | ToolError::Reply(_) | ToolError::Frame(_)),
                ) => {
                    return SendEnd::Unknown(error);
                }
                Some(error) => return SendEnd::Stopped(error),
            }
        }
    }

    /// A summary of the lines that were accepted and of the lines that were not.
    pub(super) fn summary(
        &self,
        name: &str,
        lines: usize,
        end: &SendEnd,
        took: Duration,
    ) -> String {
        let sent = self.sender.sent();
        let (packets, bytes, rate) = (sent.packets, byte_count(sent.bytes), rate(sent.bytes, took));
        let channel = self.channel.number();
        let mut summary = match sent.lines {
            0 => format!("{name}: channel {channel} accepted nothing"),
            _ => {
                let packets = plural(packets, "packet");
                let took = took.as_secs_f64();
                format!(
                    "{name}: channel {channel} accepted {} in {packets}, {bytes}, within {took:.1} \
                     s ({rate})",
                    range(1, sent.lines),
                )
            }
        };
        let rejected = match self.busy_rejections {
            0 => String::new(),
            times => format!(", after {}", plural(times, "temporary rejection")),
        };
        summary.push_str(&rejected);
        let mut next = sent.lines.saturating_add(1);
        if let SendEnd::Unknown(_) = end {
            let after = next.saturating_add(self.out);
            let out = range(next, after.saturating_sub(1));
            let _infallible = write!(summary, "\n  unknown whether accepted: {out}");
            next = after;
        }
        if next <= lines {
            let _infallible =
                write!(summary, "\n  not sent or not accepted: {}", range(next, lines));
        }
        summary
    }
}

fn range(first: usize, last: usize) -> String {
    if first == last { format!("line {first}") } else { format!("lines {first} to {last}") }
}

pub(super) fn acknowledge(sender: &mut Sender<'_>, ack: Ack) -> Result<(), ToolError> {
    sender.acknowledge(ack).map_err(|error| ToolError::Internal(error.to_string()))
}
