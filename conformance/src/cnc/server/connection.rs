//! One connection: frames in, in any pieces; answers out, as many at a time as have been asked for.

use std::io::{self, Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use ads_cnc::ads::{AmsNetId, FrameRef};
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};

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
pub(super) fn serve(
    cnc: &Cnc,
    net_id: AmsNetId,
    mut stream: &TcpStream,
    idle: Option<Duration>,
) -> io::Result<()> {
    // Pages nobody writes to take no memory.
    let mut received = vec![0; RECEIVED_MAX];
    let mut held = 0;
    let mut answers = Vec::with_capacity(GATHERED_MAX);
    let mut asked = Instant::now();
    loop {
        let room = received.get_mut(held..).unwrap_or_default();
        let count = match stream.read(room) {
            Ok(0) if held == 0 => return Ok(()),
            Ok(0) => return Err(io::Error::other(format!("closed {held} bytes into a frame"))),
            Ok(count) => count,
            Err(error) => match error.kind() {
                io::ErrorKind::Interrupted => continue,
                io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => return Err(silent(idle)),
                _ => return Err(error),
            },
        };
        held = held.saturating_add(count);
        let mut rest = received.get(..held).unwrap_or_default();
        while let Some((frame, len)) = split(rest)? {
            cnc.respond(net_id, &frame, &mut answers);
            rest = rest.get(len..).unwrap_or_default();
            if answers.len() >= GATHERED_MAX {
                stream.write_all(&answers)?;
                answers.clear();
            }
        }
        if !answers.is_empty() {
            stream.write_all(&answers)?;
            answers.clear();
        }
        let left = rest.len();
        if left < held {
            received.copy_within(held.saturating_sub(left)..held, 0);
            held = left;
            asked = Instant::now();
        } else if idle.is_some_and(|idle| asked.elapsed() > idle) {
            // A byte now and then is no request either.
            return Err(silent(idle));
        }
    }
}

fn split(received: &[u8]) -> io::Result<Option<(FrameRef<'_>, usize)>> {
    let malformed =
        |error| io::Error::new(io::ErrorKind::InvalidData, format!("malformed frame: {error}"));
    FrameRef::split(received, DATA_MAX).map_err(malformed)
}

fn silent(idle: Option<Duration>) -> io::Error {
    let seconds = idle.unwrap_or_default().as_secs_f64();
    io::Error::new(io::ErrorKind::TimedOut, format!("no request for {seconds} s"))
}
