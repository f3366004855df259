//! The suite: what it tries, in which order, and what comes of it.

mod address;
mod addresses;
mod arrays;
mod attributes;
mod axis;
mod axis_interface;
mod axis_place;
mod com;
mod configured;
mod content;
mod described;
mod device;
mod dynamic;
mod elements;
mod exchange;
mod general;
mod handles;
mod held;
mod inventory;
mod known;
mod layout;
mod malformed;
mod names;
mod needs;
mod numbers;
mod packed;
mod place;
mod platform;
mod printed;
mod probe;
mod replay;
mod run;
mod sda;
mod service;
mod services;
mod session;
mod still;
mod stream;
mod survey;
mod texts;
mod undo;
mod values;
mod variable;
mod write;
mod write_after;
mod write_all;
mod write_content;
mod write_elements;
mod write_refused;
mod write_sizes;
mod write_texts;
mod write_ways;

pub(crate) use com::descriptor_holds_together;
pub use probe::Probe;
pub use run::run;
pub use session::Session;
pub use undo::Changes;
pub(crate) use variable::holds_together;

use crate::judge::{Body, Case, Needs, Step, Subject, codec_cases, in_catalogue};

/// The function that tries a case.
type Try = fn(&mut Probe<'_>) -> Step;

/// A case that a function tries.
struct Row {
    id: &'static str,
    clauses: &'static [&'static str],
    needs: Needs,
    run: Try,
    title: &'static str,
}

/// A row of a table of cases.
const fn case(
    id: &'static str,
    clauses: &'static [&'static str],
    needs: Needs,
    run: Try,
    title: &'static str,
) -> Row {
    Row { id, clauses: in_catalogue(clauses), needs, run, title }
}

/// The cases that a function tries.
const TABLES: &[&[Row]] = &[
    address::CASES,
    services::CASES,
    attributes::CASES,
    general::CASES,
    numbers::CASES,
    packed::CASES,
    device::CASES,
    com::CASES,
    content::CASES,
    platform::CASES,
    held::CASES,
    sda::CASES,
    elements::CASES,
    dynamic::CASES,
    variable::CASES,
    handles::CASES,
    known::CASES,
    described::CASES,
    names::CASES,
    values::CASES,
    arrays::CASES,
    configured::CASES,
    axis::CASES,
    axis_place::CASES,
    exchange::CASES,
    write::CASES,
    write_elements::CASES,
    write_refused::CASES,
    write_sizes::CASES,
    write_all::CASES,
    write_texts::CASES,
    write_content::CASES,
    write_after::CASES,
    write_ways::CASES,
    texts::CASES,
    stream::CASES,
    service::CASES,
    malformed::CASES,
    address::FRAME_CASES,
];

fn rows() -> impl Iterator<Item = &'static Row> {
    TABLES.iter().copied().flatten()
}

/// Every case. [`Selection::plan`](crate::judge::Selection::plan) puts them in order.
pub fn cases() -> Vec<Case> {
    let mut cases = codec_cases();
    cases.extend(rows().map(|row| Case {
        id: row.id.to_owned(),
        title: row.title.to_owned(),
        subject: Subject::Target,
        requirements: row.clauses.to_vec(),
        needs: row.needs,
        body: Body::Probe,
    }));
    cases.extend(replay::cases());
    cases.extend(printed::cases());
    cases
}
