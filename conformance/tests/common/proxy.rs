//! A proxy between a tool and a CNC. A test decides for each frame of the tool what the proxy does
//! with the frame.

use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::thread;

use ads_cnc::Encode as _;
use ads_cnc::ads::{AdsError, Command, FrameRef, WriteReply};
use ads_cnc_conformance::net;

use super::connect;

/// What the proxy does with a frame of the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FrameHandling {
    /// The CNC receives the frame, and the tool receives the reply.
    Pass,
    /// The CNC does not receive the frame, and the tool receives no reply.
    Lose,
    /// The CNC receives the frame, but the tool does not receive the reply.
    LoseAnswer,
    /// The CNC does not receive the frame, and the connection is closed.
    Close,
    /// The proxy replies with success, but the CNC does not receive the frame.
    Pretend,
    /// The proxy replies with an error, and the CNC does not receive the frame.
    Reject,
}

/// Starts a proxy that handles connections to a CNC one after the other by `pass`. Returns the address
/// of the proxy.
pub(crate) fn proxy_by(
    cnc: SocketAddr,
    mut pass: impl FnMut(&TcpStream, &TcpStream) -> io::Result<()> + Send + 'static,
) -> SocketAddr {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let addr = listener.local_addr().unwrap();
    thread::spawn(move || {
        for client in listener.incoming() {
            // Either side may disconnect at any time.
            let _gone = pass(&client.unwrap(), &connect(cnc));
        }
    });
    addr
}

/// Starts a proxy that forwards connections to a CNC one after the other and calls `handling` for
/// each frame of the tool. Returns the address of the proxy.
pub(crate) fn proxy(
    cnc: SocketAddr,
    mut handling: impl FnMut(&FrameRef<'_>) -> FrameHandling + Send + 'static,
) -> SocketAddr {
    proxy_by(cnc, move |client, cnc| pass(client, cnc, &mut handling))
}

fn pass(
    mut client: &TcpStream,
    mut cnc: &TcpStream,
    handling: &mut impl FnMut(&FrameRef<'_>) -> FrameHandling,
) -> io::Result<()> {
    loop {
        let bytes = frame(client)?;
        let (frame, _) = FrameRef::split(&bytes, u32::MAX).unwrap().unwrap();
        let handling = handling(&frame);
        match handling {
            FrameHandling::Pass | FrameHandling::LoseAnswer => {
                cnc.write_all(&bytes)?;
                let answer = self::frame(cnc)?;
                if handling == FrameHandling::Pass {
                    client.write_all(&answer)?;
                }
            }
            FrameHandling::Lose => {}
            FrameHandling::Close => return Ok(()),
            FrameHandling::Reject | FrameHandling::Pretend => {
                let result = match handling == FrameHandling::Reject {
                    true => AdsError::INVALID_ACCESS,
                    false => AdsError::NO_ERROR,
                };
                let data = WriteReply { result }.encode_to_vec().unwrap();
                let reply = FrameRef::new(frame.header().response(), &data).unwrap();
                client.write_all(&reply.encode_to_vec().unwrap())?;
            }
        }
    }
}

/// Reads a complete frame.
pub(crate) fn frame(mut stream: &TcpStream) -> io::Result<Vec<u8>> {
    let mut frame = vec![0; 6];
    stream.read_exact(&mut frame)?;
    let length = frame[2..].try_into().map(u32::from_le_bytes).unwrap();
    frame.resize(6 + length as usize, 0);
    stream.read_exact(&mut frame[6..])?;
    Ok(frame)
}

/// Whether the frame is a Write.
pub(crate) fn is_write(frame: &FrameRef<'_>) -> bool {
    frame.header().command == Command::WRITE
}
