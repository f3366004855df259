//! Streams that are one number.

/// Declares a stream of one UNS32; the same type reads and owns it.
macro_rules! number_stream {
    (
        $(#[$doc:meta])*
        $name:ident, $stream:ident, $field:path
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        pub struct $name(pub u32);

        impl<'a> $crate::stream::Decode<'a> for $name {
            const STREAM: $crate::layout::Stream = $crate::layout::Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, $crate::error::Error> {
                $crate::bytes::Reader::number($field, bytes).map(Self)
            }
        }

        impl $crate::stream::Encode for $name {
            fn encoded_len(&self) -> usize {
                4
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], $crate::error::Error> {
                use $crate::stream::Decode;
                $crate::bytes::Writer::copy(Self::STREAM, &self.0.to_le_bytes(), buf)
            }
        }
    };
}

pub(crate) use number_stream;
