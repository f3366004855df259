//! Compares a report with an earlier one.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::failures::list;
use super::model::{Report, RequirementReport};
use crate::judge::{CaseSubject, Verdict};
use crate::text::plural;

/// Maximum number of cases that a line names.
const CASES_MAX: usize = 3;

/// How a verdict has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Change {
    NoLongerJudged,
    NewlyJudged,
    Mended,
    NewlyFailing,
}

impl Change {
    const fn name(self) -> &'static str {
        match self {
            Self::NoLongerJudged => "no longer judged",
            Self::NewlyJudged => "newly judged",
            Self::Mended => "mended",
            Self::NewlyFailing => "newly failing",
        }
    }

    /// The change from one verdict to another; `None` without one that matters.
    fn of(before: Option<&RequirementReport>, now: Option<&RequirementReport>) -> Option<Self> {
        let fails = |one: Option<&RequirementReport>| one.is_some_and(is_failing);
        let judged =
            |one: Option<&RequirementReport>| one.is_some_and(|one| one.verdict.is_judged());
        match (fails(before), fails(now)) {
            (false, true) => Some(Self::NewlyFailing),
            (true, false) if judged(now) => Some(Self::Mended),
            (true, true) => None,
            _ if !judged(before) && judged(now) => Some(Self::NewlyJudged),
            _ if judged(before) && !judged(now) => Some(Self::NoLongerJudged),
            _ => None,
        }
    }
}

const fn is_failing(one: &RequirementReport) -> bool {
    !one.waived && matches!(one.verdict, Verdict::Fail | Verdict::Vacuous | Verdict::HarnessError)
}

type Judged<'r> = BTreeMap<(CaseSubject, &'r str, &'r str), &'r RequirementReport>;

fn judged(report: &Report) -> Judged<'_> {
    let of_case = report.cases.iter().flat_map(|case| {
        let requirements = case.requirements.iter();
        requirements.map(|one| ((case.subject, one.requirement.as_str(), case.id.as_str()), one))
    });
    of_case.collect()
}

/// Writes what has changed since an earlier report, what fails newly last; returns whether there is any.
pub fn compare(now: &Report, before: &Report, out: &mut dyn Write) -> io::Result<bool> {
    let (new, old) = (judged(now), judged(before));
    let mut changes: BTreeMap<(Change, &str, CaseSubject), Vec<String>> = BTreeMap::new();
    for key in new.keys().chain(old.keys().filter(|key| !new.contains_key(*key))) {
        let (before, now) = (old.get(key).copied(), new.get(key).copied());
        let Some(change) = Change::of(before, now) else { continue };
        let (subject, requirement, case) = *key;
        let [was, is] = [before, now].map(|one| one.map_or("not there", |one| one.verdict.name()));
        let cases = changes.entry((change, requirement, subject)).or_default();
        cases.push(format!("{case} ({was} -> {is})"));
    }
    writeln!(out, "before   {}, {}, seed {}", before.time, before.target.name, before.seed)?;
    writeln!(out, "now      {}, {}, seed {}", now.time, now.target.name, now.seed)?;
    for ((change, requirement, subject), cases) in &changes {
        let (change, cases) = (change.name(), list(cases.iter().map(String::as_str), CASES_MAX));
        writeln!(out, "{change:<16}  {requirement:<7}  {subject}  {cases}")?;
    }
    let number = |wanted: Change| {
        let all = changes.iter().filter(|((change, ..), _)| *change == wanted);
        all.map(|(_, cases)| cases.len()).sum::<usize>()
    };
    let failing = number(Change::NewlyFailing);
    writeln!(
        out,
        "{failing} newly failing, {} mended, {} newly judged, {} no longer judged, of {}",
        number(Change::Mended),
        number(Change::NewlyJudged),
        number(Change::NoLongerJudged),
        plural(new.len(), "verdict")
    )?;
    Ok(failing > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_one_of_failing_or_of_being_judged() {
        use Verdict::*;
        let one = |verdict, waived| RequirementReport {
            requirement: "VAR-8".to_owned(),
            verdict,
            waived,
        };
        let change = |before, now| Change::of(Some(&one(before, false)), Some(&one(now, false)));
        assert_eq!(change(Pass, Fail), Some(Change::NewlyFailing));
        assert_eq!(change(NotRun, Fail), Some(Change::NewlyFailing));
        assert_eq!(change(Fail, Pass), Some(Change::Mended));
        assert_eq!(change(Fail, NotRun), Some(Change::NoLongerJudged));
        assert_eq!(change(NotRun, Pass), Some(Change::NewlyJudged));
        assert_eq!(change(Fail, Vacuous), None);
        assert_eq!(change(Pass, Warning), None);
        assert_eq!(Change::of(None, Some(&one(Fail, true))), Some(Change::NewlyJudged));
        assert_eq!(Change::of(None, Some(&one(Fail, false))), Some(Change::NewlyFailing));
        assert_eq!(Change::of(Some(&one(Pass, false)), None), Some(Change::NoLongerJudged));
    }
}
