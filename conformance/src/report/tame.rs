//! Text of others as it may be shown: whoever was judged may say anything, and nothing of it moves
//! the cursor of a terminal or begins a line.

use serde_json::Value;

use super::model::{
    AreaReport, CaseReport, EvidenceReport, FailureReport, LeftChanged, ProfileReport, Report,
    RequirementReport, SubjectReport, TargetReport, WaiverReport,
};
use super::{BytesReport, DeviceReport, FieldReport};

/// Text with what a terminal or a reader's eye would act on as escapes.
pub(crate) fn tame(text: &str) -> String {
    escape(text, |_| false)
}

/// The same of text that has lines: their ends are kept, and tabs.
pub(crate) fn tame_lines(text: &str) -> String {
    escape(&text.replace("\r\n", "\n"), |one| matches!(one, '\n' | '\t'))
}

/// Whether a terminal or a reader's eye acts on a character: controls, line and paragraph
/// separators, and those that turn the direction of what follows.
pub(super) fn acts(one: char) -> bool {
    one.is_control() || matches!(one, '\u{2028}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

fn escape(text: &str, is_kept: impl Fn(char) -> bool) -> String {
    let mut tamed = String::with_capacity(text.len());
    for one in text.chars() {
        match acts(one) && !is_kept(one) {
            true => tamed.extend(one.escape_debug()),
            false => tamed.push(one),
        }
    }
    tamed
}

impl Report {
    /// With nothing in any text that acts on who reads it, whoever wrote the report.
    pub(super) fn tamed(mut self) -> Self {
        // Each structure is taken apart whole: a field that is new has to be looked at here.
        let Self {
            format: _,
            suite,
            vectors,
            time,
            editions,
            seed: _,
            only,
            target,
            profile,
            waivers,
            exit_code: _,
            checks: _,
            frames: _,
            left_changed,
            left_out: _,
            subjects,
            cases,
        } = &mut self;
        all([suite, vectors, time]);
        all(editions.iter_mut().chain(only));
        tame_target(target);
        if let Some(ProfileReport { name, claims }) = profile {
            all([name]);
            let tamed = std::mem::take(claims).into_iter();
            *claims = tamed.map(|(key, claim)| (tame(&key), tame_value(claim))).collect();
        }
        for WaiverReport { test, requirement, verdict: _, reason, expires, state: _, found: _ } in
            waivers
        {
            all([test, requirement, reason, expires]);
        }
        for LeftChanged { name, was, is, refused } in left_changed {
            all([name, was]);
            all(is.iter_mut().chain(refused));
        }
        for SubjectReport { subject: _, totals: _, waived: _, areas } in subjects {
            for AreaReport { area, totals: _, requirements } in areas {
                all([area]);
                tame_requirements(requirements);
            }
        }
        cases.iter_mut().for_each(tame_case);
        self
    }
}

fn all<'t>(texts: impl IntoIterator<Item = &'t mut String>) {
    for text in texts {
        if text.chars().any(acts) {
            *text = tame(text);
        }
    }
}

fn tame_value(value: Value) -> Value {
    match value {
        Value::String(text) => Value::String(tame(&text)),
        Value::Array(items) => Value::Array(items.into_iter().map(tame_value).collect()),
        Value::Object(fields) => {
            let fields = fields.into_iter();
            Value::Object(fields.map(|(key, value)| (tame(&key), tame_value(value))).collect())
        }
        value @ (Value::Null | Value::Bool(_) | Value::Number(_)) => value,
    }
}

fn tame_target(target: &mut TargetReport) {
    let TargetReport { name, version, language, command, address, net_id, device, stderr, file } =
        target;
    all([name]);
    all([version, language, command, address, net_id, file].into_iter().flatten());
    if let Some(said) = stderr {
        *said = tame_lines(said);
    }
    if let Some(DeviceReport { name, version, state }) = device {
        all([name, version].into_iter().chain(state));
    }
}

fn tame_requirements(requirements: &mut [RequirementReport]) {
    for RequirementReport { requirement, verdict: _, waived: _ } in requirements {
        all([requirement]);
    }
}

fn tame_case(case: &mut CaseReport) {
    let CaseReport {
        id,
        title,
        subject: _,
        stream,
        verdict: _,
        waived: _,
        requirements,
        checks: _,
        note,
        failures,
    } = case;
    all([id, title].into_iter().chain(stream).chain(note));
    tame_requirements(requirements);
    for failure in failures {
        let FailureReport {
            requirement,
            level: _,
            clause,
            sources,
            verdict: _,
            waived: _,
            expected,
            found,
            more: _,
            evidence,
        } = failure;
        all([requirement, clause, expected, found].into_iter().chain(sources));
        if let Some(evidence) = evidence {
            tame_evidence(evidence);
        }
    }
}

fn tame_evidence(evidence: &mut EvidenceReport) {
    let EvidenceReport { call, result, sent, received, expected, frame_sent, frame_received } =
        evidence;
    // Of a capture, its packets are below.
    *call = tame_lines(call);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_acts() {
        let text = "a\0\u{1b}[31m\u{9b}2J\u{7f}\n\n# H\r\u{202e}é\\\"|`";
        let shown = r##"a\0\u{1b}[31m\u{9b}2J\u{7f}\n\n# H\r\u{202e}é\"|`"##;
        assert_eq!(tame(text), shown);
        assert_eq!(tame_lines("a\r\n\tb\rc\u{1b}"), "a\n\tb\\rc\\u{1b}");
    }
}
