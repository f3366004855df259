//! Calls the functions of typed values.

use ads_cnc::value::DataType;
use ads_cnc::*;

use super::{ROOM, any, cnc, seen};

pub(super) fn runs(bytes: &[u8]) -> Result<(), Error> {
    let dimensions = [any(2), any(3)];
    let dimensions = U32List::from(&dimensions);
    for data_type in DataType::ALL.map(any) {
        seen((value::DataType::name(data_type), value::DataType::object_name(data_type)));
        seen((value::DataType::size(data_type), value::DataType::var_type(data_type)));
        seen(shape(data_type, dimensions, bytes));
    }
    seen(value::DataType::by_name(cnc(bytes)));
    seen(value::Boolean::is_true(value::Boolean(any(1))));
    seen(value::content_error(ErrorKind::OutOfRange, any(1), any(2), any(3)));
    seen(items::<f64>(bytes));
    seen(items::<value::Boolean>(bytes));
    seen(items::<bool>(bytes));
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

fn shape(data_type: DataType, dimensions: U32List<'_>, bytes: &[u8]) -> Result<(), Error> {
    let mut buf = [0; ROOM];
    seen(value::Shape::for_variable(VariableType(any(1)), dimensions, any(4)));
    let shape = value::Shape::new(data_type, dimensions, any(4))?;
    seen((value::Shape::count(&shape), value::Shape::data_type(&shape)));
    seen((value::Shape::dimensions(&shape).len(), value::Shape::element_size(&shape)));
    seen((value::Shape::size(&shape), value::Shape::index_of(&shape, dimensions)));
    seen(value::Shape::elements(&value::Shape::element_shape(&shape), bytes));
    seen(value::Shape::encode_texts(&shape, &[cnc(bytes), cnc(bytes)], &mut buf));
    let elements = Elements::new(data_type, dimensions, bytes)?;
    seen(value::Shape::encode(&shape, &elements, &mut buf));
    seen((Elements::as_bytes(&elements), Elements::data_type(&elements)));
    seen((Elements::len(&elements), Elements::is_empty(&elements)));
    seen((Elements::shape(&elements).count(), Elements::get(&elements, any(1))));
    seen(Elements::element(&elements, dimensions).map(|element| Element::data_type(&element)));
    seen(Elements::items::<u16>(&elements).is_ok());
    seen(Elements::copy_to::<u16>(&elements, &mut [0; 4]));
    Elements::iter(&elements).rev().step_by(any(2).max(1)).for_each(seen);
    seen((value::EncodeValue::data_type(&elements), value::EncodeValue::value_len(&elements)));
    seen(value::EncodeValue::element_count(&elements));
    seen(value::EncodeValue::encode_value(&elements, &mut buf));
    Ok(())
}

fn items<T: value::Scalar>(bytes: &[u8]) -> Result<(), Error> {
    let (value, content) = (ValueRef { bytes }, ContentRef { bytes });
    seen((ValueRef::get::<T>(&value, any(1)), ContentRef::get::<T>(&content, any(1))));
    seen(ValueRef::copy_to(&value, &mut [T::default(); 4]));
    seen(ContentRef::copy_to(&content, &mut [T::default(); 4]));
    let mut input = value::Reader::new(bytes);
    seen((value::Reader::read::<T>(&mut input), value::Reader::bytes(&mut input, any(3))));
    seen((value::Reader::text(&mut input, any(3)), value::Reader::rest(&mut input)));
    seen(value::Reader::finish(input));
    ValueRef::iter::<T>(&value)?.rev().for_each(seen);
    ContentRef::iter::<T>(&content)?.rev().for_each(seen);
    Ok(())
}
