//! This project's codec as the vectors see it: bytes in, fields or a refusal out, and back again.

mod address;
mod elements;
mod encode;
mod frame;
mod given;
mod path;

pub use encode::encode;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{
    AmsHeader, AmsNetId, AmsTcpHeader, DeviceInfoReply, DeviceStateReply, ReadReply, ReadRequest,
    ReadWriteReply, ReadWriteRequest, WriteReply, WriteRequest,
};
use ads_cnc::streaming::ProgramStream;
use ads_cnc::text::cp1252_to_char;
use ads_cnc::value::DataType;
use ads_cnc::{
    CncStr, Decode, Description, Descriptor, DescriptorRef, Descriptors, Element, Elements, Encode,
    Error, ErrorKind, ExtendedReply, Handle, HandleRead, HandleWrite, NameWrite, Numbers,
    ObjectCount, Text, TextRef, Value as CncValue, VariableCount, VariableIndexKind, VariableKind,
    VariableName,
};
use ads_cnc_vectors::{Context, Fields, Hex, Tagged, Type, Value};

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
            vec![
                ("handle", uns32(variable.handle.0)),
                ("type", uns32(variable.var_type.0)),
                ("access", uns32(variable.access.0)),
                ("size", uns32(variable.size)),
                ("dimensions", numbers(&variable.dimensions)),
                ("name", owned_text(&variable.name)),
            ]
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

type Named = Vec<(&'static str, Value)>;

fn stream<T>(bytes: &[u8], fields: impl FnOnce(&T) -> Named) -> Result<(Fields, Vec<u8>), Refused>
where
    T: for<'a> Decode<'a> + Encode,
{
    let value = T::decode(bytes)?;
    Ok((collect(fields(&value)), value.to_vec()?))
}

fn collect(fields: Named) -> Fields {
    fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn record(fields: Named) -> Value {
    Value::Record(collect(fields))
}

fn tagged(kind: Type, value: impl ToString) -> Tagged {
    let value = Some(value.to_string());
    Tagged { kind, value, hex: None, bits: None, tail: None, open: false }
}

fn one(kind: Type, value: impl ToString) -> Value {
    Value::One(tagged(kind, value))
}

fn uns08(number: u8) -> Value {
    one(Type::Uns08, number)
}

fn uns16(number: u16) -> Value {
    one(Type::Uns16, number)
}

fn uns32(number: u32) -> Value {
    one(Type::Uns32, number)
}

fn name(word: &str) -> Value {
    one(Type::Name, word)
}

fn numbers(numbers: &[u32]) -> Value {
    Value::List(numbers.iter().copied().map(uns32).collect())
}

fn data(bytes: &[u8]) -> Value {
    let hex = Some(Hex(bytes.to_vec()));
    Value::One(Tagged { kind: Type::Bytes, value: None, hex, bits: None, tail: None, open: false })
}

fn owned_text(text: &Text) -> Value {
    Value::One(text_tagged(text.as_ref()))
}

fn text_tagged(text: TextRef<'_>) -> Tagged {
    let bytes: Vec<u8> = text.text().bytes().collect();
    Tagged {
        kind: Type::String,
        value: Some(bytes.iter().copied().map(cp1252_to_char).collect()),
        hex: Some(Hex(bytes)),
        bits: None,
        tail: text.tail().filter(|tail| !tail.is_empty()).map(|tail| Hex(tail.to_vec())),
        open: text.tail().is_none(),
    }
}

/// A text in a field of fixed size: its tail counts only if it is more than padding.
fn padded(bytes: &[u8]) -> Value {
    let nul = bytes.iter().position(|&byte| byte == 0);
    let (text, tail) = bytes.split_at(nul.unwrap_or(bytes.len()));
    let odd = tail.iter().any(|&byte| byte != 0);
    Value::One(Tagged {
        kind: Type::String,
        value: Some(text.iter().copied().map(cp1252_to_char).collect()),
        hex: Some(Hex(text.to_vec())),
        bits: None,
        tail: odd.then(|| Hex(tail.iter().skip(1).copied().collect())),
        open: nul.is_none(),
    })
}

fn place(group: IndexGroup, offset: IndexOffset) -> Named {
    vec![("index_group", uns32(group.get())), ("index_offset", uns32(offset.get()))]
}

fn reply_data(result: u32, bytes: Option<&[u8]>) -> Named {
    let mut fields = vec![("result", uns32(result))];
    fields.extend(bytes.map(|bytes| ("data", data(bytes))));
    fields
}

fn ams_header(header: &AmsHeader) -> Named {
    let net_id = |id: AmsNetId| one(Type::NetId, id);
    vec![
        ("target_net_id", net_id(header.target.net_id)),
        ("target_port", uns16(header.target.port.0)),
        ("source_net_id", net_id(header.source.net_id)),
        ("source_port", uns16(header.source.port.0)),
        ("command", uns16(header.command.0)),
        ("state_flags", uns16(header.state_flags.0)),
        ("data_length", uns32(header.data_length)),
        ("error", uns32(header.error.0)),
        ("invoke_id", uns32(header.invoke_id)),
    ]
}

fn descriptor(object: DescriptorRef<'_>) -> Named {
    let mut buf = [0; ads_cnc::limits::DESCRIPTOR_LEN];
    let bytes = object.encode(&mut buf).unwrap_or_default();
    vec![
        ("id", uns32(object.id())),
        ("size", uns32(object.size())),
        ("write_access", uns16(object.write_access().0)),
        ("not_assigned", uns16(object.not_assigned())),
        ("index_group", uns32(object.index_group().get())),
        ("index_offset", uns32(object.index_offset().get())),
        ("name", padded(bytes.get(20..52).unwrap_or_default())),
        ("type", padded(bytes.get(52..84).unwrap_or_default())),
    ]
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

fn element(element: Element<'_>) -> Tagged {
    match element {
        Element::Boolean(boolean) => tagged(Type::Boolean, boolean.0),
        Element::Sgn08(number) => tagged(Type::Sgn08, number),
        Element::Uns08(number) => tagged(Type::Uns08, number),
        Element::Sgn16(number) => tagged(Type::Sgn16, number),
        Element::Uns16(number) => tagged(Type::Uns16, number),
        Element::Sgn32(number) => tagged(Type::Sgn32, number),
        Element::Uns32(number) => tagged(Type::Uns32, number),
        Element::Lint(number) => tagged(Type::Lint, number),
        Element::Lword(number) => tagged(Type::Lword, number),
        Element::Real32(number) => Tagged {
            bits: Some(format!("{:#010x}", number.to_bits())),
            ..tagged(Type::Real32, decimal(number.into()))
        },
        Element::Real64(number) => Tagged {
            bits: Some(format!("{:#018x}", number.to_bits())),
            ..tagged(Type::Real64, decimal(number))
        },
        Element::String(text) => text_tagged(text),
        other => tagged(Type::Name, format_args!("{other:?}")),
    }
}

/// The shortest decimal of a float as the vectors have it: an exponent has a sign and two digits.
fn decimal(number: f64) -> String {
    let shortest = format!("{number:?}").to_lowercase();
    match shortest.split_once('e') {
        None => shortest,
        Some((digits, exponent)) => {
            let (sign, exponent) = match exponent.strip_prefix('-') {
                Some(exponent) => ('-', exponent),
                None => ('+', exponent),
            };
            format!("{digits}e{sign}{exponent:0>2}")
        }
    }
}
