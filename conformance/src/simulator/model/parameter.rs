//! Dynamic parameters, and when they exist.

use std::time::Duration;

use ads_cnc::CncString;
use ads_cnc::dynamic::{DynamicKind, DynamicValue};

/// A dynamic parameter (DYN).
#[derive(Clone, Debug, PartialEq)]
pub(in crate::simulator) struct Parameter {
    pub(in crate::simulator) kind: DynamicKind,
    pub(in crate::simulator) name: CncString,
    /// The initial value each time it is created.
    pub(in crate::simulator) value: DynamicValue,
    /// It exists only while the content of this object of the channel is not 0.
    pub(in crate::simulator) needs: Option<usize>,
    /// It exists only at these times.
    pub(in crate::simulator) times: Times,
}

/// When a parameter exists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::simulator) struct Times {
    comes: Duration,
    goes: Option<Duration>,
    period: Option<Duration>,
}

impl Times {
    /// Created at `comes`, deleted at `goes`, and repeated after `period`.
    pub(super) fn new(
        comes: Duration,
        goes: Option<Duration>,
        period: Option<Duration>,
    ) -> Result<Self, &'static str> {
        let end = goes.or(period);
        if goes.is_some_and(|goes| goes <= comes) {
            return Err("it goes before it comes");
        }
        if period.is_some_and(|period| period < goes.unwrap_or(comes)) || end == Some(comes) {
            return Err("it comes and goes within its period");
        }
        if comes.is_zero() && end == period && end.is_some() {
            return Err("it is there all the period, so it does not come and go");
        }
        Ok(Self { comes, goes, period })
    }

    /// Whether it always exists.
    pub(in crate::simulator) fn is_always(&self) -> bool {
        *self == Self::default()
    }

    /// How many times it was created before at a time; `None` if it does not exist then.
    pub(in crate::simulator) fn life(&self, now: Duration) -> Option<u128> {
        let (now, period) = (now.as_nanos(), self.period.map(|period| period.as_nanos()));
        let life = period.and_then(|period| now.checked_div(period)).unwrap_or(0);
        let at = period.and_then(|period| now.checked_rem(period)).unwrap_or(now);
        let gone = self.goes.is_some_and(|goes| goes.as_nanos() <= at);
        (self.comes.as_nanos() <= at && !gone).then_some(life)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(comes: u64, goes: Option<u64>, period: Option<u64>) -> Result<Times, &'static str> {
        let at = Duration::from_secs;
        Times::new(at(comes), goes.map(at), period.map(at))
    }

    #[test]
    fn a_life_begins_and_ends_on_time() {
        let lives = |times: Times| {
            (0..9).map(|now| times.life(Duration::from_secs(now))).collect::<Vec<_>>()
        };
        let (no, a, b, c) = (None, Some(0), Some(1), Some(2));
        assert_eq!(lives(Times::default()), [a; 9]);
        assert_eq!(lives(times(2, None, None).unwrap()), [no, no, a, a, a, a, a, a, a]);
        assert_eq!(lives(times(0, Some(3), None).unwrap()), [a, a, a, no, no, no, no, no, no]);
        assert_eq!(lives(times(2, Some(5), None).unwrap()), [no, no, a, a, a, no, no, no, no]);
        assert_eq!(lives(times(1, Some(2), Some(4)).unwrap()), [no, a, no, no, no, b, no, no, no]);
        // It exists until the end of the period and is deleted at the beginning of the next.
        assert_eq!(lives(times(1, None, Some(4)).unwrap()), [no, a, a, a, no, b, b, b, no]);
        assert_eq!(lives(times(0, Some(2), Some(3)).unwrap()), [a, a, no, b, b, no, c, c, no]);
    }

    #[test]
    fn what_never_comes_or_never_goes_is_refused() {
        for (comes, goes, period) in [
            (2, Some(2), None),
            (2, Some(1), None),
            (0, Some(0), None),
            (0, None, Some(4)),
            (0, Some(4), Some(4)),
            (4, None, Some(4)),
            (5, None, Some(4)),
            (1, Some(5), Some(4)),
        ] {
            assert!(times(comes, goes, period).is_err(), "{comes} {goes:?} {period:?}");
        }
        assert!(times(1, Some(4), Some(4)).is_ok());
    }
}
