//! A case's access to the target: requests and checks.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

mod handle;
mod rejected;

use std::fmt::Display;

use ads_cnc::Decode;
use ads_cnc::address::Channel;
use ads_cnc::operation::{Function, Request};
use ads_cnc_vectors::Level;

use crate::deadline::Deadline;
use crate::evidence::{Describe, Evidence};
use crate::exchange::{Exchange, ExchangeError, Violation};
use crate::gate::Reason;
use crate::judge::{Checks, OrStop as _, Record, Rule, Rules, Step, Stop, Verdict, applicable};
use crate::number::to_usize;
use crate::process::interrupt;
use crate::profile::Claim;
use crate::suite::kit::{RawCall, TargetState};
use crate::text::plural;

/// Number of consecutive requests without a reply after which only requests that restore values are
/// sent.
const SILENCES_MAX: usize = 8;

/// Number of bytes by which a reply may exceed the read length without ending the case.
const EXCESS_MAX: usize = 4096;

/// Maximum number of requests that a case sends with [`Probe::call`], because a target may return
/// endless lists.
const REQUESTS_MAX: usize = 50_000;

/// A case's access to the target.
#[derive(Debug)]
pub struct Probe<'s> {
    pub target: &'s mut TargetState,
    pub(in crate::suite) record: Record,
    last: Option<Evidence>,
    /// The functions called since the last comparison ended; the next check may compare their
    /// replies.
    compared: Vec<Function>,
    /// The variable or object that the following exchanges are about, for their evidence.
    subject: Option<String>,
    requests: usize,
    /// Whether the case was stopped because the run is interrupted.
    pub(crate) interrupted: bool,
    /// Why the [gate](crate::gate) first rejected a write as ambiguous: the file of `--allow-write`
    /// names the value, but the handle or address of the write may also belong to another value.
    ambiguity: Option<String>,
    /// Whether the case has noted that the target has an item that the case applies to.
    has_subject: bool,
    deadline: Option<Deadline>,
}

impl<'s> Probe<'s> {
    pub(crate) fn new(target: &'s mut TargetState) -> Self {
        Self {
            target,
            record: Record::default(),
            last: None,
            compared: Vec::new(),
            subject: None,
            requests: 0,
            interrupted: false,
            ambiguity: None,
            has_subject: false,
            deadline: None,
        }
    }

    /// Sets a deadline after which only requests that restore values are sent.
    pub(crate) fn with_deadline(self, deadline: Option<Deadline>) -> Self {
        Self { deadline, ..self }
    }

    /// The channels that the profile claims, addressed by their numbers, in the order of their
    /// ranks.
    pub fn channels(&self) -> Step<Vec<Channel>> {
        let numbers = &self.target.profile.channels;
        numbers.iter().map(|&number| Ok(Channel::new(number)?)).collect()
    }

    /// The first claimed channel.
    pub fn channel(&self) -> Step<Channel> {
        let first = self.channels()?.into_iter().next();
        first.or_not_applicable("the target claims no channel")
    }

    /// Whether the function of a request is claimed and the [gate](crate::gate) allows the request.
    /// For a write by handle, first tries to [confirm](Self::confirm_handle) the handle to the
    /// gate.
    pub(crate) fn may<'a>(&mut self, request: impl Into<Request<'a>>) -> Step<bool> {
        let request = request.into();
        if self.claims(request.function()) == Claim::No {
            return Ok(false);
        }
        self.confirm_handle(&request)?;
        let checked = self.check_gate(&request)?;
        if let Err(Some(rejection)) = &checked
            && matches!(rejection.reason, Reason::Ambiguous(..))
        {
            self.ambiguity.get_or_insert_with(|| rejection.to_string());
        }
        Ok(checked.is_ok())
    }

    /// Returns the result of the case, given the result of its last step. A case that succeeded or
    /// is not applicable ends as [`Stop::NotPermitted`] if [`may`](Self::may) has found that the
    /// gate rejects a write as ambiguous.
    pub(crate) fn end(&mut self, step: Step) -> Step {
        match (self.ambiguity.take(), step) {
            (Some(why), Ok(()) | Err(Stop::NotApplicable(_))) => Err(Stop::NotPermitted(why)),
            (_, step) => step,
        }
    }

    /// Notes for [`finish`](Self::finish) that the target has an item that the case applies to,
    /// even if no check is made, for example because the value and its name are too long for a
    /// write.
    pub(crate) fn found_subject(&mut self) {
        self.has_subject = true;
    }

    /// Ends a case that has tried all items. A call of [`found_subject`](Self::found_subject) or a
    /// recorded check shows that the target has an item that the case applies to. Without either,
    /// the case is not applicable for the reason `why`.
    pub(crate) fn finish(&self, why: &str) -> Step {
        applicable(self.has_subject || self.record.checks > 0, why)
    }

    /// Whether the target claims a function.
    pub fn claims(&self, function: Function) -> Claim {
        self.target.profile.claims(function)
    }

    /// Records a check that passed.
    pub fn pass(&mut self, rules: impl Rules) {
        self.check(rules, true, "", "");
    }

    /// Like `check`, for a reply whose expected data is `reply`: the evidence of a failure contains
    /// the expected data, too.
    pub fn check_reply(
        &mut self,
        rules: impl Rules,
        kept: bool,
        reply: &[u8],
        expected: impl Describe,
        found: impl Describe,
    ) -> bool {
        if let Some(last) = self.last.as_mut().filter(|_| !kept) {
            last.expect(reply);
        }
        self.check(rules, kept, expected, found);
        if let Some(last) = &mut self.last {
            last.expected = None;
        }
        kept
    }

    /// Like `check`, but a failure ends the case.
    pub fn require(
        &mut self,
        rules: impl Rules,
        kept: bool,
        expected: impl Describe,
        found: impl Describe,
    ) -> Step {
        if self.check(rules, kept, expected, found) { Ok(()) } else { Err(Stop::Judged) }
    }

    /// Adds the checks of another record.
    pub(crate) fn take_over(&mut self, record: Record) {
        self.record.append(record);
    }

    fn record(
        &mut self,
        rule: Rule,
        verdict: Verdict,
        expected: impl Describe,
        found: impl Describe,
    ) {
        if !self.interrupted {
            self.record.add(rule, verdict, expected, found, || self.last.clone());
        }
        self.end_comparison();
    }

    /// Sends a call. The exchange becomes the evidence of the following checks.
    pub(crate) fn call(&mut self, request: &RawCall) -> Step<Exchange> {
        self.target()?;
        let call = request.call();
        self.requests = self.requests.saturating_add(1);
        if self.requests > REQUESTS_MAX {
            let why = format!(
                "{REQUESTS_MAX} requests sent; the target reports more items than can be read"
            );
            return Err(Stop::Inconclusive(why));
        }
        let function = call.dispatch().ok().map(|request| request.function());
        if let Some(function) = function.filter(|one| self.claims(*one) == Claim::No) {
            let why = format!("the profile does not claim {}", function.spec().name);
            return Err(Stop::NotApplicable(why));
        }
        let exchange = self.target.client.call(&call);
        let fault = exchange.outcome.as_ref().err();
        self.record_exchange(fault, &exchange.violations, &exchange, Evidence::from(&exchange))?;
        if exchange.violations.is_empty() && exchange.outcome.is_ok() {
            let cnc = self.target.client.target().net_id;
            self.target.rules.reply(&exchange, cnc, &call, &exchange, &[]);
        }
        if let Some(fault @ ExchangeError::Malformed(_)) = fault {
            // Without a valid reply, the data is unknown. The case `ads-every-frame` judges the
            // frame.
            return Err(Stop::Inconclusive(format!("{exchange}: {fault}")));
        }
        if exchange.contradicts_itself() {
            return Err(Stop::Inconclusive(format!("{exchange}: an error before a success")));
        }
        let given = exchange.success().map_or(0, <[u8]>::len);
        if given > to_usize(call.read_length).saturating_add(EXCESS_MAX) {
            // The case `ads-every-frame` judges the reply. Cases may keep many replies, and compare
            // them in quadratic time.
            let given = plural(given, "byte");
            let read = call.read_length;
            return Err(Stop::Inconclusive(format!("{exchange}: {given} for a length of {read}")));
        }
        if let Some(reply) = exchange.reply() {
            let has_data = reply.data.as_ref().is_some_and(|data| !data.is_empty());
            match reply.success() {
                Some(_) => self.target.any_success = true,
                None if has_data => self.target.error_with_data.clone_from(&self.last),
                None => {}
            }
        }
        if fault.is_none() && !self.target.answered.contains(&call.service) {
            self.target.answered.push(call.service);
        }
        Ok(exchange)
    }

    /// Ends the case if the run is interrupted, the deadline has passed, or the target no longer
    /// answers; also if the file of `--allow-write` would expire before the changed values could be
    /// restored.
    pub(crate) fn target(&mut self) -> Step {
        if interrupt::is_requested() {
            self.interrupted = true;
            return Err(Stop::Interrupted);
        }
        if self.target.changes.any_pending() {
            self.check_time_to_restore(0)?;
        }
        if let Some(deadline) = self.deadline.filter(Deadline::is_over) {
            return Err(Stop::Inconclusive(deadline.to_string()));
        }
        match &self.target.disconnect_reason {
            Some(why) => Err(Stop::Inconclusive(format!("the target no longer answers: {why}"))),
            None => Ok(()),
        }
    }

    /// Counts a request, stores its evidence for the following checks, and records the violations
    /// in its reply. If the gate rejected the request or the connection could not be opened, ends
    /// the case instead.
    pub(crate) fn record_exchange(
        &mut self,
        fault: Option<&ExchangeError>,
        violations: &[Violation],
        what: &impl Display,
        evidence: Evidence,
    ) -> Step {
        let state = &mut *self.target;
        match fault {
            Some(ExchangeError::NotPermitted(rejection)) => {
                let why = format!("{what}: {rejection}");
                // If no file of `--allow-write` could allow the request, the usual cause is an
                // address that the target returned, and the user cannot correct this address.
                let is_of_user = rejection.reason.is_of_file();
                return Err(if is_of_user {
                    Stop::NotPermitted(why)
                } else {
                    Stop::Inconclusive(why)
                });
            }
            Some(ExchangeError::Disconnected(why)) => {
                state.disconnect_reason = Some(why.clone());
                return Err(Stop::Inconclusive(format!("the target no longer answers: {why}")));
            }
            Some(ExchangeError::Malformed(_)) | None => state.silences = 0,
            Some(_) => state.silences = state.silences.saturating_add(1),
        }
        state.frames = state.frames.saturating_add(1);
        if state.silences >= SILENCES_MAX {
            state.disconnect_reason =
                Some(format!("{SILENCES_MAX} consecutive requests without a reply"));
        }
        for Violation { requirement, what } in violations {
            let rule = Rule::from(*requirement);
            let evidence = || Some(evidence.clone());
            state.broken.add(
                rule,
                rule.verdict(false),
                "a frame that follows the rule",
                what,
                evidence,
            );
        }
        if let Some(function) = evidence.function.filter(|one| !self.compared.contains(one)) {
            self.compared.push(function);
        }
        let (subject, compared) = (self.subject.clone(), self.compared.clone());
        self.last = Some(Evidence { subject, compared, ..evidence });
        Ok(())
    }

    /// Sends a request; before a write by handle, also the missing queries that confirm the handle
    /// to the gate.
    pub fn send<'a>(&mut self, request: impl Into<Request<'a>>) -> Step<Exchange> {
        let request = request.into();
        self.confirm_handle(&request)?;
        self.call(&RawCall::new(request)?)
    }

    /// Sends a request that must succeed, and returns the data. A failure ends the case.
    pub fn ask<'a>(&mut self, rules: impl Rules, request: impl Into<Request<'a>>) -> Step<Vec<u8>> {
        let request = request.into();
        let exchange = self.send(request)?;
        let mut rules: Vec<Rule> = rules.rules().collect();
        // A function that the profile claims by name must work, even if its rule is only assumed.
        if self.target.profile.names(request.function()) {
            rules.iter_mut().for_each(|rule| rule.level = Some(Level::Must));
        }
        let data = exchange.success();
        let compared = self.compared.clone();
        self.require(&rules[..], data.is_some(), "a success", &exchange)?;
        // A later check may still compare this reply.
        self.compared = compared;
        Ok(data.unwrap_or_default().to_vec())
    }

    /// Sends a request that may be rejected, and returns the data of a success.
    pub fn try_ask<'a>(&mut self, request: impl Into<Request<'a>>) -> Step<Option<Vec<u8>>> {
        Ok(self.send(request)?.success().map(<[u8]>::to_vec))
    }

    /// Like [`try_ask`](Self::try_ask), but also returns `None` if the data does not decode as `T`.
    pub fn try_read<'a, T>(&mut self, request: impl Into<Request<'a>>) -> Step<Option<T>>
    where
        T: for<'b> Decode<'b>,
    {
        Ok(self.send(request)?.success().and_then(|data| T::decode(data).ok()))
    }

    /// Like [`ask`](Self::ask), but decodes the data, which must be the stream `T`.
    pub fn read<'a, T>(&mut self, rule: impl Into<Rule>, request: impl Into<Request<'a>>) -> Step<T>
    where
        T: for<'b> Decode<'b>,
    {
        let rule = rule.into();
        let data = self.ask(rule, request)?;
        T::decode(&data).map_err(|error| {
            let expected = || format!("a {}", T::STREAM.layout().name);
            self.check(rule, false, expected, || error);
            Stop::Judged
        })
    }

    /// Sets the variable or object that the last call is about, and the following calls up to
    /// [`end_subject`](Self::end_subject).
    pub(crate) fn set_subject(&mut self, subject: impl Display) {
        self.subject = Some(subject.to_string());
        if let Some(last) = &mut self.last {
            last.subject.clone_from(&self.subject);
        }
    }

    /// Clears the subject set by [`set_subject`](Self::set_subject).
    pub(crate) fn end_subject(&mut self) {
        self.subject = None;
    }

    /// Notes that the reply of the last call must be a rejection.
    pub(crate) fn expect_rejection(&mut self) {
        if let Some(last) = &mut self.last {
            last.is_rejection = true;
        }
    }

    /// Ends a comparison: the next check compares only replies that are received from now on.
    pub(crate) fn end_comparison(&mut self) {
        self.compared.clear();
    }

    /// The evidence of the following checks: the exchange of the last call, unless
    /// [`set_evidence`](Self::set_evidence) has replaced it.
    pub(crate) fn evidence(&self) -> Option<Evidence> {
        self.last.clone()
    }

    /// Sets the evidence of the checks until the next call.
    pub(crate) fn set_evidence(&mut self, evidence: Option<Evidence>) {
        self.last = evidence;
    }
}

impl Checks for Probe<'_> {
    fn check(
        &mut self,
        rules: impl Rules,
        kept: bool,
        expected: impl Describe,
        found: impl Describe,
    ) -> bool {
        // After an interrupt, replies are missing through no fault of the target, so no check is
        // recorded.
        if !self.interrupted {
            self.record.add_all(rules, kept, expected, found, || self.last.clone());
        }
        self.end_comparison();
        kept
    }
}

/// Returns the exchange, or ends the case as inconclusive if no valid reply arrived: the target may
/// or may not have executed the request, so later replies prove nothing.
pub(crate) fn with_reply(exchange: Exchange) -> Step<Exchange> {
    match &exchange.outcome {
        Err(fault) => Err(Stop::Inconclusive(format!("{exchange}: {fault}"))),
        Ok(_) => Ok(exchange),
    }
}

/// The data of the reply to a request. `None` if the profile does not claim the function, in which
/// case nothing is sent, or if the reply is not a success, which other cases judge.
pub(crate) fn ask_if_claimed<'a>(
    probe: &mut Probe<'_>,
    request: impl Into<Request<'a>>,
) -> Step<Option<Vec<u8>>> {
    let request = request.into();
    match probe.claims(request.function()) {
        Claim::No => Ok(None),
        Claim::Yes | Claim::Open => probe.try_ask(request),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use ads_cnc::operation::WriteProgramStream;

    use super::*;

    /// A closed connection and a network error leave it open whether a write was executed, as a
    /// timeout does.
    #[test]
    fn without_a_reply_the_effect_of_a_request_is_unknown() {
        let packet = WriteProgramStream::new(Channel::new(1).unwrap(), b"\r\n");
        let request = RawCall::new(packet).unwrap();
        for fault in [
            ExchangeError::Closed,
            ExchangeError::Io("connection reset".to_owned()),
            ExchangeError::Silence(Duration::from_secs(1)),
        ] {
            let exchange = Exchange { outcome: Err(fault), ..Exchange::new(&request.call()) };
            assert!(matches!(with_reply(exchange), Err(Stop::Inconclusive(_))));
        }
    }
}
