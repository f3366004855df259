//! Cases of SDA and GEO: instances and their addresses.

mod address;
mod empty_places;
mod platform;
mod range;

use ads_cnc_vectors::ids::*;

use super::row::{CaseRow, case};
use crate::judge::Needs;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("sda-object-address", &[SDA_1, SDA_3, ADR_2, ADR_5, ADR_7, GEN_6],
        Needs::Queries, address::object_address,
        "The address of an instance is in the index group of its class, and is unique"),
    case("sda-configured-instances", &[SDA_1, SDA_2, SDA_5, ADR_5], Needs::Queries, range::configured,
        "Every class has the configured instances"),
    case("sda-no-such-instance", &[SDA_2, SDA_5, GEN_6], Needs::Queries, range::no_such_instance,
        "An instance that does not exist has the address (0, 0)"),
    case("sda-far-instance", &[SDA_2, SDA_5, ADR_7], Needs::Malformed, range::far,
        "No instance has a channel or an axis number that exceeds the index group or offset"),
    case("sda-axes-agree", &[SDA_1, SDA_5], Needs::Queries, range::axes_agree,
        "The classes with axes of a channel, or of the platform, have the same number of axes"),
    case("sda-bad-queries", &[SDA_1], Needs::Malformed, address::bad_queries,
        "A request for an instance with a wrong length returns an error"),
    case("sda-address-by-index", &[SDA_1, ADR_1, ADR_12], Needs::Queries, address::address_by_index,
        "By rank, an instance has the address of the same channel without the logical bit"),
    case("sda-platform-axes-of-hld", &[SDA_13], Needs::Queries, platform::platform_axes_of_hld,
        "The HLD of the first channel has all axes of the platform"),
    case("sda-empty-place", &[SDA_11], Needs::Queries, empty_places::empty_place,
        "An axis index without an axis has blank content"),
];
