//! Escapes the texts of a report, because control characters from a target must not reach a
//! terminal. Line ends are escaped too, except in the output on stderr and in the call of a check.

use serde_json::Value;

use super::document::{
    AreaReport, CaseReport, EvidenceReport, FailureReport, ProfileReport, Report,
    RequirementReport, SubjectReport, TargetReport,
};
use super::{BytesReport, DeviceReport, FieldReport, FoundReport};
use crate::judge::{UnrestoredValue, WaiverReport};
use crate::text::{escape, escape_lines, is_escaped};

impl Report {
    /// The report with all texts escaped.
    pub(super) fn escaped(mut self) -> Self {
        // List all fields, so that a new field cannot be forgotten.
        let Self {
            format: _,
            suite,
            vectors,
            time,
            editions,
            seed: _,
            only,
            target,
            traffic,
            exchanges,
            profile,
            found,
            waivers,
            again,
            exit_code: _,
            checks: _,
            frames: _,
            ended,
            left_changed,
            rejected,
            written,
            left_out: _,
            subjects,
            cases,
        } = &mut self;
        all([suite, vectors, time]);
        all(editions.iter_mut().chain(only).chain(traffic).chain(again).chain(ended));
        all(rejected.iter_mut().chain(written).chain(exchanges));
        escape_target(target);
        if let Some(ProfileReport { name, claims }) = profile {
            all([name]);
            let escaped = std::mem::take(claims).into_iter();
            *claims = escaped.map(|(key, claim)| (escape(&key), escape_value(claim))).collect();
        }
        if let Some(FoundReport {
            requests: _,
            expected: _,
            ports: _,
            channels: _,
            platform_axes: _,
            spindles: _,
            claimed_axes: _,
            claimed_spindles: _,
            silent_channels: _,
            lists,
            stopped,
        }) = found
        {
            all(lists.iter_mut().map(|list| &mut list.name).chain(stopped));
        }
        for WaiverReport { test, requirement, verdict: _, reason, expires, state: _, found: _ } in
            waivers
        {
            all([test, requirement, reason, expires]);
        }
        for UnrestoredValue { name, was, is, rejected } in left_changed {
            all([name, was]);
            all(is.iter_mut().chain(rejected));
        }
        for SubjectReport { subject: _, totals: _, waived: _, milliseconds: _, areas } in subjects {
            for AreaReport { area, totals: _, requirements } in areas {
                all([area]);
                escape_requirements(requirements);
            }
        }
        cases.iter_mut().for_each(escape_case);
        self
    }
}

fn all<'t>(texts: impl IntoIterator<Item = &'t mut String>) {
    for text in texts {
        if text.chars().any(is_escaped) {
            *text = escape(text);
        }
    }
}

fn escape_value(value: Value) -> Value {
    match value {
        Value::String(text) => Value::String(escape(&text)),
        Value::Array(items) => Value::Array(items.into_iter().map(escape_value).collect()),
        Value::Object(fields) => {
            let fields = fields.into_iter();
            Value::Object(fields.map(|(key, value)| (escape(&key), escape_value(value))).collect())
        }
        value @ (Value::Null | Value::Bool(_) | Value::Number(_)) => value,
    }
}

fn escape_target(target: &mut TargetReport) {
    let TargetReport { name, version, language, command, address, net_id, device, stderr, file } =
        target;
    all([name]);
    all([version, language, command, address, net_id, file].into_iter().flatten());
    if let Some(text) = stderr {
        *text = escape_lines(text);
    }
    if let Some(DeviceReport { name, version, state }) = device {
        all([name, version].into_iter().chain(state));
    }
}

fn escape_requirements(requirements: &mut [RequirementReport]) {
    for RequirementReport { requirement, verdict: _, waived: _ } in requirements {
        all([requirement]);
    }
}

fn escape_case(case: &mut CaseReport) {
    let CaseReport {
        id,
        title,
        subject: _,
        stream,
        verdict: _,
        waived: _,
        requirements,
        checks: _,
        milliseconds: _,
        note,
        failures,
    } = case;
    all([id, title].into_iter().chain(stream).chain(note));
    escape_requirements(requirements);
    for failure in failures {
        let FailureReport {
            requirement,
            level: _,
            follows,
            clause,
            sources,
            verdict: _,
            waived: _,
            expected,
            found,
            more: _,
            evidence,
        } = failure;
        all([requirement, clause, expected, found].into_iter().chain(sources).chain(follows));
        if let Some(evidence) = evidence {
            escape_evidence(evidence);
        }
    }
}

fn escape_evidence(evidence: &mut EvidenceReport) {
    let EvidenceReport {
        call,
        subject,
        result,
        sent,
        received,
        expected,
        frame_sent,
        frame_received,
    } = evidence;
    all(subject);
    // Keep the line ends: for a capture, the lines after the first one contain the packet numbers.
    *call = escape_lines(call);
    all([result, frame_sent, frame_received]);
    for BytesReport { stream, length: _, fields, faults } in
        [sent, received, expected].into_iter().flatten()
    {
        all(faults.iter_mut().chain(stream));
        for FieldReport { offset: _, hex, field, value, meaning, differs: _ } in fields {
            all([hex, field, value, meaning]);
        }
    }
}
