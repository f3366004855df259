//! The classes of the SDA and GEO tasks, and their index groups.

use core::fmt;

use super::group::{ELEMENT, low};
use super::{Addressing, Channel, IndexGroup, Spindle};

/// The parts of a group of the SDA and GEO tasks (ADR-5, ADR-6).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.1.
///
/// ```
/// use ads_cnc::address::{Attribute, Class, ClassGroup};
///
/// assert_eq!(ClassGroup::object_address(Class::Hld).index_group().get(), 0x12_3900);
/// assert_eq!(ClassGroup::object_address(Class::Spindle).index_group().get(), 0x2_5900);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClassGroup {
    /// Logical or by index; [`Class::Spindle`] knows only the latter.
    pub addressing: Addressing,
    /// Which class of the CNC.
    pub class: Class,
    /// Which attribute of its elements.
    pub attribute: Attribute,
    /// Channel or spindle; 0 for the platform and for queries of an object address.
    pub instance: u8,
}

impl ClassGroup {
    /// The group in which the address of a class's instances is asked for; it does not name an instance itself.
    pub const fn object_address(class: Class) -> Self {
        Self { addressing: class.best(), class, attribute: Attribute::ObjectAddress, instance: 0 }
    }

    /// The group these parts add up to. A spindle's is by index whatever `addressing` says.
    pub const fn index_group(self) -> IndexGroup {
        let addressing = match self.class {
            Class::Spindle => Addressing::Index,
            _ => self.addressing,
        };
        let sum = addressing.bits() | ELEMENT | self.class.bits() | self.attribute.bits();
        IndexGroup::new(sum | low(self.instance))
    }
}

/// A class of the CNC (ADR-5).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.1.
///
/// ```
/// use ads_cnc::address::{Attribute, Channel, Class};
///
/// assert_eq!(Channel::new(1)?.class(Class::Decoder, Attribute::Content).get(), 0x12_2301);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    /// Position controller, once in a CNC, with the platform's axes.
    PositionController,
    /// Interpolator of a channel.
    Interpolator,
    /// Decoder of a channel.
    Decoder,
    /// High-level driver of a channel; that of the first has the platform's axes too.
    Hld,
    /// Path preparation of a channel.
    PathPreparation,
    /// Spindle.
    Spindle,
}

impl Class {
    /// All of them, in the order of their bits.
    pub const ALL: [Self; 6] = [
        Self::PositionController,
        Self::Interpolator,
        Self::Decoder,
        Self::Hld,
        Self::PathPreparation,
        Self::Spindle,
    ];

    const fn bits(self) -> u32 {
        match self {
            Self::PositionController => 0x0000,
            Self::Interpolator => 0x1000,
            Self::Decoder => 0x2000,
            Self::Hld => 0x3000,
            Self::PathPreparation => 0x4000,
            Self::Spindle => 0x5000,
        }
    }

    const fn best(self) -> Addressing {
        match self {
            Self::Spindle => Addressing::Index,
            _ => Addressing::Logical,
        }
    }

    /// That with the bits `number`, which are known to be those of one.
    pub(super) const fn from_number(number: u8) -> Self {
        match number {
            0 => Self::PositionController,
            1 => Self::Interpolator,
            2 => Self::Decoder,
            3 => Self::Hld,
            4 => Self::PathPreparation,
            _ => Self::Spindle,
        }
    }

    /// Equality that the compiler can see to.
    pub(crate) const fn is(self, other: Self) -> bool {
        self.bits() == other.bits()
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::PositionController => "position controller",
            Self::Interpolator => "interpolator",
            Self::Decoder => "decoder",
            Self::Hld => "HLD",
            Self::PathPreparation => "path preparation",
            Self::Spindle => "spindle",
        })
    }
}

/// An attribute of an element (ADR-6).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
///
/// ```
/// use ads_cnc::address::{Attribute, Channel, Class};
///
/// assert_eq!(Channel::new(1)?.class(Class::Hld, Attribute::Name).get(), 0x12_3401);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Attribute {
    /// The content, of the element's type.
    Content,
    /// The name, a string.
    Name,
    /// The type's name, a string.
    Type,
    /// The length of the content in bytes.
    Length,
    /// The unit, a string.
    Unit,
    /// Whether write access is permitted, a BOOLEAN (E-11).
    WriteFlag,
    /// Channel and axis in, index group and index offset out.
    ObjectAddress,
}

impl Attribute {
    /// All of them, in the order of their bits.
    pub const ALL: [Self; 7] = [
        Self::Content,
        Self::Name,
        Self::Type,
        Self::Length,
        Self::Unit,
        Self::WriteFlag,
        Self::ObjectAddress,
    ];

    /// The attribute's part of the sum, the base 0x300 included.
    pub(super) const fn bits(self) -> u32 {
        match self {
            Self::Content => 0x300,
            Self::Name => 0x400,
            Self::Type => 0x500,
            Self::Length => 0x600,
            Self::Unit => 0x700,
            Self::WriteFlag => 0x800,
            Self::ObjectAddress => 0x900,
        }
    }

    /// That with the bits `table`, which are known to be those of one.
    pub(super) const fn from_table(table: u8) -> Self {
        match table {
            3 => Self::Content,
            4 => Self::Name,
            5 => Self::Type,
            6 => Self::Length,
            7 => Self::Unit,
            8 => Self::WriteFlag,
            _ => Self::ObjectAddress,
        }
    }

    /// Equality that the compiler can see to.
    pub(crate) const fn is(self, other: Self) -> bool {
        self.bits() == other.bits()
    }
}

impl fmt::Display for Attribute {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Content => "content",
            Self::Name => "name",
            Self::Type => "type",
            Self::Length => "length",
            Self::Unit => "unit",
            Self::WriteFlag => "write flag",
            Self::ObjectAddress => "object address",
        })
    }
}

impl Channel {
    /// The group of this channel's part of a class.
    pub const fn class(self, class: Class, attribute: Attribute) -> IndexGroup {
        let (addressing, instance) = (self.addressing(), self.number());
        ClassGroup { addressing, class, attribute, instance }.index_group()
    }
}

impl Spindle {
    /// The group of this spindle's elements.
    pub const fn class(self, attribute: Attribute) -> IndexGroup {
        let (addressing, class) = (Addressing::Index, Class::Spindle);
        ClassGroup { addressing, class, attribute, instance: self.index() }.index_group()
    }
}
