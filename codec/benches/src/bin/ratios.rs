//! Measures the time of each case with a limit of time and that of its reference alternately, so
//! that other load of the machine affects both. Prints subject, implementation, reference, and the
//! median, minimum and maximum of the ratios.

use std::time::{Duration, Instant};

use ads_cnc_benches::{Limit, Work, gate};

const PAIRS: usize = 41;
const TURN: Duration = Duration::from_millis(4);

fn main() {
    for case in gate() {
        for limit in case.limits {
            let Limit::Time(other, _) = *limit else { continue };
            let other = gate()
                .find(|it| (it.subject, it.implementation) == (case.subject, other))
                .unwrap_or_else(|| panic!("{}: no case {other}", case.subject));
            let [middle, least, most] = ratios((case.prepare)(), (other.prepare)());
            println!(
                "{}\t{}\t{}\t{middle}\t{least}\t{most}",
                case.subject, case.implementation, other.implementation
            );
        }
    }
}

fn ratios(mut one: Work, mut other: Work) -> [f64; 3] {
    let rounds = [rounds(&mut one), rounds(&mut other)];
    let mut ratios: Vec<f64> =
        (0..PAIRS).map(|_| time(&mut one, rounds[0]) / time(&mut other, rounds[1])).collect();
    ratios.sort_by(f64::total_cmp);
    [ratios[PAIRS / 2], ratios[0], ratios[PAIRS - 1]]
}

/// Determines the number of runs in a turn of 4 ms. This also warms up the caches.
fn rounds(work: &mut Work) -> u32 {
    let start = Instant::now();
    let mut rounds = 0_u32;
    while start.elapsed() < TURN * 4 {
        (work.run)();
        rounds += 1;
    }
    rounds.div_ceil(4)
}

/// Measures a turn of this number of runs; returns nanoseconds per unit.
fn time(work: &mut Work, rounds: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..rounds {
        (work.run)();
    }
    start.elapsed().as_nanos() as f64 / f64::from(rounds) / work.units as f64
}
