//! Tests of the functions of the ABI, which call them with pointers as a program in C does.

#![allow(clippy::as_conversions, clippy::indexing_slicing, clippy::unwrap_used, clippy::panic)]
#![allow(clippy::arithmetic_side_effects, reason = "tests may fail")]

use core::mem::{MaybeUninit, zeroed};
use core::ptr::{null, null_mut};

use codec::address::{Attribute, Class};
use codec::dynamic::DynamicKind;
use codec::layout::Stream;
use codec::operation::Function;

use crate::address::*;
use crate::frame::*;
use crate::machines::*;
use crate::memory::to_usize;
use crate::request::*;
use crate::stream::*;
use crate::tables::*;
use crate::*;
use common::{CALLS, SAMPLES};

mod common;
mod enumerators;
mod invalid;
mod layouts;
mod machines;

const ROOM: u32 = 4096;

fn zero<T>() -> T {
    // SAFETY: every struct of the ABI consists of numbers and pointers, which may be zero.
    unsafe { zeroed() }
}

/// The error as text.
fn text(error: &AdsCncError) -> String {
    let [subject, name, text] = [error.subject, error.name, error.text].map(string);
    format!(
        "{subject}: {name} at offset {}: {text}, expected {}, found {}",
        error.offset, error.expected, error.found
    )
}

fn string(it: AdsCncBytes) -> String {
    // SAFETY: the library returns pointers to valid bytes.
    String::from_utf8(unsafe { it.get() }.unwrap_or_default().to_vec()).unwrap()
}

fn bytes(text: &str) -> AdsCncBytes {
    AdsCncBytes::of(text.as_bytes())
}

fn number(name: &str) -> u32 {
    // SAFETY: pointer and length are those of a slice.
    unsafe { ads_cnc_function(name.as_ptr(), name.len() as u32) }
}

/// Encodes a request to a new buffer of `room` bytes.
fn encode(request: &AdsCncRequest, room: u32) -> Result<(AdsCncCall, Vec<u8>), String> {
    let (mut buffer, mut call, mut error) = (vec![0; to_usize(room)], zero::<AdsCncCall>(), zero());
    // SAFETY: all pointers are valid.
    match unsafe { ads_cnc_encode(request, buffer.as_mut_ptr(), room, &mut call, &mut error) } {
        true => {
            buffer.truncate(to_usize(call.data.length));
            Ok((call, buffer))
        }
        false => Err(text(&error)),
    }
}

fn dispatch(call: &AdsCncCall, indices: &mut [u32]) -> Result<AdsCncRequest, (u32, String)> {
    let (mut request, mut number, mut error) = (zero(), 77, zero());
    let (room, count) = (indices.as_mut_ptr(), indices.len() as u32);
    // SAFETY: all pointers are valid.
    match unsafe { ads_cnc_dispatch(call, room, count, &mut request, &mut number, &mut error) } {
        true => Ok(request),
        false => Err((number, text(&error))),
    }
}

fn decode(stream: u32, data: &[u8]) -> Result<Vec<AdsCncField>, String> {
    let (mut count, mut error) = (0, zero());
    let (at, length) = (data.as_ptr(), data.len() as u32);
    // SAFETY: all pointers are valid; without room, fields are only counted.
    unsafe { ads_cnc_decode(stream, at, length, null_mut(), 0, &mut count, null_mut()) };
    let mut fields: Vec<MaybeUninit<AdsCncField>> = Vec::new();
    fields.resize_with(to_usize(count), MaybeUninit::uninit);
    let room = fields.as_mut_ptr().cast();
    // SAFETY: all pointers are valid.
    match unsafe { ads_cnc_decode(stream, at, length, room, count, &mut count, &mut error) } {
        // SAFETY: the function has written all fields.
        true => Ok(fields.into_iter().map(|it| unsafe { it.assume_init() }).collect()),
        false => Err(text(&error)),
    }
}

fn build(stream: u32, parts: &[AdsCncPart], room: usize) -> Result<Vec<u8>, String> {
    let (mut buffer, mut length, mut error) = (vec![0; room], 0, zero());
    let (at, count) = (parts.as_ptr(), parts.len() as u32);
    // SAFETY: all pointers are valid.
    let is_built = unsafe {
        ads_cnc_build(stream, at, count, buffer.as_mut_ptr(), room as u32, &mut length, &mut error)
    };
    buffer.truncate(to_usize(length));
    if is_built { Ok(buffer) } else { Err(text(&error)) }
}

#[test]
fn names_equal_those_that_the_codec_displays() {
    assert_eq!(Class::ALL.map(|it| it.to_string()), CLASSES);
    assert_eq!(Attribute::ALL.map(|it| it.to_string()), ATTRIBUTES);
    assert_eq!(DynamicKind::ALL.map(|it| it.to_string()), KINDS);
    for (at, function) in (0..).zip(Function::ALL) {
        let name = format!("{function:?}");
        assert_eq!(operation_name(*function), name);
        assert_eq!((number(&name), number(function.spec().name)), (at, at));
    }
    assert_eq!([number("ReadByNam"), number("")], [ADS_CNC_NONE; 2]);
    let header = include_str!("../include/ads_cnc.h");
    assert!(header.contains(&format!("\n#define ADS_CNC_ABI {}\n", ads_cnc_abi())));
}

/// A request with the arguments that the table lists for a function is encoded, and dispatch sets
/// exactly these arguments. The offset of `CountElements` is listed but 0.
#[test]
fn functions_take_the_arguments_that_they_list() {
    let mut seen = Vec::new();
    for at in 0..30 {
        let mut info = zero::<AdsCncFunctionInfo>();
        // SAFETY: the last argument points to memory for one value.
        assert!(unsafe { ads_cnc_function_info(at, &mut info) });
        let mut request = AdsCncRequest { function: at, ..zero() };
        let operation = string(info.operation);
        for &argument in &info.arguments[..to_usize(info.argument_count)] {
            match argument {
                1 => request.channel = 1,
                2 => request.axis = 1,
                3 => request.index = 1,
                4 => request.count = 1,
                5 => request.size = 8,
                6 => request.handle = 7,
                // The index group of an object of the COM task, or of an element of the HLD.
                7 => {
                    request.index_group =
                        if operation.ends_with("Object") { 0x12_0101 } else { 0x12_3301 }
                }
                8 => request.index_offset = if operation == "CountElements" { 0 } else { 3 },
                9 => {
                    request.kind = bytes(if operation == "FindInstance" { "decoder" } else { "P" })
                }
                10 => request.name = bytes("V.E.a"),
                11 => request.value = bytes("G0 X1\r\n"),
                12 => (request.indices, request.indices_count) = (&4, 1),
                other => panic!("{other}"),
            }
            seen.push(argument);
        }
        let (call, data) =
            encode(&request, 64).unwrap_or_else(|error| panic!("{operation}: {error}"));
        assert_eq!((call.port, call.command), (info.port, info.command), "{operation}");
        let call = AdsCncCall { data: AdsCncBytes::of(&data), ..call };
        let mut indices = [0; 8];
        let again = dispatch(&call, &mut indices).unwrap();
        assert_eq!(encode(&again, 64).unwrap().1, data, "{operation}");
        for argument in 1..=12 {
            let is_set = match argument {
                1 => again.channel > 0,
                2 => again.axis > 0,
                3 => again.index > 0,
                4 => again.count > 0,
                5 => again.size > 0,
                6 => again.handle > 0,
                7 => again.index_group > 0,
                8 => again.index_offset > 0 || operation == "CountElements",
                9 => again.kind.length > 0,
                10 => again.name.length > 0,
                11 => again.value.length > 0,
                _ => again.indices_count > 0,
            };
            let is_listed = info.arguments[..to_usize(info.argument_count)].contains(&argument);
            let is_first = argument == 8 && operation == "CountElements";
            assert!(is_set == is_listed || is_first, "{operation}, argument {argument}");
        }
    }
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen, (1..=12).collect::<Vec<_>>());
    // SAFETY: the functions do not write to a null pointer.
    unsafe {
        assert!(!ads_cnc_function_info(30, null_mut()) && ads_cnc_function_info(29, null_mut()));
        assert!(!ads_cnc_argument_name(0, null_mut()) && !ads_cnc_argument_name(13, null_mut()));
    }
}

#[test]
fn calls_are_dispatched_and_encoded_again() {
    let mut indices = [0; 510];
    for sample in CALLS {
        let call = AdsCncCall::of(&sample.call);
        let request = dispatch(&call, &mut indices)
            .unwrap_or_else(|error| panic!("{}: {error:?}", sample.slug));
        assert_eq!(request.function, number(sample.function.spec().name), "{}", sample.slug);
        let (again, data) =
            encode(&request, ROOM).unwrap_or_else(|error| panic!("{}: {error}", sample.slug));
        // A call to the GEO task is encoded again as a call to the SDA task, so the port may
        // differ.
        let address = |it: &AdsCncCall| (it.command, it.index_group, it.index_offset);
        assert_eq!(address(&again), address(&call), "{}", sample.slug);
        // A text is encoded with one NUL, even if the received text has several.
        let text = |data: &[u8]| {
            data.iter().rposition(|byte| *byte != 0).map_or(0, |at| at.saturating_add(1))
        };
        let is_padded = sample.call.data.get(..text(sample.call.data)) == data.get(..text(&data));
        assert!(data == sample.call.data || is_padded, "{}", sample.slug);
    }
}

#[test]
fn calls_without_a_function_are_rejected() {
    let call = AdsCncCall {
        port: 552,
        command: 9,
        index_group: 0x12_2301,
        index_offset: 0x46,
        read_length: 4,
        data: bytes("V.E.a\0"),
    };
    let rejected = |call: AdsCncCall| dispatch(&call, &mut []).unwrap_err();
    assert_eq!(rejected(AdsCncCall { port: 851, ..call }).0, 6);
    assert_eq!(
        rejected(AdsCncCall { port: 0x1_0228, ..call }).1,
        "call: port at offset 0: argument not accepted by the function, expected 0, found 0"
    );
    assert_eq!(rejected(AdsCncCall { index_group: 1, ..call }).0, 0x702);
    let (number, told) = rejected(AdsCncCall { index_offset: 0x4E, ..call });
    assert_eq!(number, 0x703);
    let offset = "call: index_offset at offset 0: no function has this index offset";
    assert_eq!(told, format!("{offset}, expected 0, found 78"));
    assert_eq!(
        rejected(AdsCncCall { command: 2, ..call }).1,
        "call: command at offset 0: the function requires another command, expected 9, found 2"
    );
    assert_eq!(rejected(AdsCncCall { command: 77, ..call }).0, 0x701);
    assert_eq!(
        rejected(AdsCncCall { data: bytes("V.E.a"), ..call }),
        (0x705, "variable-name: name at offset 0: no NUL, expected 256, found 5".to_string())
    );
    let indices = AdsCncBytes::of(b"\x01\0\0\0\x02\0\0\0\x05\0\0\0\x06\0\0\0");
    let read = AdsCncCall { index_offset: 0x47, data: indices, ..call };
    assert_eq!(rejected(read).1, "call:  at offset 0: too little room, expected 2, found 0");
    let mut room = [0; 2];
    let request = dispatch(&read, &mut room).unwrap();
    assert_eq!((request.handle, request.indices_count), (1, 2));
    assert_eq!(room, [5, 6]);
}

/// `ads_cnc_decode` returns the fields that a walk finds, and `ads_cnc_build` builds the stream
/// from them.
#[test]
fn streams_are_decoded_and_built() {
    for (stream, samples) in SAMPLES {
        let number = stream_number(*stream);
        let name = stream.layout().name;
        // SAFETY: pointer and length are those of a slice.
        assert_eq!(unsafe { ads_cnc_stream(name.as_ptr(), name.len() as u32) }, number);
        for sample in *samples {
            let data = sample.bytes();
            let fields =
                decode(number, &data).unwrap_or_else(|error| panic!("{}: {error}", sample.slug));
            let mut walked = Vec::new();
            stream
                .walk(&data, |it| walked.push((field_number(it.field), it.offset, it.bytes)))
                .unwrap();
            let part = |it: &AdsCncField| {
                let bytes = &data[to_usize(it.offset)..][..to_usize(it.length)];
                (it.field, it.offset, bytes)
            };
            assert_eq!(fields.iter().map(part).collect::<Vec<_>>(), walked, "{}", sample.slug);
            for by_number in [false, true] {
                let parts: Vec<AdsCncPart> = fields
                    .iter()
                    .filter_map(|it| {
                        let mut info = zero();
                        // SAFETY: the last argument points to memory for one value.
                        assert!(unsafe { ads_cnc_field_info(number, it.field, &mut info) });
                        let is_number = by_number && [1, 2].contains(&info.kind) && info.size > 0;
                        let data =
                            if is_number { AdsCncBytes::NONE } else { AdsCncBytes::of(part(it).2) };
                        // Counts other than 0 are omitted in the second pass, so that
                        // `ads_cnc_build` computes them.
                        let is_left_out = info.is_count == 1 && it.number > 0 && by_number;
                        (!is_left_out).then_some(AdsCncPart {
                            field: it.field,
                            number: it.number,
                            data,
                        })
                    })
                    .collect();
                let built = build(number, &parts, data.len());
                assert_eq!(built.as_ref(), Ok(&data), "{}, {by_number}", sample.slug);
                if let Some(room) = data.len().checked_sub(1) {
                    assert!(build(number, &parts, room).unwrap_err().contains("buffer too small"));
                }
            }
        }
    }
}

#[test]
fn a_number_fits_its_field() {
    let flag = stream_number(Stream::ElementWriteFlag);
    let part = AdsCncPart { field: 0, number: 255, data: AdsCncBytes::NONE };
    assert_eq!(build(flag, &[part], 1), Ok(vec![255]));
    let part = AdsCncPart { field: 0, number: 256, data: AdsCncBytes::NONE };
    assert_eq!(
        build(flag, &[part], 1).unwrap_err(),
        "call: flag at offset 0: argument not accepted by the function, expected 0, found 0"
    );
    let part = AdsCncPart { field: 1, number: 0, data: AdsCncBytes::NONE };
    assert_eq!(
        build(flag, &[part], 1).unwrap_err(),
        "call:  at offset 0: no field of the stream has this number, expected 0, found 0"
    );
}

#[test]
fn replies_are_compared_with_their_request() {
    let of = |name: &str| AdsCncRequest { function: number(name), channel: 1, ..zero() };
    let reply = |request: &AdsCncRequest, data: &[u8]| {
        let (mut count, mut error) = (77, zero());
        let (at, length) = (data.as_ptr(), data.len() as u32);
        // SAFETY: all pointers are valid.
        let is_one = unsafe {
            ads_cnc_decode_reply(request, at, length, null_mut(), 0, &mut count, &mut error)
        };
        if is_one { Ok(count) } else { Err(text(&error)) }
    };
    let handle = AdsCncRequest { name: bytes("V.E.a"), ..of("HandleByName") };
    assert_eq!(reply(&handle, &[4, 0, 0, 2]), Ok(1));
    assert_eq!(
        reply(&handle, &[4, 0, 0]).unwrap_err(),
        "variable-handle: handle at offset 0: truncated, expected 4, found 3"
    );
    let write = AdsCncRequest { name: bytes("V.E.a"), value: bytes("x"), ..of("WriteByName") };
    assert_eq!(reply(&write, &[]), Ok(0));
    assert!(reply(&write, &[0]).unwrap_err().contains("trailing"));
    let content =
        AdsCncRequest { index_group: 0x12_0101, index_offset: 3, size: 1, ..of("ReadObject") };
    assert_eq!(reply(&content, &[1]), Ok(1));
    assert!(reply(&content, &[1, 2]).unwrap_err().contains("too long, expected 1, found 2"));
}

#[test]
fn addresses_are_parsed() {
    let words = |group| {
        let mut it = zero::<AdsCncGroup>();
        // SAFETY: the last argument points to memory for one value.
        let is_there = unsafe { ads_cnc_group(group, &mut it) };
        let all = [it.task, it.access, it.addressing, it.table, it.object_class, it.attribute];
        is_there.then(|| (all.map(string).join(" "), it.instance))
    };
    assert_eq!(words(0x12_2301), Some(("SDA/GEO element logical  decoder content".to_string(), 1)));
    assert_eq!(words(0x13_0202), Some(("COM object logical axis  ".to_string(), 2)));
    assert_eq!(words(0x2_5403).unwrap().0, "SDA/GEO element index  spindle name");
    assert_eq!(words(0x13_3301), None);
    let (mut offset, mut axis, mut element, mut error) = (0, 0, 0, zero());
    // SAFETY: all pointers are valid.
    unsafe {
        assert!(ads_cnc_offset(0x1_0000, 2, 5, &mut offset, null_mut()) && offset == 0x2_0005);
        assert!(ads_cnc_offset_parts(0x1000, offset, &mut axis, &mut element, null_mut()));
        assert_eq!((axis, element), (0x20, 5));
        assert!(!ads_cnc_offset(7, 2, 5, null_mut(), &mut error) && string(error.name) == "stride");
        assert!(!ads_cnc_offset(0x1000, 2, 0x1000, null_mut(), &mut error));
        assert_eq!(
            text(&error),
            "index-offset: element at offset 0: out of range, expected 4095, found 4096"
        );
        assert!(!ads_cnc_offset_parts(0x1000, u32::MAX, null_mut(), null_mut(), null_mut()));
    }
}

#[test]
fn names_are_parsed() {
    let parts = |name: &[u8]| {
        let (mut parts, mut count, mut error) = ([0; 9].map(|_| zero::<AdsCncField>()), 0, zero());
        let (at, length) = (name.as_ptr(), name.len() as u32);
        // SAFETY: all pointers are valid.
        match unsafe { ads_cnc_path(at, length, parts.as_mut_ptr(), 9, &mut count, &mut error) } {
            true => Ok(parts[..to_usize(count)]
                .iter()
                .map(|it| {
                    let text = &name[to_usize(it.offset)..][..to_usize(it.length)];
                    (
                        it.field,
                        it.record,
                        it.item,
                        String::from_utf8_lossy(text).into_owned(),
                        it.number,
                    )
                })
                .collect::<Vec<_>>()),
            false => Err(text(&error)),
        }
    };
    let part =
        |field, record, item, text: &str, number| (field, record, item, text.to_string(), number);
    assert_eq!(
        parts(b"V.G.NP[0].V[1][02]"),
        Ok(vec![
            part(0, 0, 0, "V.G", 0),
            part(1, 0, 0, "NP", 0),
            part(2, 0, 0, "", 0),
            part(1, 1, 0, "V", 0),
            part(2, 1, 0, "", 1),
            part(2, 1, 1, "", 2),
        ])
    );
    assert!(parts(b"V.G.a[").unwrap_err().starts_with("variable-path: index at offset 6"));
    assert!(
        parts(b"V.G.a.b.c.d.e.f.g.h.i")
            .unwrap_err()
            .contains("too little room, expected 10, found 9")
    );
}

#[test]
fn texts_are_converted_both_ways() {
    type Convert =
        unsafe extern "C" fn(*const u8, u32, *mut u8, u32, *mut u32, *mut AdsCncError) -> bool;
    let convert = |by: Convert, text: &[u8], room: u32| {
        let (mut buffer, mut length, mut error) = (vec![0; to_usize(room)], 0, zero());
        let (at, size) = (text.as_ptr(), text.len() as u32);
        // SAFETY: all pointers are valid.
        let is_done = unsafe { by(at, size, buffer.as_mut_ptr(), room, &mut length, &mut error) };
        buffer.truncate(to_usize(length));
        (is_done, length, buffer, error)
    };
    let (is_done, length, utf8, _) = convert(ads_cnc_text_to_utf8, b"L\xE4nge \x80\0x", 20);
    assert_eq!((is_done, length, &utf8[..]), (true, 10, "Länge €".as_bytes()));
    let (is_done, length, ..) = convert(ads_cnc_text_to_utf8, b"L\xE4nge \x80", 9);
    assert_eq!((is_done, length), (false, 10));
    let (is_done, length, cp1252, _) = convert(ads_cnc_text_from_utf8, &utf8, 7);
    assert_eq!((is_done, length, &cp1252[..]), (true, 7, &b"L\xE4nge \x80"[..]));
    let (is_done, .., error) = convert(ads_cnc_text_from_utf8, "aΩ".as_bytes(), 7);
    assert_eq!(
        (is_done, text(&error)),
        (false, "text: text at offset 1: not in CP1252, expected 0, found 937".to_string())
    );
    let (is_done, .., error) = convert(ads_cnc_text_from_utf8, b"\xFF", 7);
    assert_eq!((is_done, error.kind), (false, 36));
    // All bytes except NUL are converted to UTF-8 and back.
    let all: Vec<u8> = (1..=255).collect();
    let utf8 = convert(ads_cnc_text_to_utf8, &all, 1000).2;
    assert_eq!(convert(ads_cnc_text_from_utf8, &utf8, 1000).2, all);
}
