//! Tests that the CNC answers pseudo-random calls with data that decodes as the reply stream of the
//! function, or with an error number.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::AdsService;

use super::*;

/// Pseudo-random numbers that are the same in every run.
struct PseudoRandom(u64);

impl PseudoRandom {
    fn below(&mut self, end: u32) -> u32 {
        // Knuth's multiplier; use the high bits.
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        u32::try_from(self.0 >> 33).unwrap() % end
    }

    fn of<T: Copy>(&mut self, some: &[T]) -> T {
        some[self.below(u32::try_from(some.len()).unwrap()) as usize]
    }
}

const NAMES: &[&[u8]] = &[
    b"V.E\0",
    b"V.G\0",
    b"V.A\0",
    b"V.CYC\0",
    b"\0",
    b"",
    b"P1\0",
    b"V.L.depth\0",
    b"V.P.count\0",
    b"V.E.test\0",
    b"V.E.test[4]\0",
    b"V.E.text\0abc\0",
    b"V.E.test[4]\0\x7B\0\0\0",
    b"V.A.WCS\0",
    b"V.A.WCS.Y\0",
    b"V.A.WCS\0\0\0\0\0\0\0\0\0",
    b"V.G.SERVICE.REQUEST\0x\0",
    b"V.CYC.matrix[1][1]\0",
    b"\x02\0\0\0V.E\0",
    b"\0\0\0\0V.A\0",
    b"\x34\x12\0\x02\0\0\0\0",
    b"\x1B\0\x02\x01\0\0\0\0",
    b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7B\0\0\0",
    b"\x01\0\0\0\x02\0\0\0",
    b"\x01\0\0\0",
    b"\x01",
    b"\x03\0",
    b"\x05\0",
    b"\0\0",
    b"\0\0\0\0\0\0\0\0",
];

/// A random call, mostly at or near the address of a function, so that some calls succeed.
fn call<'a>(random: &mut PseudoRandom, data: &'a [u8]) -> Call<'a> {
    use AdsService::{Read, ReadWrite, Write};
    let axis = random.of(&[0, 0, 0, 0x1000, 0x1_0000, 0x2_0000, 0x6_0000, 0xFFFF_0000]);
    let instance = random.of(&[0, 1, 1, 2, 3, 6, 255]);
    let (task, group, offset, service) = match random.below(4) {
        0 => {
            let group = random.of(&[0x2_0100, 0x3_0100, 0x2_0200, 0x3_0200]);
            (AmsPort::COM, group, axis + random.below(0x20), random.of(&[Read, Read, Write]))
        }
        1 => {
            let offset = random.of(&[0x02, 0x1B, 0x44]) + random.below(12);
            (AmsPort::SDA, 0x2_2300, offset, random.of(&[Read, Write, ReadWrite, ReadWrite]))
        }
        2 => {
            let offset = axis + random.of(&[4, 5, 6]);
            (AmsPort::SDA, 0x2_2300, offset, random.of(&[Write, ReadWrite]))
        }
        _ => {
            let group = 0x2_0300 + random.below(6) * 0x1000 + random.below(7) * 0x100;
            let service = random.of(&[Read, Read, Write, ReadWrite]);
            (AmsPort::GEO, group, axis + random.below(4), service)
        }
    };
    let anywhere = random.below(16) == 0;
    Call {
        port: if anywhere { random.of(&[AmsPort::GEO, AmsPort::SDA, AmsPort::COM]) } else { task },
        service,
        index_group: IndexGroup::new((group + instance) | random.of(&[0x10_0000, 0x10_0000, 0])),
        index_offset: IndexOffset::new(offset),
        read_length: random.of(&[2048, 2048, 2048, 256, 84, 8, 4, 1, 0, u32::MAX]),
        data,
    }
}

#[test]
fn any_call_is_answered() {
    let cnc = Cnc::with_default_model().unwrap();
    let mut random = PseudoRandom(2026);
    let (mut answered, mut functions) = (0, std::collections::BTreeSet::new());
    for _ in 0..200_000 {
        let data = random.of(NAMES);
        let call = call(&mut random, data);
        // A Read has no data.
        let call = if call.service == AdsService::Read { Call { data: &[], ..call } } else { call };
        let Ok(reply) = cnc.answer(&call) else { continue };
        answered += 1;
        let request = call.dispatch().unwrap();
        functions.insert(request.function());
        assert!(u32::try_from(reply.len()).unwrap() <= call.read_length);
        assert!(request.decode_reply(&reply).is_ok(), "{call:?}: {reply:?}");
    }
    // Fewer successful replies would not test enough.
    assert!(answered > 5_000, "{answered}");
    assert!(functions.len() > 25, "{functions:?}");
}
