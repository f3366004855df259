//! What a run found: one data structure, written as JSON, from which everything else is made.

mod badge;
mod build;
mod bytes;
mod console;
mod device;
pub(crate) mod hex;
mod html;
pub(crate) mod json;
mod junit;
mod markdown;
mod model;
mod tame;

use std::io::{self, Write};

pub use badge::to_badge;
pub use build::{About, LeftOut};
pub use bytes::{BytesReport, FieldReport};
pub use console::print;
pub use device::DeviceReport;
pub use html::to_html;
pub use junit::to_junit;
pub use markdown::to_markdown;
pub use model::{
    AreaReport, CaseReport, EvidenceReport, FORMAT, FailureReport, LeftChanged, ProfileReport,
    Report, RequirementReport, SubjectReport, TargetReport, Totals, WaiverReport, WaiverState,
};
pub(crate) use tame::{tame, tame_lines};

/// Writes the report as JSON.
///
/// # Errors
/// Those of `out`.
pub fn to_json(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    json::write(report, out)
}
