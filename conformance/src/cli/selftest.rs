//! `ads-cnc selftest`: tests the suite itself.

use std::path::PathBuf;
use std::sync::Mutex;
use std::time::Instant;

use clap::Args;

use super::message::{exit_with_error, print_error};
use super::numbers::whole;
use super::output::{is_stdout, lost, show, write};
use super::progress::{LOG_INTERVAL, ProgressLine, UPDATE_INTERVAL, progress_text};
use crate::exit::Exit;
use crate::judge::any_seed;
use crate::mutex::lock;
use crate::process::progress::Counts;
use crate::selftest::detection::Scope;
use crate::selftest::{self, SelfTestProgress};

/// Test the suite itself: it must fail seeded defects and pass correct implementations
///
/// The vectors judge codecs with a defect, the cases over the wire judge CNCs with a defect, and
/// the scenarios judge clients with a defect. A defect is detected if a requirement that it
/// violates fails. `serve --list-defects` lists the defects of codecs and CNCs, `client
/// --list-defects` those of clients.
#[derive(Args, Debug)]
#[command(
    after_help = "Exit codes: 0 every defect without a documented reason detected, and no false \
    alarm; 1 otherwise; 3 nothing tested.\n\nExamples:\n  ads-cnc selftest\n  ads-cnc selftest \
    --only VAR-11 --verbose\n  ads-cnc selftest --only cnc --json selftest.json"
)]
pub(super) struct SelfTestArgs {
    /// Test only this: a group (codec, cnc, client, miniature, different), an area, a requirement
    /// or the beginning of an ID; repeatable [default: all]
    #[arg(long, value_name = "WORD")]
    only: Vec<String>,

    /// Measure every seeded defect of a CNC in every mode [default: the defects changed since the
    /// published table was written, and a sample of 60]
    #[arg(long)]
    all: bool,

    /// Set the seed of the sample [default: random; shown on stderr]
    #[arg(long, value_name = "N", conflicts_with = "all", allow_negative_numbers = true,
        value_parser = whole(0..=u32::MAX))]
    seed: Option<u32>,

    /// Measure the changed defects, or all if the list of cases, a level or the default model
    /// changed, and write detection.tsv and detection.md to this folder
    #[arg(long, value_name = "DIR", conflicts_with_all = ["seed", "only"])]
    renew: Option<PathBuf>,

    /// Show every tested implementation and every missed defect
    #[arg(long, short)]
    verbose: bool,

    /// Write the result of each test as JSON; - is stdout
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

impl SelfTestArgs {
    pub(super) fn execute(&self) -> Exit {
        let shown = Mutex::new((ProgressLine::new(), "", Instant::now()));
        let tell = |now: SelfTestProgress| {
            let SelfTestProgress { part, all, done, failed } = now;
            let mut shown = lock(&shown);
            let (line, last_part, begin) = &mut *shown;
            let is_new = *last_part != part;
            if is_new {
                (*last_part, *begin) = (part, Instant::now());
            }
            let due = if line.live { UPDATE_INTERVAL } else { LOG_INTERVAL };
            if is_new || line.is_due(due) {
                let counts = Counts { all, done, failed, requests: 0 };
                line.show(&progress_text(counts, part, begin.elapsed()));
            }
        };
        let seed = self.seed.unwrap_or_else(any_seed);
        let scope = if self.all {
            Scope::All
        } else if self.renew.is_some() {
            Scope::Changed
        } else {
            print_error(format_args!("sample by --seed {seed}"));
            Scope::Sample(seed)
        };
        let test = selftest::run(&self.only, scope, tell);
        drop(shown);
        if let Some(folder) = &self.renew {
            let table = &test.detection.table;
            let files = [("detection.tsv", table.to_text()), ("detection.md", table.to_markdown())];
            for (name, text) in files {
                let file = folder.join(name);
                if let Err(error) = std::fs::write(&file, text) {
                    let why = format!("{}: {error}", file.display());
                    return exit_with_error(Exit::Internal, why);
                }
            }
        }
        let json = |file: &PathBuf| {
            write(file, |out| {
                serde_json::to_writer_pretty(&mut *out, &test)?;
                out.write_all(b"\n")
            })
        };
        let written = self.json.as_ref().map_or(Ok(()), json);
        let quiet = self.json.as_deref().is_some_and(is_stdout);
        let shown =
            if quiet { Ok(()) } else { show(|out| selftest::print(&test, self.verbose, out)) };
        written.and(shown).map_or_else(lost, |()| test.exit())
    }
}
