//! Parses the numbers of options.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// A parser for clap that accepts the whole numbers in this range.
pub(super) fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: FromStr + PartialOrd + Display + Clone,
{
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        let (least, most) = (range.start(), range.end());
        number.ok_or_else(|| format!("expected a whole number from {least} to {most}"))
    }
}

/// A parser of a time: a whole number from 1 to `u32::MAX`, whose unit the option defines.
pub(super) fn time() -> impl Fn(&str) -> Result<u64, String> + Clone {
    whole(1..=u64::from(u32::MAX))
}
