//! Dictionaries: what a fuzzer would not guess, a file for each family.

use std::collections::BTreeSet;

use ads_cnc_vectors::vectors;

use crate::bodies::bytes::FAMILIES;
use crate::common;

/// Longer entries are what a corpus is for.
const LONGEST: usize = 64;

/// Family and content of every dictionary, in libFuzzer's and AFL's common format.
pub fn dictionaries() -> Vec<(&'static str, String)> {
    let families = FAMILIES.iter().map(|&(family, _)| family).chain(["operation"]);
    families.map(|family| (family, written(&entries(family)))).collect()
}

fn entries(family: &str) -> BTreeSet<Vec<u8>> {
    let mut entries = BTreeSet::new();
    match family {
        "operation" => {
            for sample in common::CALLS {
                let call = &sample.call;
                for number in [call.index_group.get(), call.index_offset.get()] {
                    entries.insert(number.to_le_bytes().to_vec());
                }
                entries.insert(call.port.0.to_le_bytes().to_vec());
                entries.insert(call.data.to_vec());
            }
        }
        _ => {
            // The fields of the vectors: codes, texts, types.
            let streams =
                FAMILIES.iter().find(|(name, _)| *name == family).map_or(&[][..], |f| f.1);
            for vector in vectors() {
                if streams.iter().any(|stream| stream.layout().name == vector.stream) {
                    entries.extend(vector.segments.iter().map(|segment| segment.hex.to_vec()));
                }
            }
        }
    }
    entries.retain(|entry| (2..=LONGEST).contains(&entry.len()));
    entries
}

fn written(entries: &BTreeSet<Vec<u8>>) -> String {
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
