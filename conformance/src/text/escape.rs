//! Escapes control characters.

/// Escapes the characters for which [`is_escaped`] returns true.
pub(crate) fn escape(text: &str) -> String {
    escape_unless(text, |_| false)
}

/// Like [`escape`], but keeps line feeds and tabs, and replaces CR LF by a line feed.
pub(crate) fn escape_lines(text: &str) -> String {
    escape_unless(&text.replace("\r\n", "\n"), |one| matches!(one, '\n' | '\t'))
}

/// Whether a character may control a terminal or the order of characters: control characters, line
/// and paragraph separators, and the bidirectional embeddings, overrides and isolates.
pub(crate) fn is_escaped(one: char) -> bool {
    one.is_control() || matches!(one, '\u{2028}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

fn escape_unless(text: &str, is_kept: impl Fn(char) -> bool) -> String {
    let mut escaped = String::with_capacity(text.len());
    for one in text.chars() {
        if is_escaped(one) && !is_kept(one) {
            escaped.extend(one.escape_debug())
        } else {
            escaped.push(one)
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn controls_are_escaped() {
        let text = "a\0\u{1b}[31m\u{9b}2J\u{7f}\n\n# H\r\u{202e}é\\\"|`";
        let shown = r##"a\0\u{1b}[31m\u{9b}2J\u{7f}\n\n# H\r\u{202e}é\"|`"##;
        assert_eq!(escape(text), shown);
        assert_eq!(escape_lines("a\r\n\tb\rc\u{1b}"), "a\n\tb\\rc\\u{1b}");
    }
}
