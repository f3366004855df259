//! Replays the corpora and prints for each target how many inputs there are and what they led to,
//! as one number. Two builds of the codec print the same for the targets that both have. With a
//! number as its argument it takes so many inputs of each folder, from all over it.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use ads_cnc_fuzz::{Defect, Folder};
use ads_cnc_fuzz::{TARGETS, corpus, regressions};

fn main() {
    let most: Option<usize> = std::env::args().nth(1).map(|most| most.parse().expect("a number"));
    for target in TARGETS {
        let (mut digest, mut inputs) = (DefaultHasher::new(), 0);
        for folder in [corpus(target.name), regressions(target.name)] {
            let folder = Folder::new(&folder);
            let files = folder.files();
            let step = most.map_or(1, |most| files.len().div_ceil(most).max(1));
            for (path, bytes) in files.step_by(step) {
                let outcome = target.run(&bytes, Defect::NONE);
                path.file_name().hash(&mut digest);
                (outcome.accepted, outcome.digest).hash(&mut digest);
                inputs += 1;
            }
        }
        println!("{:<24} {inputs:>6} inputs  {:016x}", target.name, digest.finish());
    }
}
