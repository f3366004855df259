//! Dynamic parameters, and the times at which they exist.

use std::time::Duration;

use ads_cnc::CncString;
use ads_cnc::dynamic::{DynamicKind, DynamicValue};

/// A dynamic parameter (DYN).
#[derive(Clone, Debug, PartialEq)]
pub(in crate::simulator) struct Parameter {
    pub(in crate::simulator) kind: DynamicKind,
    pub(in crate::simulator) name: CncString,
    /// The value of the parameter each time it is created.
    pub(in crate::simulator) value: DynamicValue,
    /// The index of an object of the channel: the parameter exists only while the object's content
    /// is not 0.
    pub(in crate::simulator) needs: Option<usize>,
    /// The times at which the parameter exists.
    pub(in crate::simulator) times: Times,
}

/// The times at which a parameter exists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::simulator) struct Times {
    comes: Duration,
    goes: Option<Duration>,
    period: Option<Duration>,
}

impl Times {
    /// The times of a parameter that is created at `comes` and deleted at `goes`, repeated after
    /// `period`; an error message if the times contradict each other.
    pub(super) fn new(
        comes: Duration,
        goes: Option<Duration>,
        period: Option<Duration>,
    ) -> Result<Self, &'static str> {
        let end = goes.or(period);
        if goes.is_some_and(|goes| goes <= comes) {
            return Err("goes must be later than comes");
        }
        if period.is_some_and(|period| period < goes.unwrap_or(comes)) || end == Some(comes) {
            return Err("comes and goes must be within the period");
        }
        if comes.is_zero() && end == period && end.is_some() {
            return Err("the parameter exists for the whole period, so it never goes");
        }
        Ok(Self { comes, goes, period })
    }

    /// Whether the parameter exists at all times.
    pub(in crate::simulator) fn is_always(&self) -> bool {
        *self == Self::default()
    }

    /// The number of times that the parameter was created before; `None` if it does not exist at
    /// this time.
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
    fn a_parameter_exists_from_comes_to_goes() {
        let lives = |times: Times| {
            (0..9).map(|now| times.life(Duration::from_secs(now))).collect::<Vec<_>>()
        };
        let (no, a, b, c) = (None, Some(0), Some(1), Some(2));
        assert_eq!(lives(Times::default()), [a; 9]);
        assert_eq!(lives(times(2, None, None).unwrap()), [no, no, a, a, a, a, a, a, a]);
        assert_eq!(lives(times(0, Some(3), None).unwrap()), [a, a, a, no, no, no, no, no, no]);
        assert_eq!(lives(times(2, Some(5), None).unwrap()), [no, no, a, a, a, no, no, no, no]);
        assert_eq!(lives(times(1, Some(2), Some(4)).unwrap()), [no, a, no, no, no, b, no, no, no]);
        // Without `goes`, the parameter exists until the end of each period and is deleted at the
        // beginning of the next.
        assert_eq!(lives(times(1, None, Some(4)).unwrap()), [no, a, a, a, no, b, b, b, no]);
        assert_eq!(lives(times(0, Some(2), Some(3)).unwrap()), [a, a, no, b, b, no, c, c, no]);
    }

    #[test]
    fn invalid_times_are_rejected() {
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
