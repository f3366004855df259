//! The attributes of an element (SDA-4, SDA-6 … SDA-9).

use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field::{element_count, element_length, element_text};
use crate::limits::TEXT_MAX;
use crate::stream::{Decode, Encode};

crate::number::number_stream! {
    #[doc = include_str!("../../doc/element-count.md")]
    ///
    /// Elements are counted from the first one on, which is not counted itself (assumed).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2. The width is assumed.
    ///
    /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::sda::ElementCount;
    ///
    /// assert_eq!(ElementCount::decode(&[9, 0, 0, 0])?, ElementCount(9));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Debug)]
    ElementCount, ElementCount, element_count::COUNT
}

crate::text::text_stream! {
    #[doc = include_str!("../../doc/element-text.md")]
    ///
    /// The text ends at its first NUL or with the reply (assumed); what follows the NUL is kept.
    /// An empty reply is an empty text, and 256 bytes are the most that are asked for (assumed).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
    ///
    /// `decode` refuses with [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::sda::ElementTextRef;
    ///
    /// assert_eq!(ElementTextRef::decode(b"feedhold.enable\0")?.text.text(), "feedhold.enable");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ElementTextRef,
    ///
    /// ```
    /// use ads_cnc::Encode;
    /// use ads_cnc::sda::ElementText;
    ///
    /// let reply = ElementText { text: "mm".parse()? };
    /// assert_eq!(reply.to_vec()?, b"mm\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ElementText, ElementText {
        /// Name, type or unit.
        text: element_text::TEXT
    }
    read open(0, to_u32(TEXT_MAX)),
    check check_open(0, to_u32(TEXT_MAX))
}

#[doc = include_str!("../../doc/element-length.md")]
///
/// How wide the number is, is not documented: one, two and four bytes are accepted, four are
/// written of a new one (assumed).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
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
pub struct ElementLength {
    length: u32,
    width: Width,
}

/// In how many bytes a length was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
enum Width {
    One,
    Two,
    Four,
}

impl ElementLength {
    /// So many bytes, in a number of four.
    pub const fn new(length: u32) -> Self {
        Self { length, width: Width::Four }
    }

    /// Bytes of the content.
    pub const fn get(self) -> u32 {
        self.length
    }
}

impl<'a> Decode<'a> for ElementLength {
    const STREAM: Stream = Stream::ElementLength;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        match *bytes {
            [a] => Ok(Self { length: a.into(), width: Width::One }),
            [a, b] => Ok(Self { length: u16::from_le_bytes([a, b]).into(), width: Width::Two }),
            _ => Reader::number(element_length::LENGTH, bytes).map(Self::new),
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
        // A narrow number is only ever read, so that nothing is cut off.
        let all = self.length.to_le_bytes();
        Writer::copy(Self::STREAM, all.get(..self.encoded_len()).unwrap_or_default(), buf)
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

#[doc = include_str!("../../doc/element-write-flag.md")]
///
/// TRUE permits writing (section 2.2.1), though the heading in section 2.2.2 speaks of protection
/// (E-11).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct ElementWriteFlag(pub u8);

impl ElementWriteFlag {
    /// FALSE, as written.
    pub const READ_ONLY: Self = Self(0);
    /// TRUE, as written.
    pub const WRITABLE: Self = Self(1);

    /// Whether this is TRUE: anything but 0, and kept.
    pub const fn is_writable(self) -> bool {
        self.0 != 0
    }
}

impl<'a> Decode<'a> for ElementWriteFlag {
    const STREAM: Stream = Stream::ElementWriteFlag;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        Reader::all(Self::STREAM, bytes).map(|&flag| Self(flag))
    }
}

impl Encode for ElementWriteFlag {
    fn encoded_len(&self) -> usize {
        1
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::copy(Self::STREAM, &[self.0], buf)
    }
}
