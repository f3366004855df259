//! A fake CNC whose replies a test determines, mainly to writes to the program stream.

use std::io::{self, Read as _, Write as _};
use std::net::SocketAddr;
use std::net::TcpStream;
use std::thread;

use ads_cnc::Encode as _;
use ads_cnc::ads::{AdsError, FrameRef, WriteReply};
use ads_cnc::operation::{Call, Request};
use ads_cnc_conformance::net;

/// The reply to a write.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Answer {
    Result(AdsError),
    Silence,
    Close,
}

/// The reaction to a frame.
#[derive(Clone, Debug)]
pub(crate) enum Reaction {
    Send(Vec<u8>),
    Silence,
    Close,
}

/// Starts a fake CNC that replies to writes to the program stream as `answer` decides. It serves one
/// connection after the other; any other request ends the fake CNC with a panic. Returns its
/// address.
pub(crate) fn fake(mut answer: impl FnMut(u8, &[u8]) -> Answer + Send + 'static) -> SocketAddr {
    reacting(move |frame| {
        let request = Call::from_frame(frame).unwrap().unwrap();
        let Ok(Request::WriteProgramStream(op)) = request.dispatch() else { panic!("{request:?}") };
        match answer(op.channel.number(), op.packet) {
            Answer::Silence => Reaction::Silence,
            Answer::Close => Reaction::Close,
            Answer::Result(result) => {
                let data = WriteReply { result }.encode_to_vec().unwrap();
                let reply = FrameRef::new(frame.header().response(), &data).unwrap();
                Reaction::Send(reply.encode_to_vec().unwrap())
            }
        }
    })
}

/// Starts a fake CNC that reacts to each frame as `react` decides. It serves one connection after the
/// other. Returns its address.
pub(crate) fn reacting(
    mut react: impl FnMut(&FrameRef<'_>) -> Reaction + Send + 'static,
) -> SocketAddr {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let addr = listener.local_addr().unwrap();
    thread::spawn(move || {
        for stream in listener.incoming() {
            // The tool may disconnect at any time.
            let _gone = serve(&stream.unwrap(), &mut react);
        }
    });
    addr
}

fn serve(
    mut stream: &TcpStream,
    react: &mut impl FnMut(&FrameRef<'_>) -> Reaction,
) -> io::Result<()> {
    let (mut received, mut chunk) = (Vec::new(), [0; 4096]);
    loop {
        match stream.read(&mut chunk)? {
            0 => return Ok(()),
            len => received.extend_from_slice(&chunk[..len]),
        }
        while let Some((frame, len)) = FrameRef::split(&received, 0x1_0000).unwrap() {
            match react(&frame) {
                Reaction::Silence => {}
                Reaction::Close => return Ok(()),
                Reaction::Send(bytes) => stream.write_all(&bytes)?,
            }
            received.drain(..len);
        }
    }
}
