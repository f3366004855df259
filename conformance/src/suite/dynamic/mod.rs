//! Cases of dynamic parameters.

mod change;
mod list;
mod malformed;
mod parameters;
mod value;

use super::row::{CaseRow, case};
use crate::judge::Needs;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("dyn-count", &["DYN-1", "SDA-12"], Needs::Queries, list::count,
        "Each kind has a number, where the decoder's elements have none"),
    case("dyn-names", &["DYN-1", "DYN-2", "DYN-5", "DYN-6", "SDA-12"], Needs::Queries, list::names,
        "Every index from 1 on has a name of its kind, unlike the others, and no other has"),
    case("dyn-index-beyond-last", &["DYN-5"], Needs::Queries, list::index_beyond_last,
        "The index behind the last is answered by an error"),
    case("dyn-values", &["DYN-2", "DYN-3", "DYN-4", "DYN-6"], Needs::Queries, value::values,
        "A parameter has the same value by its name and by its index"),
    case("dyn-unknown-name", &["DYN-3"], Needs::Queries, value::unknown_name,
        "A name that no parameter has is answered by an error"),
    case("dyn-kinds-apart", &["DYN-3"], Needs::Queries, value::kinds_apart,
        "A parameter is found among those of its own kind only"),
    case("dyn-by-index-of-channel", &["ADR-1", "ADR-12"], Needs::Queries, value::by_rank,
        "A channel's parameters are the same by its number and by its rank"),
    case("dyn-come-and-go", &["DYN-1", "DYN-2", "DYN-3", "DYN-4", "DYN-5", "DYN-6"],
        Needs::Simulator, change::come_and_go,
        "Parameters that are made and deleted change numbers and indices, and no name"),
    case("dyn-bad-requests", &["ADS-1", "DYN-2", "DYN-3", "DYN-4", "DYN-5", "DYN-6"],
        Needs::Malformed, malformed::bad_requests,
        "Index 0 and requests of another length are answered by an error"),
    case("dyn-name-forms", &["DYN-3"], Needs::Malformed, malformed::forms,
        "A name is found without its NUL, and with more of them"),
];
