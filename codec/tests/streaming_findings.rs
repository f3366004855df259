//! Tests of the diagnostics of a whole text.
#![cfg(feature = "alloc")]

use ads_cnc::streaming::{DiagnosticKind, LoopWord, NcText};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use super::common::findings::check_findings;
use super::kept;

fn findings(text: &str) -> Vec<String> {
    let text = NcText::new(text.as_bytes()).expect("text that can be streamed");
    text.diagnostics().map(|finding| finding.to_string()).collect()
}

#[track_caller]
fn clean(text: &str) {
    assert_eq!(findings(text), [""; 0], "{text}");
}

/// The example of a `$SWITCH` in two packets, from section 2.3.3 of `stream-en`.
const SWITCH: &str = "%switchstream\nN010 G00 X0 Y0 Z0\nN020 P1=10\nN030\nN040 $SWITCH P1\n\
    N050 $CASE 1\nN060 X10\nN070 $BREAK\nN080 $CASE 5\nN090 X50\nN100 $BREAK\nN110 $CASE 9\n\
    N120 X90\nN130 $BREAK\nN140 $CASE 10\nN150 X100\nN160 $ENDSWITCH\nM30\n";

/// The example of comments in two packets, from section 2.3.4 of `stream-en`.
const COMMENT: &str = "%commentstream\nN010 G00 X0 Y0 Z0 (Move to start position)\n\
    N17 G53 G90 (Absolute dimension)\nN18 G00 X0\nN21 G54 G90 ;Zero offsets\n#COMMENT BEGIN\n\
    #HSC ON [OPMODE 2]\nN22 (==========)\nN22 (PROG NAME : Test.nc)\nN25 (HISTORY :)\n\
    N29 S30000 M03\nN32 G01 X14.4 Y9.216\n#COMMENT END\nN33 G01 X14.4 Y9.216 F30000\nM30\n";

/// The example of a jump within a packet and a jump over a packet, from section 2.3.6 of
/// `stream-en`.
const FORWARD: &str = "N01 G01 X0 Y0 Z0 F1000\nN10 G01 X20\nN20 $GOTO N40\nN30 G01 Z40\n\
    N40: G01 X40\nN50 $GOTO N80\nN60 G01 Y20\nN70 G01 Y40\nN80: G01 X-20\nN90 G01 X-40\nM30\n";

#[test]
fn printed_examples_are_clean() {
    clean(SWITCH);
    clean(COMMENT);
    clean(FORWARD);
    // These are the examples of sections 2.3.1, 2.3.2 and 2.3.7. In the last one, parentheses are
    // not closed.
    clean("N10 G01 X200 F1000\nN20 X240 Y100\nN30 X200 Y0\nN40 #FLUSH CONTINUE");
    clean("N10 G01 X200 F1000\nN20 X240 Y100\nN30 X200 Y0\nN40 L subprogram.nc\n");
    clean(
        "%streaming-spline\n#SPLINE TYPE BSPLINE\nG151\nN36335 X-1.5586 Y-16.3853 (M122\n\
        N36336 X-1.5666 Y-16.4702 Z2.9971\nN36348 X-1.657 Y-17.4202 (Z2.4442\n",
    );
    // `$IF`, `$SWITCH` and the words that belong to them are not loops.
    clean(
        "$IF P1 == 1\nX1\n$ELSEIF P1 == 2\nX2\n$ELSE\nX3\n$ENDIF\n$SWITCH P1\n$DEFAULT\n$ENDSWITCH\n",
    );
}

/// A file name after `L` ends at a character that it cannot contain, so that an M30 after it is a
/// program end.
#[test]
fn names_of_files_end() {
    for behind in [" M30", "\tM30", "[1] M30", "\"x\" M30", "(x) M30"] {
        let text = format!("L sub.nc{behind}\nX1\n");
        assert_eq!(
            findings(&text),
            ["line 2, column 1: text after the M30 of line 1 (STM-10)"],
            "{text}"
        );
    }
    clean("L M30\nL sub_M30.nc\nX1\n");
}

/// A comment between an address letter and its number is skipped, so that an M30 after the number
/// is a program end.
#[test]
fn numbers_after_comments_are_skipped() {
    for text in ["X(a)5 M30\nX1\n", "X(a)12.5M30\nX1\n", "X(a)5.M30\nX1\n"] {
        let wanted = "line 2, column 1: text after the M30 of line 1 (STM-10)";
        assert_eq!(findings(text), [wanted], "{text}");
    }
}

/// Each of the three examples above has a diagnostic after one change.
#[test]
fn changed_examples_have_diagnostics() {
    let with = |text: &str, from: &str, to: &str| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        findings(&text.replace(from, to))
    };
    assert_eq!(
        with(SWITCH, "$SWITCH P1", "$WHILE P1"),
        ["line 5, column 6: $WHILE in a stream (STM-8)"]
    );
    assert_eq!(
        with(FORWARD, "$GOTO N80", "$GOTO N40"),
        ["line 6, column 5: $GOTO back to line 5 (STM-8)"]
    );
    assert_eq!(
        with(COMMENT, "#COMMENT END\n", ""),
        ["line 6, column 1: #COMMENT BEGIN without #COMMENT END (STM-9)"]
    );
    assert_eq!(
        with(COMMENT, "S30000 M03", "\n#COMMENT END\nM30"),
        ["line 14, column 1: text after the M30 of line 13 (STM-10)"]
    );
    assert_eq!(
        with(FORWARD, "M30\n", "M30\nX1"),
        ["line 12, column 1: text after the M30 of line 11 (STM-10)"]
    );
}

#[test]
fn each_loop_word_is_found() {
    for word in LoopWord::ALL {
        for text in [format!("{word}"), format!("N1 X1 {}[1]", word.to_string().to_lowercase())] {
            let text = NcText::new(text.as_bytes()).unwrap();
            let kinds: Vec<_> = text.diagnostics().map(|finding| finding.kind).collect();
            assert_eq!(kinds, [DiagnosticKind::Loop(word)]);
        }
        // A longer word, a word in quotes, and a word without `$` are not loop words.
        clean(&format!("{word}X 1\n#MSG [\"{word}\"]"));
        clean(&word.to_string()[1..]);
    }
}

#[test]
fn comments_hide_words_and_only_words() {
    for comment in [
        "($FOR)",
        "($FOR",
        "($FOR M30 (nested) $FOR)",
        "(a (b $FOR",
        ";$FOR",
        "; ( $FOR",
        "X1 ; $FOR",
        "#COMMENT BEGIN\n$FOR\n(\n$GOTO N1\n#COMMENT END",
        "N1 #COMMENT BEGIN (why)\n$DO\n/ N2 #COMMENT END",
        "#comment\tbegin\n #COMMENT ENDE $FOR\nX1 #COMMENT END $FOR\n(#COMMENT END) $FOR\n#COMMENT END",
        "#COMMENT BEGIN\n#COMMENT BEGIN\n$FOR\n#COMMENT END",
    ] {
        clean(comment);
        let behind = format!("{comment}\n$FOR");
        let line = behind.lines().count();
        assert_eq!(findings(&behind), [format!("line {line}, column 1: $FOR in a stream (STM-8)")]);
    }
    for (code, column) in [
        ("(a) $FOR", 5),
        ("(a (b)) $FOR", 9),
        ("()$FOR", 3),
        ("#MSG [\"(\"] $FOR", 12),
        ("\" $FOR", 3),
    ] {
        assert_eq!(findings(code), [format!("line 1, column {column}: $FOR in a stream (STM-8)")]);
    }
    // These lines neither begin nor end a comment block.
    for no_block in [
        "X1 #COMMENT BEGIN",
        "(#COMMENT BEGIN)",
        "#COMMENTBEGIN",
        "#COMMENT BEGINS",
        "#COMMENT END",
    ] {
        assert_eq!(
            findings(&format!("{no_block}\n$DO")),
            ["line 2, column 1: $DO in a stream (STM-8)"]
        );
    }
}

#[test]
fn jumps_back_are_found_and_no_others() {
    for back in [
        "N1: X1\n$GOTO N1",
        "N1: $GOTO N1",
        "N001:\nX1 $GOTO N01 M8",
        " / N1 : X1\n$goto n1",
        "/1 N1:\n$GOTO N 1",
        "[AGAIN] X1\n$GOTO [again]",
        "N5 [ A ]\n$GOTO [A]",
        "%a\nN1:\n$IF P1 == 1 $GOTO N1",
        "N0:\n$GOTO N00",
        "N1:\n$GOTO N1 (+ 1)",
    ] {
        let line = NcText::new(back.as_bytes()).unwrap().line_count();
        let to = usize::from(back.starts_with('%')) + 1;
        let found = findings(back);
        assert_eq!(found.len(), 1, "{back}");
        assert!(found[0].starts_with(&format!("line {line}, ")), "{found:?}");
        assert!(found[0].ends_with(&format!(": $GOTO back to line {to} (STM-8)")), "{found:?}");
    }
    for no_back in [
        // The label occurs after the jump, or before and after it, or it does not occur.
        "$GOTO N1\nN1:",
        "N1:\n$GOTO N1\nN1:",
        "$GOTO N1",
        "N1:\n$GOTO N11\nN11:",
        "N1:\n$GOTO N11",
        // The last line contains no jump, or a jump whose target is not a label.
        "N1:\n($GOTO N1)",
        "N1:\n;$GOTO N1",
        "N1:\n\"$GOTO N1\"",
        "N1:\n$GOTO N1+P1",
        "N1:\n$GOTO NV.E.N1",
        "N1:\n$GOTO P1",
        "N1:\n$GOTOX N1",
        "[A]\n$GOTO V.E.A",
        "[A]\n$GOTO [A",
        // No line before the jump has this label.
        "N1\n$GOTO N1",
        "(N1:)\n$GOTO N1",
        ";N1:\n$GOTO N1",
        "X1 N1:\n$GOTO N1",
        "X[A]\n$GOTO [A]",
        "#COMMENT BEGIN\nN1:\n#COMMENT END\n$GOTO N1",
        "N[1]:\n$GOTO N1",
        "N1:\n$GOTO [1]",
        "[1]\n$GOTO N1",
        // The label belongs to an earlier program.
        "%L sub\nN1:\nM29\n%main\n$GOTO N1",
    ] {
        let jumps: Vec<_> =
            findings(no_back).into_iter().filter(|found| found.contains("GOTO")).collect();
        assert_eq!(jumps, [""; 0], "{no_back}");
    }
    // Two programs have a label N1; the jump in the first program goes to the label of this
    // program.
    let two = "%L sub\nN1:\n$GOTO N1\nM29\n%main\nN1:";
    assert_eq!(findings(two)[0], "line 3, column 1: $GOTO back to line 2 (STM-8)");
}

#[test]
fn text_behind_program_ends_is_found_and_behind_nothing_else() {
    for (end, name) in [
        ("M30", "M30"),
        ("N9 M2 (end)", "M2"),
        ("M02", "M2"),
        ("m030", "M30"),
        ("G0X1.M17", "M17"),
        ("XP1M29", "M29"),
        ("X.5M30", "M30"),
        ("X 10M30", "M30"),
        ("WAIT M30", "M30"),
        ("X1 M30 Y2", "M30"),
        ("N9M30", "M30"),
        ("$IF P1 == 1 M30", "M30"),
        ("M30 M2", "M30"),
        ("P_1=2 M30", "M30"),
    ] {
        clean(end);
        clean(&format!("{end}\n\n  \t\n(comment)\n;comment\n#COMMENT BEGIN\nX1\n#COMMENT END\n"));
        assert_eq!(
            findings(&format!("{end}\n\n (c) X1\nX2\n")),
            [format!("line 3, column 6: text after the {name} of line 1 (STM-10)")],
            "{end}"
        );
    }
    for no_end in [
        "M3",
        "M300",
        "M0300",
        "M",
        "M20",
        "M1 M7",
        "M30.5",
        "M30_X",
        "V.E.M30",
        "V.E.A[1].M30=1",
        "P_M30=1",
        "_M30",
        "TOOL1_M30=1",
        "(M30)",
        ";M30",
        "ROOM30",
        "AM2=1",
        "L M30.nc",
        "LL M30",
        "L M30",
        "%M30",
        "#MSG [\"M30\"]",
        "X.30",
        "$GOTO [M30]",
        "[M30]",
        "V.E.X1M30",
    ] {
        clean(&format!("{no_end}\nX1"));
    }
    // Text after a program end causes one diagnostic, and a loop word in this text causes another.
    assert_eq!(
        findings("M30\n$DO\nX1\nM17\nX1\n%next\nM2"),
        [
            "line 2, column 1: text after the M30 of line 1 (STM-10)",
            "line 2, column 1: $DO in a stream (STM-8)",
            "line 5, column 1: text after the M17 of line 4 (STM-10)"
        ]
    );
}

#[test]
fn diagnostics_have_a_requirement_and_a_consequence() {
    let text = NcText::new(b"N1:\n$GOTO N1\n$DO\nM30\nX1\n#COMMENT BEGIN").unwrap();
    let found: Vec<_> =
        text.diagnostics().map(|at| (at.kind.clause(), at.kind.ends_streaming())).collect();
    assert_eq!(found, [("STM-8", true), ("STM-8", true), ("STM-10", false), ("STM-9", false)]);
}

/// Jumps back are found in texts with 5000 labels and jumps, and jumps forward are not reported.
#[test]
fn jumps_back_are_found_among_many_labels() {
    let count = 5000;
    let labels = || (0..count).map(|n| format!("N{n}: X1\n"));
    let jumps = || (0..count).map(|n| format!("$GOTO N{n}\n"));
    assert_eq!(findings(&labels().chain(jumps()).collect::<String>()).len(), count);
    clean(&jumps().chain(labels()).collect::<String>());
    clean(&labels().chain(jumps()).chain(labels()).collect::<String>());
    clean(&jumps().zip(labels()).map(|(jump, label)| jump + &label).collect::<String>());
}

/// A line of a random program with jumps; the labels are 0 to 5.
#[derive(Clone, Copy, Debug)]
enum Line {
    Label(u8),
    Goto(u8),
    Both(u8, u8),
    Program,
    Other,
}

fn program() -> impl Strategy<Value = Vec<Line>> {
    let line = prop_oneof![
        3 => (0..6_u8).prop_map(Line::Label),
        4 => (0..6_u8).prop_map(Line::Goto),
        1 => (0..6_u8, 0..6_u8).prop_map(|(label, goto)| Line::Both(label, goto)),
        1 => Just(Line::Program),
        4 => Just(Line::Other),
    ];
    vec(line, 0..60)
}

impl Line {
    fn text(self) -> String {
        match self {
            Self::Label(label) => format!("N{label}: X1\n"),
            Self::Goto(goto) => format!("X1 $GOTO N{goto}\n"),
            Self::Both(label, goto) => format!("N{label}: $GOTO N{goto}\n"),
            Self::Program => "%next\n".into(),
            Self::Other => "N1 ($GOTO N1)\n".into(),
        }
    }

    fn label(self) -> Option<u8> {
        match self {
            Self::Label(label) | Self::Both(label, _) => Some(label),
            _ => None,
        }
    }

    fn goto(self) -> Option<u8> {
        match self {
            Self::Goto(goto) | Self::Both(_, goto) => Some(goto),
            _ => None,
        }
    }
}

/// The expected jumps back: the index of the line of the jump, and that of the last line with the
/// label in the same program, if this is not after the jump.
fn jumps_back(program: &[Line]) -> Vec<(usize, usize)> {
    let is_title = |line: &Line| matches!(line, Line::Program);
    let mut back = Vec::new();
    for (at, line) in program.iter().enumerate() {
        let Some(goto) = line.goto() else { continue };
        let start = program[..at].iter().rposition(is_title).map_or(0, |title| title + 1);
        let end = program[at..].iter().position(is_title).map_or(program.len(), |title| at + title);
        let places: Vec<_> =
            (start..end).filter(|&place| program[place].label() == Some(goto)).collect();
        if let Some(&last) = places.last().filter(|&&last| last <= at) {
            back.push((at, last));
        }
    }
    back
}

/// A random text of words that are difficult to parse in combination.
fn pieces() -> impl Strategy<Value = String> {
    let piece = select(vec![
        "$FOR",
        "$GOTO",
        "$GOTO N1",
        "N1:",
        "N1",
        ":",
        "[A]",
        "(",
        ")",
        ";",
        "\"",
        "#COMMENT BEGIN",
        "#COMMENT END",
        "#COMMENT",
        "M30",
        "M2",
        "M",
        "30",
        ".",
        "_",
        "%",
        "/",
        " ",
        "\t",
        "\n",
        "\r\n",
        "\r",
        "V.E.x",
        "L ",
        "$",
        "X1",
    ]);
    vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

proptest! {
#![proptest_config(kept::cases(1000, file!()))]

#[test]
fn jumps_back_are_found_as_defined(program in program()) {
    let text: String = program.iter().map(|line| line.text()).collect();
    let found: Vec<_> = NcText::new(text.as_bytes()).unwrap().diagnostics().map(|at| (at.line, at.kind)).collect();
    let wanted: Vec<_> = jumps_back(&program)
        .into_iter()
        .map(|(at, to)| (at as u32 + 1, DiagnosticKind::BackwardJump { to: to as u32 + 1 }))
        .collect();
    prop_assert_eq!(found, wanted);
}

/// For any text, the diagnostics satisfy `check_findings`. A text within a comment block or a
/// comment has no diagnostics.
#[test]
fn findings_of_any_text(text in pieces()) {
    check_findings(text.as_bytes(), |_, _| ());
    let comment = text.replace("#COMMENT END", "");
    let hidden = format!("#COMMENT BEGIN\n{comment}\n#COMMENT END");
    prop_assert_eq!(NcText::new(hidden.as_bytes()).unwrap().diagnostics().count(), 0);
    let hidden = text.replace(['\r', '\n'], " ");
    prop_assert_eq!(NcText::new(format!(";{hidden}").as_bytes()).unwrap().diagnostics().count(), 0);
}}
