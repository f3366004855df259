//! Tests with the golden vectors. Snapshots contain their decoded values and the texts of errors,
//! for comparison with the manuals.

#![cfg(feature = "alloc")]

use std::collections::BTreeMap;
use std::fmt::Write as _;

use ads_cnc::address::{
    Addressing, AxisStride, Channel, ComTable, Group, IndexGroup, IndexOffset, PlatformAxis,
    Spindle,
};
use ads_cnc::ads::*;
use ads_cnc::dynamic::*;
use ads_cnc::layout::Stream;
use ads_cnc::sda::*;
use ads_cnc::value::DataType;
use ads_cnc::*;
use ads_cnc_vectors::{Expect, Vector, vectors};

/// Decodes bytes to both types of a stream, checks that both values encode to the same bytes, and
/// formats the owned value.
macro_rules! show {
    ($bytes:expr, $view:ty, $owned:ty) => {{
        let view = <$view>::decode($bytes).and_then(|view| view.encode_to_vec());
        let owned = <$owned>::decode($bytes);
        let again = owned.as_ref().map_err(|error| *error).and_then(|owned| owned.encode_to_vec());
        assert_eq!(view, again, "the readings disagree");
        if let Ok(again) = again {
            assert_eq!(again, $bytes, "encoded again");
        }
        owned.map(|owned| format!("{owned:#?}"))
    }};
}

/// An error: the name of its class in the vectors, and its text.
#[derive(Debug)]
struct Rejection(&'static str, String);

impl From<Error> for Rejection {
    fn from(error: Error) -> Self {
        Self(class(&error), error.to_string())
    }
}

fn decode(vector: &Vector, bytes: &[u8]) -> Result<String, Rejection> {
    match vector.stream.as_str() {
        "index-group" => {
            let group = IndexGroup::new(ObjectCount::decode(bytes)?.0);
            if let Some(base) = vector.context.base {
                assert_eq!(of_base(IndexGroup::new(base), group)?, group, "{}", vector.id);
            }
            Ok(format!("{group} {:#?}", group.parts()))
        }
        "variable-path" => Ok(path(bytes)?),
        "ams-frame" => frame(bytes),
        "index-offset" => {
            let stride = match vector.context.stride {
                Some(0x1000) => AxisStride::X1000,
                _ => AxisStride::X10000,
            };
            let offset = IndexOffset::new(ObjectCount::decode(bytes)?.0);
            let (axis, element) = offset.axis_and_element(stride)?;
            assert_eq!(IndexOffset::for_axis(stride, axis, element), Ok(offset), "{}", vector.id);
            Ok(format!("{offset} {stride:?}: axis {axis}, element {element:#x}"))
        }
        name => {
            let stream = Stream::by_name(name).expect("a stream of the codec");
            Ok(decode_stream(stream, vector, bytes)?)
        }
    }
}

macro_rules! shown {
    ($( $stream:ident: $view:ty $( , $owned:ty )?; )+) => {
        fn shown(stream: Stream, bytes: &[u8]) -> Result<String, Error> {
            match stream {
                $( Stream::$stream => shown!(@ bytes, $view $( , $owned )?), )+
                other => panic!("{other} has no decoder"),
            }
        }
    };
    (@ $bytes:ident, $both:ty) => { show!($bytes, $both, $both) };
    (@ $bytes:ident, $view:ty, $owned:ty) => { show!($bytes, $view, $owned) };
}

ads_cnc::streams! { shown }

fn decode_stream(stream: Stream, vector: &Vector, bytes: &[u8]) -> Result<String, Error> {
    let shown = shown(stream, bytes)?;
    let value = match stream {
        Stream::VariableValue => return elements(vector, bytes),
        Stream::Content if vector.context.kind.is_some() => return elements(vector, bytes),
        Stream::VariableHandleWrite => HandleWriteRef::decode(bytes)?.value,
        Stream::VariableNameWrite => NameWriteRef::decode(bytes)?.value,
        _ => return Ok(shown),
    };
    Ok(format!("{shown}\n{}", elements(vector, value)?))
}

/// Builds the group from its base and the number of the channel, axis or spindle, which is the
/// difference of both.
fn of_base(base: IndexGroup, group: IndexGroup) -> Result<IndexGroup, Error> {
    let number = group.get().wrapping_sub(base.get());
    Ok(match base.parts().expect("a documented base") {
        Group::Com(com) if com.table == ComTable::Axis => {
            PlatformAxis::new(number)?.com(com.access)
        }
        // Without a number, the group is that of the platform.
        Group::Com(_) if number == 0 => base,
        Group::Com(com) => channel(com.addressing, number)?.com(com.access),
        Group::Class(class) if base.get() == 0x2_5300 => {
            Spindle::new(number)?.class(class.attribute)
        }
        Group::Class(class) => {
            channel(class.addressing, number)?.class(class.class, class.attribute)
        }
    })
}

fn channel(addressing: Addressing, number: u32) -> Result<Channel, Error> {
    match addressing {
        Addressing::Logical => Channel::new(number),
        Addressing::Index => Channel::by_index(number),
    }
}

/// Parses a name, checks that the name built from its parts has the same parts, and formats these
/// parts.
fn path(bytes: &[u8]) -> Result<String, Error> {
    let path = VariablePath::from_text(CncStr::from_bytes(bytes)?)?;
    let again = without_zeros(bytes)?;
    // A built name has no leading zeros in its indices, so it may differ from the parsed name.
    let again = VariablePath::from_text(CncStr::from_bytes(&again)?)?;
    assert!(again.parts().eq(path.parts()), "{path} and {again}");
    let parts: Vec<String> = path.parts().map(|part| part.to_string()).collect();
    Ok(format!("{} {parts:?}, elements {:?}", path.kind().text(), path.elements()))
}

fn without_zeros(path: &[u8]) -> Result<Vec<u8>, Error> {
    let path = VariablePath::from_text(CncStr::from_bytes(path)?)?;
    let mut buf = [0; limits::NAME_MAX];
    Ok(VariablePath::write(path.kind(), path.parts(), &mut buf)?.text().bytes().collect())
}

/// Splits off a frame, decodes the data of its service, checks that both encode to the same bytes,
/// and formats them.
fn frame(bytes: &[u8]) -> Result<String, Rejection> {
    let Some((frame, len)) = FrameRef::split(bytes, u32::MAX)? else {
        // The frame is not complete. Decode the received part, to find the error for the truncated
        // field.
        let (tcp, rest) = bytes.split_at(bytes.len().min(limits::AMS_TCP_HEADER_LEN));
        AmsTcpHeader::decode(tcp)?;
        let (header, data) = rest.split_at(rest.len().min(limits::AMS_HEADER_LEN));
        let header = AmsHeader::decode(header)?;
        service(&header, data)?;
        // The data present is accepted, so the error names no field.
        return Err(Rejection("truncated", format!("more of {} bytes", header.data_length)));
    };
    // Bytes after the frame belong to the next frame; here, they are trailing bytes of the service.
    let shown = service(&frame.header(), &bytes[FrameRef::HEADERS_LEN..])?;
    if len != bytes.len() {
        return Err(Rejection("trailing", format!("a frame of {len} bytes, and another")));
    }
    let mut buf = vec![0; bytes.len()];
    let again = FrameRef::new(frame.header(), frame.data())?.encode(&mut buf)?;
    assert_eq!(again, bytes, "encoded again");
    Ok(format!("{:#?}\n{shown}", frame.header()))
}

fn service(header: &AmsHeader, data: &[u8]) -> Result<String, Error> {
    if data.is_empty() && header.error != AdsError::NO_ERROR {
        return Ok("no payload".to_owned());
    }
    match (header.command, header.state_flags) {
        (Command::READ, StateFlags::REQUEST) => show!(data, ReadRequest, ReadRequest),
        (Command::READ, StateFlags::RESPONSE) => show!(data, ReadReplyRef<'_>, ReadReply),
        (Command::WRITE, StateFlags::REQUEST) => show!(data, WriteRequestRef<'_>, WriteRequest),
        (Command::WRITE, StateFlags::RESPONSE) => show!(data, WriteReply, WriteReply),
        (Command::READ_WRITE, StateFlags::REQUEST) => {
            show!(data, ReadWriteRequestRef<'_>, ReadWriteRequest)
        }
        (Command::READ_WRITE, StateFlags::RESPONSE) => {
            show!(data, ReadWriteReplyRef<'_>, ReadWriteReply)
        }
        _ => Ok(format!("{data:02x?}")),
    }
}

/// Formats the elements of a value or content, decoded by the type of the vector.
fn elements(vector: &Vector, bytes: &[u8]) -> Result<String, Error> {
    let name = vector.context.kind.expect("a value has a type").name();
    let data_type = DataType::by_name(CncStr::new(name)?).expect("a type of the manuals");
    let dimensions = vector.context.dimensions.as_deref().unwrap_or_default();
    let elements = Elements::new(data_type, dimensions.into(), bytes)?;
    Ok(format!("{name} {:?}", elements.iter().collect::<Vec<_>>()))
}

/// Vectors whose stated class differs from the class of the codec's error, with the latter. The
/// class in a vector is only advisory.
const OTHERWISE: &[(&str, &str)] = &[
    // The codec decodes record by record and reports the truncated field.
    ("descriptors-cut", "truncated"),
    ("descriptors-trailing", "truncated"),
    ("descriptors-none", "truncated"),
    ("descriptors-83-bytes", "truncated"),
    ("descriptors-85-bytes", "truncated"),
    // The codec checks the maximum length of the stream first.
    ("handle-read-2052-bytes", "too-long"),
    ("handle-write-511-indices", "too-long"),
    // For an extended description, which may be empty, the codec checks the maximum length first.
    ("extended-trailing", "too-long"),
    // The codec first checks the maximum length of the data of any service.
    ("frame-tcp-length-huge", "too-long"),
    // The codec reports that the size of the value and the dimensions are inconsistent.
    ("value-strings-2-odd", "mismatch"),
    ("value-strings-2-none", "mismatch"),
    ("value-strings-2-by-2-three", "mismatch"),
    ("content-strings-2-odd", "mismatch"),
];

fn class(error: &Error) -> &'static str {
    match error.kind() {
        ErrorKind::Truncated => "truncated",
        ErrorKind::Trailing => "trailing",
        ErrorKind::TooLong => "too-long",
        ErrorKind::TooMany => "too-many",
        ErrorKind::MissingNul => "missing-nul",
        ErrorKind::OutOfRange => "out-of-range",
        ErrorKind::Mismatch => "mismatch",
        ErrorKind::Unexpected => "unexpected",
        ErrorKind::InnerNul => "not-text",
        other => panic!("no vector is rejected as {other:?}"),
    }
}

/// Decodes a vector and encodes its value in the canonical form.
fn canonical(stream: &str, bytes: &[u8]) -> Result<Vec<u8>, Error> {
    /// Encodes the stream with one NUL after this text.
    macro_rules! plain {
        ($stream:ident.$text:ident) => {{
            let mut value = $stream::decode(bytes)?;
            value.$text = value.$text.text.into();
            value.encode_to_vec()
        }};
    }
    match stream {
        "variable-kind" => plain!(VariableKind.kind),
        "variable-index-kind" => plain!(VariableIndexKind.kind),
        "variable-name" => plain!(VariableName.name),
        "variable-description" => plain!(Description.name),
        "element-text" => plain!(ElementText.text),
        "element-length" => ElementLength::new(ElementLength::decode(bytes)?.get()).encode_to_vec(),
        "element-write-flag" => match ElementWriteFlag::decode(bytes)?.is_writable() {
            true => ElementWriteFlag::WRITABLE.encode_to_vec(),
            false => ElementWriteFlag::READ_ONLY.encode_to_vec(),
        },
        "dynamic-name" => plain!(DynamicName.name),
        "dynamic-name-request" => plain!(DynamicNameRequest.name),
        "device-info-reply" => {
            let info = DeviceInfoReply::decode(bytes)?;
            let mut name = [0; 16];
            name.iter_mut().zip(info.name().bytes()).for_each(|(byte, of)| *byte = of);
            DeviceInfoReply { name, ..info }.encode_to_vec()
        }
        "variable-path" => without_zeros(bytes),
        "object-descriptor" => {
            let object = Descriptor::decode(bytes)?;
            let access = match object.write_access().is_writable() {
                true => WriteAccess::WRITABLE,
                false => WriteAccess::READ_ONLY,
            };
            Descriptor::from_text(object.name(), object.type_name())?
                .with_id(object.id())
                .with_size(object.size())
                .with_write_access(access)
                .with_not_assigned(object.not_assigned())
                .with_content(object.index_group(), object.index_offset())
                .encode_to_vec()
        }
        other => panic!("{other} has no other form"),
    }
}

/// If a vector states a canonical form, and is neither a value nor a content, the codec can encode
/// the decoded value in this form, for example a text with one NUL, or TRUE as 1.
#[test]
fn canonical_forms_are_written() {
    let mut seen = 0;
    for vector in vectors() {
        let Expect::Accept(accept) = &vector.expect else { continue };
        let Some(wanted) = &accept.canonical else { continue };
        // Skip values and contents, which the codec keeps as bytes: it does not change the end of a
        // text or the byte of a BOOLEAN.
        if ["variable-value", "variable-handle-write", "variable-name-write", "content"]
            .contains(&vector.stream.as_str())
        {
            continue;
        }
        let written = canonical(&vector.stream, &vector.bytes());
        assert_eq!(written.as_deref(), Ok(&wanted[..]), "{}", vector.id);
        seen += 1;
    }
    assert!(seen >= 26, "{seen} vectors have a canonical form");
}

/// Shortens the text of a value for a snapshot: up to sixteen numbers of a list are on one line,
/// and bytes are shown as a hex dump with their ASCII characters. Of more than 60 lines, the first
/// 40 are kept.
fn short(text: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut numbers: Vec<&str> = Vec::new();
    let mut field = "";
    for line in text.lines() {
        let word = line.trim_start();
        match word.strip_suffix(',') {
            Some(n) if n.bytes().all(|c| c.is_ascii_digit()) => numbers.push(n),
            _ => {
                let indent = line.len() - word.len() + 4;
                for row in numbers.chunks(16) {
                    lines.push(format!("{:indent$}{}", "", row_of(field, row)));
                }
                numbers.clear();
                field = word.split_once(": ").map_or(field, |(name, _)| name);
                lines.push(line.to_owned());
            }
        }
    }
    match lines.len() {
        ..=60 => lines.join("\n"),
        len => format!("{}\n… {} lines more", lines[..40].join("\n"), len - 40),
    }
}

fn row_of(field: &str, row: &[&str]) -> String {
    if !["bytes", "data", "value"].contains(&field) {
        return format!("{},", row.join(", "));
    }
    let bytes: Vec<u8> = row.iter().map(|n| n.parse().expect("a byte")).collect();
    let hex: Vec<String> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    let seen = |byte: &u8| if (0x20..0x7f).contains(byte) { char::from(*byte) } else { '.' };
    format!("{:47}  |{}|", hex.join(" "), bytes.iter().map(seen).collect::<String>())
}

/// Every vector is accepted or rejected as it specifies, a stream by both of its types. Accepted
/// streams and frames encode to the same bytes. The snapshots contain the decoded values and the
/// texts of errors.
#[test]
fn vectors_decode_as_they_did() {
    let mut streams: BTreeMap<&str, String> = BTreeMap::new();
    let mut misnamed = Vec::new();
    for vector in vectors() {
        let bytes = vector.bytes();
        let decoded = decode(vector, &bytes);
        assert_eq!(decoded.is_ok(), vector.is_accepted(), "{}: {decoded:?}", vector.id);
        let shown = match (&decoded, &vector.expect) {
            (Ok(value), _) => short(value),
            (Err(Rejection(class, error)), Expect::Reject(reject)) => {
                let named = OTHERWISE.iter().find(|(id, _)| *id == vector.id);
                let wanted = named.map_or(reject.class.as_str(), |(_, class)| class);
                if *class != wanted {
                    misnamed.push(format!("{}: {wanted}, not {error}", vector.id));
                }
                format!(
                    "rejected: {error}\nthe vector: {} at offset {}",
                    reject.class, reject.offset
                )
            }
            (Err(error), Expect::Accept(_)) => panic!("{}: {error:?}", vector.id),
        };
        let all = streams.entry(&vector.stream).or_default();
        writeln!(all, "## {}: {}\n{shown}\n", vector.id, vector.title).unwrap();
    }
    assert!(misnamed.is_empty(), "{misnamed:#?}");
    assert!(streams.len() >= 40, "vectors of {} streams", streams.len());
    for (stream, shown) in streams {
        insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
            insta::assert_snapshot!(stream, shown);
        });
    }
}
