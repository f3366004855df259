//! The three services, as requested and as answered.

use zerocopy::IntoBytes as _;
use zerocopy::little_endian::U32;

use super::AdsError;
use crate::address::{IndexGroup, IndexOffset};
#[cfg(feature = "alloc")]
use crate::bridge;
use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field;
use crate::stream::{Decode, Encode};

#[doc = include_str!("../../doc/read-request.md")]
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::address::{IndexGroup, IndexOffset};
/// use ads_cnc::{Decode, ads::ReadRequest};
///
/// let request = ReadRequest::decode(b"\x01\x01\x13\0\x10\0\0\0\x54\0\0\0")?;
/// assert_eq!(request.index_group, IndexGroup::new(0x13_0101));
/// assert_eq!((request.index_offset.get(), request.length), (0x10, 84));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ReadRequest {
    /// Index group.
    pub index_group: IndexGroup,
    /// Index offset.
    pub index_offset: IndexOffset,
    /// The most bytes to read.
    pub length: u32,
}

impl<'a> Decode<'a> for ReadRequest {
    const STREAM: Stream = Stream::ReadRequest;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let [group, offset, length]: &[U32; 3] = Reader::all(Self::STREAM, bytes)?;
        Ok(Self {
            index_group: IndexGroup::new(group.get()),
            index_offset: IndexOffset::new(offset.get()),
            length: length.get(),
        })
    }
}

impl Encode for ReadRequest {
    fn encoded_len(&self) -> usize {
        12
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let numbers = [self.index_group.get(), self.index_offset.get(), self.length];
        Writer::copy(Self::STREAM, numbers.map(U32::new).as_bytes(), buf)
    }
}

#[doc = include_str!("../../doc/write-reply.md")]
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::ads::{AdsError, WriteReply};
/// use ads_cnc::Decode;
///
/// assert_eq!(WriteReply::decode(&[4, 7, 0, 0])?.result, AdsError::INVALID_ACCESS);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct WriteReply {
    /// ADS error number.
    pub result: AdsError,
}

impl<'a> Decode<'a> for WriteReply {
    const STREAM: Stream = Stream::WriteReply;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let result = Reader::number(field::write_reply::RESULT, bytes)?;
        Ok(Self { result: AdsError(result) })
    }
}

impl Encode for WriteReply {
    fn encoded_len(&self) -> usize {
        4
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::copy(Self::STREAM, &self.result.0.to_le_bytes(), buf)
    }
}

/// Declares a request with data in both readings: numbers, the length of the data, the data.
macro_rules! request_with_data {
    (
        $doc:literal, $example:literal, $owned_example:literal,
        $stream:ident, $fields:ident, $ref:ident, $owned:ident, $wire:ident,
        numbers $count:literal $(, $extra:ident: $extra_doc:literal)?
    ) => {
        #[doc = include_str!($doc)]
        ///
        /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
        ///
        /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
        /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
        ///
        #[doc = $example]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $ref<'a> {
            /// Index group.
            pub index_group: IndexGroup,
            /// Index offset.
            pub index_offset: IndexOffset,
            $( #[doc = $extra_doc] pub $extra: u32, )?
            /// The data.
            pub data: &'a [u8],
        }

        impl<'a> Decode<'a> for $ref<'a> {
            const STREAM: Stream = Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
                let mut input = Reader::new(Self::STREAM, bytes)?;
                let numbers: &[U32; $count] = input.fixed()?;
                let [group, offset, $( $extra, )? length] = numbers;
                let data = input.take(field::$fields::DATA, length.get())?;
                input.finish()?;
                Ok(Self {
                    index_group: IndexGroup::new(group.get()),
                    index_offset: IndexOffset::new(offset.get()),
                    $( $extra: $extra.get(), )?
                    data,
                })
            }
        }

        impl Encode for $ref<'_> {
            fn encoded_len(&self) -> usize {
                size_of::<[U32; $count]>().saturating_add(self.data.len())
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
                let front = size_of::<[U32; $count]>();
                Writer::run_behind(Self::STREAM, front, self.data.len(), buf, |out| {
                    let length = to_u32(self.data.len());
                    let (group, offset) = (self.index_group.get(), self.index_offset.get());
                    let numbers = [group, offset, $( self.$extra, )? length];
                    out.put(numbers.map(U32::new).as_bytes());
                    out.put(self.data);
                })
            }
        }

        #[doc = concat!("[`", stringify!($ref), "`], owned.")]
        ///
        #[doc = $owned_example]
        #[cfg(feature = "alloc")]
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        pub struct $owned {
            /// Index group.
            pub index_group: IndexGroup,
            /// Index offset.
            pub index_offset: IndexOffset,
            $( #[doc = $extra_doc] pub $extra: u32, )?
            /// The data.
            pub data: alloc::vec::Vec<u8>,
        }

        #[cfg(feature = "alloc")]
        #[binrw::binread]
        #[br(little)]
        struct $wire {
            index_group: u32,
            index_offset: u32,
            $( $extra: u32, )?
            #[br(temp)]
            _length: u32,
            #[br(parse_with = bridge::rest)]
            data: alloc::vec::Vec<u8>,
        }

        #[cfg(feature = "alloc")]
        impl<'a> Decode<'a> for $owned {
            const STREAM: Stream = Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
                $ref::decode(bytes)?;
                let wire: $wire = bridge::read(Self::STREAM, bytes)?;
                Ok(Self {
                    index_group: IndexGroup::new(wire.index_group),
                    index_offset: IndexOffset::new(wire.index_offset),
                    $( $extra: wire.$extra, )?
                    data: wire.data,
                })
            }
        }

        #[cfg(feature = "alloc")]
        impl $owned {
            /// The request, borrowed.
            #[inline]
            pub fn as_ref(&self) -> $ref<'_> {
                $ref {
                    index_group: self.index_group,
                    index_offset: self.index_offset,
                    $( $extra: self.$extra, )?
                    data: &self.data,
                }
            }
        }

        #[cfg(feature = "alloc")]
        crate::stream::encode_as_ref!($owned);
    };
}

/// Declares a reply with data in both readings: result, the length of the data, the data.
macro_rules! reply_with_data {
    ($doc:literal, $stream:ident, $fields:ident, $ref:ident, $owned:ident, $wire:ident) => {
        #[doc = include_str!($doc)]
        ///
        /// A reply whose result is not 0 may stop behind it (ADS-6): it has no data then.
        ///
        /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
        ///
        /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
        /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
        ///
        /// ```
        #[doc = concat!("use ads_cnc::{Decode, ads::", stringify!($ref), "};")]
        ///
        #[doc = concat!("let reply = ", stringify!($ref), "::decode(&[0, 0, 0, 0, 1, 0, 0, 0, 9])?;")]
        /// assert!(reply.result.is_none());
        /// assert_eq!(reply.data, Some(&[9][..]));
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $ref<'a> {
            /// ADS error number.
            pub result: AdsError,
            /// The data; none if the reply stops behind the result.
            pub data: Option<&'a [u8]>,
        }

        impl<'a> Decode<'a> for $ref<'a> {
            const STREAM: Stream = Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
                let mut input = Reader::new(Self::STREAM, bytes)?;
                let result = AdsError(input.u32(field::$fields::RESULT)?);
                if !result.is_none() && input.is_empty() {
                    return Ok(Self { result, data: None });
                }
                let length = input.u32(field::$fields::LENGTH)?;
                let data = input.take(field::$fields::DATA, length)?;
                input.finish()?;
                Ok(Self { result, data: Some(data) })
            }
        }

        impl Encode for $ref<'_> {
            fn encoded_len(&self) -> usize {
                self.data.map_or(4, |data| data.len().saturating_add(8))
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
                let Some(data) = self.data else {
                    // Only an error may do without; success without data has none to give.
                    if self.result.is_none() {
                        let (kind, field) =
                            (crate::error::ErrorKind::Truncated, field::$fields::LENGTH);
                        return Err(Error::new(kind, field, 4, 4, 0));
                    }
                    return Writer::run(Self::STREAM, 4, buf, |out| out.u32(self.result.0));
                };
                Writer::run_behind(Self::STREAM, 8, data.len(), buf, |out| {
                    out.u32(self.result.0);
                    out.u32(to_u32(data.len()));
                    out.put(data);
                })
            }
        }

        #[doc = concat!("[`", stringify!($ref), "`], owned.")]
        ///
        /// ```
        #[doc = concat!("use ads_cnc::{Encode, ads::{AdsError, ", stringify!($owned), "}};")]
        ///
        /// let (result, data) = (AdsError::NONE, Some(vec![9]));
        #[doc = concat!("let reply = ", stringify!($owned), " { result, data };")]
        /// assert_eq!(reply.to_vec()?, [0, 0, 0, 0, 1, 0, 0, 0, 9]);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        #[cfg(feature = "alloc")]
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        pub struct $owned {
            /// ADS error number.
            pub result: AdsError,
            /// The data; none if the reply stops behind the result.
            pub data: Option<alloc::vec::Vec<u8>>,
        }

        #[cfg(feature = "alloc")]
        #[binrw::binread]
        #[br(little)]
        struct $wire {
            result: u32,
            #[br(parse_with = bridge::counted_unless_end)]
            data: Option<alloc::vec::Vec<u8>>,
        }

        #[cfg(feature = "alloc")]
        impl<'a> Decode<'a> for $owned {
            const STREAM: Stream = Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
                $ref::decode(bytes)?;
                let $wire { result, data } = bridge::read(Self::STREAM, bytes)?;
                Ok(Self { result: AdsError(result), data })
            }
        }

        #[cfg(feature = "alloc")]
        impl $owned {
            /// The reply, borrowed.
            #[inline]
            pub fn as_ref(&self) -> $ref<'_> {
                $ref { result: self.result, data: self.data.as_deref() }
            }
        }

        #[cfg(feature = "alloc")]
        crate::stream::encode_as_ref!($owned);
    };
}

request_with_data!(
    "../../doc/write-request.md",
    "```
use ads_cnc::{Decode, ads::WriteRequestRef};

let request = WriteRequestRef::decode(b\"\\x01\\x01\\x12\\0\\x01\\0\\0\\0\\x01\\0\\0\\0\\x09\")?;
assert_eq!(request.data, [9]);
# Ok::<(), ads_cnc::Error>(())
```",
    "```
use ads_cnc::{Decode, ads::WriteRequest};

let request = WriteRequest::decode(b\"\\x01\\x01\\x12\\0\\x01\\0\\0\\0\\x01\\0\\0\\0\\x09\")?;
assert_eq!(request.data, [9]);
# Ok::<(), ads_cnc::Error>(())
```",
    WriteRequest, write_request, WriteRequestRef, WriteRequest, WriteRequestWire, numbers 3
);

request_with_data!(
    "../../doc/read-write-request.md",
    "```
use ads_cnc::{Decode, ads::ReadWriteRequestRef};

let bytes = b\"\\x01\\x23\\x12\\0\\x44\\0\\0\\0\\x04\\0\\0\\0\\x04\\0\\0\\0V.E\\0\";
let request = ReadWriteRequestRef::decode(bytes)?;
assert_eq!((request.index_offset.get(), request.read_length), (0x44, 4));
assert_eq!(request.data, b\"V.E\\0\");
# Ok::<(), ads_cnc::Error>(())
```",
    "```
use ads_cnc::{Decode, ads::ReadWriteRequest};

let bytes = b\"\\x01\\x23\\x12\\0\\x44\\0\\0\\0\\x04\\0\\0\\0\\x04\\0\\0\\0V.E\\0\";
assert_eq!(ReadWriteRequest::decode(bytes)?.data, b\"V.E\\0\");
# Ok::<(), ads_cnc::Error>(())
```",
    ReadWriteRequest, read_write_request, ReadWriteRequestRef, ReadWriteRequest,
    ReadWriteRequestWire, numbers 4, read_length: "The most bytes to read."
);

reply_with_data!(
    "../../doc/read-reply.md",
    ReadReply,
    read_reply,
    ReadReplyRef,
    ReadReply,
    ReadReplyWire
);

reply_with_data!(
    "../../doc/read-write-reply.md",
    ReadWriteReply,
    read_write_reply,
    ReadWriteReplyRef,
    ReadWriteReply,
    ReadWriteReplyWire
);
