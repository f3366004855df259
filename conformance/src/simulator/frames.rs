//! Splits received bytes into frames.

use std::io;

use ads_cnc::ads::FrameRef;

use super::DATA_MAX;

/// When gathered replies reach this size in bytes, they are sent before further requests are
/// answered. The last of them may exceed the size.
pub(super) const GATHERED_MAX: usize = 32 * 1024;

/// The complete frames at the beginning of received bytes.
#[derive(Debug)]
pub struct Frames<'a> {
    received: &'a [u8],
    rest: &'a [u8],
    error: Option<io::Error>,
}

impl<'a> Frames<'a> {
    pub(super) const fn new(received: &'a [u8]) -> Self {
        Self { received, rest: received, error: None }
    }

    /// The next frame; `None` after the last complete frame, at an invalid frame, and if the
    /// gathered replies (`answers`) must be sent first.
    pub(crate) fn next(&mut self, answers: &[u8]) -> Option<FrameRef<'a>> {
        if answers.len() >= GATHERED_MAX {
            return None;
        }
        match FrameRef::split(self.rest, DATA_MAX) {
            Ok(split) => {
                let (frame, len) = split?;
                self.rest = self.rest.get(len..).unwrap_or_default();
                Some(frame)
            }
            Err(error) => {
                let words = format!("malformed frame: {error}");
                self.error = Some(io::Error::new(io::ErrorKind::InvalidData, words));
                None
            }
        }
    }

    /// Number of bytes of the frames that [`next`](Self::next) has returned.
    ///
    /// # Errors
    /// For an invalid frame, because the beginning of the next frame is unknown.
    pub(super) fn end(self) -> io::Result<usize> {
        match self.error {
            Some(error) => Err(error),
            None => Ok(self.received.len().saturating_sub(self.rest.len())),
        }
    }
}
