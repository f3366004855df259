//! The result of decoding a stream.

use ads_cnc::Error;
use ads_cnc_vectors::Fields;

/// The decoded fields of a stream, and their encoding.
#[derive(Debug, PartialEq)]
pub struct Decoded {
    /// The fields by name, without counters.
    pub fields: Fields,
    /// The bytes that result from encoding the decoded value again.
    pub bytes: Vec<u8>,
}

/// Why decoding or encoding failed.
#[derive(Debug)]
pub enum CodecError {
    /// The codec rejects the bytes.
    Error(Error),
    /// The fields are not a value of the stream.
    InvalidFields(String),
    /// The stream is unknown, or the context is incomplete.
    Unsupported(String),
}

impl From<Error> for CodecError {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}
