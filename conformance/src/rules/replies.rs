//! Judges a reply alone, and passes the reply on for the comparison with earlier replies.

use ads_cnc::ErrorKind;
use ads_cnc::ads::AmsHeader;
use ads_cnc::limits::DESCRIPTOR_LEN;
use ads_cnc::operation::{AdsService, DispatchError, Reply, Request};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::requirement;

use super::knowledge::ExchangeJudge;
use super::observation::Observation;
use super::topic::{Topic, TopicRecords};
use crate::ads_service;
use crate::exchange::{AdsReply, Exchange, Violation};
use crate::judge::{Checks as _, Rule, assumed};
use crate::number::to_u32;
use crate::text::plural;

/// Records the violations in the headers of a reply.
pub(super) fn headers(
    records: &mut TopicRecords,
    observation: &dyn Observation,
    violations: &[Violation],
) {
    let mut record = records.on(Topic::CncFrames, observation);
    for violation in violations {
        let expected = "the header of a reply to this request";
        record.check(violation.requirement, false, expected, &violation.what);
    }
    if violations.is_empty() {
        record.pass(ADS_5);
    }
}

/// Judges whether the reply has the fields of the requested service and at most the requested
/// length. Returns the reply if it has these fields.
pub(super) fn service<'e>(
    records: &mut TopicRecords,
    observation: &dyn Observation,
    exchange: &'e Exchange,
) -> Option<&'e AdsReply> {
    let clause = ads_service::clause(exchange.service);
    let mut record = records.on(Topic::CncServices, observation);
    match &exchange.outcome {
        Ok((answer, header)) => {
            record.pass(clause);
            record.pass(ADS_4);
            let given = answer.data.as_ref().map_or(0, Vec::len);
            let passed = usize::try_from(exchange.read_length).is_ok_and(|read| given <= read);
            let expected = || {
                format!("at most the {} that were requested", plural(exchange.read_length, "byte"))
            };
            record.check(clause, passed, expected, || format!("{} of data", plural(given, "byte")));
            short_error(records, observation, answer, header);
            Some(answer)
        }
        Err(fault) => {
            record.check(clause, false, "the reply of the service", || fault);
            None
        }
    }
}

/// Records a pass for an error reply that has no payload or ends after its result (ADS-6).
fn short_error(
    records: &mut TopicRecords,
    observation: &dyn Observation,
    answer: &AdsReply,
    header: &AmsHeader,
) {
    let is_error = !answer.ams_error.is_ok() || !answer.result.is_ok();
    if is_error && (answer.data.is_none() || header.data_length == 0) {
        records.on(Topic::CncFrames, observation).pass(ADS_6);
    }
}

pub(super) fn judge(context: &mut ExchangeJudge<'_>, answer: &AdsReply) {
    let (observation, call) = (context.observation, context.call);
    let data = answer.success();
    let request = match call.dispatch() {
        Ok(request) => request,
        Err(DispatchError::Stream(error)) => {
            // The rule that the CNC rejects the request is assumed, unless a count in the request
            // is too large (VAR-24).
            let spec = error.field().spec().map(|spec| spec.clause);
            let spec =
                if error.kind() == ErrorKind::TooMany { Some(VAR_24.as_str()) } else { spec };
            let Some(clause) = spec.filter(|id| requirement(id).is_some()) else { return };
            let rule =
                if clause == VAR_24.as_str() { VAR_24.into() } else { assumed(Rule::of(clause)) };
            let (_, topic) = Topic::of_clause(clause);
            let given =
                data.is_some_and(|data| !data.is_empty() || call.service == AdsService::Write);
            let mut record = context.records.on(topic, observation);
            if given && record.knows(clause) {
                record.check(rule, false, || format!("an error number for {error}"), "a success");
            }
            return;
        }
        Err(_) => return,
    };
    let reply = data.map(|data| request.decode_reply(data));
    let reply = match reply {
        None => None,
        Some(Ok(reply)) => {
            let spec = request.function().spec();
            let mut record = context.records.on(Topic::of_reply(request.function()), observation);
            let clauses = [Some(spec.clause), spec.reply.map(|stream| stream.layout().clause)];
            for clause in clauses.into_iter().flatten() {
                if record.knows(clause) {
                    record.pass(Rule::of(clause));
                }
            }
            Some(reply)
        }
        Some(Err(error)) => {
            let spec = request.function().spec();
            // A wrong count shifts every later field, so the clause of the whole stream is judged.
            let field = match error.kind() {
                ErrorKind::TooMany => spec.reply.map(|stream| stream.layout().clause),
                _ => error.field().spec().map(|spec| spec.clause),
            };
            let clause = field.filter(|id| requirement(id).is_some()).unwrap_or(spec.clause);
            let mut record = context.records.on(Topic::of_reply(request.function()), observation);
            let clause = if record.knows(clause) { clause } else { spec.clause };
            // The size of the number of element types is assumed, and so is the reply to a read
            // length between two multiples of a descriptor's length.
            let is_assumed = match &request {
                Request::CountElements(_) => true,
                Request::ReadDescriptors(_) => {
                    let whole = to_u32(DESCRIPTOR_LEN);
                    call.read_length.checked_rem(whole) != Some(0)
                }
                _ => false,
            };
            let rule = if is_assumed { assumed(Rule::of(clause)) } else { Rule::of(clause) };
            record.check(rule, false, || format!("the reply of {:?}", spec.name), error);
            return;
        }
    };
    together(context, &request, reply.as_ref());
}

/// Judges a reply together with earlier replies.
fn together(context: &mut ExchangeJudge<'_>, request: &Request<'_>, reply: Option<&Reply<'_>>) {
    // The clause of a function determines the topic.
    match Topic::of_reply(request.function()) {
        Topic::CncCom => context.objects(request, reply),
        Topic::CncStream => context.stream(reply.is_some()),
        Topic::CncSda => context.elements(request, reply),
        Topic::CncDyn => context.parameters(request, reply),
        _ => {
            context.variables(request, reply);
            context.values(request, reply);
            context.service(request, reply);
        }
    }
}
