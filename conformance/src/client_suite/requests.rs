//! Judges each request of a client: its headers, and whether the CNC has the requested function.

use std::collections::HashSet;
use std::fmt::Display;

use ads_cnc::ads::{AmsPort, Command, FrameRef};
use ads_cnc::operation::{Call, DispatchError, Effect, Request, Task};
use ads_cnc_vectors::ids::*;

use super::scenario_checks::{ScenarioChecks, evidence};
use super::test_server::RecordedExchange;
use crate::ads_service::{self, service_of};
use crate::client::answer;
use crate::evidence::Evidence;
use crate::exchange::Exchange;
use crate::judge::Rule;
use crate::rules::{Observation, RuleBook, function_at};
use crate::simulator::{DATA_MAX, NET_ID};
use crate::text::plural;

/// Maximum number of requests without a reply that are stored, so that a client cannot exhaust the
/// memory; the invoke IDs of further ones are not compared.
const PENDING_MAX: usize = 1 << 16;

/// Judges the requests of a client.
#[derive(Debug)]
pub(super) struct RequestJudge {
    rules: RuleBook,
    /// The connections and invoke IDs of the requests without a reply.
    pending: HashSet<(usize, u32)>,
    /// Whether requests are compared with earlier replies, for example with the types that they
    /// contained. False in a scenario, in which the suite tells the client the names and may change
    /// replies.
    learns: bool,
}

impl Observation for RecordedExchange {
    fn evidence(&self) -> Evidence {
        evidence(self)
    }
}

impl RequestJudge {
    /// A judge for a client that decides by itself what to request.
    pub(super) fn passive() -> Self {
        Self { learns: true, ..Self::of_scenario() }
    }

    pub(super) fn of_scenario() -> Self {
        Self { rules: RuleBook::new(false), pending: HashSet::new(), learns: false }
    }

    /// Adds the checks of the rule book to `scenario_checks`.
    pub(super) fn finish(self, scenario_checks: &mut ScenarioChecks) {
        scenario_checks.record.append(self.rules.records.into_client_record());
    }

    pub(super) fn judge(
        &mut self,
        exchanges: &[RecordedExchange],
        scenario_checks: &mut ScenarioChecks,
    ) {
        exchanges.iter().for_each(|exchange| self.one(exchange, scenario_checks));
    }

    fn one(&mut self, exchange: &RecordedExchange, scenario_checks: &mut ScenarioChecks) {
        let mut check = |rule: Rule, passed, expected: &str, found: &dyn Display| {
            scenario_checks.check(rule, passed, Some(exchange), expected, || found.to_string());
        };
        let frame = match FrameRef::split(&exchange.request, DATA_MAX) {
            Ok(Some((frame, _))) => frame,
            Ok(None) => {
                let found =
                    format!("only the first {} of a frame", plural(exchange.request.len(), "byte"));
                return check(ADS_5.into(), false, "a whole frame", &found);
            }
            Err(error) => return check(ADS_5.into(), false, "a frame", &error),
        };
        let header = frame.header();
        let net_id = header.target.net_id;
        check(ADS_5.into(), net_id == NET_ID, &format!("the NetId {NET_ID}"), &net_id);
        let command = header.command;
        let is_known = (1..=9).contains(&command.0);
        check(ADS_5.into(), is_known, "a command from 1 to 9", &command.0);
        let port = header.target.port;
        let has_task = Task::from_port(port).is_some();
        check(GEN_4.into(), has_task, "port 551, 552 or 553", &port);
        // A client that repeats the invoke ID of a pending request cannot distinguish a late reply
        // to it from the reply to the next request.
        let key = (exchange.connection, header.invoke_id);
        let is_repeated = self.pending.contains(&key);
        if self.pending.len() < PENDING_MAX && !is_answered(exchange, header.invoke_id) {
            self.pending.insert(key);
        }
        self.rules.records.request_headers(exchange, &header, Some(is_repeated));
        let clause =
            service_of(command).map_or(Rule::CLIENT, |one| ads_service::clause(one).into());
        match Call::from_frame(&frame) {
            Err(error) => check(clause, false, &format!("a request of {}", name(command)), &error),
            Ok(None) => {
                let harmless = [Command::READ_DEVICE_INFO, Command::READ_STATE];
                let expected = "Read, Write, ReadWrite, ReadDeviceInfo or ReadState";
                check(Rule::CLIENT, harmless.contains(&command), expected, &name(command));
            }
            Ok(Some(call)) => {
                check(clause, true, "", &"");
                if !has_task {
                    return;
                }
                if let Some(unknown) = self.rules.records.request(exchange, &call) {
                    check(
                        address_clause(&call),
                        false,
                        "a request for a function of the CNC",
                        &unknown,
                    );
                }
                if self.learns {
                    self.reply(exchange, &frame, &call);
                }
            }
        }
    }

    fn reply(&mut self, exchange: &RecordedExchange, asked: &FrameRef<'_>, call: &Call<'_>) {
        let Ok(Some((reply, _))) = FrameRef::split(&exchange.sent, u32::MAX) else { return };
        let header = reply.header();
        let outcome = answer(asked.header(), header, reply.data()).map(|answer| (answer, header));
        let answered = Exchange { outcome, ..Exchange::new(call) };
        self.rules.reply(exchange, NET_ID, call, &answered, &[]);
    }
}

/// Whether the server has sent a frame with this invoke ID.
fn is_answered(exchange: &RecordedExchange, invoke_id: u32) -> bool {
    let mut sent = exchange.sent.as_slice();
    while let Ok(Some((frame, len))) = FrameRef::split(sent, u32::MAX) {
        if frame.header().invoke_id == invoke_id {
            return true;
        }
        sent = sent.get(len..).unwrap_or_default();
    }
    false
}

fn name(command: Command) -> String {
    match service_of(command) {
        Some(service) => service.to_string(),
        None => format!("command {}", command.0),
    }
}

/// The requirement that a request violates if its address has no function of its service.
fn address_clause(call: &Call<'_>) -> Rule {
    match (call.dispatch(), call.port) {
        (Err(DispatchError::Group(_)), AmsPort::COM) => ADR_3.into(),
        (Err(DispatchError::Group(_)), _) => ADR_5.into(),
        (Err(DispatchError::Offset(_)), AmsPort::COM) => COM_5.into(),
        (Err(DispatchError::Offset(_)), _) => SDA_4.into(),
        _ => function_at(call).map_or(ADS_4.into(), |one| Rule::of(one.spec().clause)),
    }
}

/// Calls `then` with the decoded request of an exchange; `None` if the request does not decode.
pub(super) fn with_request<T>(
    exchange: &RecordedExchange,
    then: impl FnOnce(&Request<'_>) -> T,
) -> Option<T> {
    let (frame, _) = FrameRef::split(&exchange.request, DATA_MAX).ok()??;
    let request = Call::from_frame(&frame).ok()??.dispatch().ok()?;
    Some(then(&request))
}

/// The requirement of the function that a request calls, if the function changes the state of the
/// CNC.
pub(super) fn writes(exchange: &RecordedExchange) -> Option<Rule> {
    with_request(exchange, |request| {
        let spec = request.function().spec();
        (spec.effect != Effect::Query).then(|| Rule::of(spec.clause))
    })?
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An invoke ID may be used again after the reply, but not before.
    #[test]
    fn an_invoke_id_of_a_pending_request_is_found() {
        let mut request = vec![0, 0, 32, 0, 0, 0, 127, 0, 0, 1, 1, 1, 0x28, 2, 10, 0, 0, 9, 1, 1];
        request.extend([0, 0x80, 1, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0]);
        let found = |sent: &[u8]| {
            let exchange = RecordedExchange {
                request: request.clone(),
                sent: sent.to_vec(),
                ..RecordedExchange::default()
            };
            let (mut checks, mut judge) = (ScenarioChecks::default(), RequestJudge::of_scenario());
            judge.judge(&[exchange.clone(), exchange], &mut checks);
            judge.finish(&mut checks);
            let mut judgements = checks.record.judgements.iter();
            judgements.any(|one| one.found == "the invoke ID 0x7 of a request without a reply")
        };
        assert!(found(&[]));
        assert!(!found(&request));
    }
}
