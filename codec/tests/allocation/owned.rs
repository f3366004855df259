//! What owned readings allocate.

use std::collections::BTreeMap;
use std::hint::black_box;

use ads_cnc::layout::{FieldSpec, Size, Stream};

use crate::common::Subject;
use crate::counting::{allocated, allocations, measure};
use crate::inputs::{LONG, each_input};
use crate::{excess, start};

/// No count or length in the bytes makes an owned reading hold more than the bytes warrant.
#[test]
fn owned_readings_hold_no_more_than_the_input_warrants() {
    // Refused and accepted inputs, and the longest accepted one.
    let mut seen: BTreeMap<Stream, (u32, u32, usize)> = BTreeMap::new();
    each_input(|stream, bytes| {
        let decode = Subject::of(stream).owned.len;
        assert_eq!(
            excess(decode, bytes),
            0,
            "{stream}: {} bytes: {:x?}",
            bytes.len(),
            start(bytes)
        );
        let (refused, accepted, longest) = seen.entry(stream).or_default();
        match decode(bytes) {
            Ok(len) => (*accepted, *longest) = (*accepted + 1, len.max(*longest)),
            Err(_) => *refused += 1,
        }
    });
    for stream in Stream::all() {
        let (refused, accepted, longest) = seen[&stream];
        let long = (stream.layout().max as usize).min(LONG) / 2;
        assert!(refused > 0 && accepted > 0 && longest >= long, "{stream}: {:?}", seen[&stream]);
    }
}

/// What a reading allocated and what a copy of it did, each as how often and how many bytes.
fn decoded_and_copied(twice: fn(&[u8], &mut dyn FnMut()), bytes: &[u8]) -> [(usize, usize); 2] {
    let mut marks = [allocated(); 3];
    let mut next = 1;
    twice(bytes, &mut || {
        marks[next] = allocated();
        next += 1;
    });
    assert_eq!(next, 3);
    [0, 1].map(|at| (marks[at + 1].0 - marks[at].0, marks[at + 1].1 - marks[at].1))
}

/// An owned reading allocates what it returns and no more: as often as a copy of it, and as many
/// bytes. Nothing grows, nothing is thrown away, and what is refused has allocated nothing.
#[test]
fn owned_readings_allocate_what_they_return() {
    let mut most: BTreeMap<Stream, (usize, usize)> = BTreeMap::new();
    each_input(|stream, bytes| {
        let [decoded, copied] = decoded_and_copied(Subject::of(stream).twice, bytes);
        assert_eq!(decoded, copied, "{stream}: {} bytes: {:x?}", bytes.len(), start(bytes));
        let most = most.entry(stream).or_default();
        *most = (*most).max(decoded);
    });
    let numbers = |row: &FieldSpec| {
        use Size::{Fixed, NonZero, OptionalFixed, Padded, Uns8To32};
        matches!(row.size, Fixed(_) | OptionalFixed(_) | NonZero | Uns8To32 | Padded(_))
    };
    for stream in Stream::all() {
        let layout = stream.layout();
        let holds = layout.repeats || !layout.fields.iter().all(numbers);
        assert_eq!(most[&stream].0 > 0, holds, "{stream}");
    }
}

/// Texts are allocated once, with no room to spare, also those that are made of UTF-8.
#[test]
fn owned_texts_are_allocated_once() {
    use ads_cnc::{CncStr, CncString, Text, TextRef};

    for text in [CncStr::new("V.E.Größe_und_Länge"), CncStr::from_bytes(b"V.E.L\xE4nge")] {
        let text = text.unwrap();
        let of = |make: &dyn Fn()| {
            let before = allocated();
            make();
            let after = allocated();
            (after.0 - before.0, after.1 - before.1)
        };
        assert_eq!(of(&|| drop(black_box(CncString::from(text)))), (1, text.len()));
        assert_eq!(of(&|| drop(black_box(Text::from(TextRef::from(text))))), (1, text.len()));
    }
}

/// A reading that grows, or that reads into what it throws away, is told from its copy.
#[test]
fn growth_and_waste_are_found_out() {
    let grown: fn(&[u8], &mut dyn FnMut()) = |bytes, call| {
        let mut text = Vec::new();
        bytes.iter().for_each(|&byte| text.push(black_box(byte)));
        call();
        drop(black_box(text.clone()));
        call();
    };
    let wasted: fn(&[u8], &mut dyn FnMut()) = |bytes, call| {
        let text = black_box(bytes.to_vec()).to_vec();
        call();
        drop(black_box(text.clone()));
        call();
    };
    let [decoded, copied] = decoded_and_copied(grown, &[1; 20]);
    assert!(decoded.1 > copied.1, "{decoded:?} {copied:?}");
    let [decoded, copied] = decoded_and_copied(wasted, &[1; 20]);
    assert_eq!((decoded, copied), ((2, 40), (1, 20)));
}

/// To encode an owned reading allocates nothing on top of what it took to decode it.
#[test]
fn encoders_of_owned_readings_allocate_nothing() {
    let mut buf = vec![0; 0x41_0000];
    each_input(|stream, bytes| {
        let owned = Subject::of(stream).owned;
        let decoding = allocations(|| {
            let _ = black_box((owned.len)(bytes));
        });
        let both = allocations(|| {
            let _ = black_box((owned.encode)(bytes, &mut buf));
        });
        assert_eq!(both, decoding, "{stream}: {:x?}", start(bytes));
    });
}

/// The same count finds an owned reading out.
#[test]
fn owned_readings_are_seen_to_allocate() {
    let owned = Subject::of(Stream::VariableHandleRead).owned;
    let request = [1, 0, 0, 2, 1, 0, 0, 0, 4, 0, 0, 0];
    let decoding = allocations(|| {
        black_box((owned.len)(&request).unwrap());
    });
    assert!(decoding > 0);
}

/// A checker remembers no more of a program without end than of a long one, however long its labels
/// are and whether or not it begins anew.
#[test]
fn checkers_hold_no_more_than_the_labels_that_they_know() {
    use ads_cnc::streaming::Checker;

    // Two generations; a label is a node's share, a key of its own and its characters.
    const MOST: usize = 2 * (Checker::LABELS_KNOWN * 160 + 2 * Checker::CHARACTERS_KNOWN);
    for (length, each) in [(1, "[{}]"), (990, "[{}]"), (1, "%\n[{}]")] {
        let held = |labels: usize| {
            let lines = |n| each.replace("{}", &format!("{n:A>length$}")) + "\r\n";
            measure(|| {
                let mut checker = Checker::new();
                (0..labels).for_each(|n| drop(black_box(&mut checker).check(lines(n).as_bytes())));
            })
            .0
        };
        let known = Checker::LABELS_KNOWN.min(Checker::CHARACTERS_KNOWN / length);
        let (long, endless) = (held(3 * known), held(6 * known));
        assert!(endless <= MOST, "{endless} of {MOST}");
        assert!(endless <= long + long / 4, "{length}: {long}, then {endless}");
        // Labels of another program are forgotten at once.
        let forgets = each.starts_with('%');
        assert_eq!(forgets, endless < 4096, "{endless}");
        assert_ne!(forgets, long > Checker::CHARACTERS_KNOWN / 2, "{long}");
    }
}

/// The check of a whole text holds its labels and nothing that grows with anything else.
#[test]
fn findings_hold_no_more_than_the_labels_of_the_text() {
    use ads_cnc::streaming::NcText;

    let peak = |lines: &dyn Fn(usize) -> String| {
        let text: String = (0..20_000).map(lines).collect();
        let text = NcText::new(text.as_bytes()).unwrap();
        measure(|| assert!(black_box(text.diagnostics()).count() < 20_001)).0
    };
    assert!(peak(&|n| format!("$GOTO N{n}\n$DO\n(N{n})\n")) < 1024);
    let names = 20_000 * "N10000".len();
    let labels = peak(&|n| format!("N{}:\n", 10_000 + n));
    assert!((names..20_000 * 88).contains(&labels), "{labels}");
    // The same labels again cost nothing.
    let again = peak(&|n| format!("N{}:\n", n % 65));
    assert!(again < 65 * 160, "{again}");
}
