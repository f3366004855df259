//! Initial inputs of the targets for NC text, CP1252 text and names of variables.

use ads_cnc::layout::Stream;
use ads_cnc_vectors::{Pieces, SequenceInput, sequences, vectors};

use super::{LONGEST, Seed};
use crate::common;

/// The NC texts of at most 4096 bytes of the accepted and rejected sequences.
pub(super) fn programs() -> Vec<Seed> {
    let of = |given: &SequenceInput| match given {
        SequenceInput::NcText(text) => Some(text.bytes()),
        SequenceInput::NcCheck(packets) => Some(packets.iter().flat_map(Pieces::bytes).collect()),
        _ => None,
    };
    short(|given| of(given))
}

/// The packets of the sequences that check an NC text packet by packet, with a byte 0xFF between two
/// packets; and a text with many findings.
pub(super) fn lots() -> Vec<Seed> {
    let mut seeds = short(|given| match given {
        SequenceInput::NcCheck(packets) => {
            Some(packets.iter().map(Pieces::bytes).collect::<Vec<_>>().join(&0xFF))
        }
        _ => None,
    });
    let words = "N1:\n$GOTO N1\n\u{7F}N2: X1\n$FOR\n[A] M30 $WHILE\n\u{7F}X1\n%next\n\
                 #COMMENT BEGIN\n\u{7F}M2 $GOTO N2\n#COMMENT END\n$GOTO [A]\n$DO\n";
    let bytes = words.bytes().map(|byte| if byte == 0x7F { 0xFF } else { byte }).collect();
    seeds.push(("all-findings".into(), bytes));
    seeds
}

fn short(of: impl Fn(&SequenceInput) -> Option<Vec<u8>>) -> Vec<Seed> {
    let seed = |case: &ads_cnc_vectors::Sequence| Some((case.id.clone(), of(&case.given)?));
    sequences().iter().filter_map(seed).filter(|(_, bytes)| bytes.len() <= 2 * LONGEST).collect()
}

/// Texts in CP1252 (after an even byte) and in UTF-8 (after an odd byte).
pub(super) fn texts() -> Vec<Seed> {
    let of = |(name, text): (&str, &str)| (name.to_string(), [&[1], text.as_bytes()].concat());
    let utf8 = [
        ("ascii", "V.E.Testvar"),
        ("latin", "Länge, Größe"),
        ("beyond-latin", "€ Ÿ – — œ"),
        ("controls", "\u{81}\u{8D}\u{8F}\u{90}\u{9D}\u{7F}"),
        ("greek", "V.E.Ω"),
        ("latin-control", "V.E.abc\u{80}"),
        ("with-nul", "V.E.a\0b"),
    ];
    let all: Vec<u8> = [0].into_iter().chain(1..=0xFF).collect();
    let wire = [
        ("wire", b"\0V.E.L\xE4nge".to_vec()),
        ("wire-all", [&[0], &all[1..]].concat()),
        ("wire-nul", b"\0V.E\0\0".to_vec()),
        ("no-utf8", b"\x01\0\x20\xAC\0\xD8\0\0\x03\xA9\0\0\xE4".to_vec()),
    ];
    utf8.into_iter().map(of).chain(wire.map(|(name, bytes)| (name.to_string(), bytes))).collect()
}

/// Names of the vectors and samples, and malformed names.
pub(super) fn names() -> Vec<Seed> {
    let of_samples = common::each_sample()
        .filter(|(stream, _)| *stream == Stream::VariableName)
        .map(|(_, sample)| (sample.slug.to_string(), sample.bytes()));
    let of_vectors = vectors()
        .iter()
        .filter(|vector| vector.stream == Stream::VariableName.layout().name)
        .map(|vector| (format!("vector-{}", vector.id), vector.bytes()));
    let more = [
        ("kinds", "V.CYC.a[258]"),
        ("many-parts", "V.E.trajectory[300][4].vector[0].x.y[1]"),
        ("on-axis", "V.A.LIST[2]"),
        ("on-channel", "V.A.S[1].LIST.X[2][3]"),
        ("zeros", "V.E.a[007].b"),
        ("largest-index", "V.E.a[4294967294]"),
        ("index-too-large", "V.E.struct.array[4294967295]"),
        ("prose", "V.G.array[0 .. 9]"),
        ("open-bracket", "V.E.trajectory.vector[3"),
        ("empty-part", "V.E.trajectory..x"),
        ("no-kind", "ACT_POS"),
        ("bracket-in-part", "V.E.struct1.a]"),
    ];
    let more = more.map(|(name, text)| (name.to_string(), text.as_bytes().to_vec()));
    let longest = |len| (format!("letters-{len}"), [&b"V.E."[..], &b"\xE4".repeat(len)].concat());
    of_samples.chain(of_vectors).chain(more).chain([251, 252].map(longest)).collect()
}
