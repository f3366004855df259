//! Replies to Read, Write and ReadWrite.

use super::AdsError;
use crate::bytes::{Reader, Writer, to_u32, to_usize};
use crate::declare::stream;
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream};
use crate::stream::{Decode, Encode};

stream! {
    /// An ADS Write reply.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::ads::{AdsError, WriteReply};
    /// use ads_cnc::Decode;
    ///
    /// assert_eq!(WriteReply::decode(&[4, 7, 0, 0])?.result, AdsError::INVALID_ACCESS);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    WriteReply "write-reply", "ADS Write, reply", "ADS-2", max 4;
    struct WriteReply {
        @0 result: UNS32 as AdsError, "ADS-4", "ADS error number, 0 for success";
    }
}

/// The fields result, length and data of a reply, which are the same for Read and ReadWrite.
const fn fields(stream: Stream) -> [Field; 3] {
    const RESULT: Field = Field::of::<ReadReplyRef<'_>>("result");
    const LENGTH: Field = Field::of::<ReadReplyRef<'_>>("length");
    const DATA: Field = Field::of::<ReadReplyRef<'_>>("data");
    [RESULT.in_stream(stream), LENGTH.in_stream(stream), DATA.in_stream(stream)]
}

const LENGTH_AT: u32 = Stream::ReadReply.layout().offset("length");
const DATA_AT: u32 = Stream::ReadReply.layout().offset("data");

fn encoded_len(data: Option<&[u8]>) -> usize {
    data.map_or(to_usize(LENGTH_AT), |data| data.len().saturating_add(to_usize(DATA_AT)))
}

fn decode(stream: Stream, bytes: &[u8]) -> Result<(AdsError, Option<&[u8]>), Error> {
    let [result_field, length_field, data_field] = fields(stream);
    let mut input = Reader::new(stream, bytes)?;
    let result = AdsError(input.u32(result_field)?);
    if !result.is_ok() && input.is_empty() {
        return Ok((result, None));
    }
    let length = input.u32(length_field)?;
    let data = input.take(data_field, length)?;
    input.finish()?;
    Ok((result, Some(data)))
}

fn encode<'b>(
    stream: Stream,
    result: AdsError,
    data: Option<&[u8]>,
    buf: &'b mut [u8],
) -> Result<&'b [u8], Error> {
    let Some(data) = data else {
        // A reply may end after its result only if the result is an error (ADS-6).
        if result.is_ok() {
            let [_, length_field, _] = fields(stream);
            return Err(Error::new(ErrorKind::Truncated, length_field, LENGTH_AT, 4, 0));
        }
        return Writer::copy(stream, &result.0.to_le_bytes(), buf);
    };
    Writer::run(stream, encoded_len(Some(data)), buf, |out| {
        out.u32(result.0);
        out.u32(to_u32(data.len()));
        out.put(data);
    })
}

/// Declares both types of a reply with data: result, the length of the data, the data.
macro_rules! reply_with_data {
    ($doc:literal, $stream:ident, $ref:ident, $owned:ident) => {
        #[doc = include_str!($doc)]
        ///
        /// A reply whose result is not 0 may end after the result, without data (ADS-6).
        ///
        /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
        ///
        /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
        /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
        ///
        /// ```
        #[doc = concat!("use ads_cnc::{Decode, ads::", stringify!($ref), "};")]
        ///
        #[doc = concat!("let reply = ", stringify!($ref), "::decode(&[0, 0, 0, 0, 1, 0, 0, 0, 9])?;")]
        /// assert!(reply.result.is_ok());
        /// assert_eq!(reply.data, Some(&[9][..]));
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $ref<'a> {
            /// ADS error number.
            pub result: AdsError,
            /// The data; `None` if the reply ends after the result.
            pub data: Option<&'a [u8]>,
        }

        impl<'a> Decode<'a> for $ref<'a> {
            const STREAM: Stream = Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
                let (result, data) = decode(Self::STREAM, bytes)?;
                Ok(Self { result, data })
            }
        }

        impl Encode for $ref<'_> {
            fn encoded_len(&self) -> usize {
                encoded_len(self.data)
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
                encode(Self::STREAM, self.result, self.data, buf)
            }
        }

        #[doc = concat!("[`", stringify!($ref), "`], owned.")]
        ///
        /// ```
        #[doc = concat!("use ads_cnc::{Encode, ads::{AdsError, ", stringify!($owned), "}};")]
        ///
        /// let (result, data) = (AdsError::NO_ERROR, Some(vec![9]));
        #[doc = concat!("let reply = ", stringify!($owned), " { result, data };")]
        /// assert_eq!(reply.encode_to_vec()?, [0, 0, 0, 0, 1, 0, 0, 0, 9]);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        #[cfg(feature = "alloc")]
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $owned {
            /// ADS error number.
            pub result: AdsError,
            /// The data; `None` if the reply ends after the result.
            pub data: Option<alloc::vec::Vec<u8>>,
        }

        #[cfg(feature = "alloc")]
        impl From<$ref<'_>> for $owned {
            fn from(reply: $ref<'_>) -> Self {
                Self { result: reply.result, data: reply.data.map(<[u8]>::to_vec) }
            }
        }

        #[cfg(feature = "alloc")]
        impl $ref<'_> {
            /// Copies the fields.
            pub fn to_owned(&self) -> $owned {
                (*self).into()
            }
        }

        #[cfg(feature = "alloc")]
        impl<'a> Decode<'a> for $owned {
            const STREAM: Stream = Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
                $ref::decode(bytes).map(Self::from)
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

reply_with_data!("../../doc/read-reply.md", ReadReply, ReadReplyRef, ReadReply);

reply_with_data!(
    "../../doc/read-write-reply.md",
    ReadWriteReply,
    ReadWriteReplyRef,
    ReadWriteReply
);
