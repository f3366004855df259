//! Comparisons of values that may change by themselves, as on a moving machine: such a change is
//! not a failure.

use std::fmt::Display;

use ads_cnc::address::Group;
use ads_cnc::operation::Request;
use ads_cnc_vectors::ids::ADR_12;
use ads_cnc_vectors::{ClauseId, Hex};

use crate::evidence::{Describe, Evidence};
use crate::judge::{Checks as _, Rule, Rules, Step, Stop};
use crate::suite::kit::{Probe, RawCall};

/// Maximum number of attempts of a comparison whose two values differ.
const TRIES: usize = 3;

/// The result of [`compare`]: a value is read, then another reading is made. If the two do not
/// agree, the value is read again, to find out whether it changes by itself; this is done at most
/// [`TRIES`] times.
pub(crate) enum Compared<B, R> {
    /// The value could not be read.
    NoValue,
    /// The other reading returned no data, because the reply was an error or did not arrive.
    NoReply,
    Same,
    /// In the last attempt, both reads of the value returned the same, and the other reading
    /// between them differed. The evidence is that of the other reading.
    Differs(B, R, Option<Box<Evidence>>),
    /// In the last attempt, the second read of the value returned other data than the first, or no
    /// data.
    Moved,
}

/// Compares the result of `other` with the value that `value` reads before it. Ends after [`TRIES`]
/// times, or when `same` returns true or one of the two readings gives no value. After a
/// difference, `value` is called again, to detect a value that changes by itself.
pub(crate) fn compare<B: PartialEq, R>(
    probe: &mut Probe<'_>,
    mut value: impl FnMut(&mut Probe<'_>) -> Step<Option<B>>,
    mut other: impl FnMut(&mut Probe<'_>, &B) -> Step<Option<R>>,
    same: impl Fn(&B, &R) -> bool,
) -> Step<Compared<B, R>> {
    let mut last = Compared::Moved;
    for _ in 0..TRIES {
        let Some(before) = value(probe)? else { return Ok(Compared::NoValue) };
        let Some(read) = other(probe, &before)? else { return Ok(Compared::NoReply) };
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

/// Compares two ways of reading a value, for one value after another, and records whether any of
/// these values could be judged.
#[derive(Debug, Default)]
pub(crate) struct Steady {
    judged: bool,
    moved: Option<String>,
}

impl Steady {
    /// Compares the value that the request `other` reads with the value that the request `one`
    /// reads.
    ///
    /// `rules` fail if the values differ although the value does not change by itself, or if only
    /// `one` returns a value. `what` is the name of the value in the message.
    pub(crate) fn same<'a, 'b>(
        &mut self,
        probe: &mut Probe<'_>,
        rules: impl Rules,
        what: impl Display,
        one: impl Into<Request<'a>>,
        other: impl Into<Request<'b>>,
    ) -> Step {
        let (one, other) = (one.into(), other.into());
        // Another case judges whether `one` returns a value.
        let compared = compare(
            probe,
            |probe| probe.try_ask(one),
            |probe, _| probe.try_ask(other),
            |before, read| before == read,
        )?;
        self.judge(probe, rules, &what, compared, |probe, rules, (before, read, evidence)| {
            probe.set_evidence(evidence.map(|evidence| *evidence));
            let expected = || format!("{} of {what}", Hex(before));
            probe.check(rules, false, expected, || Hex(read));
        });
        Ok(())
    }

    /// Compares the value that the request `by_index`, which contains the rank of a channel, reads
    /// with the value that `logical`, the same request with the channel number, reads.
    ///
    /// If the values differ although the value does not change by itself, or if only `logical`
    /// returns a value, the clauses of [`rules_by_index`] fail.
    pub(crate) fn by_index<'a, 'b>(
        &mut self,
        probe: &mut Probe<'_>,
        clause: ClauseId,
        what: impl Display,
        logical: impl Into<Request<'a>>,
        by_index: impl Into<Request<'b>>,
    ) -> Step {
        let (logical, by_index) = (logical.into(), by_index.into());
        let compared = compare(
            probe,
            |probe| probe.try_ask(logical),
            |probe, _| probe.try_ask(by_index),
            |before, read| before == read,
        )?;
        let outcome = match compared {
            Compared::NoReply => None,
            _ => Some(!matches!(compared, Compared::Differs(..))),
        };
        let rules = rules_by_index(probe, clause, logical, by_index, outcome)?;
        self.judge(probe, &rules[..], &what, compared, |probe, rules, (before, read, evidence)| {
            probe.set_evidence(evidence.map(|evidence| *evidence));
            probe.check(rules, false, || format!("{} of {what}", Hex(before)), || Hex(read));
        });
        Ok(())
    }

    /// Judges the result of [`compare`]; `differs` records a difference.
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
        if matches!(compared, Compared::NoValue | Compared::Moved) {
            probe.end_comparison();
        }
        match compared {
            Compared::NoValue => {}
            Compared::NoReply => {
                let expected = || format!("a success for {what}");
                probe.check(&rules[..], false, expected, "an error");
            }
            Compared::Same => probe.pass(&rules[..]),
            Compared::Differs(before, read, evidence) => {
                differs(probe, &rules, (before, read, evidence));
            }
            Compared::Moved => self.moved = Some(format!("{what} changes by itself")),
        }
    }

    /// Ends the comparisons. The case is inconclusive if no comparison could be judged and at least
    /// one value changed by itself.
    pub(crate) fn finish(self) -> Step {
        match (self.judged, self.moved) {
            (false, Some(moved)) => Err(Stop::Inconclusive(moved)),
            _ => Ok(()),
        }
    }
}

/// The clauses for which the reply to a request by index (with the rank of a channel) is judged.
/// `found` is whether the reply is the expected one, or `None` if it is not a success.
///
/// A correct reply passes `clause` and ADR-12, the requirement that both forms of an address exist.
/// A function that has returned no success although the index equals the logical number is taken to
/// lack the groups without the logical bit. Its replies that are not successes violate only ADR-12.
/// Any other wrong or missing reply violates `clause`: it is taken to concern a wrong instance.
pub(crate) fn rules_by_index(
    probe: &mut Probe<'_>,
    clause: ClauseId,
    logical: Request<'_>,
    by_index: Request<'_>,
    found: Option<bool>,
) -> Step<Vec<ClauseId>> {
    let instance = |request| -> Step<Option<u8>> {
        Ok(RawCall::new(request)?.index_group.parts().map(|group| match group {
            Group::Com(com) => com.instance,
            Group::Class(class) => class.instance,
        }))
    };
    let function = logical.function();
    let without_index_groups = &mut probe.target.without_index_groups;
    if found.is_none() && instance(logical)? == instance(by_index)? {
        without_index_groups.insert(function);
    }
    Ok(match found {
        Some(true) => vec![clause, ADR_12],
        None if without_index_groups.contains(&function) => vec![ADR_12],
        _ => vec![clause],
    })
}

/// Calls `guard`, `act` and `guard` again, and returns the result of `act`; `None` if the results
/// of `guard` differ. If the first result of `guard` is `None`, `act` is not called, and the
/// function returns `None`.
pub(crate) fn between<G: PartialEq, T>(
    probe: &mut Probe<'_>,
    guard: impl Fn(&mut Probe<'_>) -> Step<Option<G>>,
    act: impl FnOnce(&mut Probe<'_>, &G) -> Step<T>,
) -> Step<Option<T>> {
    let Some(before) = guard(probe)? else { return Ok(None) };
    let found = act(probe, &before)?;
    Ok((guard(probe)?.as_ref() == Some(&before)).then_some(found))
}

/// Maximum number of attempts of [`steadily`], including attempts that give no result because the
/// data of their guards, such as the number of parameters, changes meanwhile.
const TRIES_OF_PARAMETERS: usize = 5;
/// If no attempt passes, [`steadily`] records a failure only after at least this number of failed
/// attempts.
const FAILURES: usize = 3;

/// A check before it is recorded.
pub(crate) struct PendingCheck {
    rules: Vec<Rule>,
    passed: bool,
    expected: String,
    found: String,
    evidence: Option<Evidence>,
}

impl PendingCheck {
    /// Creates a check with the current evidence, usually that of the last call.
    pub(crate) fn new(
        probe: &mut Probe<'_>,
        rules: impl Rules,
        passed: bool,
        expected: impl Describe,
        found: impl Describe,
    ) -> Self {
        let words = (!passed).then(|| (expected.describe(), found.describe()));
        let (expected, found) = words.unwrap_or_default();
        let evidence = probe.evidence();
        probe.end_comparison();
        Self { rules: rules.rules().collect(), passed, expected, found, evidence }
    }

    fn record(self, probe: &mut Probe<'_>) {
        let last = probe.evidence();
        probe.set_evidence(self.evidence);
        probe.check(&self.rules[..], self.passed, self.expected, self.found);
        probe.set_evidence(last);
    }
}

/// Records the checks that `act` returns in the first attempt in which all of them pass. If no
/// attempt passes and at least [`FAILURES`] attempts fail, records the checks of the last of these;
/// otherwise records no check.
///
/// An attempt passes or fails only if the requests `guards` succeed and return the same data before
/// and after `act`, which receives this data.
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
        if checks.iter().all(|check| check.passed) {
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
