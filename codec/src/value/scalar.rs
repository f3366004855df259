//! The Rust types for numbers and BOOLEAN of the CNC.

use core::fmt;

use super::DataType;

/// A Rust type for numbers or BOOLEAN: `bool`, [`Boolean`], `i8`, `u8`, `i16`, `u16`, `i32`, `u32`,
/// `i64`, `u64`, `f32` and `f64`.
///
/// ```
/// use ads_cnc::value::{DataType, Scalar};
///
/// assert_eq!(<i32 as Scalar>::TYPE, DataType::Sgn32);
/// assert_eq!(<f32 as Scalar>::TYPE, DataType::Real32);
/// ```
#[diagnostic::on_unimplemented(
    note = "the numbers of a CNC are `u8` to `u64`, `i8` to `i64`, `f32`, `f64`, `bool` and `Boolean`",
    note = "read a structure of your own with `value::Reader`"
)]
pub trait Scalar: sealed::Wire + Copy + Default + PartialEq + fmt::Debug + 'static {
    /// The CNC's type that the Rust type represents.
    const TYPE: DataType;
}

pub(super) mod sealed {
    use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

    pub trait Wire: Sized {
        /// The bytes of the number.
        type Wire: FromBytes + IntoBytes + KnownLayout + Immutable + Unaligned + Copy + 'static;

        fn from_wire(wire: Self::Wire) -> Self;

        fn to_wire(self) -> Self::Wire;
    }
}

/// Calls a macro with each type of fixed size: the variant of [`DataType`] and of
/// [`Element`](super::Element), and the Rust type.
macro_rules! numbers {
    ($macro:ident!) => {
        $macro! {
            Boolean: $crate::value::Boolean;
            Sgn08: i8;
            Uns08: u8;
            Sgn16: i16;
            Uns16: u16;
            Sgn32: i32;
            Uns32: u32;
            Lint: i64;
            Lword: u64;
            Real32: f32;
            Real64: f64;
        }
    };
}

pub(crate) use numbers;

macro_rules! items {
    ($( $data_type:ident: $item:ty; )+) => { $(
        impl Scalar for $item {
            const TYPE: DataType = DataType::$data_type;
        }

        impl sealed::Wire for $item {
            type Wire = [u8; size_of::<$item>()];

            fn from_wire(wire: [u8; size_of::<$item>()]) -> Self {
                Self::from_le_bytes(wire)
            }

            fn to_wire(self) -> [u8; size_of::<$item>()] {
                self.to_le_bytes()
            }
        }
    )+ };
}

numbers!(items!);

/// Any byte but 0 is decoded as `true`, which is encoded as 1. [`Boolean`] keeps the byte.
impl Scalar for bool {
    const TYPE: DataType = DataType::Boolean;
}

impl sealed::Wire for bool {
    type Wire = [u8; 1];

    fn from_wire([byte]: [u8; 1]) -> Self {
        byte != 0
    }

    fn to_wire(self) -> [u8; 1] {
        [self.into()]
    }
}

/// A BOOLEAN that keeps its byte: 0 is FALSE, any other value is TRUE.
///
/// An [`Element`](super::Element) contains this type instead of `bool`, so that a value encodes to the
/// bytes that it was decoded from: `bool` would change a 2 to a 1.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2, where BOOLEAN\[2\] has two bytes. It is
/// assumed that any byte but 0 is TRUE.
///
/// ```
/// use ads_cnc::value::Boolean;
///
/// assert!(Boolean(2).is_true() && Boolean(2) != Boolean::TRUE);
/// assert_eq!(Boolean::from(true), Boolean(1));
/// ```
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Boolean(pub u8);

impl Boolean {
    /// FALSE: 0 when encoded.
    pub const FALSE: Self = Self(0);
    /// TRUE: 1 when encoded.
    pub const TRUE: Self = Self(1);

    /// Whether the value is TRUE: any byte but 0.
    pub const fn is_true(self) -> bool {
        self.0 != 0
    }

    const fn from_le_bytes([byte]: [u8; 1]) -> Self {
        Self(byte)
    }

    pub(crate) const fn to_le_bytes(self) -> [u8; 1] {
        [self.0]
    }
}

impl From<bool> for Boolean {
    fn from(truth: bool) -> Self {
        Self(truth.into())
    }
}

impl From<Boolean> for bool {
    fn from(boolean: Boolean) -> Self {
        boolean.is_true()
    }
}

/// Displays TRUE or FALSE.
impl fmt::Display for Boolean {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.is_true() { "TRUE" } else { "FALSE" })
    }
}

/// Formats the byte.
impl fmt::Debug for Boolean {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}
