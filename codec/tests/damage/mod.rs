//! Random mutations of bytes.

use proptest::prelude::*;
use proptest::sample::{Index, select};

/// A mutation of bytes: its position, and its byte, bit (0 to 7) or number if it has one.
#[derive(Clone, Debug)]
pub(crate) enum Damage {
    Set(Index, u8),
    Flip(Index, u8),
    Insert(Index, u8),
    Remove(Index),
    Cut(Index),
    Number(Index, u32),
}

pub(crate) fn damage() -> impl Strategy<Value = Damage> {
    let at = any::<Index>;
    // Numbers near the limits of counts and lengths.
    let number = select(vec![0, 1, 2, 255, 256, 257, 506, 507, 510, 511, 0x4000_0001, u32::MAX]);
    prop_oneof![
        (at(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        (at(), 0..8_u8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        (at(), select(vec![0, 1, b'V', 0xAA])).prop_map(|(at, byte)| Damage::Insert(at, byte)),
        at().prop_map(Damage::Remove),
        at().prop_map(Damage::Cut),
        (at(), number).prop_map(|(at, number)| Damage::Number(at, number)),
    ]
}

impl Damage {
    pub(crate) fn inflict(&self, bytes: &mut Vec<u8>) {
        let len = bytes.len();
        match self {
            Self::Insert(at, byte) => bytes.insert(at.index(len + 1), *byte),
            Self::Cut(at) => bytes.truncate(at.index(len + 1)),
            _ if len == 0 => {}
            Self::Set(at, byte) => bytes[at.index(len)] = *byte,
            Self::Flip(at, bit) => bytes[at.index(len)] ^= 1 << bit,
            Self::Remove(at) => drop(bytes.remove(at.index(len))),
            // Write the number at a multiple of four, because many numbers of streams are there.
            Self::Number(at, number) => {
                let at = at.index(len) / 4 * 4;
                let le = number.to_le_bytes();
                bytes.iter_mut().skip(at).zip(le).for_each(|(byte, new)| *byte = new);
            }
        }
    }
}
