//! Index offsets.

use core::fmt;

use crate::error::{Error, ErrorKind};
use crate::layout::index_offset::{AXIS, ELEMENT};

/// An index offset: any number of 32 bits.
///
/// The manuals print two strides between the axes of a channel (E-01), and an offset does not show which
/// stride it was computed with: `0x10001` is element 1 of axis 1, or of axis 16. For axes of COM, a client
/// should use the group and offset in the object's descriptor instead of computing them (ADR-8).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1, 2.1.2, 2.2.2 and 4.2.2.
///
/// ```
/// use ads_cnc::address::{AxisStride, IndexOffset};
///
/// // The function "handle by name" of the second axis.
/// let offset = IndexOffset::for_axis(AxisStride::default(), 2, 4)?;
/// assert_eq!(offset.get(), 0x2_0004);
/// assert_eq!(offset.axis_and_element(AxisStride::X10000)?, (2, 4));
/// assert!(IndexOffset::for_axis(AxisStride::X1000, 1, 0x1000).is_err());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IndexOffset(u32);

/// The largest axis number: with the stride 0x10000, an index offset has 16 bits for it (ADR-9).
/// The same limit applies to the stride 0x1000.
pub(super) const AXIS_MAX: u32 = 0xFFFF;

/// The distance between the axes of a channel in index offsets.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1, 2.1.2, 2.2.2 and 4.2.2.
///
/// ```
/// use ads_cnc::address::{AxisStride, IndexOffset};
///
/// assert_eq!(IndexOffset::for_axis(AxisStride::X10000, 1, 1)?.get(), 0x1_0001);
/// assert_eq!(IndexOffset::for_axis(AxisStride::X1000, 1, 0)?.get(), 0x1000);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AxisStride {
    /// 0x10000: for SDA and GEO (ADR-7; assumed for all classes except the decoder), and for COM
    /// according to the examples of the manuals (ADR-8).
    #[default]
    X10000,
    /// 0x1000: for COM according to a table of the manuals, and for the first platform axis of the HLD in a
    /// printed example (E-01).
    X1000,
}

impl AxisStride {
    const fn element_bits(self) -> u32 {
        match self {
            Self::X10000 => 16,
            Self::X1000 => 12,
        }
    }

    pub(super) const fn element_max(self) -> u32 {
        !(u32::MAX << self.element_bits())
    }
}

impl IndexOffset {
    /// The index offset with this number; any number is valid.
    pub const fn new(number: u32) -> Self {
        Self(number)
    }

    /// The number.
    pub const fn get(self) -> u32 {
        self.0
    }

    /// The index offset of an element of an axis; axis 0 is the channel itself.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] if the axis exceeds 16 bits, or the element is not less than the stride
    /// (ADR-9).
    pub const fn for_axis(stride: AxisStride, axis: u32, element: u32) -> Result<Self, Error> {
        if axis > AXIS_MAX {
            return Err(Error::new(ErrorKind::OutOfRange, AXIS, 0, AXIS_MAX, axis));
        }
        let max = stride.element_max();
        if element > max {
            return Err(Error::new(ErrorKind::OutOfRange, ELEMENT, 0, max, element));
        }
        Ok(Self((axis << stride.element_bits()) | element))
    }

    /// The axis and the element, if the offset was computed with this stride.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for an axis that exceeds 16 bits, which is possible with the stride
    /// 0x1000.
    pub const fn axis_and_element(self, stride: AxisStride) -> Result<(u32, u32), Error> {
        let axis = self.0 >> stride.element_bits();
        if axis > AXIS_MAX {
            return Err(Error::new(ErrorKind::OutOfRange, AXIS, 0, AXIS_MAX, axis));
        }
        Ok((axis, self.0 & stride.element_max()))
    }
}

impl fmt::Debug for IndexOffset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#x}", self.0)
    }
}

impl fmt::Display for IndexOffset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#x}", self.0)
    }
}

crate::number::from_number!(IndexOffset);
