//! Functions that split a line of NC text into its tokens.

/// The block number of a line, if it has one, and the text after the number. A `/`, with or without
/// digits, may precede the number. Blanks before and after each of them are skipped. Without a
/// number, the text is the line after the blanks and the `/`.
pub(super) fn block_number(line: &[u8]) -> (Option<&[u8]>, &[u8]) {
    let mut at = skip_while(line, is_blank);
    if let [b'/', after @ ..] = at {
        at = skip_while(skip_while(after, u8::is_ascii_digit), is_blank);
    }
    if let [b'N' | b'n', number @ ..] = at {
        if let Some((digits, rest)) = number_of(number) {
            return (Some(digits), skip_while(rest, is_blank));
        }
    }
    (None, at)
}

/// The digits at the start of a text, after any blanks, and the text after the digits; `None` if no
/// digit is there.
pub(super) fn number_of(text: &[u8]) -> Option<(&[u8], &[u8])> {
    let (digits, rest) = split_while(skip_while(text, is_blank), u8::is_ascii_digit);
    (!digits.is_empty()).then_some((digits, rest))
}

/// The name before the first closing bracket, without the white space around the name, and the text
/// after the bracket; `None` without a closing bracket.
pub(super) fn name_of(text: &[u8]) -> Option<(&[u8], &[u8])> {
    let (name, rest) = split_while(text, |&byte| byte != b']');
    Some((name.trim_ascii(), rest.get(1..)?))
}

/// The text after `#COMMENT`, blanks and `word`; `None` if the text does not start with them.
pub(super) fn comment_command<'a>(text: &'a [u8], word: &[u8]) -> Option<&'a [u8]> {
    let (command, rest) = text.split_at_checked(b"#COMMENT".len())?;
    if command.first() != Some(&b'#') {
        return None;
    }
    let (blanks, rest) = split_while(rest, is_blank);
    let (found, rest) = split_while(rest, is_in_path);
    let is = command.eq_ignore_ascii_case(b"#COMMENT") && !blanks.is_empty();
    (is && found.eq_ignore_ascii_case(word)).then_some(rest)
}

/// Skips blanks and the comments that begin with `;` or `(`.
pub(super) fn skip_comments(mut rest: &[u8]) -> &[u8] {
    loop {
        match rest {
            [b' ' | b'\t', after @ ..] => rest = after,
            [b';', ..] => return &[],
            [b'(', after @ ..] => rest = after_parentheses(after),
            _ => return rest,
        }
    }
}

/// Skips text that cannot begin a word of interest: numbers, signs, and addresses of one letter
/// such as X. Many lines consist only of such text, which is skipped faster than by the scan of
/// words.
pub(super) fn skip_addresses(mut rest: &[u8]) -> &[u8] {
    while let [byte, after @ ..] = rest {
        rest = match char_kind(*byte) {
            CharKind::Sign => after,
            CharKind::Digit => skip_while(after, is_in_number),
            CharKind::Letter => match after {
                [] => after,
                [next, ..] if matches!(char_kind(*next), CharKind::Sign | CharKind::Digit) => after,
                _ => return rest,
            },
            CharKind::Other => return rest,
        };
    }
    rest
}

/// A class of bytes, by the words that can begin with them.
#[derive(Clone, Copy)]
enum CharKind {
    /// Begins no text that must be examined.
    Sign,
    Digit,
    /// Begins an address of one letter, or a longer word.
    Letter,
    /// May begin text that must be examined: a word of interest, a path, the call of a subroutine,
    /// quoted text or a comment.
    Other,
}

const fn char_kind(byte: u8) -> CharKind {
    match byte {
        b'0'..=b'9' => CharKind::Digit,
        // May begin a program end (`M`) or the call of a subroutine (`L`).
        b'M' | b'm' | b'L' | b'l' => CharKind::Other,
        b'A'..=b'Z' | b'a'..=b'z' => CharKind::Letter,
        b'$' | b'"' | b'.' | b'_' | b';' | b'(' => CharKind::Other,
        _ => CharKind::Sign,
    }
}

/// The text after the parenthesis that closes one opened before `rest`; empty if no parenthesis
/// closes it.
pub(super) fn after_parentheses(mut rest: &[u8]) -> &[u8] {
    let mut open = 1_u32;
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        match byte {
            b'(' => open = open.saturating_add(1),
            b')' => open = open.saturating_sub(1),
            _ => {}
        }
        if open == 0 {
            break;
        }
    }
    rest
}

/// The text after the bytes at its start that satisfy a condition.
pub(super) fn skip_while(mut bytes: &[u8], is: impl Fn(&u8) -> bool) -> &[u8] {
    while let [byte, after @ ..] = bytes {
        if !is(byte) {
            break;
        }
        bytes = after;
    }
    bytes
}

pub(super) fn split_while(bytes: &[u8], is: impl Fn(&u8) -> bool) -> (&[u8], &[u8]) {
    let end = bytes.iter().position(|byte| !is(byte)).unwrap_or(bytes.len());
    bytes.split_at_checked(end).unwrap_or((bytes, &[]))
}

pub(super) const fn is_blank(byte: &u8) -> bool {
    matches!(byte, b' ' | b'\t')
}

pub(super) const fn is_zero(byte: &u8) -> bool {
    *byte == b'0'
}

pub(super) const fn is_in_number(byte: &u8) -> bool {
    matches!(byte, b'0'..=b'9' | b'.')
}

/// Whether the scan takes the byte for a part of a word or of the name of a variable: an ASCII
/// letter, a digit, `_` or `.`.
pub(super) const fn is_in_path(byte: &u8) -> bool {
    matches!(byte, b'0'..=b'9' | b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'.')
}

pub(super) const fn is_in_file_name(byte: &u8) -> bool {
    !matches!(byte, b' ' | b'\t' | b'(' | b';' | b'[' | b'"')
}
