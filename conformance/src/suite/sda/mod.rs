//! Cases of SDA and GEO: which instances there are, and where.

mod address;
mod empty_places;
mod platform;
mod range;
mod types;

use ads_cnc::Decode as _;
use ads_cnc::address::ElementAddress;
use ads_cnc::operation::ReadElementLength;
use ads_cnc::sda::ElementLength;

use super::probe::Probe;
use super::{Declared, declare};
use crate::judge::Step;

pub(super) use types::type_and_length;

pub(super) fn cases() -> Vec<Declared> {
    vec![
        declare!(
            "sda-object-address",
            "The address of an instance is in its class's group, and no other's",
            ["SDA-1", "ADR-2", "ADR-5", "ADR-7", "GEN-6"],
            Queries,
            address::object_address
        ),
        declare!(
            "sda-configured-instances",
            "Every class has the instances that the configuration makes",
            ["SDA-1", "SDA-2", "SDA-5", "ADR-5"],
            Queries,
            range::configured
        ),
        declare!(
            "sda-no-such-instance",
            "An instance that is not there is at (0, 0)",
            ["SDA-2", "SDA-5", "GEN-6"],
            Queries,
            range::no_such_instance
        ),
        declare!(
            "sda-far-instance",
            "A number that fits no group or no offset is that of no instance",
            ["SDA-2", "SDA-5", "ADR-7"],
            Malformed,
            range::far
        ),
        declare!(
            "sda-axes-agree",
            "Classes with the axes of a channel have as many, and so have those of the platform",
            ["SDA-1", "SDA-5"],
            Queries,
            range::axes_agree
        ),
        declare!(
            "sda-bad-queries",
            "A question for an instance of another length is answered by an error",
            ["SDA-1"],
            Malformed,
            address::bad_queries
        ),
        declare!(
            "sda-address-by-index",
            "By rank the address is that of the same channel, without the logical bit",
            ["SDA-1", "ADR-1", "ADR-12"],
            Queries,
            address::address_by_index
        ),
        declare!(
            "sda-platform-axes-of-hld",
            "The HLD of the first channel has the axes of the whole platform",
            ["SDA-5", "SDA-13"],
            Queries,
            platform::platform_axes_of_hld
        ),
        declare!(
            "sda-empty-place",
            "A place without an axis reads as blank",
            ["SDA-11"],
            Queries,
            empty_places::empty_place
        ),
        declare!(
            "sda-axis-number",
            "The logical axis number of a place is that of its axis, and 0 without one",
            ["SDA-11"],
            Embedded,
            empty_places::axis_number
        ),
    ]
}

/// The length of an element, as it says itself.
pub(super) fn length_of(probe: &mut Probe<'_>, element: ElementAddress) -> Step<Option<u32>> {
    let data = probe.try_ask(ReadElementLength::new(element))?;
    Ok(data.and_then(|data| ElementLength::decode(&data).ok()).map(ElementLength::get))
}
