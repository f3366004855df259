//! The numbers that clients and servers share, each written down a second time.

use ads_cnc::address::{Attribute, Channel, Class, IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsPort, Command, StateFlags};
use ads_cnc::layout::Stream;
use ads_cnc::operation::{Call, Effect, Function, Refusal, Service, Task};
use ads_cnc::*;

/// Name, service, port, first group, offset, request, reply, requirement and section of a function.
type Row = (
    &'static str,
    Service,
    u16,
    u32,
    u32,
    Option<&'static str>,
    Option<&'static str>,
    &'static str,
    &'static str,
);

/// Every function, where the manuals put it.
#[test]
fn functions() {
    use Service::{Read, ReadWrite, Write};
    let rows: [Row; 13] = [
        (
            "number of objects",
            Read,
            553,
            0x13_0101,
            0,
            None,
            Some("object-count"),
            "COM-1",
            "2.1.1",
        ),
        (
            "object descriptors",
            Read,
            553,
            0x13_0101,
            1,
            None,
            Some("object-descriptors"),
            "COM-2",
            "2.1.1",
        ),
        (
            "number of variable elements",
            ReadWrite,
            552,
            0x12_2301,
            0x44,
            Some("variable-kind"),
            Some("variable-count"),
            "VAR-2",
            "4.3.1",
        ),
        (
            "variable description by index",
            ReadWrite,
            552,
            0x12_2301,
            0x45,
            Some("variable-index-kind"),
            Some("variable-description"),
            "VAR-4",
            "4.3.2",
        ),
        (
            "variable handle by name",
            ReadWrite,
            552,
            0x12_2301,
            0x46,
            Some("variable-name"),
            Some("variable-handle"),
            "VAR-10",
            "4.3.3",
        ),
        (
            "read variable value by handle",
            ReadWrite,
            552,
            0x12_2301,
            0x47,
            Some("variable-handle-read"),
            Some("variable-value"),
            "VAR-11",
            "4.3.4",
        ),
        (
            "read variable value by name",
            ReadWrite,
            552,
            0x12_2301,
            0x48,
            Some("variable-name"),
            Some("variable-value"),
            "VAR-14",
            "4.3.5",
        ),
        (
            "write variable value by handle",
            Write,
            552,
            0x12_2301,
            0x49,
            Some("variable-handle-write"),
            None,
            "VAR-12",
            "4.3.6",
        ),
        (
            "write variable value by name",
            Write,
            552,
            0x12_2301,
            0x4A,
            Some("variable-name-write"),
            None,
            "VAR-13",
            "4.3.7",
        ),
        (
            "extended variable description by index",
            ReadWrite,
            552,
            0x12_2301,
            0x4B,
            Some("variable-index-kind"),
            Some("variable-extended-description"),
            "VAR-15",
            "4.3.8",
        ),
        (
            "axis variable handle by name",
            ReadWrite,
            552,
            0x12_2301,
            0x2_0004,
            Some("variable-name"),
            Some("variable-handle"),
            "VAR-26",
            "4.3.9",
        ),
        (
            "read axis variable value by name",
            ReadWrite,
            552,
            0x12_2301,
            0x2_0005,
            Some("variable-name"),
            Some("variable-value"),
            "VAR-26",
            "4.3.10",
        ),
        (
            "write axis variable value by name",
            Write,
            552,
            0x12_2301,
            0x2_0006,
            Some("variable-name-write"),
            None,
            "VAR-26",
            "4.3.11",
        ),
    ];
    assert_eq!(rows.len(), Function::ALL.len());
    for (function, row) in Function::ALL.iter().zip(rows) {
        let spec = function.spec();
        let name = |stream: Option<Stream>| stream.map(|stream| stream.layout().name);
        let (service, port, group) = (spec.service, spec.task.port().0, spec.group.example().get());
        let found: Row = (
            spec.name,
            service,
            port,
            group,
            row.4,
            name(spec.request),
            name(spec.reply),
            spec.clause,
            spec.section,
        );
        assert_eq!(found, row);
        assert!(spec.offset.holds(IndexOffset::new(row.4)), "{}", spec.name);
        // What a gate lets through by itself rests on this.
        let effect = if service == Write { Effect::Write } else { Effect::Query };
        assert_eq!(spec.effect, effect, "{}", spec.name);
    }
}

/// VAR-26: the elements of the axis interface are other functions at axis 0, and none elsewhere.
#[test]
fn the_axis_interface_begins_at_axis_1() {
    let call = |offset| Call {
        port: AmsPort::SDA,
        service: Service::ReadWrite,
        index_group: IndexGroup::new(0x12_2301),
        index_offset: IndexOffset::new(offset),
        read_length: 4,
        data: b"V.A.WCS\0",
    };
    for place in [1, 2, 0xFFFF_u32] {
        let reached = call((place << 16) | 4).dispatch().unwrap();
        let operation::Request::AxisHandleByName(op) = reached else { panic!("{reached:?}") };
        assert_eq!(u32::from(op.axis.place()), place);
    }
    for absent in [4, 5, 6, 0x1_0003, 0x1_0007, 0x1_0044] {
        let refusal = Refusal::Offset(IndexOffset::new(absent));
        assert_eq!(call(absent).dispatch(), Err(refusal));
    }
}

/// Read lengths hold the longest reply there is.
#[test]
fn read_lengths() {
    use operation::*;
    let channel = Channel::new(1).unwrap();
    let name = TextRef::new("V.E.a").unwrap();
    assert_eq!(CountObjects::new(channel).read_length(), 4);
    assert_eq!(ReadDescriptors::new(channel, 1, 3).unwrap().read_length(), 252);
    assert_eq!(CountVariables::new(channel, Kind::V_E).read_length(), 4);
    assert_eq!(DescribeByIndex::new(channel, 0, Kind::V_E).read_length(), 2048);
    assert_eq!(HandleByName { channel, name }.read_length(), 4);
    assert_eq!(ReadByHandle::new(channel, Handle(1), Numbers::EMPTY).read_length(), 2048);
    assert_eq!(ReadByName { channel, name }.read_length(), 2048);
    assert_eq!(DescribeExtended::new(channel, 0, Kind::V_E).read_length(), 2048);
    assert_eq!(WriteByName::new(channel, "V.E.a", &[]).unwrap().read_length(), 0);
}

/// ADS-5, ADS-7, GEN-4: numbers of AMS and ADS.
#[test]
fn numbers_of_ads() {
    let commands = [
        (Command::READ_DEVICE_INFO, 1),
        (Command::READ, 2),
        (Command::WRITE, 3),
        (Command::READ_STATE, 4),
        (Command::WRITE_CONTROL, 5),
        (Command::ADD_NOTIFICATION, 6),
        (Command::DELETE_NOTIFICATION, 7),
        (Command::NOTIFICATION, 8),
        (Command::READ_WRITE, 9),
    ];
    assert!(commands.iter().all(|&(command, number)| command.0 == number), "{commands:?}");
    assert_eq!((StateFlags::REQUEST.0, StateFlags::RESPONSE.0), (0x0004, 0x0005));
    let errors = [
        (AdsError::NONE, 0),
        (AdsError::TARGET_PORT_NOT_FOUND, 0x6),
        (AdsError::TARGET_MACHINE_NOT_FOUND, 0x7),
        (AdsError::SERVICE_NOT_SUPPORTED, 0x701),
        (AdsError::INVALID_GROUP, 0x702),
        (AdsError::INVALID_OFFSET, 0x703),
        (AdsError::INVALID_ACCESS, 0x704),
        (AdsError::INVALID_SIZE, 0x705),
        (AdsError::INVALID_DATA, 0x706),
        (AdsError::SYMBOL_NOT_FOUND, 0x710),
    ];
    assert!(errors.iter().all(|&(error, number)| error.0 == number), "{errors:?}");
    assert_eq!((AmsPort::GEO.0, AmsPort::SDA.0, AmsPort::COM.0), (551, 552, 553));
    for task in [Task::Geo, Task::Sda, Task::Com] {
        assert_eq!(Task::from_port(task.port()), Some(task));
    }
    assert_eq!(
        [Service::Read, Service::Write, Service::ReadWrite].map(|service| service.command().0),
        [2, 3, 9]
    );
}

/// VAR-1, VAR-5, VAR-6: names and codes of variables.
#[test]
fn codes_of_variables() {
    assert_eq!(
        [Kind::V_G, Kind::V_E, Kind::V_A, Kind::ALL].map(|kind| kind.text().to_string()),
        ["V.G", "V.E", "V.A", ""]
    );
    let types = [
        (VariableType::BOOLEAN, 1, "BOOLEAN", Some(1)),
        (VariableType::SGN08, 2, "SGN08", Some(1)),
        (VariableType::UNS08, 3, "UNS08", Some(1)),
        (VariableType::SGN16, 4, "SGN16", Some(2)),
        (VariableType::UNS16, 5, "UNS16", Some(2)),
        (VariableType::SGN32, 6, "SGN32", Some(4)),
        (VariableType::UNS32, 7, "UNS32", Some(4)),
        (VariableType::REAL64, 8, "REAL64", Some(8)),
        (VariableType::STRING, 9, "STRING", None),
    ];
    for (var_type, code, name, size) in types {
        assert_eq!(
            (var_type.0, var_type.name(), var_type.element_size()),
            (code, Some(name), size)
        );
    }
    assert_eq!((VariableType(0).name(), VariableType(10).element_size()), (None, None));
    assert_eq!((VariableAccess::READ_ONLY.0, VariableAccess::READ_WRITE.0), (1, 2));
}

/// COM-2, E-08: any write access but 0 is TRUE.
#[test]
fn write_access() {
    let access = [0, 1, 2, 0x100, 0xFFFF].map(|raw| WriteAccess(raw).is_writable());
    assert_eq!(access, [false, true, true, true, true]);
}

/// GEN-5: sizes of the types of the COM task.
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

/// GEN-6, ADR-13: platform axes are counted from 1; a list of axis 0 is none.
#[test]
fn there_is_no_axis_0() {
    let call = |group| Call {
        port: AmsPort::COM,
        service: Service::Read,
        index_group: IndexGroup::new(group),
        index_offset: IndexOffset::new(0),
        read_length: 4,
        data: &[],
    };
    assert!(call(0x13_0201).dispatch().is_ok());
    for absent in [0x13_0200, 0x3_0200] {
        assert_eq!(call(absent).dispatch(), Err(Refusal::Group(IndexGroup::new(absent))));
    }
    // Nor is there a channel 0 with variables.
    let variables = Channel::new(1).unwrap().class(Class::Decoder, Attribute::Content);
    assert_eq!(variables.get() & 0xFF, 1);
    let data = b"V.E\0";
    let of_channel_0 =
        Call { port: AmsPort::SDA, service: Service::ReadWrite, data, ..call(0x12_2300) };
    assert!(matches!(of_channel_0.dispatch(), Err(Refusal::Group(_))));
}

/// A product of dimensions beyond 32 bits is no size that fits.
#[test]
fn sizes_do_not_wrap() {
    let value = ValueRef { bytes: &[] };
    let dimensions = [0x4000_0000, 4];
    let error = value.elements(VariableType::SGN32, Numbers::from(&dimensions)).unwrap_err();
    assert_eq!((error.kind(), error.expected()), (ErrorKind::Truncated, u32::MAX));
    for (code, bound) in [(0, 1), (10, 9), (u32::MAX, 9)] {
        let error = value.elements(VariableType(code), Numbers::EMPTY).unwrap_err();
        assert_eq!((error.expected(), error.found()), (bound, code));
    }
}

/// A server that sizes its answer by the count asked for is not made to allocate 4 GiB.
#[test]
fn counts_of_descriptors_are_bounded() {
    let call = Call {
        port: AmsPort::COM,
        service: Service::Read,
        index_group: IndexGroup::new(0x13_0101),
        index_offset: IndexOffset::new(1),
        read_length: u32::MAX - 3,
        data: &[],
    };
    let Ok(operation::Request::ReadDescriptors(read)) = call.dispatch() else { panic!("{call:?}") };
    assert_eq!(read.count(), operation::ReadDescriptors::COUNT_MAX);
    assert_eq!(operation::Operation::read_length(&read), u32::MAX - 3);
}
