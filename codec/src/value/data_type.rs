//! One list of types for variables, objects and elements.

use core::fmt;

use crate::text::CncStr;
use crate::variable::VariableType;

/// The type of a value of a variable, an object or an element.
///
/// | variables (code), elements | objects | bytes |
/// |---|---|---|
/// | BOOLEAN (1) | BOOL | 1 |
/// | SGN08 (2) | SINT | 1 |
/// | UNS08 (3) | BYTE | 1 |
/// | SGN16 (4) | INT | 2 |
/// | UNS16 (5) | WORD | 2 |
/// | SGN32 (6) | DINT | 4 |
/// | UNS32 (7) | DWORD | 4 |
/// | – | LINT | 8 |
/// | – | LWORD | 8 |
/// | REAL32 | REAL | 4 |
/// | REAL64 (8) | LREAL | 8 |
/// | STRING (9) | STRING | variable |
///
/// That BYTE, WORD, DWORD and LWORD are unsigned is assumed; the manuals have no sizes (GEN-5).
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
#[non_exhaustive]
pub enum DataType {
    /// One byte; 0 is FALSE, any other TRUE.
    Boolean,
    /// Signed, one byte.
    Sgn08,
    /// Unsigned, one byte.
    Uns08,
    /// Signed, two bytes.
    Sgn16,
    /// Unsigned, two bytes.
    Uns16,
    /// Signed, four bytes.
    Sgn32,
    /// Unsigned, four bytes.
    Uns32,
    /// Signed, eight bytes; of objects only.
    Lint,
    /// Unsigned, eight bytes; of objects only.
    Lword,
    /// IEEE 754 binary32; not of variables.
    Real32,
    /// IEEE 754 binary64.
    Real64,
    /// CP1252 text.
    String,
}

impl DataType {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 12] = [
        Self::Boolean,
        Self::Sgn08,
        Self::Uns08,
        Self::Sgn16,
        Self::Uns16,
        Self::Sgn32,
        Self::Uns32,
        Self::Lint,
        Self::Lword,
        Self::Real32,
        Self::Real64,
        Self::String,
    ];

    /// Bytes of one element, if the type has a fixed size.
    pub const fn size(self) -> Option<u32> {
        Some(match self {
            Self::Boolean | Self::Sgn08 | Self::Uns08 => 1,
            Self::Sgn16 | Self::Uns16 => 2,
            Self::Sgn32 | Self::Uns32 | Self::Real32 => 4,
            Self::Lint | Self::Lword | Self::Real64 => 8,
            Self::String => return None,
        })
    }

    /// The type's name for variables and elements; for a type that only objects have, that for objects.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Boolean => "BOOLEAN",
            Self::Sgn08 => "SGN08",
            Self::Uns08 => "UNS08",
            Self::Sgn16 => "SGN16",
            Self::Uns16 => "UNS16",
            Self::Sgn32 => "SGN32",
            Self::Uns32 => "UNS32",
            Self::Real32 => "REAL32",
            Self::Real64 => "REAL64",
            Self::Lint | Self::Lword | Self::String => self.object_name(),
        }
    }

    /// The type's name for objects.
    pub const fn object_name(self) -> &'static str {
        match self {
            Self::Boolean => "BOOL",
            Self::Sgn08 => "SINT",
            Self::Uns08 => "BYTE",
            Self::Sgn16 => "INT",
            Self::Uns16 => "WORD",
            Self::Sgn32 => "DINT",
            Self::Uns32 => "DWORD",
            Self::Lint => "LINT",
            Self::Lword => "LWORD",
            Self::Real32 => "REAL",
            Self::Real64 => "LREAL",
            Self::String => "STRING",
        }
    }

    /// The type with this name, of a variable, an object or an element.
    pub fn by_name(name: CncStr<'_>) -> Option<Self> {
        Self::ALL.into_iter().find(|known| name == known.name() || name == known.object_name())
    }

    /// The type's number in errors: a variable's code, or a number greater than those.
    pub(super) const fn number(self) -> u32 {
        match (self.var_type(), self) {
            (Some(VariableType(code)), _) => code,
            (None, Self::Lint) => 10,
            (None, Self::Lword) => 11,
            (None, _) => 12,
        }
    }

    /// The type of this number in errors.
    pub(crate) fn by_number(number: u32) -> Option<Self> {
        Self::ALL.into_iter().find(|known| known.number() == number)
    }
}

/// The [`name`](DataType::name).
impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Declares the conversions between the codes of variables' types and the types.
macro_rules! codes {
    ($( $code:ident: $type:ident; )+) => {
        impl DataType {
            /// The code of this type of variables; `None` for a type that no variable has.
            pub const fn var_type(self) -> Option<VariableType> {
                Some(match self {
                    $( Self::$type => VariableType::$code, )+
                    _ => return None,
                })
            }
        }

        impl VariableType {
            /// The type with this code; `None` for a code that is not documented.
            pub const fn data_type(self) -> Option<DataType> {
                Some(match self {
                    $( Self::$code => DataType::$type, )+
                    _ => return None,
                })
            }
        }
    };
}

codes! {
    BOOLEAN: Boolean;
    SGN08: Sgn08;
    UNS08: Uns08;
    SGN16: Sgn16;
    UNS16: Uns16;
    SGN32: Sgn32;
    UNS32: Uns32;
    REAL64: Real64;
    STRING: String;
}
