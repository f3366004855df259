//! Numbers that clients and servers must agree on. The tests repeat the numbers of ports and
//! services, and sizes; a snapshot contains the numbers of functions.

use ads_cnc::address::{Attribute, Channel, Class, IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::layout::Stream;
use ads_cnc::operation::AdsService::{Read, ReadWrite, Write};
use ads_cnc::operation::{Call, CountDynamic, DispatchError, Effect, Function, Operation, Task};
use ads_cnc::*;

use super::common::CALLS;

/// A snapshot contains the row of each function in the table of functions, and the read length of a
/// call. By the effect in the row, a gateway may decide which calls to permit.
#[test]
fn functions_are_where_the_manuals_put_them() {
    let mut shown = String::new();
    for function in Function::ALL.iter().copied() {
        let spec = function.spec();
        let sample = CALLS.iter().find(|sample| sample.function == function).unwrap();
        let mut buf = [0; 256];
        let request = sample.call.dispatch().unwrap();
        let length = request.encode(&mut buf).unwrap().read_length;
        let name = |stream: Option<Stream>| stream.map_or("nothing", |stream| stream.layout().name);
        shown +=
            &format!("{}: {} to {:?}, {:?}\n", spec.name, spec.service, spec.task, spec.effect);
        shown +=
            &format!("    at {} ({:?}), {:x?}\n", spec.group.example(), spec.group, spec.offset);
        shown += &format!("    {} in, {} out, ", name(spec.request), name(spec.reply));
        shown += &format!("at most {length} bytes; {}, {}\n", spec.clause, spec.section);
        assert_eq!(spec.effect == Effect::Query, spec.service != Write, "{}", spec.name);
        assert!(spec.offset.contains(sample.call.index_offset), "{}", spec.name);
    }
    insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
        insta::assert_snapshot!("functions", shown);
    });
}

/// Exactly these functions write, and they have these effects.
#[test]
fn writes_have_these_effects() {
    let writes = Function::ALL.iter().filter(|it| it.spec().effect != Effect::Query);
    let writes: Vec<_> = writes.map(|it| (*it, it.spec().effect)).collect();
    let wanted = [
        (Function::WriteByHandle, Effect::Write),
        (Function::WriteByName, Effect::Write),
        (Function::AxisWriteByName, Effect::Write),
        (Function::WriteElement, Effect::Motion),
        (Function::WriteProgramStream, Effect::Motion),
        (Function::WriteObject, Effect::Motion),
    ];
    assert_eq!(writes, wanted);
}

/// Each function of dynamic parameters has four offsets, one for each kind.
#[test]
fn offsets_of_dynamic_parameters() {
    let offsets = |function: Function| -> Vec<u32> {
        let rule = function.spec().offset;
        (0..0x100).filter(|&offset| rule.contains(IndexOffset::new(offset))).collect()
    };
    assert_eq!(offsets(Function::CountDynamic), [0x02, 0x03, 0x04, 0x05]);
    assert_eq!(offsets(Function::DynamicNameByIndex), [0x1B, 0x1E, 0x21, 0x24]);
    assert_eq!(offsets(Function::DynamicValueByName), [0x1C, 0x1F, 0x22, 0x25]);
    assert_eq!(offsets(Function::DynamicValueByIndex), [0x1D, 0x20, 0x23, 0x26]);

    let channel = Channel::new(1).unwrap();
    for (kind, count, name) in [
        (DynamicKind::P, 0x02, "P"),
        (DynamicKind::VL, 0x03, "V.L"),
        (DynamicKind::VP, 0x04, "V.P"),
        (DynamicKind::VS, 0x05, "V.S"),
    ] {
        let count = IndexOffset::new(count);
        assert_eq!(CountDynamic::new(channel, kind).index_offset(), count);
        assert_eq!(kind.to_string(), name);
    }
}

/// The functions of the axis interface have the elements 4 to 6 of the axes from 1 on. With axis 0,
/// these offsets belong to other functions or to none (VAR-26).
#[test]
fn the_axis_interface_begins_at_axis_1() {
    let call = |offset| Call {
        port: AmsPort::SDA,
        service: ReadWrite,
        index_group: IndexGroup::new(0x12_2301),
        index_offset: IndexOffset::new(offset),
        read_length: 4,
        data: b"V.A.WCS\0",
    };
    for place in [1, 2, 0xFFFF_u32] {
        let reached = call((place << 16) | 4).dispatch().unwrap();
        let operation::Request::AxisHandleByName(op) = reached else { panic!("{reached:?}") };
        assert_eq!(u32::from(op.axis.index()), place);
    }
    for absent in [6, 0x1_0003, 0x1_0007, 0x1_0044] {
        let error_of = DispatchError::Offset(IndexOffset::new(absent));
        assert_eq!(call(absent).dispatch(), Err(error_of));
    }
    // With axis 0, the elements 4 and 5 are counts of dynamic parameters, which require Read.
    for count in [4, 5] {
        let error_of = DispatchError::Service { expected: Read, found: ReadWrite };
        assert_eq!(call(count).dispatch(), Err(error_of));
    }
}

/// Ports, tasks and services have the documented numbers (GEN-4, ADS-5). `codes.rs` tests those of
/// commands, state flags and errors.
#[test]
fn numbers_of_ads() {
    assert_eq!((AmsPort::GEO.0, AmsPort::SDA.0, AmsPort::COM.0), (551, 552, 553));
    for task in [Task::Geo, Task::Sda, Task::Com] {
        assert_eq!(Task::from_port(task.port()), Some(task));
    }
    assert_eq!([Read, Write, ReadWrite].map(|service| service.command().0), [2, 3, 9]);
}

/// Kinds of variables have the documented texts (VAR-1), and an undocumented type has no name and no
/// size. `codes.rs` tests the numbers and names of types and accesses.
#[test]
fn codes_of_variables() {
    assert_eq!(
        [Kind::V_G, Kind::V_E, Kind::V_A, Kind::ALL].map(|kind| kind.text().to_string()),
        ["V.G", "V.E", "V.A", ""]
    );
    assert_eq!((VariableType(0).name(), VariableType(10).element_size()), (None, None));
}

/// Any write access and any write flag except 0 is TRUE (COM-2, SDA-9, E-08).
#[test]
fn any_write_access_but_0_is_true() {
    let flags = [0, 1, 2, 0xFF].map(|raw| sda::ElementWriteFlag(raw).is_writable());
    assert_eq!(flags, [false, true, true, true]);
    let access = [0, 1, 2, 0x100, 0xFFFF].map(|raw| WriteAccess(raw).is_writable());
    assert_eq!(access, [false, true, true, true, true]);
}

/// The types of the COM task have these sizes; STRING and names that are not those of a type have
/// no known size (GEN-5).
#[test]
fn types_of_com() {
    let sizes = [
        ("BOOL BYTE SINT", Some(1)),
        ("WORD INT", Some(2)),
        ("DWORD DINT REAL", Some(4)),
        ("LWORD LINT LREAL", Some(8)),
        ("STRING UDINT bool", None),
    ];
    for (names, size) in sizes {
        for name in names.split(' ') {
            assert_eq!(Descriptor::new("a", name).unwrap().type_size(), size, "{name}");
        }
    }
}

/// Platform axes are counted from 1, and axis 0 has no list of objects (GEN-6, ADR-13).
#[test]
fn axis_0_is_rejected() {
    let call = |group| Call {
        port: AmsPort::COM,
        service: Read,
        index_group: IndexGroup::new(group),
        index_offset: IndexOffset::new(0),
        read_length: 4,
        data: &[],
    };
    assert!(call(0x13_0201).dispatch().is_ok());
    for absent in [0x13_0200, 0x3_0200] {
        assert_eq!(call(absent).dispatch(), Err(DispatchError::Group(IndexGroup::new(absent))));
    }
    // Channel 0 has no functions for variables.
    let variables = Channel::new(1).unwrap().class(Class::Decoder, Attribute::Content);
    assert_eq!(variables.get() & 0xFF, 1);
    let data = b"V.E\0";
    let of_channel_0 = Call {
        port: AmsPort::SDA,
        service: ReadWrite,
        index_offset: IndexOffset::new(0x44),
        data,
        ..call(0x12_2300)
    };
    assert!(matches!(of_channel_0.dispatch(), Err(DispatchError::Offset(_))));
}

/// The count of descriptors in a dispatched request is limited, so that a server that allocates
/// memory by this count does not allocate 4 GiB.
#[test]
fn counts_of_descriptors_are_bounded() {
    let call = Call {
        port: AmsPort::COM,
        service: Read,
        index_group: IndexGroup::new(0x13_0101),
        index_offset: IndexOffset::new(1),
        read_length: u32::MAX - 3,
        data: &[],
    };
    let Ok(operation::Request::ReadDescriptors(read)) = call.dispatch() else { panic!("{call:?}") };
    assert_eq!(read.count(), operation::ReadDescriptors::COUNT_MAX);
    assert_eq!(read.read_length(), u32::MAX - 3);
}
