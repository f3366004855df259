//! The time at which a packet was captured.

use std::fmt;
use std::time::Duration;

/// A time since 1970 in UTC.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Time(Duration);

impl Time {
    /// Creates a time from seconds and a fraction in units of 1/`resolution` seconds.
    pub(super) fn new(seconds: u64, units: u32, resolution: u64) -> Self {
        Self(Duration::from_secs(seconds).saturating_add(part(units.into(), resolution)))
    }

    /// Creates a time from units since 1970, plus an offset in seconds.
    pub(super) fn of_units(units: u64, resolution: u64, offset: i64) -> Self {
        let seconds = units.checked_div(resolution).unwrap_or(0);
        let rest = units.checked_rem(resolution).unwrap_or(0);
        let seconds = seconds.saturating_add_signed(offset);
        Self(Duration::from_secs(seconds).saturating_add(part(rest, resolution)))
    }

    pub(super) const fn since_1970(self) -> Duration {
        self.0
    }

    /// The time since `earlier`; zero if `earlier` is later.
    pub(super) const fn since(self, earlier: Self) -> Duration {
        self.0.saturating_sub(earlier.0)
    }
}

fn part(units: u64, resolution: u64) -> Duration {
    let nanos = u128::from(units).saturating_mul(1_000_000_000).checked_div(resolution.into());
    Duration::from_nanos(nanos.and_then(|nanos| u64::try_from(nanos).ok()).unwrap_or(0))
}

/// The time of day in UTC, with microseconds.
impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = |unit: u64, count: u64| {
            self.0.as_secs().checked_div(unit).and_then(|all| all.checked_rem(count)).unwrap_or(0)
        };
        let (hours, minutes, seconds) = (of(3600, 24), of(60, 60), of(1, 60));
        write!(f, "{hours:02}:{minutes:02}:{seconds:02}.{:06} UTC", self.0.subsec_micros())
    }
}
