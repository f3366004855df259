//! `ads-cnc report`: shows, converts and compares reports that were written as JSON.

use std::ffi::OsStr;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use super::display::DisplayArgs;
use super::message::exit_with_error;
use super::output::{is_stdout, lost, show, write};
use super::report_output::ReportFormats;
use crate::exit::Exit;
use crate::report::{self, Report};
use crate::text::{read_limited, utf8};

/// Maximum number of bytes of a report that is read; a device or a pipe may never end.
const REPORT_MAX: u64 = 256 * 1024 * 1024;

/// Show a JSON report, write it in other formats, or compare it with an earlier one
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  ads-cnc run --json report.json\n  \
    ads-cnc report report.json --html report.html --junit report.xml\n  \
    ads-cnc run --json - | ads-cnc report - --markdown -\n  \
    ads-cnc report report.json --statement statement.html\n  \
    ads-cnc report report.json --against yesterday.json\n\n\
    Exit codes: 0 written, whatever the report says; 1 a new failure, 3 a requirement is no \
    longer judged (--against); 2 wrong usage or no report; 70 internal error")]
pub(super) struct ReportArgs {
    /// The JSON report to read; - is stdin
    file: PathBuf,

    #[command(flatten)]
    forms: ReportFormats,

    /// Write a conformance statement: for each clause whether it is claimed and verified; as HTML to
    /// FILE.html, as Markdown to FILE.md; - is Markdown on stdout
    #[arg(long, value_name = "FILE", value_parser = statement_file)]
    statement: Option<PathBuf>,

    /// Compare with an earlier report: list new failures and deviations, fixed ones, and
    /// requirements newly judged or no longer judged
    #[arg(long, value_name = "EARLIER")]
    against: Option<PathBuf>,

    #[command(flatten)]
    display: DisplayArgs,
}

impl ReportArgs {
    pub(super) fn execute(&self) -> Exit {
        let comparison = self.against.as_deref().map(|_| Path::new("-"));
        let others = self.statement.as_deref().into_iter().chain(comparison);
        let files = self.forms.check(others).and_then(|()| {
            let before = self.against.as_deref().map(read).transpose()?;
            Ok((read(&self.file)?, before))
        });
        let (report, before) = match files {
            Ok(files) => files,
            Err(why) => return exit_with_error(Exit::Usage, why),
        };
        let mut exit = Exit::Success;
        let statement = self.statement.as_deref().map_or(Ok(()), |file| {
            let is_html = file.extension().is_some_and(|extension| extension == "html");
            let make = if is_html { report::to_statement_html } else { report::to_statement };
            write(file, |out| make(&report, out))
        });
        let compared = before.as_ref().map_or(Ok(()), |before| {
            show(|out| {
                exit = report::compare(&report, before, self.display.display().detail, out)?;
                Ok(())
            })
        });
        let is_done = self.statement.is_some() || self.against.is_some();
        let written = if self.forms.is_empty() && is_done {
            Ok(())
        } else if self.forms.is_empty() {
            show(|out| report::print(&report, self.display.display(), out))
        } else {
            self.forms.write(&report)
        };
        statement.and(compared).and(written).map_or_else(lost, |()| exit)
    }
}

/// Parses the file of a statement: a name that ends in .html or .md, or `-`.
fn statement_file(text: &str) -> Result<PathBuf, String> {
    match Path::new(text).extension().and_then(OsStr::to_str) {
        Some("html" | "md") => Ok(text.into()),
        None if text == "-" => Ok(text.into()),
        _ => {
            Err("expected a name that ends in .html or .md, or - for Markdown on stdout".to_owned())
        }
    }
}

fn read(file: &Path) -> Result<Report, String> {
    let failed = |why: String| format!("{}: {why}", file.display());
    let bytes = if is_stdout(file) {
        read_limited(io::stdin().lock(), REPORT_MAX)
    } else {
        File::open(file).and_then(|opened| read_limited(opened, REPORT_MAX))
    };
    let text = utf8(bytes.map_err(|error| failed(error.to_string()))?).map_err(failed)?;
    Report::from_json(&text).map_err(|error| failed(format!("not a report: {error}")))
}
