//! The attributes of an element (SDA-4, SDA-6 … SDA-9).

use core::fmt;

use crate::bytes::{Reader, Writer};
use crate::declare::stream;
use crate::error::Error;
use crate::layout::{Field, Stream};
use crate::stream::{Decode, Encode};

stream! {
    /// The number of element types of an instance.
    ///
    /// The first element of the instance is not counted (assumed).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2. The width of the number is assumed.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::sda::ElementCount;
    ///
    /// assert_eq!(ElementCount::decode(&[9, 0, 0, 0])?, ElementCount(9));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ElementCount "element-count", "Number of element types, reply", "SDA-4", max 4;
    tuple ElementCount {
        @0 count: UNS32, "SDA-4", "element types after the first element";
    }
}

crate::number::shown!(ElementCount);

stream! {
    /// The name, type or unit of an element: a text.
    ///
    /// The text ends at its first NUL, or at the end of the reply (assumed). Bytes after the NUL are
    /// kept. An empty reply is an empty text. The read length is 256 bytes (assumed).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
    ///
    /// `decode` can fail with [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::sda::ElementTextRef;
    ///
    /// assert_eq!(ElementTextRef::decode(b"feedhold.enable\0")?.text.text(), "feedhold.enable");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ElementText "element-text", "Name, type or unit of an element, reply", "SDA-6", max 256;
    struct ElementTextRef<'a> / ElementText {
        @0 text: TEXT_AND_TAIL(0, 256), "SDA-6", "name, type or unit";
    }
}

#[doc = include_str!("../../doc/element-length.md")]
///
/// The width of the number is not documented; one, two and four bytes are accepted (assumed). A new
/// length is encoded in four bytes.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
///
/// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::sda::ElementLength;
/// use ads_cnc::{Decode, Encode};
///
/// assert_eq!(ElementLength::decode(&[8, 0])?.get(), 8);
/// assert_eq!(ElementLength::new(8).encode(&mut [0; 4])?, [8, 0, 0, 0]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "LengthByType", into = "LengthByType")
)]
pub struct ElementLength {
    length: u32,
    width: Width,
}

/// The width of the number in the stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
enum Width {
    One,
    Two,
    Four,
}

impl ElementLength {
    /// A length in bytes, encoded in four bytes.
    pub const fn new(length: u32) -> Self {
        Self { length, width: Width::Four }
    }

    /// The length of the content in bytes.
    pub const fn get(self) -> u32 {
        self.length
    }
}

/// Displays the number of bytes of the content.
impl fmt::Display for ElementLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.length.fmt(f)
    }
}

impl<'a> Decode<'a> for ElementLength {
    const STREAM: Stream = Stream::ElementLength;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        match *bytes {
            [a] => Ok(Self { length: a.into(), width: Width::One }),
            [a, b] => Ok(Self { length: u16::from_le_bytes([a, b]).into(), width: Width::Two }),
            _ => {
                let field = const { Field::of::<Self>("length") };
                Reader::number(Self::STREAM, field, bytes).map(Self::new)
            }
        }
    }
}

impl Encode for ElementLength {
    fn encoded_len(&self) -> usize {
        match self.width {
            Width::One => 1,
            Width::Two => 2,
            Width::Four => 4,
        }
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        // A length with a width of one or two bytes was created from a number of that width, so it
        // fits.
        let all = self.length.to_le_bytes();
        Writer::copy(Self::STREAM, all.get(..self.encoded_len()).unwrap_or_default(), buf)
    }
}

/// The serialised form: the length, tagged with the type that has its width.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum LengthByType {
    Uns08(u8),
    Uns16(u16),
    Uns32(u32),
}

#[cfg(feature = "serde")]
impl From<LengthByType> for ElementLength {
    fn from(length: LengthByType) -> Self {
        match length {
            LengthByType::Uns08(length) => Self { length: length.into(), width: Width::One },
            LengthByType::Uns16(length) => Self { length: length.into(), width: Width::Two },
            LengthByType::Uns32(length) => Self::new(length),
        }
    }
}

#[cfg(feature = "serde")]
impl From<ElementLength> for LengthByType {
    fn from(ElementLength { length, width }: ElementLength) -> Self {
        let [a, b, ..] = length.to_le_bytes();
        match width {
            Width::One => Self::Uns08(a),
            Width::Two => Self::Uns16(u16::from_le_bytes([a, b])),
            Width::Four => Self::Uns32(length),
        }
    }
}

#[cfg(feature = "arbitrary")]
impl<'a> arbitrary::Arbitrary<'a> for ElementLength {
    fn arbitrary(u: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
        let width = u.arbitrary()?;
        let length = match width {
            Width::One => u.arbitrary::<u8>()?.into(),
            Width::Two => u.arbitrary::<u16>()?.into(),
            Width::Four => u.arbitrary()?,
        };
        Ok(Self { length, width })
    }
}

stream! {
    /// Whether an element may be written.
    ///
    /// TRUE permits writing (section 2.2.1), although the heading in section 2.2.2 is write protection
    /// (E-11).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::sda::ElementWriteFlag;
    ///
    /// assert!(!ElementWriteFlag::decode(&[0])?.is_writable());
    /// assert_eq!(ElementWriteFlag::decode(&[1])?, ElementWriteFlag::WRITABLE);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ElementWriteFlag "element-write-flag", "Write flag of an element, reply", "SDA-9", max 1;
    tuple ElementWriteFlag {
        @0 flag: BOOLEAN, "SDA-9", "TRUE: write access is permitted";
    }
}

crate::number::shown!(u8: ElementWriteFlag);

impl ElementWriteFlag {
    /// FALSE: 0 when encoded.
    pub const READ_ONLY: Self = Self(0);
    /// TRUE: 1 when encoded.
    pub const WRITABLE: Self = Self(1);

    /// Whether the flag is TRUE: any byte but 0.
    pub const fn is_writable(self) -> bool {
        self.0 != 0
    }
}
