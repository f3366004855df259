//! Measures the time of every case with criterion, for interactive use. `src/bin/ratios.rs`
//! measures the ratios for the README.

use ads_cnc_benches::all;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn time(criterion: &mut Criterion) {
    for case in all() {
        let mut work = (case.prepare)();
        let mut group = criterion.benchmark_group(case.subject);
        group.throughput(Throughput::Elements(work.units));
        group.bench_function(case.implementation, |bencher| bencher.iter(|| (work.run)()));
        group.finish();
    }
}

criterion_group!(benches, time);
criterion_main!(benches);
