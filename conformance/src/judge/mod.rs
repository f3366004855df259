//! The terms of a judgement, such as case, check, outcome, verdict, plan and waiver. These modules
//! open no file and no socket.

mod areas;
mod case;
mod cause;
mod chain;
mod check;
mod outcome;
mod plan;
mod root;
mod tally;
mod unrestored_value;
mod vectors;
mod verdict;
mod waivers;

pub use areas::about;
pub(crate) use case::matches;
pub use case::{Body, Case, CaseSubject, Needs};
pub(crate) use cause::attribute;
pub(crate) use chain::{clauses_of, follows};
pub(crate) use check::{Checks, IfPresent, OrStop, Record, TEXT_MAX, applicable};
pub use check::{Judgement, Rule, Rules, Step, Stop, assumed, online};
pub(crate) use outcome::caught;
pub use outcome::{CaseOutcome, RequirementVerdict, most_severe};
pub use plan::{Plan, Selection, SkippedCase, Unmatched, any_seed};
pub(crate) use plan::{names, order, sections};
pub use tally::VerdictTally;
pub use unrestored_value::UnrestoredValue;
pub use vectors::siblings_of;
pub(crate) use vectors::{case_of, codec_cases, typed};
pub use verdict::Verdict;
pub use waivers::{WaiverReport, WaiverState, Waivers};

/// The note of a case that was not run because `--max-fail` other cases had failed.
pub const ENOUGH: &str = "enough cases had failed before";

/// The ID of the rules of the testee protocol, which are not in the catalogue.
pub const TESTEE: &str = "TESTEE";

/// The ID of the rules of the client protocol, which are not in the catalogue.
pub const CLIENT: &str = "CLIENT";

/// The start of the note of a case whose streams the testee does not claim.
pub(crate) const NOT_CLAIMED: &str = "the testee does not claim ";

/// The expected result of the check of the answer to `hello`, which is the first step of the
/// protocols with a testee and a client. If this check fails, no case is run.
pub const HELLO: &str = "an answer to hello";
