//! The cases of descriptions of variables, with names of several lengths.

use ads_cnc::{Decode, Description, DescriptionRef, Encode};

use crate::case::{Case, Limit, Work, each};
use crate::hand::{self, HandWritten};
use crate::plain;

type ByHand<'a> = hand::Description<&'a [u8], &'a [u8]>;
type OwnedByHand = hand::Description<Vec<u8>, Vec<u32>>;

/// The number of descriptions in a run.
const COUNT: usize = 100;

macro_rules! descriptions {
    ($($subject:literal: $dimensions:literal;)+) => {
        pub(super) const CASES: &[Case] = &[$(
            Case::new($subject, "borrowed", || {
                each!(descriptions($dimensions), |bytes| DescriptionRef::decode(bytes))
            })
            .within(&[
                Limit::Instructions("borrowed by hand", 1.3),
                Limit::Time("borrowed by hand", 1.3),
            ]),
            Case::new($subject, "borrowed by hand", || {
                each!(descriptions($dimensions), |bytes| ByHand::decode(bytes))
            }),
            Case::new($subject, "owned", || {
                each!(descriptions($dimensions), |bytes| Description::decode(bytes))
            })
            .within(&[Limit::Instructions("owned by hand", 1.3), Limit::Time("owned by hand", 1.3)]),
            Case::new($subject, "owned by hand", || {
                each!(descriptions($dimensions), |bytes| OwnedByHand::decode(bytes))
            }),
            Case::new($subject, "a copy", || each!(descriptions($dimensions), |bytes| bytes.to_vec())),
            Case::new($subject, "binrw", || {
                each!(descriptions($dimensions), |bytes| plain::binrw::description(bytes))
            }),
            Case::new($subject, "deku", || {
                each!(descriptions($dimensions), |bytes| plain::deku::description(bytes))
            }),
            Case::new($subject, "encode", || encode($dimensions)).within(&[
                Limit::Instructions("encode by hand", 3.0),
            ]),
            Case::new($subject, "encode by hand", || encode_by_hand($dimensions)),
            Case::new($subject, "encode of a view", || {
                let bytes: &[Vec<u8>] = descriptions($dimensions).leak();
                let mut buf = [0; 2048];
                each!(decoded::<DescriptionRef<'_>>(bytes), |view| view.encode(&mut buf))
            })
            .within(&[Limit::Instructions("encode by hand", 3.0)]),
        )+];
    };
}

descriptions! {
    "description, 0 dimensions": 0;
    "description, 2 dimensions": 2;
}

/// Descriptions with names of 5 to 32 characters. The lengths increase by one, and begin again at 5
/// after 32.
fn descriptions(dimensions: u32) -> Vec<Vec<u8>> {
    (0..COUNT).map(|at| description(dimensions, 5 + at % 28)).collect()
}

pub(super) fn description(dimensions: u32, name: usize) -> Vec<u8> {
    let head = [0x200_0002, 6, 2, 3_u32.saturating_pow(dimensions).saturating_mul(4), dimensions];
    let numbers = head.into_iter().chain((0..dimensions).map(|_| 3));
    let name = b"V.E.axis_group_1.setpoint_of_position".iter().take(name);
    numbers.flat_map(u32::to_le_bytes).chain(name.copied()).chain([0]).collect()
}

fn decoded<'a, T: Decode<'a>>(bytes: &'a [Vec<u8>]) -> Vec<T> {
    bytes.iter().map(|bytes| T::decode(bytes).unwrap()).collect()
}

fn encode(dimensions: u32) -> Work {
    let mut buf = [0; 2048];
    each!(decoded::<Description>(&descriptions(dimensions)), |owned| owned.encode(&mut buf))
}

fn encode_by_hand(dimensions: u32) -> Work {
    let bytes = descriptions(dimensions);
    let owned: Vec<_> = bytes.iter().map(|bytes| OwnedByHand::decode(bytes).unwrap()).collect();
    let mut buf = [0; 2048];
    each!(owned, |owned| owned.encode(&mut buf))
}
