//! serde implementations for texts, NetIds and dynamic values. Their serialised forms can differ
//! from those that serde derives from their Rust fields.

use alloc::string::String;
use alloc::vec::Vec;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::ads::AmsNetId;
use crate::dynamic::DynamicValue;
use crate::text::{CncString, Text, TextRef};

/// Implements serialisation as a string, in the format of `Display` and `FromStr`.
macro_rules! strings {
    ($( $type:ty )+) => { $(
        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
            }
        }
    )+ };
}

strings! { AmsNetId CncString }

/// The serialised form of a [`Text`]: a string if the text ends in one NUL, otherwise a map of the
/// text and the bytes after its NUL (null without a NUL).
#[derive(Serialize, Deserialize)]
#[serde(
    untagged,
    deny_unknown_fields,
    expecting = "expected CP1252 text: a string, or a map of `text` and `tail`"
)]
pub(crate) enum TextShape {
    OneNul(CncString),
    Other {
        text: CncString,
        // Makes a missing `tail` an error; by default it would be `None`.
        #[serde(deserialize_with = "Option::deserialize")]
        tail: Option<Vec<u8>>,
    },
}

impl From<TextShape> for Text {
    fn from(text: TextShape) -> Self {
        match text {
            TextShape::OneNul(text) => text.into(),
            TextShape::Other { text, tail } => Self { text, tail },
        }
    }
}

impl From<Text> for TextShape {
    fn from(Text { text, tail }: Text) -> Self {
        match tail {
            Some(tail) if tail.is_empty() => Self::OneNul(text),
            tail => Self::Other { text, tail },
        }
    }
}

/// A text in a field of `N` bytes. If only NULs follow the text, they are not serialised.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "Text", into = "Text")]
pub(crate) struct Padded<const N: usize>([u8; N]);

impl<const N: usize> From<[u8; N]> for Padded<N> {
    fn from(bytes: [u8; N]) -> Self {
        Self(bytes)
    }
}

impl<const N: usize> From<Padded<N>> for [u8; N] {
    fn from(text: Padded<N>) -> Self {
        text.0
    }
}

impl<const N: usize> From<Padded<N>> for Text {
    fn from(Padded(bytes): Padded<N>) -> Self {
        let field = TextRef::split(&bytes);
        let tail = field.tail().filter(|tail| tail.iter().any(|&byte| byte != 0));
        TextRef::with_tail(field.text(), Some(tail.unwrap_or_default())).into()
    }
}

impl<const N: usize> TryFrom<Text> for Padded<N> {
    type Error = &'static str;

    fn try_from(Text { text, tail }: Text) -> Result<Self, &'static str> {
        // The NUL before an empty tail is not copied: the rest of the field is 0, if there is any.
        let tail = tail.iter().filter(|tail| !tail.is_empty());
        let nul_and_tail = tail.flat_map(|tail| [0].iter().chain(tail));
        let mut all = text.as_bytes().iter().chain(nul_and_tail);
        let mut bytes = [0; N];
        bytes.iter_mut().zip(&mut all).for_each(|(slot, &byte)| *slot = byte);
        match all.next() {
            None => Ok(Self(bytes)),
            Some(_) => Err("a text with more bytes than its field"),
        }
    }
}

/// The serialised form of a REAL64: a number, or the bits of a number that is not finite.
#[derive(Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields, expecting = "expected REAL64: a number, or a map of `bits`")]
pub(crate) enum Real {
    Finite(f64),
    Other { bits: u64 },
}

impl From<Real> for DynamicValue {
    fn from(value: Real) -> Self {
        match value {
            Real::Finite(value) => value.into(),
            Real::Other { bits } => Self::from_bits(bits),
        }
    }
}

impl From<DynamicValue> for Real {
    fn from(value: DynamicValue) -> Self {
        if value.get().is_finite() {
            Self::Finite(value.get())
        } else {
            Self::Other { bits: value.to_bits() }
        }
    }
}
