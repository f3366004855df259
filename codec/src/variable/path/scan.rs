//! Parses and checks the name of a variable.

use super::super::u32_list::decimal;
use super::INDEX_MAX;
use crate::bytes::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::variable_path::{INDEX, KIND, PART};
use crate::layout::{Field, Subject};
use crate::limits::NAME_MAX;
use crate::text::CncStr;

/// The end of a name's kind, and the end of the name without the indices at its end, as offsets in
/// [`CncStr::raw`].
pub(super) struct Ends {
    pub(super) kind: usize,
    pub(super) variable: usize,
}

/// Checks a whole name.
pub(super) fn name(text: CncStr<'_>) -> Result<Ends, Error> {
    check_len(text.len())?;
    let mut scan = Scan { text, before: 0, at: 0 };
    scan.kind()?;
    let kind = scan.at;
    loop {
        scan.expect(b'.', PART)?;
        scan.part(PART)?;
        let variable = scan.at;
        scan.indices()?;
        if scan.next().is_none() {
            return Ok(Ends { kind, variable });
        }
    }
}

/// Checks a kind.
pub(super) fn kind(text: CncStr<'_>) -> Result<(), Error> {
    let mut scan = Scan { text, before: 0, at: 0 };
    scan.kind()?;
    scan.end(KIND)
}

/// Checks the name of a part that begins after `before` characters.
pub(super) fn part(text: CncStr<'_>, before: usize) -> Result<(), Error> {
    let mut scan = Scan { text, before, at: 0 };
    scan.part(PART)?;
    scan.end(PART)
}

/// Checks an index whose digits begin after `before` characters.
pub(super) fn index(index: u32, before: usize) -> Result<(), Error> {
    if index <= INDEX_MAX {
        return Ok(());
    }
    Err(Error::new(ErrorKind::OutOfRange, INDEX, to_u32(before), INDEX_MAX, index))
}

/// Checks the length of a name.
pub(super) fn check_len(len: usize) -> Result<(), Error> {
    if len <= NAME_MAX {
        return Ok(());
    }
    let (whole, max) = (Field::whole_subject(Subject::VariablePath), to_u32(NAME_MAX));
    Err(Error::new(ErrorKind::TooLong, whole, max, max, to_u32(len)))
}

/// Whether the character ends the name of a part. The three characters are ASCII, so each has one byte in
/// CP1252 and in UTF-8.
const fn is_syntax(byte: u8) -> bool {
    matches!(byte, b'.' | b'[' | b']')
}

struct Scan<'a> {
    text: CncStr<'a>,
    /// The number of characters before the text.
    before: usize,
    /// The current offset in [`CncStr::raw`].
    at: usize,
}

impl Scan<'_> {
    fn next(&self) -> Option<u8> {
        self.text.raw().get(self.at).copied()
    }

    fn skip_while(&mut self, wanted: impl Fn(u8) -> bool) {
        while self.next().is_some_and(&wanted) {
            self.at = self.at.saturating_add(1);
        }
    }

    /// The error for the next character, or for the end of the text.
    #[cold]
    fn fault(&self, field: Field) -> Error {
        let (before, after) = self.text.split_at(self.at);
        let at = to_u32(self.before.saturating_add(before.len()));
        match after.chars().next() {
            Some(character) => {
                Error::new(ErrorKind::Unexpected, field, at, 0, u32::from(character))
            }
            None => Error::new(ErrorKind::Truncated, field, at, 1, 0),
        }
    }

    fn expect(&mut self, byte: u8, field: Field) -> Result<(), Error> {
        if self.next() != Some(byte) {
            return Err(self.fault(field));
        }
        self.at = self.at.saturating_add(1);
        Ok(())
    }

    fn end(&self, field: Field) -> Result<(), Error> {
        if self.next().is_some() { Err(self.fault(field)) } else { Ok(()) }
    }

    /// Scans a kind: `V.` and a part without indices.
    fn kind(&mut self) -> Result<(), Error> {
        self.expect(b'V', KIND)?;
        self.expect(b'.', KIND)?;
        self.part(KIND)
    }

    /// Scans the name of a part: one or more characters.
    fn part(&mut self, field: Field) -> Result<(), Error> {
        if self.next().is_none_or(is_syntax) {
            return Err(self.fault(field));
        }
        self.skip_while(|byte| !is_syntax(byte));
        Ok(())
    }

    /// Scans indices such as `[3][4]`, if there are any.
    fn indices(&mut self) -> Result<(), Error> {
        while self.next() == Some(b'[') {
            self.at = self.at.saturating_add(1);
            let start = self.at;
            self.skip_while(|byte| byte.is_ascii_digit());
            let (before, digits) = self.text.split_at(self.at).0.split_at(start);
            if digits.is_empty() {
                return Err(self.fault(INDEX));
            }
            index(decimal(digits.raw()), self.before.saturating_add(before.len()))?;
            self.expect(b']', INDEX)?;
        }
        Ok(())
    }
}
