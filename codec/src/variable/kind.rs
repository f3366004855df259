//! Asking how many variables of a kind there are, and for one of them (VAR-1 … VAR-3).

use core::fmt;

use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field::{variable_count, variable_index_kind, variable_kind};
use crate::limits::TEXT_MAX;
use crate::stream::{Decode, Encode};
use crate::text::{CncStr, TextRef};

/// A kind of variables, `V.E` for one: the text without a final dot.
///
/// Any text is one: which kinds a function takes is the CNC's to say. What the editions say of it is
/// in [`edition`](crate::edition).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.1 and 4.3.1.
///
/// ```
/// use ads_cnc::Kind;
///
/// assert_eq!(Kind::new("V.E")?, Kind::V_E);
/// assert!(Kind::ALL.text().is_empty());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Kind<'a>(TextRef<'a>);

impl<'a> Kind<'a> {
    /// Global variables.
    pub const V_G: Kind<'static> = Kind::ascii(b"V.G");
    /// External variables.
    pub const V_E: Kind<'static> = Kind::ascii(b"V.E");
    /// Axis variables.
    pub const V_A: Kind<'static> = Kind::ascii(b"V.A");
    /// Cycle variables, by name only (VAR-18).
    pub const V_CYC: Kind<'static> = Kind::ascii(b"V.CYC");
    /// Variables of the kind V.P, on the channel interface by name only (VAR-18, VAR-19).
    pub const V_P: Kind<'static> = Kind::ascii(b"V.P");
    /// Variables of the kind V.L, on the channel interface by name only (VAR-18, VAR-19).
    pub const V_L: Kind<'static> = Kind::ascii(b"V.L");
    /// Variables of the kind V.S, on the channel interface by name only (VAR-18, VAR-19).
    pub const V_S: Kind<'static> = Kind::ascii(b"V.S");
    /// V.E, V.G and V.A together; only their number can be asked for.
    pub const ALL: Kind<'static> = Kind::ascii(b"");

    const fn ascii(text: &'static [u8]) -> Kind<'static> {
        Kind(TextRef::with_tail(CncStr::without_nul(text), Some(&[])))
    }

    /// The kind of this name.
    ///
    /// # Errors
    /// Those of [`CncStr::new`].
    pub fn new(text: &'a str) -> Result<Self, Error> {
        TextRef::new(text).map(Self)
    }

    /// The kind in a text field.
    pub const fn from_field(field: TextRef<'a>) -> Self {
        Self(field)
    }

    /// The text.
    #[inline]
    pub const fn text(&self) -> CncStr<'a> {
        self.0.text()
    }

    /// The text with its end.
    pub const fn field(&self) -> TextRef<'a> {
        self.0
    }
}

impl fmt::Debug for Kind<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}

#[doc = include_str!("../../doc/variable-kind.md")]
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.1.
///
/// `decode` refuses with [`MissingNul`](crate::ErrorKind::MissingNul),
/// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Decode, VariableKindRef};
///
/// assert_eq!(VariableKindRef::decode(b"V.E\0")?.kind.text(), "V.E");
/// // No kind asks for the sum; it is written as one NUL.
/// assert!(VariableKindRef::decode(b"")?.kind.text().is_empty());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VariableKindRef<'a> {
    /// The kind.
    pub kind: Kind<'a>,
}

impl<'a> Decode<'a> for VariableKindRef<'a> {
    const STREAM: Stream = Stream::VariableKind;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        if input.is_empty() {
            return Ok(Self { kind: Kind(TextRef::with_tail(CncStr::EMPTY, None)) });
        }
        let kind = Kind(input.terminated(variable_kind::KIND, to_u32(TEXT_MAX))?);
        Ok(Self { kind })
    }
}

impl Encode for VariableKindRef<'_> {
    fn encoded_len(&self) -> usize {
        self.kind.0.field_len()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let field = self.kind.0;
        let len = match field.field_len() {
            0 => 0,
            _ => field.check_terminated(variable_kind::KIND, 0, to_u32(TEXT_MAX))?,
        };
        Writer::run(Self::STREAM, len, buf, |out| field.write(out))
    }
}

crate::number::number_stream! {
    #[doc = include_str!("../../doc/variable-count.md")]
    ///
    /// Indices run from 0 to one less.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.1.
    ///
    /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Decode, VariableCount};
    ///
    /// assert_eq!(VariableCount::decode(&[123, 0, 0, 0])?, VariableCount(123));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Debug)]
    VariableCount, VariableCount, variable_count::COUNT
}

#[doc = include_str!("../../doc/variable-index-kind.md")]
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
/// [`MissingNul`](crate::ErrorKind::MissingNul), [`Trailing`](crate::ErrorKind::Trailing) or
/// [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Encode, Kind, VariableIndexKindRef};
///
/// let mut buf = [0; 8];
/// let request = VariableIndexKindRef { index: 2, kind: Kind::V_E };
/// assert_eq!(request.encode(&mut buf)?, b"\x02\0\0\0V.E\0");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VariableIndexKindRef<'a> {
    /// Index of the variable, from 0.
    pub index: u32,
    /// The kind.
    pub kind: Kind<'a>,
}

impl<'a> Decode<'a> for VariableIndexKindRef<'a> {
    const STREAM: Stream = Stream::VariableIndexKind;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        let index = input.u32(variable_index_kind::INDEX)?;
        let kind = Kind(input.terminated(variable_index_kind::KIND, to_u32(TEXT_MAX))?);
        Ok(Self { index, kind })
    }
}

impl Encode for VariableIndexKindRef<'_> {
    fn encoded_len(&self) -> usize {
        self.kind.0.field_len().saturating_add(4)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let len = self.kind.0.check_terminated(variable_index_kind::KIND, 4, to_u32(TEXT_MAX))?;
        Writer::run(Self::STREAM, len.saturating_add(4), buf, |out| {
            out.u32(self.index);
            self.kind.0.write(out);
        })
    }
}

#[cfg(feature = "alloc")]
pub use owned::{VariableIndexKind, VariableKind};

#[cfg(feature = "alloc")]
mod owned {
    use super::*;
    use crate::bridge::{self, TextLen};
    use crate::text::Text;

    #[binrw::binread]
    #[br(little, import(len: TextLen))]
    struct KindWire {
        #[br(parse_with = bridge::text, args(len))]
        kind: Text,
    }

    /// [`VariableKindRef`], owned.
    ///
    /// ```
    /// use ads_cnc::{Decode, VariableKind};
    ///
    /// assert_eq!(VariableKind::decode(b"V.E\0")?.kind.text.as_bytes(), b"V.E");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct VariableKind {
        /// The kind.
        pub kind: Text,
    }

    impl<'a> Decode<'a> for VariableKind {
        const STREAM: Stream = Stream::VariableKind;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            let len: TextLen = VariableKindRef::decode(bytes)?.kind.0.into();
            let KindWire { kind } = bridge::read_with(Self::STREAM, bytes, (len,))?;
            Ok(Self { kind })
        }
    }

    impl VariableKind {
        /// The request, borrowed.
        #[inline]
        pub fn as_ref(&self) -> VariableKindRef<'_> {
            VariableKindRef { kind: Kind(self.kind.as_ref()) }
        }
    }

    crate::stream::encode_as_ref!(VariableKind);

    #[binrw::binread]
    #[br(little, import(len: TextLen))]
    struct IndexKindWire {
        index: u32,
        #[br(parse_with = bridge::text, args(len))]
        kind: Text,
    }

    /// [`VariableIndexKindRef`], owned.
    ///
    /// ```
    /// use ads_cnc::{Decode, VariableIndexKind};
    ///
    /// let request = VariableIndexKind::decode(b"\x02\0\0\0V.E\0")?;
    /// assert_eq!((request.index, request.kind.text.as_bytes()), (2, &b"V.E"[..]));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct VariableIndexKind {
        /// Index of the variable, from 0.
        pub index: u32,
        /// The kind.
        pub kind: Text,
    }

    impl<'a> Decode<'a> for VariableIndexKind {
        const STREAM: Stream = Stream::VariableIndexKind;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            let len: TextLen = VariableIndexKindRef::decode(bytes)?.kind.0.into();
            let IndexKindWire { index, kind } = bridge::read_with(Self::STREAM, bytes, (len,))?;
            Ok(Self { index, kind })
        }
    }

    impl VariableIndexKind {
        /// The request, borrowed.
        #[inline]
        pub fn as_ref(&self) -> VariableIndexKindRef<'_> {
            VariableIndexKindRef { index: self.index, kind: Kind(self.kind.as_ref()) }
        }
    }

    crate::stream::encode_as_ref!(VariableIndexKind);
}
