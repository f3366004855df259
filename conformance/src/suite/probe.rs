//! What a case works with: it asks the target and judges the answers.

mod handle;
mod refused;

use std::fmt::Display;
use std::sync::Arc;

use ads_cnc::Decode;
use ads_cnc::address::Channel;
use ads_cnc::operation::{Call, Function, Request};
use ads_cnc_vectors::Level;

use super::session::Session;
use crate::deadline::Deadline;
use crate::exchange::{Exchange, Fault, Violation};
use crate::gate::Reason;
use crate::judge::{Checks, Evidence, Judgement, Record, Rule, Step, Stop, Verdict};
use crate::process::interrupt;
use crate::profile::Claim;
use crate::simulator::Cnc;

/// Requests in a row without an answer after which no more are sent.
const SILENCES_MAX: usize = 8;

/// Requests of one case after which it ends: a target may say to have no end of anything.
const REQUESTS_MAX: usize = 50_000;

/// One case's view of the session.
#[derive(Debug)]
pub struct Probe<'s> {
    /// The session.
    pub session: &'s mut Session,
    record: Record,
    last: Option<Evidence>,
    asked: usize,
    /// Whether it was kept from asking, as the run is to end.
    pub(super) interrupted: bool,
    /// Why something that the file names is not written.
    doubt: Option<String>,
    deadline: Option<Deadline>,
}

impl<'s> Probe<'s> {
    pub(super) fn new(session: &'s mut Session) -> Self {
        Self {
            session,
            record: Record::default(),
            last: None,
            asked: 0,
            interrupted: false,
            doubt: None,
            deadline: None,
        }
    }

    /// Asks for nothing more after this.
    pub(super) fn with_deadline(self, deadline: Option<Deadline>) -> Self {
        Self { deadline, ..self }
    }

    pub(super) fn into_findings(self) -> (Vec<Judgement>, usize) {
        (self.record.judgements, self.record.checks)
    }

    /// The channels the target claims, by number.
    pub fn channels(&self) -> Step<Vec<Channel>> {
        let numbers = &self.session.profile.channels;
        numbers.iter().map(|&number| Channel::new(number).map_err(harness)).collect()
    }

    /// The first channel.
    pub fn channel(&self) -> Step<Channel> {
        let first = self.channels()?.into_iter().next();
        first.ok_or(Stop::NotApplicable("the target claims no channel".into()))
    }

    /// Whether a request may be sent; of a write by handle the device confirms the handle first.
    pub(super) fn may<'a>(&mut self, request: impl Into<Request<'a>>) -> Step<bool> {
        let request = request.into();
        if self.claims(request.function()) == Claim::No {
            return Ok(false);
        }
        self.confirm_handle(&request)?;
        let checked = self.check_gate(&request)?;
        if let Err(Some(refusal)) = &checked
            && matches!(refusal.reason, Reason::Doubtful(..))
        {
            self.doubt.get_or_insert_with(|| refusal.to_string());
        }
        Ok(checked.is_ok())
    }

    /// How the case ends: one that could not write what the file names did not run to its end.
    pub(super) fn end(&mut self, step: Step) -> Step {
        match (self.doubt.take(), step) {
            (Some(why), Ok(()) | Err(Stop::NotApplicable(_))) => Err(Stop::Refused(why)),
            (_, step) => step,
        }
    }

    /// The CNC itself, to do to it from within what nobody can ask for.
    pub(super) fn cnc(&self) -> Step<Arc<Cnc>> {
        let cnc = self.session.cnc.clone();
        cnc.ok_or_else(|| Stop::NotApplicable("the CNC is not in this process".to_owned()))
    }

    /// Whether the target claims a function.
    pub fn claims(&self, function: Function) -> Claim {
        self.session.profile.claims(function)
    }

    /// Judges one check.
    pub fn check(
        &mut self,
        rule: impl Into<Rule>,
        kept: bool,
        expected: impl Display,
        found: impl Display,
    ) -> bool {
        let rule = rule.into();
        self.record(rule, rule.verdict(kept), expected, found);
        kept
    }

    /// As [`check`](Self::check), where the data of the reply is known to the byte: the evidence
    /// shows both.
    pub fn check_reply(
        &mut self,
        rule: impl Into<Rule>,
        kept: bool,
        reply: &[u8],
        expected: impl Display,
        found: impl Display,
    ) -> bool {
        if let Some(last) = self.last.as_mut().filter(|_| !kept) {
            last.expect(reply);
        }
        let kept = self.check(rule, kept, expected, found);
        if let Some(last) = &mut self.last {
            last.expected = None;
        }
        kept
    }

    /// As [`check`](Self::check), and there is nothing to go on with if it fails.
    pub fn require(
        &mut self,
        rules: &[Rule],
        kept: bool,
        expected: impl Display,
        found: impl Display,
    ) -> Step {
        for &rule in rules {
            self.check(rule, kept, &expected, &found);
        }
        if kept { Ok(()) } else { Err(Stop::Judged) }
    }

    /// Takes over what other cases have found.
    pub(super) fn take_over(&mut self, record: Record) {
        self.record.append(record);
    }

    fn record(
        &mut self,
        rule: Rule,
        verdict: Verdict,
        expected: impl Display,
        found: impl Display,
    ) {
        if self.interrupted {
            // What was not asked for any more is no fault of the target.
            return;
        }
        let last = &self.last;
        self.record.add(rule, verdict, expected, found, || last.clone());
    }

    /// Sends a call and keeps it as the evidence of the checks that follow.
    pub fn call(&mut self, call: &Call<'_>) -> Step<Exchange> {
        self.target()?;
        self.asked = self.asked.saturating_add(1);
        if self.asked > REQUESTS_MAX {
            let why =
                format!("{REQUESTS_MAX} requests, and no end to what the target says to have");
            return Err(Stop::Inconclusive(why));
        }
        let function = call.dispatch().ok().map(|request| request.function());
        if let Some(function) = function.filter(|one| self.claims(*one) == Claim::No) {
            let why = format!("the profile does not claim {}", function.spec().name);
            return Err(Stop::NotApplicable(why));
        }
        let exchange = self.session.client.call(call);
        let fault = exchange.outcome.as_ref().err();
        self.came(fault, &exchange.violations, &exchange, Evidence::from(&exchange))?;
        if fault.is_none() && !self.session.answered.contains(&call.service) {
            self.session.answered.push(call.service);
        }
        Ok(exchange)
    }

    /// Whether there is a target left.
    pub(super) fn target(&mut self) -> Step {
        if interrupt::came() {
            self.interrupted = true;
            return Err(Stop::Interrupted);
        }
        if self.session.changes.any_pending() {
            self.check_time_to_restore()?;
        }
        if let Some(deadline) = self.deadline.filter(Deadline::is_over) {
            return Err(Stop::Inconclusive(deadline.to_string()));
        }
        match &self.session.gone {
            Some(why) => Err(Stop::Inconclusive(format!("no target left: {why}"))),
            None => Ok(()),
        }
    }

    /// What came of a request.
    pub(super) fn came(
        &mut self,
        fault: Option<&Fault>,
        violations: &[Violation],
        what: &impl Display,
        evidence: Evidence,
    ) -> Step {
        let session = &mut *self.session;
        match fault {
            Some(Fault::Refused(why)) => return Err(Stop::Refused(format!("{what}: {why}"))),
            Some(Fault::Gone(why)) => {
                session.gone = Some(why.clone());
                return Err(Stop::Inconclusive(format!("the target is gone: {why}")));
            }
            Some(_) => session.silences = session.silences.saturating_add(1),
            None => session.silences = 0,
        }
        session.frames = session.frames.saturating_add(1);
        if session.silences >= SILENCES_MAX {
            session.gone = Some(format!("{SILENCES_MAX} requests in a row without an answer"));
        }
        for Violation { requirement, what } in violations {
            let rule = Rule::from(*requirement);
            let evidence = || Some(evidence.clone());
            session.broken.add(rule, rule.verdict(false), "a frame as required", what, evidence);
        }
        self.last = Some(evidence);
        Ok(())
    }

    /// Sends an operation.
    pub fn send<'a>(&mut self, request: impl Into<Request<'a>>) -> Step<Exchange> {
        let request = request.into();
        self.confirm_handle(&request)?;
        let mut buf = vec![0; request.encoded_len()];
        let call = request.encode(&mut buf).map_err(harness)?;
        self.call(&call)
    }

    /// Sends an operation that must be answered, and returns the data.
    pub fn ask<'a>(
        &mut self,
        rule: impl Into<Rule>,
        request: impl Into<Request<'a>>,
    ) -> Step<Vec<u8>> {
        self.ask_for(&[rule.into()], request)
    }

    /// As [`ask`](Self::ask), where an answer speaks for several requirements.
    pub fn ask_for<'a>(
        &mut self,
        rules: &[Rule],
        request: impl Into<Request<'a>>,
    ) -> Step<Vec<u8>> {
        let request = request.into();
        let exchange = self.send(request)?;
        let data = exchange.answer().and_then(|answer| answer.success());
        let named = self.session.profile.names(request.function());
        // What is claimed by its name must work, whatever is documented of it.
        let level = |rule: &Rule| if named { Some(Level::Must) } else { rule.level };
        let rules: Vec<Rule> =
            rules.iter().map(|rule| Rule { level: level(rule), ..*rule }).collect();
        self.require(&rules, data.is_some(), "an answer", exchange.result())?;
        Ok(data.unwrap_or_default().to_vec())
    }

    /// Sends an operation and returns the data if it is answered; that it need not be.
    pub fn try_ask<'a>(&mut self, request: impl Into<Request<'a>>) -> Step<Option<Vec<u8>>> {
        let exchange = self.send(request)?;
        Ok(exchange.answer().and_then(|answer| answer.success()).map(<[u8]>::to_vec))
    }

    /// As [`ask`](Self::ask), and the data must be the stream `T`.
    pub fn read<'a, T>(&mut self, rule: impl Into<Rule>, request: impl Into<Request<'a>>) -> Step<T>
    where
        T: for<'b> Decode<'b>,
    {
        let rule = rule.into();
        let data = self.ask(rule, request)?;
        match T::decode(&data) {
            Ok(value) => Ok(value),
            Err(error) => {
                let expected = format!("a {}", T::STREAM.layout().name);
                self.require(&[rule], false, expected, error)?;
                Err(Stop::Judged)
            }
        }
    }

    /// The evidence of the last call.
    pub(super) fn evidence(&self) -> Option<Evidence> {
        self.last.clone()
    }

    /// Puts this evidence under the checks that follow.
    pub(super) fn show(&mut self, evidence: Option<Evidence>) {
        self.last = evidence;
    }
}

/// What the suite builds for itself has to encode.
pub(super) fn harness(error: impl Display) -> Stop {
    Stop::Harness(error.to_string())
}

impl Checks for Probe<'_> {
    fn check(
        &mut self,
        rule: impl Into<Rule>,
        kept: bool,
        expected: impl Display,
        found: impl Display,
    ) -> bool {
        Probe::check(self, rule, kept, expected, found)
    }
}
