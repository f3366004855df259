//! Text in code page CP1252 (GEN-3): on its own, and as it stands in a stream.

mod cncstr;
mod cp1252;
mod field;
#[cfg(feature = "alloc")]
mod owned;
mod stream;

pub use cncstr::{Chars, CncStr};
pub use cp1252::{char_to_cp1252, cp1252_to_char};
pub use field::TextRef;
#[cfg(feature = "alloc")]
pub use owned::{CncString, Text};
pub(crate) use stream::text_stream;
