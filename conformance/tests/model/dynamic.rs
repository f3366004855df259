//! Dynamic parameters.

use super::{CHANNEL_1, Cnc};

/// Count, name by index, value by name, value by index of each kind.
const P: [u32; 4] = [0x02, 0x1B, 0x1C, 0x1D];
const VL: [u32; 4] = [0x03, 0x1E, 0x1F, 0x20];
const VP: [u32; 4] = [0x04, 0x21, 0x22, 0x23];
const VS: [u32; 4] = [0x05, 0x24, 0x25, 0x26];

fn real(value: f64) -> Result<Vec<u8>, u32> {
    Ok(value.to_le_bytes().to_vec())
}

#[test]
fn printed_example() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    assert_eq!(sda.read(CHANNEL_1, 0x02, 4), Ok(vec![1, 0, 0, 0]));
    assert_eq!(sda.ask(CHANNEL_1, 0x1B, &[1, 0, 0, 0]), Ok(b"P1\0".to_vec()));
    let value = vec![0, 0, 0, 0, 0, 0x67, 0xB2, 0x40];
    assert_eq!(sda.ask(CHANNEL_1, 0x1C, b"P1\0"), Ok(value.clone()));
    assert_eq!(sda.ask(CHANNEL_1, 0x1C, b"P1"), Ok(value.clone()));
    assert_eq!(sda.ask(CHANNEL_1, 0x1D, &[1, 0, 0, 0]), Ok(value));
}

#[test]
fn every_kind_has_its_functions() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    for (kind, names) in [
        (P, &[("P1", 4711.0)][..]),
        (VL, &[("V.L.depth", 2.5)]),
        (VP, &[("V.P.count", 3.0), ("V.P.offset", -0.125)]),
        (VS, &[("V.S.radius", 6.25)]),
    ] {
        let [count, name_at, by_name, by_index] = kind;
        assert_eq!(sda.read(CHANNEL_1, count, 4), Ok(vec![names.len() as u8, 0, 0, 0]));
        for (index, &(name, value)) in (1_u8..).zip(names) {
            let (index, name) = ([index, 0, 0, 0], format!("{name}\0"));
            assert_eq!(sda.ask(CHANNEL_1, name_at, &index), Ok(name.clone().into_bytes()));
            assert_eq!(sda.ask(CHANNEL_1, by_name, name.as_bytes()), real(value), "{name}");
            assert_eq!(sda.ask(CHANNEL_1, by_index, &index), real(value), "{name}");
        }
        // Indices are 1 to n; names are those of the kind.
        for index in [0, names.len() as u8 + 1, 255] {
            let wanted = if index == 0 { 0x705 } else { 0x706 };
            assert_eq!(sda.ask(CHANNEL_1, name_at, &[index, 0, 0, 0]), Err(wanted));
            assert_eq!(sda.ask(CHANNEL_1, by_index, &[index, 0, 0, 0]), Err(wanted));
        }
        assert_eq!(sda.ask(CHANNEL_1, by_name, b"V.X.nobody\0"), Err(0x710));
        assert_eq!(sda.ask(CHANNEL_1, by_name, b"P\0"), Err(0x710));
        assert_eq!(sda.ask(CHANNEL_1, by_name, &[b'x'; 97]), Err(0x705));
        // Channel 2 has none.
        assert_eq!(sda.read(0x12_2302, count, 4), Ok(vec![0; 4]));
        assert_eq!(sda.read(0x12_2303, count, 4), Err(0x702));
    }
    assert_eq!(sda.ask(CHANNEL_1, 0x1C, b"V.L.depth\0"), Err(0x710));
}

/// While a subroutine runs it has a variable in front of the other: the index of that one moves,
/// its name stays (DYN-4).
#[test]
fn parameters_come_and_go() {
    let cnc = Cnc::start(&[]);
    let (sda, com) = (cnc.sda(), cnc.com());
    let first = || sda.ask(CHANNEL_1, 0x1E, &[1, 0, 0, 0]);
    assert_eq!(first(), Ok(b"V.L.depth\0".to_vec()));
    assert_eq!(com.write(0x12_0101, 0x1F, &[1]), Ok(()));
    assert_eq!(sda.read(CHANNEL_1, 0x03, 4), Ok(vec![2, 0, 0, 0]));
    assert_eq!(first(), Ok(b"V.L.temporary\0".to_vec()));
    assert_eq!(sda.ask(CHANNEL_1, 0x20, &[1, 0, 0, 0]), real(0.5));
    assert_eq!(sda.ask(CHANNEL_1, 0x20, &[2, 0, 0, 0]), real(2.5));
    assert_eq!(sda.ask(CHANNEL_1, 0x1F, b"V.L.depth\0"), real(2.5));
    assert_eq!(sda.ask(CHANNEL_1, 0x1F, b"V.L.temporary\0"), real(0.5));
    assert_eq!(com.write(0x12_0101, 0x1F, &[0]), Ok(()));
    assert_eq!(sda.read(CHANNEL_1, 0x03, 4), Ok(vec![1, 0, 0, 0]));
    assert_eq!(first(), Ok(b"V.L.depth\0".to_vec()));
    assert_eq!(sda.ask(CHANNEL_1, 0x1F, b"V.L.temporary\0"), Err(0x710));
    assert_eq!(sda.ask(CHANNEL_1, 0x20, &[2, 0, 0, 0]), Err(0x706));
}
