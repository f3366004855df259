//! Tests of `Checker`, which checks a text part by part. As long as the checker remembers all
//! labels, the division of the text into parts of whole lines only affects the diagnostic of a jump
//! whose label occurs before and after the jump.
#![cfg(feature = "alloc")]

use ads_cnc::streaming::{CheckEvent, Checker, ProgramEnd};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use super::common::checker::{CheckedLots, check_any_lots, check_lines as check};
use super::common::findings::findings_of as whole;
use super::kept;

/// The example in section 2.3.6 of `stream-en` has no diagnostics if its packets are checked one by
/// one. With a jump back in the second packet, it has one.
#[test]
fn jumps_of_the_example() {
    let packets = [
        &b"N01 G01 X0 Y0 Z0 F1000\r\nN10 G01 X20\r\nN20 $GOTO N40\r\nN30 G01 Z40\r\n\
        N40: G01 X40\r\nN50 $GOTO N80\r\n"[..],
        b"N60 G01 Y20\r\nN70 G01 Y40\r\n",
        b"N80: G01 X-20\r\nN90 G01 X-40\r\nM30\r\n",
    ];
    let mut checker = Checker::new();
    let found = packets.map(|packet| check(&mut checker, packet));
    assert!(found.iter().all(|(findings, _)| findings.is_empty()));
    assert_eq!(found[2].1, [(ProgramEnd::M30, 11, 1)]);
    assert_eq!(checker.lines(), 11);

    let mut checker = Checker::new();
    assert_eq!(check(&mut checker, packets[0]).0, []);
    let (findings, _) = check(&mut checker, b"N60 $GOTO N40\r\n");
    assert_eq!(findings[0].to_string(), "line 7, column 5: $GOTO back to line 5 (STM-8)");
}

#[test]
fn blocks_ends_and_programs_are_carried_over() {
    let mut checker = Checker::new();
    assert_eq!(check(&mut checker, b"N1: X1\r\n  #COMMENT BEGIN\r\n"), (vec![], vec![]));
    let open = checker.open_comment().unwrap();
    assert_eq!(open.to_string(), "line 2, column 3: #COMMENT BEGIN without #COMMENT END (STM-9)");
    assert_eq!(check(&mut checker, b"$DO\r\nM30\r\n"), (vec![], vec![]));
    assert_eq!(check(&mut checker, b"#COMMENT END M17\r\n").1, [(ProgramEnd::M17, 5, 14)]);
    assert_eq!(checker.open_comment(), None);
    let (findings, _) = check(&mut checker, b"\r\n(X)\r\n%next\r\nN2:\r\n");
    assert_eq!(findings[0].to_string(), "line 8, column 1: text after the M17 of line 5 (STM-10)");
    // The label belongs to another program.
    assert_eq!(check(&mut checker, b"$GOTO N1\r\n"), (vec![], vec![]));
    assert_eq!(check(&mut checker, b"$GOTO N2\r\n").0.len(), 1);
}

/// A jump whose label occurs before and after it is not a jump back if the later label is in the
/// same part.
#[test]
fn a_later_label_counts_if_it_is_in_the_same_part() {
    let lines = [&b"N1:\r\n"[..], b"$GOTO N1\r\n", b"N1:\r\n"];
    let mut checker = Checker::new();
    assert_eq!(check(&mut checker, &lines.concat()).0, []);
    let mut checker = Checker::new();
    assert_eq!(lines.map(|line| check(&mut checker, line).0.len()), [0, 1, 0]);
}

/// A label and a program end affect later parts even if the iterator over the events of their part
/// was dropped at once.
#[test]
fn events_that_are_not_requested_count() {
    let mut checker = Checker::new();
    drop(checker.check(b"N1:\r\nM30\r\n"));
    let found: Vec<_> = checker.check(b"$GOTO N1\r\n").map(|found| found.line()).collect();
    assert_eq!(found, [3, 3]);
}

/// When an event is returned, `remaining` returns the lines after that of the event. After a
/// program end, the CNC discards these lines.
#[test]
fn remaining_lines_are_available_after_a_program_end() {
    let lines = b"N10 X1\r\nN20 $DO X\r\nN30 M30\r\nN40 X2\r\nN50 X3\r\n";
    let mut checker = Checker::new();
    checker.check(b"%main\r\n").for_each(drop);
    let mut checked = checker.check(lines);
    assert_eq!(checked.remaining(), lines);
    let mut seen = Vec::new();
    while let Some(found) = checked.next() {
        let is_end = matches!(found, CheckEvent::ProgramEnd { end: ProgramEnd::M30, .. });
        seen.push((found.line(), is_end, checked.remaining()));
    }
    drop(checked);
    let after_end = &b"N40 X2\r\nN50 X3\r\n"[..];
    assert!(seen.contains(&(4, true, after_end)), "{seen:?}");
    for (line, _, below) in seen {
        let first = 2 + lines.split_inclusive(|&byte| byte == b'\n').count() as u32;
        let left = below.split_inclusive(|&byte| byte == b'\n').count() as u32;
        assert_eq!(line, first - left - 1);
    }
    assert_eq!(checker.lines(), 6);
}

/// Any bytes are accepted, because a CNC may receive any bytes.
#[test]
fn bytes_that_are_not_text_are_accepted() {
    let mut checker = Checker::new();
    let line = [&b"\xFF".repeat(5000)[..], b"\0 $DO M2\r\n\r\r\n\nM30"].concat();
    let (findings, ends) = check(&mut checker, &line);
    assert_eq!(findings[0].line, 1);
    assert_eq!(ends, [(ProgramEnd::M2, 1, 5007), (ProgramEnd::M30, 5, 1)]);
}

/// The checker remembers at least the documented number of recent labels, and forgets old labels.
#[test]
fn only_recent_labels_are_remembered() {
    for (length, known) in [(0, Checker::LABELS_KNOWN), (990, Checker::CHARACTERS_KNOWN / 990)] {
        let name = |n: usize| format!("{n:0>length$}").replace('0', "A");
        let mut checker = Checker::new();
        let count = 3 * known;
        for n in 0..count {
            assert_eq!(check(&mut checker, format!("[{}]\r\n", name(n)).as_bytes()).0, []);
        }
        let mut jump =
            |n| check(&mut checker, format!("$GOTO [{}]\r\n", name(n)).as_bytes()).0.len();
        assert_eq!((jump(count - 1), jump(count - known), jump(0)), (1, 1, 0), "{length}");
    }
}

/// A random line. It consists of words that are difficult to parse in combination.
fn line() -> impl Strategy<Value = Vec<u8>> {
    let piece = select(vec![
        "$FOR",
        "$GOTO N1",
        "$GOTO N2",
        "$GOTO [A]",
        "N1:",
        "N2:",
        "N01 :",
        "[A]",
        "(",
        ")",
        ";",
        "\"",
        "#COMMENT BEGIN",
        "#COMMENT END",
        "M30",
        "M2",
        "%",
        "/",
        " ",
        "L ",
        "X1",
        "N7 ",
    ]);
    (vec(piece, 0..5), select(vec!["\r\n", "\r\n", "\n", "\r"]))
        .prop_map(|(pieces, end)| (pieces.concat() + end).into_bytes())
}

/// A random text in parts of random lines. A line that is only LF does not follow a line that ends
/// in CR, because CR and LF together would be one line end.
fn lots() -> impl Strategy<Value = Vec<Vec<Vec<u8>>>> {
    vec(vec(line(), 1..6), 0..14).prop_filter("LF behind CR", |lots| {
        let lines: Vec<&Vec<u8>> = lots.iter().flatten().collect();
        !lines.windows(2).any(|two| two[0].ends_with(b"\r") && two[1].starts_with(b"\n"))
    })
}

proptest! {
#![proptest_config(kept::cases(2000, file!()))]

/// The diagnostics of each part equal those of the text so far for the lines of the part, without
/// the diagnostic of an open comment block.
#[test]
fn events_by_part_equal_those_of_the_text_so_far(lots in lots()) {
    let mut checked = CheckedLots::new(|_, _| ());
    for lot in lots {
        checked.lot(&lot.concat());
    }
}

#[test]
fn any_bytes_in_any_parts_are_accepted(lots in vec(vec(any::<u8>(), 0..60), 0..6)) {
    check_any_lots(lots.iter().map(Vec::as_slice));
}

/// If all labels are unique, the diagnostics do not depend on the parts.
#[test]
fn the_split_does_not_matter_for_unique_labels(
    mut lines in vec(line(), 0..60),
    cuts in vec(any::<prop::sample::Index>(), 0..10),
) {
    let mut seen = std::collections::BTreeSet::new();
    for (at, line) in lines.iter_mut().enumerate() {
        // Rename a label that occurs in an earlier line, even in a comment.
        let mut text = String::from_utf8(line.clone()).unwrap().replace(['\r', '\n'], "");
        for label in ["N1:", "N2:", "N01 :", "[A]"] {
            if text.contains(label) && !seen.insert(label.replace(['0', ' '], "")) {
                text = text.replace(label, &format!("N9{at}:"));
            }
        }
        *line = (text + "\r\n").into_bytes();
    }
    let mut at: Vec<usize> = cuts.iter().map(|cut| cut.index(lines.len() + 1)).collect();
    at.extend([0, lines.len()]);
    at.sort_unstable();
    let mut checker = Checker::new();
    let mut found = Vec::new();
    for cut in at.windows(2) {
        found.extend(check(&mut checker, &lines[cut[0]..cut[1]].concat()).0);
    }
    found.extend(checker.open_comment());
    prop_assert_eq!(found, whole(&lines.concat()));
}
}
