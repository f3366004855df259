//! Which assumptions of a vector its expectation stands on.

use ads_cnc_vectors::{ProvenanceKind, Vector};

/// Assumptions that set the scene, or without which nothing could be said of a stream at all. Whoever
/// does it otherwise is judged nonetheless; so are the widths of numbers in an address, which are a
/// must (ADR-9) though nobody documents them. All others are left to the testee: it may differ.
const SETTING: [&str; 45] = [
    "0x4C is reserved in the manuals",
    "0x703 for a wrong offset",
    "0x704 for an object that must not be written",
    "0x710 for an unknown name",
    "NetIds, the client's port and the invoke ID are made up",
    "TRUE is written as 1",
    "a STRING of 21 bytes",
    "a number takes the low 8 bits",
    "an instance takes the low 8 bits",
    "axis and element take 16 bits each",
    "both numbers are UNS32",
    "both numbers are UNS32, so both lengths are 8",
    "channel 1",
    "channel 1: the example prints no group",
    "descriptors of platform axes stand under 0x130200 + axis",
    "handles of the axis interface are used with 0x47",
    "handles of the axis interface are used with 0x49",
    "id and size",
    "one NUL is written behind the text",
    "the axis takes 16 bits",
    "the axis takes 16 bits, the element 12",
    "the content is made up: none is printed",
    "the element and its type",
    "the element takes 12 bits",
    "the group: only its parts are printed, the base without the bit for logical addressing",
    "the length to read",
    "the name ends with one NUL",
    "the name has its kind in front",
    "the number is an UNS32",
    "the number is an UNS32 and does not count element 0",
    "the number is an UNS32, so 4 bytes are read",
    "the port: that of SDA, for HLD and decoder alike",
    "the read length",
    "the result is 0",
    "the result of the access is 0",
    "the sizes, which the manuals do not print",
    "the states are UNS32, as in the C code",
    "the stream object can be addressed either way",
    "the texts are padded with NULs",
    "the two unassigned bytes are 0",
    "the type BOOL: printed for mc_active_single_block_r only",
    "the type REAL64 is not printed",
    "the type SGN32 is not printed",
    "the write itself succeeds",
    "which stride was used; the offset alone does not tell",
];

/// Whether what the vector expects stands on something that nobody documents.
pub(crate) fn rests_on_assumption(vector: &Vector) -> bool {
    vector.provenance.kind != ProvenanceKind::Manual
        && vector.assumed.iter().any(|one| !SETTING.contains(&one.as_str()))
}

#[cfg(test)]
mod tests {
    use ads_cnc_vectors::{vector, vectors};

    use super::*;

    #[test]
    fn every_assumption_named_here_is_one_of_the_vectors() {
        for setting in SETTING {
            let mut all = vectors().iter().flat_map(|vector| &vector.assumed);
            assert!(all.any(|assumed| assumed == setting), "{setting}");
        }
    }

    #[test]
    fn printed_bytes_are_judged_and_rulings_are_not() {
        let rests = |id: &str| rests_on_assumption(vector(id).unwrap());
        assert!(!rests("descriptor-printed") && !rests("element-name-printed"));
        assert!(!rests("address-query-no-bytes"));
        assert!(rests("element-text-256-and-nul") && rests("kind-padded-256"));
    }
}
