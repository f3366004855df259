//! Defects of the streaming interface and in the execution of streamed programs (STM).

use ads_cnc::limits::STREAM_MAX;
use ads_cnc::streaming::{
    Ack, CheckEvent, Checker, Diagnostic, DiagnosticKind, LINE_END_ERROR, LineError, LoopWord,
    ProgramEnd, check_line_ends,
};
use ads_cnc_vectors::ids::*;

use super::{CncDefect, program};
use crate::simulator::program::{
    Buffer, Policy, ProgramEvent, ProgramSegment, StreamingInterface, lines,
};

const RIGHT: Policy = Policy::DEFAULT;

/// A streaming interface that stores the boundaries of writes.
#[derive(Debug)]
struct PacketBuffer {
    stored: Vec<Vec<u8>>,
    room: usize,
    /// Removes the bytes to execute from the stored packets and returns them.
    take: Take,
}

type Taken = Result<Vec<u8>, LineError>;
type Take = fn(&mut Vec<Vec<u8>>, Result<(), LineError>) -> Taken;

impl PacketBuffer {
    fn of(room: usize, take: Take) -> Box<dyn Buffer> {
        Box::new(Self { stored: Vec::new(), room, take })
    }

    fn all(stored: &mut Vec<Vec<u8>>, ends: Result<(), LineError>) -> Taken {
        let all = std::mem::take(stored).concat();
        ends.map(|()| all)
    }

    fn first(stored: &mut Vec<Vec<u8>>, ends: Result<(), LineError>) -> Taken {
        match ends {
            Ok(()) => Ok(stored.drain(..1.min(stored.len())).flatten().collect()),
            Err(error) => {
                stored.clear();
                Err(error)
            }
        }
    }

    fn reversed(stored: &mut Vec<Vec<u8>>, ends: Result<(), LineError>) -> Taken {
        stored.reverse();
        Self::all(stored, ends)
    }

    fn whole_lines(stored: &mut Vec<Vec<u8>>, _: Result<(), LineError>) -> Taken {
        let all = std::mem::take(stored).concat();
        Ok(lines(&all).filter(|line| line.ends_with(b"\r\n")).flatten().copied().collect())
    }
}

impl Buffer for PacketBuffer {
    fn write(&mut self, data: &[u8]) -> Ack {
        // Writes of an invalid length are rejected, as by the correct CNC.
        if StreamingInterface::new().write(data) == Ack::Rejected {
            return Ack::Rejected;
        }
        if self.len().saturating_add(data.len()) > self.room {
            return Ack::Busy;
        }
        self.stored.push(data.to_vec());
        Ack::Accepted
    }

    fn read(&mut self) -> Taken {
        let ends = check_line_ends(&self.stored.concat());
        (self.take)(&mut self.stored, ends)
    }

    fn len(&self) -> usize {
        self.stored.iter().map(Vec::len).sum()
    }

    fn clear(&mut self) {
        self.stored.clear();
    }
}

/// The lines read, with the events of the check except those for which `is_overlooked` returns
/// true.
fn overlooking(
    checker: &mut Checker,
    read: &[u8],
    is_overlooked: fn(&CheckEvent) -> bool,
) -> ProgramSegment {
    let number = checker.lines().saturating_add(1);
    let found = checker.check(read).filter(|found| !is_overlooked(found));
    ProgramSegment::with_findings(read, number, found)
}

const fn kind(found: &CheckEvent) -> Option<DiagnosticKind> {
    match found {
        CheckEvent::Diagnostic(finding) => Some(finding.kind),
        CheckEvent::ProgramEnd { .. } => None,
    }
}

fn loops(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    overlooking(checker, read, |found| matches!(kind(found), Some(DiagnosticKind::Loop(_))))
}

fn jumps_back(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    overlooking(checker, read, |found| {
        matches!(kind(found), Some(DiagnosticKind::BackwardJump { .. }))
    })
}

fn no_end(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    overlooking(checker, read, |found| matches!(found, CheckEvent::ProgramEnd { .. }))
}

fn m30_only(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    overlooking(
        checker,
        read,
        |found| matches!(found, CheckEvent::ProgramEnd { end, .. } if *end != ProgramEnd::M30),
    )
}

/// Checks each read with a new checker, which does not know the labels of earlier reads.
fn forgets(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    *checker = Checker::new();
    ProgramSegment::new(checker, read)
}

fn comments(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    let number = checker.lines().saturating_add(1);
    let blank = |byte: &u8| if b"();#".contains(byte) { b' ' } else { *byte };
    let seen: Vec<u8> = read.iter().map(blank).collect();
    ProgramSegment::with_findings(read, number, checker.check(&seen))
}

/// Executes the lines after the program end too, up to the end of the data that was read.
fn past_end(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    let number = checker.lines().saturating_add(1);
    let mut found: Vec<CheckEvent> = checker.check(read).collect();
    if let Some(at) = found.iter().position(|found| matches!(found, CheckEvent::ProgramEnd { .. }))
    {
        let line = found.get(at).map(CheckEvent::line);
        found.retain(|one| Some(one.line()) <= line);
    }
    for one in &mut found {
        if let CheckEvent::ProgramEnd { line, .. } = one {
            *line = checker.lines();
        }
    }
    ProgramSegment::with_findings(read, number, found)
}

/// Adds the finding `found` for the first line for which `is_end` returns true.
fn ended_by(
    checker: &mut Checker,
    read: &[u8],
    found: fn(u32) -> CheckEvent,
    is_end: fn(&[u8]) -> bool,
) -> ProgramSegment {
    let number = checker.lines().saturating_add(1);
    let place = lines(read).position(is_end).and_then(|place| u32::try_from(place).ok());
    let own = place.map(|place| found(number.saturating_add(place)));
    ProgramSegment::with_findings(read, number, own.into_iter().chain(checker.check(read)))
}

/// A finding that rejects a line because of a loop word.
const fn looped(line: u32) -> CheckEvent {
    CheckEvent::Diagnostic(Diagnostic {
        line,
        column: 1,
        kind: DiagnosticKind::Loop(LoopWord::While),
    })
}

fn has(line: &[u8], word: &[u8]) -> bool {
    line.windows(word.len()).any(|part| part == word)
}

fn branches(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    ended_by(checker, read, looped, |line| has(line, b"$IF") || has(line, b"$SWITCH"))
}

fn whole_branches(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    let count = |word: &[u8]| lines(read).filter(|line| has(line, word)).count();
    if count(b"$IF") == count(b"$ENDIF") && count(b"$SWITCH") == count(b"$ENDSWITCH") {
        ProgramSegment::new(checker, read)
    } else {
        branches(checker, read)
    }
}

fn jumps(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    ended_by(checker, read, looped, |line| has(line, b"$GOTO"))
}

fn subroutines(checker: &mut Checker, read: &[u8]) -> ProgramSegment {
    let end = |line| CheckEvent::ProgramEnd { end: ProgramEnd::M17, line, column: 1 };
    ended_by(checker, read, end, |line| {
        let mut words = line.split(|byte| byte.is_ascii_whitespace());
        words.find(|word| !word.starts_with(b"N")) == Some(b"L")
    })
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    program("cnc.stm.room-8188", &[STM_3],
        "the streaming interface holds up to 8188 bytes instead of 4094",
        Policy { buffer: || PacketBuffer::of(2 * STREAM_MAX, PacketBuffer::all), ..RIGHT }),
    program("cnc.stm.room-2048", &[STM_3],
        "the streaming interface holds up to 2048 bytes instead of 4094",
        Policy { buffer: || PacketBuffer::of(2048, PacketBuffer::all), ..RIGHT }),
    program("cnc.stm.loops-run", &[STM_8],
        "a line with a loop command, such as $WHILE, is executed instead of ending streaming",
        Policy { segment: loops, ..RIGHT }),
    program("cnc.stm.jumps-back-run", &[STM_8],
        "a $GOTO to an earlier line is executed instead of ending streaming",
        Policy { segment: jumps_back, ..RIGHT }),
    program("cnc.stm.jumps-back-forgotten", &[STM_8],
        "a $GOTO to an earlier line is executed if the label was not read together with it",
        Policy { segment: forgets, ..RIGHT }),
    program("cnc.stm.branches-whole", &[STM_8],
        "an $IF or $SWITCH whose end is not read together with it ends streaming with an error",
        Policy { segment: whole_branches, ..RIGHT }),
    program("cnc.stm.branches-refused", &[STM_19], "$IF and $SWITCH end streaming, as loops do",
        Policy { segment: branches, ..RIGHT }),
    program("cnc.stm.jumps-refused", &[STM_19], "every $GOTO ends streaming",
        Policy { segment: jumps, ..RIGHT }),
    program("cnc.stm.comments-run", &[STM_9],
        "a loop command in a comment ends streaming with an error",
        Policy { segment: comments, ..RIGHT }),
    program("cnc.stm.end-ignored", &[STM_10], "M2, M30, M17 and M29 do not end the program",
        Policy { segment: no_end, ..RIGHT }),
    program("cnc.stm.end-m30-only", &[STM_10],
        "only M30 ends the program, and M2, M17 and M29 do not",
        Policy { segment: m30_only, ..RIGHT }),
    program("cnc.stm.behind-end-run", &[STM_10],
        "the lines after a program end that are read together with it are executed",
        Policy { segment: past_end, ..RIGHT }),
    program("cnc.stm.end-empties", &[STM_10], "a program end empties the streaming interface",
        Policy { clears: &[ProgramEvent::Reset, ProgramEvent::End], ..RIGHT }),
    program("cnc.stm.reset-keeps", &[STM_11], "an NC reset does not empty the streaming interface",
        Policy { clears: &[], ..RIGHT }),
    program("cnc.stm.reset-goes-on", &[STM_11], "an NC reset does not end streaming",
        Policy { ends: &[], ..RIGHT }),
    program("cnc.stm.reads-packets", &[STM_12], "the CNC reads one packet at a time",
        Policy { buffer: || PacketBuffer::of(STREAM_MAX, PacketBuffer::first), ..RIGHT }),
    program("cnc.stm.starts-itself", &[STM_14],
        "streaming begins at power-on and after an NC reset, even if no program is started",
        Policy { starts: &[ProgramEvent::PowerOn, ProgramEvent::Reset], ..RIGHT }),
    program("cnc.stm.starts-empty", &[STM_14],
        "a start of the streaming program empties the streaming interface",
        Policy { clears: &[ProgramEvent::Reset, ProgramEvent::Start], ..RIGHT }),
    program("cnc.stm.reads-reversed", &[STM_15],
        "the CNC reads the packets in the streaming interface in reverse order",
        Policy { buffer: || PacketBuffer::of(STREAM_MAX, PacketBuffer::reversed), ..RIGHT }),
    program("cnc.stm.dry-ends", &[STM_16],
        "the program ends when the streaming interface has no more lines",
        Policy { ends: &[ProgramEvent::Reset, ProgramEvent::Dry], ..RIGHT }),
    program("cnc.stm.subroutine-ends", &[STM_18],
        "the M17 of a global subroutine ends the streaming program that calls it",
        Policy { segment: subroutines, ..RIGHT }),
    program("cnc.stm.error-none", &[STM_5],
        "the CNC skips a line without CR LF instead of ending with error 21476",
        Policy { buffer: || PacketBuffer::of(STREAM_MAX, PacketBuffer::whole_lines), ..RIGHT }),
    program("cnc.stm.error-other", &[STM_5],
        "the error number of a line without CR LF is 21477 instead of 21476",
        Policy { line_end_error: LINE_END_ERROR + 1, ..RIGHT }),
];
