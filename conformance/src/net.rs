//! The only module that opens sockets, except for tests: the lint `clippy::disallowed_methods`
//! forbids this in the other modules.

#![allow(clippy::disallowed_methods, reason = "this is the one place")]

use std::fmt;
use std::io::{self, Read as _, Write as _};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::gate::Permit;

/// Listens on an address; for port 0 the system chooses the port.
///
/// # Errors
/// An error of the system, for example if the port is in use or this machine does not have the
/// address.
pub fn listen(addr: SocketAddr) -> io::Result<TcpListener> {
    TcpListener::bind(addr)
}

/// Accepts the connections of a listener in a separate thread, until the `Acceptor` is stopped or
/// dropped.
#[derive(Debug)]
pub struct Acceptor {
    addr: SocketAddr,
    stopped: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Acceptor {
    /// Starts the thread `name`, which calls `take` with each accepted connection and the address
    /// of its peer.
    ///
    /// # Errors
    /// If the listener has no address, or the system cannot start a thread.
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
                    // The most likely cause is that no file descriptor is free. The pause gives
                    // other connections time to end.
                    tracing::warn!("no connection accepted: {error}");
                    thread::sleep(Duration::from_millis(50));
                }
            }
        };
        let thread = thread::Builder::new().name(name.to_owned()).spawn(accept)?;
        Ok(Self { addr, stopped, thread: Some(thread) })
    }

    /// The address on which the listener listens.
    pub const fn addr(&self) -> SocketAddr {
        self.addr
    }

    /// Stops accepting connections, and waits for the thread to end if the thread can be woken.
    pub fn stop(&mut self) {
        let Some(thread) = self.thread.take() else { return };
        self.stopped.store(true, Ordering::SeqCst);
        // The thread blocks in `accept` until a connection arrives, so a connection wakes it. If
        // the connection fails and the thread still runs, the thread is not joined: it might never
        // end.
        if self.wake_listener().is_ok() || thread.is_finished() {
            let _panicked = thread.join();
        }
    }

    fn wake_listener(&self) -> io::Result<()> {
        // A listener on all addresses can be reached at the loopback address.
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

/// Connects to a listener on this machine without a gate. The suite's reference client, which can
/// have a seeded defect, connects in this way to the CNC that the suite plays.
///
/// # Errors
/// An error of the system, or [`io::ErrorKind::PermissionDenied`] if `addr` is not a loopback
/// address.
pub(crate) fn connect_ungated(addr: SocketAddr, timeout: Duration) -> io::Result<TcpStream> {
    if !addr.ip().is_loopback() {
        let why = "a deliberately faulty client connects only to this machine";
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, why));
    }
    let stream = TcpStream::connect_timeout(&addr, timeout)?;
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(timeout))?;
    Ok(stream)
}

/// The other end of a [`Wire`]: a socket, or a simulated CNC in this process.
pub trait Peer: fmt::Debug + Send {
    /// Sends all bytes within `timeout`.
    ///
    /// # Errors
    /// Those of the system; [`io::ErrorKind::WouldBlock`] or [`io::ErrorKind::TimedOut`] if
    /// `timeout` has passed, after which only a part of the bytes may have been sent.
    fn send(&mut self, bytes: &[u8], timeout: Duration) -> io::Result<()>;

    /// Receives bytes that have arrived, waiting for at most `timeout`. Returns the number of
    /// bytes, which is 0 at the end of the connection.
    ///
    /// # Errors
    /// Those of the system; [`io::ErrorKind::WouldBlock`] or [`io::ErrorKind::TimedOut`] if no
    /// bytes arrived.
    fn receive(&mut self, buf: &mut [u8], timeout: Duration) -> io::Result<usize>;
}

/// Opens connections to a simulated CNC of this process without sockets, and controls its clock.
pub trait LocalPeers: fmt::Debug + Send + Sync {
    /// Opens a connection.
    fn connect(&self) -> Box<dyn Peer>;

    /// Advances the clock of the CNC by `time`.
    fn pass(&self, time: Duration);
}

impl Peer for TcpStream {
    fn send(&mut self, mut bytes: &[u8], timeout: Duration) -> io::Result<()> {
        // The timeout of the socket limits only one write, which may accept a single byte.
        let started = Instant::now();
        while !bytes.is_empty() {
            let left = timeout.saturating_sub(started.elapsed());
            if left.is_zero() {
                return Err(io::ErrorKind::TimedOut.into());
            }
            self.set_write_timeout(Some(left))?;
            match self.write(bytes) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(len) => bytes = bytes.get(len..).unwrap_or_default(),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    fn receive(&mut self, buf: &mut [u8], timeout: Duration) -> io::Result<usize> {
        self.set_read_timeout(Some(timeout))?;
        self.read(buf)
    }
}

/// A connection to a target. It only sends frames that the gate has permitted.
#[derive(Debug)]
pub struct Wire {
    peer: Box<dyn Peer>,
    local: SocketAddr,
}

impl Wire {
    /// Connects to an address within `timeout`, without Nagle's algorithm.
    ///
    /// # Errors
    /// An error of the system, or [`io::ErrorKind::TimedOut`].
    pub fn connect(addr: SocketAddr, timeout: Duration) -> io::Result<Self> {
        let stream = TcpStream::connect_timeout(&addr, timeout)?;
        stream.set_nodelay(true)?;
        let local = stream.local_addr()?;
        Ok(Self { peer: Box::new(stream), local })
    }

    /// Connects to a peer in this process, without a socket.
    pub fn over(peer: Box<dyn Peer>) -> Self {
        Self { peer, local: SocketAddr::from((Ipv4Addr::LOCALHOST, 0)) }
    }

    pub const fn local(&self) -> SocketAddr {
        self.local
    }

    /// Sends a frame that the gate has permitted within `timeout`.
    pub fn send(&mut self, permit: Permit<'_>, timeout: Duration) -> io::Result<()> {
        self.peer.send(permit.frame(), timeout)
    }

    /// Like [`send`](Self::send), but in pieces of at most `piece` bytes, with a pause after each
    /// piece. The pauses do not count towards `timeout`.
    pub fn send_in_pieces(
        &mut self,
        permit: Permit<'_>,
        piece: usize,
        pause: Duration,
        mut timeout: Duration,
    ) -> io::Result<()> {
        for piece in permit.frame().chunks(piece.max(1)) {
            let started = Instant::now();
            self.peer.send(piece, timeout)?;
            timeout = timeout.saturating_sub(started.elapsed());
            thread::sleep(pause);
        }
        Ok(())
    }

    /// Receives bytes that have arrived, waiting for at most `timeout`. Returns the number of
    /// bytes, which is 0 at the end of the connection.
    ///
    /// # Errors
    /// Those of the system; [`io::ErrorKind::WouldBlock`] or [`io::ErrorKind::TimedOut`] if no
    /// bytes arrived.
    pub fn receive(&mut self, buf: &mut [u8], timeout: Duration) -> io::Result<usize> {
        self.peer.receive(buf, timeout)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A peer that reads slowly accepts a part of the bytes in every write, but not all of them
    /// within the timeout.
    #[test]
    fn the_timeout_limits_sending_as_a_whole() {
        let listener = listen(SocketAddr::from((Ipv4Addr::LOCALHOST, 0))).unwrap();
        let addr = listener.local_addr().unwrap();
        thread::spawn(move || {
            let (mut stream, _) = listener.accept().unwrap();
            let mut chunk = vec![0; 1 << 18];
            while stream.read(&mut chunk).is_ok_and(|len| len > 0) {
                thread::sleep(Duration::from_millis(20));
            }
        });
        let mut stream = TcpStream::connect(addr).unwrap();
        let sent = Peer::send(&mut stream, &vec![0; 48 << 20], Duration::from_millis(300));
        let kind = sent.unwrap_err().kind();
        assert!(matches!(kind, io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut), "{kind}");
    }
}
