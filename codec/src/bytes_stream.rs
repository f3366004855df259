//! Streams that are bytes and nothing more.

/// Declares a stream of `min` to `max` bytes that mean nothing by themselves, borrowed and owned.
macro_rules! bytes_stream {
    (
        $(#[$doc:meta])*
        $view:ident, $(#[$owned_doc:meta])* $owned:ident, $stream:ident {
            $(#[$field_doc:meta])*
            bytes: $field:path, $min:literal to $max:expr
        }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $view<'a> {
            $(#[$field_doc])*
            pub bytes: &'a [u8],
        }

        impl<'a> $crate::stream::Decode<'a> for $view<'a> {
            const STREAM: $crate::layout::Stream = $crate::layout::Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, $crate::error::Error> {
                let max = $crate::bytes::to_u32($max);
                $crate::bytes::Reader::only($field, $min, max, bytes).map(|bytes| Self { bytes })
            }
        }

        impl $crate::stream::Encode for $view<'_> {
            fn encoded_len(&self) -> usize {
                self.bytes.len()
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], $crate::error::Error> {
                use $crate::stream::Decode as _;
                let bytes = Self::decode(self.bytes)?.bytes;
                $crate::bytes::Writer::fill(Self::STREAM, bytes.len(), buf, |out| out.put(bytes))
            }
        }

        #[doc = concat!("[`", stringify!($view), "`], owned.")]
        $(#[$owned_doc])*
        #[cfg(feature = "alloc")]
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        pub struct $owned {
            $(#[$field_doc])*
            pub bytes: alloc::vec::Vec<u8>,
        }

        #[cfg(feature = "alloc")]
        const _: () = {
            #[binrw::binread]
            #[br(little)]
            struct Wire {
                #[br(parse_with = $crate::bridge::rest)]
                bytes: alloc::vec::Vec<u8>,
            }

            impl<'a> $crate::stream::Decode<'a> for $owned {
                const STREAM: $crate::layout::Stream = $crate::layout::Stream::$stream;

                fn decode(bytes: &'a [u8]) -> Result<Self, $crate::error::Error> {
                    $view::decode(bytes)?;
                    let Wire { bytes } = $crate::bridge::read(Self::STREAM, bytes)?;
                    Ok(Self { bytes })
                }
            }

            impl $owned {
                /// The bytes, borrowed.
                #[inline]
                pub fn as_ref(&self) -> $view<'_> {
                    $view { bytes: &self.bytes }
                }
            }

            $crate::stream::encode_as_ref!($owned);
        };
    };
}

pub(crate) use bytes_stream;
