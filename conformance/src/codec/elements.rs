//! Elements of SDA and GEO, contents, dynamic parameters, and the description by name.

use ads_cnc::dynamic::{DynamicCount, DynamicIndex, DynamicName, DynamicNameRequest, DynamicValue};
use ads_cnc::sda::{
    ElementCount, ElementLength, ElementText, ElementWriteFlag, ObjectAddress, ObjectAddressQuery,
};
use ads_cnc::{Content, ContentRef, Decode, DescriptionByName, Element, Encode};
use ads_cnc_vectors::{Context, Type, Value};

use super::{
    Decoded, Refused, data, description, element, elements, one, owned_text, place, stream, uns32,
};

pub(super) fn decode(name: &str, context: &Context, bytes: &[u8]) -> Result<Decoded, Refused> {
    let (fields, bytes) = match name {
        "object-address-query" => stream(bytes, |query: &ObjectAddressQuery| {
            vec![("channel", uns32(query.channel)), ("axis", uns32(query.axis))]
        }),
        "object-address" => {
            stream(bytes, |found: &ObjectAddress| place(found.index_group, found.index_offset))
        }
        "element-count" => stream(bytes, |count: &ElementCount| vec![("count", uns32(count.0))]),
        "element-text" => {
            stream(bytes, |reply: &ElementText| vec![("text", owned_text(&reply.text))])
        }
        "element-length" => stream(bytes, |length: &ElementLength| {
            let width = match length.encoded_len() {
                1 => Type::Uns08,
                2 => Type::Uns16,
                _ => Type::Uns32,
            };
            vec![("length", one(width, length.get()))]
        }),
        "element-write-flag" => {
            stream(bytes, |flag: &ElementWriteFlag| vec![("flag", one(Type::Boolean, flag.0))])
        }
        "content" => {
            let content = content(context, ContentRef::decode(bytes)?.bytes)?;
            stream(bytes, |_: &Content| vec![("content", content)])
        }
        "dynamic-count" => stream(bytes, |count: &DynamicCount| vec![("count", uns32(count.0))]),
        "dynamic-index" => stream(bytes, |index: &DynamicIndex| vec![("index", uns32(index.0))]),
        "dynamic-name" => {
            stream(bytes, |reply: &DynamicName| vec![("name", owned_text(&reply.name))])
        }
        "dynamic-name-request" => {
            stream(bytes, |request: &DynamicNameRequest| vec![("name", owned_text(&request.name))])
        }
        "dynamic-value" => stream(bytes, |value: &DynamicValue| {
            vec![("value", Value::One(element(Element::Real64(value.get()))))]
        }),
        "variable-description-by-name" => stream(bytes, |variable: &DescriptionByName| {
            let DescriptionByName { handle, var_type, access, size, .. } = *variable;
            description(handle, var_type, access, size, &variable.dimensions)
        }),
        other => return Err(Refused::Unsupported(format!("stream {other}"))),
    }?;
    Ok(Decoded { fields, bytes })
}

/// A content by its type; bytes if there is none.
fn content(context: &Context, bytes: &[u8]) -> Result<Value, Refused> {
    match (context.kind, &context.dimensions) {
        (Some(_), Some(_)) => elements(context, bytes),
        _ => Ok(data(bytes)),
    }
}
