//! What streamed programs do (STM).

use super::{Row, habit};
use crate::cnc::program::Habit;

pub(super) const ROWS: &[Row] = &[
    habit("cnc.stm.room-8188", &["STM-3"], "the interface holds up to 8188 bytes", Habit::Roomy),
    habit("cnc.stm.room-2048", &["STM-3"], "the interface holds 2048 bytes", Habit::Narrow),
    habit("cnc.stm.loops-run", &["STM-8"], "words of loops are run", Habit::Loops),
    habit("cnc.stm.jumps-back-run", &["STM-8"], "a jump back is run", Habit::JumpsBack),
    habit(
        "cnc.stm.jumps-back-forgotten",
        &["STM-8"],
        "a jump back to a label of an earlier read is run",
        Habit::Forgets,
    ),
    habit(
        "cnc.stm.branches-whole",
        &["STM-8"],
        "an $IF or $SWITCH without its end in the same read ends streaming",
        Habit::BranchesWhole,
    ),
    habit(
        "cnc.stm.branches-refused",
        &["STM-19"],
        "$IF and $SWITCH end streaming, as loops do",
        Habit::Branches,
    ),
    habit("cnc.stm.jumps-refused", &["STM-19"], "every $GOTO ends streaming", Habit::Jumps),
    habit(
        "cnc.stm.comments-run",
        &["STM-9"],
        "a word of a loop in a comment ends streaming",
        Habit::Comments,
    ),
    habit("cnc.stm.end-ignored", &["STM-10"], "M2, M30, M17 and M29 end nothing", Habit::NoEnd),
    habit(
        "cnc.stm.end-m30-only",
        &["STM-10"],
        "M30 ends a program, M2, M17 and M29 do not",
        Habit::EndM30,
    ),
    habit(
        "cnc.stm.behind-end-run",
        &["STM-10"],
        "what was read with a program end is run before the program ends",
        Habit::AfterEnd,
    ),
    habit(
        "cnc.stm.end-empties",
        &["STM-10"],
        "a program end empties the interface",
        Habit::EndEmpties,
    ),
    habit(
        "cnc.stm.reset-keeps",
        &["STM-11"],
        "an NC reset leaves the interface as it is",
        Habit::ResetKeeps,
    ),
    habit(
        "cnc.stm.reset-goes-on",
        &["STM-11"],
        "an NC reset does not end streaming",
        Habit::ResetGoesOn,
    ),
    habit(
        "cnc.stm.reads-packets",
        &["STM-12"],
        "the CNC reads one packet at a time",
        Habit::Packets,
    ),
    habit(
        "cnc.stm.starts-itself",
        &["STM-14"],
        "streaming begins without a start",
        Habit::StartsItself,
    ),
    habit(
        "cnc.stm.starts-empty",
        &["STM-14"],
        "a start empties the interface",
        Habit::StartEmpties,
    ),
    habit(
        "cnc.stm.reads-reversed",
        &["STM-15"],
        "packets that wait are taken last first",
        Habit::Reversed,
    ),
    habit("cnc.stm.dry-ends", &["STM-16"], "without more lines the program ends", Habit::DryEnds),
    habit(
        "cnc.stm.subroutine-ends",
        &["STM-18"],
        "the M17 of a global subroutine ends the stream that calls it",
        Habit::SubroutineEnds,
    ),
    habit("cnc.stm.error-none", &["STM-5"], "a line without CR LF is skipped", Habit::SkipsLines),
    habit(
        "cnc.stm.error-other",
        &["STM-5"],
        "the error of a line without CR LF is 21477",
        Habit::OtherError,
    ),
];
