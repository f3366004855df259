//! What a client tells of its connections.

use std::fmt;
use std::io;
use std::net::SocketAddr;

/// A record of all bytes that a client sends and receives.
pub trait Tap: fmt::Debug + Send {
    fn opened(&mut self, local: SocketAddr, remote: SocketAddr);

    /// These bytes were sent.
    fn sent(&mut self, bytes: &[u8]);

    /// These bytes were received.
    fn received(&mut self, bytes: &[u8]);

    fn closed(&mut self);

    /// Ends the record.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
