//! Elements of the classes of SDA and GEO.

use super::Cnc;

/// The index group and offset of an instance, for a channel and an axis.
fn find(cnc: &Cnc, group: u32, channel: u8, axis: u8) -> (u32, u32) {
    let query = [channel, 0, 0, 0, axis, 0, 0, 0];
    let reply = cnc.sda().ask(group, 0, &query).unwrap();
    assert_eq!(reply, cnc.geo().ask(group, 0, &query).unwrap());
    let number = |at: usize| u32::from_le_bytes(reply[at..at + 4].try_into().unwrap());
    assert_eq!(reply.len(), 8);
    (number(0), number(4))
}

#[test]
fn printed_addresses() {
    let cnc = Cnc::start(&[]);
    assert_eq!(find(&cnc, 0x12_3900, 1, 0), (0x12_3301, 0));
    assert_eq!(find(&cnc, 0x12_3900, 2, 0), (0x12_3302, 0));
    assert_eq!(find(&cnc, 0x12_3900, 0, 1), (0x12_3300, 0x1000));
    assert_eq!(find(&cnc, 0x12_2900, 1, 2), (0x12_2301, 0x2_0000));
}

#[test]
fn every_class_has_its_instances() {
    let cnc = Cnc::start(&[]);
    // The position controller has instances for channel 0 and axes from 1 on.
    assert_eq!(find(&cnc, 0x12_0900, 0, 1), (0x12_0300, 0x1_0000));
    assert_eq!(find(&cnc, 0x12_0900, 0, 5), (0x12_0300, 0x5_0000));
    for (channel, axis) in [(0, 0), (0, 6), (1, 0), (1, 1)] {
        assert_eq!(find(&cnc, 0x12_0900, channel, axis), (0, 0), "{channel} {axis}");
    }
    // The interpolator, the decoder and the path preparation have instances for channels and for
    // their places, including places without an axis.
    for (group, content) in [(0x12_1900, 0x12_1300), (0x12_2900, 0x12_2300), (0x12_4900, 0x12_4300)]
    {
        assert_eq!(find(&cnc, group, 6, 0), (content + 6, 0));
        assert_eq!(find(&cnc, group, 1, 3), (content + 1, 0x3_0000));
        assert_eq!(find(&cnc, group, 2, 3), (content + 2, 0x3_0000));
        for (channel, axis) in [(0, 0), (0, 1), (1, 4), (3, 0), (5, 1), (255, 0)] {
            assert_eq!(find(&cnc, group, channel, axis), (0, 0), "{channel} {axis}");
        }
    }
    // The HLD has instances for channels, for platform axes, and for platform axes of a channel.
    assert_eq!(find(&cnc, 0x12_3900, 0, 5), (0x12_3300, 0x5000));
    assert_eq!(find(&cnc, 0x12_3900, 1, 4), (0x12_3301, 0x4_0000));
    assert_eq!(find(&cnc, 0x12_3900, 6, 1), (0x12_3306, 0x1_0000));
    for (channel, axis) in [(0, 0), (0, 6), (1, 6), (3, 0)] {
        assert_eq!(find(&cnc, 0x12_3900, channel, axis), (0, 0), "{channel} {axis}");
    }
    // Spindles are counted from 0, and only addressed by index.
    assert_eq!(find(&cnc, 0x02_5900, 0, 0), (0x02_5300, 0));
    assert_eq!(find(&cnc, 0x02_5900, 1, 0), (0x02_5301, 0));
    assert_eq!(find(&cnc, 0x02_5900, 2, 0), (0, 0));
    assert_eq!(find(&cnc, 0x02_5900, 0, 1), (0, 0));
    // Addressed by rank, channel 3 is the third active channel, and channel 4 does not exist.
    assert_eq!(find(&cnc, 0x02_1900, 3, 0), (0x02_1303, 0));
    assert_eq!(find(&cnc, 0x02_1900, 4, 0), (0, 0));
    // A channel number of more than eight bits does not exist.
    let query = [1, 1, 0, 0, 0, 0, 0, 0];
    assert_eq!(cnc.sda().ask(0x12_3900, 0, &query), Ok(vec![0; 8]));
    assert_eq!(cnc.sda().ask(0x12_3900, 0, &query[..7]), Err(0x705));
    // Instances are requested at the group of instance 0 only.
    assert_eq!(cnc.sda().ask(0x12_3901, 0, &query), Err(0x702));
}

/// All attributes of the element feedhold.enable are as printed.
#[test]
fn printed_attributes() {
    let cnc = Cnc::start(&[]);
    for task in [cnc.sda(), cnc.geo()] {
        let read = |group, length| task.read(group, 1, length);
        assert_eq!(read(0x12_3301, 1), Ok(vec![1]));
        assert_eq!(read(0x12_3401, 256), Ok(b"feedhold.enable\0".to_vec()));
        assert_eq!(read(0x12_3501, 256), Ok(b"BOOLEAN\0".to_vec()));
        assert_eq!(read(0x12_3601, 4), Ok(vec![1, 0, 0, 0]));
        assert_eq!(read(0x12_3701, 256), Ok(b"-\0".to_vec()));
        assert_eq!(read(0x12_3801, 1), Ok(vec![0]));
    }
}

/// Element 0 contains the number of elements and the name of the instance, whatever the stride of axes is.
#[test]
fn the_first_element_describes_the_instance() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    for (group, offset, count, name) in [
        (0x12_3301, 0, 2, "HLD of channel 1"),
        (0x12_3300, 0x1000, 2, "HLD of platform axis 1"),
        (0x12_3301, 0x1_0000, 2, "HLD of platform axis 1"),
        (0x12_2306, 0, 6, "decoder of channel 6"),
        (0x12_2301, 0x2_0000, 2, "decoder of the axis at place 2"),
        (0x12_0300, 0x3_0000, 3, "position controller of platform axis 3"),
        (0x02_5301, 0, 2, "spindle 1"),
    ] {
        assert_eq!(sda.read(group, offset, 4), Ok(vec![count, 0, 0, 0]), "{name}");
        let named = format!("{name}\0").into_bytes();
        assert_eq!(sda.read(group + 0x100, offset, 256), Ok(named));
        assert_eq!(sda.read(group + 0x200, offset, 256), Ok(b"UNS32\0".to_vec()));
        assert_eq!(sda.read(group + 0x300, offset, 4), Ok(vec![4, 0, 0, 0]));
        assert_eq!(sda.read(group + 0x500, offset, 1), Ok(vec![0]));
        // The number of elements cannot be written. With the offset 0x1000, the request is a write
        // of the content of an element, which is read-only; with other offsets, the function
        // supports only Read.
        let rejected = if offset == 0x1000 { 0x704 } else { 0x701 };
        assert_eq!(sda.write(group, offset, &[9, 0, 0, 0]), Err(rejected));
        // No attribute has an element after the last one.
        for attribute in [0, 0x100, 0x200, 0x300, 0x400, 0x500] {
            let behind = offset + u32::from(count) + 1;
            assert_eq!(sda.read(group + attribute, behind, 256), Err(0x703), "{name}");
        }
    }
}

#[test]
fn contents_are_read_and_written() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    // The element example.feed of the HLD of channel 1: SGN16, -1500, mm/min.
    assert_eq!(sda.read(0x12_3301, 2, 2), Ok(vec![0x24, 0xFA]));
    assert_eq!(sda.read(0x12_3701, 2, 256), Ok(b"mm/min\0".to_vec()));
    assert_eq!(sda.read(0x12_3801, 2, 1), Ok(vec![1]));
    assert_eq!(sda.write(0x12_3301, 2, &[7, 0]), Ok(()));
    assert_eq!(sda.read(0x12_3301, 2, 2), Ok(vec![7, 0]));
    assert_eq!(sda.read(0x12_3302, 2, 2), Ok(vec![0x24, 0xFA]));
    assert_eq!(sda.write(0x12_3301, 2, &[7]), Err(0x705));
    assert_eq!(sda.read(0x12_3301, 2, 1), Err(0x705));
    // The element feedhold.enable is read-only, and names are never writable.
    assert_eq!(sda.write(0x12_3301, 1, &[1]), Err(0x704));
    assert_eq!(sda.write(0x12_3401, 2, b"x\0"), Err(0x701));
    // Both addresses of the HLD of a platform axis have the same content: SGN08, -21 °C.
    assert_eq!(sda.read(0x12_3300, 0x2002, 1), Ok(vec![0xEB]));
    assert_eq!(sda.read(0x12_3301, 0x2_0002, 1), Ok(vec![0xEB]));
    assert_eq!(sda.read(0x12_3700, 0x2002, 256), Ok(b"\xB0C\0".to_vec()));
    assert_eq!(sda.write(0x12_3300, 0x2001, &[0]), Ok(()));
    assert_eq!(sda.read(0x12_3306, 0x2_0001, 1), Ok(vec![0]));
    // The value of spindle 1 is 3400.0.
    assert_eq!(sda.read(0x02_5301, 1, 8), Ok(vec![0, 0, 0, 0, 0, 0x90, 0xAA, 0x40]));
    assert_eq!(sda.read(0x02_5302, 1, 8), Err(0x702));
    // A REAL32 33.5, and a STRING.
    assert_eq!(sda.read(0x12_0300, 0x1_0003, 4), Ok(vec![0, 0, 6, 0x42]));
    assert_eq!(sda.write(0x12_1301, 3, b"a.nc"), Ok(()));
    assert_eq!(sda.read(0x12_1301, 3, 32).unwrap()[..8], *b"a.nc\0\0\0\0");
    // The port of COM has no elements.
    assert_eq!(cnc.com().read(0x12_3301, 1, 1), Err(0x702));
}

/// Functions and elements of the decoder may have the same index offset (SDA-12): at the groups of
/// attributes, the offset is the element; at the group of contents, it is the function.
#[test]
fn functions_take_precedence_over_elements() {
    let cnc = Cnc::start(&[]);
    let sda = cnc.sda();
    assert_eq!(sda.read(0x12_2401, 2, 256), Ok(b"example.p_count\0".to_vec()));
    assert_eq!(sda.read(0x12_2501, 2, 256), Ok(b"UNS32\0".to_vec()));
    assert_eq!(sda.read(0x12_2301, 2, 4), Ok(vec![1, 0, 0, 0]));
    assert_eq!(sda.read(0x12_2301, 6, 4), Ok(vec![10, 0, 0, 0]));
    assert_eq!(sda.write(0x12_2301, 2, &[0; 4]), Err(0x701));
}
