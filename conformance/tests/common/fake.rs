//! Fake CNCs whose replies a test determines.

use std::io::{self, Read as _};
use std::net::{SocketAddr, TcpStream};
use std::sync::{Arc, Mutex};
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

/// Starts a fake CNC that replies to writes to the program stream as `answer` decides. Any other
/// request panics in the thread of its connection, which closes it. Returns its address.
pub(crate) fn fake(answer: impl FnMut(u8, &[u8]) -> Answer + Send + 'static) -> SocketAddr {
    let answer = Mutex::new(answer);
    serving(move |frame, out| {
        let request = Call::from_frame(frame).unwrap().unwrap();
        let Ok(Request::WriteProgramStream(op)) = request.dispatch() else { panic!("{request:?}") };
        match (answer.lock().unwrap())(op.channel.number(), op.packet) {
            Answer::Silence => Ok(()),
            Answer::Close => Err(io::ErrorKind::ConnectionAborted.into()),
            Answer::Result(result) => {
                let data = WriteReply { result }.encode_to_vec().unwrap();
                let reply = FrameRef::new(frame.header().response(), &data).unwrap();
                out.write_all(&reply.encode_to_vec().unwrap())
            }
        }
    })
}

/// Starts a server that calls `react` for each frame, and closes the connection after an error.
/// Returns its address.
pub(crate) fn serving(
    react: impl Fn(&FrameRef<'_>, &mut dyn io::Write) -> io::Result<()> + Send + Sync + 'static,
) -> SocketAddr {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let addr = listener.local_addr().unwrap();
    let react = Arc::new(react);
    thread::spawn(move || {
        for stream in listener.incoming() {
            let react = Arc::clone(&react);
            // The tool may disconnect at any time.
            thread::spawn(move || serve(stream.unwrap(), &*react));
        }
    });
    addr
}

fn serve(
    mut stream: TcpStream,
    react: &impl Fn(&FrameRef<'_>, &mut dyn io::Write) -> io::Result<()>,
) -> io::Result<()> {
    stream.set_nodelay(true)?;
    let (mut received, mut chunk) = (Vec::new(), [0; 4096]);
    loop {
        match stream.read(&mut chunk)? {
            0 => return Ok(()),
            len => received.extend_from_slice(&chunk[..len]),
        }
        while let Some((frame, len)) = FrameRef::split(&received, 0x1_0000).unwrap() {
            react(&frame, &mut stream)?;
            received.drain(..len);
        }
    }
}
