//! One connection: frames in, in any pieces; answers out, as many at a time as have been asked for.

use std::io::{self, Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use ads_cnc::ads::{AmsNetId, FrameRef};

use super::ServerOptions;
use crate::simulator::{DATA_MAX, FRAME_MAX, Responder};

/// Room for the longest frame and what comes with it.
const RECEIVED_MAX: usize = FRAME_MAX + 16 * 1024;

/// Answers that are gathered before they leave; one more may be added to them.
const GATHERED_MAX: usize = 32 * 1024;

/// The most bytes that a connection holds of what it receives and of what it is about to send.
pub(super) const HELD_MAX: usize = RECEIVED_MAX + GATHERED_MAX + FRAME_MAX;

/// The bytes of a connection, without it: what was received and is not answered yet.
///
/// ```
/// use ads_cnc_conformance::simulator::{Cnc, NET_ID, Received};
///
/// // ReadState of the COM task, in two pieces.
/// let state = b"\0\0\x20\0\0\0\x7f\0\0\x01\x01\x01\x29\x02\x7f\0\0\x01\x01\x02\0\x80\
///               \x04\0\x04\0\0\0\0\0\0\0\0\0\x01\0\0\0";
/// let cnc = Cnc::with_default_model()?;
/// let (mut received, mut answers) = (Received::new(), Vec::<u8>::new());
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
pub struct Received {
    bytes: Vec<u8>,
    buffered: usize,
    answers: Vec<u8>,
}

impl Default for Received {
    fn default() -> Self {
        Self::new()
    }
}

impl Received {
    /// Nothing yet.
    pub fn new() -> Self {
        // Pages nobody writes to take no memory.
        Self {
            bytes: vec![0; RECEIVED_MAX],
            buffered: 0,
            answers: Vec::with_capacity(GATHERED_MAX),
        }
    }

    /// Where the next bytes go; never empty.
    pub fn room(&mut self) -> &mut [u8] {
        self.bytes.get_mut(self.buffered..).unwrap_or_default()
    }

    /// Bytes of a frame whose rest is awaited.
    pub const fn buffered(&self) -> usize {
        self.buffered
    }

    /// The most bytes that were ever held, answers included.
    pub fn capacity(&self) -> usize {
        self.bytes.capacity().saturating_add(self.answers.capacity())
    }

    /// Answers all frames that are whole after `count` more bytes, in their order and several at a
    /// time; returns the bytes of these frames.
    ///
    /// # Errors
    /// A frame that does not hold together: what follows it cannot be found. And those of `send`.
    pub fn take(
        &mut self,
        count: usize,
        cnc: &dyn Responder,
        net_id: AmsNetId,
        mut send: impl FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<usize> {
        self.buffered = self.buffered.saturating_add(count).min(self.bytes.len());
        let buffered = self.bytes.get(..self.buffered).unwrap_or_default();
        let mut rest = buffered;
        let broken = loop {
            match split(rest) {
                Ok(Some((frame, len))) => {
                    cnc.respond(net_id, &frame, &mut self.answers);
                    rest = rest.get(len..).unwrap_or_default();
                }
                Ok(None) => break Ok(()),
                Err(error) => break Err(error),
            }
            if self.answers.len() >= GATHERED_MAX {
                send(&self.answers)?;
                self.answers.clear();
            }
        };
        // Whoever asked before it came apart has the answers.
        if !self.answers.is_empty() {
            send(&self.answers)?;
            self.answers.clear();
        }
        broken?;
        let answered = buffered.len().saturating_sub(rest.len());
        if answered > 0 {
            self.bytes.copy_within(answered..self.buffered, 0);
            self.buffered = self.buffered.saturating_sub(answered);
        }
        Ok(answered)
    }
}

/// Answers frames in their order, however they are cut, until the client closes, says nothing for
/// too long, or sends one that does not hold together: what follows it cannot be found.
pub(super) fn serve(
    cnc: &dyn Responder,
    options: &ServerOptions,
    mut stream: &TcpStream,
) -> io::Result<()> {
    let mut received = Received::new();
    let mut limit = Limit::new(options);
    limit.set(stream)?;
    loop {
        let count = match stream.read(received.room()) {
            Ok(0) if received.buffered() == 0 => return Ok(()),
            Ok(0) => {
                let buffered = received.buffered();
                return Err(io::Error::other(format!("closed {buffered} bytes into a frame")));
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

/// Sends answers, in pieces of the responder's size.
fn send(cnc: &dyn Responder, mut stream: &TcpStream, answers: &[u8]) -> io::Result<()> {
    answers.chunks(cnc.piece()).try_for_each(|piece| stream.write_all(piece))
}

fn split(received: &[u8]) -> io::Result<Option<(FrameRef<'_>, usize)>> {
    let malformed =
        |error| io::Error::new(io::ErrorKind::InvalidData, format!("malformed frame: {error}"));
    FrameRef::split(received, DATA_MAX).map_err(malformed)
}

/// How long a connection may go on without a whole frame.
struct Limit<'a> {
    options: &'a ServerOptions,
    awaited: Awaited,
    /// Since when that is awaited; of the next frame nobody has to know.
    since: Instant,
    /// The time that the stream has for a read; not set yet, or no limit.
    set: Option<Option<Duration>>,
}

/// What a connection waits for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Awaited {
    /// Its first frame, or the rest of it.
    First,
    /// Another.
    Next,
    /// The rest of one.
    Rest,
}

impl<'a> Limit<'a> {
    fn new(options: &'a ServerOptions) -> Self {
        Self { options, awaited: Awaited::First, since: Instant::now(), set: None }
    }

    /// Frames were whole; a part of another has come with them, or not.
    fn request_received(&mut self, part: bool) {
        self.awaited = Awaited::Next;
        if part {
            (self.awaited, self.since) = (Awaited::Rest, Instant::now());
        }
    }

    /// There is a part of a frame, and not all of it. A byte now and then is no request either: the
    /// time runs on.
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

    /// Has the next read wait no longer than what is left.
    fn set(&mut self, stream: &TcpStream) -> io::Result<()> {
        let mut left = self.time();
        // One that has just begun has all of it: who asks and asks costs no call of the system.
        if self.awaited != Awaited::Next {
            let passed = self.since.elapsed();
            left = left.map(|time| time.saturating_sub(passed));
            if left == Some(Duration::ZERO) {
                return Err(self.over());
            }
        }
        if self.set != Some(left) {
            // No time at all cannot be set; the shortest can.
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
            Awaited::Rest => "a frame without its end",
        };
        io::Error::new(io::ErrorKind::TimedOut, format!("{what} for {seconds} s"))
    }
}
