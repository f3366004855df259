//! The four kinds of dynamic parameters.

use core::fmt;

use crate::address::IndexOffset;

/// A kind of dynamic parameters. The decoder of a channel has four functions for them:
/// [`CountDynamic`](crate::operation::CountDynamic),
/// [`DynamicNameByIndex`](crate::operation::DynamicNameByIndex),
/// [`DynamicValueByName`](crate::operation::DynamicValueByName) and
/// [`DynamicValueByIndex`](crate::operation::DynamicValueByIndex). Each function has its own index offset
/// for each kind.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3.1 … 3.4.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::dynamic::DynamicKind;
/// use ads_cnc::operation::{CountDynamic, Operation};
///
/// let count = CountDynamic { channel: Channel::new(1)?, kind: DynamicKind::P };
/// assert_eq!((count.index_group().get(), count.index_offset().get()), (0x12_2301, 0x02));
/// assert_eq!(DynamicKind::VL.to_string(), "V.L");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum DynamicKind {
    /// P parameters.
    P,
    /// V.L variables.
    VL,
    /// V.P variables.
    VP,
    /// V.S variables.
    VS,
}

impl DynamicKind {
    /// All kinds, in the order of the manual.
    pub const ALL: [Self; 4] = [Self::P, Self::VL, Self::VP, Self::VS];

    /// The offset for this kind, from the four offsets of a function.
    pub(crate) const fn offset(self, [p, vl, vp, vs]: [u32; 4]) -> IndexOffset {
        IndexOffset::new(match self {
            Self::P => p,
            Self::VL => vl,
            Self::VP => vp,
            Self::VS => vs,
        })
    }

    /// The kind whose offset in `offsets`, the four offsets of a function, is `offset`.
    pub(crate) fn from_offset(offsets: [u32; 4], offset: IndexOffset) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.offset(offsets) == offset)
    }
}

/// Displays the name of the kind in the manual: `P`, `V.L`, `V.P` or `V.S`.
impl fmt::Display for DynamicKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::P => "P",
            Self::VL => "V.L",
            Self::VP => "V.P",
            Self::VS => "V.S",
        })
    }
}
