//! Text: hex, escapes, times, JSON. Without I/O; imports no other module of this crate.

mod duration;
mod escape;
pub mod hex;
pub(crate) mod json;
mod moment;

pub(crate) use duration::{duration, some_time};
pub(crate) use escape::{escape, escape_lines, is_escaped};
pub use moment::Moment;

/// A text, or its first `most` characters with an ellipsis.
pub(crate) fn shorten(text: &str, most: usize) -> String {
    let shown: String = text.chars().take(most).collect();
    if shown.len() < text.len() { shown + "…" } else { shown }
}

/// Declares the variants of an enum in this order, and their names.
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
