//! Streams that are one text.

/// Declares a stream that is one text, borrowed and owned. `read` is the reader's rule for the
/// field, `check` refuses what that rule would not accept.
macro_rules! text_stream {
    (
        $(#[$doc:meta])*
        $view:ident, $(#[$owned_doc:meta])* $owned:ident, $stream:ident {
            $(#[$field_doc:meta])*
            $name:ident: $field:path
        }
        read $reader:ident $args:tt, check $checker:ident $check_args:tt
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $view<'a> {
            $(#[$field_doc])*
            pub $name: $crate::text::TextRef<'a>,
        }

        impl<'a> $crate::stream::Decode<'a> for $view<'a> {
            const STREAM: $crate::layout::Stream = $crate::layout::Stream::$stream;

            fn decode(bytes: &'a [u8]) -> Result<Self, $crate::error::Error> {
                let mut input = $crate::bytes::Reader::new(Self::STREAM, bytes)?;
                let $name = $crate::text::text_stream!(@read input, $reader, $field, $args)?;
                Ok(Self { $name })
            }
        }

        impl $crate::stream::Encode for $view<'_> {
            fn encoded_len(&self) -> usize {
                self.$name.field_len()
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], $crate::error::Error> {
                use $crate::stream::Decode as _;
                let text = &self.$name;
                let len = $crate::text::text_stream!(@check text, $checker, $field, $check_args)?;
                $crate::bytes::Writer::run(Self::STREAM, len, buf, |out| text.write(out))
            }
        }

        #[doc = concat!("[`", stringify!($view), "`], owned.")]
        $(#[$owned_doc])*
        #[cfg(feature = "alloc")]
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        pub struct $owned {
            $(#[$field_doc])*
            pub $name: $crate::text::Text,
        }

        #[cfg(feature = "alloc")]
        const _: () = {
            #[binrw::binread]
            #[br(little, import(len: $crate::bridge::TextLen))]
            struct Wire {
                #[br(parse_with = $crate::bridge::text, args(len))]
                text: $crate::text::Text,
            }

            impl<'a> $crate::stream::Decode<'a> for $owned {
                const STREAM: $crate::layout::Stream = $crate::layout::Stream::$stream;

                fn decode(bytes: &'a [u8]) -> Result<Self, $crate::error::Error> {
                    let len = $view::decode(bytes)?.$name.into();
                    let Wire { text } = $crate::bridge::read_with(Self::STREAM, bytes, (len,))?;
                    Ok(Self { $name: text })
                }
            }

            impl $owned {
                /// The text, borrowed.
                #[inline]
                pub fn as_ref(&self) -> $view<'_> {
                    $view { $name: self.$name.as_ref() }
                }
            }

            $crate::stream::encode_as_ref!($owned);
        };
    };
    (@read $input:ident, $reader:ident, $field:path, ($($arg:expr),*)) => {
        $input.$reader($field $(, $arg)*)
    };
    (@check $text:expr, $checker:ident, $field:path, ($($arg:expr),*)) => {
        $text.$checker($field, 0, $($arg),*)
    };
}

pub(crate) use text_stream;
