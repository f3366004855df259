//! Errors of the codec and of the caller.

use codec::operation::DispatchError;
use codec::{Error, ErrorKind};

use crate::ADS_CNC_NONE;
use crate::memory::{AdsCncBytes, put};
use crate::tables::{field_number, stream_number};

/// The reason why a function returned false.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct AdsCncError {
    /// The kind: one of the constants of `AdsCncErrorKind` in the header, from
    /// `ADS_CNC_OTHER_ERROR` on.
    pub kind: u32,
    /// The number of the stream at fault, or `ADS_CNC_NONE`.
    pub stream: u32,
    /// The number of the field at fault; `ADS_CNC_NONE` for a fault of the whole stream, or if
    /// there is no stream.
    pub field: u32,
    /// The offset of the fault in the stream, in bytes; in a text or name, in characters; for a
    /// line of an NC program, its column; for an error without a position, 0.
    pub offset: u32,
    /// A number whose meaning depends on the kind, such as the expected length.
    pub expected: u32,
    /// A number whose meaning depends on the kind, such as the found length.
    pub found: u32,
    /// The name of the stream or other subject at fault.
    pub subject: AdsCncBytes,
    /// The name of the field or argument, or empty.
    pub name: AdsCncBytes,
    /// A description of the kind.
    pub text: AdsCncBytes,
}

/// A reason for a function to fail.
#[derive(Clone, Copy)]
pub(crate) enum Fault {
    Codec(Error),
    /// A null pointer, or a length beyond the address space.
    Pointer,
    NoFunction,
    NoStream,
    NoField,
    /// The name of an argument or field whose value the function does not accept.
    Argument(&'static str),
    /// The memory of the caller is too small: the numbers of items needed and available.
    Room(u32, u32),
    /// The sender or host is not started.
    NotStarted,
    /// A line of an NC program that cannot be sent: line, column, the number found, and a
    /// description.
    Line(u32, u32, u32, &'static str),
    /// A received call that cannot be dispatched.
    Dispatch(DispatchError),
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::Codec(error)
    }
}

/// The number and the description of each kind of errors of the codec.
pub(crate) fn class(kind: ErrorKind) -> (u32, &'static str) {
    match kind {
        ErrorKind::Truncated => (1, "truncated"),
        ErrorKind::Trailing => (2, "trailing bytes"),
        ErrorKind::TooLong => (3, "too long"),
        ErrorKind::TooMany => (4, "too many"),
        ErrorKind::MissingNul => (5, "no NUL"),
        ErrorKind::InnerNul => (6, "NUL inside the text"),
        ErrorKind::NotCp1252 => (7, "not in CP1252"),
        ErrorKind::NotDecimal => (8, "not a decimal digit"),
        ErrorKind::Digits => (9, "wrong number of digits"),
        ErrorKind::Unexpected => (10, "unexpected character"),
        ErrorKind::Missing => (11, "missing"),
        ErrorKind::OutOfRange => (12, "out of range"),
        ErrorKind::Mismatch => (13, "mismatch"),
        ErrorKind::Function => (14, "a function, not content"),
        ErrorKind::BufferTooSmall => (15, "buffer too small"),
        _ => (0, "another error"),
    }
}

impl AdsCncError {
    pub(crate) fn new(fault: Fault) -> Self {
        let of = |kind, text: &str| Self {
            kind,
            stream: ADS_CNC_NONE,
            field: ADS_CNC_NONE,
            offset: 0,
            expected: 0,
            found: 0,
            subject: AdsCncBytes::of(b"call"),
            name: AdsCncBytes::NONE,
            text: AdsCncBytes::of(text.as_bytes()),
        };
        let numbers =
            |error: Self, offset, expected, found| Self { offset, expected, found, ..error };
        let named = |error: Self, subject: &str, name: &str| Self {
            subject: AdsCncBytes::of(subject.as_bytes()),
            name: AdsCncBytes::of(name.as_bytes()),
            ..error
        };
        match fault {
            Fault::Codec(error) => {
                let (field, (kind, text)) = (error.field(), class(error.kind()));
                let error =
                    numbers(of(kind, text), error.offset(), error.expected(), error.found());
                Self {
                    stream: field.stream().map_or(ADS_CNC_NONE, stream_number),
                    field: field_number(field),
                    ..named(error, field.subject().name(), field.name())
                }
            }
            Fault::Pointer => of(32, "null, or longer than memory can be"),
            Fault::NoFunction => of(33, "no function has this number"),
            Fault::NoStream => of(34, "no stream has this number"),
            Fault::NoField => of(35, "no field of the stream has this number"),
            Fault::Argument(name) => {
                named(of(36, "argument not accepted by the function"), "call", name)
            }
            Fault::Room(needed, given) => numbers(of(37, "too little room"), 0, needed, given),
            Fault::NotStarted => of(38, "not started"),
            Fault::Line(line, column, found, text) => {
                named(numbers(of(39, text), column, line, found), "nc-text", "line")
            }
            Fault::Dispatch(error) => match error {
                DispatchError::Port(port) => named(
                    numbers(of(40, "no task has this port"), 0, 0, port.0.into()),
                    "call",
                    "port",
                ),
                DispatchError::Group(group) => {
                    let error = of(41, "no function has this index group");
                    named(numbers(error, 0, 0, group.get()), "call", "index_group")
                }
                DispatchError::Offset(offset) => {
                    let error = of(42, "no function has this index offset");
                    named(numbers(error, 0, 0, offset.get()), "call", "index_offset")
                }
                DispatchError::Service { expected, found } => {
                    let [expected, found] = [expected, found].map(|it| it.command().0.into());
                    let error = of(43, "the function requires another command");
                    named(numbers(error, 0, expected, found), "call", "command")
                }
                DispatchError::Stream(error) => Self::new(Fault::Codec(error)),
                _ => of(0, "another error"),
            },
        }
    }
}

/// Converts a result for the caller: returns true, or writes the error to `out` and returns false.
///
/// # Safety
/// `out` is null, or points to memory for an error.
pub(crate) unsafe fn told(result: Result<(), Fault>, out: *mut AdsCncError) -> bool {
    match result {
        Ok(()) => true,
        Err(fault) => {
            // SAFETY: the caller's contract.
            unsafe { put(out, AdsCncError::new(fault)) };
            false
        }
    }
}
