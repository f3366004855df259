//! The stored descriptions of a list of variables.

use std::collections::BTreeMap;

use ads_cnc::Description;

/// The variables of a kind in a channel.
#[derive(Clone, Debug, Default)]
pub(crate) struct DescribedList {
    /// The number of variables according to the target.
    pub(crate) count: u32,
    /// The descriptions that were read, by index; `None` if the name of the variable is too long
    /// for a request.
    pub(crate) read: BTreeMap<u32, Option<Description>>,
}

impl DescribedList {
    /// The descriptions that were read, except those whose name is too long for a request.
    pub(crate) fn descriptions(&self) -> impl Iterator<Item = &Description> {
        self.read.values().flatten()
    }
}
