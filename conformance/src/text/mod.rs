//! Text, such as hex, escapes, durations, points in time, patterns of names, JSON and errors of
//! files. This module opens no file or socket, and imports no other module of this crate.

use std::fmt::Display;

mod duration;
mod escape;
mod file_error;
pub mod hex;
pub(crate) mod json;
mod moment;
mod nearest;
mod parse_error;
mod pattern;

pub(crate) use duration::{duration, shown_time, some_time};
pub(crate) use escape::{escape, escape_lines, is_escaped};
pub use file_error::FileError;
pub(crate) use file_error::{FILE_MAX, read_limited};
pub use moment::Moment;
pub(crate) use nearest::{did_you_mean, nearest};
pub(crate) use parse_error::{found, in_words, json_error, toml_error};
pub use pattern::Pattern;

/// The text, or its first `most` characters with an ellipsis.
pub(crate) fn shorten(text: &str, most: usize) -> String {
    let shown: String = text.chars().take(most).collect();
    if shown.len() < text.len() { shown + "…" } else { shown }
}

/// Whether a file starts with the byte order mark of UTF-16, which Windows PowerShell 5 writes with
/// `>`.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF])
}

pub(crate) const UTF16: &str = "the file is UTF-16; save it as UTF-8";

/// The text of a file without the byte order mark of UTF-8.
///
/// # Errors
/// If the file is not UTF-8. The error says that the file is UTF-16, or contains the offset of the
/// first invalid byte.
pub(crate) fn utf8(bytes: Vec<u8>) -> Result<String, String> {
    if is_utf16(&bytes) {
        return Err(UTF16.to_owned());
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        format!(
            "the file is not UTF-8: invalid byte at offset {}",
            error.utf8_error().valid_up_to()
        )
    })?;
    Ok(text.strip_prefix('\u{FEFF}').map(str::to_owned).unwrap_or(text))
}

/// A number and its noun, in the plural unless the number is 1.
pub(crate) fn plural<N: Display + PartialEq + From<u8>>(number: N, noun: &str) -> String {
    let (stem, end) = match noun {
        _ if number == N::from(1) => (noun, ""),
        _ if noun.ends_with("index") => (noun.trim_end_matches("ex"), "ices"),
        _ if noun.ends_with("axis") => (noun.trim_end_matches("is"), "es"),
        _ if noun.ends_with('y') => (noun.trim_end_matches('y'), "ies"),
        _ => (noun, "s"),
    };
    format!("{number} {stem}{end}")
}

/// The words of a text in lines of at most `width` characters. A word longer than `width` has its
/// own line.
pub(crate) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().chain(word.chars()).count() < width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Adds the list of its variants, in this order, and the name of each variant to an enum.
macro_rules! named {
    ($enum:ident: $($variant:ident $name:literal,)+) => {
        impl $enum {
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }
        }
    };
}
pub(crate) use named;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nouns_are_in_the_plural_unless_there_is_one() {
        let all = [(1, "byte"), (0, "byte"), (2, "reply"), (2, "index"), (2, "platform axis")];
        let all = all.map(|(number, noun): (u32, &str)| plural(number, noun));
        assert_eq!(all, ["1 byte", "0 bytes", "2 replies", "2 indices", "2 platform axes"]);
    }
}
