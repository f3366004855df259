//! The result of decoding a stream.

use ads_cnc::Error;
use ads_cnc_vectors::Fields;

/// The decoded fields of a stream, and their encoding.
#[derive(Debug, PartialEq)]
pub struct Decoded {
    /// The fields by name, without counters (fields that contain a length or a number of items).
    pub fields: Fields,
    /// The bytes that result from encoding the decoded value again.
    pub bytes: Vec<u8>,
}

/// Why decoding or encoding failed.
#[derive(Debug)]
pub enum CodecError {
    /// The codec rejects the bytes or the value.
    Error(Error),
    /// The fields are not a value of the stream, or the bytes of a frame do not match its length.
    InvalidFields(String),
    /// The stream is unknown, or the context is incomplete or does not match the bytes.
    Unsupported(String),
}

impl From<Error> for CodecError {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}
