//! What a person is told: errors and refusals.

use std::error::Error as _;

use ads_cnc::address::{Channel, Class, ElementAddress, IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsNetId, AmsPort};
use ads_cnc::operation::*;
use ads_cnc::*;

fn error<T: std::fmt::Debug>(result: Result<T, Error>) -> (ErrorKind, String) {
    let error = result.expect_err("refused");
    // Where it is shown in a test that fails, the class is named too.
    assert_eq!(format!("{error:?}"), format!("Error({:?}, {error})", error.kind()));
    (error.kind(), error.to_string())
}

/// The text of each kind of error says in words what its numbers mean.
#[test]
fn errors_say_what_is_wrong() {
    let kind = TextRef::with_tail(CncStr::new("V.E").unwrap(), None);
    let kind = VariableKindRef { kind: Kind::from_field(kind) };
    let channel = Channel::new(1).unwrap();
    let by_name = ElementAddress::of_channel(channel, Class::Decoder, 0x46).unwrap();
    let indices = [0; 511];
    let too_many = HandleReadRef { handle: Handle(1), indices: Numbers::from(&indices) };
    for ((kind, text), wanted) in [
        (
            error(Handle::decode(&[4, 0, 0])),
            (
                ErrorKind::Truncated,
                "variable-handle: handle at offset 0: truncated, 4 bytes expected, 3 there",
            ),
        ),
        (
            error(Handle::decode(&[4, 0, 0, 2, 0])),
            (
                ErrorKind::Trailing,
                "variable-handle: stream at offset 4: trailing bytes, 4 bytes expected, 5 there",
            ),
        ),
        (
            error(ValueRef::decode(&[0; 2049])),
            (
                ErrorKind::TooLong,
                "variable-value: stream at offset 2048: too long, at most 2048 bytes expected, 2049 there",
            ),
        ),
        (
            error(too_many.encode(&mut [0; 4096])),
            (
                ErrorKind::TooMany,
                "variable-handle-read: index_count at offset 4: too many, at most 510 expected, 511 found",
            ),
        ),
        (
            error(kind.encode(&mut [0; 512])),
            (
                ErrorKind::MissingNul,
                "variable-kind: kind at offset 0: no NUL, one expected within 256 bytes, 3 there without",
            ),
        ),
        (
            error(CncStr::new("a\0b")),
            (ErrorKind::InnerNul, "text: text at offset 1: NUL inside the text, at its byte 1"),
        ),
        (
            error(CncStr::new("ä☃")),
            (ErrorKind::NotCp1252, "text: text at offset 1: U+2603 is not in CP1252"),
        ),
        (
            error("1.2.3.4.5.x".parse::<AmsNetId>()),
            (ErrorKind::NotDecimal, "ams-net-id: number at offset 5: U+0078 is no decimal digit"),
        ),
        (
            error("1.2.3.4.5.0006".parse::<AmsNetId>()),
            (ErrorKind::Digits, "ams-net-id: number at offset 5: 1 to 3 digits expected, 4 found"),
        ),
        (
            error(Channel::new(0)),
            (
                ErrorKind::OutOfRange,
                "index-group: instance at offset 0: out of range, at least 1 expected, 0 found",
            ),
        ),
        (
            error("1.2.3.4.5.256".parse::<AmsNetId>()),
            (
                ErrorKind::OutOfRange,
                "ams-net-id: number at offset 5: out of range, at most 255 expected, 256 found",
            ),
        ),
        (
            error("1.2.3.4.5".parse::<AmsNetId>()),
            (ErrorKind::Mismatch, "ams-net-id: numbers at offset 0: mismatch, 6 expected, 5 found"),
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
                "variable-handle: stream at offset 0: buffer too small, 4 bytes expected, 3 there",
            ),
        ),
    ] {
        assert_eq!((kind, text.as_str()), wanted);
    }
}

/// What a server refuses is told in words, once, and as the number that goes back.
#[test]
fn refusals_say_what_is_refused() {
    let call = Call {
        port: AmsPort::SDA,
        service: Service::ReadWrite,
        index_group: IndexGroup::new(0x12_2301),
        index_offset: IndexOffset::new(0x46),
        read_length: 4,
        data: b"V.E.vartest\0",
    };
    assert!(call.dispatch().is_ok());
    let refused = |call: Call<'_>| {
        let refusal = call.dispatch().unwrap_err();
        assert!(refusal.source().is_none(), "a chain of errors would show it again");
        (refusal.to_string(), refusal.ads_error())
    };
    let plain = |text: &str, number| (text.to_string(), number);
    assert_eq!(
        refused(Call { port: AmsPort(554), ..call }),
        plain("no task has port 554", AdsError::TARGET_PORT_NOT_FOUND)
    );
    assert_eq!(
        refused(Call { index_group: IndexGroup::new(0xF005), ..call }),
        plain("no function has index group 0xf005", AdsError::INVALID_GROUP)
    );
    assert_eq!(
        refused(Call { index_offset: IndexOffset::new(0x4E), ..call }),
        plain("no function has index offset 0x4e", AdsError::INVALID_OFFSET)
    );
    assert_eq!(
        refused(Call { service: Service::Write, ..call }),
        plain("the function takes ReadWrite, not Write", AdsError::SERVICE_NOT_SUPPORTED)
    );
    let stream =
        "variable-name: name at offset 0: no NUL, one expected within 256 bytes, 1 there without";
    assert_eq!(refused(Call { data: b"V", ..call }), plain(stream, AdsError::INVALID_SIZE));
}
