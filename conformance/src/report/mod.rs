//! What a run found: one data structure, written as JSON and shown on the console.

mod console;
pub(crate) mod hex;
mod model;

pub use console::print;
pub use model::{
    AreaReport, CaseReport, FailureReport, Report, RequirementReport, SubjectReport, TargetReport,
};
