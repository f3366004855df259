//! Text of others as it may be shown: whoever was judged may say anything, and nothing of it moves
//! the cursor of a terminal or begins a line.

use super::model::{CaseReport, EvidenceReport, FailureReport, LeftChanged, Report, TargetReport};

/// Text with what a terminal or a reader's eye would act on as escapes.
pub(crate) fn tame(text: &str) -> String {
    escape(text, |_| false)
}

/// The same of text that has lines: their ends are kept, and tabs.
pub(crate) fn tame_lines(text: &str) -> String {
    escape(&text.replace("\r\n", "\n"), |one| matches!(one, '\n' | '\t'))
}

fn escape(text: &str, is_kept: impl Fn(char) -> bool) -> String {
    let mut tamed = String::with_capacity(text.len());
    for one in text.chars() {
        // Line and paragraph separators, and those that turn the direction of what follows.
        let turns = matches!(one, '\u{2028}'..='\u{202E}' | '\u{2066}'..='\u{2069}');
        match (one.is_control() || turns) && !is_kept(one) {
            true => tamed.extend(one.escape_debug()),
            false => tamed.push(one),
        }
    }
    tamed
}

impl Report {
    /// With nothing of others in it that acts on who reads it. The device's name is shown in
    /// quotes, escaped.
    pub(super) fn tamed(mut self) -> Self {
        let TargetReport {
            name, version, language, command, address, net_id, file, stderr, ..
        } = &mut self.target;
        *name = tame(name);
        for said in [version, language, command, address, net_id, file].into_iter().flatten() {
            *said = tame(said);
        }
        if let Some(said) = stderr {
            *said = tame_lines(said);
        }
        for LeftChanged { name, was, is } in &mut self.left_changed {
            (*name, *was) = (tame(name), tame(was));
            *is = is.as_deref().map(tame);
        }
        for CaseReport { title, note, failures, .. } in &mut self.cases {
            *title = tame(title);
            if let Some(said) = note {
                *said = tame(said);
            }
            for FailureReport { expected, found, evidence, .. } in failures {
                (*expected, *found) = (tame(expected), tame(found));
                if let Some(EvidenceReport { call, result, .. }) = evidence {
                    // Of a capture, its packets stand below.
                    (*call, *result) = (tame_lines(call), tame(result));
                }
            }
        }
        self
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
