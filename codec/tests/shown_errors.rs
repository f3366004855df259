//! Tests of the texts of errors.

use std::error::Error as _;

use ads_cnc::address::{
    Channel, ChannelAxis, Class, ElementAddress, IndexGroup, IndexOffset, PlatformAxis, Spindle,
};
use ads_cnc::ads::{AdsError, AmsNetId, AmsPort};
use ads_cnc::operation::*;
use ads_cnc::value::{DataType, Shape};
use ads_cnc::*;

fn error<T: std::fmt::Debug>(result: Result<T, Error>) -> (ErrorKind, String) {
    let error = result.expect_err("rejected");
    // `Debug` displays the kind of the error before the text.
    assert_eq!(format!("{error:?}"), format!("Error({:?}, {error})", error.kind()));
    (error.kind(), error.to_string())
}

/// The text of an error explains the fault. Most texts name the field and its offset, and the
/// expected or the found number.
#[test]
fn errors_explain_the_fault() {
    let kind = TextRef::with_tail(CncStr::new("V.E").unwrap(), None);
    let kind = VariableKindRef { kind: Kind::from_field(kind) };
    let channel = Channel::new(1).unwrap();
    let by_name = ElementAddress::for_channel(channel, Class::Decoder, 0x46).unwrap();
    let indices = [0; 511];
    let too_many = HandleReadRef { handle: Handle(1), indices: U32List::from(&indices) };
    for ((kind, text), wanted) in [
        (
            error(Handle::decode(&[4, 0, 0])),
            (
                ErrorKind::Truncated,
                "variable-handle: handle at offset 0: truncated, expected 4 bytes, found 3",
            ),
        ),
        (
            error(Handle::decode(&[4, 0, 0, 2, 0])),
            (
                ErrorKind::Trailing,
                "variable-handle: stream at offset 4: trailing bytes, expected 4 bytes, found 5",
            ),
        ),
        (
            error(ValueRef::decode(&[0; 2049])),
            (
                ErrorKind::TooLong,
                "variable-value: stream at offset 2048: too long, expected at most 2048 bytes, found 2049",
            ),
        ),
        (
            error(too_many.encode(&mut [0; 4096])),
            (
                ErrorKind::TooMany,
                "variable-handle-read: index_count at offset 4: too many, expected at most 510, found 511",
            ),
        ),
        (
            error(kind.encode(&mut [0; 512])),
            (
                ErrorKind::MissingNul,
                "variable-kind: kind at offset 0: no NUL, expected one within 256 bytes, found 3 without",
            ),
        ),
        (
            error(CncStr::new("a\0b")),
            (ErrorKind::InnerNul, "text at offset 1: NUL inside the text"),
        ),
        (
            error(CncStr::new("ä☃")),
            (ErrorKind::NotCp1252, "text at offset 1: U+2603 is not in CP1252"),
        ),
        (
            error("1.2.3.4.5.x".parse::<AmsNetId>()),
            (ErrorKind::NotDecimal, "ams-net-id: number at offset 10: 'x' is not a decimal digit"),
        ),
        (
            error("1.2.3.4.5.0006".parse::<AmsNetId>()),
            (ErrorKind::Digits, "ams-net-id: number at offset 10: expected 1 to 3 digits, found 4"),
        ),
        (
            error(ValueRef { bytes: &[] }.get::<u8>(0)),
            (ErrorKind::Missing, "typed-value: value at offset 0: missing"),
        ),
        (error(Channel::new(0)), (ErrorKind::OutOfRange, "channel 0 is out of range 1..=255")),
        (
            error("1.2.3.4.5.256".parse::<AmsNetId>()),
            (
                ErrorKind::OutOfRange,
                "ams-net-id: number at offset 10: out of range, expected at most 255, found 256",
            ),
        ),
        (
            error("1.2.3.4.5".parse::<AmsNetId>()),
            (ErrorKind::Mismatch, "ams-net-id: numbers at offset 0: expected 6, found 5"),
        ),
        (
            error(ReadElement::new(by_name, 4)),
            (
                ErrorKind::Function,
                "index-offset: element at offset 0: 0x46 is a function, not content",
            ),
        ),
        (
            error(Handle(1).encode(&mut [0; 3])),
            (
                ErrorKind::BufferTooSmall,
                "variable-handle: stream at offset 0: buffer too small, expected 4 bytes, found 3",
            ),
        ),
    ] {
        assert_eq!((kind, text.as_str()), wanted);
    }
}

/// Errors about the range of an argument name the argument, errors at a character of the name of a
/// variable have the offset in the name, and errors about a type name both types.
#[test]
fn errors_of_arguments_name_the_argument() {
    let text = |error: Error| error.to_string();
    let place = |number| PlatformAxis::new(number).map_err(text).unwrap_err();
    assert_eq!(place(0), "platform axis 0 is out of range 1..=255");
    assert_eq!(place(256), "platform axis 256 is out of range 1..=255");
    let axis = ChannelAxis::new(65536).map_err(text).unwrap_err();
    assert_eq!(axis, "channel axis 65536 is out of range 1..=65535");
    let spindle = Spindle::new(256).map_err(text).unwrap_err();
    assert_eq!(spindle, "spindle 256 is out of range 0..=255");
    let channel = Channel::by_index(256).map_err(text).unwrap_err();
    assert_eq!(channel, "channel 256 is out of range 1..=255");

    let object = ReadObject::new(IndexGroup::new(0xF005), IndexOffset::new(1), 4);
    let object = object.map_err(text).unwrap_err();
    assert_eq!(object, "index group: expected one such as 0x120100, found 0xf005");
    let path = VariablePath::new("V.E.matrix[1").map_err(text).unwrap_err();
    assert_eq!(path, "variable-path: index at offset 12: no \"]\"");
    let cut = |name| VariablePath::new(name).map_err(text).unwrap_err();
    let kind = "the name ends, expected a kind such as V.E";
    assert_eq!(cut(""), format!("variable-path: kind at offset 0: {kind}"));
    let part = "the name ends, expected another part";
    assert_eq!(cut("V.E"), format!("variable-path: part at offset 3: {part}"));
    assert_eq!(cut("V.E."), format!("variable-path: part at offset 4: {part}"));
    let long = "variable-path: too long, expected at most 255 characters, found 256";
    assert_eq!(cut(&format!("V.E.{}", "n".repeat(252))), long);

    let read = |first, count| ReadDescriptors::new(ObjectList::PLATFORM, first, count);
    let read = |first, count| read(first, count).map_err(text).unwrap_err();
    assert_eq!(read(0, 1), "first object 0 is out of range 1..=4294967295");
    assert_eq!(read(1, 0), "count of descriptors 0 is out of range 1..=49932");
    assert_eq!(read(1, 49933), "count of descriptors 49933 is out of range 1..=49932");

    let shape = Shape::new(DataType::Sgn32, U32List::EMPTY, 4).unwrap();
    let written = shape.encode(&1.5_f64, &mut [0; 8]).map_err(text).unwrap_err();
    assert_eq!(written, "expected SGN32, found REAL64");
    let read = shape.elements(&[0; 4]).unwrap().copy_to(&mut [0.0_f32]);
    let read = read.map_err(text).unwrap_err();
    assert_eq!(read, "expected REAL32, found SGN32");
}

/// The texts of errors of elements, indices and numbers contain no byte offset.
#[test]
fn errors_of_values_have_no_byte_offset() {
    let text = |error: Error| error.to_string();
    let dimensions = [2, 3];
    let bytes = [0; 24];
    let elements = Elements::new(DataType::Sgn32, U32List::from(&dimensions), &bytes).unwrap();
    assert_eq!(elements.get(6).map_err(text).unwrap_err(), "index 6 is out of range 0..=5");
    let at = |indices: &[u32]| elements.element(U32List::from(indices)).map_err(text).unwrap_err();
    assert_eq!(at(&[2, 0]), "index 2 is out of range 0..=1");
    assert_eq!(at(&[1, 3]), "index 3 in dimension 1 (from 0) is out of range 0..=2");
    assert_eq!(at(&[1]), "value: expected 2 indices, found 1");
    let copied = elements.copy_to(&mut [0_i32; 5]).map_err(text).unwrap_err();
    assert_eq!(copied, "value: expected 6 elements, found 5");
    let one = Shape::new(DataType::Sgn32, U32List::EMPTY, 4).unwrap();
    let written = one.encode(&[1, 2], &mut [0; 8]).map_err(text).unwrap_err();
    assert_eq!(written, "value: expected 1 element, found 2");
    let shape = Shape::new(DataType::Sgn32, U32List::from(&dimensions), 20).map_err(text);
    assert_eq!(shape.unwrap_err(), "size: expected 24 bytes, found 20");

    let fits = |text: Result<(), Error>| text.unwrap_err().to_string();
    let to_u8 = |element| fits(u8::try_from(element).map(drop));
    assert_eq!(to_u8(Element::Sgn32(300)), "300 does not fit UNS08");
    assert_eq!(to_u8(Element::Lint(i64::MIN)), "-0x8000000000000000 does not fit UNS08");
    assert_eq!(to_u8(Element::Real64(1.0)), "expected UNS08, found REAL64");
    assert_eq!(to_u8(Element::Lword(0x1_0000_0002)), "0x100000002 does not fit UNS08");
    let to_u32 = fits(u32::try_from(Element::Sgn32(-3)).map(drop));
    assert_eq!(to_u32, "-3 does not fit UNS32");
    let to_f64 = fits(f64::try_from(Element::Lint(i64::MAX)).map(drop));
    assert_eq!(to_f64, "0x7fffffffffffffff does not fit REAL64");
    let to_i64 = fits(i64::try_from(Element::Lword(u64::MAX)).map(drop));
    assert_eq!(to_i64, "0xffffffffffffffff does not fit LINT");
}

/// The error of a count that the remaining bytes limit says so. The errors of content have the
/// offset in the content.
#[test]
fn errors_of_counts_name_their_limit() {
    let cut = DescriptionRef::decode(&[&[0; 16][..], &[1, 0, 0, 0]].concat()).unwrap_err();
    let wanted = "variable-description: dimension_count at offset 16: too many, expected at most 0 in \
                  the bytes that follow, found 1";
    assert_eq!(cut.to_string(), wanted);
    let error = value::content_error(ErrorKind::TooMany, 0, 0, 1);
    let wanted = "content: content at offset 0: too many, expected at most 0, found 1";
    assert_eq!(error.to_string(), wanted);
    let error = value::content_error(ErrorKind::InnerNul, 2, 0, 1);
    let wanted = "content: content at offset 2: NUL inside the text, at its byte 1";
    assert_eq!(error.to_string(), wanted);
}

/// The texts of five kinds of errors.
#[test]
fn kinds_have_different_texts() {
    assert_eq!(ErrorKind::Truncated.to_string(), "truncated");
    assert_eq!(ErrorKind::OutOfRange.to_string(), "out of range");
    assert_eq!(ErrorKind::Mismatch.to_string(), "mismatch");
    assert_eq!(ErrorKind::Digits.to_string(), "wrong number of digits");
    assert_eq!(ErrorKind::Unexpected.to_string(), "unexpected character");
}

/// A dispatch error has a text and an ADS error. It has no source, because its text already
/// contains that of the error of the stream.
#[test]
fn dispatch_errors_have_a_text_and_a_number() {
    let call = Call {
        port: AmsPort::SDA,
        service: AdsService::ReadWrite,
        index_group: IndexGroup::new(0x12_2301),
        index_offset: IndexOffset::new(0x46),
        read_length: 4,
        data: b"V.E.vartest\0",
    };
    assert!(call.dispatch().is_ok());
    let rejected = |call: Call<'_>| {
        let fault = call.dispatch().unwrap_err();
        assert!(fault.source().is_none(), "a chain of errors would show it again");
        (fault.to_string(), fault.ads_error())
    };
    let plain = |text: &str, number| (text.to_string(), number);
    assert_eq!(
        rejected(Call { port: AmsPort(554), ..call }),
        plain("no task has port 554", AdsError::TARGET_PORT_NOT_FOUND)
    );
    assert_eq!(
        rejected(Call { index_group: IndexGroup::new(0xF005), ..call }),
        plain("no function has index group 0xf005", AdsError::INVALID_GROUP)
    );
    assert_eq!(
        rejected(Call { index_offset: IndexOffset::new(0x4E), ..call }),
        plain("no function has index offset 0x4e", AdsError::INVALID_OFFSET)
    );
    assert_eq!(
        rejected(Call { service: AdsService::Write, ..call }),
        plain("the function takes ReadWrite, not Write", AdsError::SERVICE_NOT_SUPPORTED)
    );
    let stream =
        "variable-name: name at offset 0: no NUL, expected one within 256 bytes, found 1 without";
    assert_eq!(rejected(Call { data: b"V", ..call }), plain(stream, AdsError::INVALID_SIZE));
}
