//! The AMS/TCP server: a thread for each connection, a bounded number of them.

use std::collections::BTreeMap;
use std::io::{self, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use ads_cnc::ads::{AmsNetId, FrameRef};

use super::{Cnc, DATA_MAX, NET_ID};
use crate::net;

/// The most connections at a time; one more is closed at once.
pub const CONNECTIONS_MAX: usize = 64;

/// Bytes taken from a socket at a time. A connection holds at most so many and one frame.
const CHUNK: usize = 8 * 1024;

/// How long a client may leave an answer lying before its connection ends.
const WRITE_TIMEOUT: Duration = Duration::from_secs(10);

/// How long the server waits for its own thread to take notice of its end.
const WAKE_TIMEOUT: Duration = Duration::from_secs(1);

/// A running server; dropping it ends every connection and waits for their threads.
#[derive(Debug)]
pub struct Server {
    addr: SocketAddr,
    shared: Arc<Shared>,
    acceptor: Option<JoinHandle<Vec<JoinHandle<()>>>>,
}

#[derive(Debug)]
struct Shared {
    cnc: Arc<Cnc>,
    stopped: AtomicBool,
    /// The open connections, to end them from outside.
    connections: Mutex<BTreeMap<u64, TcpStream>>,
}

impl Server {
    /// Serves the connections of a listener until dropped.
    ///
    /// # Errors
    /// If the listener has no address or the system no thread.
    pub fn start(listener: TcpListener, cnc: Arc<Cnc>) -> io::Result<Self> {
        let addr = listener.local_addr()?;
        let connections = Mutex::new(BTreeMap::new());
        let shared = Arc::new(Shared { cnc, stopped: AtomicBool::new(false), connections });
        let accepting = Arc::clone(&shared);
        let acceptor = thread::Builder::new()
            .name("cnc-accept".to_owned())
            .spawn(move || accepting.accept(&listener))?;
        Ok(Self { addr, shared, acceptor: Some(acceptor) })
    }

    /// Where it listens.
    pub const fn addr(&self) -> SocketAddr {
        self.addr
    }

    /// The AMS NetId it answers for.
    pub const fn net_id(&self) -> AmsNetId {
        NET_ID
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.shared.stopped.store(true, Ordering::SeqCst);
        // The acceptor waits for a connection: it gets one. Without, it is left behind.
        let woken = net::knock(self.addr, WAKE_TIMEOUT).is_ok();
        let acceptor = self.acceptor.take().filter(|acceptor| woken || acceptor.is_finished());
        let threads = acceptor.and_then(|acceptor| acceptor.join().ok()).unwrap_or_default();
        for stream in self.shared.connections().values() {
            // Closed by the client already, if this fails.
            let _closed = stream.shutdown(Shutdown::Both);
        }
        for thread in threads {
            let _panicked = thread.join();
        }
    }
}

impl Shared {
    fn accept(self: Arc<Self>, listener: &TcpListener) -> Vec<JoinHandle<()>> {
        let mut threads: Vec<JoinHandle<()>> = Vec::new();
        for id in 0_u64.. {
            let accepted = listener.accept();
            if self.stopped.load(Ordering::SeqCst) {
                break;
            }
            threads.retain(|thread| !thread.is_finished());
            match accepted {
                Ok((stream, peer)) => match Arc::clone(&self).connection(id, stream, peer) {
                    Ok(thread) => threads.push(thread),
                    Err(error) => tracing::warn!(%peer, "connection not taken: {error}"),
                },
                Err(error) => {
                    // Out of file descriptors, most likely: wait for connections to end.
                    tracing::warn!("no connection: {error}");
                    thread::sleep(Duration::from_millis(50));
                }
            }
        }
        threads
    }

    fn connection(
        self: Arc<Self>,
        id: u64,
        stream: TcpStream,
        peer: SocketAddr,
    ) -> io::Result<JoinHandle<()>> {
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(WRITE_TIMEOUT))?;
        let mut connections = self.connections();
        if connections.len() >= CONNECTIONS_MAX {
            return Err(io::Error::other("there are as many as there may be"));
        }
        connections.insert(id, stream.try_clone()?);
        drop(connections);
        // Taken off the list when dropped: at the thread's end, or here if there is no thread.
        let open = Open { shared: Arc::clone(&self), id };
        thread::Builder::new().name(format!("cnc-{id}")).spawn(move || {
            tracing::info!(%peer, "connected");
            match serve(&open.shared.cnc, &stream) {
                Ok(()) => tracing::info!(%peer, "closed"),
                Err(error) => tracing::warn!(%peer, "connection ended: {error}"),
            }
        })
    }

    fn connections(&self) -> MutexGuard<'_, BTreeMap<u64, TcpStream>> {
        // The map is whole whatever panicked meanwhile.
        self.connections.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

struct Open {
    shared: Arc<Shared>,
    id: u64,
}

impl Drop for Open {
    fn drop(&mut self) {
        self.shared.connections().remove(&self.id);
    }
}

/// Answers frames in their order, however they are cut, until the client closes or one of them
/// does not hold together: what follows it cannot be found.
fn serve(cnc: &Cnc, mut stream: &TcpStream) -> io::Result<()> {
    let mut received = Vec::new();
    let mut chunk = [0; CHUNK];
    loop {
        let count = match stream.read(&mut chunk) {
            Ok(0) => return Ok(()),
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        received.extend_from_slice(chunk.get(..count).unwrap_or_default());
        let mut rest = received.as_slice();
        loop {
            match FrameRef::split(rest, DATA_MAX) {
                Ok(Some((frame, len))) => {
                    if let Some(answer) = cnc.respond(&frame) {
                        stream.write_all(&answer)?;
                    }
                    rest = rest.get(len..).unwrap_or_default();
                }
                Ok(None) => break,
                Err(error) => {
                    let error = format!("malformed frame: {error}");
                    return Err(io::Error::new(io::ErrorKind::InvalidData, error));
                }
            }
        }
        let left = rest.len();
        received.drain(..received.len().saturating_sub(left));
    }
}

#[cfg(test)]
mod tests;
