//! Comparing while the machine moves: only what stood still meanwhile is judged.

use std::fmt::Display;

use ads_cnc::operation::Request;
use ads_cnc_vectors::Hex;

use crate::judge::{Checks as _, Describe, Evidence, Rule, Rules, Step, Stop};
use crate::suite::kit::Probe;

/// How often a value that does not stand still is read again.
const TRIES: usize = 3;

/// The result of comparing a value, read before and after, with another reading in between.
pub(crate) enum Compared<B, R> {
    /// The value could not be read.
    NoValue,
    /// The reading between them got no answer.
    NoAnswer,
    Same,
    /// In the last attempt both readings of the value were equal, and the reading between them
    /// differed. The evidence is that of the reading between them.
    Differs(B, R, Option<Box<Evidence>>),
    /// In the last attempt the two readings of the value differed.
    Moved,
}

/// Compares what `other` reads with what `value` reads before and after it, at most [`TRIES`] times,
/// until `same` finds them the same.
pub(crate) fn compare<B: PartialEq, R>(
    probe: &mut Probe<'_>,
    mut value: impl FnMut(&mut Probe<'_>) -> Step<Option<B>>,
    mut other: impl FnMut(&mut Probe<'_>, &B) -> Step<Option<R>>,
    same: impl Fn(&B, &R) -> bool,
) -> Step<Compared<B, R>> {
    let mut last = Compared::Moved;
    for _ in 0..TRIES {
        let Some(before) = value(probe)? else { return Ok(Compared::NoValue) };
        let Some(read) = other(probe, &before)? else { return Ok(Compared::NoAnswer) };
        if same(&before, &read) {
            return Ok(Compared::Same);
        }
        let evidence = probe.evidence().map(Box::new);
        last = if value(probe)?.as_ref() == Some(&before) {
            Compared::Differs(before, read, evidence)
        } else {
            Compared::Moved
        };
    }
    Ok(last)
}

/// Two ways to the same value, to be judged by many such pairs.
#[derive(Debug, Default)]
pub(crate) struct Steady {
    judged: bool,
    moved: Option<String>,
}

impl Steady {
    /// Judges what `other` reads by what `one` reads before and after it.
    pub(crate) fn same<'a, 'b>(
        &mut self,
        probe: &mut Probe<'_>,
        rules: impl Rules,
        what: impl Display,
        one: impl Into<Request<'a>>,
        other: impl Into<Request<'b>>,
    ) -> Step {
        let (one, other) = (one.into(), other.into());
        // Whether that is answered at all is judged elsewhere.
        let compared = compare(
            probe,
            |probe| probe.try_ask(one),
            |probe, _| probe.try_ask(other),
            |before, read| before == read,
        )?;
        self.judge(probe, rules, &what, compared, |probe, rules, (before, read, _)| {
            let expected = || format!("{} of {what}", Hex(before));
            probe.check(rules, false, expected, || Hex(read));
        });
        Ok(())
    }

    /// Judges what came of a comparison; `differs` says what differs.
    pub(crate) fn judge<B, R>(
        &mut self,
        probe: &mut Probe<'_>,
        rules: impl Rules,
        what: &impl Display,
        compared: Compared<B, R>,
        differs: impl FnOnce(&mut Probe<'_>, &[Rule], (B, R, Option<Box<Evidence>>)),
    ) {
        let rules: Vec<Rule> = rules.rules().collect();
        self.judged |= !matches!(compared, Compared::NoValue | Compared::Moved);
        match compared {
            Compared::NoValue => {}
            Compared::NoAnswer => {
                let expected = || format!("an answer of {what}");
                probe.check(&rules[..], false, expected, "an error");
            }
            Compared::Same => probe.pass(&rules[..]),
            Compared::Differs(before, read, evidence) => {
                differs(probe, &rules, (before, read, evidence));
            }
            Compared::Moved => self.moved = Some(format!("{what} does not stand still")),
        }
    }

    /// Nothing was judged if nothing stood still.
    pub(crate) fn finish(self) -> Step {
        match (self.judged, self.moved) {
            (false, Some(moved)) => Err(Stop::Inconclusive(moved)),
            _ => Ok(()),
        }
    }
}

/// What `act` finds between two equal readings of a guard; None if the guard moved, or was not read.
pub(crate) fn between<G: PartialEq, T>(
    probe: &mut Probe<'_>,
    guard: impl Fn(&mut Probe<'_>) -> Step<Option<G>>,
    act: impl FnOnce(&mut Probe<'_>, &G) -> Step<T>,
) -> Step<Option<T>> {
    let Some(before) = guard(probe)? else { return Ok(None) };
    let found = act(probe, &before)?;
    Ok((guard(probe)?.as_ref() == Some(&before)).then_some(found))
}

/// How often something is tried while parameters come and go.
const TRIES_OF_PARAMETERS: usize = 5;
/// In how many of them it has to fail, and in none be right.
const FAILURES: usize = 3;

/// One check that is not recorded yet.
pub(crate) struct PendingCheck {
    rules: Vec<Rule>,
    kept: bool,
    expected: String,
    found: String,
    evidence: Option<Evidence>,
}

impl PendingCheck {
    /// With the last call as its evidence.
    pub(crate) fn new(
        probe: &Probe<'_>,
        rules: impl Rules,
        kept: bool,
        expected: impl Describe,
        found: impl Describe,
    ) -> Self {
        let words = (!kept).then(|| (expected.describe(), found.describe()));
        let (expected, found) = words.unwrap_or_default();
        Self { rules: rules.rules().collect(), kept, expected, found, evidence: probe.evidence() }
    }

    fn record(self, probe: &mut Probe<'_>) {
        let last = probe.evidence();
        probe.set_evidence(self.evidence);
        probe.check(&self.rules[..], self.kept, self.expected, self.found);
        probe.set_evidence(last);
    }
}

/// Judges what `act` finds, if the guards answer the same before and after it; it gets their
/// answers. A failed check is repeated and has to fail every time. If the answers of the guards always
/// differ, nothing is judged.
pub(crate) fn steadily(
    probe: &mut Probe<'_>,
    guards: &[Request<'_>],
    mut act: impl FnMut(&mut Probe<'_>, &[Vec<u8>]) -> Step<Vec<PendingCheck>>,
) -> Step {
    let answers = |probe: &mut Probe<'_>| -> Step<Option<Vec<Vec<u8>>>> {
        guards.iter().map(|&guard| probe.try_ask(guard)).collect()
    };
    let mut failures = Vec::new();
    for _ in 0..TRIES_OF_PARAMETERS {
        let checks = between(probe, answers, |probe, answers| act(probe, answers))?;
        let Some(checks) = checks else { continue };
        if checks.iter().all(|check| check.kept) {
            checks.into_iter().for_each(|check| check.record(probe));
            return Ok(());
        }
        failures.push(checks);
    }
    if failures.len() >= FAILURES {
        let last = failures.pop().unwrap_or_default();
        last.into_iter().for_each(|check| check.record(probe));
    }
    Ok(())
}
