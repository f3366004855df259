//! The traits of the streams, [`Decode`] and [`Encode`], and the empty stream, [`NoData`].

use crate::bytes::{Reader, to_usize};
use crate::error::Error;
use crate::layout::{Size, Stream};

/// Decodes a stream.
///
/// A type `XRef`, such as [`DescriptionRef`](crate::DescriptionRef), borrows from the bytes and
/// never allocates; a type `X`, such as `Description`, owns its data. Both types of a stream accept
/// the same bytes and reject all other bytes with the same [`Error`].
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.
///
/// ```
/// use ads_cnc::{Decode, Handle};
///
/// assert_eq!(Handle::STREAM.layout().name, "variable-handle");
/// assert_eq!(Handle::decode(&[4, 0, 0, 2])?, Handle(0x2000004));
/// assert_eq!(
///     Handle::decode(&[4, 0, 0]).unwrap_err().to_string(),
///     "variable-handle: handle at offset 0: truncated, expected 4 bytes, found 3"
/// );
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[diagnostic::on_unimplemented(
    note = "the type that borrows is `XRef<'a>`, the type that owns its data is `X`",
    note = "for content of your own, implement `Decode` with `value::Reader`"
)]
pub trait Decode<'a>: Sized {
    /// The stream that this type decodes. [`Stream::layout`] returns its field table.
    const STREAM: Stream;

    /// Decodes the stream, which must have exactly the length of `bytes`.
    ///
    /// # Errors
    /// A fault in the bytes, with its field and offset.
    fn decode(bytes: &'a [u8]) -> Result<Self, Error>;

    /// Decodes the stream at the front of the bytes, and returns the remaining bytes.
    ///
    /// A stream of fixed fields ends after its last field; a stream whose last field is a list, or
    /// data with a length, ends after its counted items. A stream that ends in text of variable
    /// length, in data without a length or in records without a count extends to the end of the
    /// bytes. An [`ElementLength`](crate::sda::ElementLength) consists of the first four bytes, or
    /// of all bytes if there are fewer. Only if no bytes follow, an
    /// [`ExtendedReply`](crate::ExtendedReply) is empty, and an ADS reply ends after its result.
    ///
    /// ```
    /// use ads_cnc::{Decode, Handle, HandleReadRef, U32List};
    ///
    /// let bytes = [4, 0, 0, 2, 1, 0, 0, 0, 9, 0, 0, 0, 0xFF];
    /// let (read, rest) = HandleReadRef::decode_prefix(&bytes)?;
    /// assert_eq!((read.handle, read.indices), (Handle(0x2000004), U32List::from(&[9])));
    /// assert_eq!(rest, [0xFF]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`decode`](Self::decode). [`Trailing`](crate::ErrorKind::Trailing) is only possible
    /// for a stream that extends to the end of the bytes.
    ///
    /// # For implementors
    /// By default, a type whose [`STREAM`](Self::STREAM) is [`Stream::Content`] extends to the end
    /// of the bytes. Override this method if the content itself determines its end.
    fn decode_prefix(bytes: &'a [u8]) -> Result<(Self, &'a [u8]), Error> {
        let (stream, rest) =
            bytes.split_at_checked(prefix(Self::STREAM, bytes)).unwrap_or((bytes, &[]));
        Self::decode(stream).map(|decoded| (decoded, rest))
    }
}

/// The length of the stream at the front of `bytes`; if the stream is truncated, that of `bytes`.
fn prefix(stream: Stream, bytes: &[u8]) -> usize {
    let layout = stream.layout();
    let (mut at, mut count) = (0_usize, 0);
    for field in layout.fields {
        let rest = bytes.get(at..).unwrap_or_default();
        let len = match field.size {
            _ if layout.repeats => rest.len(),
            Size::FixedOnSuccess(_) | Size::OptionalFixed(_) if rest.is_empty() => break,
            Size::Items { each, .. } => to_usize(count).saturating_mul(to_usize(each)),
            Size::CStringPrefix { .. } => {
                rest.iter().position(|&byte| byte == 0).unwrap_or(rest.len()).saturating_add(1)
            }
            Size::Uns8To32 => 4,
            Size::Fixed(_)
            | Size::FixedOnSuccess(_)
            | Size::OptionalFixed(_)
            | Size::Padded(_)
            | Size::NonZero => to_usize(field.size.fixed()),
            Size::CString { .. }
            | Size::TextAndTail { .. }
            | Size::OptionalNul { .. }
            | Size::Rest { .. } => rest.len(),
        };
        count = rest.first_chunk().map_or(0, |number| u32::from_le_bytes(*number));
        at = at.saturating_add(len).min(bytes.len());
    }
    at
}

/// Encodes a stream. A decoded value encodes to the same bytes.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.
///
/// ```
/// use ads_cnc::{Encode, ErrorKind, Handle};
///
/// let handle = Handle(0x2000004);
/// assert_eq!(handle.encoded_len(), 4);
/// assert_eq!(handle.encode(&mut [0; 8])?, [4, 0, 0, 2]);
/// assert_eq!(handle.encode(&mut [0; 3]).unwrap_err().kind(), ErrorKind::BufferTooSmall);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
pub trait Encode {
    /// The number of bytes that [`encode`](Self::encode) writes.
    fn encoded_len(&self) -> usize;

    /// Writes the stream to the front of `buf` and returns the bytes written.
    ///
    /// # Errors
    /// A value that the decoder would reject, or a buffer that is too small. On error, nothing is written.
    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error>;

    /// Encodes the stream into a new vector.
    ///
    /// # Errors
    /// A value that the decoder would reject, or (only for an encoder of your own) a stream that is
    /// longer than any frame of this crate.
    #[cfg(feature = "alloc")]
    fn encode_to_vec(&self) -> Result<alloc::vec::Vec<u8>, Error> {
        // No encoder of this crate writes more than `LEN_MAX` bytes, so allocate at most this
        // number.
        let len = self.encoded_len().min(crate::ads::FrameRef::LEN_MAX);
        let mut bytes = alloc::vec![0; len];
        self.encode(&mut bytes)?;
        Ok(bytes)
    }
}

/// The reply of a function that returns no data (VAR-17).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.6, 4.3.7 and 4.3.11.
///
/// `decode` can fail with [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::{Decode, NoData};
///
/// assert_eq!(NoData::decode(&[])?, NoData);
/// assert!(NoData::decode(&[0]).is_err());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct NoData;

impl<'a> Decode<'a> for NoData {
    const STREAM: Stream = Stream::NoData;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        Reader::exact(Self::STREAM, bytes).map(|[]: &[u8; 0]| Self)
    }
}

impl Encode for NoData {
    fn encoded_len(&self) -> usize {
        0
    }

    fn encode<'b>(&self, _: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Ok(&[])
    }
}

/// Implements [`Encode`] for an owned type through its borrowed type.
macro_rules! encode_as_ref {
    ($owned:ident) => {
        impl $crate::stream::Encode for $owned {
            fn encoded_len(&self) -> usize {
                $crate::stream::Encode::encoded_len(&self.as_ref())
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], $crate::error::Error> {
                $crate::stream::Encode::encode(&self.as_ref(), buf)
            }
        }
    };
}

pub(crate) use encode_as_ref;
