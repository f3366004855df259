//! Count, index and value of dynamic parameters (DYN-1, DYN-4, DYN-5).

use core::fmt;

use zerocopy::little_endian::U64;

use crate::bytes::{Reader, Writer};
use crate::declare::stream;
use crate::error::Error;
use crate::layout::{Field, Stream};
use crate::rows::{NonZero, Row as _};
use crate::stream::{Decode, Encode};

stream! {
    /// The number of dynamic parameters.
    ///
    /// The indices of the parameters are 1 to this number.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3.1 … 3.4.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::dynamic::DynamicCount;
    ///
    /// assert_eq!(DynamicCount::decode(&[1, 0, 0, 0])?, DynamicCount(1));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicCount "dynamic-count", "Number of dynamic parameters, reply", "DYN-1", max 4;
    tuple DynamicCount {
        @0 count: UNS32, "DYN-1", "parameters of the kind; also the largest index";
    }
}

crate::number::shown!(DynamicCount);

stream! {
    /// The data of a request that selects a dynamic parameter by its index. The function determines
    /// whether the reply is the name or the value.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`OutOfRange`](crate::ErrorKind::OutOfRange) or [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::dynamic::DynamicIndex;
    /// use ads_cnc::{Decode, Encode};
    ///
    /// assert_eq!(DynamicIndex(1).encode(&mut [0; 4])?, [1, 0, 0, 0]);
    /// assert_eq!(
    ///     DynamicIndex::decode(&[0; 4]).unwrap_err().to_string(),
    ///     "dynamic-index: index at offset 0: out of range, expected at least 1, found 0"
    /// );
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicIndex "dynamic-index", "Dynamic parameter by index, request", "DYN-5", max 4;
    tuple DynamicIndex {
        @0 index: UNS32_NON_ZERO, "DYN-5", "index of the parameter, from 1";
    }
}

crate::number::shown!(DynamicIndex);

impl DynamicIndex {
    /// Rejects 0, like the decoder.
    pub(crate) fn check(self) -> Result<Self, Error> {
        let field = const { Field::of::<Self>("index") };
        NonZero::check(self.0, field, 0).map(|()| self)
    }
}

#[doc = include_str!("../../doc/dynamic-value.md")]
///
/// All bits are kept, including those of a NaN. Two values are equal if their bits are equal.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3.1 … 3.4.
///
/// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::Encode;
/// use ads_cnc::dynamic::DynamicValue;
///
/// assert_eq!(DynamicValue::from(4711.0).encode(&mut [0; 8])?, [0, 0, 0, 0, 0, 0x67, 0xB2, 0x40]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "crate::serial::Real", into = "crate::serial::Real")
)]
pub struct DynamicValue {
    bits: u64,
}

impl DynamicValue {
    /// The value.
    pub const fn get(self) -> f64 {
        f64::from_bits(self.bits)
    }

    /// The value with these bits.
    pub const fn from_bits(bits: u64) -> Self {
        Self { bits }
    }

    /// The bytes of the stream.
    pub const fn to_bytes(self) -> [u8; 8] {
        self.bits.to_le_bytes()
    }

    /// The bits of the value.
    pub const fn to_bits(self) -> u64 {
        self.bits
    }
}

impl From<f64> for DynamicValue {
    fn from(value: f64) -> Self {
        Self { bits: value.to_bits() }
    }
}

impl From<DynamicValue> for f64 {
    fn from(value: DynamicValue) -> Self {
        value.get()
    }
}

/// Displays the number.
impl fmt::Display for DynamicValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.get().fmt(f)
    }
}

impl fmt::Debug for DynamicValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} ({:#018x})", self.get(), self.bits)
    }
}

impl<'a> Decode<'a> for DynamicValue {
    const STREAM: Stream = Stream::DynamicValue;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let bits: &U64 = Reader::exact(Self::STREAM, bytes)?;
        Ok(Self { bits: bits.get() })
    }
}

impl Encode for DynamicValue {
    fn encoded_len(&self) -> usize {
        size_of_val(&self.bits)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::copy(Self::STREAM, &self.to_bytes(), buf)
    }
}
