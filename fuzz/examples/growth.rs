//! Runs a target with inputs of one length; `fuzz/growth` counts the instructions. Without arguments, lists
//! the targets.
//!
//! The inputs are the longest ones of the target's corpus and single bytes, repeated to this length.

use std::cmp::Reverse;
use std::hint::black_box;
use std::process::ExitCode;

use ads_cnc_fuzz::{Defect, Folder, TARGETS, corpus};

/// Number of inputs of the corpus that are repeated.
const INPUTS: usize = 4;

/// Bytes that are repeated. Some of them nest, separate or continue parts of the texts that targets
/// parse.
const BYTES: [u8; 8] = *b"\0\xFFA0[.\"\n";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let Some(name) = arguments.next() else {
        TARGETS.iter().for_each(|target| println!("{}", target.name));
        return ExitCode::SUCCESS;
    };
    let target = TARGETS.iter().find(|target| target.name == name);
    let size = arguments.next().and_then(|size| size.parse::<usize>().ok());
    let (Some(target), Some(size)) = (target, size) else {
        eprintln!("expected a target and a length in bytes, found `{name}` and {size:?}");
        return ExitCode::from(2);
    };
    let files = Folder::new(&corpus(target.name));
    let mut seeds: Vec<Vec<u8>> = files.files().map(|(_, bytes)| bytes).collect();
    seeds.retain(|bytes| !bytes.is_empty());
    seeds.sort_by_key(|bytes| Reverse(bytes.len()));
    seeds.truncate(INPUTS);
    seeds.extend(BYTES.map(|byte| vec![byte]));
    for seed in seeds {
        let mut input = seed.repeat(size.div_ceil(seed.len()));
        input.truncate(size);
        black_box(target.run(black_box(&input), Defect::NONE));
    }
    ExitCode::SUCCESS
}
