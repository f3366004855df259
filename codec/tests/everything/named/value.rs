//! Values with their types.

use ads_cnc::value::DataType;
use ads_cnc::*;

use super::{ROOM, any, cnc, seen};

pub(super) fn runs(bytes: &[u8]) -> Result<(), Error> {
    let dimensions = [any(2), any(3)];
    let dimensions = Numbers::from(&dimensions);
    for data_type in DataType::ALL.map(any) {
        seen((value::DataType::name(data_type), value::DataType::object_name(data_type)));
        seen((value::DataType::size(data_type), value::DataType::var_type(data_type)));
        seen(shape(data_type, dimensions, bytes));
    }
    seen(value::DataType::by_name(cnc(bytes)));
    seen(value::Boolean::is_true(value::Boolean(any(1))));
    seen(items::<f64>(bytes, dimensions));
    seen(items::<value::Boolean>(bytes, dimensions));
    let value = ValueRef { bytes };
    seen(ValueRef::elements(&value, VariableType(any(1)), dimensions));
    if let Ok(nameless) = DescriptionByNameRef::decode(bytes) {
        seen(DescriptionByNameRef::element(&nameless, &value));
        seen(DescriptionByNameRef::elements(&nameless, &value));
        seen(DescriptionByNameRef::shape(&nameless));
    }
    let description = DescriptionRef::decode(bytes)?;
    seen(DescriptionRef::element(&description, &value));
    seen(DescriptionRef::elements(&description, &value));
    seen(DescriptionRef::shape(&description));
    seen(DescriptionRef::without_name(&description));
    Ok(())
}

fn shape(data_type: DataType, dimensions: Numbers<'_>, bytes: &[u8]) -> Result<(), Error> {
    let mut buf = [0; ROOM];
    seen(value::Shape::of_variable(VariableType(any(1)), dimensions, any(4)));
    let shape = value::Shape::new(data_type, dimensions, any(4))?;
    seen((value::Shape::count(&shape), value::Shape::data_type(&shape)));
    seen((value::Shape::dimensions(&shape).len(), value::Shape::element_size(&shape)));
    seen((value::Shape::size(&shape), value::Shape::place(&shape, dimensions)));
    seen(value::Shape::elements(&value::Shape::one(&shape), bytes));
    seen(value::Shape::encode_texts(&shape, &[cnc(bytes), cnc(bytes)], &mut buf));
    let elements = Elements::new(data_type, dimensions, bytes)?;
    seen(value::Shape::encode(&shape, &elements, &mut buf));
    seen((Elements::as_bytes(&elements), Elements::data_type(&elements)));
    seen((Elements::len(&elements), Elements::is_empty(&elements)));
    seen((Elements::shape(&elements).count(), Elements::get(&elements, any(1))));
    seen(Elements::element(&elements, dimensions).map(|element| Element::data_type(&element)));
    seen(Elements::items::<u16>(&elements).is_some());
    Elements::iter(&elements).rev().step_by(any(2).max(1)).for_each(seen);
    seen((value::EncodeValue::data_type(&elements), value::EncodeValue::value_len(&elements)));
    seen(value::EncodeValue::element_count(&elements));
    seen(value::EncodeValue::encode_value(&elements, &mut buf));
    if let Some(texts) = Elements::strings(&elements) {
        seen((value::StringsRef::as_bytes(&texts), value::StringsRef::element_size(&texts)));
        seen((value::StringsRef::len(&texts), value::StringsRef::is_empty(&texts)));
        seen(value::StringsRef::get(&texts, any(1)));
        value::StringsRef::iter(&texts).rev().for_each(seen);
    }
    seen(value::StringsRef::new(bytes, any(3)));
    Ok(())
}

fn items<T: value::Item>(bytes: &[u8], dimensions: Numbers<'_>) -> Result<(), Error> {
    let items: value::Items<'_, T> = value::Items::new(bytes)?;
    seen((value::Items::len(&items), value::Items::is_empty(&items)));
    seen((value::Items::as_bytes(&items), value::Items::get(&items, any(1))));
    seen(value::Items::copy_to(&items, &mut [T::default(); 4]));
    seen(value::Items::element(&items, dimensions, dimensions));
    value::Items::iter(&items).rev().for_each(seen);
    Ok(())
}
