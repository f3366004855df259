//! What a run found: one data structure, written as JSON, from which everything else is made.

mod build;
mod bytes;
mod console;
pub(crate) mod hex;
mod model;

pub use build::{About, LeftOut};
pub use bytes::{BytesReport, FieldReport};
pub use console::print;
pub use model::{
    AreaReport, CaseReport, EvidenceReport, FORMAT, FailureReport, ProfileReport, Report,
    RequirementReport, SubjectReport, TargetReport, Totals, WaiverReport, WaiverState,
};
