//! Data streaming: an NC program written to the CNC packet by packet while it runs.
//!
//! | manual (`stream-en`) | implemented by |
//! |---|---|
//! | 2.2, lines and packets | [`NcText`], [`Packets`] |
//! | 2.2, end of the program; 2.3.3, 2.3.4, 2.3.6, permitted contents of a program | with `alloc`: `Diagnostics`, or packet by packet, `Checker` |
//! | 3.1, sizes | [`limits`](crate::limits) |
//! | 3.2, the object | [`WriteProgramStream`](crate::operation::WriteProgramStream), [`ProgramStreamRef`], [`OBJECT_NAME`] |
//! | 4.1, line ends | [`check_line_ends`], [`LINE_END_ERROR`] |
//! | 4.2 and 5, acknowledgement and repetition | [`Sender`], [`Ack`], [`RETRY_AFTER`] |
//!
//! A packet consists of whole lines of ASCII text, each ended by CR LF, without a NUL and without a
//! leading length (STM-4, STM-7). The module does no I/O. Only `ProgramStream`, `Diagnostics`,
//! `Checker` and its iterator `CheckEvents`, all with the feature `alloc`, allocate memory.
//!
//! ```
//! use ads_cnc::streaming::{Ack, NcText, Sender};
//!
//! // Check the lines and the NC words of the whole text before the first packet is sent.
//! let text = NcText::new(b"N10 G01 X200 F1000\nN20 X240 Y100\nN30 M30")?;
//! # #[cfg(feature = "alloc")]
//! assert_eq!(text.diagnostics().next(), None);
//!
//! let mut sender = Sender::new(text);
//! let mut written = Vec::new();
//! while let Some(packet) = sender.packet() {
//!     // Write the packet to the CNC. After `Ack::Busy`, wait `RETRY_AFTER`; then `packet` returns it again.
//!     written.extend_from_slice(packet);
//!     sender.acknowledge(Ack::Accepted)?;
//! }
//! assert_eq!(written, b"N10 G01 X200 F1000\r\nN20 X240 Y100\r\nN30 M30\r\n");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use core::time::Duration;

use crate::address::IndexOffset;
use crate::operation::Function;

#[cfg(feature = "alloc")]
mod check;
#[cfg(feature = "alloc")]
mod checker;
mod ends;
mod error;
#[cfg(feature = "alloc")]
mod labels;
#[cfg(feature = "alloc")]
mod lex;
mod packets;
mod program_stream;
#[cfg(feature = "alloc")]
mod scan;
mod sender;
mod text;
#[cfg(feature = "alloc")]
mod words;

#[cfg(feature = "alloc")]
pub use check::{Diagnostic, DiagnosticKind};
#[cfg(feature = "alloc")]
pub use checker::{CheckEvent, CheckEvents, Checker, Diagnostics};
pub use ends::check_line_ends;
pub use error::{LineError, LineErrorKind};
pub use packets::Packets;
#[cfg(feature = "alloc")]
pub use program_stream::ProgramStream;
pub use program_stream::ProgramStreamRef;
pub use sender::{Ack, Progress, Sender, SenderState, UnexpectedAck};
pub use text::{Lines, NcText};
#[cfg(feature = "alloc")]
pub use words::{LoopWord, ProgramEnd};

/// Index offset of the program stream in the COM group of a channel: `0x20100` + channel, or
/// `0x120100` + channel in logical addressing (STM-1).
///
/// Manual: `stream-en`, sections 3.2 and 5.
pub const INDEX_OFFSET: IndexOffset = Function::WriteProgramStream.spec().offset.first();

/// Name of the COM object of the program stream (STM-1).
///
/// Manual: `stream-en`, section 3.2.
pub const OBJECT_NAME: &str = "mc_program_stream_w";

/// Number of the CNC error for a line that does not end in CR LF, which aborts processing (STM-5).
///
/// Manual: `stream-en`, section 4.1.
pub const LINE_END_ERROR: u32 = 21476;

/// Number of the CNC warning for data that the CNC cannot accept at present (STM-6).
///
/// Manual: `stream-en`, section 4.2.
pub const BUSY_WARNING: u32 = 11012;

/// The time that the driver in the manual waits before it writes the same data again (STM-6).
///
/// Manual: `stream-en`, section 5.
pub const RETRY_AFTER: Duration = Duration::from_millis(500);
