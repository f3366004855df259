//! The words of a judgement: case, check, evidence, outcome, verdict, plan, waiver. Nothing here
//! opens a file or a socket.

mod case;
mod check;
mod evidence;
mod left_changed;
mod outcome;
mod plan;
mod vectors;
mod verdict;
mod waivers;

pub(crate) use case::in_catalogue;
pub use case::{Body, Case, CaseSubject, Needs};
pub(crate) use check::{Checks, IfThere, OrStop, Record, TEXT_MAX, applicable};
pub use check::{Describe, Judgement, Rule, Rules, Step, Stop, assumed, online};
pub use evidence::Evidence;
pub use left_changed::LeftChanged;
pub(crate) use outcome::caught;
pub use outcome::{CaseOutcome, RequirementVerdict, gravest};
pub use plan::{LeftOut, Plan, Selection, Unmatched, any_seed};
pub(crate) use plan::{names, order};
pub use vectors::siblings_of;
pub(crate) use vectors::{case_of, codec_cases, typed};
pub use verdict::{Exit, Verdict, VerdictTally};
pub use waivers::{WaiverError, WaiverReport, WaiverState, Waivers};

/// What the protocol with a codec demands, beside the requirements of the catalogue.
pub const TESTEE: &str = "TESTEE";

/// What the protocol with a client demands, beside the requirements of the catalogue.
pub const CLIENT: &str = "CLIENT";
