//! Text in code page 1252, by itself and as a field of a stream (GEN-3).
//!
//! | | borrowed | owned (feature `alloc`) |
//! |---|---|---|
//! | a text without a NUL | [`CncStr`] | `CncString` |
//! | a field of a stream: a text, its NUL if any, and the bytes after it | [`TextRef`] | `Text` |
//!
//! ```
//! use ads_cnc::{CncStr, TextRef};
//!
//! let name = CncStr::new("V.E.Länge")?;
//! assert_eq!(name.len(), 9); // one byte per character
//! assert_eq!(TextRef::from(name).field_len(), 10);
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! Manual: `ads-en` 1.05 and `ads-de` 1.051, section 1.

mod cncstr;
mod cp1252;
pub(crate) mod end;
mod field;
#[cfg(feature = "alloc")]
mod owned;

pub use cncstr::{Chars, CncStr};
pub use cp1252::{char_to_cp1252, cp1252_to_char};
pub use field::TextRef;
#[cfg(feature = "alloc")]
pub use owned::{CncString, Text};
