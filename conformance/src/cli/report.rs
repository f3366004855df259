//! `ads-cnc report`: other forms of a report that was written as JSON.

use std::io::{self, Read as _};
use std::path::PathBuf;

use super::message::print_error;
use super::report_output::{ReportFormats, is_stdout, lost, show};
use crate::judge::Exit;
use crate::report::{self, Report};

/// Make other forms of a report that `run --json` wrote; without any, show it
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  ads-cnc run --json report.json\n  \
    ads-cnc report report.json --html report.html --junit report.xml\n  \
    ads-cnc run --json - | ads-cnc report - --markdown -\n\n\
    Exit codes: 0 written, whatever the report says, 2 wrong usage or no report, 70 internal error")]
pub(super) struct ReportArgs {
    /// The report; - is stdin
    file: PathBuf,

    #[command(flatten)]
    forms: ReportFormats,

    /// Show the cases made of vectors one by one
    #[arg(long, short)]
    verbose: bool,
}

impl ReportArgs {
    pub(super) fn execute(&self) -> Exit {
        let report = match self.forms.check(None).and_then(|()| self.read()) {
            Ok(report) => report,
            Err(why) => {
                print_error(why);
                return Exit::Usage;
            }
        };
        let written = if self.forms.is_empty() {
            show(|out| report::print(&report, self.verbose, out))
        } else {
            self.forms.write(&report)
        };
        written.map_or_else(lost, |()| Exit::Success)
    }

    fn read(&self) -> Result<Report, String> {
        let failed = |why: String| format!("{}: {why}", self.file.display());
        let mut text = String::new();
        let read = if is_stdout(&self.file) {
            io::stdin().lock().read_to_string(&mut text).map(|_| ())
        } else {
            std::fs::read_to_string(&self.file).map(|read| text = read)
        };
        read.map_err(|error| failed(error.to_string()))?;
        Report::from_json(&text).map_err(|error| failed(format!("no report: {error}")))
    }
}
