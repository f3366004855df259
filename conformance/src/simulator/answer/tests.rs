use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::AdsService;
use ads_cnc::{Decode, Description, DescriptorsRef, VariableType};

use super::*;

fn cnc() -> Cnc {
    Cnc::with_default_model().unwrap()
}

fn call(group: u32, offset: u32, read_length: u32, data: &[u8]) -> Call<'_> {
    Call {
        port: AmsPort::SDA,
        service: AdsService::ReadWrite,
        index_group: IndexGroup::new(group),
        index_offset: IndexOffset::new(offset),
        read_length,
        data,
    }
}

/// Sends a request to channel 1, with a large read length.
fn ask(offset: u32, data: &[u8]) -> Result<Vec<u8>, AdsError> {
    cnc().answer(&call(0x12_2301, offset, 2048, data))
}

fn com_call(group: u32, offset: u32, read_length: u32) -> Call<'static> {
    let call = call(group, offset, read_length, &[]);
    Call { port: AmsPort::COM, service: AdsService::Read, ..call }
}

fn com(group: u32, offset: u32, read_length: u32) -> Result<Vec<u8>, AdsError> {
    cnc().answer(&com_call(group, offset, read_length))
}

fn le(numbers: &[i32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

#[test]
fn printed_examples() {
    assert_eq!(ask(0x44, b"V.E\0"), Ok(vec![123, 0, 0, 0]));
    let description =
        b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";
    assert_eq!(ask(0x45, b"\x02\0\0\0V.E\0"), Ok(description.to_vec()));
    assert_eq!(ask(0x46, b"V.E.vartest\0"), Ok(vec![4, 0, 0, 2]));
    assert_eq!(ask(0x46, b"V.E.test\0"), Ok(vec![0x34, 0x12, 0, 2]));
    let element = b"\x41\x23\x01\x20\x01\0\0\0\x04\0\0\0";
    assert_eq!(ask(0x47, element), Ok(le(&[333])));
    let array = le(&[123, 234, 345, 456, 567]);
    assert_eq!(ask(0x47, b"\x34\x12\x00\x02\0\0\0\0"), Ok(array.clone()));
    assert_eq!(ask(0x48, b"V.E.Testvar\0"), Ok(array));
    // The value follows from the array above, not from the printed 333 (E-27).
    assert_eq!(ask(0x48, b"V.E.Testvar[3]\0"), Ok(le(&[456])));
    assert_eq!(ask(0x4B, b"\x03\0\0\0V.E\0"), Ok(vec![2, 0, 0, 0, 2, 0, 0, 0]));
    for kind in [b"\0\0\0\0V.G\0", b"\0\0\0\0V.A\0"] {
        assert_eq!(ask(0x4B, kind), Ok(Vec::new()));
    }
    assert_eq!(ask(0x2_0004, b"V.A.WCS\0"), Ok(vec![0x1B, 0, 2, 1]));
    assert_eq!(ask(0x2_0005, b"V.A.WCS\0"), Ok(1234.2_f64.to_le_bytes().to_vec()));
    // The place of the first request does not exist; the name in the second request contains an
    // axis.
    assert_eq!(ask(0x4_0005, b"V.A.WCS\0"), Err(AdsError::SYMBOL_NOT_FOUND));
    assert_eq!(ask(0x2_0005, b"V.A.WCS.Y\0"), Err(AdsError::SYMBOL_NOT_FOUND));
    // On the channel interface, the name contains the axis name.
    assert_eq!(ask(0x46, b"V.A.WCS.Y\0"), Ok(vec![0x1B, 0, 2, 1]));
    assert_eq!(ask(0x48, b"V.A.WCS.Y\0"), Ok(1234.2_f64.to_le_bytes().to_vec()));

    let mut descriptor = vec![82, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0x12, 0, 3, 0, 0, 0];
    descriptor.extend(b"mc_active_single_block_r\0\0\0\0\0\0\0\0");
    descriptor.extend(b"BOOL");
    descriptor.resize(84, 0);
    assert_eq!(com(0x13_0101, 0x10, 84), Ok(descriptor));
}

#[test]
fn all_names_of_the_manual_exist() {
    for name in [
        "V.E.array_sgn32",
        "V.E.struct.array_uns32",
        "V.G.NP[0].V",
        "V.G.NP[0].V[1]",
        "V.G.NP[1].V",
        "V.G.WZ_AKT.SPDL_AX_NR",
        "V.G.array[0]",
        "V.G.array[9]",
        "V.E.trajectory.vector.x",
        "V.E.struct1[0].struct2[0].array_sgn32",
        "V.E.struct1[5].struct2[8].array_sgn32[2]",
        "V.A.ACT_POS.X",
        "V.A.WCS.Z",
    ] {
        assert!(ask(0x48, format!("{name}\0").as_bytes()).is_ok(), "{name}");
    }
}

#[test]
fn every_variable_matches_its_description() {
    let cnc = cnc();
    let mut types = std::collections::BTreeSet::new();
    for (group, counts) in
        [(0x12_2301, [123, 10, 6]), (0x12_2302, [2, 6, 2]), (0x12_2306, [2, 6, 2])]
    {
        for (kind, count) in ["V.E\0", "V.G\0", "V.A\0"].into_iter().zip(counts) {
            let number = cnc.answer(&call(group, 0x44, 4, kind.as_bytes()));
            assert_eq!(number, Ok(u32::to_le_bytes(count).to_vec()));
            for index in 0..count {
                let request = [&index.to_le_bytes(), kind.as_bytes()].concat();
                let bytes = cnc.answer(&call(group, 0x45, 2048, &request)).unwrap();
                let described = Description::decode(&bytes).unwrap();
                types.insert(described.var_type);
                let name = [described.name.text.as_bytes(), b"\0"].concat();
                let handle = cnc.answer(&call(group, 0x46, 4, &name)).unwrap();
                assert_eq!(handle, described.handle.0.to_le_bytes());
                let value = cnc.answer(&call(group, 0x48, 2048, &name)).unwrap();
                assert_eq!(u32::try_from(value.len()), Ok(described.size));
                let whole = [&handle[..], &[0; 4]].concat();
                assert_eq!(cnc.answer(&call(group, 0x47, 2048, &whole)), Ok(value));
            }
        }
    }
    assert_eq!(types, (1..=9).map(VariableType).collect());
}

#[test]
fn elements_with_several_dimensions() {
    assert_eq!(ask(0x48, b"V.E.matrix[1][0]\0"), Ok(vec![21, 0]));
    assert_eq!(ask(0x48, b"V.E.cube[1][2][3]\0"), Ok(vec![23]));
    let handle = ask(0x46, b"V.E.cube\0").unwrap();
    let indexed = |indices: &[i32]| {
        let count = i32::try_from(indices.len()).unwrap();
        ask(0x47, &[&handle[..], &le(&[count]), &le(indices)].concat())
    };
    assert_eq!(indexed(&[1, 0, 2]), Ok(vec![14]));
    for wrong in [&[1][..], &[1, 0], &[1, 0, 2, 0], &[2, 0, 0], &[0, 3, 0], &[0, 0, -1]] {
        assert_eq!(indexed(wrong), Err(AdsError::INVALID_DATA), "{wrong:?}");
    }
    let text = ask(0x48, b"V.E.texts[1]\0").unwrap();
    assert_eq!((text.len(), &text[..4]), (128, &b"two\0"[..]));
}

#[test]
fn a_rank_is_not_a_number() {
    let channel = |group| cnc().answer(&call(group, 0x48, 4, b"V.E.channel\0"));
    for (group, number) in [
        (0x12_2301, 1),
        (0x12_2302, 2),
        (0x12_2306, 6),
        (0x02_2301, 1),
        (0x02_2302, 2),
        (0x02_2303, 6),
    ] {
        assert_eq!(channel(group), Ok(le(&[number])), "{group:#x}");
    }
    for group in [0x12_2303, 0x12_2305, 0x12_23FF, 0x02_2304, 0x02_2306] {
        assert_eq!(channel(group), Err(AdsError::INVALID_GROUP), "{group:#x}");
    }
    // In this group, only elements may exist: there is no channel 0, so no function for variables
    // has this address.
    assert_eq!(channel(0x12_2300), Err(AdsError::INVALID_OFFSET));
}

#[test]
fn unknown_addresses_are_errors() {
    use AdsError as E;
    let none = b"V.E\0";
    assert_eq!(ask(0x43, none), Err(E::INVALID_OFFSET));
    assert_eq!(ask(0x4D, none), Err(E::INVALID_OFFSET));
    assert_eq!(ask(0x49, none), Err(E::SERVICE_NOT_SUPPORTED));
    assert_eq!(ask(0x4B, b"\x7b\0\0\0V.E\0"), Err(E::INVALID_DATA));
    assert_eq!(ask(0x4B, b"\0\0\0\0V.P\0"), Err(E::SYMBOL_NOT_FOUND));
    assert_eq!(cnc().answer(&call(0xF005, 0x44, 4, none)), Err(E::INVALID_GROUP));
    assert_eq!(com(0x12_0101, 0x4, 1), Err(E::INVALID_OFFSET));
    // The program stream cannot be read (STM-1).
    assert_eq!(com(0x12_0101, 0x90, 1), Err(E::SERVICE_NOT_SUPPORTED));
    let port = Call { port: AmsPort(851), ..call(0x12_2301, 0x44, 4, none) };
    assert_eq!(cnc().answer(&port), Err(E::TARGET_PORT_NOT_FOUND));
    for service in [AdsService::Read, AdsService::Write] {
        let call = Call { service, ..call(0x12_2301, 0x44, 4, none) };
        assert_eq!(cnc().answer(&call), Err(E::SERVICE_NOT_SUPPORTED));
    }
    for name in ["V.E.nobody", "V.E.struct1[0]", "V.E", "v.e.test", "V.E.test[", "V.E.test[]", ""] {
        let name = format!("{name}\0");
        assert_eq!(ask(0x46, name.as_bytes()), Err(E::SYMBOL_NOT_FOUND), "{name}");
        assert_eq!(ask(0x48, name.as_bytes()), Err(E::SYMBOL_NOT_FOUND), "{name}");
    }
    // A handle belongs to the variable, not to an element.
    assert_eq!(ask(0x46, b"V.E.test[1]\0"), Err(E::SYMBOL_NOT_FOUND));
    for name in ["V.E.test[5]\0", "V.E.test[1][1]\0", "V.E.vartest[0]\0", "V.E.matrix[1]\0"] {
        assert_eq!(ask(0x48, name.as_bytes()), Err(E::INVALID_DATA), "{name}");
    }
    assert_eq!(ask(0x47, &[9, 9, 9, 9, 0, 0, 0, 0]), Err(E::INVALID_DATA));
    for kind in ["V.P\0", "V.CYC\0", "V.E.\0", "v.e\0", "V\0"] {
        assert_eq!(ask(0x44, kind.as_bytes()), Err(E::SYMBOL_NOT_FOUND), "{kind}");
        let described = ask(0x45, format!("\0\0\0\0{kind}").as_bytes());
        assert_eq!(described, Err(E::SYMBOL_NOT_FOUND), "{kind}");
    }
    assert_eq!(ask(0x45, b"\x7B\0\0\0V.E\0"), Err(E::INVALID_DATA));
    assert_eq!(ask(0x45, b"\xFF\xFF\xFF\xFFV.E\0"), Err(E::INVALID_DATA));
}

#[test]
fn a_count_without_a_kind_is_the_sum() {
    assert_eq!(ask(0x44, b"\0"), Ok(vec![139, 0, 0, 0]));
    assert_eq!(ask(0x44, b""), Ok(vec![139, 0, 0, 0]));
    assert_eq!(ask(0x45, b"\0\0\0\0\0"), Err(AdsError::SYMBOL_NOT_FOUND));
}

#[test]
fn wrong_lengths_are_errors() {
    use AdsError as E;
    let short = |offset, length, data: &[u8]| {
        assert!(cnc().answer(&call(0x12_2301, offset, length, data)).is_ok());
        cnc().answer(&call(0x12_2301, offset, length - 1, data))
    };
    assert_eq!(short(0x44, 4, b"V.E\0"), Err(E::INVALID_SIZE));
    assert_eq!(short(0x45, 39, b"\x02\0\0\0V.E\0"), Err(E::INVALID_SIZE));
    assert_eq!(short(0x46, 4, b"V.E.test\0"), Err(E::INVALID_SIZE));
    assert_eq!(short(0x48, 20, b"V.E.test\0"), Err(E::INVALID_SIZE));
    for (offset, data) in [
        (0x44, &b"V.E"[..]),
        (0x44, b"V.E\0x"),
        (0x45, b"\x02\0\0"),
        (0x45, b"\x02\0\0\0V.E"),
        (0x46, b"V.E.test"),
        (0x46, b""),
        (0x47, b"\x34\x12\x00\x02\0\0\0"),
        (0x47, b"\x34\x12\x00\x02\x01\0\0\0"),
        (0x47, b"\x34\x12\x00\x02\xFF\xFF\xFF\xFF\x01\0\0\0"),
        (0x47, b"\x34\x12\x00\x02\0\0\0\0\x01"),
        (0x48, &[b'a'; 257]),
    ] {
        assert_eq!(ask(offset, data), Err(E::INVALID_SIZE), "{offset:#x} {data:?}");
    }
}

/// In the default model, the list of every channel contains the program stream of the channel
/// (STM-1).
#[test]
fn every_channel_lists_its_streaming_object() {
    for channel in [1, 2, 6] {
        let all = com(0x13_0100 + channel, 1, 84 * 40).unwrap();
        let name = b"mc_program_stream_w\0";
        let listed = all.chunks(84).filter(|object| object[20..].starts_with(name));
        let places: Vec<&[u8]> = listed.map(|object| &object[12..20]).collect();
        let group = 0x12_0100 + channel;
        assert_eq!(places, [&[group.to_le_bytes(), 0x90_u32.to_le_bytes()].concat()[..]]);
    }
}

#[test]
fn object_lists() {
    let count = |group| com(group, 0, 4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap()));
    // 19 objects of the channel itself, 9 of its axes, 2 of the platform.
    assert_eq!(count(0x13_0101), Ok(30));
    assert_eq!(count(0x03_0101), Ok(30));
    assert_eq!(count(0x13_0100), Ok(2));
    assert_eq!((count(0x13_0106), count(0x03_0103)), (Ok(12), Ok(12)));
    assert_eq!((count(0x13_0201), count(0x13_0205)), (Ok(3), Ok(3)));
    for absent in [0x13_0105, 0x03_0104, 0x13_0200, 0x13_0206] {
        assert_eq!(count(absent), Err(AdsError::INVALID_GROUP), "{absent:#x}");
    }
    // A group of contents, which has no object list.
    assert_eq!(count(0x12_0101), Err(AdsError::INVALID_OFFSET));
    assert_eq!(com(0x13_0101, 0, 3), Err(AdsError::INVALID_SIZE));

    let read = |first, length| com(0x13_0101, first, length).map(|bytes| bytes.len() / 84);
    assert_eq!((read(1, 84), read(1, 168), read(1, 30 * 84)), (Ok(1), Ok(2), Ok(30)));
    // The reply contains at most the existing descriptors, and one descriptor if the read length is
    // not a multiple of 84 bytes.
    assert_eq!((read(29, 4 * 84), read(1, 31 * 84), read(1, 100)), (Ok(2), Ok(30), Ok(1)));
    assert_eq!(read(1, 84 * 10_000_000), Ok(30));
    assert_eq!(read(1, 83), Err(AdsError::INVALID_SIZE));
    assert_eq!(read(31, 84), Err(AdsError::INVALID_OFFSET));
    assert_eq!(read(u32::MAX, 84), Err(AdsError::INVALID_OFFSET));

    let all = com(0x13_0101, 1, 30 * 84).unwrap();
    let platform = com(0x13_0100, 1, 2 * 84).unwrap();
    assert!(all.ends_with(&platform));
    let all = DescriptorsRef::decode(&all).unwrap();
    let at = |place: usize| {
        let object = all.get(place - 1).unwrap();
        (object.index_group().get(), object.index_offset().get(), object.name().to_string())
    };
    assert_eq!(at(17), (0x12_0101, 1, "mc_command_single_block_w".into()));
    assert_eq!(at(20), (0x12_0101, 0x1_0001, "example_position_r".into()));
    assert_eq!(at(29), (0x12_0100, 0x251, "example_platform_cycle_time_r".into()));
    let axis = com(0x13_0201, 1, 84).unwrap();
    assert_eq!(axis[12..20], [0, 2, 0x12, 0, 1, 0, 1, 0]);
}

/// Each object except the program streams can be read with the address and the length from its
/// descriptor.
#[test]
fn every_object_matches_its_descriptor() {
    let cnc = cnc();
    let mut ids = std::collections::BTreeSet::new();
    for group in [0x13_0101, 0x13_0102, 0x13_0106, 0x13_0201, 0x13_0202, 0x13_0203, 0x13_0205] {
        let list = cnc.answer(&com_call(group, 1, 30 * 84)).unwrap();
        for object in DescriptorsRef::decode(&list).unwrap().iter() {
            assert!(ids.insert(object.id()), "{}", object.id());
            let (group, offset) = (object.index_group().get(), object.index_offset().get());
            let read = cnc.answer(&com_call(group, offset, object.size()));
            match object.name().to_string().as_str() {
                "mc_program_stream_w" => assert_eq!(read, Err(AdsError::SERVICE_NOT_SUPPORTED)),
                name => {
                    assert_eq!(read.map(|bytes| bytes.len() as u32), Ok(object.size()), "{name}");
                }
            }
        }
    }
}

/// With sixteen or more platform axes, the offsets with the stride 0x1000 reach the range of the
/// offsets with the stride 0x10000.
#[test]
fn many_platform_axes() {
    let axes: String = (1..=40).map(|n| format!("[[axis]]\nname = \"A{n}\"\n")).collect();
    let model = axes
        + "[[channel]]\nnumber = 1\n[class.hld.axis]\nname = \"axis {}\"\n\
           elements = [{ name = \"n\", type = \"UNS16\", is = \"axis-number\" }]\n";
    let cnc = Cnc::new(Model::from_toml(&model, "many").unwrap());
    let query = |axis: u8| cnc.answer(&call(0x12_3900, 0, 8, &[0, 0, 0, 0, axis, 0, 0, 0]));
    assert_eq!(query(17), Ok(vec![0, 0x33, 0x12, 0, 0, 0x10, 1, 0]));
    assert_eq!(query(41), Ok(vec![0; 8]));
    let read = |group, offset, length| {
        cnc.answer(&Call { service: AdsService::Read, ..call(group, offset, length, &[]) })
    };
    for axis in 1..=40_u32 {
        let number = Ok(u16::try_from(axis).unwrap().to_le_bytes().to_vec());
        assert_eq!(read(0x12_3300, 0x1000 * axis + 1, 2), number);
        assert_eq!(read(0x12_3301, 0x1_0000 * axis + 1, 2), number);
        // Element 0 contains the number of the other elements.
        assert_eq!(read(0x12_3300, 0x1000 * axis, 4), Ok(vec![1, 0, 0, 0]));
    }
}

/// The CNC accepts packets only for the program of an active channel.
#[test]
fn packets_of_the_program_stream() {
    let write = |group| {
        let call = call(group, 0x90, 0, b"N10\r\n");
        cnc().answer(&Call { port: AmsPort::COM, service: AdsService::Write, ..call })
    };
    assert_eq!(write(0x12_0101), Ok(vec![]));
    assert_eq!(write(0x02_0103), Ok(vec![]));
    assert_eq!(write(0x12_0103), Err(AdsError::INVALID_GROUP));
}
