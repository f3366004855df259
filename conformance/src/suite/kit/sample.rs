//! The choice of the items of a long list.

use std::ops::Range;

use crate::judge::order;

/// A list of at most this many items is read whole.
const WHOLE_MAX: u32 = 256;
/// Number of items that are read at each end of a longer list.
const END: u32 = 64;
/// Number of equal parts between the ends; one item of each is read.
const PARTS: u32 = 128;
/// Maximum number of items of a list that are read.
const ITEMS_MAX: u32 = 10_000;

/// Which items of a list the cases read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// Of a list of more than 256 items the first 64, the last 64, and 128 in between by this seed.
    BySeed(u32),
    /// The first 10,000 items of every list.
    All,
}

impl Sample {
    /// The chosen items, in order. Lists of the same length have the same choice.
    ///
    /// ```
    /// use ads_cnc_conformance::suite::Sample;
    ///
    /// assert_eq!(Sample::BySeed(1).of(0..256), Sample::All.of(0..256));
    /// let some = Sample::BySeed(1).of(1..10_001);
    /// assert_eq!((some.len(), some[0], some[63], some[255]), (256, 1, 64, 10_000));
    /// assert_eq!(some, Sample::BySeed(1).of(1..10_001));
    /// assert_ne!(some, Sample::BySeed(2).of(1..10_001));
    /// ```
    pub fn of(self, items: Range<u32>) -> Vec<u32> {
        let Range { start, end } = items;
        let count = end.saturating_sub(start);
        let seed = match self {
            Self::BySeed(seed) if count > WHOLE_MAX => seed,
            _ => return (start..end.min(start.saturating_add(ITEMS_MAX))).collect(),
        };
        let (first, last) = (start.saturating_add(END), end.saturating_sub(END));
        // The parts differ by one item at most.
        let begin = |part: u32| {
            let items = u64::from(last.saturating_sub(first)).saturating_mul(part.into());
            let items = u32::try_from(items / u64::from(PARTS)).unwrap_or(u32::MAX);
            first.saturating_add(items)
        };
        let between = (0..PARTS).map(|part| {
            let (begin, end) = (begin(part), begin(part.saturating_add(1)));
            let random = order(seed, &format!("{part} of {count}"));
            let random = random.checked_rem(end.saturating_sub(begin).into()).unwrap_or_default();
            begin.saturating_add(u32::try_from(random).unwrap_or_default())
        });
        (start..first).chain(between).chain(last..end).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every part has its item, whatever the length.
    #[test]
    fn a_sample_is_spread_over_the_list() {
        for count in [257, 258, 300, 511, 780, 10_000, 1 << 31, u32::MAX - 1] {
            let chosen = Sample::BySeed(7).of(1..count + 1);
            assert_eq!(chosen.len(), 256, "{count}");
            assert!(chosen.is_sorted_by(|one, next| one < next), "{count}");
            assert_eq!((chosen[0], chosen[255]), (1, count), "{count}");
            let gaps = chosen.windows(2).map(|pair| u64::from(pair[1] - pair[0]));
            assert!(gaps.max() <= Some(u64::from(count) / 64), "{count}");
        }
        assert_eq!(Sample::BySeed(7).of(0..0), [0; 0]);
        assert_eq!(Sample::All.of(0..u32::MAX).len(), 10_000);
    }
}
