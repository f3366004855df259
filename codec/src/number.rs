//! Codes: numbers on the wire that have names.

/// Conversions of a code from its number and back.
macro_rules! from_number {
    ($( $code:ident ),+) => { $crate::number::from_number!(u32: $($code),+); };
    ($number:ident: $( $code:ident ),+) => { $(
        impl From<$number> for $code {
            #[inline]
            fn from(number: $number) -> Self {
                Self(number)
            }
        }

        impl From<$code> for $number {
            #[inline]
            fn from(code: $code) -> Self {
                code.0
            }
        }
    )+ };
}

/// `Debug` as it is derived.
macro_rules! debug {
    ($name:ident) => {
        impl core::fmt::Debug for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_tuple(stringify!($name)).field(&self.0).finish()
            }
        }
    };
}

pub(crate) use {debug, from_number};
