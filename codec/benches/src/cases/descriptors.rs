//! The cases of lists of object descriptors.

use ads_cnc::{Decode, Descriptors, DescriptorsRef, Encode};

use crate::case::{Case, Limit, Work, each};
use crate::hand::{self, HandWritten};
use crate::plain;

/// The minimum number of descriptors in a run, in all lists together.
const RECORDS: u64 = 10_000;

macro_rules! lists {
    ($($subject:literal: $count:literal;)+) => {
        pub(super) const CASES: &[Case] = &[$(
            Case::new($subject, "borrowed, one field read", || {
                each!(lists($count), $count, |bytes| DescriptorsRef::decode(bytes).map(last_offset))
            })
            .within(&[Limit::Instructions("by hand", 1.3), Limit::Time("by hand", 1.3)]),
            Case::new($subject, "owned", || {
                each!(lists($count), $count, |bytes| Descriptors::decode(bytes))
            })
            .within(&[Limit::Instructions("by hand", 1.3), Limit::Time("by hand", 1.3)]),
            Case::new($subject, "by hand", || {
                each!(lists($count), $count, |bytes| hand::Descriptors::decode(bytes))
            }),
            Case::new($subject, "a copy", || each!(lists($count), $count, |bytes| bytes.to_vec())),
            Case::new($subject, "binrw", || {
                each!(lists($count), $count, |bytes| plain::binrw::descriptors(bytes))
            }),
            Case::new($subject, "deku", || {
                each!(lists($count), $count, |bytes| plain::deku::descriptors(bytes))
            }),
            Case::new($subject, "encode", || encode($count))
                .within(&[Limit::Instructions("encode by hand", 3.0)]),
            Case::new($subject, "encode by hand", || encode_by_hand($count)),
        )+];
    };
}

lists! {
    "1 descriptor": 1;
    "100 descriptors": 100;
    "10,000 descriptors": 10_000;
}

/// Reads the index offset of each descriptor, like a client that searches for an address.
pub(super) fn last_offset(list: DescriptorsRef<'_>) -> u32 {
    list.iter().fold(0, |sum, object| sum ^ object.index_offset().get())
}

pub(super) fn lists(count: u64) -> Vec<Vec<u8>> {
    (0..RECORDS.max(count) / count)
        .map(|list| (0..count).flat_map(|place| record(list * count + place)).collect())
        .collect()
}

/// The bytes of the descriptor of object number `at`, with a name and an address like those in the
/// manuals.
fn record(at: u64) -> [u8; 84] {
    let mut bytes = [0; 84];
    bytes[..4].copy_from_slice(&(at as u32).to_le_bytes());
    bytes[4..8].copy_from_slice(&4_u32.to_le_bytes());
    bytes[8] = (at % 2) as u8;
    bytes[12..16].copy_from_slice(&0x12_0101_u32.to_le_bytes());
    bytes[16..20].copy_from_slice(&(at as u32 + 1).to_le_bytes());
    let name = format!("gdb[0].object_{at}");
    bytes[20..][..name.len()].copy_from_slice(name.as_bytes());
    bytes[52..56].copy_from_slice(b"DINT");
    bytes
}

fn encode(count: u64) -> Work {
    let lists = lists(count);
    let mut buf = vec![0; lists[0].len()];
    let lists: Vec<_> = lists.iter().map(|bytes| Descriptors::decode(bytes).unwrap()).collect();
    each!(lists, count, |list| list.encode(&mut buf))
}

fn encode_by_hand(count: u64) -> Work {
    let lists = lists(count);
    let mut buf = vec![0; lists[0].len()];
    let lists: Vec<_> =
        lists.iter().map(|bytes| hand::Descriptors::decode(bytes).unwrap()).collect();
    each!(lists, count, |list| list.encode(&mut buf))
}
