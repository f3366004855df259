//! Replays the corpora and prints, for each target, the number of inputs and a digest of their
//! outcomes. Two builds of the codec print the same lines for the targets that both have.
//!
//! An argument limits the number of inputs of each folder. The replayed inputs are evenly distributed over
//! the folder.

use std::hash::{Hash as _, Hasher as _};

use ads_cnc_fuzz::{Defect, Digest, Folder, TARGETS, corpus, regressions};

fn main() {
    let most = std::env::args().nth(1).map(|most| most.parse().expect("a number of inputs"));
    for target in TARGETS {
        let (mut digest, mut inputs) = (Digest::default(), 0);
        for folder in [corpus(target.name), regressions(target.name)] {
            let folder = Folder::new(&folder).at_most(most.unwrap_or(usize::MAX));
            for (path, bytes) in folder.files() {
                let outcome = target.run(&bytes, Defect::NONE);
                path.file_name().map(|name| name.to_string_lossy()).hash(&mut digest);
                (outcome.accepted, outcome.digest).hash(&mut digest);
                inputs += 1;
            }
        }
        println!("{:<24} {inputs:>6} inputs  {:016x}", target.name, digest.finish());
    }
}
