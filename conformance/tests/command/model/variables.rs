//! Writes of variables of the simulated CNC, and their extended descriptions.

use super::{CHANNEL_1, Cnc};

/// Five SGN32 values: 123 234 345 456 567. `COUNTED` contains 1 2 3 4 5.
const PRINTED: &[u8] = &[123, 0, 0, 0, 234, 0, 0, 0, 89, 1, 0, 0, 200, 1, 0, 0, 55, 2, 0, 0];
const COUNTED: &[u8] = &[1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0, 5, 0, 0, 0];

#[test]
fn printed_writes() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    let test = || sda.ask(CHANNEL_1, 0x48, b"V.E.test\0").unwrap();
    // Element 4 is set to 123, by handle and by name; then the whole value is written again.
    for (offset, request) in [
        (0x49, &b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7B\0\0\0"[..]),
        (0x4A, b"V.E.test[4]\0\x7B\0\0\0"),
    ] {
        assert_eq!(sda.write(CHANNEL_1, offset, request), Ok(()));
        assert_eq!(test(), [&PRINTED[..16], &[123, 0, 0, 0]].concat());
        let whole = [b"\x34\x12\0\x02\0\0\0\0", PRINTED].concat();
        assert_eq!(sda.write(CHANNEL_1, 0x49, &whole), Ok(()));
        assert_eq!(test(), PRINTED);
    }
    assert_eq!(sda.write(CHANNEL_1, 0x4A, &[b"V.E.test\0", COUNTED].concat()), Ok(()));
    assert_eq!(test(), COUNTED);
    // The writes did not change V.E.Testvar.
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.E.Testvar\0"), Ok(PRINTED.to_vec()));
    // V.A.WCS of the second axis is set to 123.456.
    let value = [0x77, 0xBE, 0x9F, 0x1A, 0x2F, 0xDD, 0x5E, 0x40];
    assert_eq!(sda.write(CHANNEL_1, 0x2_0006, &[b"V.A.WCS\0", &value[..]].concat()), Ok(()));
    assert_eq!(sda.ask(CHANNEL_1, 0x2_0005, b"V.A.WCS\0"), Ok(value.to_vec()));
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.A.WCS.Y\0"), Ok(value.to_vec()));
    assert_eq!(sda.ask(CHANNEL_1, 0x47, b"\x1B\0\x02\x01\0\0\0\0"), Ok(value.to_vec()));
    // A read over the axis interface returns the value that was written over the channel interface.
    assert_eq!(sda.write(CHANNEL_1, 0x4A, b"V.A.WCS.X\0\0\0\0\0\0\0\0\0"), Ok(()));
    assert_eq!(sda.ask(CHANNEL_1, 0x1_0005, b"V.A.WCS\0"), Ok(vec![0; 8]));
}

#[test]
fn every_type_is_written() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    for (name, value) in [
        ("V.E.boolean", &[0][..]),
        ("V.E.sgn08", &[0x7F]),
        ("V.E.uns08", &[1]),
        ("V.E.sgn16", &[0xFE, 0xFF]),
        ("V.E.uns16", &[1, 2]),
        ("V.E.sgn32", &[1, 2, 3, 0x80]),
        ("V.E.uns32", &[1, 2, 3, 4]),
        // A NaN with a payload, which must be stored unchanged.
        ("V.E.real64", &[1, 2, 3, 4, 5, 6, 0xF8, 0x7F]),
        ("V.E.matrix[1][2]", &[0x34, 0x12]),
        ("V.E.cube[1][2][3]", &[0xAA]),
        ("V.G.NP[0].V[1]", &[0, 0, 0, 0, 0, 0, 0xF0, 0x3F]),
        ("V.CYC.count", &[9, 0, 0, 0]),
        ("V.CYC.matrix[1][0]", &[0, 0, 0, 0, 0, 0, 0xF0, 0x3F]),
    ] {
        let name = format!("{name}\0");
        let request = [name.as_bytes(), value].concat();
        assert_eq!(sda.write(CHANNEL_1, 0x4A, &request), Ok(()), "{name}");
        assert_eq!(sda.ask(CHANNEL_1, 0x48, name.as_bytes()), Ok(value.to_vec()), "{name}");
    }
    // The matrix is 11 12 13, 21 22 0x1234: only the written element has changed.
    let matrix = vec![11, 0, 12, 0, 13, 0, 21, 0, 22, 0, 0x34, 0x12];
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.E.matrix\0"), Ok(matrix));
}

/// A text may be shorter than its declared size, which must have room for the text and a NUL.
#[test]
fn texts_are_written() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    let write = |request: &[u8]| sda.write(CHANNEL_1, 0x4A, request);
    let read = |name: &[u8]| sda.ask(CHANNEL_1, 0x48, name).unwrap();
    assert_eq!(write(b"V.E.text\0new\x80\0"), Ok(()));
    assert_eq!(read(b"V.E.text\0"), b"new\x80\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0");
    // 20 characters and a NUL fit into the declared 21 bytes; 21 characters do not.
    assert_eq!(write(b"V.E.text\0aaaaaaaaaaaaaaaaaaaa"), Ok(()));
    assert_eq!(read(b"V.E.text\0"), b"aaaaaaaaaaaaaaaaaaaa\0");
    assert_eq!(write(b"V.E.text\0aaaaaaaaaaaaaaaaaaaaa"), Err(0x705));
    assert_eq!(write(b"V.E.text\0aaaaaaaaaaaaaaaaaaaaa\0"), Err(0x705));
    // A text in an array may be shorter, too, but the whole array must be written with its size.
    assert_eq!(write(b"V.E.texts[2]\0third\0"), Ok(()));
    assert_eq!(read(b"V.E.texts[2]\0")[..7], *b"third\0\0");
    assert_eq!(read(b"V.E.texts[1]\0")[..5], *b"two\0\0");
    assert_eq!(write(b"V.E.texts\0one\0"), Err(0x705));
    assert_eq!(write(&[b"V.E.texts\0", &[0; 384][..]].concat()), Ok(()));
    assert_eq!(read(b"V.E.texts\0"), [0; 384]);
}

#[test]
fn invalid_writes_are_rejected() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    let by_name = |request: &[u8]| sda.write(CHANNEL_1, 0x4A, request);
    let by_handle = |request: &[u8]| sda.write(CHANNEL_1, 0x49, request);
    // The size is wrong: that of a whole value, that of an element, and no bytes at all.
    assert_eq!(by_name(b"V.E.test\0\x7B\0\0\0"), Err(0x705));
    assert_eq!(by_name(b"V.E.test[4]\0\x7B\0\0"), Err(0x705));
    assert_eq!(by_name(b"V.E.test[4]\0\x7B\0\0\0\0"), Err(0x705));
    assert_eq!(by_name(b"V.E.test[4]\0"), Err(0x705));
    assert_eq!(by_name(b"V.E.test[4]"), Err(0x705));
    assert_eq!(by_handle(b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7B\0\0"), Err(0x705));
    assert_eq!(by_handle(b"\x34\x12\0\x02\0\0\0\0\x7B\0\0\0"), Err(0x705));
    // Read-only variables are rejected over each interface.
    assert_eq!(by_name(b"V.E.Variable_3\0\0\0"), Err(0x704));
    assert_eq!(by_name(b"V.E.Variable_3[0]\0\0"), Err(0x704));
    assert_eq!(by_handle(b"\x02\0\0\x02\0\0\0\0\0\0"), Err(0x704));
    assert_eq!(by_name(b"V.A.ACT_POS.X\0\0\0\0\0\0\0\0\0"), Err(0x704));
    assert_eq!(sda.write(CHANNEL_1, 0x1_0006, b"V.A.ACT_POS\0\0\0\0\0\0\0\0\0"), Err(0x704));
    // Handles, names and elements that do not exist are rejected.
    assert_eq!(by_handle(b"\xFF\xFF\xFF\x7F\0\0\0\0\0"), Err(0x706));
    assert_eq!(by_name(b"V.E.nobody\0\0"), Err(0x710));
    assert_eq!(by_name(b"V.A.WCS\0\0\0\0\0\0\0\0\0"), Err(0x710));
    assert_eq!(sda.write(CHANNEL_1, 0x1_0006, b"V.A.WCS.X\0\0\0\0\0\0\0\0\0"), Err(0x710));
    assert_eq!(sda.write(CHANNEL_1, 0x1_0006, b"V.E.test\0\0"), Err(0x710));
    assert_eq!(sda.write(CHANNEL_1, 0x4_0006, b"V.A.WCS\0\0\0\0\0\0\0\0\0"), Err(0x710));
    assert_eq!(by_name(b"V.E.test[5]\0\x7B\0\0\0"), Err(0x706));
    assert_eq!(by_handle(b"\x34\x12\0\x02\x01\0\0\0\x05\0\0\0\x7B\0\0\0"), Err(0x706));
    // The rejected writes have changed nothing.
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.E.test\0"), Ok(PRINTED.to_vec()));
    assert_eq!(sda.ask(CHANNEL_1, 0x48, b"V.E.Variable_3\0"), Ok(vec![1, 0]));
}

/// A handle is only valid for its channel.
#[test]
fn handles_of_another_channel_are_rejected() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    let with_header = |handle: &[u8]| [handle, &[0; 4]].concat();
    for name in [&b"V.E.channel\0"[..], b"V.G.channel\0", b"V.A.ACT_POS.X\0"] {
        let handles = [0x12_2301, 0x12_2302, 0x12_2306].map(|group| {
            let handle = sda.ask(group, 0x46, name).unwrap();
            assert!(sda.ask(group, 0x47, &with_header(&handle)).is_ok());
            handle
        });
        for group in [0x12_2302, 0x12_2306] {
            assert_eq!(sda.ask(group, 0x47, &with_header(&handles[0])), Err(0x706));
        }
        assert_eq!(sda.ask(CHANNEL_1, 0x47, &with_header(&handles[1])), Err(0x706));
    }
    let handle = sda.ask(0x12_2302, 0x46, b"V.E.array\0").unwrap();
    let write = [&handle[..], &[0; 4], &[7; 8]].concat();
    assert_eq!(sda.write(0x12_2306, 0x49, &write), Err(0x706));
    assert_eq!(sda.write(0x12_2302, 0x49, &write), Ok(()));
    assert_eq!(sda.ask(0x12_2302, 0x48, b"V.E.array\0"), Ok(vec![7; 8]));
    assert_eq!(sda.ask(0x12_2306, 0x48, b"V.E.array\0"), Ok(vec![6, 0, 0, 0, 6, 0, 0, 0]));
}

#[test]
fn each_variable_has_its_own_extended_description() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    // The printed example: the variable with index 3.
    assert_eq!(sda.ask(CHANNEL_1, 0x4B, b"\x03\0\0\0V.E\0"), Ok(vec![2, 0, 0, 0, 2, 0, 0, 0]));
    // V.E.real64 has index 28; it is not synchronised, and is valid for its channel.
    let described = sda.ask(CHANNEL_1, 0x45, b"\x1C\0\0\0V.E\0").unwrap();
    assert!(described.ends_with(b"V.E.real64\0"), "{described:?}");
    assert_eq!(sda.ask(CHANNEL_1, 0x4B, b"\x1C\0\0\0V.E\0"), Ok(vec![1, 0, 0, 0, 1, 0, 0, 0]));
    assert_eq!(sda.ask(CHANNEL_1, 0x4B, b"\0\0\0\0V.G\0"), Ok(vec![]));
    assert_eq!(sda.ask(CHANNEL_1, 0x4B, b"\0\0\0\0V.A\0"), Ok(vec![]));
    assert_eq!(sda.ask(CHANNEL_1, 0x4B, b"\x7B\0\0\0V.E\0"), Err(0x706));
}
