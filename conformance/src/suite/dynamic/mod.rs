//! Cases of dynamic parameters.

mod list;
mod malformed;
mod parameters;
mod value;

use ads_cnc_vectors::ids::*;

use super::row::{CaseRow, case};
use crate::judge::Needs;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("dyn-count", &[DYN_1, SDA_12], Needs::Queries, list::count,
        "Each kind has a number of parameters, at an offset that no element of the decoder uses"),
    case("dyn-names", &[DYN_1, DYN_2, DYN_5, DYN_6, SDA_12], Needs::Queries, list::names,
        "Every index from 1 to the last has a unique name of its kind; other indices have none"),
    case("dyn-index-beyond-last", &[DYN_5], Needs::Queries, list::index_beyond_last,
        "A request with the index after the last returns an error"),
    case("dyn-values", &[DYN_2, DYN_3, DYN_4, DYN_6], Needs::Queries, value::values,
        "A parameter has the same value by its name and by its index"),
    case("dyn-unknown-name", &[DYN_3], Needs::Queries, value::unknown_name,
        "A request with an unknown parameter name returns an error"),
    case("dyn-kinds-apart", &[DYN_3], Needs::Queries, value::kinds_apart,
        "A parameter can be read only under its own kind"),
    case("dyn-by-index-of-channel", &[ADR_1, ADR_12], Needs::Queries, value::by_rank,
        "A channel has the same parameters by its number and by its rank"),
    case("dyn-bad-requests", &[ADS_1, DYN_2, DYN_3, DYN_4, DYN_5, DYN_6],
        Needs::Malformed, malformed::bad_requests,
        "Index 0 and requests with a wrong length return an error"),
    case("dyn-name-forms", &[DYN_3], Needs::Malformed, malformed::forms,
        "A parameter name is accepted without a NUL and with several NULs"),
];
