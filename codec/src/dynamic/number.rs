//! Count, index and value of dynamic parameters (DYN-1, DYN-4, DYN-5).

use core::fmt;

use zerocopy::little_endian::U64;

use crate::bytes::{Reader, Writer};
use crate::error::{Error, ErrorKind};
use crate::layout::Stream;
use crate::layout::field::{dynamic_count, dynamic_index};
use crate::stream::{Decode, Encode};

crate::number::number_stream! {
    #[doc = include_str!("../../doc/dynamic-count.md")]
    ///
    /// Indices run from 1 to this number.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3.1 … 3.4.
    ///
    /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::dynamic::DynamicCount;
    ///
    /// assert_eq!(DynamicCount::decode(&[1, 0, 0, 0])?, DynamicCount(1));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Debug)]
    DynamicCount, DynamicCount, dynamic_count::COUNT
}

#[doc = include_str!("../../doc/dynamic-index.md")]
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
/// [`OutOfRange`](crate::ErrorKind::OutOfRange) or [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::dynamic::DynamicIndex;
/// use ads_cnc::{Decode, Encode};
///
/// assert_eq!(DynamicIndex(1).encode(&mut [0; 4])?, [1, 0, 0, 0]);
/// assert_eq!(
///     DynamicIndex::decode(&[0; 4]).unwrap_err().to_string(),
///     "dynamic-index: index at offset 0: out of range, at least 1 expected, 0 found"
/// );
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DynamicIndex(pub u32);

impl DynamicIndex {
    /// Refuses what no decoder would accept.
    pub(crate) const fn check(self) -> Result<Self, Error> {
        match self.0 {
            0 => Err(Error::new(ErrorKind::OutOfRange, dynamic_index::INDEX, 0, 1, 0)),
            _ => Ok(self),
        }
    }
}

impl<'a> Decode<'a> for DynamicIndex {
    const STREAM: Stream = Stream::DynamicIndex;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::ending(Self::STREAM, bytes);
        let index = Self(input.u32(dynamic_index::INDEX)?).check()?;
        input.finish()?;
        Ok(index)
    }
}

impl Encode for DynamicIndex {
    fn encoded_len(&self) -> usize {
        4
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        self.check()?;
        Writer::copy(Self::STREAM, &self.0.to_le_bytes(), buf)
    }
}

#[doc = include_str!("../../doc/dynamic-value.md")]
///
/// The bits are kept, those of a NaN too; two values are equal if their bits are.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3.1 … 3.4.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
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

    /// The value's bits.
    pub const fn to_bits(self) -> u64 {
        self.bits
    }
}

impl From<f64> for DynamicValue {
    fn from(value: f64) -> Self {
        Self { bits: value.to_bits() }
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
        let bits: &U64 = Reader::all(Self::STREAM, bytes)?;
        Ok(Self { bits: bits.get() })
    }
}

impl Encode for DynamicValue {
    fn encoded_len(&self) -> usize {
        8
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::copy(Self::STREAM, &self.bits.to_le_bytes(), buf)
    }
}
