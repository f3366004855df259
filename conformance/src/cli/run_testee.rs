//! `ads-cnc run --testee`: a codec behind a pipe.

use std::io::{self, Write};
use std::time::Duration;

use crate::deadline::Deadline;
use crate::judge::{Case, Exit, Outcome, Subject};
use crate::process::interrupt;
use crate::report::TargetReport;
use crate::testee::{Finding, Judged, Process, Terms, check_protocol, judge};
use crate::text::shorten;

/// The last of stderr that a report keeps.
const STDERR_SHOWN: usize = 4000;

/// The most characters of a name that are shown.
const SAID_MAX: usize = 200;

pub(super) struct OfTestee {
    pub(super) target: TargetReport,
    pub(super) outcomes: Vec<Outcome>,
}

/// Asks the testee that this command starts all of these cases.
pub(super) fn run(
    command: &str,
    timeout: Duration,
    cases: Vec<Case>,
    seed: u32,
    edition: Option<&str>,
    deadline: Deadline,
) -> OfTestee {
    let mut process = Process::new(command, timeout).with_deadline(deadline);
    let terms = Terms { seed, subject: Subject::Testee, edition, strict: false };
    let Judged { hello, outcomes, .. } = judge(&mut process, cases, terms);
    let identity = hello.map(|hello| hello.testee);
    let given = identity.as_ref().map(|one| [&*one.name, &*one.version, &*one.language]);
    OfTestee { target: target("testee", command, given, &process.stderr()), outcomes }
}

/// What a report says of a program that a command started: the name, version and language it gave,
/// and the last of stderr.
pub(super) fn target(
    kind: &str,
    command: &str,
    given: Option<[&str; 3]>,
    stderr: &str,
) -> TargetReport {
    let given = given.unwrap_or_default().map(|text| shorten(text, SAID_MAX));
    let [name, version, language] = given.map(|text| Some(text).filter(|text| !text.is_empty()));
    let skipped = stderr.chars().count().saturating_sub(STDERR_SHOWN);
    let last: String = stderr.chars().skip(skipped).collect();
    TargetReport {
        name: name.unwrap_or_else(|| kind.to_owned()),
        version,
        language,
        command: Some(command.to_owned()),
        stderr: Some(last).filter(|last| !last.is_empty()),
        ..TargetReport::default()
    }
}

/// Goes through the protocol step by step, and says of each what is wrong and how it should be.
pub(super) fn check(command: &str, timeout: Duration, out: &mut dyn Write) -> io::Result<Exit> {
    let mut process = Process::new(command, timeout);
    let mut faults = 0_usize;
    let findings = check_protocol(&mut process);
    if interrupt::came() {
        writeln!(out, "Interrupted: the protocol was not gone through.")?;
        return Ok(Exit::Nothing);
    }
    for Finding { what, sent, received, fault } in findings {
        match &fault {
            None => writeln!(out, "ok     {what}")?,
            Some(fault) => {
                faults += 1;
                writeln!(out, "WRONG  {what}: {fault}")?;
                for (mark, line) in [("→", sent), ("←", received)] {
                    if let Some(line) = line {
                        writeln!(out, "       {mark} {line}")?;
                    }
                }
            }
        }
    }
    let stderr = process.stderr();
    if !stderr.is_empty() {
        writeln!(out, "stderr, which is not judged:")?;
        for line in stderr.lines().rev().take(20).collect::<Vec<_>>().into_iter().rev() {
            writeln!(out, "       {line}")?;
        }
    }
    match faults {
        0 => {
            writeln!(out, "The protocol is kept; run without --check-protocol judges the codec.")?;
            Ok(Exit::Success)
        }
        _ => {
            writeln!(out, "{faults} wrong; the protocol is in conformance/adapters/README.md")?;
            Ok(Exit::Failure)
        }
    }
}
