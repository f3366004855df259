//! An instance of SDA or GEO.

use ads_cnc::address::{Class, ElementAddress};

/// An instance of a class, by the channel and the axis of its request.
#[derive(Clone, Debug)]
pub(crate) struct Instance {
    pub(crate) class: Class,
    pub(crate) channel: u32,
    pub(crate) axis: u32,
    pub(crate) first: ElementAddress,
    /// The number of elements that the target reports.
    pub(crate) reported: u32,
    /// The elements without element 0, which holds their number: whether the number counts it is not
    /// documented.
    pub(crate) count: u32,
    /// The number of elements that cases read.
    pub(super) reached: u32,
}

impl Instance {
    /// Whether the reported number includes element 0.
    pub(crate) const fn counts_itself(&self) -> bool {
        self.reported > self.count
    }

    /// Its elements without element 0.
    pub(crate) fn elements(&self) -> impl Iterator<Item = ElementAddress> + '_ {
        (1..=self.reached).map_while(|place| self.first.nth(place).ok())
    }
}

impl std::fmt::Display for Instance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({}, {})", self.class, self.channel, self.axis)
    }
}
