//! Two ways to the same value. A machine moves: only one that stands still meanwhile is judged.

use ads_cnc::operation::Request;
use ads_cnc_vectors::Hex;

use super::probe::Probe;
use crate::judge::{Rule, Step, Stop};

/// How often a value that does not stand still is read again.
const TRIES: usize = 3;

/// What came of comparing.
#[derive(Debug, Default)]
pub(super) struct Steady {
    judged: bool,
    moved: Option<String>,
}

impl Steady {
    /// Holds what `other` reads against what `one` reads before and after it.
    pub(super) fn same(
        &mut self,
        probe: &mut Probe<'_>,
        rules: &[Rule],
        what: &str,
        one: impl Into<Request<'static>>,
        other: Request<'_>,
    ) -> Step {
        let one = one.into();
        self.same_part(probe, rules, what, one, other, |bytes| bytes.to_vec())
    }

    /// As [`same`](Self::same), where `other` reads a part.
    pub(super) fn same_part(
        &mut self,
        probe: &mut Probe<'_>,
        rules: &[Rule],
        what: &str,
        one: Request<'_>,
        other: Request<'_>,
        part: impl Fn(&[u8]) -> Vec<u8>,
    ) -> Step {
        let mut differs = None;
        for _ in 0..TRIES {
            // Whether that is answered at all is judged elsewhere.
            let Some(before) = probe.try_ask(one)? else { return Ok(()) };
            let Some(read) = probe.try_ask(other)? else {
                self.judge(probe, rules, false, format!("an answer of {what}"), "an error");
                return Ok(());
            };
            if part(&before) == read {
                self.judge(probe, rules, true, String::new(), "");
                return Ok(());
            }
            let stood = probe.try_ask(one)?.as_ref() == Some(&before);
            differs = stood.then_some((before, read));
        }
        match differs {
            // It stood still before and after, and read otherwise in between.
            Some((before, read)) => {
                let expected = format!("{} of {what}", Hex(part(&before)));
                self.judge(probe, rules, false, expected, &Hex(read).to_string());
            }
            None => self.moved = Some(format!("{what} does not stand still")),
        }
        Ok(())
    }

    fn judge(
        &mut self,
        probe: &mut Probe<'_>,
        rules: &[Rule],
        kept: bool,
        expected: String,
        found: &str,
    ) {
        self.judged = true;
        for &rule in rules {
            probe.check(rule, kept, &expected, found);
        }
    }

    /// Nothing was judged if nothing stood still.
    pub(super) fn finish(self) -> Step {
        match (self.judged, self.moved) {
            (false, Some(moved)) => Err(Stop::Inconclusive(moved)),
            _ => Ok(()),
        }
    }
}
