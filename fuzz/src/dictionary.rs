//! Dictionaries: words that a fuzzer would not guess, in one file for each family.

use std::collections::BTreeSet;

use ads_cnc_vectors::vectors;

use crate::bodies::bytes::FAMILIES;
use crate::common;

/// Maximum length of a word in bytes. Longer words belong in the corpus.
const LONGEST: usize = 64;

/// The family and the text of every dictionary, in the common format of libFuzzer and AFL.
pub fn dictionaries() -> Vec<(&'static str, String)> {
    let families =
        FAMILIES.iter().map(|&(family, _)| family).chain(["operation", "service", "text"]);
    #[cfg(feature = "tools")]
    let families = families.chain(["tools", "cnc"]);
    families.map(|family| (family, to_text(&entries(family)))).collect()
}

fn entries(family: &str) -> BTreeSet<Vec<u8>> {
    let mut entries = BTreeSet::new();
    match family {
        #[cfg(feature = "tools")]
        "tools" => entries.extend(crate::seeds::tools::words()),
        "operation" | "cnc" => {
            for sample in common::CALLS {
                let call = &sample.call;
                for number in [call.index_group.get(), call.index_offset.get()] {
                    entries.insert(number.to_le_bytes().to_vec());
                }
                entries.insert(call.port.0.to_le_bytes().to_vec());
                entries.insert(call.data.to_vec());
            }
        }
        "text" => entries.extend(HIGH.chars().map(|character| character.to_string().into_bytes())),
        "service" => entries.extend(EVENTS.iter().map(|events| events.to_vec())),
        _ => {
            // The fields of the vectors, such as codes, texts and types.
            let streams =
                FAMILIES.iter().find(|(name, _)| *name == family).map_or(&[][..], |f| f.1);
            for vector in vectors() {
                if streams.iter().any(|stream| stream.layout().name == vector.stream) {
                    entries.extend(vector.segments.iter().map(|segment| segment.hex.to_vec()));
                }
            }
        }
    }
    let more: &[&[u8]] = match family {
        "streaming" => WORDS,
        "variable" => NAMES,
        _ => &[],
    };
    entries.extend(more.iter().map(|entry| entry.to_vec()));
    entries.retain(|entry| (2..=LONGEST).contains(&entry.len()));
    entries
}

/// Characters that take several bytes in UTF-8: from all parts of CP1252, and one that CP1252 lacks.
const HIGH: &str =
    "\u{81}\u{9D}\u{A0}\u{E4}\u{FF}\u{152}\u{178}\u{192}\u{2C6}\u{2013}\u{20AC}\u{2122}\u{3A9}";

/// Parts of inputs for the targets of the family `service`: a host finds a request, answers it and
/// writes; the program and the hosts make steps in turn.
const EVENTS: &[&[u8]] = &[
    b"\x00\x0A\x00\x03\x00\x1D",
    b"\x0E\x01\x0D",
    b"\x09\x09\x09\x0C",
    b"\x70\x72\x7A",
    b"\x06\x12\x05\x12",
    b"\x0D\x1A\x0E\x1A",
];

/// Words that the checks of an NC program detect.
const WORDS: &[&[u8]] = &[
    b"$FOR",
    b"$ENDFOR",
    b"$WHILE",
    b"$ENDWHILE",
    b"$DO",
    b"$ENDDO",
    b"$REPEAT",
    b"$UNTIL",
    b"$IF",
    b"$GOTO N1",
    b"$GOTO [A]",
    b"N1:",
    b"N01 :",
    b"[A]",
    b"#COMMENT BEGIN",
    b"#COMMENT END",
    b"M30",
    b"M2",
    b"M17",
    b"M29",
    b"\r\n",
    b"\n%",
    b"\xFF\n",
    b"\r\nN10 G01 X200 F1000\r\n",
];

/// Parts of the names of variables, valid and invalid.
const NAMES: &[&[u8]] = &[
    b"V.A.",
    b"V.E.",
    b"V.G.",
    b"V.CYC.",
    b"[0]",
    b"[258]",
    b"][",
    b"].",
    b"[4294967294]",
    b"[4294967295]",
    b"[007]",
    b"..",
];

fn to_text(entries: &BTreeSet<Vec<u8>>) -> String {
    entries.iter().map(|entry| format!("\"{}\"\n", escaped(entry))).collect()
}

fn escaped(entry: &[u8]) -> String {
    let escape = |&byte: &u8| match byte {
        b'"' | b'\\' => format!("\\{}", char::from(byte)),
        b' '..=b'~' => char::from(byte).to_string(),
        _ => format!("\\x{byte:02X}"),
    };
    entry.iter().map(escape).collect()
}
