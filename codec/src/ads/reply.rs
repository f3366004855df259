//! Replies of the three services.

use super::AdsError;
use crate::bytes::{Reader, Writer, to_u32};
use crate::declare::stream;
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field;
use crate::stream::{Decode, Encode};

stream! {
    /// An ADS Write reply.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
    ///
    /// `decode` rejects bytes with [`Truncated`](crate::ErrorKind::Truncated) or
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

/// Declares a reply with data in both readings: result, the length of the data, the data.
macro_rules! reply_with_data {
    ($doc:literal, $stream:ident, $fields:ident, $ref:ident, $owned:ident) => {
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
        /// assert!(reply.result.is_ok());
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
                if !result.is_ok() && input.is_empty() {
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
                    if self.result.is_ok() {
                        let (kind, field) =
                            (crate::error::ErrorKind::Truncated, field::$fields::LENGTH);
                        return Err(Error::new(kind, field, 4, 4, 0));
                    }
                    return Writer::run(Self::STREAM, 4, buf, |out| out.u32(self.result.0));
                };
                Writer::run(Self::STREAM, data.len().saturating_add(8), buf, |out| {
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
        /// let (result, data) = (AdsError::NO_ERROR, Some(vec![9]));
        #[doc = concat!("let reply = ", stringify!($owned), " { result, data };")]
        /// assert_eq!(reply.encode_to_vec()?, [0, 0, 0, 0, 1, 0, 0, 0, 9]);
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

reply_with_data!("../../doc/read-reply.md", ReadReply, read_reply, ReadReplyRef, ReadReply);

reply_with_data!(
    "../../doc/read-write-reply.md",
    ReadWriteReply,
    read_write_reply,
    ReadWriteReplyRef,
    ReadWriteReply
);
