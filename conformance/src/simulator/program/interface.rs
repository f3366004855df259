//! The buffer between the writes of a client and the decoder of the CNC.

use std::fmt;

use ads_cnc::limits::{STREAM_MAX, STREAM_PACKET_MAX};
use ads_cnc::streaming::{Ack, LineError, check_line_ends};

/// The streaming interface of a CNC: a buffer of at most 4094 bytes that were written but not yet
/// read.
///
/// Manual: `stream-en`, sections 2.2, 3.1, 4.1 and 4.2 (STM-3, STM-5, STM-6, STM-11, STM-12,
/// STM-15).
///
/// ```
/// use ads_cnc::streaming::Ack;
/// use ads_cnc_conformance::simulator::program::StreamingInterface;
///
/// let mut interface = StreamingInterface::new();
/// assert_eq!(interface.write(b"N10 G0 X0\r\n"), Ack::Accepted);
/// assert_eq!(interface.write(b"N20 M30\r\n"), Ack::Accepted);
/// assert_eq!(interface.read()?, b"N10 G0 X0\r\nN20 M30\r\n");
/// assert!(interface.is_empty());
///
/// // The CNC detects a wrong line end when it reads the line: error 21476.
/// assert_eq!(interface.write(b"N30 G0 X0\n"), Ack::Accepted);
/// assert_eq!(
///     interface.read().unwrap_err().to_string(),
///     "line 1, column 10: CR LF expected, LF alone found (STM-5)"
/// );
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone)]
pub struct StreamingInterface {
    bytes: [u8; STREAM_MAX],
    len: usize,
}

impl StreamingInterface {
    /// Creates an empty interface.
    pub const fn new() -> Self {
        Self { bytes: [0; STREAM_MAX], len: 0 }
    }

    /// Appends all bytes of a write to the buffer, or none of them (STM-15).
    ///
    /// Returns [`Ack::Rejected`] for more than 992 bytes and for no bytes (STM-4), and
    /// [`Ack::Busy`], for which a CNC issues warning 11012, if the bytes do not fit now (STM-6).
    /// These causes are assumed. The line ends are not checked here.
    pub fn write(&mut self, data: &[u8]) -> Ack {
        if data.is_empty() || data.len() > STREAM_PACKET_MAX {
            return Ack::Rejected;
        }
        let free = self.bytes.get_mut(self.len..).unwrap_or_default();
        let Some((place, _)) = free.split_at_mut_checked(data.len()) else {
            return Ack::Busy;
        };
        place.copy_from_slice(data);
        self.len = self.len.saturating_add(data.len());
        Ack::Accepted
    }

    /// Removes and returns all buffered bytes in the order of the writes, without the boundaries of
    /// the writes (STM-12).
    ///
    /// # Errors
    /// The first line in the buffer that does not end in CR LF: CNC error 21476 (STM-5). This also
    /// empties the buffer (assumed).
    pub fn read(&mut self) -> Result<&[u8], LineError> {
        let bytes = self.bytes.get(..self.len).unwrap_or_default();
        self.len = 0;
        check_line_ends(bytes).map(|()| bytes)
    }

    /// NC reset: empties the buffer (STM-11).
    pub const fn reset(&mut self) {
        self.len = 0;
    }

    pub const fn len(&self) -> usize {
        self.len
    }

    /// Whether the buffer is empty. After a program end, a client must not write the next program
    /// before the buffer is empty (STM-17).
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }
}

impl Default for StreamingInterface {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Debug for StreamingInterface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "StreamingInterface({} of {STREAM_MAX} bytes)", self.len)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn debug_does_not_show_the_text() {
        let mut interface = StreamingInterface::default();
        assert_eq!(format!("{interface:?}"), "StreamingInterface(0 of 4094 bytes)");
        assert_eq!(interface.write(b"N10\r\n"), Ack::Accepted);
        assert_eq!(format!("{interface:?}"), "StreamingInterface(5 of 4094 bytes)");
    }
}
