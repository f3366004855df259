//! Tests of data streaming: texts, packets and the sender.

use ads_cnc::limits::{NC_LINE_MAX, STREAM_MAX, STREAM_PACKET_MAX};
use ads_cnc::streaming::*;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use super::common::streaming::*;
use super::kept;

const ENDS: [&str; 3] = ["\n", "\r\n", "\r"];

#[test]
fn texts_of_zero_and_one_byte_have_their_lines() {
    assert_eq!(packets(b""), [[0; 0]; 0]);
    assert_eq!(packets(b"X"), [b"X\r\n"]);
    assert_eq!(packets(b"\n"), [b"\r\n"]);
    assert_eq!(packets(b"\r"), [b"\r\n"]);
    assert_eq!(packets(b"\r\n"), [b"\r\n"]);
    assert_eq!(packets(b"\r\r\n\n"), [b"\r\n\r\n\r\n"]);
}

/// ADS errors of the target, the service, the address, the access and the size are final
/// rejections; all other errors mean busy.
#[test]
fn results_are_converted_to_acknowledgements() {
    use ads_cnc::ads::AdsError;

    let rejected = [6, 7, 0x701, 0x702, 0x703, 0x704, 0x705];
    for number in (0..0x1_0000).chain([u32::MAX]) {
        let wanted = match number {
            0 => Ack::Accepted,
            number if rejected.contains(&number) => Ack::Rejected,
            _ => Ack::Busy,
        };
        assert_eq!(Ack::from_result(AdsError(number)), wanted, "{number:#x}");
    }
}

/// Lines of 989 and 990 characters are accepted, and lines of 991 characters are rejected, as the
/// first or the second line of a text and with any line end.
#[test]
fn lines_are_accepted_up_to_990_characters() {
    for end in ["", "\n", "\r\n", "\r"] {
        for before in ["", "N1\n", "N1\r\n"] {
            for len in [989, 990] {
                check_packets(format!("{before}{}{end}", "X".repeat(len)).as_bytes());
            }
            let text = format!("{before}{}{end}", "X".repeat(991));
            let error = NcText::new(text.as_bytes()).unwrap_err();
            let line = if before.is_empty() { 1 } else { 2 };
            assert_eq!((error.line(), error.column()), (line, 991));
            assert_eq!(error.kind(), LineErrorKind::TooLong { length: 991 });
            assert_eq!(
                error.to_string(),
                format!(
                    "line {line}, column 991: line of at most 990 characters expected, 991 found (STM-20)"
                )
            );
        }
    }
}

/// Two lines are in one packet if they fit it together with their line ends, and in two packets if
/// they have one byte more.
#[test]
fn packets_are_filled_to_the_last_byte() {
    for end in ENDS {
        for last in [end, ""] {
            let lens = |len| -> Vec<usize> {
                let text = format!("A{end}{}{last}", "X".repeat(len));
                check_packets(text.as_bytes());
                packets(text.as_bytes()).iter().map(Vec::len).collect()
            };
            assert_eq!((lens(986), lens(987), lens(988)), (vec![991], vec![992], vec![3, 990]));
        }
    }
}

/// Control characters other than NUL, CR and LF are text.
#[test]
fn other_control_characters_are_text() {
    let line = "\t\x0B\x0C\x08\x0E\x7F".repeat(5);
    assert_eq!(packets(line.as_bytes()), [format!("{line}\r\n").into_bytes()]);
    for control in 1..0x20_u8 {
        if !b"\r\n".contains(&control) {
            let line = format!("N1 {}", char::from(control)).repeat(5);
            check_packets(format!("{line}\n{line}\r\n{line}").as_bytes());
        }
    }
}

#[test]
fn errors_name_the_first_fault() {
    let show = |bytes: &[u8]| NcText::new(bytes).unwrap_err().to_string();
    assert_eq!(show(b"\0"), "line 1, column 1: ASCII character expected, NUL found (STM-7)");
    assert_eq!(
        show(b"N1\r\nN2\rN\x80"),
        "line 3, column 2: ASCII character expected, byte 0x80 found (STM-7)"
    );
    assert_eq!(
        show("N1\n\n(ä)".as_bytes()),
        "line 3, column 2: ASCII character expected, byte 0xC3 found (STM-7)"
    );
    let long = [&b"X".repeat(2000)[..], b"\xFF\n\0"].concat();
    assert_eq!(
        show(&long),
        "line 1, column 991: line of at most 990 characters expected, 2001 found (STM-20)"
    );
    let early = [&b"X".repeat(900)[..], b"\xFF", &b"X".repeat(900)].concat();
    assert_eq!(
        show(&early),
        "line 1, column 901: ASCII character expected, byte 0xFF found (STM-7)"
    );
}

#[test]
fn constants_are_those_of_the_manual() {
    assert_eq!((STREAM_PACKET_MAX, STREAM_MAX, NC_LINE_MAX), (992, 4094, 990));
    assert_eq!((INDEX_OFFSET.get(), OBJECT_NAME), (0x90, "mc_program_stream_w"));
    assert_eq!((LINE_END_ERROR, BUSY_WARNING, RETRY_AFTER.as_millis()), (21476, 11012, 500));
}

#[test]
fn a_sender_of_nothing_is_done() {
    let mut sender = Sender::new(NcText::new(b"").unwrap());
    assert_eq!(sender.packet(), None);
    assert_eq!(sender.state(), SenderState::Done);
    assert_eq!(sender.acknowledge(Ack::Accepted), Err(UnexpectedAck));
    assert_eq!(sender.state(), SenderState::Done);
}

#[test]
fn a_sender_accepts_one_acknowledgement_per_packet() {
    for (ack, state) in [
        (Ack::Accepted, SenderState::Done),
        (Ack::Busy, SenderState::Waiting),
        (Ack::Rejected, SenderState::Stopped),
    ] {
        let mut sender = Sender::new(NcText::new(b"M30").unwrap());
        assert_eq!(sender.acknowledge(ack), Err(UnexpectedAck));
        assert_eq!(sender.packet(), Some(&b"M30\r\n"[..]));
        assert_eq!(sender.acknowledge(ack), Ok(()));
        assert_eq!((sender.acknowledge(ack), sender.state()), (Err(UnexpectedAck), state));
    }
}

/// The sender counts busy acknowledgements for each packet separately.
#[test]
fn a_sender_counts_busy_results() {
    let line = [&[b'X'; NC_LINE_MAX][..], b"\r\n"].concat();
    let two = line.repeat(2);
    let mut sender = Sender::new(NcText::new(&two).unwrap());
    for _ in 0..2 {
        for busy in 0..3 {
            assert_eq!(sender.packet(), Some(&line[..]));
            assert_eq!(sender.busy_count(), busy);
            assert_eq!(sender.acknowledge(Ack::Busy), Ok(()));
        }
        assert_eq!(sender.packet(), Some(&line[..]));
        assert_eq!((sender.busy_count(), sender.acknowledge(Ack::Accepted)), (3, Ok(())));
    }
    assert_eq!((sender.busy_count(), sender.packet()), (0, None));
}

/// A random text: lines of many lengths with any line ends; the last line may lack its line end.
fn text() -> impl Strategy<Value = Vec<u8>> {
    let len = prop_oneof![8 => 0..60_usize, 1 => 60..=990_usize, 1 => 980..=990_usize];
    let line =
        (len, select(b"XN1 \t$(;\x0B\x7F".to_vec()), 0..8_u8).prop_map(|(len, fill, end)| {
            let end = match end {
                0 => "\r",
                1..4 => "\r\n",
                _ => "\n",
            };
            [vec![fill; len], end.into()].concat()
        });
    (vec(line, 0..60), prop::option::of(0..3_usize), any::<bool>()).prop_map(
        |(mut lines, same, open)| {
            if let Some(same) = same {
                for line in &mut lines {
                    line.retain(|&byte| byte != b'\r' && byte != b'\n');
                    line.extend(ENDS[same].bytes());
                }
            }
            let mut text = lines.concat();
            while open && text.last().is_some_and(|&byte| byte == b'\r' || byte == b'\n') {
                text.pop();
            }
            text
        },
    )
}

/// The last line of a text may lack its line end. If it fits into a packet together with CR LF and
/// the lines before it, this packet cannot be borrowed from the text. Otherwise, the packet only
/// consists of the lines before it, and can be borrowed.
#[test]
fn open_lines_are_borrowed_up_to() {
    for (last, borrowed) in [(987, None), (988, Some(&b"X\r\n"[..]))] {
        let text = [&b"X\r\n"[..], &b"Y".repeat(last)].concat();
        assert_eq!(NcText::new(&text).unwrap().packets().next_borrowed(), borrowed, "{last}");
    }
}

proptest! {
    #![proptest_config(kept::cases(1000, file!()))]

    #[test]
    fn packets_are_the_text_and_maximal(text in text()) {
        check_packets(&text);
    }

    /// An invalid byte inserted into a valid text is reported at its position or, after the maximum
    /// length of a line, as a line that is too long.
    #[test]
    fn a_fault_is_reported_at_its_position(text in text(), at in any::<prop::sample::Index>(), byte in select(vec![0, 0x80, 0xFF, 0xE4])) {
        let at = at.index(text.len() + 1);
        let line = reference_lines(&text[..at]).len() + usize::from(at == 0 || b"\r\n".contains(&text[at - 1]));
        let column = at - text[..at].iter().rposition(|byte| b"\r\n".contains(byte)).map_or(0, |end| end + 1) + 1;
        // A byte inserted between CR and LF is a separate line. A byte inserted after 990
        // characters of a line makes the line too long.
        let bad = [&text[..at], &[byte], &text[at..]].concat();
        prop_assert!(check_text(&bad, TextMutation::NONE).is_err());
        let error = NcText::new(&bad).unwrap_err();
        let kind = if byte == 0 { LineErrorKind::Nul } else { LineErrorKind::NotAscii { byte } };
        if column <= NC_LINE_MAX {
            prop_assert_eq!((error.line() as usize, error.column() as usize, error.kind()), (line, column, kind));
        } else {
            prop_assert_eq!((error.line() as usize, error.column()), (line, 991));
        }
    }

    /// For random acknowledgements, the sender returns the packets of the text in order, the same
    /// packet again while it is not accepted, and none after a rejection; its progress, state and
    /// counts are the expected ones.
    #[test]
    fn a_sender_loses_and_repeats_nothing(text in text(), acks in vec(0..20_u8, 0..200), twice in any::<bool>()) {
        let mut sender = CheckedSender::new(&text, SenderMutation::NONE);
        for ack in acks {
            sender.acknowledge(Ack::Accepted);
            for _ in 0..=u8::from(twice) {
                sender.packet();
            }
            sender.acknowledge(match ack {
                0 => Ack::Rejected,
                1..8 => Ack::Busy,
                _ => Ack::Accepted,
            });
        }
        sender.check_left();
    }

    /// The first line that does not end in CR LF is reported.
    #[test]
    fn line_ends_are_checked(text in text(), wire in any::<bool>()) {
        let text = if wire { reference_wire(&text) } else { text };
        let found = check_line_ends(&text).err().map(fault_of);
        prop_assert_eq!(found, missing_end(&text));
        prop_assert!(!wire || found.is_none());
    }
}
