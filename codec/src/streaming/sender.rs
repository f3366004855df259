//! The sender of an NC program.

use core::fmt;

use super::NcText;
use super::ends::LF;
use super::packets::{PacketBytes, Packets};
use crate::ads::AdsError;
use crate::limits::STREAM_PACKET_MAX;

/// The result of a write to the program stream.
///
/// Which ADS results are temporary is not documented: see [`from_result`](Self::from_result). The
/// driver in the manual retries after every error. If the reply to a write is lost, the outcome is
/// unknown and a retry may execute lines twice: acknowledge the packet as
/// [`Rejected`](Self::Rejected).
///
/// Manual: `stream-en`, sections 4.2 and 5 (STM-6).
///
/// ```
/// use ads_cnc::ads::AdsError;
/// use ads_cnc::streaming::Ack;
///
/// assert_eq!(Ack::from_result(AdsError(0)), Ack::Accepted);
/// assert_eq!(Ack::from_result(AdsError::INVALID_SIZE), Ack::Rejected);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ack {
    /// The data was accepted.
    Accepted,
    /// The CNC cannot accept the data at present; write the same data again later.
    Busy,
    /// The CNC does not accept the data; do not write the data again.
    Rejected,
}

impl Ack {
    /// The acknowledgement for the ADS result of a write. Which results a CNC returns is not
    /// documented. An error about the target port or machine, the service, index group, index
    /// offset, access or size is assumed to reject the data. Any other error is assumed to mean
    /// that the CNC is busy (STM-6, ADS-7).
    ///
    /// ```
    /// use ads_cnc::ads::AdsError;
    /// use ads_cnc::streaming::Ack;
    ///
    /// assert_eq!(Ack::from_result(AdsError::NO_ERROR), Ack::Accepted);
    /// assert_eq!(Ack::from_result(AdsError::INVALID_SIZE), Ack::Rejected);
    /// assert_eq!(Ack::from_result(AdsError::INVALID_DATA), Ack::Busy);
    /// ```
    pub const fn from_result(result: AdsError) -> Self {
        match result {
            AdsError::NO_ERROR => Self::Accepted,
            AdsError::TARGET_PORT_NOT_FOUND
            | AdsError::TARGET_MACHINE_NOT_FOUND
            | AdsError::SERVICE_NOT_SUPPORTED
            | AdsError::INVALID_GROUP
            | AdsError::INVALID_OFFSET
            | AdsError::INVALID_ACCESS
            | AdsError::INVALID_SIZE => Self::Rejected,
            _ => Self::Busy,
        }
    }
}

/// The state of a [`Sender`].
///
/// ```
/// use ads_cnc::streaming::{Ack, NcText, Sender, SenderState};
///
/// let mut sender = Sender::new(NcText::new(b"M30\n")?);
/// assert_eq!(sender.state(), SenderState::Ready);
/// assert_eq!(sender.packet(), Some(&b"M30\r\n"[..]));
/// assert_eq!(sender.state(), SenderState::InFlight);
/// sender.acknowledge(Ack::Busy)?;
/// assert_eq!(sender.state(), SenderState::Waiting);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SenderState {
    /// The next packet is ready.
    Ready,
    /// A packet was returned and is not acknowledged yet.
    InFlight,
    /// The CNC was busy; the same packet is ready again.
    Waiting,
    /// A packet was rejected; no more packets are returned.
    Stopped,
    /// All packets were accepted, or the text has no lines.
    Done,
}

/// The amount of data that the CNC has accepted.
///
/// ```
/// use ads_cnc::streaming::{Ack, NcText, Progress, Sender};
///
/// let mut sender = Sender::new(NcText::new(b"N10 G0 X0\nN20 M30\n")?);
/// assert_eq!(sender.packet(), Some(&b"N10 G0 X0\r\nN20 M30\r\n"[..]));
/// sender.acknowledge(Ack::Accepted)?;
/// assert_eq!(sender.sent(), Progress { packets: 1, lines: 2, bytes: 20 });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Progress {
    /// Number of packets.
    pub packets: usize,
    /// Number of lines.
    pub lines: usize,
    /// Number of bytes, including CR LF after each line.
    pub bytes: usize,
}

/// The error for an acknowledgement without a packet in flight.
///
/// ```
/// use ads_cnc::streaming::{Ack, NcText, UnexpectedAck, Sender};
///
/// let mut sender = Sender::new(NcText::new(b"M30\n")?);
/// assert_eq!(sender.acknowledge(Ack::Accepted), Err(UnexpectedAck));
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[error("acknowledgement without a packet in flight")]
pub struct UnexpectedAck;

/// Streams a text: returns a packet, accepts its acknowledgement, and continues with the next packet.
///
/// After [`Ack::Busy`], the sender returns the same packet again. The caller should first wait, for
/// example [`RETRY_AFTER`](super::RETRY_AFTER), and can give up by dropping the sender. After
/// [`Ack::Rejected`], the sender returns no more packets. While a packet is in flight,
/// [`packet`](Self::packet) returns it again without counting it twice.
///
/// The sender contains a buffer for one packet, for text whose line ends must be replaced or added:
/// see [`NcText::is_wire`].
///
/// Manual: `stream-en`, sections 2.2, 3.1, 4.2 and 5 (STM-2, STM-4, STM-6).
///
/// ```
/// use ads_cnc::streaming::{Ack, NcText, Sender, SenderState};
///
/// let mut sender = Sender::new(NcText::new(b"N10 G0 X0\nN20 M30")?);
/// assert_eq!(sender.packet(), Some(&b"N10 G0 X0\r\nN20 M30\r\n"[..]));
/// sender.acknowledge(Ack::Busy)?;
/// assert_eq!((sender.busy_count(), sender.left_lines()), (1, 2));
/// assert_eq!(sender.packet(), Some(&b"N10 G0 X0\r\nN20 M30\r\n"[..]));
/// sender.acknowledge(Ack::Accepted)?;
/// assert_eq!(sender.packet(), None);
/// assert_eq!(sender.state(), SenderState::Done);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Sender<'a> {
    text: NcText<'a>,
    /// The packets that the CNC has not accepted yet.
    packets: Packets<'a>,
    /// The packet that is in flight, waits for a retry or was rejected, and the packets after it.
    in_flight: Option<(PacketBytes<'a>, Packets<'a>)>,
    state: SenderState,
    sent: Progress,
    busy_count: u32,
    buffer: [u8; STREAM_PACKET_MAX],
}

impl<'a> Sender<'a> {
    /// Creates a sender at the first line. For a text without lines, its state is [`SenderState::Done`].
    pub const fn new(text: NcText<'a>) -> Self {
        let empty = text.bytes().is_empty();
        Self {
            text,
            packets: text.packets(),
            in_flight: None,
            state: if empty { SenderState::Done } else { SenderState::Ready },
            sent: Progress { packets: 0, lines: 0, bytes: 0 },
            busy_count: 0,
            buffer: [0; STREAM_PACKET_MAX],
        }
    }

    /// The packet to write now; `None` if all packets were accepted or a packet was rejected.
    #[must_use = "the packet has to be written to the CNC"]
    pub fn packet(&mut self) -> Option<&[u8]> {
        if matches!(self.state, SenderState::Stopped | SenderState::Done) {
            return None;
        }
        if self.in_flight.is_none() {
            let mut rest = self.packets.clone();
            let packet = rest.next_in(&mut self.buffer)?;
            self.in_flight = Some((packet, rest));
        }
        self.state = SenderState::InFlight;
        self.packet_in_flight()
    }

    /// Reports the result of writing the packet in flight.
    ///
    /// # Errors
    /// [`UnexpectedAck`] if no packet is in flight; nothing changes.
    pub fn acknowledge(&mut self, ack: Ack) -> Result<(), UnexpectedAck> {
        if self.state != SenderState::InFlight {
            return Err(UnexpectedAck);
        }
        match ack {
            Ack::Accepted => self.accept(),
            Ack::Busy => {
                self.state = SenderState::Waiting;
                self.busy_count = self.busy_count.saturating_add(1);
            }
            Ack::Rejected => self.state = SenderState::Stopped,
        }
        Ok(())
    }

    /// The state of the sender.
    pub const fn state(&self) -> SenderState {
        self.state
    }

    /// The amount of data that the CNC has accepted.
    pub const fn sent(&self) -> Progress {
        self.sent
    }

    /// The number of lines that are not accepted yet, including those of the packet in flight.
    pub const fn left_lines(&self) -> usize {
        self.text.line_count().saturating_sub(self.sent.lines)
    }

    /// The number of bytes that are not accepted yet, including CR LF after each line.
    pub const fn left_bytes(&self) -> usize {
        self.text.wire_len().saturating_sub(self.sent.bytes)
    }

    /// The part of the original text that is not accepted yet.
    pub const fn left(&self) -> &'a [u8] {
        self.packets.rest()
    }

    /// The number of [`Ack::Busy`] results for the current packet.
    pub const fn busy_count(&self) -> u32 {
        self.busy_count
    }

    fn packet_in_flight(&self) -> Option<&[u8]> {
        match self.in_flight.as_ref()?.0 {
            PacketBytes::Text(packet) => Some(packet),
            PacketBytes::Buffer(len) => self.buffer.get(..len),
        }
    }

    fn accept(&mut self) {
        let packet = self.packet_in_flight().unwrap_or_default();
        let lines = packet.iter().filter(|&&byte| byte == LF).count();
        self.sent = Progress {
            packets: self.sent.packets.saturating_add(1),
            lines: self.sent.lines.saturating_add(lines),
            bytes: self.sent.bytes.saturating_add(packet.len()),
        };
        if let Some((_, rest)) = self.in_flight.take() {
            self.packets = rest;
        }
        self.busy_count = 0;
        let done = self.packets.rest().is_empty();
        self.state = if done { SenderState::Done } else { SenderState::Ready };
    }
}

impl fmt::Debug for Sender<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { text, state, sent, busy_count, .. } = self;
        f.debug_struct("Sender")
            .field("text", text)
            .field("state", state)
            .field("sent", sent)
            .field("busy_count", busy_count)
            .finish_non_exhaustive()
    }
}
