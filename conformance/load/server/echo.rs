//! The floor: a server that takes as many bytes as a request has for one, whatever they are, and
//! gives as many as its reply has. A thread for each connection, as the simulated CNC has.

use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::thread;

use crate::work::Result;

/// As many requests as are answered at once.
const BATCH: usize = 64;

/// Serves until stdin ends: with the process that has started it.
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
    let mut held = 0;
    loop {
        let count = stream.read(&mut requests[held..])?;
        if count == 0 {
            return Ok(());
        }
        held += count;
        stream.write_all(&replies[..held / request_len * reply_len])?;
        held %= request_len;
    }
}
