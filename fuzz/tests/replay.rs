//! The corpora, on stable Rust and without a fuzzer.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use ads_cnc_fuzz::{TARGETS, replay, seeds};

fn corpus(target: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target)
}

/// Every input of every corpus keeps the laws of its target.
#[test]
fn corpora_keep_the_laws() {
    for (target, body) in TARGETS {
        let inputs = replay(&corpus(target), body);
        assert!(inputs >= seeds(target).len(), "{target}: {inputs} inputs");
    }
}

/// Every sample of the codec is an input of its corpus, under its own name.
#[test]
fn corpora_hold_the_seeds() {
    let write = std::env::var_os("ADS_CNC_WRITE_SEEDS").is_some();
    let mut stale = Vec::new();
    for (target, _) in TARGETS {
        let seeds = seeds(target);
        let names: HashSet<_> = seeds.iter().map(|(name, _)| name).collect();
        assert_eq!(names.len(), seeds.len(), "{target}: two seeds of one name");
        for (name, bytes) in &seeds {
            let path = corpus(target).join(name);
            if write {
                std::fs::create_dir_all(corpus(target)).unwrap();
                std::fs::write(path, bytes).unwrap();
            } else if std::fs::read(&path).ok().as_ref() != Some(bytes) {
                stale.push(path);
            }
        }
    }
    assert!(stale.is_empty(), "run with ADS_CNC_WRITE_SEEDS=1 to rewrite {stale:#?}");
}
