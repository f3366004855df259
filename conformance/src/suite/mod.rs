//! The suite: what it tries, in which order, and what comes of it.

mod address;
mod addresses;
mod ads_services;
mod arrays;
mod attributes;
mod axis;
mod axis_exchange;
mod axis_interface;
mod axis_place;
mod byte_order;
mod com;
mod configured;
mod content;
mod describe_by_name;
mod device;
mod dynamic;
mod elements;
mod general;
mod handles;
mod inventory;
mod layout;
mod malformed;
mod names;
mod needs;
mod no_padding;
mod place;
mod platform;
mod printed;
mod probe;
mod replay;
mod run;
mod sda;
mod service_interface;
mod session;
mod simulator_state;
mod steady;
mod stream;
mod texts;
mod undo;
mod values;
mod variable;
mod variable_lookup;
mod write;
mod write_after_error;
mod write_aliases;
mod write_content;
mod write_elements;
mod write_isolation;
mod write_refused;
mod write_sizes;
mod write_texts;

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
    cases.extend(ads_services::cases());
    cases.extend(attributes::cases());
    cases.extend(general::cases());
    cases.extend(byte_order::cases());
    cases.extend(no_padding::cases());
    cases.extend(device::cases());
    cases.extend(com::cases());
    cases.extend(content::cases());
    cases.extend(platform::cases());
    cases.extend(simulator_state::cases());
    cases.extend(sda::cases());
    cases.extend(elements::cases());
    cases.extend(dynamic::cases());
    cases.extend(variable::cases());
    cases.extend(handles::cases());
    cases.extend(variable_lookup::cases());
    cases.extend(describe_by_name::cases());
    cases.extend(names::cases());
    cases.extend(values::cases());
    cases.extend(arrays::cases());
    cases.extend(configured::cases());
    cases.extend(axis::cases());
    cases.extend(axis_place::cases());
    cases.extend(axis_exchange::cases());
    cases.extend(write::cases());
    cases.extend(write_elements::cases());
    cases.extend(write_refused::cases());
    cases.extend(write_sizes::cases());
    cases.extend(write_isolation::cases());
    cases.extend(write_texts::cases());
    cases.extend(write_content::cases());
    cases.extend(write_after_error::cases());
    cases.extend(write_aliases::cases());
    cases.extend(texts::cases());
    cases.extend(stream::cases());
    cases.extend(service_interface::cases());
    cases.extend(replay::cases());
    cases.extend(malformed::cases());
    cases.extend(printed::cases());
    // Judges what all the others exchanged, so it comes last.
    cases.extend(address::frame_cases());
    cases
}
