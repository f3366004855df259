//! Tests that dependencies.md names every crate on which the tools depend, and no other as used;
//! and that only the crates named in codec/ASSURANCE.md bring unsafe code into the codec.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

use serde_json::Value;

use super::root;

/// Executes cargo with these arguments, and returns its output.
fn cargo(args: &[&str]) -> String {
    let cargo = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()))
        .args(args)
        .args(["--locked", "--offline"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(cargo.status.success(), "{}", String::from_utf8_lossy(&cargo.stderr));
    String::from_utf8(cargo.stdout).unwrap()
}

#[test]
fn every_crate_has_a_reason() {
    let normal = ["-e", "normal,build", "--prefix", "none"];
    let tree = cargo(&[&["tree", "-p", "ads-cnc-conformance"], &normal[..]].concat());
    let named = |line: &str| line.split(' ').take(2).map(str::to_owned).collect::<Vec<_>>();
    let versions: BTreeSet<Vec<String>> =
        tree.lines().map(named).filter(|words| !words[0].starts_with("ads-cnc")).collect();
    let crates: BTreeSet<&str> = versions.iter().map(|words| words[0].as_str()).collect();

    let document = fs::read_to_string(root().join("conformance/doc/dependencies.md")).unwrap();
    let (used, _) = document.split_once("## Considered and not used").unwrap();
    let quoted = used.split('`').skip(1).step_by(2);
    // Options and this project's own crates are quoted, too, but are not dependencies.
    let quoted = quoted.filter(|word| !word.starts_with('-') && !word.starts_with("ads-cnc"));
    assert_eq!(quoted.collect::<BTreeSet<_>>(), crates);
    let counted = format!("built from {} crates", versions.len());
    assert!(document.contains(&counted), "{counted}");
}

/// Whether a Rust file in the folder or below has a line of code with the word `unsafe`.
fn has_unsafe_code(folder: &Path) -> bool {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).any(|path| {
        let is_code = |line: &str| !line.trim_start().starts_with("//");
        match path.extension().is_some_and(|extension| extension == "rs") {
            true => {
                let text = fs::read_to_string(path).unwrap();
                text.lines().any(|line| is_code(line) && line.contains("unsafe "))
            }
            false => path.is_dir() && has_unsafe_code(&path),
        }
    })
}

/// Without a feature, with `binrw` and with `serde`, exactly the listed crates have unsafe code;
/// the codec itself is not among them.
#[test]
fn unsafe_code_is_only_in_the_listed_crates() {
    let host = format!("{}-unknown-linux-gnu", env::consts::ARCH);
    let metadata = cargo(&["metadata", "--format-version", "1", "--filter-platform", &host]);
    let metadata: Value = serde_json::from_str(&metadata).unwrap();
    for (features, listed) in [
        ("", "zerocopy"),
        ("binrw", "array-init bytemuck zerocopy"),
        ("serde", "serde serde_core zerocopy"),
    ] {
        let edges = ["-e", "normal,no-proc-macro", "--prefix", "none", "--no-default-features"];
        let tree =
            cargo(&[&["tree", "-p", "ads-cnc", "--features", features], &edges[..]].concat());
        let has_unsafe_code = |package: &&Value| {
            let [name, version] = ["name", "version"].map(|key| package[key].as_str().unwrap());
            let manifest = Path::new(package["manifest_path"].as_str().unwrap());
            tree.lines().any(|line| line.split(' ').take(2).eq([name, &format!("v{version}")]))
                && has_unsafe_code(&manifest.with_file_name("src"))
        };
        let packages = metadata["packages"].as_array().unwrap().iter().filter(has_unsafe_code);
        let found: BTreeSet<&str> = packages.map(|one| one["name"].as_str().unwrap()).collect();
        assert_eq!(found, listed.split(' ').collect(), "{features}");
    }
}
