//! Functions that call generic functions of the codec with specific types, and functions that call
//! an iterator of the codec until it ends. `values` also keeps generic functions themselves.

pub(crate) mod views {
    use ads_cnc::{CncStr, DescriptorRef, DescriptorsRef, U32List};

    use crate::keep;

    fn bytes(text: &CncStr<'_>, visit: fn(u8)) {
        CncStr::bytes(text).for_each(visit);
    }

    fn numbers(numbers: &U32List<'_>, visit: fn(u32)) {
        U32List::iter(numbers).for_each(visit);
    }

    fn descriptors(list: &DescriptorsRef<'_>, visit: fn(DescriptorRef<'_>)) {
        DescriptorsRef::iter(list).for_each(visit);
    }

    keep!(bytes, numbers, descriptors);
}

pub(crate) mod operations {
    use ads_cnc::address::{Channel, ChannelAxis, ElementAddress, IndexGroup, IndexOffset};
    use ads_cnc::dynamic::DynamicKind;
    use ads_cnc::operation::{self, ObjectList};
    use ads_cnc::{DescriptorRef, Error, Handle};

    use crate::keep;

    macro_rules! makers {
        ($( $name:ident($( $argument:ident: $ty:ty ),+) -> $made:ty = $new:path; )+) => {
            $( fn $name<'a>($( $argument: $ty ),+) -> $made {
                $new($( $argument ),+)
            } )+
            keep!($( $name ),+);
        };
    }

    makers! {
        count(list: ObjectList) -> operation::CountObjects = operation::CountObjects::new;
        descriptors(list: ObjectList, first: u32, count: u32)
            -> Result<operation::ReadDescriptors, Error> = operation::ReadDescriptors::new;
        handle(channel: Channel, name: &'a str)
            -> Result<operation::HandleByName<'a>, Error> = operation::HandleByName::new;
        read(channel: Channel, name: &'a str)
            -> Result<operation::ReadByName<'a>, Error> = operation::ReadByName::new;
        write(channel: Channel, name: &'a str, value: f64)
            -> Result<operation::WriteByName<'a>, Error> = operation::WriteByName::new;
        describe(channel: Channel, name: &'a str)
            -> Result<operation::DescribeByName<'a>, Error> = operation::DescribeByName::new;
        read_by_handle(channel: Channel, handle: Handle, indices: &'a [u32])
            -> operation::ReadByHandle<'a> = operation::ReadByHandle::new;
        write_by_handle(channel: Channel, handle: Handle, indices: &'a [u32], value: &'a [u8])
            -> operation::WriteByHandle<'a> = operation::WriteByHandle::new;
        handle_of_axis(channel: Channel, axis: ChannelAxis, name: &'a str)
            -> Result<operation::AxisHandleByName<'a>, Error> = operation::AxisHandleByName::new;
        read_of_axis(channel: Channel, axis: ChannelAxis, name: &'a str)
            -> Result<operation::AxisReadByName<'a>, Error> = operation::AxisReadByName::new;
        write_of_axis(channel: Channel, axis: ChannelAxis, name: &'a str, value: &'a [u8])
            -> Result<operation::AxisWriteByName<'a>, Error> = operation::AxisWriteByName::new;
        parameter(channel: Channel, kind: DynamicKind, name: &'a str)
            -> Result<operation::DynamicValueByName<'a>, Error> =
            operation::DynamicValueByName::new;
        write_element(element: ElementAddress, content: &'a [u8])
            -> Result<operation::WriteElement<'a>, Error> = operation::WriteElement::new;
        write_object(group: IndexGroup, offset: IndexOffset, content: &'a [u8])
            -> Result<operation::WriteObject<'a>, Error> = operation::WriteObject::new;
        read_object_of(object: DescriptorRef<'a>)
            -> Result<operation::ReadObject, Error> = operation::ReadObject::of;
        write_object_of(object: DescriptorRef<'a>, content: &'a [u8])
            -> Result<operation::WriteObject<'a>, Error> = operation::WriteObject::of;
    }
}

pub(crate) mod names {
    use ads_cnc::{Error, Kind, PathPart, VariablePath};

    use crate::keep;

    fn write<'a>(
        kind: Kind<'_>,
        parts: &[PathPart<'_>],
        buf: &'a mut [u8],
    ) -> Result<VariablePath<'a>, Error> {
        VariablePath::write(kind, parts.iter().copied(), buf)
    }

    keep!(write);
}

pub(crate) mod tables {
    use ads_cnc::Error;
    use ads_cnc::layout;
    use ads_cnc::layout::{Field, Segment, Stream};

    use crate::keep;

    fn all(visit: fn(Stream)) {
        layout::Stream::all().for_each(visit);
    }

    fn fields(stream: Stream, visit: fn(Field)) {
        layout::Stream::fields(stream).for_each(visit);
    }

    fn join<'b>(
        stream: Stream,
        parts: &[(Field, &[u8])],
        buf: &'b mut [u8],
    ) -> Result<&'b [u8], Error> {
        layout::Stream::join(stream, parts.iter().copied(), buf)
    }

    fn walk(stream: Stream, bytes: &[u8], visit: fn(Segment<'_>)) -> Result<(), Error> {
        layout::Stream::walk(stream, bytes, visit)
    }

    keep!(all, fields, join, walk);
}

pub(crate) mod values {
    use ads_cnc::value;
    use ads_cnc::value::{Boolean, EncodeValue};
    use ads_cnc::{ContentRef, Elements, Error, ValueRef};

    use crate::keep;

    fn encode<'b>(
        shape: &value::Shape<'_>,
        elements: &Elements<'_>,
        buf: &'b mut [u8],
    ) -> Result<&'b [u8], Error> {
        value::Shape::encode(shape, elements, buf)
    }

    fn of_value<T: value::Scalar>(value: &ValueRef<'_>, visit: fn(T)) -> Result<(), Error> {
        ValueRef::iter(value).map(|all| all.for_each(visit))
    }

    fn of_content<T: value::Scalar>(content: &ContentRef<'_>, visit: fn(T)) -> Result<(), Error> {
        ContentRef::iter(content).map(|all| all.for_each(visit))
    }

    fn items<T: value::Scalar>(elements: &Elements<'_>, visit: fn(T)) -> Result<(), Error> {
        Elements::items(elements).map(|all| all.for_each(visit))
    }

    fn read<T: value::Scalar>(reader: &mut value::Reader<'_>) -> Result<T, Error> {
        value::Reader::read(reader)
    }

    macro_rules! of_each_type {
        ($( $ty:ty ),+) => {
            keep!(encode, $(
                of_value::<$ty>,
                of_content::<$ty>,
                items::<$ty>,
                read::<$ty>,
                Elements::copy_to::<$ty>,
                ValueRef::get::<$ty>,
                ValueRef::copy_to::<$ty>,
                ContentRef::get::<$ty>,
                ContentRef::copy_to::<$ty>,
                <[$ty] as EncodeValue>::encode_value,
            )+);
        };
    }

    of_each_type!(bool, Boolean, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64);
}
