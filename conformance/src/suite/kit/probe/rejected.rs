//! Requests that a target must reject.

use ads_cnc::operation::Request;
use ads_cnc_vectors::Level;
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Rule, Rules, Step, Stop, Verdict};
use crate::suite::kit::{IntoRawCall, Probe};

impl Probe<'_> {
    /// Sends a request that must be rejected. `sibling` is the same request without the fault; it
    /// is sent first, because a rejection proves nothing if the target also rejects `sibling`.
    ///
    /// A success without data is accepted as a rejection, because it returns no value of an object
    /// that does not exist. The case `ads-every-refusal` judges it if `sibling` has succeeded and a
    /// rule has the level *must*.
    pub(crate) fn rejects<'a, 'b>(
        &mut self,
        rules: impl Rules,
        what: &str,
        request: impl IntoRawCall<'a>,
        sibling: impl IntoRawCall<'b>,
    ) -> Step {
        let rules: Vec<Rule> = rules.rules().collect();
        let (request, sibling) = (request.into_raw_call()?, sibling.into_raw_call()?);
        let accepted = self.call(&sibling)?;
        let (is_vacuous, shown) = (accepted.success().is_none(), self.last.clone());
        let exchange = self.call(&request)?;
        self.expect_rejection();
        let expected = || format!("an error number for {what}");
        let given = exchange.reply().map(|reply| reply.success().unwrap_or_default());
        match given {
            Some([]) if is_vacuous => {
                self.last = shown;
                let expected = || format!("{}, and a success without this fault", expected());
                let found = || format!("an error also without the fault: {}", accepted.result());
                for rule in rules {
                    // The target did not accept the sibling. A rule below the level *must* is
                    // recorded as not met, which does not fail a run. The verdict *vacuous* would.
                    let verdict = match rule.level {
                        Some(Level::Must) => Verdict::Vacuous,
                        Some(level) => Verdict::missed(level),
                        None => Verdict::HarnessError,
                    };
                    self.record(rule, verdict, expected, found);
                }
            }
            Some(data) => {
                if exchange.is_error() {
                    let rejections = &mut self.target.rejections;
                    rejections.by_number = rejections.by_number.saturating_add(1);
                } else if data.is_empty()
                    && rules.iter().any(|rule| rule.level == Some(Level::Must))
                {
                    let (rule, last) = (Rule::from(ADS_7), &self.last);
                    let found = "a success without data";
                    let by_nothing = &mut self.target.rejections.by_nothing;
                    let verdict = rule.verdict(false);
                    by_nothing.add(rule, verdict, "an error number", found, || last.clone());
                }
                self.check(&rules[..], data.is_empty(), expected, &exchange);
            }
            None => {
                // A missing reply is never permitted, even to an undocumented request.
                let rules: Vec<Rule> = rules.into_iter().map(|rule| rule.at(Level::Must)).collect();
                self.check(&rules[..], false, expected, &exchange);
                if self.target.silences > 1 {
                    return Err(Stop::Judged);
                }
            }
        }
        Ok(())
    }

    /// Checks that a request for an item of an empty list, for which no valid sibling exists, is
    /// rejected. A success without data is accepted as a rejection.
    pub fn rejects_alone<'a>(
        &mut self,
        rules: impl Rules,
        what: &str,
        request: impl Into<Request<'a>>,
    ) -> Step {
        let exchange = self.send(request)?;
        self.expect_rejection();
        let expected = || format!("an error number for {what}");
        self.check(rules, exchange.is_rejected(), expected, &exchange);
        Ok(())
    }

    /// Invalid numbers, of which `first` is the smallest. Most others are the last valid number
    /// (`first - 1`) with a higher bit set. A CNC that truncates numbers would accept them, and
    /// they stay invalid if the list grows by a few items. If the gate allows malformed requests,
    /// more numbers are returned, among them `first + 1` and `u32::MAX`.
    pub fn beyond(&self, first: u32) -> Vec<u32> {
        let last = first.saturating_sub(1);
        let wide = |bits: &[u32]| -> Vec<u32> {
            bits.iter().map(|bit| last | bit).filter(|number| *number > first).collect()
        };
        if !self.target.client.gate().lets_malformed_pass() {
            return [vec![first], wide(&[0x100, 0x1_0000])].concat();
        }
        let far = wide(&[0x100, 0x1_0000, 0x100_0000, 0x8000_0000]);
        [vec![first, first.saturating_add(1)], far, vec![u32::MAX]].concat()
    }
}
