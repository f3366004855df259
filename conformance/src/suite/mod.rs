//! The cases for this project's codec and for a target (a CNC under test), and their execution.

mod address;
mod ads_services;
mod allowed;
mod arrays;
mod attributes;
mod axis;
mod axis_place;
mod byte_order;
mod com;
mod content;
mod describe_by_name;
mod device;
mod discovery;
mod dynamic;
mod elements;
mod general;
mod handles;
mod kit;
mod malformed;
mod names;
mod needs;
mod no_padding;
mod platform;
mod printed;
mod row;
mod run;
mod sda;
mod service_interface;
mod streaming;
mod texts;
mod values;
mod variable;
mod variable_lookup;
mod write;
mod write_after_error;
mod write_aliases;
mod write_array_elements;
mod write_content;
mod write_isolation;
mod write_rejected;
mod write_sizes;
mod write_texts;

pub use allowed::{Unwritable, unwritable};
pub use discovery::{ClaimsBy, Discovery, discover};
pub(crate) use kit::PLACES_MAX;
pub use kit::{Changes, Probe, Sample, TargetState};
pub use run::run;

use crate::judge::{Body, Case, CaseSubject, codec_cases};
use crate::rules::reply_cases;
use row::CaseRow;

/// The cases for a target, each of which has its own function in a submodule. [`cases`] makes the
/// other cases from vectors, sequences and the rules for replies.
const TABLES: &[&[CaseRow]] = &[
    address::CASES,
    ads_services::CASES,
    attributes::CASES,
    general::CASES,
    byte_order::CASES,
    no_padding::CASES,
    device::CASES,
    com::CASES,
    content::CASES,
    platform::CASES,
    sda::CASES,
    elements::CASES,
    dynamic::CASES,
    variable::CASES,
    handles::CASES,
    variable_lookup::CASES,
    describe_by_name::CASES,
    names::CASES,
    values::CASES,
    arrays::CASES,
    axis::CASES,
    axis_place::CASES,
    write::CASES,
    write_array_elements::CASES,
    write_rejected::CASES,
    write_sizes::CASES,
    write_isolation::CASES,
    write_texts::CASES,
    write_content::CASES,
    write_after_error::CASES,
    write_aliases::CASES,
    texts::CASES,
    streaming::CASES,
    service_interface::CASES,
    malformed::CASES,
    address::FRAME_CASES,
];

fn rows() -> impl Iterator<Item = &'static CaseRow> {
    TABLES.iter().copied().flatten()
}

fn case_of(row: &CaseRow) -> Case {
    Case {
        id: row.id.to_owned(),
        title: row.title.to_owned(),
        subject: CaseSubject::Target,
        requirements: row.clauses.iter().map(|id| id.as_str()).collect(),
        needs: row.needs,
        body: Body::Probe,
    }
}

/// All cases for the codec and for a target, in no particular order:
/// [`Selection::plan`](crate::judge::Selection::plan) orders them.
pub fn cases() -> Vec<Case> {
    let mut cases = codec_cases();
    cases.extend(rows().map(case_of));
    cases.extend(printed::cases());
    cases.extend(reply_cases());
    cases
}
