//! Replays the corpora and prints for each target how many inputs there are and what they led to,
//! as one number. Two builds of the codec print the same for the targets that both have.
//!
//! With a number, so many inputs of each folder are replayed, from one end of it to the other.

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
