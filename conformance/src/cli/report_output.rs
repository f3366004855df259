//! The options of `run`, `check` and `report` for the formats of a report, and their output.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;

use super::message::print_error;
use super::output::{is_stdout, lost, show, write};
use crate::client_suite;
use crate::exit::Exit;
use crate::judge::Waivers;
use crate::matrix;
use crate::report::{self, Report};
use crate::text::{FileError, did_you_mean};

/// The heading of these options in the help.
pub(super) const HEADING: &str = "Reports";

/// An example of a waiver in the file of --waivers.
pub(super) const WAIVER: &str = "  [[waiver]]
  test = \"var-descriptions\"   # the ID of a case
  requirement = \"VAR-8\"
  verdict = \"fail\"            # or vacuous, inconclusive, warning, differs
  reason = \"sizes are rounded up to 4 until firmware 2.1\"
  expires = 2027-01-31        # the waiver is not valid from this day on";

/// The options for the formats of a report other than JSON.
#[derive(Args, Clone, Debug)]
pub(super) struct ReportFormats {
    /// Write the report as one self-contained HTML file
    #[arg(long, help_heading = HEADING, value_name = "FILE")]
    html: Option<PathBuf>,

    /// Write the report as JUnit XML, one test for each case
    #[arg(long, help_heading = HEADING, value_name = "FILE")]
    junit: Option<PathBuf>,

    /// Write the report as Markdown, for example for a pull request
    #[arg(long, hide_short_help = true, help_heading = HEADING, value_name = "FILE")]
    markdown: Option<PathBuf>,

    /// Write the JSON of a badge for an endpoint of shields.io
    #[arg(long, hide_short_help = true, help_heading = HEADING, value_name = "FILE")]
    badge: Option<PathBuf>,
}

/// A function that writes a report in a format.
type FormatWriter = fn(&Report, &mut dyn Write) -> io::Result<()>;

impl ReportFormats {
    fn requested(&self) -> impl Iterator<Item = (&Path, FormatWriter)> {
        let all: [(&Option<PathBuf>, FormatWriter); 4] = [
            (&self.html, report::to_html),
            (&self.junit, report::to_junit),
            (&self.markdown, report::to_markdown),
            (&self.badge, report::to_badge),
        ];
        all.into_iter().filter_map(|(file, maker)| Some((file.as_deref()?, maker)))
    }

    /// Whether one of the formats goes to stdout.
    pub(super) fn has_stdout(&self) -> bool {
        self.requested().any(|(file, _)| is_stdout(file))
    }

    /// Whether no format is requested.
    pub(super) fn is_empty(&self) -> bool {
        self.requested().next().is_none()
    }

    /// The files of the requested formats.
    fn files(&self) -> impl Iterator<Item = &Path> {
        self.requested().map(|(file, _)| file)
    }

    /// Checks that at most one of the requested formats and the other files goes to stdout.
    pub(super) fn check<'a>(
        &'a self,
        others: impl IntoIterator<Item = &'a Path>,
    ) -> Result<(), String> {
        let files = others.into_iter().chain(self.files());
        match files.filter(|file| is_stdout(file)).count() {
            0 | 1 => Ok(()),
            _ => Err("only one report or comparison can be written to stdout".to_owned()),
        }
    }

    pub(super) fn write(&self, report: &Report) -> io::Result<()> {
        self.requested().try_for_each(|(file, maker)| write(file, |out| maker(report, out)))
    }
}

/// The options of `run` and `check` for the reports and the file of known failures.
#[derive(Args, Clone, Debug)]
pub(super) struct Reports {
    /// Read the accepted known failures from this file
    #[arg(long, value_name = "FILE")]
    waivers: Option<PathBuf>,

    /// Write the report as JSON, which `ads-cnc report` converts to the other formats; - is stdout
    #[arg(long, help_heading = HEADING, value_name = "FILE")]
    json: Option<PathBuf>,

    #[command(flatten)]
    forms: ReportFormats,
}

impl Reports {
    /// The file of --json.
    pub(super) fn json(&self) -> Option<&Path> {
        self.json.as_deref()
    }

    /// Checks that the reports can be written, and returns the waivers in the file of --waivers.
    pub(super) fn waivers(&self) -> Result<Waivers, String> {
        let waivers = self.waivers.as_deref().map(waivers).transpose()?;
        self.forms.check(self.json())?;
        self.json().into_iter().chain(self.forms.files()).try_for_each(writable)?;
        Ok(waivers.unwrap_or_default())
    }

    /// Removes the reports of an earlier run, because this run produced none.
    pub(super) fn remove(&self) {
        let files = self.json().into_iter().chain(self.forms.files());
        // Remove only regular files, but no device, pipe or symbolic link.
        let is_file = |file: &&Path| fs::symlink_metadata(file).is_ok_and(|it| it.is_file());
        for file in files.filter(is_file) {
            if let Err(error) = fs::remove_file(file) {
                let name = file.display();
                print_error(format_args!("{name}: cannot remove the earlier report: {error}"));
            }
        }
    }

    /// Writes the reports to their files. Calls `print` with stdout, unless a report is written to
    /// stdout.
    pub(super) fn write(
        &self,
        report: &Report,
        print: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Exit {
        // Write the files first, because the reader of stdout may be slow or close the pipe.
        let json = self.json();
        let written = json.map_or(Ok(()), |file| write(file, |out| report::to_json(report, out)));
        let written = written.and_then(|()| self.forms.write(report));
        // If a report is written to stdout, write nothing else to it.
        let quiet = json.is_some_and(is_stdout) || self.forms.has_stdout();
        let shown = if quiet { Ok(()) } else { show(print) };
        written.and(shown).map_or_else(lost, |()| report.exit())
    }
}

/// Checks before the run that a report can be written; an existing file keeps its content.
fn writable(file: &Path) -> Result<(), String> {
    let there = fs::metadata(file);
    // Opening a FIFO waits for a reader, and closing it ends the reader's input, so a FIFO is only
    // opened for the report.
    if is_stdout(file) || there.as_ref().is_ok_and(|it| !it.is_file() && !it.is_dir()) {
        return Ok(());
    }
    let opened = OpenOptions::new().create(true).append(true).open(file);
    opened.map_err(|error| format!("{}: {error}", file.display()))?;
    if there.is_err() {
        // Remove the empty file that the check created, because the run may not finish. If `file`
        // is a symbolic link, the created file is its target.
        let _gone = fs::canonicalize(file).and_then(fs::remove_file);
    }
    Ok(())
}

fn waivers(file: &Path) -> Result<Waivers, String> {
    let waivers = FileError::parse(file, File::open(file), Waivers::from_toml)
        .map_err(|error| error.to_string())?;
    if waivers.is_empty() {
        let file = file.display();
        print_error(format_args!(
            "{file} contains no waiver, so every failure counts. A waiver for a known failure, which -v \
             prints for each failure of the run:\n{WAIVER}"
        ));
    }
    let cases = matrix::cases().into_iter().chain([client_suite::requests_case()]);
    let known: Vec<String> = cases.map(|case| case.id).collect();
    if let Some(id) = waivers.cases().find(|id| known.iter().all(|known| known != id)) {
        let near = did_you_mean(id, known.iter().map(String::as_str));
        return Err(format!("{}: no case has the ID {id}{near}", file.display()));
    }
    Ok(waivers)
}
