//! Replays the corpora and prints for each target how many inputs there are and what they led to,
//! as one number. Two builds of the codec print the same for the targets that both have.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use ads_cnc_fuzz::{Defect, Folder};
use ads_cnc_fuzz::{TARGETS, corpus, regressions};

fn main() {
    for target in TARGETS {
        let (mut digest, mut inputs) = (DefaultHasher::new(), 0);
        for folder in [corpus(target.name), regressions(target.name)] {
            let folder = Folder::new(&folder);
            for (path, bytes) in folder.files() {
                let outcome = target.run(&bytes, Defect::NONE);
                path.file_name().hash(&mut digest);
                (outcome.accepted, outcome.digest).hash(&mut digest);
                inputs += 1;
            }
        }
        println!("{:<24} {inputs:>6} inputs  {:016x}", target.name, digest.finish());
    }
}
