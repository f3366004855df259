//! Durations: parses a number with the unit ms, s or min, as in models and in options with the value
//! TIME, and formats a number of seconds for messages.

use std::time::Duration;

/// Parses a duration of at most 24 hours, such as `500ms`, `2s` or `1.5min`.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let invalid = || "expected a number with the unit ms, s or min, such as 500ms".to_owned();
    let end = text.find(|byte: char| !byte.is_ascii_digit() && byte != '.').ok_or_else(invalid)?;
    let (number, unit) = text.split_at_checked(end).ok_or_else(invalid)?;
    let number: f64 = number.parse().map_err(|_| invalid())?;
    let seconds = match unit {
        "ms" => number / 1000.0,
        "s" => number,
        "min" => number * 60.0,
        _ => return Err(invalid()),
    };
    let too_much = || "the maximum is 24 hours".to_owned();
    Duration::try_from_secs_f64(seconds).ok().filter(|time| *time <= MAX).ok_or_else(too_much)
}

/// Like [`duration`], but rejects durations of less than 1 ms.
pub(crate) fn some_time(text: &str) -> Result<Duration, String> {
    match duration(text)? {
        none if none < Duration::from_millis(1) => Err("the minimum is 1ms".to_owned()),
        time => Ok(time),
    }
}

/// Formats a number of seconds in hours, minutes or seconds, with the largest unit that needs no
/// fraction: `4 h`, `90 min`, `100 s`.
pub(crate) fn shown_time(seconds: u64) -> String {
    match seconds {
        0 => "0 s".to_owned(),
        whole if whole % 3600 == 0 => format!("{} h", whole / 3600),
        whole if whole % 60 == 0 => format!("{} min", whole / 60),
        seconds => format!("{seconds} s"),
    }
}

const MAX: Duration = Duration::from_secs(24 * 60 * 60);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_shown_in_its_largest_unit() {
        let shown = [0, 100, 5400, 14_400].map(shown_time);
        assert_eq!(shown, ["0 s", "100 s", "90 min", "4 h"]);
    }

    #[test]
    fn a_duration_needs_a_unit() {
        for (text, millis) in
            [("500ms", 500), ("2s", 2000), ("1.5s", 1500), ("1min", 60_000), ("0s", 0)]
        {
            assert_eq!(duration(text), Ok(Duration::from_millis(millis)), "{text}");
        }
        for text in ["", "5", "ms", "-1s", "1 s", "1h", "1e3s", "1.2.3s", "25000min", "٣s"] {
            assert!(duration(text).is_err(), "{text}");
        }
        assert!(some_time("0s").is_err() && some_time("1ms").is_ok());
    }
}
