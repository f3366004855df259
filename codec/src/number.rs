//! Codes, which are numbers with names, and the conversions of types that contain one number.

/// Declares a code: a number with names for some values. Other values are kept.
///
/// `in hex` displays the name and the number in hexadecimal; `in error` displays the number in
/// hexadecimal and decimal, and the name, as an ADS error.
macro_rules! code {
    (
        $(#[$doc:meta])*
        $code:ident($number:ident) $(in $form:ident)? {
            $( $(#[$name_doc:meta])* $name:ident = $value:expr; )+
        }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $code(pub $number);

        impl $code {
            $(
                $(#[$name_doc])*
                pub const $name: Self = Self($value);
            )+

            /// The name of the code; `None` for a number without a constant of this type.
            pub const fn name(self) -> Option<&'static str> {
                match self {
                    $( Self::$name => Some(stringify!($name)), )+
                    _ => None,
                }
            }
        }

        $crate::number::code! { @shown $code $($form)? }
        $crate::number::from_number!($number: $code);
    };
    (@shown $code:ident) => {
        /// Displays the name, or the number if it has no name.
        impl core::fmt::Display for $code {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match self.name() {
                    Some(name) => f.write_str(name),
                    None => core::fmt::Display::fmt(&self.0, f),
                }
            }
        }

        impl core::fmt::Debug for $code {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "{} {}", self.0, self.name().unwrap_or("(unknown)"))
            }
        }
    };
    (@shown $code:ident hex) => {
        /// Displays the name and the number, or only the number if it has no name.
        impl core::fmt::Display for $code {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match self.name() {
                    Some(name) => write!(f, "{name} ({:#x})", self.0),
                    None => write!(f, "{:#x}", self.0),
                }
            }
        }

        $crate::number::code! { @hex $code }
    };
    (@shown $code:ident error) => {
        /// Displays the number in hexadecimal and decimal, and the name if it has one. The text
        /// begins with `ADS error`, so that it is clear when displayed as a `Box<dyn Error>`.
        impl core::fmt::Display for $code {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "ADS error {0:#x} ({0}", self.0)?;
                match self.name() {
                    Some(name) => write!(f, ", {name})"),
                    None => f.write_str(")"),
                }
            }
        }

        $crate::number::code! { @hex $code }
    };
    (@hex $code:ident) => {
        /// Formats the number, without the name.
        impl core::fmt::LowerHex for $code {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                core::fmt::LowerHex::fmt(&self.0, f)
            }
        }

        impl core::fmt::Debug for $code {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "{:#x} {}", self.0, self.name().unwrap_or("(unknown)"))
            }
        }
    };
}

/// Implements the conversions of a type that contains one number, such as a code, from the number
/// and back.
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

/// Implements `Display`, `Debug` and the conversions for a stream that is a single number.
macro_rules! shown {
    ($name:ident) => {
        $crate::number::shown!(u32: $name);
    };
    ($number:ident: $name:ident) => {
        impl core::fmt::Display for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                self.0.fmt(f)
            }
        }

        impl core::fmt::Debug for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_tuple(stringify!($name)).field(&self.0).finish()
            }
        }

        $crate::number::from_number!($number: $name);
    };
}

pub(crate) use {code, from_number, shown};
