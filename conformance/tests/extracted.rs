//! Vectors that `check` extracts from captured traffic match the schema of the golden vectors, which is
//! in the folder next to the folder of this package.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

const SCHEMA: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../spec-vectors/schema/vectors.schema.json");

/// Calls whose traffic is captured, each with the minimum number of streams that the traffic contains.
const CALLS: [(&[&str], usize); 3] = [
    (&["browse", "--content"], 10),
    (&["browse", "--variables"], 9),
    (&["set", "V.E.Testvar[1]", "7"], 3),
];

/// A temporary folder that is removed when this value is dropped.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        let _gone = fs::remove_dir_all(&self.0);
    }
}

fn ads_cnc(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ads-cnc")).current_dir(folder).args(args).output().unwrap()
}

#[test]
fn extracted_vectors_match_the_schema() {
    let folder =
        Folder(std::env::temp_dir().join(format!("ads-cnc-extracted-{}", std::process::id())));
    fs::create_dir_all(&folder.0).unwrap();
    let schema: Value = serde_json::from_str(&fs::read_to_string(SCHEMA).unwrap()).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    for (place, (call, least)) in CALLS.into_iter().enumerate() {
        let (file, vectors) = (format!("{place}.pcapng"), format!("{place}.json"));
        let said = ads_cnc(&folder.0, &[call, &["--capture", &file]].concat());
        assert_eq!(said.status.code(), Some(0), "{call:?}: {said:?}");
        ads_cnc(&folder.0, &["check", "--any-port", &file, "--extract-vectors", &vectors]);
        let document = fs::read_to_string(folder.0.join(vectors)).unwrap();
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
