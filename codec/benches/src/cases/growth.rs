//! Cases that compare the cost of a record in short and long lists, and that of dimensions in short
//! and long descriptions.

use ads_cnc::{Decode, Description, DescriptionRef, Descriptors, DescriptorsRef, Encode};

use super::descriptors::{last_offset, lists};
use crate::case::{Case, Limit, Work, each};

/// Declares cases with increasing numbers of records or dimensions. A unit may cost at most 5 %
/// more instructions than in the case that `after` names.
macro_rules! grows {
    ($subject:literal: $($implementation:literal $(after $less:literal)?, $work:expr;)+) => {
        &[$(
            Case::new($subject, $implementation, || $work)
                $(.within(&[Limit::Instructions($less, 1.05)]))?,
        )+]
    };
}

/// The number of descriptors in the longest list. The cases of 1,000,000 descriptors process such a
/// list 25 times.
const LIST: u64 = 40_000;

pub(super) const CASES: &[&[Case]] = &[
    grows! {
        "descriptors, borrowed":
        "1", borrowed(1, 1_000);
        "100" after "1", borrowed(100, 100);
        "10,000" after "100", borrowed(10_000, 1);
        "1,000,000" after "10,000", borrowed(LIST, 25);
    },
    grows! {
        "descriptors, owned":
        "1", owned(1, 1_000);
        "100" after "1", owned(100, 100);
        "10,000" after "100", owned(10_000, 1);
        "1,000,000" after "10,000", owned(LIST, 25);
    },
    grows! {
        "descriptors, encode":
        "1", encode(1, 1_000);
        "100" after "1", encode(100, 100);
        "10,000" after "100", encode(10_000, 1);
        "1,000,000" after "10,000", encode(LIST, 25);
    },
    // Figures of this subject are per description.
    grows! {
        "dimensions, borrowed":
        "0", each!(descriptions(0), |bytes| DescriptionRef::decode(bytes));
        "50" after "0", each!(descriptions(50), |bytes| DescriptionRef::decode(bytes));
        "500" after "50", each!(descriptions(500), |bytes| DescriptionRef::decode(bytes));
    },
    // Figures of this subject and the next are per dimension.
    grows! {
        "dimensions, owned":
        "5", each!(descriptions(5), 5, |bytes| Description::decode(bytes));
        "50" after "5", each!(descriptions(50), 50, |bytes| Description::decode(bytes));
        "500" after "50", each!(descriptions(500), 500, |bytes| Description::decode(bytes));
    },
    grows! {
        "dimensions, encode":
        "5", dimensions_encoded(5);
        "50" after "5", dimensions_encoded(50);
        "500" after "50", dimensions_encoded(500);
    },
];

fn records(count: u64) -> Vec<u8> {
    lists(count).swap_remove(0)
}

/// Decodes the same list of `count` descriptors `times` times, which needs less memory than many
/// lists.
fn borrowed(count: u64, times: usize) -> Work {
    let bytes = records(count);
    each!(vec![(); times], count, |_again| {
        DescriptorsRef::decode(std::hint::black_box(&bytes)).map(last_offset)
    })
}

fn owned(count: u64, times: usize) -> Work {
    let bytes = records(count);
    each!(vec![(); times], count, |_again| Descriptors::decode(std::hint::black_box(&bytes)))
}

fn encode(count: u64, times: usize) -> Work {
    let bytes = records(count);
    let list = Descriptors::decode(&bytes).unwrap();
    let mut buf = vec![0; bytes.len()];
    each!(vec![(); times], count, |_again| std::hint::black_box(&list).encode(&mut buf))
}

fn descriptions(dimensions: u32) -> Vec<Vec<u8>> {
    vec![super::description::description(dimensions, 14); 100]
}

fn dimensions_encoded(dimensions: u32) -> Work {
    let bytes = descriptions(dimensions);
    let owned: Vec<_> = bytes.iter().map(|bytes| Description::decode(bytes).unwrap()).collect();
    let mut buf = [0; 2048];
    each!(owned, dimensions as u64, |owned| owned.encode(&mut buf))
}
