//! The golden vectors, decoded: what a person would hold beside the manual.

#![cfg(feature = "alloc")]

use std::collections::BTreeMap;
use std::fmt::Write as _;

use ads_cnc::address::{AxisStride, IndexGroup, IndexOffset};
use ads_cnc::ads::*;
use ads_cnc::layout::Stream;
use ads_cnc::*;
use ads_cnc_vectors::{Expect, Vector, vectors};

/// Decodes both readings, encodes both again, and shows the owned one.
macro_rules! show {
    ($bytes:expr, $view:ty, $owned:ty) => {{
        let view = <$view>::decode($bytes).and_then(|view| view.to_vec());
        let owned = <$owned>::decode($bytes);
        let again = owned.as_ref().map_err(|error| *error).and_then(|owned| owned.to_vec());
        assert_eq!(view, again, "the readings disagree");
        if let Ok(again) = again {
            assert_eq!(again, $bytes, "encoded again");
        }
        owned.map(|owned| format!("{owned:#?}"))
    }};
}

fn decode(vector: &Vector, bytes: &[u8]) -> Result<String, Error> {
    match vector.stream.as_str() {
        "index-group" => {
            let group = IndexGroup::new(ObjectCount::decode(bytes)?.0);
            Ok(format!("{group} {:#?}", group.parts()))
        }
        "index-offset" => {
            let stride = match vector.context.stride {
                Some(0x1000) => AxisStride::X1000,
                _ => AxisStride::X10000,
            };
            let offset = IndexOffset::new(ObjectCount::decode(bytes)?.0);
            let (axis, element) = offset.axis_and_element(stride);
            IndexOffset::of_axis(stride, axis, element)?;
            Ok(format!("{offset} {stride:?}: axis {axis}, element {element:#x}"))
        }
        name => decode_stream(Stream::by_name(name).expect("a stream of the codec"), vector, bytes),
    }
}

fn decode_stream(stream: Stream, vector: &Vector, bytes: &[u8]) -> Result<String, Error> {
    match stream {
        Stream::AmsTcpHeader => show!(bytes, AmsTcpHeader, AmsTcpHeader),
        Stream::AmsHeader => show!(bytes, AmsHeader, AmsHeader),
        Stream::ReadRequest => show!(bytes, ReadRequest, ReadRequest),
        Stream::ReadReply => show!(bytes, ReadReplyRef<'_>, ReadReply),
        Stream::WriteRequest => show!(bytes, WriteRequestRef<'_>, WriteRequest),
        Stream::WriteReply => show!(bytes, WriteReply, WriteReply),
        Stream::ReadWriteRequest => show!(bytes, ReadWriteRequestRef<'_>, ReadWriteRequest),
        Stream::ReadWriteReply => show!(bytes, ReadWriteReplyRef<'_>, ReadWriteReply),
        Stream::ObjectCount => show!(bytes, ObjectCount, ObjectCount),
        Stream::ObjectDescriptor => show!(bytes, DescriptorRef<'_>, Descriptor),
        Stream::ObjectDescriptors => show!(bytes, DescriptorsRef<'_>, Descriptors),
        Stream::VariableKind => show!(bytes, VariableKindRef<'_>, VariableKind),
        Stream::VariableCount => show!(bytes, VariableCount, VariableCount),
        Stream::VariableIndexKind => show!(bytes, VariableIndexKindRef<'_>, VariableIndexKind),
        Stream::VariableDescription => show!(bytes, DescriptionRef<'_>, Description),
        Stream::VariableName => show!(bytes, VariableNameRef<'_>, VariableName),
        Stream::VariableHandle => show!(bytes, Handle, Handle),
        Stream::VariableHandleRead => show!(bytes, HandleReadRef<'_>, HandleRead),
        Stream::VariableValue => {
            show!(bytes, ValueRef<'_>, Value)?;
            elements(vector, bytes)
        }
        other => panic!("{other} has no decoder"),
    }
}

/// A value means something only by its type.
fn elements(vector: &Vector, bytes: &[u8]) -> Result<String, Error> {
    use ads_cnc_vectors::Type;
    let var_type = match vector.context.kind.expect("a value has a type") {
        Type::Boolean => VariableType::BOOLEAN,
        Type::Sgn08 => VariableType::SGN08,
        Type::Uns08 => VariableType::UNS08,
        Type::Sgn16 => VariableType::SGN16,
        Type::Uns16 => VariableType::UNS16,
        Type::Sgn32 => VariableType::SGN32,
        Type::Uns32 => VariableType::UNS32,
        Type::Real64 => VariableType::REAL64,
        Type::String => VariableType::STRING,
        other => panic!("no variable is a {other:?}"),
    };
    let dimensions = vector.context.dimensions.as_deref().unwrap_or_default();
    let elements = ValueRef::decode(bytes)?.elements(var_type, dimensions.into())?;
    Ok(format!("{var_type:?} {:?}", elements.collect::<Vec<_>>()))
}

/// Cuts what no person reads to the end.
fn short(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    match lines.len() {
        ..=60 => text.to_owned(),
        len => format!("{}\n… {} lines more", lines[..40].join("\n"), len - 40),
    }
}

/// Every vector is accepted or refused as it says, by both readings and with the same bytes again,
/// and looks as it did when a person last compared it with the manual.
#[test]
fn vectors_decode_as_they_did() {
    let mut streams: BTreeMap<&str, String> = BTreeMap::new();
    for vector in vectors() {
        let bytes = vector.bytes();
        let decoded = decode(vector, &bytes);
        assert_eq!(decoded.is_ok(), vector.is_accepted(), "{}: {decoded:?}", vector.id);
        let shown = match (&decoded, &vector.expect) {
            (Ok(value), _) => short(value),
            (Err(error), Expect::Reject(reject)) => {
                format!(
                    "refused: {error}\nthe vector: {} at offset {}",
                    reject.class, reject.offset
                )
            }
            (Err(error), Expect::Accept(_)) => panic!("{}: {error}", vector.id),
        };
        let all = streams.entry(&vector.stream).or_default();
        writeln!(all, "## {}: {}\n{shown}\n", vector.id, vector.title).unwrap();
    }
    assert!(streams.len() >= 20, "vectors of {} streams", streams.len());
    for (stream, shown) in streams {
        insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
            insta::assert_snapshot!(stream, shown);
        });
    }
}
