//! An instance of a class of SDA or GEO.

use ads_cnc::address::{Class, ElementAddress};

use crate::suite::kit::Sample;

/// An instance of a class, with the channel and the axis in the request for its address.
#[derive(Clone, Debug)]
pub(crate) struct Instance {
    pub(crate) class: Class,
    pub(crate) channel: u32,
    pub(crate) axis: u32,
    pub(crate) first: ElementAddress,
    /// The number of elements that the target reports; 0 if it does not return this number.
    pub(crate) reported: u32,
    /// The number of elements after element 0. The content of element 0 is the reported number;
    /// whether the reported number includes element 0 is not documented.
    pub(crate) count: u32,
    /// The number of the last element for which a name was found, at most `OBJECTS_MAX`; 0 if none
    /// was found.
    pub(crate) reached: u32,
    /// The elements that the cases read, and their maximum number in a sample.
    pub(super) sample: (Sample, u32),
}

impl Instance {
    /// Whether the reported number was found to include element 0.
    pub(crate) const fn counts_itself(&self) -> bool {
        self.reported > self.count
    }

    /// The elements that the cases read, without element 0.
    pub(crate) fn elements(&self) -> impl Iterator<Item = ElementAddress> + '_ {
        let (sample, most) = self.sample;
        let numbers = sample.of(1..self.reached.saturating_add(1), most);
        numbers.into_iter().map_while(|number| self.first.nth(number).ok())
    }
}

impl std::fmt::Display for Instance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.class)?;
        if self.channel > 0 {
            write!(f, " of channel {}", self.channel)?;
        }
        if self.axis > 0 {
            write!(f, ", axis {}", self.axis)?;
        }
        Ok(())
    }
}
