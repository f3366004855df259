//! The AMS/TCP server: one thread per connection, with a limited number of connections.

mod connection;
mod options;

use std::collections::BTreeMap;
use std::io;
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use ads_cnc::ads::AmsNetId;

use super::Responder;
use crate::gate::Gate;
use crate::mutex::lock;
use crate::net;

pub use connection::ReceiveBuffer;
pub use options::ServerOptions;

/// Maximum number of simultaneous connections; further connections are closed at once.
pub const CONNECTIONS_MAX: usize = 64;

/// Maximum number of bytes of received requests and unsent replies that a connection buffers, in
/// addition to the data of the reply being built.
pub const CONNECTION_BYTES_MAX: usize = connection::BUFFERED_MAX;

/// Stack size of a connection's thread in bytes.
const STACK: usize = 1024 * 1024;

/// Time after which a connection is closed if no more bytes of the replies can be sent, because the
/// client does not read.
const WRITE_TIMEOUT: Duration = Duration::from_secs(10);

/// A running server; dropping it closes every connection and waits for the threads of the
/// connections.
#[derive(Debug)]
pub struct Server {
    acceptor: net::Acceptor,
    shared: Arc<ServerState>,
}

#[derive(Debug)]
struct ServerState {
    cnc: Arc<dyn Responder>,
    options: ServerOptions,
    /// The open connections, to close them from outside.
    connections: Mutex<BTreeMap<u64, TcpStream>>,
    threads: Mutex<Vec<JoinHandle<()>>>,
}

impl Gate {
    /// Creates a gate that allows every request except WriteControl, notifications, sum commands,
    /// undocumented access to a program stream, and writes at a port other than the documented one.
    /// The gate is only for this server of a simulated CNC in this process, which moves nothing: a
    /// client with this gate connects to no other address.
    pub fn of_server(server: &Server) -> Self {
        Self::of_address(server.addr())
    }
}

impl Server {
    /// Starts a server, which answers the connections of a listener until the server is dropped.
    ///
    /// # Errors
    /// If the listener has no address, or the system cannot start a thread.
    pub fn start(listener: TcpListener, cnc: Arc<dyn Responder>) -> io::Result<Self> {
        Self::with_options(listener, cnc, ServerOptions::default())
    }

    /// Like [`start`](Self::start), with options.
    ///
    /// # Errors
    /// If the listener has no address, or the system cannot start a thread.
    pub fn with_options(
        listener: TcpListener,
        cnc: Arc<dyn Responder>,
        options: ServerOptions,
    ) -> io::Result<Self> {
        let (connections, threads) = Default::default();
        let shared = Arc::new(ServerState { cnc, options, connections, threads });
        let (accepting, mut ids) = (Arc::clone(&shared), 0_u64..);
        let acceptor = net::Acceptor::start("cnc-accept", listener, move |stream, peer| {
            lock(&accepting.threads).retain(|thread| !thread.is_finished());
            let Some(id) = ids.next() else { return };
            match Arc::clone(&accepting).connection(id, stream, peer) {
                Ok(thread) => lock(&accepting.threads).push(thread),
                Err(error) => tracing::warn!(%peer, "connection rejected: {error}"),
            }
        })?;
        Ok(Self { acceptor, shared })
    }

    /// The address that the server listens on.
    pub const fn addr(&self) -> SocketAddr {
        self.acceptor.addr()
    }

    pub fn net_id(&self) -> AmsNetId {
        self.shared.options.net_id
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.acceptor.stop();
        for stream in lock(&self.shared.connections).values() {
            // This may fail if the client has already closed the connection.
            let _closed = stream.shutdown(Shutdown::Both);
        }
        for thread in lock(&self.shared.threads).drain(..) {
            let _panicked = thread.join();
        }
    }
}

impl ServerState {
    fn connection(
        self: Arc<Self>,
        id: u64,
        stream: TcpStream,
        peer: SocketAddr,
    ) -> io::Result<JoinHandle<()>> {
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(WRITE_TIMEOUT))?;
        let options = self.options;
        let mut connections = lock(&self.connections);
        if connections.len() >= CONNECTIONS_MAX {
            return Err(io::Error::other("maximum number of connections reached"));
        }
        connections.insert(id, stream.try_clone()?);
        drop(connections);
        // Dropping this removes the connection: at the end of the thread, or here if no thread
        // starts.
        let open = Open { shared: Arc::clone(&self), id };
        let thread = thread::Builder::new().name(format!("cnc-{id}")).stack_size(STACK);
        thread.spawn(move || {
            tracing::info!(%peer, "connected");
            match connection::serve(&*open.shared.cnc, &options, &stream) {
                Ok(()) => tracing::info!(%peer, "closed"),
                Err(error) => tracing::warn!(%peer, "connection ended: {error}"),
            }
        })
    }
}

struct Open {
    shared: Arc<ServerState>,
    id: u64,
}

impl Drop for Open {
    fn drop(&mut self) {
        lock(&self.shared.connections).remove(&self.id);
    }
}

#[cfg(test)]
mod tests;
