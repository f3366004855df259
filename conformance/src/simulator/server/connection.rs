//! A connection: receives frames in pieces of any size, gathers the replies to the complete
//! requests up to a limit, and sends these replies together.

use std::io::{self, Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use ads_cnc::ads::AmsNetId;

use super::ServerOptions;
use crate::simulator::frames::GATHERED_MAX;
use crate::simulator::{FRAME_MAX, Frames, Responder};
use crate::text::plural;

/// Size in bytes of the buffer for received bytes: the longest frame and some following bytes.
const RECEIVED_MAX: usize = FRAME_MAX + 16 * 1024;

/// Maximum number of bytes that a connection buffers: received bytes and gathered replies.
pub(super) const BUFFERED_MAX: usize = RECEIVED_MAX + GATHERED_MAX + FRAME_MAX;

/// The buffers of a connection: received bytes that are not yet answered, and gathered replies.
///
/// ```
/// use ads_cnc_conformance::simulator::{Cnc, NET_ID, ReceiveBuffer};
///
/// // ReadState of the COM task, in two pieces.
/// let state = b"\0\0\x20\0\0\0\x7f\0\0\x01\x01\x01\x29\x02\x7f\0\0\x01\x01\x02\0\x80\
///               \x04\0\x04\0\0\0\0\0\0\0\0\0\x01\0\0\0";
/// let cnc = Cnc::with_default_model()?;
/// let (mut received, mut answers) = (ReceiveBuffer::new(), Vec::<u8>::new());
/// for piece in [&state[..7], &state[7..]] {
///     received.room()[..piece.len()].copy_from_slice(piece);
///     received.take(piece.len(), &cnc, NET_ID, |answer| {
///         answers.extend(answer);
///         Ok(())
///     })?;
/// }
/// assert_eq!((answers.len(), received.buffered()), (46, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ReceiveBuffer {
    bytes: Vec<u8>,
    buffered: usize,
    answers: Vec<u8>,
}

impl Default for ReceiveBuffer {
    fn default() -> Self {
        Self::new()
    }
}

impl ReceiveBuffer {
    pub fn new() -> Self {
        // Most systems allocate pages of zeros at the first write to them.
        Self {
            bytes: vec![0; RECEIVED_MAX],
            buffered: 0,
            // The room that the answers may need; a growing buffer would double beyond it.
            answers: Vec::with_capacity(GATHERED_MAX.saturating_add(FRAME_MAX)),
        }
    }

    /// The free part of the buffer for the next bytes; not empty, unless [`take`](Self::take) has
    /// failed.
    pub fn room(&mut self) -> &mut [u8] {
        self.bytes.get_mut(self.buffered..).unwrap_or_default()
    }

    /// Number of received bytes in the buffer; after a successful [`take`](Self::take), these are
    /// the bytes of an incomplete frame.
    pub const fn buffered(&self) -> usize {
        self.buffered
    }

    /// Number of bytes of memory that are reserved for received bytes and replies.
    pub fn capacity(&self) -> usize {
        self.bytes.capacity().saturating_add(self.answers.capacity())
    }

    /// Answers all frames that are complete after `count` more bytes, in order; returns the number
    /// of bytes of these frames.
    ///
    /// # Errors
    /// For an invalid frame, because the beginning of the next frame is unknown, and those of
    /// `send`.
    pub fn take(
        &mut self,
        count: usize,
        cnc: &dyn Responder,
        net_id: AmsNetId,
        mut send: impl FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<usize> {
        self.buffered = self.buffered.saturating_add(count).min(self.bytes.len());
        let mut frames = Frames::new(self.bytes.get(..self.buffered).unwrap_or_default());
        loop {
            cnc.respond_all(net_id, &mut frames, &mut self.answers);
            let is_full = self.answers.len() >= GATHERED_MAX;
            if !self.answers.is_empty() {
                send(&self.answers)?;
                self.answers.clear();
            }
            if !is_full {
                break;
            }
        }
        // The replies to requests before an invalid frame have been sent.
        let answered = frames.end()?;
        if answered > 0 {
            self.bytes.copy_within(answered..self.buffered, 0);
            self.buffered = self.buffered.saturating_sub(answered);
        }
        Ok(answered)
    }
}

/// Answers frames in order until the connection fails, or the client closes it, exceeds a time
/// limit or sends an invalid frame, after which the beginning of the next frame is unknown.
pub(super) fn serve(
    cnc: &dyn Responder,
    options: &ServerOptions,
    mut stream: &TcpStream,
) -> io::Result<()> {
    let mut received = ReceiveBuffer::new();
    let mut limit = Limit::new(options);
    limit.set(stream)?;
    loop {
        let count = match stream.read(received.room()) {
            Ok(0) if received.buffered() == 0 => return Ok(()),
            Ok(0) => {
                let buffered = received.buffered();
                return Err(io::Error::other(format!(
                    "closed {} into a frame",
                    plural(buffered, "byte")
                )));
            }
            Ok(count) => count,
            Err(error) => match error.kind() {
                io::ErrorKind::Interrupted => continue,
                io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => return Err(limit.over()),
                _ => return Err(error),
            },
        };
        let answered =
            received.take(count, cnc, options.net_id, |answers| send(cnc, stream, answers))?;
        if answered > 0 {
            limit.request_received(received.buffered() > 0);
        } else {
            limit.received();
        }
        limit.set(stream)?;
    }
}

/// Sends replies in pieces of the size that the responder requires.
fn send(cnc: &dyn Responder, mut stream: &TcpStream, answers: &[u8]) -> io::Result<()> {
    answers.chunks(cnc.piece()).try_for_each(|piece| stream.write_all(piece))
}

/// The time limit for the next complete frame.
struct Limit<'a> {
    options: &'a ServerOptions,
    awaited: Awaited,
    /// The time at which the limit for the first frame, or for the rest of a frame, began.
    since: Instant,
    /// The timeout that was set on the stream; `None` if none was set yet.
    set: Option<Option<Duration>>,
}

/// The frame that a connection waits for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Awaited {
    /// The first frame, or the rest of it.
    First,
    /// The beginning of another frame.
    Next,
    /// The rest of a frame.
    Rest,
}

impl<'a> Limit<'a> {
    fn new(options: &'a ServerOptions) -> Self {
        Self { options, awaited: Awaited::First, since: Instant::now(), set: None }
    }

    /// Notes that complete frames were received; `part` states whether an incomplete frame follows.
    fn request_received(&mut self, part: bool) {
        self.awaited = Awaited::Next;
        if part {
            (self.awaited, self.since) = (Awaited::Rest, Instant::now());
        }
    }

    /// Notes that bytes of an incomplete frame were received. The limit begins with the first bytes
    /// of a frame (for the first frame, with the connection); further bytes do not extend it.
    fn received(&mut self) {
        if self.awaited == Awaited::Next {
            self.request_received(true);
        }
    }

    fn time(&self) -> Option<Duration> {
        let ServerOptions { idle, frame, .. } = *self.options;
        match self.awaited {
            Awaited::Next => idle,
            Awaited::First | Awaited::Rest => frame.into_iter().chain(idle).min(),
        }
    }

    /// Limits the next read to the remaining time.
    fn set(&mut self, stream: &TcpStream) -> io::Result<()> {
        let mut left = self.time();
        // Between frames, the whole idle time applies to each read. So the timeout stays the same,
        // which avoids a system call.
        if self.awaited != Awaited::Next {
            let passed = self.since.elapsed();
            left = left.map(|time| time.saturating_sub(passed));
            if left == Some(Duration::ZERO) {
                return Err(self.over());
            }
        }
        if self.set != Some(left) {
            // A timeout of zero cannot be set.
            stream.set_read_timeout(left.map(|left| left.max(Duration::from_millis(1))))?;
            self.set = Some(left);
        }
        Ok(())
    }

    fn over(&self) -> io::Error {
        let seconds = self.time().unwrap_or_default().as_secs_f64();
        let what = match self.awaited {
            Awaited::First => "no first request",
            Awaited::Next => "no request",
            Awaited::Rest => "incomplete frame",
        };
        io::Error::new(io::ErrorKind::TimedOut, format!("{what} for {seconds} s"))
    }
}
