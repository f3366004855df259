//! The report as JUnit XML: a suite for each subject, a test for each case.

use std::io::{self, Write};
use std::time::Duration;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};

use super::FoundReport;
use super::console::describe;
use super::display::RESULT_MAX;
use super::document::{CaseReport, Report};
use super::failures::{finding, sentence};
use crate::judge::{Verdict, WaiverReport, WaiverState};

/// Writes the report as JUnit XML.
///
/// A fail or a vacuous verdict is a failure. An inconclusive verdict, an interrupted case and a
/// harness error are errors. A case is skipped if it was not run, was not judged, or is waived.
/// Warnings and differences pass, with their text in `system-out`. Further failures are in their
/// own suites: values that were not restored in `left-changed`, requests and entries rejected for
/// safety in `rejected`, and stale waivers in `waivers`. Measured times are in seconds.
pub fn to_junit(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let mut xml: Xml<'_> = Writer::new_with_indent(&mut *out, b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let stale: Vec<&WaiverReport> =
        report.waivers.iter().filter(|waiver| waiver.state.is_stale()).collect();
    let of_case = |tests: &Tests, case: &CaseReport| tests.plus(kind(case));
    let all = report.cases.iter().fold(Tests::default(), |tests, case| of_case(&tests, case));
    let failed = |tests: Tests, number: usize| {
        (0..number).fold(tests, |tests, _| tests.plus(JunitKind::Failure))
    };
    let (left, rejected) = (&report.left_changed, &report.rejected);
    let all = failed(failed(failed(all, stale.len()), left.len()), rejected.len());
    let milliseconds = report.subjects.iter().map(|one| one.milliseconds).sum();
    let all = Tests { milliseconds, ..all };
    let mut root = BytesStart::new("testsuites");
    put(&mut root, "name", "ads-cnc");
    all.put(&mut root);
    xml.write_event(Event::Start(root))?;
    if !left.is_empty() {
        begin_suite(&mut xml, report, "left-changed", failed(Tests::default(), left.len()))?;
        for one in left {
            failure(&mut xml, (&one.name, "left-changed"), (&one.to_string(), "left-changed"))?;
        }
        end(&mut xml, "testsuite")?;
    }
    if !rejected.is_empty() {
        begin_suite(&mut xml, report, "rejected", failed(Tests::default(), rejected.len()))?;
        for why in rejected {
            failure(&mut xml, (why, "rejected"), (why, "rejected"))?;
        }
        end(&mut xml, "testsuite")?;
    }
    for subject in &report.subjects {
        let sorted = report.sorted();
        let cases = || sorted.iter().copied().filter(|case| case.subject == subject.subject);
        let tests = cases().fold(Tests::default(), |tests, case| of_case(&tests, case));
        let tests = Tests { milliseconds: subject.milliseconds, ..tests };
        begin_suite(&mut xml, report, subject.subject.name(), tests)?;
        cases().try_for_each(|one| case(&mut xml, report, one))?;
        end(&mut xml, "testsuite")?;
    }
    if !stale.is_empty() {
        begin_suite(&mut xml, report, "waivers", failed(Tests::default(), stale.len()))?;
        for waiver in stale {
            let name = format!("{} {}", waiver.test, waiver.requirement);
            failure(&mut xml, (&name, "waivers"), (&in_words(waiver), "stale"))?;
        }
        end(&mut xml, "testsuite")?;
    }
    end(&mut xml, "testsuites")?;
    writeln!(xml.get_mut())
}

type Xml<'w> = Writer<&'w mut dyn Write>;

/// The result of a test in JUnit.
#[derive(Clone, Copy, PartialEq, Eq)]
enum JunitKind {
    Passed,
    Failure,
    Error,
    Skipped,
}

fn kind(case: &CaseReport) -> JunitKind {
    match case.verdict {
        _ if case.waived => JunitKind::Skipped,
        Verdict::Pass | Verdict::Warning | Verdict::Differs => JunitKind::Passed,
        Verdict::Fail | Verdict::Vacuous => JunitKind::Failure,
        Verdict::Inconclusive | Verdict::Interrupted | Verdict::HarnessError => JunitKind::Error,
        Verdict::NotApplicable | Verdict::NotObserved | Verdict::NotRun => JunitKind::Skipped,
    }
}

#[derive(Clone, Copy, Default)]
struct Tests {
    tests: usize,
    failures: usize,
    errors: usize,
    skipped: usize,
    milliseconds: Option<u64>,
}

impl Tests {
    fn plus(self, kind: JunitKind) -> Self {
        let one = |number: usize, of: JunitKind| number + usize::from(kind == of);
        Self {
            tests: self.tests + 1,
            failures: one(self.failures, JunitKind::Failure),
            errors: one(self.errors, JunitKind::Error),
            skipped: one(self.skipped, JunitKind::Skipped),
            milliseconds: self.milliseconds,
        }
    }

    fn put(self, element: &mut BytesStart<'_>) {
        let Self { tests, failures, errors, skipped, milliseconds } = self;
        for (name, number) in
            [("tests", tests), ("failures", failures), ("errors", errors), ("skipped", skipped)]
        {
            put(element, name, &number.to_string());
        }
        put_time(element, milliseconds);
    }
}

/// Adds a time in seconds, if it is known.
fn put_time(element: &mut BytesStart<'_>, milliseconds: Option<u64>) {
    if let Some(time) = milliseconds.map(Duration::from_millis) {
        put(element, "time", &format!("{:.3}", time.as_secs_f64()));
    }
}

fn begin_suite(xml: &mut Xml<'_>, report: &Report, name: &str, tests: Tests) -> io::Result<()> {
    let mut suite = BytesStart::new("testsuite");
    put(&mut suite, "name", name);
    tests.put(&mut suite);
    put(&mut suite, "timestamp", report.time.trim_end_matches('Z'));
    xml.write_event(Event::Start(suite))?;
    xml.write_event(Event::Start(BytesStart::new("properties")))?;
    for (name, value) in properties(report) {
        let mut property = BytesStart::new("property");
        put(&mut property, "name", name);
        put(&mut property, "value", &value);
        xml.write_event(Event::Empty(property))?;
    }
    end(xml, "properties")
}

fn properties(report: &Report) -> Vec<(&'static str, String)> {
    let Report {
        suite, vectors, editions, seed, only, target, profile, found, waivers, ended, ..
    } = report;
    let mut all = vec![
        ("suite", suite.clone()),
        ("vectors", vectors.clone()),
        ("editions", editions.join(" ")),
        ("seed", seed.to_string()),
        ("target", describe(target)),
    ];
    all.extend(target.device.iter().map(|device| ("device", device.to_string())));
    all.extend(profile.iter().map(|profile| ("profile", profile.name.clone())));
    all.extend(found.iter().map(|found| ("found", found.summary())));
    let sampled = found.iter().filter_map(FoundReport::sampled);
    all.extend(sampled.map(|sampled| ("sampled", sampled)));
    all.extend((!only.is_empty()).then(|| ("only", only.join(" "))));
    all.extend(waivers.iter().map(|waiver| ("waiver", in_words(waiver))));
    all.extend(ended.iter().map(|why| ("ended", why.clone())));
    all.push(("exit_code", report.exit_code.to_string()));
    all
}

/// A waiver on one line.
pub(super) fn in_words(waiver: &WaiverReport) -> String {
    let WaiverReport { test, requirement, verdict, reason, expires, state, .. } = waiver;
    format!("{test} {requirement} {verdict} until {expires}, {}: {reason}", state.name())
}

fn case(xml: &mut Xml<'_>, report: &Report, case: &CaseReport) -> io::Result<()> {
    let group = case.stream.as_deref().or_else(|| case.id.split('-').next()).unwrap_or_default();
    let mut test = BytesStart::new("testcase");
    put(&mut test, "name", &case.id);
    put(&mut test, "classname", &format!("{}.{group}", case.subject));
    put(&mut test, "assertions", &case.checks.to_string());
    put_time(&mut test, case.milliseconds);
    let findings = text(case)?;
    let most_severe = case.failures.iter().rev().max_by_key(|failure| {
        (failure.verdict.fails_run() && !failure.waived, failure.verdict.severity())
    });
    let message = match (&case.note, most_severe) {
        (_, Some(failure)) => {
            let sentence = sentence(failure, RESULT_MAX);
            format!("{}: {}: {sentence}", failure.requirement, case.title)
        }
        (Some(note), None) => format!("{}: {note}", case.title),
        (None, None) => case.title.clone(),
    };
    let element = match kind(case) {
        JunitKind::Passed if findings.is_empty() => return xml.write_event(Event::Empty(test)),
        JunitKind::Passed => "system-out",
        JunitKind::Failure => "failure",
        JunitKind::Error => "error",
        JunitKind::Skipped => "skipped",
    };
    xml.write_event(Event::Start(test))?;
    let waived =
        waivers(report, case).map(|WaiverReport { requirement, expires, reason, .. }| {
            format!("{requirement} waived until {expires}: {reason}")
        });
    let waived = waived.collect::<Vec<String>>().join("; ");
    let message = if waived.is_empty() { message } else { waived };
    let mut inner = BytesStart::new(element);
    if element != "system-out" {
        put(&mut inner, "message", &message);
    }
    if matches!(kind(case), JunitKind::Failure | JunitKind::Error) {
        put(&mut inner, "type", case.verdict.name());
    }
    xml.write_event(Event::Start(inner))?;
    xml.write_event(Event::Text(BytesText::new(&clean(&findings))))?;
    end(xml, element)?;
    end(xml, "testcase")
}

/// The waivers of a waived case.
fn waivers<'r>(report: &'r Report, case: &CaseReport) -> impl Iterator<Item = &'r WaiverReport> {
    let used = report.waivers.iter().filter(|waiver| waiver.state == WaiverState::Used);
    used.filter(|waiver| case.waived && waiver.test == case.id)
}

/// Writes a failed test that is not a case.
fn failure(
    xml: &mut Xml<'_>,
    (name, class): (&str, &str),
    (message, kind): (&str, &str),
) -> io::Result<()> {
    let mut test = BytesStart::new("testcase");
    put(&mut test, "name", name);
    put(&mut test, "classname", class);
    xml.write_event(Event::Start(test))?;
    let mut failure = BytesStart::new("failure");
    put(&mut failure, "message", message);
    put(&mut failure, "type", kind);
    xml.write_event(Event::Empty(failure))?;
    end(xml, "testcase")
}

/// The checks of a case that did not pass, as text.
fn text(case: &CaseReport) -> io::Result<String> {
    let mut out = Vec::new();
    for all in case.findings() {
        finding(case.subject, &all, &mut out)?;
    }
    Ok(String::from_utf8_lossy(&out).into_owned())
}

fn end(xml: &mut Xml<'_>, name: &str) -> io::Result<()> {
    xml.write_event(Event::End(BytesEnd::new(name)))
}

fn put(element: &mut BytesStart<'_>, name: &str, value: &str) {
    element.push_attribute((name, clean(value).as_str()));
}

/// Replaces each character that XML does not allow, not even escaped, by U+FFFD.
fn clean(text: &str) -> String {
    let allowed = |c: char| {
        matches!(c, '\t' | '\n' | '\r') || c >= ' ' && !matches!(c, '\u{fffe}' | '\u{ffff}')
    };
    text.chars().map(|c| if allowed(c) { c } else { '\u{fffd}' }).collect()
}
