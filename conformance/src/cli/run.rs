//! `ads-cnc run`: judges a target, a codec or a client by the cases of the suite.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::borrow::Cow;
use std::ffi::OsString;
use std::io::{self, IsTerminal as _, Write as _};
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::display::DisplayArgs;
use super::list;
use super::message::{exit_with_error, print_error};
use super::numbers::whole;
use super::output::{lost, print_output, show, write};
use super::progress::Watch;
use super::repeat_command::again;
use super::report_output::{Reports, WAIVER};
use super::run_client::ClientArgs;
use super::run_testee;
use super::serve::find_defect;
use super::target::{DeadlineArgs, REACHING_A_DEVICE, TargetArgs, WHAT_MAY_BE_WRITTEN};
use crate::edition::Edition;
use crate::exit::Exit;
use crate::faults::SeededDefect;
use crate::judge::{
    Case, CaseOutcome, CaseSubject, ENOUGH, Needs, Plan, Selection, Unmatched, Waivers, any_seed,
};
use crate::process::interrupt::Interrupt;
use crate::profile::{self, Profile};
use crate::report::{self, DisplayOptions, Report, RunInfo, TargetReport};
use crate::session::ToolError;
use crate::simulator::Model;
use crate::suite::{self, Changes};
use crate::text::{Moment, plural};

mod target;

/// The heading of these options in the help.
const SELECTION: &str = "Selection";

/// Judge a device, a codec, a client or the simulated CNC by the requirements
///
/// Without --target, the run starts a simulated CNC on this machine and judges it together with the
/// codec. A device is only read: the run sends only documented queries, to the documented ports.
/// Some queries address the item after the last one, to verify that the device rejects them.
///
/// Without --profile, the run first queries the device for its ports, channels and axes, and judges
/// all of them. Before the cases, it prints what it found and how long the cases will take.
#[derive(Args, Debug)]
#[command(
    after_help = "Exit codes: 0 passed, 1 failed, 2 wrong usage, 3 nothing judged, inconclusive or \
        interrupted, 4 rejected for safety, 5 a waiver is no longer valid, 6 a value was left \
        changed, 70 internal error",
    after_long_help = after_long_help()
)]
pub(super) struct Run {
    /// The time at which the command began.
    #[arg(skip = Moment::now())]
    begun: Moment,

    #[command(flatten)]
    target: TargetArgs,

    #[command(flatten)]
    deadline: DeadlineArgs,

    #[command(flatten)]
    client: ClientArgs,

    /// Judge a codec in any language: start this command, which reads requests on stdin and writes
    /// replies to stdout, one line of JSON each (see conformance/adapters)
    #[arg(
        long,
        value_name = "COMMAND",
        value_parser = NonEmptyStringValueParser::new(),
        conflicts_with_all = [
            "target", "allow_write", "dry_run", "rate", "capture", "profile", "defect"
        ]
    )]
    testee: Option<String>,

    /// Check the protocol of the testee step by step; for authors of adapters
    #[arg(long, hide_short_help = true, requires = "testee",
        conflicts_with_all = ["client", "client_listen", "only", "list", "json", "waivers"])]
    check_protocol: bool,

    /// Also send malformed requests, for example to unknown addresses, to verify that the CNC
    /// rejects them
    ///
    /// The effect on a CNC that accepts them is unknown. Needs `malformed = true` in the file of
    /// --allow-write and a target on loopback. Loopback does not guarantee that no machine moves:
    /// the CNC of an industrial PC and a device at the other end of an SSH tunnel are also reached
    /// through it.
    #[arg(long, hide_short_help = true, requires = "target", conflicts_with_all = ["testee", "client", "client_listen"])]
    malformed: bool,

    /// Run only these cases: an area (VAR), a requirement (VAR-11), a section of a manual and those
    /// below it (ads:4.3, stream:3, service:2), a stream (variable-description) or the ID of a
    /// case; * and ? are wildcards; repeatable or comma-separated [default: all]
    #[arg(long, help_heading = SELECTION, value_name = "AREA|ID|STREAM", value_delimiter = ',')]
    only: Vec<String>,

    /// Judge by this edition only, en-1.05 or de-1.051; the simulated CNC follows the edition
    /// [default: both]
    #[arg(long, hide_short_help = true, help_heading = SELECTION, value_name = "EDITION", value_parser = Edition::by_name)]
    edition: Option<Edition>,

    /// Set the seed of the order of the cases and of the samples of long lists [default: random;
    /// shown in the report]
    #[arg(long, help_heading = SELECTION, value_name = "N", allow_negative_numbers = true,
        value_parser = whole(0..=u32::MAX))]
    seed: Option<u32>,

    /// Read every item of every list of a device, up to 10000 [default: a sample of each list of
    /// more than 256 items, unless a write is allowed]
    #[arg(long, hide_short_help = true, help_heading = SELECTION, requires = "target",
        conflicts_with_all = ["testee", "client", "client_listen"])]
    all: bool,

    /// Stop after N failed cases, waived failures included; the cases of the codec are always all
    /// run
    #[arg(long, hide_short_help = true, help_heading = SELECTION, value_name = "N",
        allow_negative_numbers = true, value_parser = whole(1..=u32::MAX),
        conflicts_with_all = ["testee", "client_listen"])]
    max_fail: Option<u32>,

    /// List the cases without running them; with --seed in the order of the run, with --json as
    /// JSON
    #[arg(long, help_heading = SELECTION)]
    list: bool,

    /// Read from this file what the target claims; skip everything else (see --print-profile)
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,

    /// Print a commented profile to fill in; with --target, filled in with the answers of the
    /// device
    #[arg(long, conflicts_with_all = ["testee", "client", "client_listen", "profile", "defect", "only", "list"])]
    print_profile: bool,

    #[command(flatten)]
    reports: Reports,

    #[command(flatten)]
    display: DisplayArgs,

    /// Enable a defect of the simulated CNC and of the codec's cases (see serve --list-defects)
    #[arg(long, hide_short_help = true, value_name = "ID", conflicts_with = "target")]
    defect: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  ads-cnc run
  ads-cnc run --target 192.0.2.10 --net-id 192.0.2.10.1.1 --source-net-id 192.0.2.20.1.1 \
      --html report.html
  ads-cnc run --testee \"python3 conformance/adapters/python/testee.py\"
  ads-cnc run --client \"./my-client --suite\"
  ads-cnc run --only VAR --defect variable-description.size.flip";

fn after_long_help() -> String {
    format!(
        "{EXAMPLES}

{REACHING_A_DEVICE}

{WHAT_MAY_BE_WRITTEN}

Known failures, a file for --waivers:
{WAIVER}
  A waiver is stale if it has expired, if the case has no verdict on the requirement, or if the
  verdict is a different one. A stale waiver makes the run end with 5 unless a case fails. An unknown
  case is wrong usage. With --waivers or -v, the run prints such an entry for each of up to 20
  failures.

Signals:
  On SIGINT (Ctrl-C), SIGTERM and SIGHUP, the run restores the value under test and reads it back,
  ends the testee or the client, and writes the reports with the results up to then; the other cases
  are interrupted. A second signal ends the run at once and prints which value is left changed.

Exit codes, the first that applies:
  70 internal error, 6 a value was changed and could not be restored, 2 wrong usage, 4 rejected for
  safety, 1 a fail or a vacuous verdict, 5 a stale waiver, 3 nothing judged, or a case is
  inconclusive or interrupted, 0 passed. Warnings and differences do not change the exit code."
    )
}

/// Prints the values that could not be restored; returns whether such values exist.
fn print_left_changed(changes: &Changes) -> bool {
    let left = changes.left();
    for one in &left {
        let _unprinted = writeln!(io::stderr(), "{one}");
    }
    !left.is_empty()
}

fn lossy(argument: OsString) -> String {
    argument.to_string_lossy().into_owned()
}

/// The reason why a run ended without a report.
enum Stopped {
    Usage(String),
    Target(ToolError),
}

impl From<ToolError> for Stopped {
    fn from(error: ToolError) -> Self {
        Self::Target(error)
    }
}

impl From<Unmatched> for Stopped {
    fn from(unmatched: Unmatched) -> Self {
        Self::Usage(unmatched.to_string())
    }
}

impl Run {
    /// Runs the suite and writes its reports, or prints the profile, lists the cases or checks the
    /// testee protocol, as the options say.
    pub(super) fn execute(&self) -> Exit {
        if self.print_profile {
            let text = if self.target.is_device() {
                match self.profile_of_device() {
                    Ok(text) => text,
                    Err(error) => return exit_with_error(error.exit(), error),
                }
            } else {
                profile::EXAMPLE.to_owned()
            };
            return print_output(|out| out.write_all(text.as_bytes()));
        }
        let checked = find_defect(self.defect.as_deref()).and_then(|defect| {
            // An invalid file for --allow-write is an error even without a target.
            self.target.allowed().map_err(|error| error.to_string())?;
            if self.target.has_file() && !self.target.is_device() {
                return Err(
                    "--allow-write needs --target: no file is needed to write to the simulated \
                            CNC of this process"
                        .to_owned(),
                );
            }
            Ok((defect, self.reports.waivers()?, self.profile()?))
        });
        let (defect, waivers, profile) = match checked {
            Ok(checked) => checked,
            Err(why) => return exit_with_error(Exit::Usage, why),
        };
        if let (Some(command), true) = (&self.testee, self.check_protocol) {
            if let Err(error) = Interrupt::catch() {
                return exit_with_error(Exit::Internal, ToolError::uncaught(&error));
            }
            let mut exit = Exit::Success;
            let checked = show(|out| {
                let deadline = self.deadline.begin();
                exit = run_testee::check(command, self.target.timeout(), deadline, out)?;
                Ok(())
            });
            return checked.map_or_else(lost, |()| exit);
        }
        let seed = self.seed.unwrap_or_else(any_seed);
        if self.list {
            return self.list(seed, &profile);
        }
        let changes = Changes::default();
        let exit = self.judged(seed, waivers, profile, defect, &changes);
        let is_left = print_left_changed(&changes);
        match exit {
            Exit::Internal => exit,
            _ if is_left => Exit::UnrestoredValue,
            exit => exit,
        }
    }

    /// Runs the selected cases and writes the reports, also after a signal.
    fn judged(
        &self,
        seed: u32,
        waivers: Waivers,
        profile: Profile,
        defect: Option<SeededDefect>,
        changes: &Changes,
    ) -> Exit {
        let (first, last) = (changes.clone(), changes.clone());
        let first_words = move || {
            if !first.left().is_empty() {
                print_error(
                    "interrupted: restoring the changed value; a second signal ends at once",
                );
            }
        };
        let last_words = move || print_left_changed(&last).then_some(Exit::UnrestoredValue);
        let interrupt = match Interrupt::catch_with(first_words, last_words) {
            Ok(interrupt) => interrupt,
            Err(error) => return exit_with_error(Exit::Internal, ToolError::uncaught(&error)),
        };
        // A run that waits for a client prints no time limit: apart from messages about its
        // options, the first line on stderr must contain the address on which it waits.
        let asks = self.testee.is_some() || self.client.is_wanted() || !self.is_simulated();
        let is_default = self.deadline.is_default();
        if asks && !is_default && !self.client.waits() && !self.display.is_quiet() {
            print_error(self.deadline);
        }
        let report = match &self.testee {
            _ if self.client.is_wanted() => self.of_client(seed, waivers, &interrupt),
            Some(command) => self.testee(command, seed, waivers),
            None if self.is_simulated() => self.simulated(seed, waivers, profile, defect),
            None => self.device(seed, waivers, profile, changes),
        };
        if interrupt.is_requested() && !self.client.waits() {
            print_error("interrupted: the reports contain the results up to now");
        }
        match report {
            Ok(report) => self.write(&report),
            Err(Stopped::Usage(why)) => exit_with_error(Exit::Usage, why),
            Err(Stopped::Target(error)) => {
                print_error(&error);
                // The report of an earlier run could be mistaken for the report of this run.
                if !matches!(error, ToolError::NotSent) {
                    self.reports.remove();
                }
                error.exit()
            }
        }
    }

    /// The profile in the file of --profile, or the default profile, with the edition of --edition
    /// if set. For the simulated CNC, it also has the names that the default profile excludes from
    /// writes.
    fn profile(&self) -> Result<Profile, String> {
        let read = self.profile.as_deref().map(Profile::from_file).transpose();
        let without = if self.is_simulated() {
            let model = Model::default_model().map_err(|error| error.to_string())?;
            Profile { printed_examples: true, ..model.profile() }
        } else {
            Profile::DEVICE
        };
        let kept = if self.is_simulated() { without.unwritten.clone() } else { Cow::default() };
        let profile = read.map_err(|error| error.to_string())?.unwrap_or(without);
        let edition = self.edition.unwrap_or(profile.edition);
        // A write to these objects and elements exchanges axes, and writing the old value does not
        // always undo the exchange.
        let new = kept.iter().filter(|name| !profile.unwritten.contains(name));
        let unwritten = profile.unwritten.iter().chain(new).cloned().collect();
        Ok(Profile { edition, unwritten, ..profile })
    }

    const fn is_simulated(&self) -> bool {
        !(self.target.is_device() || self.target.is_dry())
    }

    fn plan(&self, seed: u32) -> Result<Plan, Unmatched> {
        let selection = Selection { edition: self.edition, only: self.only.clone() };
        if self.client.is_wanted() {
            return selection.plan(self.client.cases(), seed);
        }
        let fits = |case: &Case| match (&self.testee, case.needs) {
            (Some(_), needs) => needs == Needs::Codec,
            (None, Needs::Codec) => self.is_simulated(),
            (None, _) => true,
        };
        let mut cases: Vec<Case> = suite::cases().into_iter().filter(fits).collect();
        if self.testee.is_some() {
            cases.iter_mut().for_each(|case| case.subject = CaseSubject::Testee);
        }
        selection.plan(cases, seed)
    }

    fn testee(&self, command: &str, seed: u32, waivers: Waivers) -> Result<Report, Stopped> {
        let plan = self.plan(seed)?;
        let edition = self.edition.map(Edition::name);
        let timeout = self.target.timeout();
        let cases = plan.cases.clone();
        let begin = Instant::now();
        let judged = {
            let _watch = Watch::start("questions");
            let deadline = self.deadline.begin();
            run_testee::run(command, timeout, cases, seed, edition.as_deref(), deadline)
        };
        let times = vec![(CaseSubject::Testee, begin.elapsed())];
        let (outcomes, left_out) = plan.finish(judged.outcomes);
        let about = RunInfo { times, ..self.about(judged.target, seed, waivers) };
        Ok(Report::new(about, &outcomes, &left_out))
    }

    fn list(&self, seed: u32, profile: &Profile) -> Exit {
        let plan = match self.plan(seed) {
            Ok(plan) => plan,
            Err(why) => return exit_with_error(Exit::Usage, why),
        };
        // Without --target, no gate is needed: every write to the simulated CNC of this process is
        // allowed.
        let gate = self
            .target
            .is_device()
            .then(|| self.target.clone().with_malformed(self.malformed).gate());
        let gate = match gate.transpose() {
            Ok(gate) => gate,
            Err(error) => return exit_with_error(error.exit(), error),
        };
        let unmet = |needs: Needs| {
            let unmet = needs.unmet(gate.as_ref()?, profile);
            unmet.map(|(_, why)| why.to_owned())
        };
        let mut listed = list::of_plan(&plan, unmet);
        // Without --seed, the order of the cases is random.
        if self.seed.is_none() {
            list::sort(&mut listed);
        }
        let written = match self.reports.json() {
            Some(file) => write(file, |out| list::to_json(&listed, out)),
            None => show(|out| list::to_text(&listed, out)),
        };
        written.map_or_else(lost, |()| Exit::Success)
    }

    fn of_client(
        &self,
        seed: u32,
        waivers: Waivers,
        interrupt: &Interrupt,
    ) -> Result<Report, Stopped> {
        let plan = self.plan(seed)?;
        let begin = Instant::now();
        let judged = {
            let _watch = (!self.client.waits()).then(|| Watch::start("cases"));
            let capture = self.target.begin_capture().map_err(|error| error.to_string());
            capture.and_then(|capture| {
                let most = self.max_fail.and_then(|most| usize::try_from(most).ok());
                self.client.judge(&plan, capture, self.deadline.begin(), interrupt, most)
            })
        };
        let times = vec![(CaseSubject::Client, begin.elapsed())];
        let judged = judged.map_err(Stopped::Usage)?;
        let (outcomes, left_out) = plan.finish(judged.outcomes);
        let about = self.about(judged.target, seed, waivers);
        let ended = self.ended(&outcomes);
        let about = RunInfo { frames: judged.frames, times, ended, ..about };
        Ok(Report::new(about, &outcomes, &left_out))
    }

    /// Says how many cases were not run because of --max-fail; `None` if --max-fail ended nothing.
    fn ended(&self, outcomes: &[CaseOutcome]) -> Option<String> {
        let unrun = outcomes.iter().filter(|one| one.note.as_deref() == Some(ENOUGH)).count();
        let most = plural(self.max_fail.filter(|_| unrun > 0)?, "failed case");
        Some(format!("{} not run after {most} (--max-fail)", plural(unrun, "case")))
    }

    fn about(&self, target: TargetReport, seed: u32, waivers: Waivers) -> RunInfo {
        RunInfo {
            time: self.begun,
            edition: self.edition,
            seed,
            only: self.only.clone(),
            target,
            traffic: Vec::new(),
            exchanges: Vec::new(),
            profile: None,
            found: None,
            waivers,
            frames: 0,
            again: Some(again(std::env::args_os().skip(1).map(lossy))),
            times: Vec::new(),
            left_changed: Vec::new(),
            ended: None,
        }
    }

    fn write(&self, report: &Report) -> Exit {
        // What the discovery found was printed on stderr: do not repeat it on stdout if both are
        // terminals.
        let found_shown = io::stdout().is_terminal() && io::stderr().is_terminal();
        let display = DisplayOptions { found_shown, ..self.display.display() };
        self.reports.write(report, |out| report::print(report, display, out))
    }
}
