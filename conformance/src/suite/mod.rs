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

use crate::judge::{Case, Step, codec_cases};

/// The function that tries a case.
type Try = fn(&mut Probe<'_>) -> Step;

/// A case and the function that tries it, if one does.
type Declared = (Case, Option<Try>);

/// Declares a case.
macro_rules! declare {
    ($id:literal, $title:literal, [$($requirement:literal),+], $needs:ident, $body:path) => {
        (
            $crate::judge::Case {
                id: $id.to_owned(),
                title: $title.to_owned(),
                subject: $crate::judge::Subject::Target,
                requirements: vec![$($requirement),+],
                needs: $crate::judge::Needs::$needs,
                body: $crate::judge::Body::Probe,
            },
            Some($body as $crate::suite::Try),
        )
    };
}

pub(crate) use declare;

/// Every case. [`Selection::plan`](crate::judge::Selection::plan) puts them in order.
pub fn cases() -> Vec<Case> {
    let mut cases = codec_cases();
    cases.extend(declared().into_iter().map(|(case, _)| case));
    cases
}

/// Every case for a target.
fn declared() -> Vec<Declared> {
    let mut cases = address::cases();
    cases.extend(services::cases());
    cases.extend(attributes::cases());
    cases.extend(general::cases());
    cases.extend(numbers::cases());
    cases.extend(packed::cases());
    cases.extend(device::cases());
    cases.extend(com::cases());
    cases.extend(content::cases());
    cases.extend(platform::cases());
    cases.extend(held::cases());
    cases.extend(sda::cases());
    cases.extend(elements::cases());
    cases.extend(dynamic::cases());
    cases.extend(variable::cases());
    cases.extend(handles::cases());
    cases.extend(known::cases());
    cases.extend(described::cases());
    cases.extend(names::cases());
    cases.extend(values::cases());
    cases.extend(arrays::cases());
    cases.extend(configured::cases());
    cases.extend(axis::cases());
    cases.extend(axis_place::cases());
    cases.extend(exchange::cases());
    cases.extend(write::cases());
    cases.extend(write_elements::cases());
    cases.extend(write_refused::cases());
    cases.extend(write_sizes::cases());
    cases.extend(write_all::cases());
    cases.extend(write_texts::cases());
    cases.extend(write_content::cases());
    cases.extend(write_after::cases());
    cases.extend(write_ways::cases());
    cases.extend(texts::cases());
    cases.extend(stream::cases());
    cases.extend(service::cases());
    cases.extend(replay::cases());
    cases.extend(malformed::cases());
    cases.extend(printed::cases());
    // Judges what all the others exchanged, so it comes last.
    cases.extend(address::frame_cases());
    cases
}
