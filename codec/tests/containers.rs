//! Lists and iterators: their lengths and items.

use ads_cnc::value::DataType;
use ads_cnc::*;

/// Checks that an iterator reports the exact number of remaining items at each step.
#[track_caller]
fn counts_down(mut items: impl Iterator, count: usize) {
    for left in (0..=count).rev() {
        assert_eq!(items.size_hint(), (left, Some(left)));
        assert_eq!(items.next().is_some(), left > 0);
    }
}

#[test]
fn views_of_lists_return_all_items() {
    let bytes = [1, 0, 2, 0, 3, 0];
    let dimensions = [[0], [1], [3]];
    for (count, dimensions) in [0, 1, 3].into_iter().zip(&dimensions) {
        let bytes = &bytes[..2 * count];
        let elements = Elements::new(DataType::Uns16, dimensions.into(), bytes).unwrap();
        assert_eq!((elements.len(), elements.is_empty()), (count, count == 0));
        assert!(elements.get(count).is_err());
        counts_down(elements.iter(), count);
        assert_eq!(elements.iter().len(), count);
        let (backward, forward): (Vec<_>, Vec<_>) =
            (elements.iter().rev().collect(), elements.iter().collect());
        assert!(backward.iter().eq(forward.iter().rev()) && forward.len() == count);
        for place in 0..count {
            assert_eq!(elements.iter().nth(place), elements.get(place).ok());
        }

        let value = ValueRef { bytes };
        assert_eq!(value.iter::<u16>().unwrap().len(), count);
        assert!(value.get::<u16>(count).is_err());
        counts_down(value.iter::<u16>().unwrap(), count);
        assert!(value.iter::<u16>().unwrap().eq(elements.items::<u16>().unwrap()));

        let numbers = [7, 8, 9];
        let numbers = U32List::from(&numbers[..count]);
        assert_eq!(
            (numbers.len(), numbers.is_empty(), numbers.get(count)),
            (count, count == 0, None)
        );
        counts_down(numbers.iter(), count);
    }
}

#[cfg(feature = "alloc")]
#[test]
fn owned_lists_return_all_items() {
    let object = |name| Descriptor::new(name, "UNS32").unwrap();
    for count in [0, 1, 3] {
        let list: Descriptors =
            ["mc_a", "mc_b", "mc_c"][..count].iter().map(|name| object(name)).collect();
        let list = list.as_ref();
        assert_eq!((list.len(), list.is_empty(), list.get(count)), (count, count == 0, None));
        counts_down(list.iter(), count);
        assert!((0..count).filter_map(|place| list.get(place)).eq(list.iter()));
        for first in 0..=4 {
            for most in 0..=4 {
                let some: Vec<_> = list.iter().skip(first).take(most).collect();
                assert!(list.slice(first, most).iter().eq(some), "{first} {most} of {count}");
            }
        }
    }
}
