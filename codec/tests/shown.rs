//! Tests of the texts of `Display` and `Debug`. `shown_errors.rs` tests those of
//! `Error`, `ErrorKind` and `DispatchError`.

use std::fmt::{Debug, Display};

use ads_cnc::address::{
    Attribute, Channel, ChannelAxis, Class, IndexGroup, IndexOffset, PlatformAxis, Spindle,
};
use ads_cnc::ads::{AdsError, AdsState, AmsAddr, AmsNetId, AmsPort, Command, StateFlags};
use ads_cnc::dynamic::{DynamicKind, DynamicValue};
use ads_cnc::layout::{Field, Stream, Type};
use ads_cnc::operation::{Function, Task};
use ads_cnc::sda::ElementLength;
use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
use ads_cnc::streaming::*;
use ads_cnc::value::{Boolean, DataType};
use ads_cnc::*;

#[track_caller]
fn shows(value: impl Display, text: &str) {
    assert_eq!(value.to_string(), text);
}

#[track_caller]
fn debugs(value: impl Debug, text: &str) {
    assert_eq!(format!("{value:?}"), text);
}

/// Index groups, index offsets and handles are displayed in hexadecimal, ports and NetIds in
/// decimal, and ADS errors in both.
#[test]
fn addresses_are_in_hexadecimal_and_ports_are_not() {
    shows(IndexGroup::new(0x12_2301), "0x122301");
    debugs(IndexGroup::new(0x12_2301), "0x122301");
    shows(IndexOffset::new(0x2_0004), "0x20004");
    debugs(IndexOffset::new(0x2_0004), "0x20004");
    shows(AdsError::SYMBOL_NOT_FOUND, "ADS error 0x710 (1808, SYMBOL_NOT_FOUND)");
    debugs(AdsError::SYMBOL_NOT_FOUND, "0x710 SYMBOL_NOT_FOUND");
    shows(AdsError(0x7FF), "ADS error 0x7ff (2047)");
    debugs(AdsError(0x7FF), "0x7ff (unknown)");
    assert_eq!(format!("{:#x}", AdsError::SYMBOL_NOT_FOUND), "0x710");
    shows(AmsPort::COM, "553");
    debugs(AmsPort::COM, "553");
    let net_id = AmsNetId([192, 0, 2, 7, 1, 1]);
    shows(net_id, "192.0.2.7.1.1");
    debugs(net_id, "192.0.2.7.1.1");
    shows(AmsAddr { net_id, port: AmsPort::COM }, "192.0.2.7.1.1:553");
    debugs(AmsAddr { net_id, port: AmsPort::COM }, "192.0.2.7.1.1:553");
    debugs(Handle(0x2001_2341), "Handle(0x20012341)");
    shows(Handle(0x2001_2341), "0x20012341");
}

/// Codes are displayed by name (state flags also with their number), and undocumented codes as
/// numbers. Of the accesses of variables, only READ_WRITE permits writing.
#[test]
fn codes_are_displayed_by_name() {
    shows(VariableType::REAL64, "REAL64");
    debugs(VariableType::REAL64, "8 REAL64");
    shows(VariableType(10), "10");
    debugs(VariableType(10), "10 (unknown)");
    shows(VariableAccess::READ_WRITE, "READ_WRITE");
    shows(Synchronisation::NO_SYNC, "NO_SYNC");
    shows(Validity::GLOBAL, "GLOBAL");
    shows(WriteAccess::WRITABLE, "WRITABLE");
    shows(Command::READ_WRITE, "READ_WRITE");
    debugs(Command(77), "77 (unknown)");
    shows(AdsState::RUN, "RUN");
    shows(StateFlags::RESPONSE, "RESPONSE (0x5)");
    shows(StateFlags(0x44), "0x44");
    shows(DataType::Real32, "REAL32");
    shows(Kind::V_E, "V.E");
    for access in [0, 1, 3, u32::MAX].map(VariableAccess) {
        assert!(!access.is_writable());
    }
    assert!(VariableAccess::READ_WRITE.is_writable());
}

/// Channels, axes and spindles are displayed as numbers; classes and attributes with the terms of
/// the manual.
#[test]
fn parts_of_addresses_are_numbers_and_words() {
    shows(Channel::new(3).unwrap(), "3");
    shows(PlatformAxis::new(4).unwrap(), "4");
    shows(ChannelAxis::new(0x1234).unwrap(), "4660");
    shows(Spindle::new(0).unwrap(), "0");
    let classes = Class::ALL.map(|class| class.to_string()).join(", ");
    let words = "position controller, interpolator, decoder, HLD, path preparation, spindle";
    assert_eq!(classes, words);
    let attributes = Attribute::ALL.map(|attribute| attribute.to_string()).join(", ");
    assert_eq!(attributes, "content, name, type, length, unit, write flag, object address");
    shows(ElementLength::new(8), "8");
    shows(ObjectCount(16), "16");
}

/// The ADS error 0 is success; any other number is an error.
#[test]
fn results_are_errors_unless_0() {
    assert_eq!(AdsError::NO_ERROR.into_result(), Ok(()));
    for number in [1, 0x703, u32::MAX].map(AdsError) {
        assert!(!number.is_ok());
        assert_eq!(number.into_result(), Err(number));
    }
}

#[test]
fn streams_and_fields_have_their_names() {
    shows(Stream::VariableDescription, "variable-description");
    let field = Field::by_name(Stream::VariableDescription, "type").unwrap();
    shows(field, "variable-description: type");
    debugs(field, "variable-description.type");
    shows(Field::whole(Stream::Content), "content: stream");
    assert_eq!(Field::by_name(Stream::VariableHandle, "value"), None);
    let names = [
        (Type::Uns08, "UNS08"),
        (Type::Uns16, "UNS16"),
        (Type::Uns32, "UNS32"),
        (Type::Unsigned, "unsigned"),
        (Type::Boolean, "BOOLEAN"),
        (Type::Real64, "REAL64"),
        (Type::String, "STRING"),
        (Type::NetId, "BYTE[6]"),
        (Type::Bytes, "BYTE[]"),
    ];
    for (kind, name) in names {
        shows(kind, name);
    }
}

/// `Debug` of an iterator of a list displays the remaining items.
#[test]
fn iterators_show_the_remaining_items() {
    let mut numbers = U32List::from(&[3, 9, 27]).iter();
    numbers.next();
    debugs(numbers, "U32Iter([9, 27])");
    let descriptors = DescriptorsRef::decode(&[0; 168]).unwrap();
    let mut objects = descriptors.iter();
    objects.next();
    debugs(objects, &format!("DescriptorIter({:?})", descriptors.slice(1, 1)));
}

#[test]
fn texts_are_in_characters_with_their_end() {
    let text = CncStr::new("Größe \"€\"").unwrap();
    shows(text, "Größe \"€\"");
    debugs(text, r#""Größe \"€\"""#);
    let with = |tail| TextRef::with_tail(CncStr::new("a").unwrap(), tail);
    debugs(with(Some(&[])), r#""a""#);
    debugs(with(Some(&[0, 0])), r#""a" and 2 NULs more"#);
    debugs(with(Some(&[0, 0xAB])), r#""a" and [00, ab]"#);
    debugs(with(None), r#""a" without NUL"#);
    shows(with(Some(&[0, 0])), "a");
    shows(with(None), "a");
    #[cfg(feature = "alloc")]
    shows(Text::from(with(None)), "a");
    debugs(Kind::V_E, r#""V.E""#);
    let path = VariablePath::new("V.E.test[4].Länge").unwrap();
    shows(path, "V.E.test[4].Länge");
    debugs(path, r#""V.E.test[4].Länge""#);
    shows(path.parts().next().unwrap(), "test[4]");
    debugs(U32List::from(&[3, 0]), "[3, 0]");
}

#[test]
fn values_are_numbers_and_texts() {
    debugs(DynamicValue::from_bits(1.5_f64.to_bits()), "1.5 (0x3ff8000000000000)");
    shows(DynamicValue::from(1.5), "1.5");
    debugs(Boolean(2), "2");
    shows(Boolean(2), "TRUE");
    shows(Boolean::FALSE, "FALSE");
    let elements = Elements::new(DataType::Uns16, U32List::from(&[2]), &[1, 0, 2, 0]).unwrap();
    debugs(elements, "[Uns16(1), Uns16(2)]");
    let elements = Elements::new(DataType::Sgn08, U32List::from(&[3]), &[1, 2, 0xFF]).unwrap();
    debugs(elements, "[Sgn08(1), Sgn08(2), Sgn08(-1)]");
    let bytes = |data_type, bytes| Elements::new(data_type, U32List::EMPTY, bytes).unwrap();
    for (elements, shown) in [
        (bytes(DataType::Boolean, &[0]), "FALSE"),
        (bytes(DataType::Boolean, &[7]), "TRUE"),
        (bytes(DataType::Sgn08, &[0xFF]), "-1"),
        (bytes(DataType::Uns08, &[0xFF]), "255"),
        (bytes(DataType::Sgn16, &[0xFE, 0xFF]), "-2"),
        (bytes(DataType::Uns16, &[0xFE, 0xFF]), "65534"),
        (bytes(DataType::Sgn32, &[0, 0, 0, 0x80]), "-2147483648"),
        (bytes(DataType::Uns32, &[0, 0, 0, 0x80]), "2147483648"),
        (bytes(DataType::Lint, &[0xFF; 8]), "-1"),
        (bytes(DataType::Lword, &[0xFF; 8]), "18446744073709551615"),
        (bytes(DataType::Real32, &[0, 0, 0xC0, 0xBF]), "-1.5"),
        (bytes(DataType::Real64, &1234.2_f64.to_le_bytes()), "1234.2"),
        (bytes(DataType::String, b"L\xE4nge\0rest"), "Länge"),
    ] {
        shows(elements.get(0).unwrap(), shown);
    }
    shows(DynamicKind::VL, "V.L");
}

#[test]
fn services_have_their_names() {
    let id = "12345678-9ABC-DEF0-1234-56789ABCDEF0";
    let shown = ServiceId::new(id).unwrap();
    shows(shown, id);
    debugs(shown, &format!("ServiceId({id})"));
    for variable in ServiceVariable::ALL {
        shows(variable, variable.name());
    }
    shows(ServiceVariable::Request, "V.G.SERVICE.REQUEST");
    let tasks = [Task::Geo, Task::Sda, Task::Com];
    assert_eq!(tasks.map(|task| task.to_string()), ["GEO", "SDA", "COM"]);
    shows(Function::ReadByName, "read variable value by name");
    // `Debug` of a host displays its CP1252 text as characters.
    let ids = [shown];
    let mut host = Host::new(&ids);
    while let HostStep::Read(variable) = host.step() {
        let value: &[u8] = match variable {
            ServiceVariable::Uuid => id.as_bytes(),
            ServiceVariable::Request => b"2 for 1 \x80\0",
            _ => &[1, 0, 0, 0],
        };
        host.read(value).unwrap();
    }
    let host = format!("{host:?}");
    assert!(host.contains("\"2 for 1 €\""), "{host}");
}

#[test]
fn streaming_displays_progress_and_not_the_text() {
    let text = NcText::new(b"N10 $WHILE 1\nN20 M30\nN30").unwrap();
    debugs(text, "NcText(3 lines, 24 bytes)");
    #[cfg(feature = "alloc")]
    {
        use ads_cnc::streaming::{DiagnosticKind, LoopWord, ProgramEnd};
        let mut findings = text.diagnostics();
        debugs(&findings, "Diagnostics { .. }");
        shows(findings.next().unwrap(), "line 1, column 5: $WHILE in a stream (STM-8)");
        shows(findings.next().unwrap(), "line 3, column 1: text after the M30 of line 2 (STM-10)");
        shows(LoopWord::While, "$WHILE");
        shows(ProgramEnd::M30, "M30");
        shows(DiagnosticKind::BackwardJump { to: 5 }, "$GOTO back to line 5");
    }
    let mut sender = Sender::new(text);
    let shown = |state, rejections| {
        let sent = "Progress { packets: 0, lines: 0, bytes: 0 }";
        let state = format!("state: {state}, sent: {sent}, busy_count: {rejections}");
        format!("Sender {{ text: NcText(3 lines, 24 bytes), {state}, .. }}")
    };
    debugs(&sender, &shown("Ready", 0));
    assert!(sender.packet().is_some());
    debugs(&sender, &shown("InFlight", 0));
    sender.acknowledge(Ack::Busy).unwrap();
    debugs(sender, &shown("Waiting", 1));
}

#[cfg(feature = "alloc")]
#[test]
fn owned_types_are_displayed_like_borrowed_ones() {
    let text: CncString = "Größe".parse().unwrap();
    shows(&text, "Größe");
    debugs(&text, r#""Größe""#);
    debugs(Text { text, tail: None }, r#""Größe" without NUL"#);
    let object = Descriptor::new("mc_x", "UNS32").unwrap();
    let shown = "Descriptor { id: 0, size: 0, write_access: 0 READ_ONLY, not_assigned: 0, \
                 index_group: 0x0, index_offset: 0x0, name: \"mc_x\", type_name: \"UNS32\" }";
    debugs(object, shown);
    debugs(object.as_ref(), shown);
    let list: Descriptors = [object].into_iter().collect();
    debugs(list.as_ref(), &format!("[{shown}]"));
    debugs(list, &format!("[{shown}]"));
    let mut checker = Checker::default();
    debugs(checker.check(b"N10\r\n"), "CheckEvents { .. }");
    debugs(checker, "Checker(1 lines)");
}
