//! This project's codec as the vectors see it: bytes in, fields or a refusal out, and back again.

mod address;
mod elements;
mod encode;
mod fields;
mod frame;
mod given;
pub mod message;
mod path;

pub use encode::encode;
use fields::{
    Named, ams_header, collect, data, description, descriptor, element, name, numbers, one,
    owned_text, padded, place, record, reply_data, text_tagged, uns08, uns16, uns32,
};

use ads_cnc::ads::{
    AmsTcpHeader, DeviceInfoReply, DeviceStateReply, ReadReply, ReadRequest, ReadWriteReply,
    ReadWriteRequest, WriteReply, WriteRequest,
};
use ads_cnc::streaming::ProgramStream;
use ads_cnc::value::DataType;
use ads_cnc::{
    CncStr, Decode, Description, Descriptor, Descriptors, Elements, Encode, Error, ErrorKind,
    ExtendedReply, Handle, HandleRead, HandleWrite, NameWrite, Numbers, ObjectCount, TextRef,
    Value as CncValue, VariableCount, VariableIndexKind, VariableKind, VariableName,
};
use ads_cnc_vectors::{Context, Fields, Tagged, Value};

/// What the codec makes of a stream: its fields, and the bytes it encodes to again.
#[derive(Debug, PartialEq)]
pub struct Decoded {
    /// The fields under their names, without what only counts.
    pub fields: Fields,
    /// Encoded again.
    pub bytes: Vec<u8>,
}

/// Why the codec has no answer.
#[derive(Debug)]
pub enum Refused {
    /// It refuses the bytes.
    Error(Error),
    /// These fields are no value of the stream.
    Unfit(String),
    /// It does not know the stream, or the context lacks what it needs.
    Unsupported(String),
}

impl From<Error> for Refused {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

/// The class of an error under the name vectors give it.
pub fn class(error: &Error) -> &'static str {
    match error.kind() {
        ErrorKind::Truncated => "truncated",
        ErrorKind::Trailing => "trailing",
        ErrorKind::TooLong => "too-long",
        ErrorKind::TooMany => "too-many",
        ErrorKind::MissingNul => "missing-nul",
        ErrorKind::InnerNul => "not-text",
        ErrorKind::NotCp1252 => "not-text",
        ErrorKind::Unexpected | ErrorKind::NotDecimal => "unexpected",
        ErrorKind::Digits => "out-of-range",
        ErrorKind::Missing => "truncated",
        ErrorKind::OutOfRange => "out-of-range",
        ErrorKind::Mismatch => "mismatch",
        _ => "other",
    }
}

/// Decodes `bytes` as the stream of this name.
///
/// # Errors
/// The codec's refusal.
pub fn decode_stream(name: &str, context: &Context, bytes: &[u8]) -> Result<Decoded, Refused> {
    let (fields, bytes) = match name {
        "ams-tcp-header" => stream(bytes, |header: &AmsTcpHeader| {
            vec![("reserved", uns16(header.reserved)), ("length", uns32(header.length))]
        }),
        "ams-header" => stream(bytes, ams_header),
        "read-request" => stream(bytes, |read: &ReadRequest| {
            let mut fields = place(read.index_group, read.index_offset);
            fields.push(("length", uns32(read.length)));
            fields
        }),
        "read-reply" => {
            stream(bytes, |reply: &ReadReply| reply_data(reply.result.0, reply.data.as_deref()))
        }
        "write-request" => stream(bytes, |write: &WriteRequest| {
            let mut fields = place(write.index_group, write.index_offset);
            fields.push(("data", data(&write.data)));
            fields
        }),
        "write-reply" => {
            stream(bytes, |reply: &WriteReply| vec![("result", uns32(reply.result.0))])
        }
        "read-write-request" => stream(bytes, |both: &ReadWriteRequest| {
            let mut fields = place(both.index_group, both.index_offset);
            fields.push(("read_length", uns32(both.read_length)));
            fields.push(("data", data(&both.data)));
            fields
        }),
        "read-write-reply" => stream(bytes, |reply: &ReadWriteReply| {
            reply_data(reply.result.0, reply.data.as_deref())
        }),
        "device-info-reply" => stream(bytes, |reply: &DeviceInfoReply| {
            vec![
                ("result", uns32(reply.result.0)),
                ("major", uns08(reply.major)),
                ("minor", uns08(reply.minor)),
                ("build", uns16(reply.build)),
                ("name", padded(&reply.name)),
            ]
        }),
        "device-state-reply" => stream(bytes, |reply: &DeviceStateReply| {
            vec![
                ("result", uns32(reply.result.0)),
                ("ads_state", uns16(reply.ads_state.0)),
                ("device_state", uns16(reply.device_state)),
            ]
        }),
        "object-count" => stream(bytes, |count: &ObjectCount| vec![("count", uns32(count.0))]),
        "object-descriptor" => stream(bytes, |object: &Descriptor| descriptor(object.as_ref())),
        "object-descriptors" => stream(bytes, |objects: &Descriptors| {
            let records = objects.as_ref().iter().map(|object| record(descriptor(object)));
            vec![("descriptors", Value::List(records.collect()))]
        }),
        "variable-kind" => {
            stream(bytes, |request: &VariableKind| vec![("kind", owned_text(&request.kind))])
        }
        "variable-count" => stream(bytes, |count: &VariableCount| vec![("count", uns32(count.0))]),
        "variable-index-kind" => stream(bytes, |request: &VariableIndexKind| {
            vec![("index", uns32(request.index)), ("kind", owned_text(&request.kind))]
        }),
        "variable-description" => stream(bytes, |variable: &Description| {
            let Description { handle, var_type, access, size, .. } = *variable;
            let mut fields = description(handle, var_type, access, size, &variable.dimensions);
            fields.push(("name", owned_text(&variable.name)));
            fields
        }),
        "variable-name" => {
            stream(bytes, |request: &VariableName| vec![("name", owned_text(&request.name))])
        }
        "variable-handle" => stream(bytes, |handle: &Handle| vec![("handle", uns32(handle.0))]),
        "variable-handle-read" => stream(bytes, |request: &HandleRead| {
            vec![("handle", uns32(request.handle.0)), ("indices", numbers(&request.indices))]
        }),
        "variable-value" => {
            let elements = elements(context, bytes)?;
            stream(bytes, |_: &CncValue| vec![("value", elements)])
        }
        "variable-handle-write" => {
            let elements = elements(context, &HandleWrite::decode(bytes)?.value)?;
            stream(bytes, |request: &HandleWrite| {
                vec![
                    ("handle", uns32(request.handle.0)),
                    ("indices", numbers(&request.indices)),
                    ("value", elements),
                ]
            })
        }
        "variable-name-write" => {
            let elements = elements(context, &NameWrite::decode(bytes)?.value)?;
            stream(bytes, |request: &NameWrite| {
                let name = TextRef::from(request.name.as_cnc_str());
                vec![("name", Value::One(text_tagged(name))), ("value", elements)]
            })
        }
        "variable-extended-description" => stream(bytes, |reply: &ExtendedReply| match reply.0 {
            None => Vec::new(),
            Some(extended) => vec![
                ("synchronisation", uns32(extended.synchronisation.0)),
                ("validity", uns32(extended.validity.0)),
            ],
        }),
        "variable-path" => return path::decode(bytes),
        "program-stream" => {
            stream(bytes, |write: &ProgramStream| vec![("data", data(&write.bytes))])
        }
        "ams-frame" => return frame::decode(context, bytes),
        "index-group" => return address::index_group(context, bytes),
        "index-offset" => return address::index_offset(context, bytes),
        other => return elements::decode(other, context, bytes),
    }?;
    Ok(Decoded { fields, bytes })
}

fn stream<T>(bytes: &[u8], fields: impl FnOnce(&T) -> Named) -> Result<(Fields, Vec<u8>), Refused>
where
    T: for<'a> Decode<'a> + Encode,
{
    let value = T::decode(bytes)?;
    Ok((collect(fields(&value)), value.encode_to_vec()?))
}

/// A value or a content by its type, whose name the elements keep.
fn elements(context: &Context, bytes: &[u8]) -> Result<Value, Refused> {
    let lacks = |what: &str| Refused::Unsupported(format!("a value without {what}"));
    let kind = context.kind.ok_or_else(|| lacks("a type"))?;
    let dimensions = context.dimensions.as_deref().ok_or_else(|| lacks("dimensions"))?;
    let Some(data_type) = DataType::by_name(CncStr::new(kind.name())?) else {
        return Err(Refused::Unsupported(format!("values of type {kind:?}")));
    };
    let elements = Elements::new(data_type, Numbers::from(dimensions), bytes)?;
    let named = |item| Value::One(Tagged { kind, ..element(item) });
    Ok(Value::List(elements.iter().map(named).collect()))
}
