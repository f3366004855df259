//! The speed at which streamed lines are executed.

use std::num::NonZeroU32;
use std::time::Duration;

/// The speed at which a decoder executes the lines of a stream. The manuals do not specify it.
///
/// ```
/// use ads_cnc_conformance::simulator::program::Pace;
///
/// assert_eq!(Pace::lines_per_second(0), None);
/// assert_eq!(Pace::lines_per_second(500).unwrap().to_string(), "500 lines/s");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// As fast as possible: a line takes no time.
    Fast,
    /// Lines per second.
    Lines(NonZeroU32),
    /// Bytes per second, including line ends.
    Bytes(NonZeroU32),
    /// Stopped: no line is read or executed.
    Hold,
}

impl Pace {
    /// Lines per second; `None` for 0.
    pub fn lines_per_second(lines: u32) -> Option<Self> {
        NonZeroU32::new(lines).map(Self::Lines)
    }

    /// Bytes per second; `None` for 0.
    pub fn bytes_per_second(bytes: u32) -> Option<Self> {
        NonZeroU32::new(bytes).map(Self::Bytes)
    }
}

/// The error for a text that is not a [`Pace`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a number of lines per second from 1, `4000 bytes/s`, `fast` or `hold`")]
pub struct ParsePaceError;

/// Parses a number of lines per second, with or without `lines/s`, a number of bytes per second
/// with `bytes/s`, `fast` or `hold`.
///
/// ```
/// use ads_cnc_conformance::simulator::program::Pace;
///
/// assert_eq!("500".parse::<Pace>()?, Pace::lines_per_second(500).unwrap());
/// assert_eq!("4000 bytes/s".parse::<Pace>()?, Pace::bytes_per_second(4000).unwrap());
/// assert!("0".parse::<Pace>().is_err());
/// # Ok::<(), ads_cnc_conformance::simulator::program::ParsePaceError>(())
/// ```
impl std::str::FromStr for Pace {
    type Err = ParsePaceError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (number, unit) = text.split_once(' ').unwrap_or((text, "lines/s"));
        // The parser of numbers would accept a plus sign.
        let number = Some(number).filter(|number| !number.starts_with('+'));
        let number = number.and_then(|number| number.parse().ok());
        let pace = match (text, unit) {
            ("fast", _) => Some(Self::Fast),
            ("hold", _) => Some(Self::Hold),
            (_, "lines/s") => number.and_then(Self::lines_per_second),
            (_, "bytes/s") => number.and_then(Self::bytes_per_second),
            _ => None,
        };
        pace.ok_or(ParsePaceError)
    }
}

impl std::fmt::Display for Pace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fast => f.write_str("as fast as possible"),
            Self::Lines(lines) => write!(f, "{lines} lines/s"),
            Self::Bytes(bytes) => write!(f, "{bytes} bytes/s"),
            Self::Hold => f.write_str("on hold"),
        }
    }
}

/// Calculates the time at which a line has been executed, always from the start of this clock, so
/// that rounding errors do not accumulate.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LineClock {
    since: Duration,
    /// Lines or bytes executed since the start.
    units: u64,
}

impl LineClock {
    /// Starts the clock at `now`, when the execution of the current line begins.
    pub(super) fn begin(now: Duration) -> Self {
        Self { since: now, units: 0 }
    }

    /// Returns whether a line has been executed by `now`; in this case, counts the line, unless the
    /// pace is [`Pace::Fast`].
    pub(super) fn pass(&mut self, pace: Pace, line: &[u8], now: Duration) -> bool {
        let (rate, cost) = match pace {
            Pace::Fast => return true,
            Pace::Hold => return false,
            Pace::Lines(rate) => (rate, 1),
            Pace::Bytes(rate) => (rate, u64::try_from(line.len()).unwrap_or(u64::MAX)),
        };
        let units = self.units.saturating_add(cost);
        let whole = Duration::from_secs(units.checked_div(rate.get().into()).unwrap_or(0));
        let part = units.checked_rem(rate.get().into()).unwrap_or(0).saturating_mul(1_000_000_000);
        let part = Duration::from_nanos(part.div_ceil(rate.get().into()));
        let due = self.since.saturating_add(whole).saturating_add(part);
        if due <= now {
            self.units = units;
        }
        due <= now
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formatted_pace_is_parsed_again() {
        for (text, pace) in [
            ("1", Pace::lines_per_second(1)),
            ("500 lines/s", Pace::lines_per_second(500)),
            ("4294967295 bytes/s", Pace::bytes_per_second(u32::MAX)),
            ("fast", Some(Pace::Fast)),
            ("hold", Some(Pace::Hold)),
        ] {
            assert_eq!(text.parse().ok(), pace, "{text}");
        }
        let bad =
            ["", "0", "-1", "+1", "1.5", " 1", "1 ", "4294967296", "0 bytes/s", "1 lines", "Fast"];
        for text in bad {
            assert_eq!(text.parse::<Pace>(), Err(ParsePaceError), "{text}");
        }
    }
}
