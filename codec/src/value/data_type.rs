//! One list of types for variables, objects and elements.

use core::fmt;

use crate::text::CncStr;
use crate::variable::VariableType;

/// The type of a value, whoever names it.
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

    /// The type's name as that of a variable or an element; of an object if no other has it.
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

    /// The type's name as that of an object.
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

    /// The type of this name, be it that of a variable, an object or an element.
    pub fn by_name(name: CncStr<'_>) -> Option<Self> {
        Self::ALL.into_iter().find(|known| name == known.name() || name == known.object_name())
    }

    /// The code of a variable's type, if a variable can have this one.
    pub const fn var_type(self) -> Option<VariableType> {
        Some(match self {
            Self::Boolean => VariableType::BOOLEAN,
            Self::Sgn08 => VariableType::SGN08,
            Self::Uns08 => VariableType::UNS08,
            Self::Sgn16 => VariableType::SGN16,
            Self::Uns16 => VariableType::UNS16,
            Self::Sgn32 => VariableType::SGN32,
            Self::Uns32 => VariableType::UNS32,
            Self::Real64 => VariableType::REAL64,
            Self::String => VariableType::STRING,
            Self::Lint | Self::Lword | Self::Real32 => return None,
        })
    }

    /// The type's number in errors: a variable's code, or one after the last of those.
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

impl VariableType {
    /// The type, if the manuals have the code.
    pub const fn data_type(self) -> Option<DataType> {
        Some(match self {
            Self::BOOLEAN => DataType::Boolean,
            Self::SGN08 => DataType::Sgn08,
            Self::UNS08 => DataType::Uns08,
            Self::SGN16 => DataType::Sgn16,
            Self::UNS16 => DataType::Uns16,
            Self::SGN32 => DataType::Sgn32,
            Self::UNS32 => DataType::Uns32,
            Self::REAL64 => DataType::Real64,
            Self::STRING => DataType::String,
            _ => return None,
        })
    }
}
