//! The classes of the SDA and GEO tasks, the attributes of their elements, and their index groups.

use core::fmt;

use super::group::{ELEMENT, low};
use super::{Addressing, Channel, IndexGroup, Spindle};

/// The parts of an index group of the SDA and GEO tasks (ADR-5, ADR-6).
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
    /// Logical or by index; [`Class::Spindle`] is always addressed by index.
    pub addressing: Addressing,
    /// The class.
    pub class: Class,
    /// The attribute of the elements.
    pub attribute: Attribute,
    /// The logical number or the index of the channel, or the index of the spindle; 0 for the
    /// platform and for the query of an object address.
    pub instance: u8,
}

impl ClassGroup {
    /// The group for querying the addresses of the instances of a class; its `instance` is 0.
    pub const fn object_address(class: Class) -> Self {
        Self { addressing: class.best(), class, attribute: Attribute::ObjectAddress, instance: 0 }
    }

    /// The index group with these parts. For [`Class::Spindle`], `addressing` is ignored, because
    /// spindles are always addressed by index.
    pub const fn index_group(self) -> IndexGroup {
        let addressing = match self.class {
            Class::Spindle => Addressing::Index,
            _ => self.addressing,
        };
        let sum = addressing.bits() | ELEMENT | self.class.bits() | self.attribute.bits();
        IndexGroup::new(sum | low(self.instance))
    }
}

/// Declares an enum from rows of three items: variant, number in the index group, and displayed name.
macro_rules! numbered {
    (
        $(#[$doc:meta])*
        $type:ident { $( $(#[$variant_doc:meta])* $variant:ident = $number:literal, $name:literal; )+ }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $type { $( $(#[$variant_doc])* $variant, )+ }

        impl $type {
            /// All variants, in the order of their numbers.
            pub const ALL: [Self; [$( $number ),+].len()] = [$( Self::$variant ),+];

            const fn number(self) -> u8 {
                match self { $( Self::$variant => $number, )+ }
            }

            /// The variant with this number.
            pub(super) const fn from_number(number: u8) -> Option<Self> {
                Some(match number {
                    $( $number => Self::$variant, )+
                    _ => return None,
                })
            }

            /// Whether two variants are equal; `const fn` cannot use `==`.
            pub(crate) const fn is(self, other: Self) -> bool {
                self.number() == other.number()
            }
        }

        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self { $( Self::$variant => $name, )+ })
            }
        }
    };
}

numbered! {
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
    Class {
        /// Position controller: a CNC has one position controller, to which the platform axes
        /// belong.
        PositionController = 0, "position controller";
        /// Interpolator of a channel.
        Interpolator = 1, "interpolator";
        /// Decoder of a channel.
        Decoder = 2, "decoder";
        /// High-level driver of a channel; the driver of the first channel also has the platform
        /// axes.
        Hld = 3, "HLD";
        /// Path preparation of a channel.
        PathPreparation = 4, "path preparation";
        /// Spindle.
        Spindle = 5, "spindle";
    }
}

impl Class {
    const fn bits(self) -> u32 {
        low(self.number()) << 12
    }

    /// The addressing for this class: by index for spindles, which have no logical address;
    /// otherwise logical, as the manuals recommend.
    const fn best(self) -> Addressing {
        match self {
            Self::Spindle => Addressing::Index,
            _ => Addressing::Logical,
        }
    }
}

numbered! {
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
    Attribute {
        /// The content, in the type of the element.
        Content = 3, "content";
        /// The name, a string.
        Name = 4, "name";
        /// The name of the type, a string.
        Type = 5, "type";
        /// The length of the content in bytes.
        Length = 6, "length";
        /// The unit, a string.
        Unit = 7, "unit";
        /// Whether write access is permitted, a BOOLEAN (E-11).
        WriteFlag = 8, "write flag";
        /// A query: channel and axis in the request, index group and index offset in the reply.
        ObjectAddress = 9, "object address";
    }
}

impl Attribute {
    const fn bits(self) -> u32 {
        low(self.number()) << 8
    }
}

impl Channel {
    /// The index group of an attribute of a class in this channel.
    pub const fn class(self, class: Class, attribute: Attribute) -> IndexGroup {
        let (addressing, instance) = (self.addressing(), self.number());
        ClassGroup { addressing, class, attribute, instance }.index_group()
    }
}

impl Spindle {
    /// The index group of an attribute of this spindle.
    pub const fn class(self, attribute: Attribute) -> IndexGroup {
        let (addressing, class) = (Addressing::Index, Class::Spindle);
        ClassGroup { addressing, class, attribute, instance: self.index() }.index_group()
    }
}
