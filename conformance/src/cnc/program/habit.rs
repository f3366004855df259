//! What NC programs can be made to do wrong: seeded defects.

use ads_cnc::streaming::{CheckEvent, Diagnostic, DiagnosticKind, LoopWord, ProgramEnd};

use super::executed::lines;

/// One thing that an NC program, or what gives it its lines, does wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Habit {
    /// Words of loops are run.
    Loops,
    /// Jumps back are run.
    JumpsBack,
    /// Labels are known within a read only.
    Forgets,
    /// `$IF` and `$SWITCH` without an end in the same read end streaming.
    BranchesWhole,
    /// `$IF` and `$SWITCH` end streaming.
    Branches,
    /// Every `$GOTO` ends streaming.
    Jumps,
    /// Comments are looked through too.
    Comments,
    /// No word ends a program.
    NoEnd,
    /// M30 alone does.
    EndM30,
    /// What was read with an end is run.
    AfterEnd,
    /// An end empties the interface.
    EndEmpties,
    /// A reset does not.
    ResetKeeps,
    /// A reset does not end streaming.
    ResetGoesOn,
    /// One packet is read at a time.
    Packets,
    /// Those that wait are read in reverse order.
    Reversed,
    /// It is started without being told.
    StartsItself,
    /// A start empties the interface.
    StartEmpties,
    /// It ends when there is nothing more to run.
    DryEnds,
    /// A call of a subroutine ends it.
    SubroutineEnds,
    /// Lines without CR LF are skipped.
    SkipsLines,
    /// They have another error.
    OtherError,
    /// The interface holds twice as much.
    Roomy,
    /// The interface holds half as much.
    Narrow,
    /// A script does not wait for a response.
    WaitsNot,
    /// A script writes the request state first.
    StateFirst,
    /// A script has no longest wait.
    WaitsForEver,
}

impl Habit {
    /// The most bytes that the interface holds besides, or at all.
    pub(super) const ROOM: usize = 4094;
    pub(super) const LITTLE_ROOM: usize = 2048;

    /// What the lines are looked through as.
    pub(super) fn seen(self, read: &[u8]) -> Vec<u8> {
        let mut seen = read.to_vec();
        if self == Self::Comments {
            let comment = |byte: &u8| b"();#".contains(byte);
            seen.iter_mut().filter(|byte| comment(byte)).for_each(|byte| *byte = b' ');
        }
        seen
    }

    /// Whether it overlooks that.
    pub(super) fn overlooks(self, found: &CheckEvent) -> bool {
        match found {
            CheckEvent::Diagnostic(Diagnostic { kind: DiagnosticKind::Loop(_), .. }) => {
                self == Self::Loops
            }
            CheckEvent::Diagnostic(Diagnostic {
                kind: DiagnosticKind::BackwardJump { .. },
                ..
            }) => self == Self::JumpsBack,
            CheckEvent::Diagnostic(_) => false,
            CheckEvent::ProgramEnd { end, .. } => {
                self == Self::NoEnd || self == Self::EndM30 && *end != ProgramEnd::M30
            }
        }
    }

    /// Where it finds something among the lines from this number on.
    pub(super) fn finds(self, read: &[u8], first: u32) -> Option<CheckEvent> {
        let has = |line: &[u8], word: &[u8]| line.windows(word.len()).any(|part| part == word);
        let count = |word: &[u8]| lines(read).filter(|line| has(line, word)).count();
        let opens = |line: &[u8]| has(line, b"$IF") || has(line, b"$SWITCH");
        let whole = count(b"$IF") == count(b"$ENDIF") && count(b"$SWITCH") == count(b"$ENDSWITCH");
        let line = |is: &dyn Fn(&[u8]) -> bool| {
            let place = lines(read).position(is)?;
            Some(first.saturating_add(u32::try_from(place).ok()?))
        };
        let branch = |line| CheckEvent::Diagnostic(Diagnostic { line, column: 1, kind: LOOP });
        match self {
            Self::BranchesWhole if !whole => line(&opens).map(branch),
            Self::Branches => line(&opens).map(branch),
            Self::Jumps => line(&|line| has(line, b"$GOTO")).map(branch),
            Self::SubroutineEnds => {
                let calls = |line: &[u8]| {
                    let mut words = line.split(|byte| byte.is_ascii_whitespace());
                    words.find(|word| !word.starts_with(b"N")) == Some(b"L")
                };
                line(&calls).map(|line| CheckEvent::ProgramEnd {
                    end: ProgramEnd::M17,
                    line,
                    column: 1,
                })
            }
            _ => None,
        }
    }
}

const LOOP: DiagnosticKind = DiagnosticKind::Loop(LoopWord::While);
