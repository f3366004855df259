//! Counts the instructions of the cases with callgrind: those of `gate`, and in a separate group
//! all others. Unlike times, the counts do not depend on the load of the machine.

use ads_cnc_benches::{Case, Work, gate, others};
use gungraun::{LibraryBenchmarkConfig, library_benchmark, library_benchmark_group, main};

/// Makes the C library copy blocks of any length like short blocks. By default, it copies a long
/// block with one processor instruction, which callgrind counts byte by byte, and a block larger
/// than the caches with a third method.
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
    // Run once before counting, so that one-time work such as resolving symbols is not counted.
    (work.run)();
    work
}

// The functions return the work, so that dropping it is not counted.
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
