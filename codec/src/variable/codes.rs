//! Codes of a description; unknown ones stay what they are (VAR-23).

/// The type of a variable (VAR-5).
///
/// | code | type | bytes of an element |
/// |---|---|---|
/// | 1 | BOOLEAN | 1 |
/// | 2 | SGN08 | 1 |
/// | 3 | UNS08 | 1 |
/// | 4 | SGN16 | 2 |
/// | 5 | UNS16 | 2 |
/// | 6 | SGN32 | 4 |
/// | 7 | UNS32 | 4 |
/// | 8 | REAL64 | 8 |
/// | 9 | STRING | variable |
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
///
/// ```
/// use ads_cnc::VariableType;
///
/// assert_eq!(VariableType::REAL64.element_size(), Some(8));
/// assert_eq!(VariableType(77).name(), None);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct VariableType(pub u32);

impl VariableType {
    /// One byte, 0 or 1.
    pub const BOOLEAN: Self = Self(1);
    /// Signed, one byte.
    pub const SGN08: Self = Self(2);
    /// Unsigned, one byte.
    pub const UNS08: Self = Self(3);
    /// Signed, two bytes.
    pub const SGN16: Self = Self(4);
    /// Unsigned, two bytes.
    pub const UNS16: Self = Self(5);
    /// Signed, four bytes.
    pub const SGN32: Self = Self(6);
    /// Unsigned, four bytes.
    pub const UNS32: Self = Self(7);
    /// IEEE 754 binary64.
    pub const REAL64: Self = Self(8);
    /// CP1252 text.
    pub const STRING: Self = Self(9);

    /// The type's name, if the manuals have the code.
    pub const fn name(self) -> Option<&'static str> {
        Some(match self {
            Self::BOOLEAN => "BOOLEAN",
            Self::SGN08 => "SGN08",
            Self::UNS08 => "UNS08",
            Self::SGN16 => "SGN16",
            Self::UNS16 => "UNS16",
            Self::SGN32 => "SGN32",
            Self::UNS32 => "UNS32",
            Self::REAL64 => "REAL64",
            Self::STRING => "STRING",
            _ => return None,
        })
    }

    /// Bytes of one element, if the type has a fixed size.
    pub const fn element_size(self) -> Option<u32> {
        match self.data_type() {
            Some(data_type) => data_type.size(),
            None => None,
        }
    }
}

/// Whether a variable may be written (VAR-6).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
///
/// ```
/// assert_eq!(ads_cnc::VariableAccess(2), ads_cnc::VariableAccess::READ_WRITE);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct VariableAccess(pub u32);

impl VariableAccess {
    /// Reading only.
    pub const READ_ONLY: Self = Self(1);
    /// Reading and writing.
    pub const READ_WRITE: Self = Self(2);

    /// The code's name, if the manuals have it.
    pub const fn name(self) -> Option<&'static str> {
        match self {
            Self::READ_ONLY => Some("READ_ONLY"),
            Self::READ_WRITE => Some("READ_WRITE"),
            _ => None,
        }
    }
}

/// Whether access to a variable is synchronised (VAR-15).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8; the editions spell the second code's
/// name SYNCHRONISED and SYNCHRONIZED (E-23).
///
/// ```
/// assert_eq!(ads_cnc::Synchronisation(2), ads_cnc::Synchronisation::SYNCHRONIZED);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Synchronisation(pub u32);

impl Synchronisation {
    /// Not synchronised.
    pub const NO_SYNC: Self = Self(1);
    /// Synchronised.
    pub const SYNCHRONIZED: Self = Self(2);

    /// The code's name, if the manuals have it.
    pub const fn name(self) -> Option<&'static str> {
        match self {
            Self::NO_SYNC => Some("NO_SYNC"),
            Self::SYNCHRONIZED => Some("SYNCHRONIZED"),
            _ => None,
        }
    }
}

/// Where a variable is valid (VAR-15).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8.
///
/// ```
/// assert_eq!(ads_cnc::Validity(1), ads_cnc::Validity::CHANNEL);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Validity(pub u32);

impl Validity {
    /// In its channel.
    pub const CHANNEL: Self = Self(1);
    /// In all channels.
    pub const GLOBAL: Self = Self(2);

    /// The code's name, if the manuals have it.
    pub const fn name(self) -> Option<&'static str> {
        match self {
            Self::CHANNEL => Some("CHANNEL"),
            Self::GLOBAL => Some("GLOBAL"),
            _ => None,
        }
    }
}

/// Shows a code as number and name.
macro_rules! debug_code {
    ($code:ident) => {
        impl core::fmt::Debug for $code {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "{} {}", self.0, self.name().unwrap_or("(unknown)"))
            }
        }
    };
}

debug_code!(VariableType);
debug_code!(VariableAccess);
debug_code!(Synchronisation);
debug_code!(Validity);

crate::number::from_number!(VariableType, VariableAccess, Synchronisation, Validity);
