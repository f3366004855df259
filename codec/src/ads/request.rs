//! Requests of the three services.

use zerocopy::IntoBytes as _;
use zerocopy::little_endian::U32;

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
