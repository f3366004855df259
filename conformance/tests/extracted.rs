//! Vectors that `check` extracts from captured traffic match the schema of the golden vectors in
//! the folder `spec-vectors`, which is not a part of this package.

#[allow(dead_code, reason = "this test uses folders only")]
#[path = "common/file.rs"]
mod file;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

use file::TestFolder;

const SCHEMA: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../spec-vectors/schema/vectors.schema.json");

/// Calls whose traffic is captured, each with the minimum number of different streams among the
/// vectors that are extracted from the traffic.
const CALLS: [(&[&str], usize); 3] = [
    (&["browse", "--content"], 10),
    (&["browse", "--variables"], 9),
    (&["set", "V.E.Testvar[1]", "7"], 3),
];

fn ads_cnc(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ads-cnc")).current_dir(folder).args(args).output().unwrap()
}

#[test]
fn extracted_vectors_match_the_schema() {
    let folder = TestFolder::new();
    let schema: Value = serde_json::from_str(&fs::read_to_string(SCHEMA).unwrap()).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    for (place, (call, least)) in CALLS.into_iter().enumerate() {
        let (file, vectors) = (format!("{place}.pcapng"), format!("{place}.json"));
        let said = ads_cnc(folder.path(), &[call, &["--capture", &file]].concat());
        assert_eq!(said.status.code(), Some(0), "{call:?}: {said:?}");
        ads_cnc(folder.path(), &["check", "--any-port", &file, "--extract-vectors", &vectors]);
        let document = folder.read(&vectors);
        let document: Value = serde_json::from_str(&document).unwrap();
        let faults: Vec<String> =
            schema.iter_errors(&document).map(|fault| fault.to_string()).collect();
        assert_eq!(faults, [""; 0], "{call:?}");
        let mut streams: Vec<_> = document["vectors"]
            .as_array()
            .unwrap()
            .iter()
            .map(|vector| &vector["stream"])
            .collect();
        streams.sort_by_key(|stream| stream.as_str());
        streams.dedup();
        assert!(streams.len() >= least, "{call:?}: {streams:?}");
    }
}
