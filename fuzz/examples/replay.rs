//! Replays folders of inputs, each with a subfolder for each target, and prints the number of inputs.
//!
//! ```sh
//! cargo run -p ads-cnc-fuzz --example replay -- fuzz/corpus fuzz/regressions
//! ```

use std::panic::catch_unwind;
use std::path::PathBuf;
use std::process::ExitCode;

use ads_cnc_fuzz::{Defect, Folder, TARGETS};

fn main() -> ExitCode {
    let folders: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let (mut all, mut failed) = (0, 0);
    for target in TARGETS {
        let mut inputs = 0;
        for folder in &folders {
            for (path, bytes) in Folder::new(&folder.join(target.name)).files() {
                inputs += 1;
                if catch_unwind(|| target.run(&bytes, Defect::NONE)).is_err() {
                    failed += 1;
                    eprintln!("failed: {}", path.display());
                }
            }
        }
        println!("{:<24} {inputs:>6} inputs", target.name);
        all += inputs;
    }
    println!("{all} inputs in all, {failed} failed");
    // A run without inputs would prove nothing, so it fails.
    ExitCode::from(u8::from(all == 0 || failed > 0))
}
