//! Judging while parameters come and go: an NC program makes and deletes them as it likes.

use std::fmt::Display;

use ads_cnc::operation::Request;

use super::super::probe::Probe;
use crate::judge::{Evidence, Rule, Step};

/// How often something is tried.
const TRIES: usize = 5;
/// In how many of them it has to fail, and in none be right.
const FAILURES: usize = 3;

/// One check that is not recorded yet.
pub(super) struct Checked {
    rule: Rule,
    kept: bool,
    expected: String,
    found: String,
    evidence: Option<Evidence>,
}

impl Checked {
    /// With the last call as its evidence.
    pub(super) fn new(
        probe: &Probe<'_>,
        rule: impl Into<Rule>,
        kept: bool,
        expected: impl Display,
        found: impl Display,
    ) -> Self {
        let (expected, found) = (expected.to_string(), found.to_string());
        Self { rule: rule.into(), kept, expected, found, evidence: probe.evidence() }
    }

    fn record(self, probe: &mut Probe<'_>) {
        let last = probe.evidence();
        probe.show(self.evidence);
        probe.check(self.rule, self.kept, self.expected, self.found);
        probe.show(last);
    }
}

/// What these answer; nothing if one of them does not.
fn answers(probe: &mut Probe<'_>, guards: &[Request<'_>]) -> Step<Option<Vec<Vec<u8>>>> {
    let mut all = Vec::new();
    for &guard in guards {
        let Some(data) = probe.try_ask(guard)? else { return Ok(None) };
        all.push(data);
    }
    Ok(Some(all))
}

/// Judges what `act` finds, if the guards answer the same before and after it; it gets their
/// answers. What fails is tried again: it has to fail every time. Where nothing stands still,
/// nothing is judged.
pub(super) fn steadily(
    probe: &mut Probe<'_>,
    guards: &[Request<'_>],
    mut act: impl FnMut(&mut Probe<'_>, &[Vec<u8>]) -> Step<Vec<Checked>>,
) -> Step {
    let (mut failed, mut failures) = (Vec::new(), 0_usize);
    for _ in 0..TRIES {
        let Some(before) = answers(probe, guards)? else { continue };
        let checks = act(probe, &before)?;
        if answers(probe, guards)?.as_ref() != Some(&before) {
            continue;
        }
        if checks.iter().all(|check| check.kept) {
            failed = checks;
            failures = FAILURES;
            break;
        }
        failed = checks;
        failures = failures.saturating_add(1);
    }
    if failures >= FAILURES {
        failed.into_iter().for_each(|check| check.record(probe));
    }
    Ok(())
}
