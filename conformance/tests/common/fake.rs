//! A CNC that answers writes to the program stream as a test wants.

use std::io::{self, Read as _, Write as _};
use std::net::SocketAddr;
use std::net::TcpStream;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;

use ads_cnc::Encode as _;
use ads_cnc::ads::{AdsError, AmsHeader, FrameRef, WriteReply};
use ads_cnc::operation::{Call, Request};
use ads_cnc_conformance::net;

/// How a write is answered.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Answer {
    Result(AdsError),
    Silence,
    Close,
}

/// Serves connections, one after the other; what else is asked than writes to the stream ends them.
pub(crate) fn fake(mut answer: impl FnMut(u8, &[u8]) -> Answer + Send + 'static) -> SocketAddr {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    let addr = listener.local_addr().unwrap();
    thread::spawn(move || {
        for stream in listener.incoming() {
            // The tool may be gone at any time.
            let _gone = serve(&stream.unwrap(), &mut answer);
        }
    });
    addr
}

fn serve(mut stream: &TcpStream, answer: &mut impl FnMut(u8, &[u8]) -> Answer) -> io::Result<()> {
    let (mut received, mut chunk) = (Vec::new(), [0; 4096]);
    loop {
        match stream.read(&mut chunk)? {
            0 => return Ok(()),
            len => received.extend_from_slice(&chunk[..len]),
        }
        while let Some((frame, len)) = FrameRef::split(&received, 0x1_0000).unwrap() {
            let request = Call::of_frame(&frame).unwrap().unwrap();
            let Ok(Request::WriteProgramStream(op)) = request.dispatch() else {
                panic!("{request:?}")
            };
            match answer(op.channel.number(), op.packet.bytes) {
                Answer::Silence => {}
                Answer::Close => return Ok(()),
                Answer::Result(result) => stream.write_all(&reply(frame.header(), result))?,
            }
            received.drain(..len);
        }
    }
}

fn reply(asked: AmsHeader, result: AdsError) -> Vec<u8> {
    let data = WriteReply { result }.to_vec().unwrap();
    FrameRef::new(asked.response(), &data).unwrap().to_vec().unwrap()
}

/// A file that is removed in the end.
pub(crate) struct TestFile(pub(crate) PathBuf);

impl TestFile {
    pub(crate) fn new(suffix: &str, content: &[u8]) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let (process, count) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(format!("ads-cnc-test-{process}-{count}{suffix}"));
        std::fs::write(&path, content).unwrap();
        Self(path)
    }

    /// A file for --allow-write, good for a CNC on this machine.
    pub(crate) fn allowing(table: &str) -> Self {
        let head = "target = \"127.0.0.1.1.1\"\nexpires = 2999-01-01T00:00:00Z\n";
        Self::new(".toml", format!("{head}{table}").as_bytes())
    }

    pub(crate) fn path(&self) -> &str {
        self.0.to_str().unwrap()
    }
}

impl Drop for TestFile {
    fn drop(&mut self) {
        let _gone = std::fs::remove_file(&self.0);
    }
}
