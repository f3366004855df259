//! Splitting a text into packets.

use super::ends::{CR, LF, after_end, split_at_end};
use crate::limits::STREAM_PACKET_MAX;

/// The packets of a text: whole lines, each ended by CR LF, as many as fit into 992 bytes.
///
/// All packets together are the lines of the text, each ended by CR LF. Text whose lines all end in
/// CR LF is not copied: its packets are slices of the text. A line that is joined to the next line
/// by `\` is treated like any other line, so the two lines may be in different packets (assumed).
///
/// Manual: `stream-en`, sections 2.2, 3.1, 3.2 and 5 (STM-2, STM-4, STM-7).
///
/// ```
/// use ads_cnc::limits::STREAM_PACKET_MAX;
/// use ads_cnc::streaming::NcText;
///
/// let line = [b'X'; 500];
/// let bytes = [&line[..], b"\n", &line, b"\n", &line[..488]].concat();
/// let mut packets = NcText::new(&bytes)?.packets();
/// let mut buf = [0; STREAM_PACKET_MAX];
/// assert_eq!(packets.next_into(&mut buf).map(<[u8]>::len), Some(502));
/// assert_eq!(packets.next_into(&mut buf).map(<[u8]>::len), Some(502 + 490));
/// assert_eq!(packets.next_into(&mut buf), None);
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Packets<'a> {
    /// Begins at the start of a line. All lines were checked to fit into a packet.
    rest: &'a [u8],
    crlf: bool,
}

/// The location of the bytes of a packet: in the text or in the buffer.
#[derive(Clone, Copy)]
pub(super) enum PacketBytes<'a> {
    Text(&'a [u8]),
    /// The number of bytes at the front of the buffer.
    Buffer(usize),
}

impl<'a> Packets<'a> {
    /// Creates the packets of `rest`; `crlf` is true if all line ends in `rest` are CR LF.
    pub(super) const fn new(rest: &'a [u8], crlf: bool) -> Self {
        Self { rest, crlf }
    }

    /// The part of the text that has not been returned in a packet yet.
    pub const fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next packet, copied to `buf` or borrowed from the text; `None` after the last line.
    pub fn next_into<'b>(&mut self, buf: &'b mut [u8; STREAM_PACKET_MAX]) -> Option<&'b [u8]>
    where
        'a: 'b,
    {
        match self.next_in(buf)? {
            PacketBytes::Text(packet) => Some(packet),
            PacketBytes::Buffer(len) => buf.get(..len),
        }
    }

    /// The next packet, borrowed from the text; `None` after the last line, if any line end of the
    /// text must be replaced, or if CR LF must be added to this packet: then use
    /// [`next_into`](Self::next_into).
    ///
    /// If [`is_wire`](super::NcText::is_wire) returns `true`, all packets can be borrowed. If only the
    /// end of the last line is missing, all packets but the last can be borrowed.
    ///
    /// ```
    /// use ads_cnc::streaming::NcText;
    ///
    /// let bytes = b"N10 G0 X0\r\nN20 M30\r\n";
    /// let mut packets = NcText::new(bytes)?.packets();
    /// assert_eq!(packets.next_borrowed(), Some(&bytes[..]));
    /// assert_eq!(NcText::new(b"N10 G0 X0\n")?.packets().next_borrowed(), None);
    /// # Ok::<(), ads_cnc::streaming::LineError>(())
    /// ```
    pub fn next_borrowed(&mut self) -> Option<&'a [u8]> {
        if !self.crlf {
            return None;
        }
        let reach = match self.rest.get(..STREAM_PACKET_MAX) {
            Some(reach) => reach,
            // The last packet. If its last line lacks a line end, the packet must be copied,
            // because there is room for CR LF.
            None if self.rest.len() < STREAM_PACKET_MAX.saturating_sub(1) => {
                self.rest.ends_with(&[LF]).then_some(self.rest)?
            }
            None => self.rest,
        };
        let len = reach.iter().rposition(|&byte| byte == LF)?.saturating_add(1);
        let (packet, rest) = self.rest.split_at_checked(len)?;
        self.rest = rest;
        Some(packet)
    }

    pub(super) fn next_in(&mut self, buf: &mut [u8; STREAM_PACKET_MAX]) -> Option<PacketBytes<'a>> {
        if let Some(packet) = self.next_borrowed() {
            return Some(PacketBytes::Text(packet));
        }
        let (rest, len) = copy(self.rest, buf);
        self.rest = rest;
        (len > 0).then_some(PacketBytes::Buffer(len))
    }
}

/// Copies as many lines as fit into the packet. Returns the rest of the text and the length of the packet.
fn copy<'a>(text: &'a [u8], packet: &mut [u8; STREAM_PACKET_MAX]) -> (&'a [u8], usize) {
    let (mut rest, mut free_space, mut free) = (text, packet.as_mut_slice(), STREAM_PACKET_MAX);
    while !rest.is_empty() {
        let Some((after, left)) = copy_line(rest, free_space) else {
            break;
        };
        (rest, free, free_space) = (after, left.len(), left);
    }
    (rest, STREAM_PACKET_MAX.saturating_sub(free))
}

/// Copies a line and ends it with CR LF. Returns the text after the line and the remaining room; `None` if
/// the line does not fit.
fn copy_line<'a, 'b>(text: &'a [u8], free_space: &'b mut [u8]) -> Option<(&'a [u8], &'b mut [u8])> {
    let (line, _) = split_at_end(text.get(..=free_space.len()).unwrap_or(text));
    let (out, free_space) = free_space.split_at_mut_checked(line.len())?;
    out.iter_mut().zip(line).for_each(|(out, byte)| *out = *byte);
    let (end, free_space) = free_space.split_first_chunk_mut()?;
    *end = [CR, LF];
    Some((after_end(text.get(line.len()..)?), free_space))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streaming::NcText;

    #[test]
    fn a_line_that_does_not_fit_is_not_copied() {
        for len in 0..40 {
            let text = [&b"X".repeat(len)[..], b"\nY"].concat();
            for free in 0..44 {
                let mut free_space = [0; 44];
                let copied = copy_line(&text, &mut free_space[..free])
                    .map(|(rest, free_space)| (rest, free_space.len()));
                let wanted = (free >= len + 2).then(|| (&b"Y"[..], free - len - 2));
                assert_eq!(copied, wanted, "{len} characters, room for {free}");
            }
        }
    }

    #[test]
    fn packets_without_changes_are_borrowed() {
        let line = [&b"X".repeat(498)[..], b"\r\n"].concat();
        let bytes = [&line[..], &line, &line, b"N1"].concat();
        let mut packets = NcText::new(&bytes).unwrap().packets();
        let mut buf = [0; STREAM_PACKET_MAX];
        assert!(
            matches!(packets.next_in(&mut buf), Some(PacketBytes::Text(packet)) if packet.len() == 500)
        );
        assert!(
            matches!(packets.next_in(&mut buf), Some(PacketBytes::Text(packet)) if packet.len() == 500)
        );
        assert!(matches!(packets.next_in(&mut buf), Some(PacketBytes::Buffer(504))));
        assert!(packets.next_in(&mut buf).is_none());

        // If there is no room for the missing CR LF, only the line before the open line is borrowed.
        for (open, borrowed) in [(490, false), (491, true), (492, true)] {
            let bytes = [&line[..], &b"X".repeat(open)].concat();
            let mut packets = NcText::new(&bytes).unwrap().packets();
            assert_eq!(packets.next_borrowed().map(<[u8]>::len), borrowed.then_some(500), "{open}");
        }
    }
}
