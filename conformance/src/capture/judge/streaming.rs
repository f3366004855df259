//! NC text written to the program stream of a channel.

use std::time::Duration;

use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::Call;
use ads_cnc::streaming::{CheckEvent, Checker, DiagnosticKind, LineErrorKind, NcText};

use super::super::findings::{Observation, Topic};
use super::observed::Bench;
use crate::judge::{Checks as _, assumed};

/// After a rejected write, a client that is silent for this long has given up.
const GIVEN_UP: Duration = Duration::from_secs(30);

impl Bench<'_> {
    pub(super) fn stream(
        &mut self,
        observation: &Observation<'_>,
        call: &Call<'_>,
        accepted: bool,
    ) {
        let data = call.data;
        let mut page = self.records.on(Topic::ClientStream, observation);
        let length = data.len();
        let kept = length <= STREAM_PACKET_MAX;
        page.check("STM-2", kept, "at most 992 bytes", || format!("{length} bytes"));
        let whole = data.ends_with(b"\r\n");
        page.check("STM-4", whole, "whole lines, each with CR LF", "an open line at the end");
        // `NcText` accepts every line end, so bare line feeds are detected here.
        let bare = data.windows(2).any(|two| matches!(two, [first, b'\n'] if *first != b'\r'))
            || data.first() == Some(&b'\n')
            || data.windows(2).any(|two| matches!(two, [b'\r', second] if *second != b'\n'));
        page.check("STM-4", !bare, "lines that end in CR LF", "CR or LF alone");
        match NcText::new(data) {
            Ok(_) => {
                page.pass("STM-7");
                page.pass("STM-20");
            }
            Err(error) => {
                let rule = error.kind().clause();
                let rule = if rule == "STM-5" { "STM-4" } else { rule };
                let is_line = matches!(error.kind(), LineErrorKind::TooLong { .. });
                let expected = if is_line { "lines of at most 990 characters" } else { "ASCII" };
                page.check(rule, false, expected, || error);
            }
        }
        let now = observation.time();
        let is_lost = self.cnc.streams.is_lost;
        let stream = self.cnc.streams.known.entry(call.index_group.get()).or_default();
        if let Some((refused, then)) = stream.refused.take() {
            let waited = match (now, then) {
                (Some(now), Some(then)) => now.since(then),
                _ => Duration::ZERO,
            };
            if waited < GIVEN_UP {
                let expected = || format!("the {} bytes that were refused before", refused.len());
                page.check("STM-6", refused == data, expected, "other data");
            }
        }
        // After a gap the data may be inside a comment, where every byte is allowed.
        if accepted && !is_lost {
            let checker = stream.checker.get_or_insert_with(Checker::new);
            let mut ended = false;
            for found in checker.check(data) {
                match found {
                    CheckEvent::ProgramEnd { .. } => ended = true,
                    CheckEvent::Diagnostic(finding) => {
                        let clause = match finding.kind {
                            DiagnosticKind::Loop(_) | DiagnosticKind::BackwardJump { .. } => {
                                "STM-8"
                            }
                            // After the end of a program the next one begins, or the rest of this
                            // one follows.
                            _ => continue,
                        };
                        page.check(clause, false, "what a stream may have", || finding);
                    }
                }
            }
            page.pass("STM-8");
            if ended {
                stream.checker = None;
            }
        } else if !accepted && kept && whole {
            stream.refused = Some((data.to_vec(), now));
        }
        let mut page = self.records.on(Topic::CncStream, observation);
        let expected = "an error number for more than 992 bytes";
        page.check(assumed("STM-2"), kept || !accepted, expected, "a success");
    }
}
