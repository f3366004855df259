//! The cases of NC text: it is split into packets, and it is checked.

use ads_cnc::streaming::{Ack, Checker, NcText, Sender};

use crate::case::{Case, Limit, Work};

/// Declares cases for texts of 1 KB, 100 KB and 10 MB. A longer text may cost at most 1.1 times as
/// many instructions per byte as the shorter one.
macro_rules! texts {
    ($($subject:literal: $lines:expr;)+) => {
        pub(super) const PACKETS: &[&[Case]] = &[$(
            texts!(@each concat!("packets of ", $subject, ", LF"), $lines, "\n", packets),
            texts!(@each concat!("packets of ", $subject, ", CR LF"), $lines, "\r\n", packets),
            texts!(@each concat!("packets of ", $subject, ", sent"), $lines, "\n", sent),
        )+];
    };
    (@each $subject:expr, $lines:expr, $end:literal, $run:ident) => {
        &[
            Case::new($subject, "1 KB", || $run(text(&$lines, $end, 1_000))),
            Case::new($subject, "100 KB", || $run(text(&$lines, $end, 100_000)))
                .within(&[Limit::Instructions("1 KB", 1.1)]),
            Case::new($subject, "10 MB", || $run(text(&$lines, $end, 10_000_000)))
                .within(&[Limit::Instructions("100 KB", 1.1)])
                .long(),
        ]
    };
}

texts! {
    "a program": program;
    "longest lines": |_| "X".repeat(990);
    "short lines": |_| "X1".into();
    "empty lines": |_| String::new();
}

macro_rules! checks {
    ($($subject:literal: $lines:expr;)+) => {
        pub(super) const CHECKS: &[&[Case]] = &[$(
            checks!(@each concat!("check of ", $subject, ", as it comes"), $lines, "\r\n", checked),
            checks!(@each concat!("check of ", $subject, ", as a whole"), $lines, "\n", findings),
        )+];
    };
    (@each $subject:expr, $lines:expr, $end:literal, $run:ident) => {
        &[
            Case::new($subject, "1 KB", || $run(text(&$lines, $end, 1_000))),
            Case::new($subject, "100 KB", || $run(text(&$lines, $end, 100_000)))
                .within(&[Limit::Instructions("1 KB", 1.58)]),
        ]
    };
}

checks! {
    "a program": program;
    "positions": |at| format!("N{at}0 G01 X{at}.125 Y-{at}.5 Z0.001 F1200");
    "comments": |at| format!("({at} is all (that (is) said) here) ; and this");
    "empty lines": |_| String::new();
    "open quotes, by line": |_| "\"(".repeat(400);
    "names": |at| format!("V.E.NAME_{at}.M30 = V.P.M2_{at} + _M30");
}

/// Declares cases for checks of whole texts, whose labels are stored in a sorted tree. A text of a
/// hundred times the length may cost 10^(2 × 1.1) times the instructions, which is 1.58 times the
/// instructions per byte.
macro_rules! grows {
    ($($subject:literal: $lines:expr;)+) => {
        pub(super) const GROWTH: &[Case] = &[$(
            Case::new(concat!("check of ", $subject), "1 KB", || whole(1_000, $lines)),
            Case::new(concat!("check of ", $subject), "100 KB", || whole(100_000, $lines))
                .within(&[Limit::Instructions("1 KB", 1.58)]),
            Case::new(concat!("check of ", $subject), "10 MB", || whole(10_000_000, $lines))
                .within(&[Limit::Instructions("100 KB", 1.58)])
                .long(),
        )+];
    };
}

// Each function creates a line from its number and the number of lines.
grows! {
    "labels": |at, _| format!("N{at}: X1");
    "jumps to lines above": |at, _| format!("N{at}: $GOTO N{}", at / 2);
    "jumps to 65 labels in turn": |at, _| match at {
        0..65 => format!("N{at}: X1"),
        _ => format!("$GOTO N{}", at % 65),
    };
    "labels, then a jump to each": |at, of| match at < of / 2 {
        true => format!("N{at}: X1"),
        false => format!("$GOTO N{}", at - of / 2),
    };
    "jumps far ahead": |at, of| match at < of / 2 {
        true => format!("$GOTO N{at}"),
        false => format!("N{}: X1", at - of / 2),
    };
    "jumps far ahead from labels": |at, of| match at < of / 2 {
        true => format!("[A{at}] $GOTO N{at}"),
        false => format!("N{}: X1", at - of / 2),
    };
    "open brackets": |_, _| "$GOTO[".repeat(150);
    "jumps to one label": |at, _| if at == 0 { "N1: X1".into() } else { "$GOTO N1".into() };
    "jumps without a label": |at, _| format!("$GOTO N{at}");
    "jumps to names": |at, _| format!("[A{at}] $GOTO [A{}]", at / 2);
    "labels of many zeros": |at, _| format!("N{}{at}: $GOTO N{at}", "0".repeat(400));
    "one label again and again": |_, _| "N10: X1".into();
    "loops": |at, _| format!("N{at} $FOR P1 = 0, 10, 1 $ENDFOR");
    "program ends": |at, _| format!("N{at} M30");
    "blocks of comment": |at, _| match at % 2 {
        0 => "#COMMENT BEGIN".into(),
        _ => "#COMMENT END".into(),
    };
    "a block of comment without an end": |at, _| match at {
        0 => "#COMMENT BEGIN".into(),
        _ => format!("N{at}: $GOTO N{at}"),
    };
    "open parentheses": |_, _| "(".repeat(900);
    "open quotes": |_, _| "\"(".repeat(400);
}

/// A line of a typical program: motion, comments, subroutines, conditions, labels and jumps.
fn program(at: usize) -> String {
    let number = at * 10;
    match at % 40 {
        0 => format!("(Contour {at}, roughing and finishing)"),
        1 => format!("N{number}: T{} D1 M6", at % 24 + 1),
        2 => format!("N{number} G54 G90 G17 S12000 M3"),
        7 => format!("N{number} $IF V.E.Quality[{at}] > 5"),
        8 => format!("N{number} $GOTO N{}", number + 50),
        9 => format!("N{number} $ENDIF"),
        13 => format!("N{number}: G0 Z50 ; clear of the part"),
        18 => format!("N{number} L CYCLE_{at}.nc [@P1=20 @P2={at}.5]"),
        19 => format!("N{number} LL Drill (subroutine)"),
        23 => format!("N{number} #MSG INFO [\"part {at} done; M30 follows\"]"),
        27 => format!("N{number} V.L.Depth = V.A.ABS.Z - P{at}"),
        31 => "; ----------------------------------------".into(),
        32 => String::new(),
        33 => format!("N{number} #HSC ON [CONTERROR 0.01]"),
        39 => format!("N{number} G41 D2 X10 Y{at}"),
        _ => format!(
            "N{number} G01 X{at}.{:03} Y-{}.5 Z{}.25 F1500",
            at * 7 % 1000,
            at % 300,
            at % 9
        ),
    }
}

/// A text of these lines that has at least `size` bytes and ends after a line.
fn text(line: &dyn Fn(usize) -> String, end: &str, size: usize) -> Vec<u8> {
    let mut text = Vec::with_capacity(size + 1000);
    for at in 0.. {
        if text.len() >= size {
            break;
        }
        text.extend(line(at).bytes());
        text.extend(end.bytes());
    }
    text
}

fn of_each_byte(text: Vec<u8>, mut run: impl FnMut(&[u8]) + 'static) -> Work {
    let units = text.len() as u64;
    Work { units, run: Box::new(move || run(std::hint::black_box(&text))) }
}

fn packets(text: Vec<u8>) -> Work {
    of_each_byte(text, |text| {
        let (mut packets, mut buf) = (NcText::new(text).unwrap().packets(), [0; 992]);
        while let Some(packet) = packets.next_into(&mut buf) {
            std::hint::black_box(packet);
        }
    })
}

fn sent(text: Vec<u8>) -> Work {
    of_each_byte(text, |text| {
        let mut sender = Sender::new(NcText::new(text).unwrap());
        while let Some(packet) = sender.packet() {
            std::hint::black_box(packet);
            sender.acknowledge(Ack::Accepted).unwrap();
        }
    })
}

/// Checks the text by a `Checker`, in parts of four packets. The CNC holds at most 4094 bytes,
/// which are about four packets.
fn checked(text: Vec<u8>) -> Work {
    let mut packets = NcText::new(&text).unwrap().packets();
    let mut lots = Vec::new();
    while let Some(packet) = packets.next_borrowed() {
        lots.push(packet.to_vec());
    }
    assert!(packets.rest().is_empty());
    let lots: Vec<_> = lots.chunks(4).map(|lot| lot.concat()).collect();
    of_each_byte(text, move |_| {
        let mut checker = Checker::new();
        for lot in std::hint::black_box(&lots) {
            std::hint::black_box(checker.check(lot).count());
        }
    })
}

/// Checks a whole text of about `size` bytes.
fn whole(size: usize, line: fn(usize, usize) -> String) -> Work {
    // Estimate the number of lines from the length of a line near the end, where line numbers are
    // longest.
    let lines = size / (line(size / 16, size).len() + 1);
    findings(text(&|at| line(at, lines), "\n", size))
}

fn findings(text: Vec<u8>) -> Work {
    of_each_byte(text, |text| {
        std::hint::black_box(NcText::new(text).unwrap().diagnostics().count());
    })
}
