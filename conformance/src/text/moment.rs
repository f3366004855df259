//! Points in time. Only [`Moment::now`] reads a clock.

use std::fmt;
use std::sync::LazyLock;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use toml::value::{Date, Datetime, Offset, Time};

/// Seconds since 1970-01-01T00:00:00Z.
///
/// ```
/// use ads_cnc_conformance::text::Moment;
///
/// let moment = Moment::from_rfc3339("2026-03-01T00:30:00+01:00").unwrap();
/// assert_eq!(moment.to_string(), "2026-02-28T23:30:00Z");
/// assert!(moment > Moment::EPOCH && moment < Moment::from_rfc3339("2026-03-01T00:00:00Z").unwrap());
/// assert_eq!(Moment::from_rfc3339("2026-03-01T00:30:00"), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Moment(i64);

const DAY: i64 = 86_400;

impl Moment {
    /// The start of 1970.
    pub const EPOCH: Self = Self(0);

    /// The current time of the system clock, even if it is set back after the first call.
    pub fn now() -> Self {
        static START: LazyLock<(SystemTime, Instant)> =
            LazyLock::new(|| (SystemTime::now(), Instant::now()));
        let (start, monotonic) = *START;
        Self::of_clock(SystemTime::now(), start, monotonic.elapsed())
    }

    /// The time of `clock`, but not earlier than `start` plus the time `passed` since then: a clock
    /// that is set back must not make an expired permission valid again.
    fn of_clock(clock: SystemTime, start: SystemTime, passed: Duration) -> Self {
        let time = start.checked_add(passed).map_or(clock, |least| least.max(clock));
        // For a clock before 1970, the latest moment is returned, so that all permissions have
        // expired.
        let since = time.duration_since(UNIX_EPOCH);
        Self(since.map_or(i64::MAX, |time| i64::try_from(time.as_secs()).unwrap_or(i64::MAX)))
    }

    /// This moment plus a duration; fractions of a second are rounded up.
    #[must_use]
    pub fn after(self, time: Duration) -> Self {
        let seconds = time.as_secs().saturating_add(u64::from(time.subsec_nanos() > 0));
        Self(self.0.saturating_add(i64::try_from(seconds).unwrap_or(i64::MAX)))
    }

    /// Parses a date and time with an offset from UTC, as in RFC 3339.
    pub fn from_rfc3339(text: &str) -> Option<Self> {
        Self::from_datetime(text.parse().ok()?)
    }

    /// Seconds since 1970-01-01T00:00:00Z.
    pub(crate) const fn seconds(self) -> i64 {
        self.0
    }

    /// The start of a day in UTC.
    pub(crate) fn from_date(date: Date) -> Option<Self> {
        let Date { year, month, day } = date;
        days(year.into(), month.into(), day.into())?.checked_mul(DAY).map(Self)
    }

    /// Converts a date and time. Fractions of a second are dropped, so that a permission expires
    /// slightly earlier.
    pub(crate) fn from_datetime(datetime: Datetime) -> Option<Self> {
        let Date { year, month, day } = datetime.date?;
        let Time { hour, minute, second, .. } = datetime.time?;
        let offset = match datetime.offset? {
            Offset::Z => 0,
            Offset::Custom { minutes } => i64::from(minutes).checked_mul(60)?,
        };
        let seconds = i64::from(hour)
            .checked_mul(3600)?
            .checked_add(i64::from(minute).checked_mul(60)?)?
            .checked_add(i64::from(second.unwrap_or(0)))?;
        let days = days(year.into(), month.into(), day.into())?;
        days.checked_mul(DAY)?.checked_add(seconds)?.checked_sub(offset).map(Self)
    }
}

/// The moment in UTC.
impl fmt::Display for Moment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (days, seconds) = (self.0.div_euclid(DAY), self.0.rem_euclid(DAY));
        let Some((year, month, day)) = date(days) else { return write!(f, "{} s", self.0) };
        let part = |unit: i64, modulus: i64| seconds.div_euclid(unit).rem_euclid(modulus);
        let (hour, minute, second) = (part(3600, 24), part(60, 60), part(1, 60));
        write!(f, "{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
    }
}

/// Days since 1970-01-01 in the Gregorian calendar. The years start in March, so that the leap day
/// is the last day.
fn days(year: i64, month: i64, day: i64) -> Option<i64> {
    let year = if month <= 2 { year.checked_sub(1)? } else { year };
    let shifted = month.checked_add(9)?.rem_euclid(12);
    let of_year = shifted.checked_mul(153)?.checked_add(2)?.div_euclid(5);
    let leaps =
        year.div_euclid(4).checked_sub(year.div_euclid(100))?.checked_add(year.div_euclid(400))?;
    let before = year.checked_mul(365)?.checked_add(leaps)?.checked_add(of_year)?;
    // 719 468 days from 0000-03-01 to 1970-01-01.
    before.checked_add(day)?.checked_sub(1)?.checked_sub(719_468)
}

/// The year, month and day of a day, counted from 1970-01-01. The first estimate of the year is off
/// by at most 1.
fn date(day: i64) -> Option<(i64, i64, i64)> {
    let mut year = day.checked_mul(400)?.div_euclid(146_097).checked_add(1970)?;
    while days(year, 1, 1)? > day {
        year = year.checked_sub(1)?;
    }
    while days(year.checked_add(1)?, 1, 1)? <= day {
        year = year.checked_add(1)?;
    }
    let mut month = 12;
    while days(year, month, 1)? > day {
        month = month.checked_sub(1)?;
    }
    Some((year, month, day.checked_sub(days(year, month, 1)?)?.checked_add(1)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_that_is_set_back_does_not_change_the_moment() {
        let at = |seconds| UNIX_EPOCH + Duration::from_secs(seconds);
        let now = |clock| Moment::of_clock(clock, at(1000), Duration::from_secs(60));
        assert_eq!(now(at(1060)), Moment(1060));
        assert_eq!(now(at(500)), Moment(1060));
        assert_eq!(now(at(2000)), Moment(2000));
    }

    #[test]
    fn dates_match_the_calendar() {
        // As printed by `date -u -d @…`.
        for (seconds, text) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_709_251_199, "2024-02-29T23:59:59Z"),
            (1_709_251_200, "2024-03-01T00:00:00Z"),
            (4_107_542_399, "2100-02-28T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
            (253_402_300_799, "9999-12-31T23:59:59Z"),
        ] {
            assert_eq!(Moment(seconds).to_string(), text);
            assert_eq!(Moment::from_rfc3339(text), Some(Moment(seconds)));
        }
        for day in -800_000..800_000 {
            let (year, month, of_month) = date(day).unwrap();
            assert_eq!(days(year, month, of_month), Some(day));
        }
    }
}
