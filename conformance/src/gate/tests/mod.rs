use ads_cnc::Encode as _;
use ads_cnc::address::{
    Attribute, Channel, ChannelAxis, Class, ElementAddress, IndexGroup, IndexOffset,
};
use ads_cnc::ads::{AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef};
use ads_cnc::operation::{
    AdsService, AxisWriteByName, Call, Request, WriteByName, WriteElement, WriteObject,
    WriteProgramStream,
};

use super::*;

mod observed;

const TARGET: AmsNetId = AmsNetId([192, 0, 2, 7, 1, 1]);
const SOURCE: AmsAddr = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8000) };

/// The time of most checks: half an hour before the files of these tests expire.
fn now() -> Moment {
    Moment::from_rfc3339("2026-05-04T15:00:00Z").unwrap()
}

fn file(tables: &str) -> String {
    format!("target = \"{TARGET}\"\nexpires = 2026-05-04T17:30:00+02:00\n{tables}")
}

fn gate(tables: &str) -> Gate {
    Gate::queries().with_allowed(Some(Allowed::from_toml(&file(tables)).unwrap()))
}

/// A gate with a file that has no entries, but permits malformed requests.
fn malformed() -> Gate {
    gate("malformed = true").and_malformed()
}

fn frame(command: Command, port: AmsPort, data: &[u8]) -> Vec<u8> {
    let header = AmsHeader::request(AmsAddr { net_id: TARGET, port }, SOURCE, command, 1);
    FrameRef::new(header, data).unwrap().encode_to_vec().unwrap()
}

fn call(call: &Call<'_>) -> Vec<u8> {
    frame(call.service.command(), call.port, &call.encode_to_vec().unwrap())
}

fn request<'a>(request: impl Into<Request<'a>>) -> Vec<u8> {
    let request = request.into();
    let mut buf = vec![0; request.encoded_len()];
    call(&request.encode(&mut buf).unwrap())
}

fn at(port: AmsPort, service: AdsService, group: u32, offset: u32, data: &[u8]) -> Vec<u8> {
    call(&Call {
        port,
        service,
        index_group: IndexGroup::new(group),
        index_offset: IndexOffset::new(offset),
        read_length: if service == AdsService::Write { 0 } else { 4 },
        data,
    })
}

fn channel(number: u32) -> Channel {
    Channel::new(number).unwrap()
}

fn by_name(name: &str) -> Vec<u8> {
    request(WriteByName::new(channel(1), name, &[1][..]).unwrap())
}

fn element() -> ElementAddress {
    ElementAddress::for_channel(channel(1), Class::Hld, 1).unwrap()
}

/// A request for each function that writes, except for a write by a handle, with the table of the
/// file that allows the request.
fn writes() -> Vec<(Vec<u8>, &'static str)> {
    let (group, offset) = (IndexGroup::new(0x12_0101), IndexOffset::new(1));
    let axis = ChannelAxis::new(2).unwrap();
    vec![
        (by_name("V.E.a"), "[[variable]]\nchannel = 1\nname = \"V.E.a\""),
        (
            request(AxisWriteByName::new(channel(1), axis, "V.A.a", &[1][..]).unwrap()),
            "[[variable]]\nchannel = 1\naxis = 2\nname = \"V.A.a\"",
        ),
        (
            request(WriteElement::new(element(), &[1][..]).unwrap()),
            "[[element]]\ngroup = 0x123301\noffset = 0x1",
        ),
        (
            request(WriteObject::new(group, offset, &[1][..]).unwrap()),
            "[[object]]\ngroup = 0x120101\noffset = 0x1",
        ),
        (request(WriteProgramStream::new(channel(1), b"M30\r\n")), "[[stream]]\nchannel = 1"),
    ]
}

#[test]
fn only_queries_pass_by_default() {
    for function in Function::ALL {
        let spec = function.spec();
        if spec.effect != Effect::Query {
            continue;
        }
        // The gate must allow the address only at the documented ports of its function, and there
        // with at least one of the items of `data`.
        let offset = match spec.offset {
            ads_cnc::operation::OffsetRule::At(at) => at,
            ads_cnc::operation::OffsetRule::OfKind([first, ..]) => first,
            ads_cnc::operation::OffsetRule::AtLeast(first) => first.max(1),
            ads_cnc::operation::OffsetRule::OfAxis(element) => 0x1_0000 | element,
            _ => 0,
        };
        let data: &[&[u8]] = &[b"", b"V.E\0", b"\x01\0\0\0V.E\0", &[1, 0, 0, 0], &[0; 8]];
        let passes = |port| {
            data.iter().any(|data| {
                let data = if spec.service == AdsService::Read { b"" } else { *data };
                let group = spec.group.example().get();
                check(&call(&Call {
                    port,
                    service: spec.service,
                    index_group: IndexGroup::new(group),
                    index_offset: IndexOffset::new(offset),
                    read_length: 84,
                    data,
                }))
                .is_ok_and(|permit| permit.is_repeatable())
            })
        };
        assert!(passes(spec.task.port()), "{}", spec.name);
        for port in [1, 550, 551, 552, 553, 554, 851, 10000].map(AmsPort) {
            // Section 2.2 of the manual documents its functions for both SDA and GEO.
            let of_geo = port == AmsPort::GEO && spec.section.starts_with("2.2");
            let documented = port == spec.task.port() || of_geo;
            assert_eq!(passes(port), documented, "{} at {port}", spec.name);
        }
    }
    for (frame, _) in writes() {
        assert!(check(&frame).is_err());
    }
    for port in [551, 552, 553] {
        assert!(check(&frame(Command::READ_STATE, AmsPort(port), &[])).is_ok());
        assert!(check(&frame(Command::READ_DEVICE_INFO, AmsPort(port), &[])).is_ok());
        assert!(check(&frame(Command::READ_STATE, AmsPort(port), &[0])).is_err());
    }
    assert!(check(&frame(Command::READ_STATE, AmsPort(10000), &[])).is_err());
}

#[test]
fn some_requests_are_never_allowed() {
    let everything = "[[stream]]\nchannel = 1\n[[object]]\ngroup = 0x120101\noffset = 1";
    let sda = AmsPort::SDA;
    let never = [
        // WriteControl to the state RUN, notifications, and sum commands
        frame(Command::WRITE_CONTROL, AmsPort::COM, &[5, 0, 0, 0, 0, 0, 0, 0]),
        frame(Command::ADD_NOTIFICATION, AmsPort::COM, &[0; 40]),
        frame(Command::DELETE_NOTIFICATION, AmsPort::COM, &[0; 4]),
        frame(Command::NOTIFICATION, AmsPort::COM, &[0; 8]),
        at(sda, AdsService::ReadWrite, 0xF080, 1, &[0; 12]),
        at(sda, AdsService::ReadWrite, 0xF081, 1, &[0; 13]),
        at(sda, AdsService::ReadWrite, 0xF082, 1, &[0; 17]),
        // Access to the program stream other than a write to a channel
        at(AmsPort::COM, AdsService::Read, 0x12_0101, 0x90, &[]),
        at(AmsPort::COM, AdsService::Read, 0x2_0101, 0x90, &[]),
        at(AmsPort::COM, AdsService::Read, 0x12_0100, 0x90, &[]),
        at(AmsPort::COM, AdsService::ReadWrite, 0x12_0101, 0x90, &[1]),
        at(AmsPort::COM, AdsService::Write, 0x12_0100, 0x90, b"M30\r\n"),
        // A write to the address of the program stream, but at the port of SDA
        at(AmsPort::SDA, AdsService::Write, 0x12_0101, 0x90, b"M30\r\n"),
    ];
    for frame in never {
        assert!(check(&frame).is_err());
        assert!(gate(everything).check(&frame, now()).is_err());
        let rejection = malformed().check(&frame, now()).unwrap_err();
        assert!(!rejection.to_string().is_empty() && rejection.needed.is_none());
    }
}

#[test]
fn each_write_needs_its_entry() {
    let all = writes();
    for (frame, table) in &all {
        let rejection = check(frame).unwrap_err();
        assert_eq!(rejection.needed.as_ref().unwrap().to_string(), *table);
        assert!(rejection.advice().contains(table));
        assert!(malformed().check(frame, now()).is_err());

        let gate = gate(table);
        assert!(!gate.check(frame, now()).unwrap().is_repeatable());
        let passed = all.iter().filter(|(other, _)| gate.check(other, now()).is_ok());
        assert_eq!(passed.count(), 1, "{table}");
    }
}

#[test]
fn a_file_applies_to_one_target_until_it_expires() {
    for (frame, table) in writes() {
        let gate = gate(table);
        let end = Moment::from_rfc3339("2026-05-04T15:30:00Z").unwrap();
        let just = Moment::from_rfc3339("2026-05-04T15:29:59Z").unwrap();
        assert!(gate.check(&frame, just).is_ok());
        let rejection = gate.check(&frame, end).unwrap_err();
        assert!(matches!(rejection.reason, Reason::Expired(at) if at == end), "{rejection}");

        let mut other = frame.clone();
        other[6] ^= 1;
        let rejection = gate.check(&other, now()).unwrap_err();
        assert!(matches!(rejection.reason, Reason::OtherTarget { .. }), "{rejection}");
        // The gate rejects two frames at once, whatever their target is.
        let two = [frame.clone(), frame].concat();
        assert!(gate.check(&two, now()).is_err());
    }
}

#[test]
fn a_variable_includes_only_its_elements() {
    let list = gate("[[variable]]\nchannel = 1\nname = \"V.E.list\"");
    for (name, passes) in [
        ("V.E.list", true),
        ("V.E.list[3]", true),
        ("V.E.list[3][14]", true),
        ("V.E.list[3].a", false),
        ("V.E.list[]", false),
        ("V.E.list[a]", false),
        ("V.E.list[1", false),
        ("V.E.list]", false),
        ("V.E.list2", false),
        ("V.E.lis", false),
        ("v.e.list", false),
    ] {
        assert_eq!(list.check(&by_name(name), now()).is_ok(), passes, "{name}");
    }
    let one = gate("[[variable]]\nchannel = 1\nname = \"V.E.list[3]\"");
    assert!(one.check(&by_name("V.E.list[3]"), now()).is_ok());
    assert!(one.check(&by_name("V.E.list"), now()).is_err());
    assert!(one.check(&by_name("V.E.list[31]"), now()).is_err());
    // The channel with rank 1 may be another channel than channel 1.
    let by_rank = WriteByName::new(Channel::by_index(1).unwrap(), "V.E.list", &[1][..]).unwrap();
    assert!(list.check(&request(by_rank), now()).is_err());
    let other = WriteByName::new(channel(2), "V.E.list", &[1][..]).unwrap();
    assert!(list.check(&request(other), now()).is_err());
}

/// A file may require an IP address. A file for the NetId 127.0.0.1.1.1, which every machine uses
/// for itself, only applies to a loopback address.
#[test]
fn a_file_may_require_an_address() {
    let table = "[[variable]]\nchannel = 1\nname = \"V.E.a\"";
    let to = |gate: &Gate, address: &str| gate.clone().to_address(address.parse().unwrap());
    let bound = gate(&format!("address = \"192.0.2.10\"\n{table}"));
    let write = by_name("V.E.a");
    assert!(to(&bound, "192.0.2.10").check(&write, now()).is_ok());
    assert!(to(&bound, "::ffff:192.0.2.10").check(&write, now()).is_ok());
    for other in [to(&bound, "192.0.2.11"), to(&bound, "2001:db8::1"), bound] {
        let rejection = other.check(&write, now()).unwrap_err();
        assert!(matches!(rejection.reason, Reason::OtherAddress { .. }), "{rejection}");
        assert!(other.check_target(TARGET, now()).is_err());
    }
    for any in ["192.0.2.10", "192.0.2.11", "2001:db8::1"] {
        assert!(to(&gate(table), any).check(&write, now()).is_ok(), "{any}");
    }

    let text = file(table).replace("192.0.2.7.1.1", "127.0.0.1.1.1");
    let local = Gate::queries().with_allowed(Some(Allowed::from_toml(&text).unwrap()));
    let mut write = write;
    write[6..12].copy_from_slice(&[127, 0, 0, 1, 1, 1]);
    for here in ["127.0.0.1", "127.1.2.3", "::1", "::ffff:127.0.0.1"] {
        assert!(to(&local, here).check(&write, now()).is_ok(), "{here}");
    }
    for other in [to(&local, "192.0.2.10"), to(&local, "::"), local] {
        let rejection = other.check(&write, now()).unwrap_err();
        assert!(matches!(rejection.reason, Reason::LocalNetId(_)), "{rejection}");
    }
}

/// Malformed requests to a device pass only with both the option `--malformed` and a file that
/// permits them, to the target of the file and before its expiry.
#[test]
fn malformed_requests_need_a_file() {
    let bad = at(AmsPort::SDA, AdsService::ReadWrite, 0xF005, 0, b"x");
    let odd = at(AmsPort::SDA, AdsService::Write, 0x12_2301, 0x44, b"V.E\0");
    let end = Moment::from_rfc3339("2026-05-04T15:30:00Z").unwrap();
    for frame in [&bad, &odd] {
        assert!(malformed().check(frame, now()).is_ok());
        for gate in [Gate::queries().and_malformed(), gate(""), gate("malformed = true")] {
            assert!(gate.check(frame, now()).is_err());
        }
        assert!(gate("malformed = false").and_malformed().check(frame, now()).is_err());
        let late = malformed().check(frame, end).unwrap_err();
        assert!(matches!(late.reason, Reason::Expired(_)), "{late}");
        let mut other = frame.clone();
        other[6] ^= 1;
        let rejection = malformed().check(&other, now()).unwrap_err();
        assert!(matches!(rejection.reason, Reason::OtherTarget { .. }), "{rejection}");
        // An incomplete frame is rejected: no file can permit it.
        assert!(malformed().check(&frame[..frame.len() - 1], now()).is_err());
    }
    let rejection = Gate::queries().and_malformed().check_malformed(TARGET, now()).unwrap_err();
    assert!(rejection.advice().contains("malformed = true"), "{}", rejection.advice());
    assert!(malformed().check_malformed(TARGET, now()).is_ok());
    assert!(malformed().check_malformed(TARGET, end).is_err());
}

#[test]
fn a_service_entry_allows_three_variables() {
    let gate = gate("[[service]]\nchannel = 1");
    for (name, passes) in [
        ("V.G.SERVICE.RESPONSE", true),
        ("V.G.SERVICE.RESPONSE_STATE", true),
        ("V.G.SERVICE.REQUEST_STATE", true),
        ("V.G.SERVICE.REQUEST", false),
        ("V.G.SERVICE.UUID", false),
        ("V.G.SERVICE.RESPONSE[1]", false),
    ] {
        assert_eq!(gate.check(&by_name(name), now()).is_ok(), passes, "{name}");
    }
}

#[test]
fn an_invalid_file_is_rejected_with_its_line() {
    for (tables, line, what) in [
        ("tarlet = 1", 3, "is unknown"),
        ("[[variable]]\nchannel = 1\nname = \"V.E.a\"\naxes = 1", 6, "is unknown"),
        ("[[variables]]\nchannel = 1", 3, "is unknown"),
        ("[[variable]]\nchannel = 1", 3, "is missing"),
        ("[[variable]]\nname = \"V.E.a\"", 3, "channel"),
        ("[[variable]]\nchannel = 1\nrank = 1\nname = \"V.E.a\"", 3, "rank"),
        ("[[variable]]\nchannel = 256\nname = \"V.E.a\"", 3, "out of range"),
        ("[[variable]]\nchannel = 1\nname = \"\"", 3, "characters"),
        ("[[variable]]\nchannel = 1\nname = \"\u{3a9}\"", 3, "CP1252"),
        ("[[object]]\ngroup = 0x120101\noffset = 0x90", 3, "[[stream]]"),
        ("[[object]]\ngroup = 0x123301\noffset = 1", 3, "no content of a COM object"),
        ("[[object]]\ngroup = 0x130101\noffset = 1", 3, "no content of a COM object"),
        ("[[object]]\ngroup = 0x120101", 3, "group and offset"),
        ("[[element]]\ngroup = 0x120101\noffset = 1", 3, "no content of an element"),
        ("[[element]]\ngroup = 0x122301\noffset = 0x4A", 3, "no content of an element"),
        ("[[element]]\ngroup = 0x123401\noffset = 1", 3, "no content of an element"),
        ("[[stream]]\nchannel = 0", 3, "out of range"),
    ] {
        let error = Allowed::from_toml(&file(tables)).unwrap_err().to_string();
        assert!(error.contains(what), "{tables}\n{error}");
        assert!(error.contains(&format!("line {line}")), "{tables}\n{error}");
    }
    for text in [
        "expires = 2026-05-04T17:30:00Z",
        "target = \"192.0.2.7.1.1\"",
        "target = \"192.0.2.7\"\nexpires = 2026-05-04T17:30:00Z",
        "target = \"192.0.2.7.1.1\"\naddress = \"192.0.2.7:48898\"\nexpires = 2026-05-04T17:30:00Z",
        "target = \"192.0.2.7.1.1\"\nmalformed = 1\nexpires = 2026-05-04T17:30:00Z",
        "target = \"192.0.2.7.1.1\"\nexpires = 2026-05-04T17:30:00",
        "target = \"192.0.2.7.1.1\"\nexpires = 2026-05-04",
        "target = \"192.0.2.7.1.1\"\nexpires = \"tomorrow\"",
    ] {
        assert!(Allowed::from_toml(text).is_err(), "{text}");
    }
    let lost = Allowed::from_file("/no/such/file.toml".as_ref()).unwrap_err();
    assert!(lost.to_string().starts_with("/no/such/file.toml: "));
}

/// An entry that is formatted as in the advice of a rejection can be read from a file.
#[test]
fn entries_are_shown_as_they_are_read() {
    let entries = [
        Entry::Variable {
            channel: Channel::by_index(3).unwrap(),
            axis: None,
            name: "V.E.\"L\\\u{e4}nge\"\u{7f}".parse().unwrap(),
        },
        Entry::Object { list: AllowedList::Platform, name: "a".parse().unwrap() },
        Entry::Object { list: AllowedList::Channel(channel(2)), name: "a".parse().unwrap() },
        Entry::Object {
            list: AllowedList::Axis(ads_cnc::address::PlatformAxis::new(3).unwrap()),
            name: "a".parse().unwrap(),
        },
        Entry::Content {
            group: element().group(Attribute::Content),
            offset: element().index_offset(),
        },
        Entry::Content { group: IndexGroup::new(0x12_0203), offset: IndexOffset::new(1) },
        Entry::Stream(Channel::by_index(1).unwrap()),
        Entry::Service(channel(255)),
    ];
    for entry in entries {
        let allowed = Allowed::from_toml(&file(&entry.to_string())).unwrap();
        assert_eq!(allowed.entries, [entry]);
    }
}
