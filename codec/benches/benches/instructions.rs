//! Instructions of every case, counted by callgrind: the same on every run.

use ads_cnc_benches::{Work, all};
use gungraun::{LibraryBenchmarkConfig, library_benchmark, library_benchmark_group, main};

fn prepare(at: usize) -> Work {
    let case = all().nth(at).expect("a case");
    let mut work = (case.prepare)();
    // What is done once only, such as resolving a symbol, is done by now.
    (work.run)();
    work
}

/// Large copies that are one instruction of the processor are counted byte by byte; the C library
/// is told to do them as it does smaller ones.
fn config() -> LibraryBenchmarkConfig {
    let tunable =
        "glibc.cpu.x86_rep_movsb_threshold=0x7fffffff:glibc.cpu.x86_rep_stosb_threshold=0x7fffffff";
    let mut config = LibraryBenchmarkConfig::default();
    config.env("GLIBC_TUNABLES", tunable);
    config
}

// The work is given back so that tidying up is not counted.
#[library_benchmark(config = config())]
#[benches::case(iter = 0..all().len(), setup = prepare)]
fn count(mut work: Work) -> Work {
    (work.run)();
    work
}

library_benchmark_group!(name = cases; benchmarks = count);
main!(library_benchmark_groups = cases);
