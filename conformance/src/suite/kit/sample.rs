//! Selects items of long lists.

use std::ops::Range;

use crate::judge::order;
use crate::number::to_u32;

/// Maximum number of items that are selected from a list if no sample is taken.
const ITEMS_MAX: u32 = 10_000;

/// Which items of each list the cases read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// All items of a short list, and a sample of a long list, which is selected with this seed.
    /// For objects, variables and elements, the size of the sample depends on the lengths of all
    /// lists of the same kind.
    BySeed(u32),
    /// The first 10,000 items of every list.
    All,
}

impl Sample {
    /// The selected items in ascending order. [`All`](Self::All) selects the first 10,000 items.
    /// [`BySeed`](Self::BySeed) selects all items, or `most` items of a list with more items. A
    /// quarter of these (rounded down) are the first, a quarter the last, and the rest are spread
    /// over the items in between. The same seed and the same `most` select the same positions in
    /// all lists of the same length.
    ///
    /// ```
    /// use ads_cnc_conformance::suite::Sample;
    ///
    /// let by_seed = |seed| Sample::BySeed(seed).of(1..10_001, 256);
    /// let some = by_seed(1);
    /// assert_eq!((some.len(), some[0], some[63], some[192], some[255]), (256, 1, 64, 9_937, 10_000));
    /// assert_eq!(some, by_seed(1));
    /// assert_ne!(some, by_seed(2));
    /// assert_eq!(Sample::BySeed(1).of(0..256, 256), Sample::All.of(0..256, 256));
    /// ```
    pub fn of(self, items: Range<u32>, most: u32) -> Vec<u32> {
        let Range { start, end } = items;
        let count = end.saturating_sub(start);
        let seed = match self {
            Self::BySeed(seed) if count > most => seed,
            _ => return (start..end.min(start.saturating_add(ITEMS_MAX))).collect(),
        };
        let at_end = most / 4;
        let parts = most.saturating_sub(at_end.saturating_mul(2));
        let (first, last) = (start.saturating_add(at_end), end.saturating_sub(at_end));
        // The items in between are divided into `parts` ranges, whose lengths differ by at most one
        // item; one item of each range is selected.
        let begin = |part: u32| {
            let items = u64::from(last.saturating_sub(first)).saturating_mul(part.into());
            let items = items.checked_div(parts.into()).unwrap_or_default();
            first.saturating_add(to_u32(items))
        };
        let between = (0..parts).map(|part| {
            let (begin, end) = (begin(part), begin(part.saturating_add(1)));
            let random = order(seed, &format!("{part} of {count}"));
            let random = random.checked_rem(end.saturating_sub(begin).into()).unwrap_or_default();
            begin.saturating_add(u32::try_from(random).unwrap_or_default())
        });
        (start..first).chain(between).chain(last..end).collect()
    }

    /// The selected items of a list that is already known.
    pub(crate) fn among<T>(self, items: Vec<T>, most: u32) -> Vec<T> {
        let count = to_u32(items.len());
        let chosen = self.of(0..count, most);
        let numbered = (0..).zip(items);
        let kept = numbered.filter(|(number, _)| chosen.binary_search(number).is_ok());
        kept.map(|(_, item)| item).collect()
    }
}

/// The kind of the items of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ItemKind {
    Object,
    Variable,
    Element,
}

/// Maximum number of items of a list in a sample, for each kind of item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SampleSizes {
    objects: u32,
    variables: u32,
    elements: u32,
}

impl SampleSizes {
    /// The largest size.
    const MOST: u32 = 256;
    /// The smallest size, also for a very large number of lists.
    const LEAST: u32 = 4;
    /// The sizes until the lists of a target are counted; they remain the same if the target has
    /// few items.
    pub(crate) const DEFAULT: Self =
        Self { objects: Self::MOST, variables: Self::MOST, elements: Self::MOST };

    /// The sizes for these lists, given by kind and number of items. For each kind, this is the
    /// largest size with which the samples of all its lists have at most a fixed number of items in
    /// total, but at least [`LEAST`](Self::LEAST) and at most [`MOST`](Self::MOST). These numbers
    /// limit the requests of a run, see `tests/library/large.rs`.
    pub(crate) fn new(lists: &[(ItemKind, u32)]) -> Self {
        let size = |kind, budget| {
            let counts = || lists.iter().filter(move |list| list.0 == kind).map(|list| list.1);
            let read = |most: u32| counts().map(|count| u64::from(count.min(most))).sum::<u64>();
            (Self::LEAST..=Self::MOST)
                .rev()
                .find(|most| read(*most) <= budget)
                .unwrap_or(Self::LEAST)
        };
        Self {
            objects: size(ItemKind::Object, 560),
            variables: size(ItemKind::Variable, 320),
            elements: size(ItemKind::Element, 336),
        }
    }

    pub(crate) const fn of(self, kind: ItemKind) -> u32 {
        match kind {
            ItemKind::Object => self.objects,
            ItemKind::Variable => self.variables,
            ItemKind::Element => self.elements,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sample of a longer list has `most` different items in ascending order, among them the
    /// first and the last item of the list, without large gaps.
    #[test]
    fn a_sample_is_spread_over_the_list() {
        for most in [4, 5, 17, 255, 256] {
            for count in [257, 258, 300, 511, 780, 10_000, 1 << 31, u32::MAX - 1] {
                let chosen = Sample::BySeed(7).of(1..count + 1, most);
                assert_eq!(chosen.len(), most as usize, "{count}");
                assert!(chosen.is_sorted_by(|one, next| one < next), "{count}: {chosen:?}");
                assert_eq!((chosen[0], chosen[chosen.len() - 1]), (1, count));
                let gaps = chosen.windows(2).map(|pair| pair[1] - pair[0]);
                assert!(gaps.max() <= Some(count / (most / 4)), "{count}");
            }
        }
        assert_eq!(Sample::BySeed(7).of(0..0, 256), [0; 0]);
        assert_eq!(Sample::All.of(0..u32::MAX, 256).len(), 10_000);
    }

    /// If the lists have few items in total, a list of 256 items is read completely; for more or
    /// longer lists, the maximum number of items of each list is smaller.
    #[test]
    fn many_lists_share_the_requests() {
        let sizes = |lists: &[u32]| {
            let lists: Vec<_> = lists.iter().map(|&items| (ItemKind::Variable, items)).collect();
            let sizes = SampleSizes::new(&lists);
            assert_eq!(sizes.of(ItemKind::Object), 256);
            sizes.of(ItemKind::Variable)
        };
        assert_eq!(sizes(&[256, 50, 3]), 256);
        assert_eq!(sizes(&[10_000, 50, 20]), 250);
        assert_eq!(sizes(&[333; 30]), 10);
        assert_eq!(sizes(&[10; 50]), 6);
        assert_eq!(sizes(&[10; 1000]), 4);
    }
}
