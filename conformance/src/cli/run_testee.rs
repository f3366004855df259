//! `ads-cnc run --testee`: judges a codec in another process over stdin and stdout.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::io::{self, Write};
use std::time::Duration;

use crate::codec::message::Identity;
use crate::deadline::Deadline;
use crate::exit::Exit;
use crate::judge::{Case, CaseOutcome, CaseSubject};
use crate::process::interrupt;
use crate::report::TargetReport;
use crate::testee::{
    JudgedTestee, JudgementOptions, ProtocolStepResult, TesteeProcess, check_protocol, judge,
};
use crate::text::shorten;

/// Maximum number of characters of stderr in a report; of a longer stderr, the report contains the
/// end.
const STDERR_SHOWN: usize = 4000;

/// Maximum number of characters of the name, version or language of a program in a report.
const NAME_MAX: usize = 200;

pub(super) struct OfTestee {
    pub(super) target: TargetReport,
    pub(super) outcomes: Vec<CaseOutcome>,
}

/// Runs these cases on the testee that a command starts.
pub(super) fn run(
    command: &str,
    timeout: Duration,
    cases: Vec<Case>,
    seed: u32,
    edition: Option<&str>,
    deadline: Deadline,
) -> OfTestee {
    let mut process = TesteeProcess::new(command, timeout).with_deadline(deadline);
    let terms = JudgementOptions { seed, subject: CaseSubject::Testee, edition, strict: false };
    let JudgedTestee { hello, outcomes, .. } = judge(&mut process, cases, terms);
    let identity = hello.map(|hello| hello.testee);
    OfTestee { target: target("testee", command, identity, &process.stderr()), outcomes }
}

/// The description of a testee or client in a report: name, version, language, command, and the end
/// of stderr. Without a name, the name is `kind`.
pub(super) fn target(
    kind: &str,
    command: &str,
    identity: Option<Identity>,
    stderr: &str,
) -> TargetReport {
    let given = identity.map(|Identity { name, version, language }| [name, version, language]);
    let given = given.unwrap_or_default().map(|text| shorten(&text, NAME_MAX));
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

/// Checks the protocol step by step. Prints each step and, for a wrong step, the fault and the
/// lines sent and received; then the end of stderr. Prints no step if a signal interrupts the
/// check, and only the steps before the deadline.
pub(super) fn check(
    command: &str,
    timeout: Duration,
    deadline: Deadline,
    out: &mut dyn Write,
) -> io::Result<Exit> {
    let mut process = TesteeProcess::new(command, timeout).with_deadline(deadline);
    let findings = check_protocol(&mut process);
    let faults = findings.iter().filter(|finding| finding.fault.is_some()).count();
    if interrupt::is_requested() {
        writeln!(out, "Interrupted: the protocol was not checked.")?;
        return Ok(Exit::Nothing);
    }
    for ProtocolStepResult { what, sent, received, fault } in findings {
        match &fault {
            None => writeln!(out, "ok     {what}")?,
            Some(fault) => {
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
        writeln!(out, "stderr (not judged):")?;
        for line in stderr.lines().rev().take(20).collect::<Vec<_>>().into_iter().rev() {
            writeln!(out, "       {line}")?;
        }
    }
    if deadline.is_over() {
        writeln!(out, "Not all steps were checked: {deadline}.")?;
    }
    match faults {
        0 if deadline.is_over() => Ok(Exit::Nothing),
        0 => {
            writeln!(out, "The protocol is correct. To judge the codec, omit --check-protocol.")?;
            Ok(Exit::Success)
        }
        _ => {
            writeln!(out, "{faults} wrong; see conformance/adapters/README.md for the protocol")?;
            Ok(Exit::Failure)
        }
    }
}
