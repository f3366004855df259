//! Tests of lists and iterators: their lengths and items.

use std::iter::FusedIterator;

use ads_cnc::streaming::NcText;
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

/// Checks that an iterator returns `count` items, and `None` from then on, as `FusedIterator`
/// promises.
#[track_caller]
fn stays_at_its_end(mut items: impl FusedIterator, count: usize) {
    assert_eq!(items.by_ref().count(), count);
    for _ in 0..3 {
        assert!(items.next().is_none());
    }
}

#[test]
fn iterators_stay_at_their_end() {
    let indices = VariablePath::new("V.E.s[3].t[4][5]").unwrap().elements();
    let wire = HandleReadRef::decode(&[1, 0, 0, 2, 1, 0, 0, 0, 9, 0, 0, 0]).unwrap();
    for (numbers, count) in [(U32List::from(&[3, 9]), 2), (wire.indices, 1), (indices, 2)] {
        stays_at_its_end(numbers.iter(), count);
    }
    stays_at_its_end(DescriptorsRef::decode(&[0; 168]).unwrap().iter(), 2);
    let elements = Elements::new(DataType::Uns16, U32List::from(&[2]), &[1, 0, 2, 0]).unwrap();
    stays_at_its_end(elements.iter(), 2);
    // After `nth` with an index past the end, the iterator is at its end.
    let mut skipped = elements.iter();
    assert_eq!(skipped.nth(5), None);
    stays_at_its_end(skipped, 0);
    let mut backward = elements.iter();
    assert!(backward.next_back().is_some());
    stays_at_its_end(backward, 1);
    for name in [CncStr::new("V.E.s[3].t").unwrap(), CncStr::from_bytes(b"V.E.s[3].t").unwrap()] {
        stays_at_its_end(VariablePath::from_text(name).unwrap().parts(), 2);
        stays_at_its_end(name.chars(), 10);
    }
    stays_at_its_end(NcText::new(b"N10\r\n\nN20").unwrap().lines(), 3);
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

#[test]
fn an_owned_descriptor_is_made_from_a_view() {
    let descriptor = Descriptor::new("mc_active_single_block_r", "BOOL").unwrap().with_id(82);
    let mut buf = [0; limits::DESCRIPTOR_LEN];
    let view = DescriptorRef::decode(descriptor.encode(&mut buf).unwrap()).unwrap();
    assert_eq!(Descriptor::from(view), descriptor);
}
