//! Splits one direction of a connection into frames.

use std::collections::VecDeque;

use ads_cnc::Decode as _;
use ads_cnc::ads::{AmsHeader, AmsPort, AmsTcpHeader, Command, FrameRef, StateFlags};
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};
use ads_cnc::operation::Task;

use super::connection_event::{ConnectionEvent, SegmentDirection, Span};
use super::tcp::CapturePosition;

/// The bytes of one direction of a connection that are not yet split into frames.
#[derive(Debug, Default)]
pub(super) struct Frames {
    bytes: Vec<u8>,
    /// Number of bytes at the beginning of `bytes` that are already split. They are removed
    /// together: a removal moves all bytes after it.
    done: usize,
    /// For each segment in the buffer, the offset of its first byte in the [rest](Self::rest), and
    /// its location in the capture.
    marks: VecDeque<(usize, CapturePosition)>,
    /// Offset of the first byte of the rest, from the beginning of the direction.
    offset: u64,
    /// Whether the start of the next frame is unknown, so that a frame may begin at any offset.
    is_lost: bool,
    skipped: usize,
}

impl Frames {
    /// Memory of the buffer and its marks in bytes; for many small segments, the marks need more
    /// memory than the bytes.
    pub(super) fn memory_size(&self) -> usize {
        let marks = self.marks.capacity().saturating_mul(size_of::<(usize, CapturePosition)>());
        self.bytes.capacity().saturating_add(marks)
    }

    /// Searches for the first frame, because the beginning of the direction was not captured.
    pub(super) const fn begin_anywhere(&mut self) {
        self.is_lost = true;
    }

    /// Appends bytes and emits the events that are now complete.
    pub(super) fn push(
        &mut self,
        bytes: &[u8],
        direction: SegmentDirection,
        mark: CapturePosition,
        out: &mut Vec<ConnectionEvent>,
    ) {
        self.marks.push_back((self.bytes.len(), mark));
        self.bytes.extend_from_slice(bytes);
        while self.step(direction, out) {}
        self.bytes.drain(..std::mem::take(&mut self.done));
    }

    /// The bytes that are not yet split.
    fn rest(&self) -> &[u8] {
        self.bytes.get(self.done..).unwrap_or_default()
    }

    /// Handles `length` bytes that were not captured: the current frame remains incomplete.
    pub(super) fn gap(
        &mut self,
        length: u64,
        direction: SegmentDirection,
        out: &mut Vec<ConnectionEvent>,
    ) {
        let begun = self.bytes.len();
        if begun > 0 {
            if self.is_lost {
                self.skipped = self.skipped.saturating_add(begun);
            } else if let Some(span) = self.span(begun) {
                out.push(ConnectionEvent::Cut(self.bytes.clone(), direction, span));
            }
            self.drop(begun);
        }
        self.offset = self.offset.saturating_add(length);
        self.is_lost = true;
    }

    /// Handles the end of the connection.
    pub(super) fn end(&mut self, out: &mut Vec<ConnectionEvent>) {
        if !self.is_lost && !self.bytes.is_empty() {
            out.push(ConnectionEvent::Unfinished);
        }
        self.skipped = self.skipped.saturating_add(if self.is_lost { self.bytes.len() } else { 0 });
        self.bytes.clear();
        self.marks.clear();
        self.emit_skipped(out);
    }

    /// Removes one frame, or bytes that are not a frame, from the buffer and emits an event. Returns
    /// whether another event may follow.
    fn step(&mut self, direction: SegmentDirection, out: &mut Vec<ConnectionEvent>) -> bool {
        if self.is_lost {
            return self.find(out);
        }
        let router = self.rest().get(..AMS_TCP_HEADER_LEN).and_then(router);
        if let Some(length) = router {
            if self.rest().len() < length {
                return false;
            }
            self.drop(length);
            match out.last_mut() {
                Some(ConnectionEvent::Router(count)) => *count = count.saturating_add(1),
                _ => out.push(ConnectionEvent::Router(1)),
            }
            return true;
        }
        match FrameRef::split(self.rest(), u32::MAX) {
            Ok(None) => false,
            Ok(Some((_, length))) => {
                if let Some(span) = self.span(length) {
                    let frame = self.rest().get(..length).unwrap_or_default().to_vec();
                    self.drop(length);
                    out.push(ConnectionEvent::Frame(frame, direction, span));
                }
                true
            }
            Err(error) => {
                let shown = self.rest().len().min(SHOWN);
                if let Some(span) = self.span(shown) {
                    let bytes = self.rest().get(..shown).unwrap_or_default().to_vec();
                    out.push(ConnectionEvent::Broken(error, bytes, direction, span));
                }
                self.skip(1);
                self.is_lost = true;
                true
            }
        }
    }

    /// Skips to the next offset at which a frame may begin; returns whether there is such an
    /// offset.
    fn find(&mut self, out: &mut Vec<ConnectionEvent>) -> bool {
        let rest = self.rest();
        let last = rest.len().saturating_sub(FrameRef::HEADERS_LEN);
        if rest.len() < FrameRef::HEADERS_LEN {
            return false;
        }
        let offset = (0..=last).find(|&offset| rest.get(offset..).is_some_and(is_plausible));
        match offset {
            Some(offset) => {
                self.skip(offset);
                self.emit_skipped(out);
                self.is_lost = false;
                true
            }
            None => {
                // The remaining bytes may be the beginning of a header.
                self.skip(last.saturating_add(1));
                false
            }
        }
    }

    fn emit_skipped(&mut self, out: &mut Vec<ConnectionEvent>) {
        match std::mem::take(&mut self.skipped) {
            0 => {}
            skipped => out.push(ConnectionEvent::Skipped(skipped)),
        }
    }

    fn skip(&mut self, length: usize) {
        self.skipped = self.skipped.saturating_add(length);
        self.drop(length);
    }

    fn drop(&mut self, length: usize) {
        let length = length.min(self.rest().len());
        self.done = self.done.saturating_add(length);
        self.offset = self.offset.saturating_add(u64::try_from(length).unwrap_or(u64::MAX));
        for (offset, _) in &mut self.marks {
            *offset = offset.saturating_sub(length);
        }
        // Of several marks at offset 0, only the last one applies.
        while matches!(self.marks.get(1), Some((0, _))) {
            self.marks.pop_front();
        }
        // Free the memory of an idle connection.
        if self.rest().is_empty() {
            self.bytes = Vec::new();
            self.done = 0;
            self.marks = VecDeque::new();
        }
    }

    /// The location in the capture of the first `length` bytes.
    fn span(&self, length: usize) -> Option<Span> {
        let inside = self.marks.iter().take_while(|(offset, _)| *offset < length);
        let first = self.marks.front().map(|(_, mark)| *mark)?;
        let end = self.offset.saturating_add(u64::try_from(length).unwrap_or(u64::MAX));
        Some(Span { first, last: inside.last().map_or(first, |(_, mark)| *mark), end })
    }
}

/// Maximum number of bytes of [`ConnectionEvent::Broken`].
const SHOWN: usize = 64;

/// Length of a message between a client and its local router (open port, close port, router
/// notification, local NetId), including its header `tcp`; `None` if `tcp` is not the header of
/// such a message. The rest of such a message is shorter than an AMS header.
fn router(tcp: &[u8]) -> Option<usize> {
    let header = AmsTcpHeader::decode(tcp).ok()?;
    let length = usize::try_from(header.length).ok().filter(|length| *length < AMS_HEADER_LEN)?;
    let is_known = matches!(header.reserved, 1 | 0x1000..=0x1002);
    is_known.then(|| length.saturating_add(AMS_TCP_HEADER_LEN))
}

/// Whether the port belongs to a task of a CNC.
pub(super) fn is_cnc(port: AmsPort) -> bool {
    Task::from_port(port).is_some()
}

/// Whether a frame is a reply, according to its state flags. If these are invalid, a frame to a
/// port of a CNC is not a reply, and any other frame from a port of a CNC is one. Between other
/// ports, the lowest bit of the state flags decides.
pub(super) fn is_reply(header: &AmsHeader) -> bool {
    match header.state_flags {
        StateFlags::REQUEST => false,
        StateFlags::RESPONSE => true,
        _ if is_cnc(header.target.port) => false,
        _ if is_cnc(header.source.port) => true,
        flags => flags.0 & 1 == 1,
    }
}

/// Whether `bytes` may be the beginning of a frame: the two headers are valid, their lengths agree,
/// and the command and the state flags are known.
fn is_plausible(bytes: &[u8]) -> bool {
    let header = bytes.get(AMS_TCP_HEADER_LEN..FrameRef::HEADERS_LEN);
    let Some(Ok(header)) = header.map(AmsHeader::decode) else { return false };
    let known = (Command::READ_DEVICE_INFO..=Command::READ_WRITE).contains(&header.command);
    let flags = matches!(header.state_flags, StateFlags::REQUEST | StateFlags::RESPONSE);
    known && flags && FrameRef::split(bytes, u32::MAX).is_ok()
}
