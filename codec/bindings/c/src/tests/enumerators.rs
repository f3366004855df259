//! The enumerators of the header: the numbers that the library uses.

use codec::ErrorKind;
use codec::address::{IndexGroup, IndexOffset};
use codec::ads::{AdsError, AmsPort, StateFlags};
use codec::layout::Type;
use codec::operation::{AdsService, DispatchError};

use super::*;
use crate::error::{Fault, class};

/// The enumerators of the header, such as "BUSY = 1", in its order.
fn enumerators() -> Vec<String> {
    let header = include_str!("../../include/ads_cnc.h");
    let code: String = header.split("/*").map(|it| it.split("*/").last().unwrap()).collect();
    let bodies = code.split("enum ").skip(1).map(|it| it.split(['{', '}']).nth(1).unwrap());
    let rows = bodies.flat_map(|it| it.split(','));
    rows.map(|it| it.trim().strip_prefix("ADS_CNC_").unwrap().to_string()).collect()
}

fn info<T>(write: impl FnOnce(*mut T) -> bool) -> T {
    let mut info = zero();
    assert!(write(&mut info));
    info
}

fn effect(function: &str) -> u32 {
    // SAFETY: the pointer is valid.
    info(|it| unsafe { ads_cnc_function_info(number(function), it) }).effect
}

fn field_kind(ty: Type) -> u32 {
    let fields = |stream: Stream| (0..).zip(stream.layout().fields).map(move |it| (stream, it));
    let mut fields = Stream::all().flat_map(fields);
    let (stream, (at, _)) = fields.find(|(_, (_, row))| row.ty == ty).unwrap();
    // SAFETY: the pointer is valid.
    info(|it| unsafe { ads_cnc_field_info(stream_number(stream), at, it) }).kind
}

fn type_kind(name: &str) -> u32 {
    // SAFETY: the pointer is valid.
    let mut types = (0..12).map(|at| info(|it| unsafe { ads_cnc_type(at, it) }));
    types.find(|it| string(it.name) == name).unwrap().kind
}

/// The states of a sender: at the start, with a packet in flight, and after each acknowledgement.
fn sender_states() -> [u32; 5] {
    let sender = &mut zero::<AdsCncSender>();
    // SAFETY: all pointers are valid.
    let mut state = |packet: bool, acknowledgement: u32| unsafe {
        assert!(ads_cnc_sender_start(sender, b"M30".as_ptr(), 3, null_mut()));
        assert!(!packet || ads_cnc_sender_packet(sender, null_mut()));
        ads_cnc_sender_acknowledge(sender, acknowledgement);
        info(|it| ads_cnc_sender_progress(sender, it)).state
    };
    [state(false, 3), state(true, 3), state(true, 1), state(true, 2), state(true, 0)]
}

#[test]
fn enumerators_of_the_header_are_the_numbers_of_the_library() {
    let fault = |fault| AdsCncError::new(fault).kind;
    let dispatch = |error| fault(Fault::Dispatch(error));
    let commands = DispatchError::Service { expected: AdsService::Read, found: AdsService::Write };
    let of_codec = |kind| class(kind).0;
    let mut expected = vec![
        // No error of the codec has this kind yet.
        ("OTHER_ERROR", 0),
        ("TRUNCATED", of_codec(ErrorKind::Truncated)),
        ("TRAILING", of_codec(ErrorKind::Trailing)),
        ("TOO_LONG", of_codec(ErrorKind::TooLong)),
        ("TOO_MANY", of_codec(ErrorKind::TooMany)),
        ("MISSING_NUL", of_codec(ErrorKind::MissingNul)),
        ("INNER_NUL", of_codec(ErrorKind::InnerNul)),
        ("NOT_CP1252", of_codec(ErrorKind::NotCp1252)),
        ("NOT_DECIMAL", of_codec(ErrorKind::NotDecimal)),
        ("DIGITS", of_codec(ErrorKind::Digits)),
        ("UNEXPECTED", of_codec(ErrorKind::Unexpected)),
        ("MISSING", of_codec(ErrorKind::Missing)),
        ("OUT_OF_RANGE", of_codec(ErrorKind::OutOfRange)),
        ("MISMATCH", of_codec(ErrorKind::Mismatch)),
        ("CONTENT", of_codec(ErrorKind::Function)),
        ("BUFFER", of_codec(ErrorKind::BufferTooSmall)),
        ("POINTER", fault(Fault::Pointer)),
        ("NO_FUNCTION", fault(Fault::NoFunction)),
        ("NO_STREAM", fault(Fault::NoStream)),
        ("NO_FIELD", fault(Fault::NoField)),
        ("ARGUMENT", fault(Fault::Argument(""))),
        ("ROOM", fault(Fault::Room(0, 0))),
        ("NOT_STARTED", fault(Fault::NotStarted)),
        ("LINE", fault(Fault::Line(0, 0, 0, ""))),
        ("NO_PORT", dispatch(DispatchError::Port(AmsPort(0)))),
        ("NO_GROUP", dispatch(DispatchError::Group(IndexGroup::new(0)))),
        ("NO_OFFSET", dispatch(DispatchError::Offset(IndexOffset::new(0)))),
        ("COMMAND", dispatch(commands)),
    ];
    // SAFETY: the pointer is valid.
    let arguments = (1..=12).map(|at| (info(|it| unsafe { ads_cnc_argument_name(at, it) }), at));
    let arguments: Vec<_> = arguments.map(|(name, at)| (string(name).to_uppercase(), at)).collect();
    expected.extend(arguments.iter().map(|(name, at)| (name.as_str(), *at)));
    let [ready, in_flight, waiting, stopped, done] = sender_states();
    let acknowledgement = |error: AdsError| ads_cnc_acknowledgement(error.0);
    expected.extend([
        ("EFFECT_NONE", effect("ReadByName")),
        ("EFFECT_WRITE", effect("WriteByName")),
        ("EFFECT_MOTION", effect("WriteProgramStream")),
        ("NUMBER", field_kind(Type::Uns32)),
        ("BOOLEAN", field_kind(Type::Boolean)),
        ("REAL64", field_kind(Type::Real64)),
        ("TEXT", field_kind(Type::String)),
        ("NET_ID", field_kind(Type::NetId)),
        ("BYTES", field_kind(Type::Bytes)),
        ("TYPE_BOOLEAN", type_kind("BOOLEAN")),
        ("TYPE_UNSIGNED", type_kind("UNS32")),
        ("TYPE_SIGNED", type_kind("SGN32")),
        ("TYPE_FLOAT", type_kind("REAL64")),
        ("TYPE_TEXT", type_kind("STRING")),
        ("REQUEST", StateFlags::REQUEST.0.into()),
        ("RESPONSE", StateFlags::RESPONSE.0.into()),
        ("ACCEPTED", acknowledgement(AdsError::NO_ERROR)),
        ("BUSY", acknowledgement(AdsError::INVALID_DATA)),
        ("REJECTED", acknowledgement(AdsError::INVALID_SIZE)),
        ("SENDER_READY", ready),
        ("SENDER_IN_FLIGHT", in_flight),
        ("SENDER_WAITING", waiting),
        ("SENDER_STOPPED", stopped),
        ("SENDER_DONE", done),
        // Literals, because the library has no constants for the numbers of the host.
        ("STEP_WAIT", 0),
        ("STEP_READ", 1),
        ("STEP_WRITE", 2),
        ("STEP_SERVE", 3),
        ("WRITTEN", 0),
        ("FAILED", 1),
        ("POLL", 2),
        ("RESTART", 3),
        ("NO_OUTCOME", 0),
        ("ANSWERED", 1),
        ("ABANDONED", 2),
    ]);
    let expected = expected.iter().map(|(name, number)| format!("{name} = {number}"));
    assert_eq!(enumerators(), expected.collect::<Vec<_>>());
}
