//! The allocations of owned types.

use std::collections::BTreeMap;
use std::hint::black_box;

use ads_cnc::layout::{FieldSpec, Size, Stream};

use crate::common::Subject;
use crate::counting::{allocated, allocations, measure};
use crate::inputs::{LONG, each_input};
use crate::{excess, start};

#[test]
fn memory_of_decoding_is_limited_by_the_input() {
    // For each stream: the number of rejected inputs, the number of accepted inputs, and the
    // maximum encoded length of their values.
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
        let (rejected, accepted, longest) = seen.entry(stream).or_default();
        match decode(bytes) {
            Ok(len) => (*accepted, *longest) = (*accepted + 1, len.max(*longest)),
            Err(_) => *rejected += 1,
        }
    });
    for stream in Stream::all() {
        let (rejected, accepted, longest) = seen[&stream];
        let long = (stream.layout().max as usize).min(LONG) / 2;
        assert!(rejected > 0 && accepted > 0 && longest >= long, "{stream}: {:?}", seen[&stream]);
    }
}

/// The number of allocations and of allocated bytes, first of decoding and then of copying the
/// value. `twice` calls its second argument after each of the two.
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

/// Decoding allocates as often and as many bytes as copying the value: no buffer grows or is
/// discarded. Rejected bytes allocate nothing.
#[test]
fn decoding_allocates_as_much_as_a_copy() {
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

/// A text without bytes after its NUL, also one from UTF-8, is allocated once, without spare
/// capacity.
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

/// `decoding_allocates_as_much_as_a_copy` can fail: decoders whose buffers grow or are discarded
/// allocate more than a copy.
#[test]
fn growth_and_waste_are_detected() {
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

#[test]
fn encoding_an_owned_value_allocates_nothing() {
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

/// The allocations of decoding are counted; the tests above rely on this.
#[test]
fn allocations_of_decoding_are_detected() {
    let owned = Subject::of(Stream::VariableHandleRead).owned;
    let request = [1, 0, 0, 2, 1, 0, 0, 0, 4, 0, 0, 0];
    let decoding = allocations(|| {
        black_box((owned.len)(&request).unwrap());
    });
    assert!(decoding > 0);
}

/// A length with few bytes after it does not make `BinRead` allocate memory for the length.
#[cfg(feature = "binrw")]
#[test]
fn memory_of_binread_is_limited_by_the_bytes() {
    use ads_cnc::ads::WriteRequest;
    use ads_cnc::binrw::{BinRead as _, io::Cursor};

    for length in [0x40_0000_u32, u32::MAX] {
        let bytes = [&[0; 8], &length.to_le_bytes()[..], &[1, 2, 3]].concat();
        let (held, _) = measure(|| {
            assert!(black_box(WriteRequest::read(&mut Cursor::new(&bytes))).is_err());
        });
        assert!(held < 8192, "{length}: {held}");
    }
}

/// The memory of a checker is limited for an endless stream of lines: with short labels, with long
/// labels, and if each label is in a program of its own.
#[test]
fn memory_of_a_checker_is_limited() {
    use ads_cnc::streaming::Checker;

    // The checker keeps two generations of labels. A label needs a part of a node of a B-tree, a
    // key and its characters.
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
        // If each label is in a program of its own, the labels of earlier programs are discarded.
        let forgets = each.starts_with('%');
        assert_eq!(forgets, endless < 4096, "{endless}");
        assert_ne!(forgets, long > Checker::CHARACTERS_KNOWN / 2, "{long}");
    }
}

/// The diagnostics of a text need memory only for the different labels of the text.
#[test]
fn memory_of_diagnostics_is_limited_by_the_labels() {
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
    // A repeated label needs no further memory.
    let again = peak(&|n| format!("N{}:\n", n % 65));
    assert!(again < 65 * 160, "{again}");
}
