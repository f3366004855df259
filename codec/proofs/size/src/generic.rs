//! What is generic, with the types it is used with, and iterators that have no name, to their end.

pub(crate) mod views {
    use ads_cnc::{CncStr, DescriptorRef, DescriptorsRef, Numbers};

    use crate::keep;

    fn bytes(text: &CncStr<'_>, visit: fn(u8)) {
        CncStr::bytes(text).for_each(visit);
    }

    fn numbers(numbers: &Numbers<'_>, visit: fn(u32)) {
        Numbers::iter(numbers).for_each(visit);
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

    fn walk(stream: Stream, bytes: &[u8], visit: fn(Segment<'_>)) -> Result<(), Error> {
        layout::Stream::walk(stream, bytes, visit)
    }

    keep!(all, fields, walk);
}

pub(crate) mod values {
    use ads_cnc::value;
    use ads_cnc::value::{Boolean, EncodeValue, Items};
    use ads_cnc::{Elements, Error, TextRef};

    use crate::keep;

    fn strings(texts: &value::StringsRef<'_>, visit: fn(TextRef<'_>)) {
        value::StringsRef::iter(texts).for_each(visit);
    }

    fn encode<'b>(
        shape: &value::Shape<'_>,
        elements: &Elements<'_>,
        buf: &'b mut [u8],
    ) -> Result<&'b [u8], Error> {
        value::Shape::encode(shape, elements, buf)
    }

    fn items<T: value::Item>(items: &Items<'_, T>, visit: fn(T)) {
        value::Items::iter(items).for_each(visit);
    }

    macro_rules! of_each_type {
        ($( $ty:ty ),+) => {
            keep!(strings, encode, $(
                items::<$ty>,
                Elements::items::<$ty>,
                value::Items::<'_, $ty>::new,
                value::Items::<'_, $ty>::is_empty,
                value::Items::<'_, $ty>::len,
                value::Items::<'_, $ty>::as_bytes,
                value::Items::<'_, $ty>::copy_to,
                value::Items::<'_, $ty>::element,
                value::Items::<'_, $ty>::get,
                <Items<'_, $ty> as EncodeValue>::encode_value,
                <[$ty] as EncodeValue>::encode_value,
            )+);
        };
    }

    of_each_type!(Boolean, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64);
}
