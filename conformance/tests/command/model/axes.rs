//! Axis exchange between places of channels (a place is the index of an axis in its channel), and
//! activation of channels.

use ads_cnc_conformance::simulator::DEFAULT_MODEL;

use super::{CHANNEL_1, Cnc};
use crate::common::file::TestFile;

/// The value of V.A.WCS of the axis at a place of a channel.
fn wcs(cnc: &Cnc, channel: u32, place: u32) -> Result<Vec<u8>, u32> {
    cnc.sda().ask(0x12_2300 + channel, place * 0x1_0000 + 5, b"V.A.WCS\0")
}

fn real(value: f64) -> Result<Vec<u8>, u32> {
    Ok(value.to_le_bytes().to_vec())
}

/// Places 2 and 3 of channel 2 have no axis: reads of contents return zeros, and writes are
/// rejected, except those of the axis number.
#[test]
fn an_empty_place_is_blank() {
    let cnc = Cnc::start(&[]);
    let (sda, com) = (cnc.sda(), cnc.com());
    assert_eq!(com.read(0x12_0102, 0x1_0003, 2), Ok(vec![4, 0]));
    assert_eq!(com.read(0x12_0102, 0x2_0003, 2), Ok(vec![0, 0]));
    assert_eq!(com.read(0x12_0102, 0x2_0001, 8), Ok(vec![0; 8]));
    assert_eq!(com.write(0x12_0102, 0x2_0002, &[1]), Err(0x706));
    assert_eq!(sda.read(0x12_1302, 0x2_0001, 2), Ok(vec![0, 0]));
    assert_eq!(sda.read(0x12_1302, 0x2_0002, 8), Ok(vec![0; 8]));
    assert_eq!(sda.write(0x12_1302, 0x2_0002, &[1; 8]), Err(0x706));
    assert_eq!(sda.read(0x12_1402, 0x2_0002, 256), Ok(b"example.distance_to_go\0".to_vec()));
    // The variables of the axis interface at these places are zero. No variable has a name with an
    // axis of these places.
    assert_eq!(wcs(&cnc, 2, 2), Ok(vec![0; 8]));
    assert_eq!(sda.ask(0x12_2302, 0x2_0004, b"V.A.WCS\0"), Ok(vec![0x1B, 1, 2, 1]));
    assert_eq!(sda.ask(0x12_2302, 0x47, b"\x1B\x01\x02\x01\0\0\0\0"), Ok(vec![0; 8]));
    assert_eq!(sda.write(0x12_2302, 0x2_0006, b"V.A.WCS\0\0\0\0\0\0\0\xF0\x3F"), Err(0x706));
    assert_eq!(sda.ask(0x12_2302, 0x48, b"V.A.WCS.Y\0"), Err(0x710));
    // Channel 2 has two V.A variables, those of its only axis.
    assert_eq!(sda.ask(0x12_2302, 0x44, b"V.A\0"), Ok(vec![2, 0, 0, 0]));
}

/// The printed value is that of the second axis. After another axis is assigned to place 2, the place has
/// the values of that axis.
#[test]
fn axis_exchange_changes_the_axis_of_a_place() {
    let cnc = Cnc::start(&[]);
    let (sda, com) = (cnc.sda(), cnc.com());
    let y = b"\x1B\0\x02\x01\0\0\0\0";
    assert_eq!(wcs(&cnc, 1, 2), real(1234.2));
    assert_eq!(sda.ask(CHANNEL_1, 0x47, y), real(1234.2));
    assert_eq!(sda.read(0x12_2301, 0x2_0001, 8), real(20.5));
    let platform = com.read(0x12_0202, 1, 8);

    // Z is assigned to place 2: then Y has no place, and place 3 has no axis.
    assert_eq!(com.write(0x12_0101, 0x2_0003, &[3, 0]), Ok(()));
    assert_eq!(com.read(0x12_0101, 0x2_0003, 2), Ok(vec![3, 0]));
    assert_eq!(com.read(0x12_0101, 0x3_0003, 2), Ok(vec![0, 0]));
    assert_eq!((wcs(&cnc, 1, 2), wcs(&cnc, 1, 3)), (real(-3.5), real(0.0)));
    // The handle belongs to the place (VAR-10), the name to the axis.
    assert_eq!(sda.ask(CHANNEL_1, 0x47, y), real(-3.5));
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.A.WCS.Z\0"), real(-3.5));
    assert_eq!(sda.ask(CHANNEL_1, 0x46, b"V.A.WCS.Z\0"), Ok(vec![0x1B, 0, 2, 1]));
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.A.WCS.Y\0"), Err(0x710));
    assert_eq!(sda.ask(CHANNEL_1, 0x44, b"V.A\0"), Ok(vec![4, 0, 0, 0]));
    assert_eq!(sda.ask(CHANNEL_1, 0x45, b"\x01\0\0\0V.A\0").unwrap()[20..], *b"V.A.ACT_POS.Z\0");
    assert_eq!(sda.read(0x12_2301, 0x2_0001, 8), real(30.5));
    // The platform axes do not change.
    assert_eq!(com.read(0x12_0202, 1, 8), platform);

    // Y is assigned to channel 2, with its values: a write to the element has the same effect as a
    // write to the object.
    assert_eq!(sda.write(0x12_1302, 0x3_0001, &[2, 0]), Ok(()));
    assert_eq!(wcs(&cnc, 2, 3), real(1234.2));
    assert_eq!(sda.ask(0x12_2302, 0x48, b"V.A.WCS.Y\0"), real(1234.2));
    // A value that is written at a place moves with the axis to the next place.
    assert_eq!(sda.write(0x12_2302, 0x4A, b"V.A.WCS.Y\0\0\0\0\0\0\0\xF0\x3F"), Ok(()));
    assert_eq!(com.write(0x12_0101, 0x3_0003, &[2, 0]), Ok(()));
    assert_eq!(wcs(&cnc, 1, 3), real(1.0));
    assert_eq!(wcs(&cnc, 2, 3), real(0.0));
    // A write of 0 removes the axis from its place.
    assert_eq!(com.write(0x12_0101, 0x3_0003, &[0, 0]), Ok(()));
    assert_eq!(wcs(&cnc, 1, 3), real(0.0));

    // An axis that does not exist, and a second axis X, whose variables would have equal names.
    assert_eq!(com.write(0x12_0101, 0x3_0003, &[9, 0]), Err(0x706));
    assert_eq!(com.write(0x12_0101, 0x3_0003, &[4, 0]), Err(0x706));
    assert_eq!(com.read(0x12_0101, 0x1_0003, 2), Ok(vec![1, 0]));
}

/// Ranks count only active channels, and the objects of the platform have addresses of the first active
/// channel (ADR-11).
#[test]
fn inactive_channels_have_no_rank() {
    let model = DEFAULT_MODEL.replacen("number = 1\n", "number = 1\nactive = false\n", 1);
    let file = TestFile::new(".toml", model.as_bytes());
    let cnc = Cnc::start(&["--model", file.path()]);
    let (sda, com) = (cnc.sda(), cnc.com());
    let channel = |group| sda.ask(group, 0x48, b"V.E.channel\0");
    assert_eq!(channel(0x12_2301), Err(0x702));
    assert_eq!(channel(0x02_2301), Ok(vec![2, 0, 0, 0]));
    // As in the printed example, the rank of channel 6 decreases when a preceding channel is
    // deactivated.
    assert_eq!(channel(0x02_2302), Ok(vec![6, 0, 0, 0]));
    assert_eq!(channel(0x12_2306), Ok(vec![6, 0, 0, 0]));
    assert_eq!(channel(0x02_2303), Err(0x702));
    assert_eq!(com.read(0x12_0101, 1, 1), Err(0x702));
    assert_eq!(com.read(0x12_0102, 0x251, 4), Ok(vec![0xE8, 3, 0, 0]));
    // The first active channel lists three objects of its own, nine of its places, and two of the
    // platform.
    assert_eq!(com.read(0x13_0102, 0, 4), Ok(vec![14, 0, 0, 0]));
    assert_eq!(com.read(0x13_0106, 0, 4), Ok(vec![12, 0, 0, 0]));
    assert_eq!(sda.ask(0x12_3900, 0, &[1, 0, 0, 0, 0, 0, 0, 0]), Ok(vec![0; 8]));
}
