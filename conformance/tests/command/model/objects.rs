//! Contents of COM objects of the simulated CNC.

use super::Cnc;

#[test]
fn contents_are_read_and_written() {
    let cnc = Cnc::start(&[]);
    let com = cnc.com();
    // The printed objects mc_active_single_block_r and mc_command_single_block_w.
    assert_eq!(com.read(0x12_0101, 3, 1), Ok(vec![0]));
    assert_eq!(com.write(0x12_0101, 1, &[1]), Ok(()));
    assert_eq!(com.read(0x12_0101, 1, 1), Ok(vec![1]));
    // The address by rank is the same object, and channel 2 has an object of its own.
    assert_eq!(com.read(0x02_0101, 1, 1), Ok(vec![1]));
    assert_eq!(com.read(0x12_0102, 1, 1), Ok(vec![0]));
    // A longer read returns the whole content.
    assert_eq!(com.read(0x12_0101, 1, 100), Ok(vec![1]));

    // An LREAL 1234.5678, a REAL 1.5, an LWORD, and a CP1252 text with its padding NULs.
    let real = [0xAD, 0xFA, 0x5C, 0x6D, 0x45, 0x4A, 0x93, 0x40];
    assert_eq!(com.read(0x12_0101, 0x1A, 8), Ok(real.to_vec()));
    assert_eq!(com.read(0x12_0101, 0x19, 4), Ok(vec![0, 0, 0xC0, 0x3F]));
    let word = [0xEF, 0xCD, 0xAB, 0x89, 0x67, 0x45, 0x23, 0x01];
    assert_eq!(com.read(0x12_0101, 0x17, 8), Ok(word.to_vec()));
    let text = b"L\xE4nge 5\x80\0\0\0\0\0\0\0\0\0\0\0\0\0";
    assert_eq!(com.read(0x12_0101, 0x1B, 21), Ok(text.to_vec()));
    assert_eq!(com.write(0x12_0101, 0x1A, &[0; 8]), Ok(()));
    assert_eq!(com.read(0x12_0101, 0x1A, 8), Ok(vec![0; 8]));
    // A written text may be shorter than the size of the content.
    assert_eq!(com.write(0x12_0101, 0x1D, b"short\0"), Ok(()));
    let mut text = b"short\0".to_vec();
    text.resize(128, 0);
    assert_eq!(com.read(0x12_0101, 0x1D, 128), Ok(text));
}

#[test]
fn invalid_accesses_are_rejected() {
    let cnc = Cnc::start(&[]);
    let com = cnc.com();
    // A write of a read-only object is rejected as such, whatever its size is.
    assert_eq!(com.write(0x12_0101, 3, &[1]), Err(0x704));
    assert_eq!(com.write(0x12_0101, 3, &[1, 2]), Err(0x704));
    // A write and a read with a wrong size, and a text without a NUL, are rejected.
    assert_eq!(com.write(0x12_0101, 1, &[]), Err(0x705));
    assert_eq!(com.write(0x12_0101, 1, &[1, 0]), Err(0x705));
    assert_eq!(com.write(0x12_0101, 0x1D, &[b'x'; 128]), Err(0x705));
    assert_eq!(com.write(0x12_0101, 0x1D, &[0; 129]), Err(0x705));
    assert_eq!(com.read(0x12_0101, 0x1A, 7), Err(0x705));
    assert_eq!(com.read(0x12_0101, 1, 1), Ok(vec![0]));
    // Objects, places, axes and channels that do not exist are rejected.
    assert_eq!(com.read(0x12_0101, 4, 1), Err(0x703));
    assert_eq!(com.write(0x12_0101, 4, &[1]), Err(0x703));
    assert_eq!(com.read(0x12_0101, 0x1_0004, 1), Err(0x703));
    assert_eq!(com.read(0x12_0101, 0x4_0001, 8), Err(0x703));
    assert_eq!(com.read(0x12_0206, 1, 8), Err(0x702));
    assert_eq!(com.read(0x12_0200, 0x6_0001, 8), Err(0x703));
    assert_eq!(com.read(0x12_0200, 1, 8), Err(0x703));
    assert_eq!(com.read(0x12_0105, 1, 1), Err(0x702));
    assert_eq!(com.read(0x02_0104, 1, 1), Err(0x702));
    // The port of another task does not have the objects.
    assert_eq!(cnc.sda().read(0x12_0101, 3, 1), Err(0x702));
}

/// The objects of the platform have the addresses of channel 0 and of the first channel (COM-4).
#[test]
fn the_platform_has_two_addresses() {
    let cnc = Cnc::start(&[]);
    let com = cnc.com();
    for group in [0x12_0100, 0x12_0101, 0x02_0100, 0x02_0101] {
        assert_eq!(com.read(group, 0x251, 4), Ok(vec![0xE8, 3, 0, 0]), "{group:#x}");
    }
    assert_eq!(com.read(0x12_0102, 0x251, 4), Err(0x703));
    // The objects of channel 1 do not have addresses of channel 0.
    assert_eq!(com.read(0x12_0100, 3, 1), Err(0x703));
}

/// The number of a platform axis is in the group or in the offset (E-04). The axis at a place of a
/// channel has other objects than the platform axis.
#[test]
fn platform_axes() {
    let cnc = Cnc::start(&[]);
    let com = cnc.com();
    // The values are 100.25 and -200.5.
    let x = vec![0, 0, 0, 0, 0, 0x10, 0x59, 0x40];
    let y = vec![0, 0, 0, 0, 0, 0x10, 0x69, 0xC0];
    assert_eq!(com.read(0x12_0200, 0x1_0001, 8), Ok(x.clone()));
    assert_eq!(com.read(0x12_0201, 1, 8), Ok(x.clone()));
    assert_eq!(com.read(0x12_0202, 1, 8), Ok(y.clone()));
    assert_eq!(com.read(0x12_0205, 3, 2), Ok(vec![5, 0]));
    assert_eq!(com.read(0x12_0101, 0x1_0001, 8), Ok(x));
    assert_eq!(com.read(0x12_0101, 0x2_0001, 8), Ok(y));
    assert_eq!(com.write(0x12_0202, 2, &[1]), Ok(()));
    assert_eq!(com.read(0x12_0200, 0x2_0002, 1), Ok(vec![1]));
    assert_eq!(com.read(0x12_0201, 2, 1), Ok(vec![0]));
}

/// The sizes and write access of objects agree with their descriptors.
#[test]
fn objects_agree_with_their_descriptors() {
    let cnc = Cnc::start(&[]);
    let com = cnc.com();
    for group in [0x13_0101, 0x13_0205] {
        let number = com.read(group, 0, 4).unwrap()[0];
        for index in 1..=u32::from(number) {
            let object = com.read(group, index, 84).unwrap();
            let field = |at: usize| u32::from_le_bytes(object[at..at + 4].try_into().unwrap());
            let (size, writable) = (field(4) as usize, object[8] == 1);
            let (group, offset) = (field(12), field(16));
            if offset == 0x90 {
                // The program stream can only be written.
                assert_eq!(com.read(group, offset, 1), Err(0x701));
                continue;
            }
            let content = com.read(group, offset, size).unwrap();
            assert_eq!(content.len(), size, "{index} of {group:#x}");
            let written = if writable { Ok(()) } else { Err(0x704) };
            assert_eq!(com.write(group, offset, &content), written, "{index} of {group:#x}");
            assert_eq!(com.read(group, offset, size), Ok(content));
        }
    }
}
