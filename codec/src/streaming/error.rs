//! Errors in lines.

/// The error for a line that cannot be streamed, or for a wrong line end in received data: the
/// position and the class of the fault.
///
/// It is `Copy` and has 16 bytes. It describes the first fault of a text to be sent, which
/// [`NcText::new`](super::NcText::new) returns before anything is sent, or of received data, which
/// [`check_line_ends`](super::check_line_ends) returns.
///
/// Manual: `stream-en`, sections 2.2, 3.1, 3.2 and 4.1.
///
/// ```
/// use ads_cnc::streaming::{LineErrorKind, NcText};
///
/// let error = NcText::new(b"N10 G0 X0\n(L\xE4nge)\n").unwrap_err();
/// assert_eq!((error.line(), error.column()), (2, 3));
/// assert_eq!(error.kind(), LineErrorKind::NotAscii { byte: 0xE4 });
/// let text = "line 2, column 3: ASCII character expected, byte 0xE4 found (STM-7)";
/// assert_eq!(error.to_string(), text);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[error("line {line}, column {column}: {kind} ({})", .kind.clause())]
pub struct LineError {
    line: u32,
    column: u32,
    kind: LineErrorKind,
}

/// The class of a [`LineError`].
///
/// ```
/// use ads_cnc::streaming::{LineErrorKind, NcText};
///
/// let line = [b'X'; 991];
/// let kind = NcText::new(&line).unwrap_err().kind();
/// assert_eq!((kind, kind.clause()), (LineErrorKind::TooLong { length: 991 }, "STM-20"));
/// assert!(NcText::new(&line[..990]).is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[non_exhaustive]
pub enum LineErrorKind {
    /// The line and its CR LF do not fit into a packet (STM-20). The column is that of the first
    /// character beyond the limit.
    #[error("line of at most 990 characters expected, {length} found")]
    TooLong {
        /// Number of characters of the line.
        length: u32,
    },
    /// A byte that is not ASCII (STM-7).
    #[error("ASCII character expected, byte {byte:#04X} found")]
    NotAscii {
        /// The byte.
        byte: u8,
    },
    /// A NUL, which the stream must not contain (STM-7).
    #[error("ASCII character expected, NUL found")]
    Nul,
    /// LF without CR before it, in received data (STM-5).
    #[error("CR LF expected, LF alone found")]
    BareLf,
    /// CR without LF after it, in received data (STM-5).
    #[error("CR LF expected, CR alone found")]
    BareCr,
    /// Received data that ends within a line (STM-5).
    #[error("CR LF expected, end of data found")]
    NoLineEnd,
}

impl LineErrorKind {
    /// The ID of the requirement that the line violates.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::TooLong { .. } => "STM-20",
            Self::NotAscii { .. } | Self::Nul => "STM-7",
            Self::BareLf | Self::BareCr | Self::NoLineEnd => "STM-5",
        }
    }
}

impl LineError {
    pub(super) const fn new(line: u32, column: u32, kind: LineErrorKind) -> Self {
        Self { line, column, kind }
    }

    /// The line, from 1.
    pub const fn line(&self) -> u32 {
        self.line
    }

    /// The column, from 1, in bytes.
    pub const fn column(&self) -> u32 {
        self.column
    }

    /// The class of the error.
    pub const fn kind(&self) -> LineErrorKind {
        self.kind
    }
}

const _: () = assert!(size_of::<LineError>() == 16);
