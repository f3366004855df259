//! The baseline of the comparison, an echo server: for every `request_len` received bytes, whatever
//! they contain, it sends the bytes of one reply. Like the simulated CNC, it has a thread for each
//! connection.

use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::thread;

use crate::work::Result;

/// Maximum number of requests that are answered at once.
const BATCH: usize = 64;

/// Serves until stdin ends, which happens when the parent process ends.
pub(crate) fn serve(request_len: usize, reply: &[u8]) -> Result<()> {
    let listener = TcpListener::bind(SocketAddr::from(([127, 0, 0, 1], 0)))?;
    println!("listening on {}", listener.local_addr()?);
    let replies = reply.repeat(BATCH);
    let reply_len = reply.len();
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let replies = replies.clone();
            thread::spawn(move || answer(stream, request_len, &replies, reply_len));
        }
    });
    io::copy(&mut io::stdin(), &mut io::sink())?;
    Ok(())
}

fn answer(
    mut stream: TcpStream,
    request_len: usize,
    replies: &[u8],
    reply_len: usize,
) -> io::Result<()> {
    stream.set_nodelay(true)?;
    let mut requests = vec![0; request_len * BATCH];
    let mut buffered = 0;
    loop {
        let count = stream.read(&mut requests[buffered..])?;
        if count == 0 {
            return Ok(());
        }
        buffered += count;
        stream.write_all(&replies[..buffered / request_len * reply_len])?;
        buffered %= request_len;
    }
}
