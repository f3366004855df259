//! Bytes as hex.

pub(crate) mod compact;
mod input;

pub use input::{HexError, parse_hex};

use ads_cnc_vectors::Hex;

/// Number of bytes on a line of [`dump`].
pub(crate) const LINE: usize = 16;

/// Bytes in hex, separated by spaces.
pub(crate) fn spaced(bytes: &[u8]) -> String {
    Hex(bytes.to_vec()).to_string()
}

/// A byte as a character if it is a graphic ASCII character, otherwise a middle dot.
pub(crate) fn character(byte: u8) -> char {
    if byte.is_ascii_graphic() { char::from(byte) } else { '·' }
}

/// Formats at most [`LINE`] bytes as a line: mark, offset, bytes, characters, name.
pub(crate) fn line(mark: char, offset: usize, bytes: &[u8], name: &str) -> String {
    let text: String = bytes.iter().copied().map(character).collect();
    let line = format!("{mark}{offset:5}  {:<47}  {text:<16}  {name}", spaced(bytes));
    line.trim_end().to_owned()
}

/// Formats bytes as lines of at most 16 bytes, each with offset, bytes and characters.
pub fn dump(bytes: &[u8]) -> Vec<String> {
    let chunks = (0_usize..).step_by(LINE).zip(bytes.chunks(LINE));
    chunks.map(|(offset, chunk)| line(' ', offset, chunk, "")).collect()
}
