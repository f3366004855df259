//! Where sockets are opened: nowhere else, by lint.

#![allow(clippy::disallowed_methods, reason = "this is the one place")]

use std::fmt;
use std::io::{self, Read as _, Write as _};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crate::gate::Permit;

/// Listens on an address; the system picks the port if it is 0.
///
/// # Errors
/// Those of the system: the port is taken, the address is none of this machine's.
pub fn listen(addr: SocketAddr) -> io::Result<TcpListener> {
    TcpListener::bind(addr)
}

/// Accepts the connections of a listener in a thread of its own, until dropped.
#[derive(Debug)]
pub struct Acceptor {
    addr: SocketAddr,
    stopped: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Acceptor {
    /// Hands over each connection, and whose it is.
    ///
    /// # Errors
    /// If the listener has no address or the system no thread.
    pub fn start(
        name: &str,
        listener: TcpListener,
        mut take: impl FnMut(TcpStream, SocketAddr) + Send + 'static,
    ) -> io::Result<Self> {
        let (addr, stopped) = (listener.local_addr()?, Arc::new(AtomicBool::new(false)));
        let is_stopped = Arc::clone(&stopped);
        let accept = move || loop {
            let accepted = listener.accept();
            if is_stopped.load(Ordering::SeqCst) {
                return;
            }
            match accepted {
                Ok((stream, peer)) => take(stream, peer),
                Err(error) => {
                    // Out of file descriptors, most likely: wait for connections to end.
                    tracing::warn!("no connection: {error}");
                    thread::sleep(Duration::from_millis(50));
                }
            }
        };
        let thread = thread::Builder::new().name(name.to_owned()).spawn(accept)?;
        Ok(Self { addr, stopped, thread: Some(thread) })
    }

    /// Where it listens.
    pub const fn addr(&self) -> SocketAddr {
        self.addr
    }

    /// Accepts no more connections.
    pub fn stop(&mut self) {
        let Some(thread) = self.thread.take() else { return };
        self.stopped.store(true, Ordering::SeqCst);
        // The thread waits for a connection; if none can be made, the thread is not joined.
        if self.knock().is_ok() || thread.is_finished() {
            let _panicked = thread.join();
        }
    }

    fn knock(&self) -> io::Result<()> {
        // A listener on all addresses is reached on this machine's own.
        let ip = match self.addr.ip() {
            IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
            IpAddr::V6(ip) if ip.is_unspecified() => Ipv6Addr::LOCALHOST.into(),
            ip => ip,
        };
        let addr = SocketAddr::new(ip, self.addr.port());
        TcpStream::connect_timeout(&addr, Duration::from_secs(1)).map(drop)
    }
}

impl Drop for Acceptor {
    fn drop(&mut self) {
        self.stop();
    }
}

/// Connects to a listener on this machine for what may send anything: a client that is wrong on
/// purpose, and the simulated CNC it is wrong to.
///
/// # Errors
/// Those of the system, and [`io::ErrorKind::PermissionDenied`] for any other machine.
pub(crate) fn rehearse(addr: SocketAddr, timeout: Duration) -> io::Result<TcpStream> {
    if !addr.ip().is_loopback() {
        let why = "a client that is wrong on purpose goes to this machine only";
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, why));
    }
    let stream = TcpStream::connect_timeout(&addr, timeout)?;
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(timeout))?;
    Ok(stream)
}

/// The other end of a [`Wire`]: a socket, or a CNC of this process.
pub trait Peer: fmt::Debug + Send {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Gives the bytes that have arrived, waiting for at most `timeout`; 0 bytes at the end.
    ///
    /// # Errors
    /// Those of the system, [`io::ErrorKind::WouldBlock`] or [`io::ErrorKind::TimedOut`] if nothing
    /// arrived.
    fn receive(&mut self, buf: &mut [u8], timeout: Duration) -> io::Result<usize>;
}

impl Peer for TcpStream {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.write_all(bytes)
    }

    fn receive(&mut self, buf: &mut [u8], timeout: Duration) -> io::Result<usize> {
        self.set_read_timeout(Some(timeout))?;
        self.read(buf)
    }
}

/// A connection to a target. Every frame sent on it has passed the gate.
#[derive(Debug)]
pub struct Wire {
    peer: Box<dyn Peer>,
    local: SocketAddr,
}

impl Wire {
    /// Connects to an address within `timeout`. What is sent leaves at once.
    ///
    /// # Errors
    /// Those of the system, and [`io::ErrorKind::TimedOut`].
    pub fn connect(addr: SocketAddr, timeout: Duration) -> io::Result<Self> {
        let stream = TcpStream::connect_timeout(&addr, timeout)?;
        stream.set_nodelay(true)?;
        let local = stream.local_addr()?;
        Ok(Self { peer: Box::new(stream), local })
    }

    /// Connects to a peer of this process, without a socket.
    pub fn over(peer: Box<dyn Peer>) -> Self {
        Self { peer, local: SocketAddr::from((Ipv4Addr::LOCALHOST, 0)) }
    }

    pub const fn local(&self) -> SocketAddr {
        self.local
    }

    /// Sends a frame that may be sent.
    pub fn send(&mut self, permit: Permit<'_>) -> io::Result<()> {
        self.peer.send(permit.frame())
    }

    /// As [`send`](Self::send), this many bytes at a time, one pause after the other.
    pub fn send_in_pieces(
        &mut self,
        permit: Permit<'_>,
        piece: usize,
        pause: Duration,
    ) -> io::Result<()> {
        for piece in permit.frame().chunks(piece.max(1)) {
            self.peer.send(piece)?;
            thread::sleep(pause);
        }
        Ok(())
    }

    /// What has come, waiting at most so long; 0 bytes at the end.
    ///
    /// # Errors
    /// Those of the system, [`io::ErrorKind::WouldBlock`] or [`io::ErrorKind::TimedOut`] if nothing
    /// came.
    pub fn receive(&mut self, buf: &mut [u8], timeout: Duration) -> io::Result<usize> {
        self.peer.receive(buf, timeout)
    }
}
