//! What a case works with: it asks the target and judges the answers.

use std::collections::BTreeMap;
use std::fmt::Display;

use ads_cnc::address::Channel;
use ads_cnc::operation::{Call, CountObjects, ObjectList, Request};
use ads_cnc::{Decode, Description};
use ads_cnc_vectors::Level;

use super::case::{Evidence, Judgement, Rule, Step, Stop};
use crate::client::Client;
use crate::exchange::{Exchange, Fault, Violation};
use crate::profile::Profile;
use crate::verdict::Verdict;

/// The most failed checks a case keeps of one requirement.
const KEPT: usize = 3;

/// The connection, and what has been learnt of the target so far.
#[derive(Debug)]
pub struct Session {
    /// The connection.
    pub client: Client,
    /// What the target claims.
    pub profile: Profile,
    /// Descriptions of the variables of each kind and channel.
    pub(super) variables: BTreeMap<(u32, &'static str), Vec<Description>>,
    /// Requests sent.
    pub frames: usize,
    /// What frames themselves broke, each with its evidence.
    pub violations: Vec<(Violation, Evidence)>,
}

impl Session {
    /// Asks the least there is to ask, to learn whether anybody answers: an error does.
    ///
    /// # Errors
    /// Why there is no answer.
    pub fn greet(&mut self) -> Result<(), Fault> {
        let list = ObjectList::PLATFORM;
        let mut buf = [];
        let call = Request::from(CountObjects::new(list)).encode(&mut buf);
        let call = call.map_err(Fault::Unsendable)?;
        self.client.call(&call).outcome.map(|_| ())
    }

    /// A session over a connection.
    pub fn new(client: Client, profile: Profile) -> Self {
        Self { client, profile, variables: BTreeMap::new(), frames: 0, violations: Vec::new() }
    }
}

/// One case's view of the session.
#[derive(Debug)]
pub struct Probe<'s> {
    /// The session.
    pub session: &'s mut Session,
    judgements: Vec<Judgement>,
    last: Option<Evidence>,
    checks: usize,
}

impl<'s> Probe<'s> {
    pub(super) fn new(session: &'s mut Session) -> Self {
        Self { session, judgements: Vec::new(), last: None, checks: 0 }
    }

    pub(super) fn into_findings(self) -> (Vec<Judgement>, usize) {
        (self.judgements, self.checks)
    }

    /// The channels the target claims, by number.
    pub fn channels(&self) -> Step<Vec<Channel>> {
        let numbers = self.session.profile.channels;
        numbers.iter().map(|&number| Channel::new(number).map_err(harness)).collect()
    }

    /// The first channel.
    pub fn channel(&self) -> Step<Channel> {
        let first = self.channels()?.into_iter().next();
        first.ok_or(Stop::NotApplicable("the target claims no channel".into()))
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
        let verdict = match (kept, rule.level) {
            (true, _) => Verdict::Pass,
            (false, Some(level)) => Verdict::missed(level),
            (false, None) => Verdict::HarnessError,
        };
        self.record(rule.id, verdict, expected.to_string(), found.to_string());
        kept
    }

    /// As [`check`](Self::check), and there is nothing to go on with if it fails.
    pub fn require(
        &mut self,
        rule: impl Into<Rule>,
        kept: bool,
        expected: impl Display,
        found: impl Display,
    ) -> Step {
        if self.check(rule, kept, expected, found) { Ok(()) } else { Err(Stop::Judged) }
    }

    fn record(&mut self, id: &'static str, verdict: Verdict, expected: String, found: String) {
        self.checks = self.checks.saturating_add(1);
        let same = self
            .judgements
            .iter()
            .filter(|judgement| judgement.requirement == id && judgement.verdict == verdict);
        let keep = if verdict == Verdict::Pass { 1 } else { KEPT };
        if same.count() >= keep {
            return;
        }
        let judgement = match verdict {
            Verdict::Pass => Judgement {
                requirement: id,
                verdict,
                expected: String::new(),
                found: String::new(),
                evidence: None,
            },
            _ => {
                let evidence = self.last.clone();
                Judgement { requirement: id, verdict, expected, found, evidence }
            }
        };
        self.judgements.push(judgement);
    }

    /// Sends a call and keeps it as the evidence of the checks that follow.
    pub fn call(&mut self, call: &Call<'_>) -> Step<Exchange> {
        let exchange = self.session.client.call(call);
        if let Err(Fault::Refused(why)) = &exchange.outcome {
            return Err(Stop::Refused(format!("{exchange}: {why}")));
        }
        self.session.frames = self.session.frames.saturating_add(1);
        let evidence = Evidence::from(&exchange);
        for violation in &exchange.violations {
            self.session.violations.push((violation.clone(), evidence.clone()));
        }
        self.last = Some(evidence);
        Ok(exchange)
    }

    /// Sends an operation.
    pub fn send<'a>(&mut self, request: impl Into<Request<'a>>) -> Step<Exchange> {
        let request = request.into();
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
        let exchange = self.send(request)?;
        let data = exchange.answer().and_then(|answer| answer.success());
        self.require(rule, data.is_some(), "an answer", exchange.result())?;
        Ok(data.unwrap_or_default().to_vec())
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
                self.require(rule, false, expected, error)?;
                Err(Stop::Judged)
            }
        }
    }

    /// Sends a call that must be refused; `sibling` differs by the fault only and must not be.
    pub fn refused(
        &mut self,
        rule: impl Into<Rule>,
        what: &str,
        call: &Call<'_>,
        sibling: &Call<'_>,
    ) -> Step {
        let rule = rule.into();
        let accepted = self.call(sibling)?;
        let vacuous = accepted.answer().is_none_or(|answer| answer.success().is_none());
        let sibling = accepted.result();
        let exchange = self.call(call)?;
        match exchange.answer() {
            Some(answer) if answer.success().is_some() => {
                let expected = format!("an error number for {what}");
                self.check(rule, false, expected, answer);
            }
            Some(_) if vacuous => {
                let expected = format!("an error number for {what} only");
                let found = format!("its accepted sibling is refused too: {sibling}");
                self.record(rule.id, Verdict::Vacuous, expected, found);
            }
            Some(_) => {
                self.check(rule, true, "", "");
            }
            None => {
                // Silence is no way to refuse, however little is documented of the request.
                let rule = Rule { id: rule.id, level: Some(Level::Must) };
                self.check(rule, false, format!("an error number for {what}"), exchange.result());
            }
        }
        Ok(())
    }

    /// As [`refused`](Self::refused), for two operations.
    pub fn refuses<'a, 'b>(
        &mut self,
        rule: impl Into<Rule>,
        what: &str,
        request: impl Into<Request<'a>>,
        sibling: impl Into<Request<'b>>,
    ) -> Step {
        let (request, sibling) = (request.into(), sibling.into());
        let mut buf = vec![0; request.encoded_len()];
        let mut sibling_buf = vec![0; sibling.encoded_len()];
        let call = request.encode(&mut buf).map_err(harness)?;
        let sibling = sibling.encode(&mut sibling_buf).map_err(harness)?;
        self.refused(rule, what, &call, &sibling)
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
