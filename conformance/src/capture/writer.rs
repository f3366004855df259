//! Writes a capture for Wireshark in pcapng format, with artificial Ethernet, IP and TCP headers
//! around the bytes of a connection.
//!
//! The file contains the bytes that the client sent and received, in their order and with the time
//! of this machine, not the segments and acknowledgements on the network. Each connection begins
//! with a handshake, and a closed connection ends with a FIN of both sides, so that a reader can
//! reassemble it.
//!
//! ```
//! use std::net::SocketAddr;
//!
//! use ads_cnc_conformance::capture::Capture;
//! use ads_cnc_conformance::client::Tap as _;
//!
//! let (local, remote) = (SocketAddr::from(([192, 0, 2, 20], 50000)), SocketAddr::from(([192, 0, 2, 10], 48898)));
//! let file = std::env::temp_dir().join(format!("ads-cnc-doc-{}.pcapng", std::process::id()));
//! let mut capture = Capture::create(&file)?;
//! capture.opened(local, remote);
//! capture.sent(b"question");
//! capture.received(b"answer");
//! capture.closed();
//! capture.finish()?;
//! assert!(std::fs::read(&file)?.starts_with(&[0x0A, 0x0D, 0x0D, 0x0A]));
//! # std::fs::remove_file(&file)?;
//! # Ok::<(), std::io::Error>(())
//! ```

use std::fmt;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::net::SocketAddr;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::frame::{ACK, FIN, Flow, PSH, SYN};
use crate::client::Tap;
use crate::number::to_u32;

/// The comment of a capture whose requests the suite sends.
pub(super) const SUITE: &str = "the client is ads-cnc run";

/// Maximum number of data bytes of a TCP segment, which fits into an Ethernet frame.
const SEGMENT_MAX: usize = 1440;

/// A capture that is being written. [`finish`](Self::finish) returns the first error of the system.
pub struct Capture {
    out: Box<dyn Write + Send>,
    flow: Option<Flow>,
    error: Option<io::Error>,
    /// Called with the first error of the system if the capture is dropped before it is finished.
    dropped: Option<Box<dyn FnOnce(io::Error) + Send>>,
}

impl fmt::Debug for Capture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Capture").field("flow", &self.flow).finish_non_exhaustive()
    }
}

impl Capture {
    /// Creates a file, or replaces an existing file, and writes the capture to it.
    pub fn create(file: &Path) -> io::Result<Self> {
        Self::new(Box::new(BufWriter::new(File::create(file)?)))
    }

    /// Like [`create`](Self::create), with a comment that the suite sends the requests.
    pub fn of_suite(file: &Path) -> io::Result<Self> {
        Self::begin(Box::new(BufWriter::new(File::create(file)?)), &[(COMMENT, SUITE)])
    }

    /// Creates a capture that is written to `out`.
    pub fn new(out: Box<dyn Write + Send>) -> io::Result<Self> {
        Self::begin(out, &[])
    }

    fn begin(mut out: Box<dyn Write + Send>, options: &[(u16, &str)]) -> io::Result<Self> {
        out.write_all(&section(options))?;
        out.write_all(&interface())?;
        Ok(Self { out, flow: None, error: None, dropped: None })
    }

    /// Calls `tell` with the first error of the system, if any, when the capture is dropped before
    /// it is [finished](Self::finish).
    #[must_use]
    pub fn or_tell(self, tell: impl FnOnce(io::Error) + Send + 'static) -> Self {
        let mut capture = self;
        capture.dropped = Some(Box::new(tell));
        capture
    }

    /// Ends the open connection, if any, and completes the file.
    ///
    /// # Errors
    /// The first error of the system while writing.
    pub fn finish(mut self) -> io::Result<()> {
        self.dropped = None;
        self.end()
    }

    fn end(&mut self) -> io::Result<()> {
        self.closed();
        match self.error.take() {
            Some(error) => Err(error),
            None => self.out.flush(),
        }
    }

    fn bytes(&mut self, outgoing: bool, bytes: &[u8]) {
        for segment in bytes.chunks(SEGMENT_MAX) {
            self.packet(outgoing, PSH | ACK, segment);
        }
    }

    fn packet(&mut self, outgoing: bool, flags: u8, data: &[u8]) {
        let Some(flow) = &mut self.flow else { return };
        let packet = flow.packet(outgoing, flags, data);
        if let Err(error) = packet.and_then(|packet| self.out.write_all(&enhanced(&packet))) {
            self.error.get_or_insert(error);
        }
    }
}

impl Tap for Capture {
    fn opened(&mut self, local: SocketAddr, remote: SocketAddr) {
        self.flow = Some(Flow::new(local, remote));
        self.packet(true, SYN, &[]);
        self.packet(false, SYN | ACK, &[]);
        self.packet(true, ACK, &[]);
    }

    fn sent(&mut self, bytes: &[u8]) {
        self.bytes(true, bytes);
    }

    fn received(&mut self, bytes: &[u8]) {
        self.bytes(false, bytes);
    }

    fn closed(&mut self) {
        if self.flow.is_some() {
            self.packet(true, FIN | ACK, &[]);
            self.packet(false, FIN | ACK, &[]);
            self.packet(true, ACK, &[]);
            self.flow = None;
        }
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        Capture::finish(*self)
    }
}

impl From<Capture> for Box<dyn Tap> {
    fn from(capture: Capture) -> Self {
        Box::new(capture)
    }
}

impl Drop for Capture {
    fn drop(&mut self) {
        if let (Err(error), Some(tell)) = (self.end(), self.dropped.take()) {
            tell(error);
        }
    }
}

/// A block: type, length, body padded to a multiple of four bytes, length again.
fn block(kind: u32, body: &[u8]) -> Vec<u8> {
    let filled = body.len().next_multiple_of(4);
    let length = to_u32(filled.saturating_add(12));
    let mut block = kind.to_le_bytes().to_vec();
    block.extend(length.to_le_bytes());
    block.extend(body);
    block.resize(filled.saturating_add(8), 0);
    block.extend(length.to_le_bytes());
    block
}

/// Codes of options of a section header.
const COMMENT: u16 = 1;
const USER_APPLICATION: u16 = 4;

/// Section header: byte order, version 1.0, unspecified length, options, name of the writing tool.
fn section(options: &[(u16, &str)]) -> Vec<u8> {
    let name = (USER_APPLICATION, concat!("ads-cnc ", env!("CARGO_PKG_VERSION")));
    let mut body = 0x1A2B_3C4D_u32.to_le_bytes().to_vec();
    body.extend([1, 0, 0, 0]);
    body.extend(u64::MAX.to_le_bytes());
    for (code, text) in options.iter().copied().chain([name]) {
        body.extend(code.to_le_bytes());
        body.extend(u16::try_from(text.len()).unwrap_or_default().to_le_bytes());
        body.extend(text.as_bytes());
        body.resize(body.len().next_multiple_of(4), 0);
    }
    body.extend([0; 4]);
    block(0x0A0D_0D0A, &body)
}

/// Interface description: Ethernet, unlimited packet length, times in microseconds.
fn interface() -> Vec<u8> {
    block(1, &[1, 0, 0, 0, 0, 0, 0, 0])
}

/// Enhanced packet: interface 0, time, captured length, original length, packet.
fn enhanced(packet: &[u8]) -> Vec<u8> {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    let time = u64::try_from(since.as_micros()).unwrap_or(u64::MAX).to_le_bytes();
    let (low, high) = time.split_at(4);
    let length = to_u32(packet.len()).to_le_bytes();
    let body = [&[0; 4], high, low, &length, &length, packet].concat();
    block(6, &body)
}
