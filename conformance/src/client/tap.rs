//! Observes the connections of a client.

use std::fmt;
use std::io;
use std::net::SocketAddr;

/// Records the bytes that a client sends and receives.
pub trait Tap: fmt::Debug + Send {
    fn opened(&mut self, local: SocketAddr, remote: SocketAddr);

    fn sent(&mut self, bytes: &[u8]);

    fn received(&mut self, bytes: &[u8]);

    fn closed(&mut self);

    /// Ends the record.
    ///
    /// # Errors
    /// The first error of the system while the record was written.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
