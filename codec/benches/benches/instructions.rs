//! Instructions of every case, counted by callgrind: the same on every run.

use ads_cnc_benches::{Case, Work, gate, others};
use gungraun::{LibraryBenchmarkConfig, library_benchmark, library_benchmark_group, main};

/// callgrind counts large copies, which are one instruction of the processor, byte by byte; copies
/// larger than the caches use yet another method. This makes the C library copy all of them like small
/// ones.
fn config() -> LibraryBenchmarkConfig {
    let thresholds = ["rep_movsb", "rep_stosb", "non_temporal"]
        .map(|it| format!("glibc.cpu.x86_{it}_threshold=0x7fffffff"));
    let mut config = LibraryBenchmarkConfig::default();
    config.env("GLIBC_TUNABLES", thresholds.join(":"));
    config
}

fn prepare_gated(at: usize) -> Work {
    prepare(gate().nth(at).expect("a case"))
}

fn prepare_other(at: usize) -> Work {
    prepare(others().nth(at).expect("a case"))
}

fn prepare(case: Case) -> Work {
    let mut work = (case.prepare)();
    // One-time work, such as resolving symbols, is finished at this point.
    (work.run)();
    work
}

// Return the work, so that dropping it is not counted.
#[library_benchmark(config = config())]
#[benches::case(iter = 0..gate().count(), setup = prepare_gated)]
fn gated(mut work: Work) -> Work {
    (work.run)();
    work
}

#[library_benchmark(config = config())]
#[benches::case(iter = 0..others().count(), setup = prepare_other)]
fn other(mut work: Work) -> Work {
    (work.run)();
    work
}

library_benchmark_group!(name = gate_group; benchmarks = gated);
library_benchmark_group!(name = others_group; benchmarks = other);
main!(library_benchmark_groups = gate_group, others_group);
