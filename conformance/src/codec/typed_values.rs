//! Values and contents, decoded and encoded with the type in the context.

use ads_cnc::value::{DataType, EncodeValue as _};
use ads_cnc::{CncStr, Elements, U32List};
use ads_cnc_vectors::{Context, Tagged, Type, Value};

use super::CodecError;
use super::field_reader::{bits, hex, integer, invalid, text};
use super::fields::{data, element};
use crate::number::{to_u32, to_usize};
use crate::text::plural;

/// Whether the elements of a field have a type: a value always has a type, a content only if the
/// context contains a type and dimensions.
fn is_typed(field: &str, context: &Context) -> bool {
    let has_type = context.kind.is_some() && context.dimensions.is_some();
    field == "value" || field == "content" && has_type
}

/// The type of the elements, and the dimensions.
fn type_of(context: &Context) -> Result<(Type, DataType, &[u32]), CodecError> {
    let lacks = |what: &str| CodecError::Unsupported(format!("a value without {what}"));
    let kind = context.kind.ok_or_else(|| lacks("a type"))?;
    let dimensions = context.dimensions.as_deref().ok_or_else(|| lacks("dimensions"))?;
    match DataType::by_name(CncStr::new(kind.name())?) {
        Some(data_type) => Ok((kind, data_type, dimensions)),
        None => Err(CodecError::Unsupported(format!("values of type {kind:?}"))),
    }
}

/// Decodes the bytes of a field to elements of the context's type. Returns a field whose elements
/// have no type as bytes.
pub(super) fn decode(field: &str, context: &Context, bytes: &[u8]) -> Result<Value, CodecError> {
    if !is_typed(field, context) {
        return Ok(data(bytes));
    }
    let (kind, data_type, dimensions) = type_of(context)?;
    let elements = Elements::new(data_type, U32List::from(dimensions), bytes)?;
    let named = |item| Value::One(element(kind, item));
    Ok(Value::List(elements.iter().map(named).collect()))
}

/// Encodes a field. A field whose elements have a type must have as many elements as the dimensions
/// require.
pub(super) fn encode(field: &str, context: &Context, value: &Value) -> Result<Vec<u8>, CodecError> {
    if !is_typed(field, context) {
        let plain = || invalid(format_args!("{field} is not a single value"));
        return Ok(hex(value.tagged().ok_or_else(plain)?)?.to_vec());
    }
    let (kind, data_type, dimensions) = type_of(context)?;
    let given = value.list().ok_or_else(|| invalid(format_args!("{field} is not a list")))?;
    let items = given.iter().map(|value| match value.tagged() {
        Some(tagged) if tagged.kind == kind => Ok(tagged),
        _ => {
            Err(invalid(format_args!("{field} has an element that is not of type {}", kind.name())))
        }
    });
    let items: Vec<&Tagged> = items.collect::<Result<_, _>>()?;
    let count = dimensions.iter().try_fold(1_usize, |count, &len| count.checked_mul(to_usize(len)));
    if count != Some(items.len()) {
        let dimensions = U32List::from(dimensions);
        return Err(invalid(format_args!(
            "{} do not match the dimensions {dimensions:?}",
            plural(items.len(), "element")
        )));
    }
    encode_elements(data_type, &items)
}

/// Encodes the elements in order. All texts of an array must have the same size.
fn encode_elements(data_type: DataType, items: &[&Tagged]) -> Result<Vec<u8>, CodecError> {
    let element = |one: &Tagged| {
        Ok(match data_type {
            DataType::Boolean => integer::<u8>(one)?.value_to_vec()?,
            DataType::Sgn08 => integer::<i8>(one)?.value_to_vec()?,
            DataType::Uns08 => integer::<u8>(one)?.value_to_vec()?,
            DataType::Sgn16 => integer::<i16>(one)?.value_to_vec()?,
            DataType::Uns16 => integer::<u16>(one)?.value_to_vec()?,
            DataType::Sgn32 => integer::<i32>(one)?.value_to_vec()?,
            DataType::Uns32 => integer::<u32>(one)?.value_to_vec()?,
            DataType::Lint => integer::<i64>(one)?.value_to_vec()?,
            DataType::Lword => integer::<u64>(one)?.value_to_vec()?,
            DataType::Real64 => f64::from_bits(bits(one)?).value_to_vec()?,
            DataType::Real32 => {
                let bits = u32::try_from(bits(one)?).map_err(|_| invalid("more than 32 bits"))?;
                f32::from_bits(bits).value_to_vec()?
            }
            DataType::String => text(one)?.value_to_vec()?,
            other => return Err(CodecError::Unsupported(format!("values of type {other:?}"))),
        })
    };
    let each = items.iter().map(|one| element(one)).collect::<Result<Vec<_>, _>>()?;
    let bytes = each.concat();
    if data_type == DataType::String && items.len() != 1 {
        if each.windows(2).any(|two| two.first().map(Vec::len) != two.last().map(Vec::len)) {
            return Err(invalid("all texts of an array must have the same size"));
        }
        let count = [to_u32(items.len())];
        Elements::new(data_type, U32List::from(&count), &bytes)?;
    }
    Ok(bytes)
}
