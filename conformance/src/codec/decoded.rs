//! What the codec makes of a stream.

use ads_cnc::Error;
use ads_cnc_vectors::Fields;

/// What the codec makes of a stream: its fields, and the bytes it encodes to again.
#[derive(Debug, PartialEq)]
pub struct Decoded {
    /// The fields under their names, without what only counts.
    pub fields: Fields,
    /// Encoded again.
    pub bytes: Vec<u8>,
}

/// Why the codec has no answer.
#[derive(Debug)]
pub enum Refused {
    /// It refuses the bytes.
    Error(Error),
    /// These fields are no value of the stream.
    Unfit(String),
    /// It does not know the stream, or the context lacks what it needs.
    Unsupported(String),
}

impl From<Error> for Refused {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}
