//! Tests of operations and replies; for example, their parts equal the arguments with which they
//! were made.

use ads_cnc::address::{
    Access, Attribute, Channel, ChannelAxis, Class, ClassGroup, ComGroup, ComTable, ElementAddress,
    IndexOffset, PlatformAxis,
};
use ads_cnc::dynamic::*;
use ads_cnc::operation::*;
use ads_cnc::sda::*;
use ads_cnc::*;

/// The request to which a server dispatches the call that this request of a client encodes to.
fn dispatched<'b>(request: Request<'_>, buf: &'b mut [u8]) -> Request<'b> {
    let call = request.encode(buf).unwrap();
    call.dispatch().unwrap_or_else(|error| panic!("{request:?}: {error}"))
}

fn channel(number: u32) -> Channel {
    Channel::new(number).unwrap()
}

#[test]
fn instances_are_queried_by_number_or_by_index() {
    for class in Class::ALL {
        let op = FindInstance::new(class, 3, 7);
        let mut buf = [0; 8];
        let there = dispatched(op.into(), &mut buf);
        let Request::FindInstance(there) = there else { panic!("{there:?}") };
        assert_eq!(there.query(), ObjectAddressQuery { channel: 3, axis: 7 });
        assert_eq!(there.class_group(), ClassGroup::object_address(class));
        assert_eq!(there.by_index().class_group().addressing, address::Addressing::Index);
        assert_eq!(there.by_index().class_group().class, class);
    }
}

/// The address of an instance consists of the group and offset of the content of its first element.
/// Operations on elements keep the address of the element.
#[test]
fn elements_keep_their_address() {
    let axis = ChannelAxis::new(2).unwrap();
    for class in [Class::Decoder, Class::Interpolator] {
        let first = ElementAddress::for_axis(channel(1), class, axis, 0).unwrap();
        let found = ObjectAddress::from(first);
        assert_eq!(found.index_group, first.group(Attribute::Content));
        assert_eq!(found.index_offset, first.index_offset());
        assert_eq!(found.first_element(), Ok(Some(first)));

        let counted = CountElements::new(first).unwrap();
        assert_eq!(counted.element(), first);
        let second = first.nth(1).unwrap();
        let read = ReadElement::new(second, 4).unwrap();
        let write = WriteElement::new(second, &b"1234"[..]).unwrap();
        assert_eq!((read.element(), write.element()), (second, second));
        let mut buf = [0; 16];
        let there = dispatched(write.into(), &mut buf);
        let Request::WriteElement(there) = there else { panic!("{there:?}") };
        assert_eq!((there.element(), there.content().bytes), (second, &b"1234"[..]));
    }
}

#[test]
fn lists_and_objects_keep_their_address() {
    for (list, table, instance) in [
        (ObjectList::PLATFORM, ComTable::Channel, 0),
        (channel(4).into(), ComTable::Channel, 4),
        (PlatformAxis::new(2).unwrap().into(), ComTable::Axis, 2),
    ] {
        let ComGroup { access, table: of, instance: number, .. } = list.parts();
        assert_eq!((access, of, number), (Access::Object, table, instance), "{list:?}");
        let read = ReadDescriptors::new(list, 5, 3).unwrap();
        assert_eq!((read.list(), read.first(), read.count()), (list, 5, 3));
        let there = dispatched(read.into(), &mut []);
        let Request::ReadDescriptors(there) = there else { panic!("{there:?}") };
        assert_eq!((there.list(), there.first(), there.count()), (list, 5, 3));

        let group = ComGroup { access: Access::Element, ..list.parts() };
        let offset = IndexOffset::new(0x17);
        let read = ReadObject::new(group.index_group(), offset, 8).unwrap();
        let write = WriteObject::new(group.index_group(), offset, &b"12345678"[..]).unwrap();
        assert_eq!((read.address(), write.address()), ((group, offset), (group, offset)));
        assert_eq!(write.content().bytes, b"12345678");
    }
}

/// The first object has the number 1; a request reads at most as many descriptors as one reply can
/// contain.
#[test]
fn reads_of_descriptors_check_first_and_count() {
    const MOST: u32 = ReadDescriptors::COUNT_MAX;
    let ask = |first, count| {
        let read = ReadDescriptors::new(ObjectList::PLATFORM, first, count);
        read.map_err(|error| (error.kind(), error.field().name(), error.expected(), error.found()))
    };
    assert_eq!(ask(0, 1), Err((ErrorKind::OutOfRange, "element", 1, 0)));
    assert_eq!(ask(1, 0), Err((ErrorKind::OutOfRange, "count", 1, 0)));
    assert_eq!(ask(1, MOST + 1), Err((ErrorKind::TooMany, "count", MOST, MOST + 1)));
    let most = ask(1, MOST).unwrap();
    assert!(most.read_length() as usize <= limits::ADS_DATA_MAX);
    assert!(most.read_length() as usize + limits::DESCRIPTOR_LEN > limits::ADS_DATA_MAX);
}

/// The value of a dynamic parameter keeps its bits, including those of a NaN.
#[test]
fn dynamic_values_keep_their_bits() {
    for value in [4711.0, -0.0, f64::INFINITY, f64::MIN_POSITIVE / 2.0, f64::NAN] {
        let stored = DynamicValue::from(value);
        assert_eq!(stored.to_bits(), value.to_bits());
        assert_eq!(stored.get().to_bits(), value.to_bits());
        assert_eq!(DynamicValue::from_bits(stored.to_bits()), stored);
        assert_eq!(f64::from(stored).to_bits(), value.to_bits());
        let mut buf = [0; 8];
        assert_eq!(stored.encode(&mut buf), Ok(&value.to_le_bytes()[..]));
    }
}
