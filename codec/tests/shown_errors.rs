//! What a person is shown: errors, refusals, and values where one looks at them while debugging.

use std::error::Error as _;

use ads_cnc::address::{Channel, Class, ElementAddress, IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsNetId, AmsPort};
use ads_cnc::edition::{CncVersion, Edition};
use ads_cnc::layout::{Field, Stream};
use ads_cnc::limits::STREAM_MAX;
use ads_cnc::operation::*;
use ads_cnc::service::{ServiceId, ServiceVariable, SysServiceWait};
#[cfg(feature = "alloc")]
use ads_cnc::streaming::Checker;
use ads_cnc::streaming::{Ack, Interface, NcText, Sender};
use ads_cnc::value::{Boolean, DataType, Elements, Items, StringsRef};
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
            error(CncVersion::new("V3-1.3115")),
            (ErrorKind::Unexpected, "cnc-version: minor at offset 2: '-' may not stand here"),
        ),
        (
            error(CncVersion::new("V3\u{a0}1.3115")),
            (ErrorKind::Unexpected, "cnc-version: minor at offset 2: U+00A0 may not stand here"),
        ),
        (
            error(SysServiceWait::from_parameters(Some(0), Some(5000), None)),
            (ErrorKind::Missing, "sys-service-wait: @P3 at offset 8: missing"),
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

/// What a server refuses is told in words and as the number that goes back; a stream's error is
/// the source.
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
        (refusal.to_string(), refusal.ads_error(), refusal.source().map(ToString::to_string))
    };
    let plain = |text: &str, number| (text.to_string(), number, None);
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
    assert_eq!(
        refused(Call { data: b"V", ..call }),
        (stream.to_string(), AdsError::INVALID_SIZE, Some(stream.to_string()))
    );
}

/// Names as the manuals have them, and numbers as they are printed there.
#[test]
fn values_show_as_they_are_written() {
    let id = ServiceId::new("560aacbf-6335-44a9-895a-8b27f3ed5e47").unwrap();
    assert_eq!(
        format!("{id} {id:?}"),
        "560aacbf-6335-44a9-895a-8b27f3ed5e47 ServiceId(560aacbf-6335-44a9-895a-8b27f3ed5e47)"
    );
    let name = ServiceVariable::Request.name();
    assert_eq!(ServiceVariable::Request.to_string(), name);
    assert_eq!(VariablePath::new(name).map(|path| path.to_string()), Ok(name.to_string()));
    // A text in CP1252 is shown in characters.
    let wait = SysServiceWait::from_parameters(Some(0), Some(5000), Some(1)).unwrap();
    let call = service::Call::new(id, CncStr::new("2 for 1 €").unwrap(), wait).unwrap();
    assert!(format!("{call:?}").contains("\"2 for 1 €\""), "{call:?}");

    let version: CncVersion = "V.3.1.3081.07".parse().unwrap();
    assert_eq!(format!("{version} {version:?}"), "V3.1.3081.07 CncVersion(V3.1.3081.07)");
    for edition in Edition::ALL {
        assert_eq!(edition.to_string(), format!("{} {}", edition.document(), edition.number()));
    }
    let answers = [
        Edition::German.permits(Function::WriteByHandle, Kind::V_S, None),
        Edition::English.permits(Function::ReadByName, Kind::V_CYC, None),
        Edition::English.permits(Function::CountVariables, Kind::V_CYC, None),
    ];
    assert_eq!(
        answers.map(|answer| answer.to_string()),
        ["no (VAR-18)", "yes (VAR-14)", "no (VAR-1, assumed)"]
    );

    let error = AdsError::INVALID_SIZE;
    assert_eq!(format!("{error} {error:?}"), "0x705 0x705");
    assert_eq!(format!("{:?}", Kind::V_E), format!("{:?}", Kind::V_E.field()));
    assert!(format!("{:?}", Kind::V_E).contains("\"V.E\""));
    let field = Field::by_name(Stream::VariableHandle, "handle").unwrap();
    assert_eq!(format!("{field} {field:?}"), "variable-handle: handle variable-handle.handle");
    assert_eq!(Field::by_name(Stream::VariableHandle, "value"), None);
}

/// Readings of a value show their elements.
#[test]
fn typed_values_show_their_elements() {
    let elements = Elements::new(DataType::Sgn08, Numbers::from(&[3]), &[1, 2, 0xFF]).unwrap();
    assert_eq!(format!("{elements:?}"), "[Sgn08(1), Sgn08(2), Sgn08(-1)]");
    assert_eq!(format!("{:?}", elements.items::<i8>().unwrap()), "[1, 2, -1]");
    let truths = Items::<Boolean>::new(&[0, 1, 7]).unwrap();
    assert_eq!(format!("{truths:?}"), "[0, 1, 7]");
    let texts = StringsRef::new(b"ab\0c\0\0", 2).unwrap();
    let shown = texts.iter().map(|text| format!("{text:?}")).collect::<Vec<_>>();
    assert_eq!(format!("{texts:?}"), format!("[{}]", shown.join(", ")));
    assert!(shown[0].contains("\"ab\"") && shown[1].contains("\"c\""), "{shown:?}");
    #[cfg(feature = "alloc")]
    assert_eq!(format!("{:?}", value::Strings::from(texts)), format!("{texts:?}"));
}

/// The ends of a stream show where they stand, not the text.
#[test]
fn streaming_shows_where_it_stands() {
    let text = NcText::new(b"N10 X1\nN20 X2\nM30\n").unwrap();
    assert_eq!(format!("{text:?}"), "NcText(3 lines, 18 bytes)");
    let mut sender = Sender::new(text);
    let shown = |sender: &Sender<'_>| format!("{sender:?}");
    let ready = "Sender { text: NcText(3 lines, 18 bytes), state: Ready, sent: Progress { packets: 0, lines: 0, bytes: 0 }, refusals: 0, .. }";
    assert_eq!(shown(&sender), ready);
    let mut interface = Interface::default();
    assert_eq!(format!("{interface:?}"), format!("Interface(0 of {STREAM_MAX} bytes)"));
    assert_eq!(interface.write(sender.packet().unwrap()), Ack::Accepted);
    assert_eq!(format!("{interface:?}"), format!("Interface(21 of {STREAM_MAX} bytes)"));
    sender.acknowledge(Ack::Later).unwrap();
    assert_eq!(
        shown(&sender),
        ready.replace("Ready", "Waiting").replace("refusals: 0", "refusals: 1")
    );
    assert_eq!(format!("{:?}", text.findings()), "Findings { .. }");
    #[cfg(feature = "alloc")]
    {
        let mut checker = Checker::default();
        assert_eq!(format!("{:?}", checker.check(text.bytes())), "CheckedLines { .. }");
        assert_eq!(format!("{checker:?}"), "Checker(3 lines)");
    }
}
