//! NC text written to the program stream of a channel.

use std::time::Duration;

use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::streaming::{CheckEvent, Checker, DiagnosticKind, LineErrorKind, NcText};
use ads_cnc_vectors::ids::*;

use super::knowledge::ExchangeJudge;
use super::topic::Topic;
use crate::judge::{Checks as _, Rule, assumed};
use crate::text::plural;

/// If a client writes nothing for this time after a rejected write, it is assumed that the client
/// does not repeat the rejected write.
const RETRY_TIMEOUT: Duration = Duration::from_secs(30);

impl ExchangeJudge<'_> {
    pub(super) fn stream(&mut self, accepted: bool) {
        let (observation, call) = (self.observation, self.call);
        let data = call.data;
        let mut record = self.records.on(Topic::ClientStream, observation);
        let length = data.len();
        let passed = length <= STREAM_PACKET_MAX;
        record.check(STM_2, passed, "at most 992 bytes", || plural(length, "byte"));
        let whole = data.ends_with(b"\r\n");
        record.check(STM_4, whole, "whole lines, each with CR LF", "an open line at the end");
        // `NcText` also accepts CR alone and LF alone as line ends, so they are detected here.
        let bare = data.windows(2).any(|two| matches!(two, [first, b'\n'] if *first != b'\r'))
            || data.first() == Some(&b'\n')
            || data.windows(2).any(|two| matches!(two, [b'\r', second] if *second != b'\n'));
        record.check(STM_4, !bare, "lines that end in CR LF", "CR or LF alone");
        match NcText::new(data) {
            Ok(_) => {
                record.pass(STM_7);
                record.pass(STM_20);
            }
            Err(error) => {
                let clause = error.kind().clause();
                let rule = if clause == STM_5.as_str() { STM_4.into() } else { Rule::of(clause) };
                let is_line = matches!(error.kind(), LineErrorKind::TooLong { .. });
                let expected = if is_line { "lines of at most 990 characters" } else { "ASCII" };
                record.check(rule, false, expected, || error);
            }
        }
        let now = observation.time();
        let is_lost = self.cnc.is_lost;
        let stream = self.cnc.streams.entry(call.index_group.get()).or_default();
        if let Some((rejected, then)) = stream.rejected.take() {
            let waited = match (now, then) {
                (Some(now), Some(then)) => now.saturating_sub(then),
                _ => Duration::ZERO,
            };
            if waited < RETRY_TIMEOUT {
                let expected =
                    || format!("the {} that were rejected before", plural(rejected.len(), "byte"));
                record.check(STM_6, rejected == data, expected, "other data");
            }
        }
        // If packets are missing, the data may be inside a comment, where forbidden keywords are
        // permitted.
        let is_complete = accepted && !is_lost;
        if is_complete && stream.checker.is_none() && self.budget.take_program() {
            stream.checker = Some(Checker::new());
        }
        if let Some(checker) = stream.checker.as_mut().filter(|_| is_complete) {
            let mut ended = false;
            for found in checker.check(data) {
                match found {
                    CheckEvent::ProgramEnd { .. } => ended = true,
                    CheckEvent::Diagnostic(finding) => {
                        let clause = match finding.kind {
                            DiagnosticKind::Loop(_) | DiagnosticKind::BackwardJump { .. } => STM_8,
                            // Text after the end of a program may be the next program, and a later
                            // packet may close an open comment.
                            _ => continue,
                        };
                        record.check(clause, false, "a program that can be streamed", || finding);
                    }
                }
            }
            record.pass(STM_8);
            if ended {
                *checker = Checker::new();
            }
        } else if is_complete {
            self.budget.unchecked = self.budget.unchecked.saturating_add(1);
        } else if !accepted && passed && whole {
            stream.rejected = Some((data.to_vec(), now));
        }
        let mut record = self.records.on(Topic::CncStream, observation);
        let expected = "an error number for more than 992 bytes";
        record.check(assumed(STM_2), passed || !accepted, expected, "a success");
    }
}
