//! Medians and percentiles of the slices of time in which a server is measured, as rows of a table.

use std::fmt;

use crate::load::Slice;

/// The slices of one server, in the order of measurement.
pub(crate) struct Figures {
    name: String,
    rates: Vec<f64>,
    /// The median latency of each slice, in ns.
    medians: Vec<f64>,
    nanos: Vec<u32>,
    /// CPU time for each reply, in seconds.
    cpu: Option<f64>,
}

impl Figures {
    pub(crate) const HEAD: &str = "\
| clients × at a time | server | requests/s | `serve` to it | p50, `serve` to it | p50 | p90 | p99 | p99.9 | max | CPU |
|---|---|---|---|---|---|---|---|---|---|---|";

    /// `cpu` is the CPU time of the server in all slices together, in seconds.
    pub(crate) fn new(name: &str, mut slices: Vec<Slice>, cpu: Option<f64>) -> Self {
        let median = |slice: &mut Slice| {
            slice.nanos.sort_unstable();
            f64::from(ranked(&slice.nanos, 0.5))
        };
        let medians = slices.iter_mut().map(median).collect();
        let rates = slices.iter().map(|slice| slice.rate).collect();
        let mut nanos: Vec<u32> = slices.into_iter().flat_map(|slice| slice.nanos).collect();
        nanos.sort_unstable();
        let cpu = cpu.map(|cpu| cpu / nanos.len() as f64);
        Self { name: name.to_owned(), rates, medians, nanos, cpu }
    }

    /// A row of the table for this server. Each ratio is that of a slice of `other` to the slice of
    /// this server in the same round.
    pub(crate) fn row(&self, other: &Self) -> String {
        let rates = Spread::of(self.rates.clone());
        let ratio = |others: &[f64], own: &[f64]| match std::ptr::eq(self, other) {
            true => "1".to_owned(),
            false => Spread::of(others.iter().zip(own).map(|(a, b)| a / b).collect()).to_string(),
        };
        let of_rates = ratio(&other.rates, &self.rates);
        let of_medians = ratio(&other.medians, &self.medians);
        let [p50, p90, p99, p999, max] = [0.5, 0.9, 0.99, 0.999, 1.0]
            .map(|share| Time(f64::from(ranked(&self.nanos, share)) / 1e9));
        let cpu = self.cpu.map_or("?".to_owned(), |cpu| Time(cpu).to_string());
        format!(
            "| {} | {rates:.0} | {of_rates} | {of_medians} | {p50} | {p90} | {p99} | {p999} | {max} | {cpu} |",
            self.name
        )
    }
}

/// The percentile of the sorted numbers: the smallest number that `share` of the numbers (0 to 1)
/// does not exceed.
fn ranked(nanos: &[u32], share: f64) -> u32 {
    let rank = (nanos.len() as f64 * share).ceil() as usize;
    nanos[rank.clamp(1, nanos.len()) - 1]
}

/// A median with the minimum and maximum.
struct Spread {
    median: f64,
    least: f64,
    most: f64,
}

impl Spread {
    fn of(mut numbers: Vec<f64>) -> Self {
        numbers.sort_by(f64::total_cmp);
        let (middle, last) = (numbers.len() / 2, numbers.len() - 1);
        let median = match numbers.len() % 2 {
            0 => (numbers[middle - 1] + numbers[middle]) / 2.0,
            _ => numbers[middle],
        };
        Self { median, least: numbers[0], most: numbers[last] }
    }
}

impl fmt::Display for Spread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(2);
        let Self { median, least, most } = self;
        write!(f, "{median:.digits$} ({least:.digits$}–{most:.digits$})")
    }
}

/// A time in seconds, formatted in µs with three digits, or from 1 ms on in ms with two decimal
/// places.
struct Time(f64);

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let micros = self.0 * 1e6;
        match micros {
            ..10.0 => write!(f, "{micros:.2} µs"),
            ..100.0 => write!(f, "{micros:.1} µs"),
            ..1000.0 => write!(f, "{micros:.0} µs"),
            _ => write!(f, "{:.2} ms", micros / 1e3),
        }
    }
}
