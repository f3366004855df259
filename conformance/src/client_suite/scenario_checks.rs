//! Records the checks of a client in one case.

use ads_cnc::ads::FrameRef;
use ads_cnc::operation::Call;

use super::test_server::RecordedExchange;
use crate::ads_service::{decode_reply, service_of};
use crate::evidence::{Describe, Evidence};
use crate::exchange::meaning;
use crate::judge::{Record, Rule, Rules, Verdict};
use crate::text::plural;

/// The checks of a case and their verdicts.
#[derive(Debug, Default)]
pub(super) struct ScenarioChecks {
    pub(super) record: Record,
}

impl ScenarioChecks {
    /// Records a check, with the exchange as its evidence.
    pub(super) fn check(
        &mut self,
        rules: impl Rules,
        passed: bool,
        exchange: Option<&RecordedExchange>,
        expected: impl Describe,
        found: impl Describe,
    ) {
        self.record.add_all(rules, passed, expected, found, || exchange.map(evidence));
    }

    /// The requirement of the first failed check. The checks of the requests come before the checks
    /// of the client's answer, which is judged last.
    pub(super) fn first_failed(&self) -> Option<&'static str> {
        let mut judgements = self.record.judgements.iter();
        judgements.find(|one| one.verdict == Verdict::Fail).map(|one| one.requirement)
    }

    /// Marks all failed checks of other requirements as consequences of the requirement `cause`.
    pub(super) fn follow_all(&mut self, cause: &'static str) {
        for one in &mut self.record.judgements {
            if one.verdict == Verdict::Fail && one.requirement != cause {
                (one.verdict, one.follows) = (Verdict::Inconclusive, Some(cause));
            }
        }
    }

    /// Records that the check of these rules failed. The rules of requirements other than `cause`
    /// are recorded as consequences of `cause`.
    pub(super) fn follow(
        &mut self,
        rules: &[Rule],
        cause: &'static str,
        exchange: Option<&RecordedExchange>,
        expected: &str,
        found: &str,
    ) {
        let (own, others): (Vec<Rule>, _) = rules.iter().partition(|rule| rule.id == cause);
        self.check(&own[..], false, exchange, expected, found);
        for rule in others {
            self.record.add_following(rule, Verdict::Fail, cause, expected, found);
        }
    }
}

/// The evidence of an exchange in a report.
pub(super) fn evidence(exchange: &RecordedExchange) -> Evidence {
    // The suite judges the client's request, so the evidence shows the request even if it is not a
    // frame.
    let fault = exchange.fault.as_ref().map_or_else(String::new, |fault| format!(": {fault}"));
    let mut evidence = Evidence {
        call: format!("bytes that are not a request{fault}"),
        sent: Evidence::start(&exchange.request).to_vec(),
        result: plural(exchange.sent.len(), "byte"),
        frame_sent: Evidence::start(&exchange.request).to_vec(),
        frame_received: Evidence::start(&exchange.sent).to_vec(),
        ..Evidence::default()
    };
    let Ok(Some((frame, _))) = FrameRef::split(&exchange.request, u32::MAX) else {
        return evidence;
    };
    let header = frame.header();
    evidence.call = format!("command {} to port {}{fault}", header.command.0, header.target.port);
    evidence.sent = Evidence::start(frame.data()).to_vec();
    if let Ok(Some(call)) = Call::from_frame(&frame) {
        evidence.call = format!(
            "{} {}, {} at port {}",
            call.service, call.index_group, call.index_offset, call.port
        );
        evidence.sent = Evidence::start(call.data).to_vec();
        let function = call.dispatch().ok().map(|request| request.function().spec());
        evidence.request_stream =
            function.and_then(|spec| spec.request).map(|stream| stream.layout().name);
        evidence.reply_stream =
            function.and_then(|spec| spec.reply).map(|stream| stream.layout().name);
    }
    if let Ok(Some((reply, len))) = FrameRef::split(&exchange.sent, u32::MAX)
        && len == exchange.sent.len()
    {
        let service = service_of(reply.header().command);
        let decoded = service.and_then(|service| decode_reply(service, reply.data()).ok());
        evidence.received =
            decoded.and_then(|(_, data)| data).map(|data| Evidence::start(data).to_vec());
        let error = reply.header().error;
        let result =
            if error.is_ok() { decoded.map_or(error, |(result, _)| result) } else { error };
        if !result.is_ok() {
            let meaning = meaning(result).map_or_else(String::new, |why| format!(" ({why})"));
            evidence.result = format!("{result}{meaning}");
        }
    }
    evidence
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The evidence shows bytes that are not a request, and why they are not a request.
    #[test]
    fn garbage_is_shown() {
        let request = b"GET / HTTP/1.0\r\n\r\n".to_vec();
        let fault = Some("a frame of 539959386 bytes".to_owned());
        let shown = evidence(&RecordedExchange {
            request: request.clone(),
            fault,
            ..RecordedExchange::default()
        });
        assert_eq!(shown.call, "bytes that are not a request: a frame of 539959386 bytes");
        assert_eq!((shown.sent, shown.result.as_str()), (request, "0 bytes"));
    }

    /// The evidence also shows the data of a request with an unknown command.
    #[test]
    fn data_of_an_unknown_command_is_shown() {
        let mut request =
            vec![0, 0, 36, 0, 0, 0, 127, 0, 0, 1, 1, 1, 0x29, 2, 10, 0, 0, 9, 1, 1, 0, 0x80];
        request.extend([77, 0, 4, 0, 4, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0xDE, 0xAD, 0xBE, 0xEF]);
        let shown = evidence(&RecordedExchange {
            request,
            sent: vec![0; 38],
            ..RecordedExchange::default()
        });
        assert_eq!(shown.call, "command 77 to port 553");
        assert_eq!(shown.sent, [0xDE, 0xAD, 0xBE, 0xEF]);
        assert_eq!(shown.result, "38 bytes");
    }
}
