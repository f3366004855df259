//! Streams by their Rust types and field tables: serde converts a value to and from JSON, and the
//! table has the types with which the vectors tag the fields.

use ads_cnc::ads::AmsNetId;
use ads_cnc::dynamic::DynamicValue;
use ads_cnc::layout::{FieldSpec, Layout, Size, Stream, Type as FieldType};
use ads_cnc::value::Element;
use ads_cnc::{Decode, Encode, Text};
use ads_cnc_vectors::{Context, Fields, Tagged, Type, Value};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value as Json, from_value, json, to_value};

use super::field_reader::{bits, invalid, text};
use super::fields::{element, one, text_tagged};
use super::{CodecError, Decoded, typed_values};

macro_rules! dispatch {
    ($( $stream:ident: $view:ty $( , $owned:ty )?; )+) => {
        /// Decodes a stream by its name.
        pub(super) fn decode(name: &str, context: &Context, bytes: &[u8]) -> Result<Decoded, CodecError> {
            match Stream::by_name(name) {
                $( Some(Stream::$stream) => decoded::<dispatch!(@ $view $( , $owned )?)>(context, bytes), )+
                _ => Err(unknown(name)),
            }
        }

        /// Encodes fields as a stream by its name.
        pub(super) fn encode(name: &str, context: &Context, fields: &Fields) -> Result<Vec<u8>, CodecError> {
            match Stream::by_name(name) {
                $( Some(Stream::$stream) => encoded::<dispatch!(@ $view $( , $owned )?)>(context, fields), )+
                _ => Err(unknown(name)),
            }
        }
    };
    (@ $both:ty) => { $both };
    (@ $view:ty, $owned:ty) => { $owned };
}

ads_cnc::streams! { dispatch }

fn unknown(name: &str) -> CodecError {
    CodecError::Unsupported(format!("stream {name}"))
}

fn decoded<T>(context: &Context, bytes: &[u8]) -> Result<Decoded, CodecError>
where
    T: for<'a> Decode<'a> + Encode + Serialize,
{
    let value = T::decode(bytes)?;
    Ok(Decoded { fields: to_fields(context, &value)?, bytes: value.encode_to_vec()? })
}

fn encoded<T>(context: &Context, fields: &Fields) -> Result<Vec<u8>, CodecError>
where
    T: for<'a> Decode<'a> + Encode + DeserializeOwned,
{
    Ok(from_fields::<T>(context, fields)?.encode_to_vec()?)
}

/// Converts a value to fields, without counters (fields that contain a length or a number of
/// items).
pub(super) fn to_fields<T>(context: &Context, value: &T) -> Result<Fields, CodecError>
where
    T: for<'a> Decode<'a> + Serialize,
{
    let layout = T::STREAM.layout();
    let json = to_value(value).map_err(invalid)?;
    match json.as_array() {
        Some(records) if layout.repeats => {
            let records = records.iter().map(|one| record(layout, context, one).map(Value::Record));
            let records = records.collect::<Result<_, CodecError>>()?;
            Ok([(records_of(layout).to_owned(), Value::List(records))].into())
        }
        _ => record(layout, context, &json),
    }
}

pub(super) fn from_fields<T>(context: &Context, fields: &Fields) -> Result<T, CodecError>
where
    T: for<'a> Decode<'a> + DeserializeOwned,
{
    let layout = T::STREAM.layout();
    if layout.repeats {
        let name = records_of(layout);
        let records = fields.get(name).and_then(Value::list);
        let records = records.ok_or_else(|| invalid(format_args!("{name} is not a list")))?;
        let record = |one: &Value| match one {
            Value::Record(fields) => Ok(Json::Object(json_record(layout, context, fields)?)),
            _ => Err(invalid("a record is expected")),
        };
        let records = records.iter().map(record).collect::<Result<_, CodecError>>()?;
        return from_value(Json::Array(records)).map_err(invalid);
    }
    let record = json_record(layout, context, fields)?;
    if record.is_empty() {
        return from_value(Json::Null).map_err(invalid);
    }
    let single = match layout.fields {
        [row] => record.get(row.name).cloned(),
        _ => None,
    };
    from_value(Json::Object(record))
        .or_else(|error| single.and_then(|single| from_value(single).ok()).ok_or(error))
        .map_err(invalid)
}

/// The name of the field that contains the records of a stream in the vectors: the last word of the
/// stream's name.
fn records_of(layout: &Layout) -> &'static str {
    layout.name.rsplit('-').next().unwrap_or(layout.name)
}

fn record(layout: &Layout, context: &Context, json: &Json) -> Result<Fields, CodecError> {
    // The Rust type of a stream with a single field may be serialized as the value of this field.
    let single = match layout.fields {
        [row] if json.get(row.name).is_none() => Some(json),
        _ => None,
    };
    let mut fields = Fields::new();
    for row in layout.fields {
        // The JSON has no counters; an absent optional field is null.
        let given = single.or_else(|| json.get(row.name));
        if let Some(given) = given.filter(|given| !given.is_null()) {
            fields.insert(row.name.to_owned(), field(row, context, given)?);
        }
    }
    Ok(fields)
}

fn json_record(
    layout: &Layout,
    context: &Context,
    fields: &Fields,
) -> Result<Map<String, Json>, CodecError> {
    let given = layout.fields.iter().filter_map(|row| Some((row, fields.get(row.name)?)));
    given.map(|(row, value)| Ok((row.name.to_owned(), json_field(row, context, value)?))).collect()
}

/// Converts a field to the notation of the vectors.
fn field(row: &FieldSpec, context: &Context, json: &Json) -> Result<Value, CodecError> {
    if let (Json::Array(items), Size::Items { each: 2.., .. }) = (json, row.size) {
        let items = items.iter().map(|item| field(row, context, item));
        return Ok(Value::List(items.collect::<Result<_, CodecError>>()?));
    }
    let tagged = match (row.ty, json) {
        (FieldType::String, _) => {
            let text: Text = from_value(json.clone()).map_err(invalid)?;
            let tagged = text_tagged(text.as_ref());
            let is_full = |size| usize::try_from(size) == Ok(text.text.as_bytes().len());
            Tagged {
                open: tagged.open || matches!(row.size, Size::Padded(size) if is_full(size)),
                ..tagged
            }
        }
        (FieldType::Real64, _) => {
            let number: DynamicValue = from_value(json.clone()).map_err(invalid)?;
            element(Type::Real64, Element::Real64(number.get()))
        }
        (FieldType::Bytes, _) => {
            let bytes: Vec<u8> = from_value(json.clone()).map_err(invalid)?;
            return typed_values::decode(row.name, context, &bytes);
        }
        (FieldType::NetId, Json::String(id)) => return Ok(one(Type::NetId, id)),
        (FieldType::Unsigned, Json::Object(length)) => match length.iter().next() {
            Some((name, number)) => return Ok(one(kind(name)?, number)),
            None => return Err(invalid(format_args!("{} is empty", row.name))),
        },
        (ty, number) => return Ok(one(kind(&ty.to_string())?, number)),
    };
    Ok(Value::One(tagged))
}

fn kind(name: &str) -> Result<Type, CodecError> {
    from_value(name.into()).map_err(invalid)
}

/// Converts a field to the JSON of its Rust type.
fn json_field(row: &FieldSpec, context: &Context, value: &Value) -> Result<Json, CodecError> {
    if row.ty == FieldType::Bytes {
        return to_value(typed_values::encode(row.name, context, value)?).map_err(invalid);
    }
    let tagged = match value {
        Value::One(tagged) => tagged,
        Value::List(items) => {
            return items.iter().map(|item| json_field(row, context, item)).collect();
        }
        Value::Record(_) => {
            return Err(invalid(format_args!("{} is not a single value", row.name)));
        }
    };
    let json = match row.ty {
        FieldType::String => to_value(Text::from(text(tagged)?)),
        FieldType::Real64 => to_value(DynamicValue::from_bits(bits(tagged)?)),
        FieldType::NetId => {
            to_value(tagged.value.as_deref().unwrap_or_default().parse::<AmsNetId>()?)
        }
        // The Rust type contains the width of the number as the name of its variant.
        FieldType::Unsigned => match tagged.kind {
            Type::Uns08 | Type::Uns16 => Ok(json!({ (tagged.kind.name()): tagged.integer() })),
            _ => Ok(json!({ "UNS32": tagged.integer() })),
        },
        _ => to_value(tagged.integer()),
    };
    json.map_err(invalid)
}
