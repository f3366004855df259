//! The report of a run: one data structure, written as JSON and converted to all other formats.

mod badge;
mod build;
mod bytes;
mod compare;
mod console;
mod device;
mod discovery;
mod display;
mod document;
mod escape;
mod failures;
mod groups;
mod html;
mod junit;
pub(crate) mod lines;
mod markdown;
mod statement;

use std::io::{self, Write};

use crate::text::json;

pub use badge::to_badge;
pub use build::RunInfo;
pub use bytes::{BytesReport, FieldReport};
pub use compare::compare;
pub use console::print;
pub use device::DeviceReport;
pub use discovery::{FoundChannel, FoundList, FoundReport};
pub use display::{Detail, DisplayOptions};
pub use document::{
    AreaReport, CaseReport, EvidenceReport, FORMAT, FailureReport, ProfileReport, Report,
    RequirementReport, SubjectReport, TargetReport, Totals,
};
pub use html::to_html;
pub use junit::to_junit;
pub use markdown::to_markdown;

pub use statement::{to_statement, to_statement_html};

/// The title of the requirements of a protocol of the suite, which the catalogue does not contain.
const PROTOCOL_TITLE: &str = "Protocol with the suite";

pub fn to_json(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    json::write(report, out)
}
