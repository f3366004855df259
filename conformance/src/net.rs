//! Where sockets are opened: nowhere else, by lint.

#![allow(clippy::disallowed_methods, reason = "this is the one place")]

use std::io;
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::time::Duration;

/// Listens on an address; the system picks the port if it is 0.
///
/// # Errors
/// Those of the system: the port is taken, the address is none of this machine's.
pub fn listen(addr: SocketAddr) -> io::Result<TcpListener> {
    TcpListener::bind(addr)
}

/// Connects to an address within `timeout`. What is written leaves at once.
///
/// # Errors
/// Those of the system, and [`io::ErrorKind::TimedOut`].
pub fn connect(addr: SocketAddr, timeout: Duration) -> io::Result<TcpStream> {
    let stream = TcpStream::connect_timeout(&addr, timeout)?;
    stream.set_nodelay(true)?;
    Ok(stream)
}
