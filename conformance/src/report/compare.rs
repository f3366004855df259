//! Compares a report with an earlier report.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::display::Detail;
use super::document::{Report, RequirementReport};
use super::failures::list;
use crate::exit::Exit;
use crate::judge::{CaseSubject, Verdict};
use crate::text::plural;

/// Maximum number of cases named on a line.
const CASES_MAX: usize = 3;

/// How a verdict has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Change {
    NoLongerJudged,
    NewlyJudged,
    Fixed,
    NewlyDeviating,
    NewlyFailing,
}

impl Change {
    const fn name(self) -> &'static str {
        match self {
            Self::NoLongerJudged => "no longer judged",
            Self::NewlyJudged => "newly judged",
            Self::Fixed => "fixed",
            Self::NewlyDeviating => "newly deviating",
            Self::NewlyFailing => "newly failing",
        }
    }

    /// The change from one verdict to another; `None` if it is irrelevant.
    fn of(before: Option<&RequirementReport>, now: Option<&RequirementReport>) -> Option<Self> {
        let fails =
            |one: Option<&RequirementReport>| one.is_some_and(|one| one.verdict.is_failure());
        let is_open =
            |one: Option<&RequirementReport>| fails(one) && one.is_some_and(|one| !one.waived);
        let judged =
            |one: Option<&RequirementReport>| one.is_some_and(|one| one.verdict.is_judged());
        let is =
            |one: Option<&RequirementReport>, wanted| one.map(|one| one.verdict) == Some(wanted);
        let deviates = |one| is(one, Verdict::Warning) || is(one, Verdict::Differs);
        match (fails(before), fails(now)) {
            _ if is_open(now) && !is_open(before) => Some(Self::NewlyFailing),
            (true, false) if judged(now) => Some(Self::Fixed),
            (true, true) => None,
            _ if is(before, Verdict::Pass) && deviates(now) => Some(Self::NewlyDeviating),
            _ if deviates(before) && is(now, Verdict::Pass) => Some(Self::Fixed),
            _ if !judged(before) && judged(now) => Some(Self::NewlyJudged),
            _ if judged(before) && !judged(now) => Some(Self::NoLongerJudged),
            _ => None,
        }
    }
}

type Judged<'r> = BTreeMap<(CaseSubject, &'r str, &'r str), &'r RequirementReport>;

fn judged(report: &Report) -> Judged<'_> {
    let of_case = report.cases.iter().flat_map(|case| {
        let requirements = case.requirements.iter();
        requirements.map(|one| ((case.subject, one.requirement.as_str(), case.id.as_str()), one))
    });
    of_case.collect()
}

/// The differences that make two reports hard to compare: in suite, vectors, editions, target,
/// profile, claims of the profile, and selection.
fn differences(now: &Report, before: &Report) -> Vec<String> {
    let differ = |what: &str, before: String, now: String| {
        (before != now).then(|| format!("different {what}: {before} before, {now} now"))
    };
    let target = |report: &Report| {
        let net_id = report.target.net_id.as_deref();
        let net_id = net_id.map_or_else(String::new, |net_id| format!(", AMS NetId {net_id}"));
        format!("{}{net_id}", report.target.name)
    };
    let name = |report: &Report| match &report.profile {
        Some(profile) => profile.name.clone(),
        None => "none".to_owned(),
    };
    let only = |report: &Report| match report.only.as_slice() {
        [] => "all".to_owned(),
        only => only.join(", "),
    };
    let claims = [before, now].map(|report| report.profile.as_ref().map(|one| &one.claims));
    let claims = match claims {
        [Some(old), Some(new)] if name(before) == name(now) => {
            let names = old.keys().chain(new.keys().filter(|name| !old.contains_key(*name)));
            let names = names.filter(|name| old.get(*name) != new.get(*name));
            Some(list(names.map(String::as_str), usize::MAX)).filter(|names| !names.is_empty())
        }
        _ => None,
    };
    let all = [
        differ("suite", before.suite.clone(), now.suite.clone()),
        differ("vectors", before.vectors.clone(), now.vectors.clone()),
        differ("editions", before.editions.join(", "), now.editions.join(", ")),
        differ("target", target(before), target(now)),
        differ("profile", name(before), name(now)),
        claims.map(|names| format!("different claims of the profile: {names}")),
        differ("selection", only(before), only(now)),
    ];
    all.into_iter().flatten().collect()
}

/// Writes the changes since an earlier report, new failures last, and then the number of changes of
/// each kind; with [`Detail::Quiet`], only the numbers. Returns the exit code: [`Exit::Failure`] if
/// a requirement newly fails in a case; otherwise [`Exit::Nothing`] if a requirement is no longer
/// judged in a case; otherwise [`Exit::Success`].
pub fn compare(
    now: &Report,
    before: &Report,
    detail: Detail,
    out: &mut dyn Write,
) -> io::Result<Exit> {
    let warnings = differences(now, before);
    let (new, old) = (judged(now), judged(before));
    let mut changes: BTreeMap<(Change, &str, CaseSubject), Vec<String>> = BTreeMap::new();
    let (mut interrupted, mut all) = (0_usize, 0_usize);
    for key in new.keys().chain(old.keys().filter(|key| !new.contains_key(*key))) {
        all += 1;
        let (before, now) = (old.get(key).copied(), new.get(key).copied());
        let Some(change) = Change::of(before, now) else { continue };
        let is_cut = now.is_some_and(|one| one.verdict == Verdict::Interrupted);
        if change == Change::NoLongerJudged && is_cut {
            interrupted += 1;
            continue;
        }
        let (subject, requirement, case) = *key;
        let [was, is] = [before, now].map(|one| one.map_or("none", |one| one.verdict.name()));
        let cases = changes.entry((change, requirement, subject)).or_default();
        cases.push(format!("{case} ({was} -> {is})"));
    }
    if detail != Detail::Quiet {
        writeln!(out, "before   {}, {}, seed {}", before.time, before.target.name, before.seed)?;
        writeln!(out, "now      {}, {}, seed {}", now.time, now.target.name, now.seed)?;
        warnings.iter().try_for_each(|warning| writeln!(out, "warning  {warning}"))?;
        if interrupted > 0 {
            let (change, verdicts) =
                (Change::NoLongerJudged.name(), plural(interrupted, "verdict"));
            writeln!(out, "{change:<16}  {verdicts}: the run was interrupted")?;
        }
        for ((change, requirement, subject), cases) in &changes {
            let (change, cases) =
                (change.name(), list(cases.iter().map(String::as_str), CASES_MAX));
            writeln!(out, "{change:<16}  {requirement:<7}  {subject}  {cases}")?;
        }
    }
    let number = |wanted: Change| {
        let all = changes.iter().filter(|((change, ..), _)| *change == wanted);
        all.map(|(_, cases)| cases.len()).sum::<usize>()
    };
    let failing = number(Change::NewlyFailing);
    let unjudged = number(Change::NoLongerJudged) + interrupted;
    writeln!(
        out,
        "{failing} newly failing, {} newly deviating, {} fixed, {} newly judged, {unjudged} no \
         longer judged, of {}",
        number(Change::NewlyDeviating),
        number(Change::Fixed),
        number(Change::NewlyJudged),
        plural(all, "verdict")
    )?;
    Ok(match (failing, unjudged) {
        (0, 0) => Exit::Success,
        (0, _) => Exit::Nothing,
        _ => Exit::Failure,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_classified() {
        use Verdict::*;
        let one = |verdict, waived| RequirementReport {
            requirement: "VAR-8".to_owned(),
            verdict,
            waived,
        };
        let change = |before, now| Change::of(Some(&one(before, false)), Some(&one(now, false)));
        let waived = one(Fail, true);
        assert_eq!(change(Pass, Fail), Some(Change::NewlyFailing));
        assert_eq!(change(NotRun, Fail), Some(Change::NewlyFailing));
        assert_eq!(change(Fail, Pass), Some(Change::Fixed));
        assert_eq!(change(Fail, NotRun), Some(Change::NoLongerJudged));
        assert_eq!(change(NotRun, Pass), Some(Change::NewlyJudged));
        assert_eq!(change(Fail, Vacuous), None);
        assert_eq!(change(Pass, Warning), Some(Change::NewlyDeviating));
        assert_eq!(change(Pass, Differs), Some(Change::NewlyDeviating));
        assert_eq!(change(Differs, Warning), None);
        assert_eq!(change(Warning, Pass), Some(Change::Fixed));
        assert_eq!(change(Fail, Warning), Some(Change::Fixed));
        assert_eq!(change(Pass, Interrupted), Some(Change::NoLongerJudged));
        assert_eq!(Change::of(None, Some(&waived)), Some(Change::NewlyJudged));
        assert_eq!(Change::of(Some(&one(Fail, false)), Some(&waived)), None);
        assert_eq!(Change::of(Some(&waived), Some(&one(Fail, false))), Some(Change::NewlyFailing));
        assert_eq!(Change::of(Some(&waived), Some(&one(Pass, false))), Some(Change::Fixed));
        assert_eq!(Change::of(None, Some(&one(Fail, false))), Some(Change::NewlyFailing));
        assert_eq!(Change::of(Some(&one(Pass, false)), None), Some(Change::NoLongerJudged));
    }
}
