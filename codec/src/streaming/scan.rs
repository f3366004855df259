//! Scans an NC text for the words that the checks need, and skips comments.

use super::ends::{after_end, split_at_end};
use super::lex::*;
use super::words::{LoopWord, ProgramEnd};
use crate::bytes::to_u32;

/// A position in a text: line and column, from 1.
#[derive(Clone, Copy)]
pub(super) struct Position {
    pub(super) line: u32,
    pub(super) column: u32,
}

/// A word and its position.
pub(super) struct Token<'a> {
    pub(super) position: Position,
    pub(super) word: Word<'a>,
}

pub(super) enum Word<'a> {
    /// The start of the code of a line: the first text that is neither blank nor comment. A word of
    /// another variant may begin at the same position.
    Code,
    Goto(Label<'a>),
    Loop(LoopWord),
    End(ProgramEnd),
}

/// A label and its program, which is the number of lines so far that begin a program with `%`.
#[derive(Clone, Copy)]
pub(super) struct Label<'a> {
    program: u32,
    /// Whether the label is a name in brackets; otherwise it has digits without leading zeros.
    named: bool,
    text: &'a [u8],
}

impl Label<'_> {
    pub(super) const fn program(&self) -> u32 {
        self.program
    }

    /// The key by which labels of a program are compared.
    pub(super) fn key(&self) -> alloc::vec::Vec<u8> {
        let text = self.text.iter().map(u8::to_ascii_lowercase);
        core::iter::once(u8::from(self.named)).chain(text).collect()
    }
}

/// The state of a scan between two lines.
#[derive(Clone, Copy)]
pub(super) struct ScanState {
    /// The number of lines so far.
    pub(super) lines: u32,
    /// The number of lines so far that begin a program with `%`.
    pub(super) program: u32,
    /// The start of the open comment block; `None` if no block is open.
    pub(super) block: Option<Position>,
}

impl ScanState {
    pub(super) const START: Self = Self { lines: 0, program: 0, block: None };
}

/// Scans a text for words and labels; skips comment blocks.
#[derive(Clone)]
pub(super) struct Scan<'a> {
    /// The text after the current line and its line end.
    below: &'a [u8],
    line: &'a [u8],
    number: u32,
    /// The rest of the current line.
    rest: &'a [u8],
    stage: Stage,
    /// Whether it is known that the rest of the current line has no closing bracket.
    open: bool,
    /// The current line after its block number.
    body: &'a [u8],
    /// The label at the start of the current line, and the text after the label.
    label: Option<(Label<'a>, &'a [u8])>,
    program: u32,
    /// The start of the open comment block.
    block: Option<Position>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// No code has been seen in the line.
    Blank,
    /// No code has been seen in a line that begins a program, whose name may contain any words.
    Title,
    Body,
}

impl<'a> Scan<'a> {
    /// Resumes after lines that ended in this state.
    pub(super) const fn resume(state: ScanState, text: &'a [u8]) -> Self {
        let ScanState { lines, program, block } = state;
        Self {
            below: text,
            line: &[],
            number: lines,
            rest: &[],
            stage: Stage::Blank,
            open: false,
            body: &[],
            label: None,
            program,
            block,
        }
    }

    /// The state after the current line.
    pub(super) const fn state(&self) -> ScanState {
        ScanState { lines: self.number, program: self.program, block: self.block }
    }

    /// The lines after the current line.
    pub(super) const fn remaining(&self) -> &'a [u8] {
        self.below
    }

    /// Advances to the next line that has a label; returns the label and the line number.
    pub(super) fn next_label(&mut self) -> Option<(Label<'a>, u32)> {
        while self.enter_line() {
            if let Some((label, _)) = self.label {
                return Some((label, self.number));
            }
        }
        None
    }

    /// The position in the current line from which `left` bytes remain.
    fn position_with(&self, left: usize) -> Position {
        let before = self.line.len().saturating_sub(left);
        Position { line: self.number, column: to_u32(before).saturating_add(1) }
    }

    /// Advances to the next line; returns `false` after the last line.
    fn enter_line(&mut self) -> bool {
        if self.below.is_empty() {
            return false;
        }
        let (line, below) = split_at_end(self.below);
        (self.line, self.rest, self.below) = (line, line, after_end(below));
        self.number = self.number.saturating_add(1);
        (self.stage, self.open, self.label) = (Stage::Blank, false, None);
        let (number, at) = block_number(line);
        self.body = at;
        if self.block.is_some() {
            self.rest = match comment_command(at, b"END") {
                Some(rest) => {
                    self.block = None;
                    rest
                }
                None => &[],
            };
            return true;
        }
        match at {
            [b'%', ..] => {
                self.program = self.program.saturating_add(1);
                self.stage = Stage::Title;
            }
            [b'#', ..] if comment_command(at, b"BEGIN").is_some() => {
                self.block = Some(self.position_with(at.len()));
                self.rest = &[];
            }
            [b':' | b'[', ..] => self.label = self.definition(number, at),
            _ => {}
        }
        true
    }

    /// The next word of interest in the line, and the length of the line from that word on.
    fn next_word(&mut self) -> Option<(usize, Word<'a>)> {
        loop {
            self.rest = skip_comments(skip_addresses(self.rest));
            let left = self.rest.len();
            let (&first, after) = self.rest.split_first()?;
            if let Some(word) = self.word(first, after) {
                return Some((left, word));
            }
        }
    }

    /// Skips the title of a program, or the block number and the label of another line; returns
    /// [`Word::Code`].
    fn head(&mut self) -> Word<'a> {
        match (self.stage, self.label) {
            (Stage::Title, _) => self.rest = &[],
            (_, None) => {
                self.stage = Stage::Body;
                if self.body.len() < self.rest.len() {
                    self.rest = self.body;
                }
            }
            (_, Some((_, rest))) => (self.stage, self.rest) = (Stage::Body, rest),
        }
        Word::Code
    }

    /// Skips the text that begins at the current position; returns the word if it is of interest.
    fn word(&mut self, first: u8, after: &'a [u8]) -> Option<Word<'a>> {
        match first {
            b'$' => {
                let (name, after) = split_while(after, u8::is_ascii_alphabetic);
                self.rest = after;
                if name.eq_ignore_ascii_case(b"GOTO") {
                    return self.target().map(Word::Goto);
                }
                let is = |word: &LoopWord| name.eq_ignore_ascii_case(word.name().as_bytes());
                LoopWord::ALL.into_iter().find(is).map(Word::Loop)
            }
            b'"' => {
                // Skip quoted text, if the quote is closed.
                let close = after.iter().position(|&byte| byte == b'"');
                self.rest = match close.and_then(|at| after.get(at.saturating_add(1)..)) {
                    Some(rest) => rest,
                    None => after,
                };
                None
            }
            b'.' if after.first().is_some_and(u8::is_ascii_alphabetic) => self.pass_path(),
            b'_' => self.pass_path(),
            b'0'..=b'9' => {
                self.rest = skip_while(after, is_in_number);
                None
            }
            _ if first.is_ascii_alphabetic() => self.letters(),
            _ => {
                self.rest = after;
                None
            }
        }
    }

    /// Skips a word of letters (with its number, if the word is `M`), the name of a variable or the
    /// call of a subroutine; returns a program end.
    fn letters(&mut self) -> Option<Word<'a>> {
        let (letters, after) = split_while(self.rest, u8::is_ascii_alphabetic);
        match after {
            [b'_', ..] => return self.pass_path(),
            [b'.', next, ..] if next.is_ascii_alphabetic() || *next == b'_' => {
                return self.pass_path();
            }
            // The name of a subroutine may contain any words.
            [b' ' | b'\t', ..] if matches!(letters, b"L" | b"l" | b"LL" | b"ll") => {
                let name = skip_while(after, is_blank);
                self.rest = skip_while(name, is_in_file_name);
                return None;
            }
            _ => self.rest = after,
        }
        let (digits, after) = split_while(after, u8::is_ascii_digit);
        if !matches!(letters, b"M" | b"m") || matches!(after, [b'.' | b'_', ..]) {
            return None;
        }
        self.rest = after;
        match skip_while(digits, is_zero) {
            b"2" => Some(Word::End(ProgramEnd::M2)),
            b"30" => Some(Word::End(ProgramEnd::M30)),
            b"17" => Some(Word::End(ProgramEnd::M17)),
            b"29" => Some(Word::End(ProgramEnd::M29)),
            _ => None,
        }
    }

    /// Skips the name of a variable, which may contain the letters of a program end.
    fn pass_path(&mut self) -> Option<Word<'a>> {
        self.rest = skip_while(self.rest, is_in_path);
        None
    }

    /// Skips the label after `$GOTO` and returns it; `None` for an expression or any other text.
    fn target(&mut self) -> Option<Label<'a>> {
        let at = skip_while(self.rest, is_blank);
        let (label, rest) = match at {
            [b'N' | b'n', number @ ..] => {
                let (digits, rest) = number_of(number)?;
                let next = skip_while(rest, is_blank).first();
                if next.is_some_and(|next| b"+-*/.[_=".contains(next)) {
                    return None;
                }
                (self.number(digits), rest)
            }
            [b'[', name @ ..] if !self.open => {
                // Remember that the bracket is not closed: later brackets of the line are not
                // closed either.
                let Some((name, rest)) = name_of(name) else {
                    self.open = true;
                    return None;
                };
                (self.label(true, name), rest)
            }
            _ => return None,
        };
        self.rest = rest;
        Some(label)
    }

    /// The label at the start of a line, and the text after it.
    fn definition(&self, number: Option<&'a [u8]>, at: &'a [u8]) -> Option<(Label<'a>, &'a [u8])> {
        match (number, at) {
            (Some(digits), [b':', rest @ ..]) => Some((self.number(digits), rest)),
            (_, [b'[', name @ ..]) => {
                let (name, rest) = name_of(name)?;
                Some((self.label(true, name), rest))
            }
            _ => None,
        }
    }

    /// The label with this block number, without leading zeros.
    fn number(&self, digits: &'a [u8]) -> Label<'a> {
        self.label(false, skip_while(digits, is_zero))
    }

    const fn label(&self, named: bool, text: &'a [u8]) -> Label<'a> {
        Label { program: self.program, named, text }
    }
}

impl<'a> Iterator for Scan<'a> {
    type Item = Token<'a>;

    fn next(&mut self) -> Option<Token<'a>> {
        loop {
            if self.stage == Stage::Body {
                if let Some((left, word)) = self.next_word() {
                    return Some(Token { position: self.position_with(left), word });
                }
            } else {
                self.rest = skip_comments(self.rest);
                if !self.rest.is_empty() {
                    let position = self.position_with(self.rest.len());
                    return Some(Token { position, word: self.head() });
                }
            }
            if !self.enter_line() {
                return None;
            }
        }
    }
}
