//! What holds several things says how many there are and hands out each.

use ads_cnc::value::{DataType, Items, StringsRef};
use ads_cnc::*;

/// At each step an iterator says exactly how many are left.
#[track_caller]
fn counts_down(mut items: impl Iterator, count: usize) {
    for left in (0..=count).rev() {
        assert_eq!(items.size_hint(), (left, Some(left)));
        assert_eq!(items.next().is_some(), left > 0);
    }
}

#[test]
fn none_one_and_several_are_counted_and_handed_out() {
    let bytes = [1, 0, 2, 0, 3, 0];
    let dimensions = [[0], [1], [3]];
    for (count, dimensions) in [0, 1, 3].into_iter().zip(&dimensions) {
        let bytes = &bytes[..2 * count];
        let elements = Elements::new(DataType::Uns16, dimensions.into(), bytes).unwrap();
        assert_eq!((elements.len(), elements.is_empty()), (count, count == 0));
        assert_eq!(elements.get(count), None);
        counts_down(elements.iter(), count);
        assert_eq!(elements.iter().len(), count);
        let (backward, forward): (Vec<_>, Vec<_>) =
            (elements.iter().rev().collect(), elements.iter().collect());
        assert!(backward.iter().eq(forward.iter().rev()) && forward.len() == count);
        for place in 0..count {
            assert_eq!(elements.iter().nth(place), elements.get(place));
        }

        let items = Items::<u16>::new(bytes).unwrap();
        assert_eq!((items.len(), items.is_empty(), items.get(count)), (count, count == 0, None));
        counts_down(items.iter(), count);
        let others =
            [&bytes[..bytes.len() - bytes.len().min(2)], &[9; 6], &[1, 0, 2, 0, 3, 0, 4, 0]];
        for other in others.into_iter().filter(|other| *other != bytes) {
            assert_ne!(items, Items::new(other).unwrap());
        }
        let copy = bytes.to_vec();
        assert_eq!(items, Items::new(&copy).unwrap());

        let texts = b"a\0b\0c\0";
        let texts = StringsRef::new(&texts[..2 * count], count as u32).unwrap();
        assert_eq!((texts.len(), texts.is_empty()), (count, count == 0));
        assert_eq!((texts.iter().count(), texts.get(count)), (count, None));

        let numbers = [7, 8, 9];
        let numbers = Numbers::from(&numbers[..count]);
        assert_eq!(
            (numbers.len(), numbers.is_empty(), numbers.get(count)),
            (count, count == 0, None)
        );
        counts_down(numbers.iter(), count);
    }
    assert_eq!(StringsRef::new(b"ab\0c\0\0", 2).unwrap().element_size(), 3);
}

#[cfg(feature = "alloc")]
#[test]
fn owned_lists_are_counted_and_handed_out() {
    use ads_cnc::value::Values;

    for (values, count) in [
        (Values::Uns16(vec![]), 0),
        (Values::Uns16(vec![1, 2, 3]), 3),
        (Values::String(StringsRef::new(b"a\0b\0", 2).unwrap().into()), 2),
    ] {
        assert_eq!((values.len(), values.is_empty()), (count, count == 0));
    }
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
