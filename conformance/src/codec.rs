//! Calls this project's codec by the stream and field names of the golden vectors: decodes bytes to
//! fields, and encodes fields.

mod address;
mod decoded;
mod field_reader;
mod fields;
mod frame;
pub mod message;
mod path;
mod stream;
mod typed_values;

pub(crate) use address::hyphenated;
pub use decoded::{CodecError, Decoded};
use fields::{collect, data, name, numbers, one, record, text_tagged, uns16, uns32};

use ads_cnc::{Error, ErrorKind};
use ads_cnc_vectors::{Context, Fields};
use field_reader::FieldReader;

/// The class of an error, as the golden vectors name it; `other` if they have no such class.
pub fn class(error: &Error) -> &'static str {
    match error.kind() {
        ErrorKind::Truncated => "truncated",
        ErrorKind::Trailing => "trailing",
        ErrorKind::TooLong => "too-long",
        ErrorKind::TooMany => "too-many",
        ErrorKind::MissingNul => "missing-nul",
        ErrorKind::InnerNul => "not-text",
        ErrorKind::NotCp1252 => "not-text",
        ErrorKind::Unexpected | ErrorKind::NotDecimal => "unexpected",
        ErrorKind::Digits => "out-of-range",
        ErrorKind::Missing => "truncated",
        ErrorKind::OutOfRange => "out-of-range",
        ErrorKind::Mismatch => "mismatch",
        _ => "other",
    }
}

/// Decodes `bytes` as the stream of this name.
///
/// # Errors
/// If the codec rejects the bytes, the stream is unknown, or the context is incomplete.
pub fn decode_stream(name: &str, context: &Context, bytes: &[u8]) -> Result<Decoded, CodecError> {
    match name {
        "ams-frame" => frame::decode(context, bytes),
        "index-group" => address::index_group(context, bytes),
        "index-offset" => address::index_offset(context, bytes),
        "variable-path" => path::decode(bytes),
        stream => stream::decode(stream, context, bytes),
    }
}

/// Encodes fields as the stream of this name.
///
/// # Errors
/// If a required field of the stream is missing or its value does not fit the field, the codec
/// rejects the fields, the stream is unknown, or the context is incomplete. Unknown fields, and the
/// type tags of most numbers, are ignored.
pub fn encode(name: &str, context: &Context, fields: &Fields) -> Result<Vec<u8>, CodecError> {
    let of = FieldReader(fields);
    match name {
        "ams-frame" => frame::encode(of, context),
        "index-group" => address::encode_group(of),
        "index-offset" => address::encode_offset(of, context),
        "variable-path" => path::encode(of),
        stream => stream::encode(stream, context, fields),
    }
}
