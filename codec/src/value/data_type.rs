//! The types of variables, objects and elements, declared in one table.

use core::fmt;

use crate::number::code;
use crate::text::CncStr;

/// Declares the codes of the types of variables, and [`DataType`], from one table.
///
/// In the table, the name of a type that variables do not use is a string literal.
macro_rules! data_types {
    (
        $(#[$code_doc:meta])*
        $code_type:ident;
        $(#[$doc:meta])*
        $data_type:ident;
        $(
            #[doc = $variant_doc:literal]
            $variant:ident: $($code:ident)? $($name:literal)? = $number:literal, $object:literal, $size:tt;
        )+
    ) => {
        code! {
            $(#[$code_doc])*
            $code_type(u32) { $( $( #[doc = $variant_doc] $code = $number; )? )+ }
        }

        $(#[$doc])*
        ///
        /// | name of variables and elements | number | name of objects | bytes |
        /// |---|---|---|---|
        $(
            #[doc = concat!(
                "| ", $( stringify!($code), )? $( $name, )? " | ", $number, " | ", $object, " | ",
                stringify!($size), " |"
            )]
        )+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
        #[non_exhaustive]
        pub enum $data_type { $( #[doc = $variant_doc] $variant, )+ }

        impl $data_type {
            /// All types, in the order of the table.
            pub const ALL: [Self; [$( $number ),+].len()] = [$( Self::$variant ),+];

            /// The size of one element in bytes; `None` for STRING.
            pub const fn size(self) -> Option<u32> {
                match self { $( Self::$variant => data_types!(@size $size), )+ }
            }

            /// The name of the type for variables and elements; for a type of objects only, its name
            /// for objects.
            pub const fn name(self) -> &'static str {
                match self { $( Self::$variant => concat!($( stringify!($code) )? $( $name )?), )+ }
            }

            /// The name of the type for objects.
            pub const fn object_name(self) -> &'static str {
                match self { $( Self::$variant => $object, )+ }
            }

            /// The number of the type in errors: its code for variables, or a greater number if variables
            /// do not use the type.
            pub(super) const fn number(self) -> u32 {
                match self { $( Self::$variant => $number, )+ }
            }

            /// The code of the type for variables; `None` for a type that variables do not use.
            pub const fn var_type(self) -> Option<$code_type> {
                Some(match self {
                    $( $( Self::$variant => $code_type::$code, )? )+
                    _ => return None,
                })
            }
        }

        impl $code_type {
            /// The type with this code; `None` for a code that is not documented.
            pub const fn data_type(self) -> Option<$data_type> {
                Some(match self {
                    $( $( Self::$code => $data_type::$variant, )? )+
                    _ => return None,
                })
            }
        }
    };
    (@size variable) => { None };
    (@size $bytes:literal) => { Some($bytes) };
}

data_types! {
    /// The code of the type of a variable (VAR-5). The documented codes are the numbers 1 to 9 in
    /// the table of [`DataType`]; other codes are kept (VAR-23).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
    ///
    /// ```
    /// use ads_cnc::VariableType;
    ///
    /// assert_eq!(VariableType::REAL64, VariableType(8));
    /// assert_eq!(VariableType::REAL64.element_size(), Some(8));
    /// assert_eq!(VariableType::REAL64.to_string(), "REAL64");
    /// assert_eq!(VariableType(77).name(), None);
    /// ```
    VariableType;
    /// The type of a value of a variable, an object or an element.
    ///
    /// BYTE, WORD, DWORD and LWORD are assumed to be unsigned. The manuals do not define the sizes
    /// of all types (GEN-5).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.1, 2.2.1 and 4.3.2.
    ///
    /// ```
    /// use ads_cnc::value::DataType;
    /// use ads_cnc::{CncStr, Descriptor, VariableType};
    ///
    /// assert_eq!(VariableType::REAL64.data_type(), Some(DataType::Real64));
    /// assert_eq!(Descriptor::new("a", "LREAL")?.data_type(), Some(DataType::Real64));
    /// assert_eq!(DataType::by_name(CncStr::new("REAL64")?), Some(DataType::Real64));
    /// assert_eq!(DataType::by_name(CncStr::new("T_AXIS")?), None);
    /// assert_eq!(DataType::Real64.size(), Some(8));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// The number in the table is the code of the type for variables; a type that variables do not
    /// use has a number for errors only. Only objects use the types LINT and LWORD.
    DataType;
    /// One byte; 0 is FALSE, any other value is TRUE.
    Boolean: BOOLEAN = 1, "BOOL", 1;
    /// Signed, one byte.
    Sgn08: SGN08 = 2, "SINT", 1;
    /// Unsigned, one byte.
    Uns08: UNS08 = 3, "BYTE", 1;
    /// Signed, two bytes.
    Sgn16: SGN16 = 4, "INT", 2;
    /// Unsigned, two bytes.
    Uns16: UNS16 = 5, "WORD", 2;
    /// Signed, four bytes.
    Sgn32: SGN32 = 6, "DINT", 4;
    /// Unsigned, four bytes.
    Uns32: UNS32 = 7, "DWORD", 4;
    /// Signed, eight bytes; for objects only.
    Lint: "LINT" = 10, "LINT", 8;
    /// Unsigned, eight bytes; for objects only.
    Lword: "LWORD" = 11, "LWORD", 8;
    /// IEEE 754 binary32; not for variables.
    Real32: "REAL32" = 12, "REAL", 4;
    /// IEEE 754 binary64.
    Real64: REAL64 = 8, "LREAL", 8;
    /// CP1252 text.
    String: STRING = 9, "STRING", variable;
}

impl DataType {
    /// The type with this name for variables, objects or elements; `None` if there is no such type.
    pub fn by_name(name: CncStr<'_>) -> Option<Self> {
        Self::ALL.into_iter().find(|known| name == known.name() || name == known.object_name())
    }

    /// The type with this number in errors.
    pub(crate) fn by_number(number: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| known.number() == number)
    }
}

/// Displays the [`name`](DataType::name).
impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl VariableType {
    /// The size of one element in bytes; `None` for STRING and for undocumented codes.
    pub const fn element_size(self) -> Option<u32> {
        match self.data_type() {
            Some(data_type) => data_type.size(),
            None => None,
        }
    }
}
