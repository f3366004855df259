//! Fields and values as the vectors write them.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsHeader, AmsNetId};
use ads_cnc::text::cp1252_to_char;
use ads_cnc::{
    DescriptorRef, Element, Encode as _, Handle, Text, TextRef, VariableAccess, VariableType,
};
use ads_cnc_vectors::{Fields, Hex, Tagged, Type, Value};

/// Fields by their names.
pub(super) type Named = Vec<(&'static str, Value)>;

pub(super) fn collect(fields: Named) -> Fields {
    fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

pub(super) fn record(fields: Named) -> Value {
    Value::Record(collect(fields))
}

pub(super) fn tagged(kind: Type, value: impl ToString) -> Tagged {
    let value = Some(value.to_string());
    Tagged { kind, value, hex: None, bits: None, tail: None, open: false }
}

pub(super) fn one(kind: Type, value: impl ToString) -> Value {
    Value::One(tagged(kind, value))
}

pub(super) fn uns08(number: u8) -> Value {
    one(Type::Uns08, number)
}

pub(super) fn uns16(number: u16) -> Value {
    one(Type::Uns16, number)
}

pub(super) fn uns32(number: u32) -> Value {
    one(Type::Uns32, number)
}

pub(super) fn name(word: &str) -> Value {
    one(Type::Name, word)
}

pub(super) fn numbers(numbers: &[u32]) -> Value {
    Value::List(numbers.iter().copied().map(uns32).collect())
}

pub(super) fn data(bytes: &[u8]) -> Value {
    let hex = Some(Hex(bytes.to_vec()));
    Value::One(Tagged { kind: Type::Bytes, value: None, hex, bits: None, tail: None, open: false })
}

pub(super) fn owned_text(text: &Text) -> Value {
    Value::One(text_tagged(text.as_ref()))
}

pub(super) fn text_tagged(text: TextRef<'_>) -> Tagged {
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
pub(super) fn padded(bytes: &[u8]) -> Value {
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

pub(super) fn place(group: IndexGroup, offset: IndexOffset) -> Named {
    vec![("index_group", uns32(group.get())), ("index_offset", uns32(offset.get()))]
}

pub(super) fn reply_data(result: u32, bytes: Option<&[u8]>) -> Named {
    let mut fields = vec![("result", uns32(result))];
    fields.extend(bytes.map(|bytes| ("data", data(bytes))));
    fields
}

pub(super) fn ams_header(header: &AmsHeader) -> Named {
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

/// What both descriptions of a variable have.
pub(super) fn description(
    handle: Handle,
    var_type: VariableType,
    access: VariableAccess,
    size: u32,
    dimensions: &[u32],
) -> Named {
    vec![
        ("handle", uns32(handle.0)),
        ("type", uns32(var_type.0)),
        ("access", uns32(access.0)),
        ("size", uns32(size)),
        ("dimensions", numbers(dimensions)),
    ]
}

pub(super) fn descriptor(object: DescriptorRef<'_>) -> Named {
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

pub(super) fn element(element: Element<'_>) -> Tagged {
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
pub(super) fn decimal(number: f64) -> String {
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
