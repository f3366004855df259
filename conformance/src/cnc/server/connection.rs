//! One connection: frames in, in any pieces; answers out, as many at a time as have been asked for.

use std::io::{self, Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use ads_cnc::ads::FrameRef;
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};

use super::ServerOptions;
use crate::cnc::{Cnc, DATA_MAX};

/// Bytes of the longest frame.
const FRAME_MAX: usize = AMS_TCP_HEADER_LEN + AMS_HEADER_LEN + 0x1_0000;

const _: () = assert!(DATA_MAX == 0x1_0000);

/// Room for the longest frame and what comes with it.
const RECEIVED_MAX: usize = FRAME_MAX + 16 * 1024;

/// Answers that are gathered before they leave; one more may be added to them.
const GATHERED_MAX: usize = 32 * 1024;

/// The most bytes that a connection holds of what it receives and of what it is about to send.
pub(super) const HELD_MAX: usize = RECEIVED_MAX + GATHERED_MAX + FRAME_MAX;

/// Answers frames in their order, however they are cut, until the client closes, says nothing for
/// too long, or sends one that does not hold together: what follows it cannot be found.
pub(super) fn serve(cnc: &Cnc, options: &ServerOptions, mut stream: &TcpStream) -> io::Result<()> {
    // Pages nobody writes to take no memory.
    let mut received = vec![0; RECEIVED_MAX];
    let mut held = 0;
    let mut answers = Vec::with_capacity(GATHERED_MAX);
    let mut limit = Limit::new(options);
    limit.set(stream)?;
    loop {
        let room = received.get_mut(held..).unwrap_or_default();
        let count = match stream.read(room) {
            Ok(0) if held == 0 => return Ok(()),
            Ok(0) => return Err(io::Error::other(format!("closed {held} bytes into a frame"))),
            Ok(count) => count,
            Err(error) => match error.kind() {
                io::ErrorKind::Interrupted => continue,
                io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => return Err(limit.over()),
                _ => return Err(error),
            },
        };
        held = held.saturating_add(count);
        let mut rest = received.get(..held).unwrap_or_default();
        while let Some((frame, len)) = split(rest)? {
            cnc.respond(options.net_id, &frame, &mut answers);
            rest = rest.get(len..).unwrap_or_default();
            if answers.len() >= GATHERED_MAX {
                send(cnc, stream, &answers)?;
                answers.clear();
            }
        }
        if !answers.is_empty() {
            send(cnc, stream, &answers)?;
            answers.clear();
        }
        let left = rest.len();
        if left < held {
            received.copy_within(held.saturating_sub(left)..held, 0);
            held = left;
            limit.asked(held > 0);
        } else {
            limit.received();
        }
        limit.set(stream)?;
    }
}

/// Sends answers, all at once but for a CNC that does not.
fn send(cnc: &Cnc, mut stream: &TcpStream, answers: &[u8]) -> io::Result<()> {
    let piece = cnc.piece().unwrap_or(answers.len());
    answers.chunks(piece).try_for_each(|piece| stream.write_all(piece))
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
    /// Since when that is awaited.
    since: Instant,
    /// The time that the stream has for a read; not set yet, or no limit.
    set: Option<Option<Duration>>,
}

/// What a connection stands before.
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
    fn asked(&mut self, part: bool) {
        self.awaited = if part { Awaited::Rest } else { Awaited::Next };
        self.since = Instant::now();
    }

    /// There is a part of a frame, and not all of it. A byte now and then is no request either: the
    /// time runs on.
    fn received(&mut self) {
        if self.awaited == Awaited::Next {
            self.asked(true);
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
