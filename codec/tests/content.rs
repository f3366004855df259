//! Tests of the content of objects and elements: its address and length. Addresses of functions are
//! not addresses of content.

use ads_cnc::ErrorKind;
use ads_cnc::address::{Channel, Class, ElementAddress, IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::*;

use super::common::CALLS;

fn content(group: u32, offset: u32) -> Call<'static> {
    let call = CALLS.iter().find(|sample| sample.slug == "content-printed").unwrap().call;
    let port = if group & 0xF00 <= 0x200 { AmsPort::COM } else { AmsPort::SDA };
    let (index_group, index_offset) = (IndexGroup::new(group), IndexOffset::new(offset));
    Call { port, index_group, index_offset, ..call }
}

/// The constructors for content reject the address of a function, and dispatch does not take it for
/// an address of content (SDA-12, STM-1).
#[test]
fn addresses_of_functions_are_rejected_for_content() {
    let rows = Function::ALL.iter().map(|function| function.spec());
    let of_decoder = rows.filter(|spec| {
        spec.group == GroupRule::ChannelOf(Class::Decoder) && spec.service != AdsService::Read
    });
    let offsets = of_decoder.flat_map(|spec| match spec.offset {
        OffsetRule::At(at) => vec![at],
        OffsetRule::OfKind(offsets) => offsets.to_vec(),
        OffsetRule::OfAxis(element) => vec![0x1_0000 | element, 0x2_0000 | element],
        _ => vec![],
    });
    let of_decoder = offsets.map(|offset| (0x12_2301, offset));
    for (group, offset) in of_decoder.chain([(0x12_0101, 0x90), (0x2_0106, 0x90)]) {
        let call = content(group, offset);
        let error = call.dispatch().unwrap_err();
        assert!(matches!(error, DispatchError::Service { .. }), "{call:?}: {error}");
        let (group, offset) = (call.index_group, call.index_offset);
        let error = match call.port {
            AmsPort::COM => {
                assert!(WriteObject::new(group, offset, &[][..]).is_err());
                ReadObject::new(group, offset, 4).unwrap_err()
            }
            _ => {
                let Some(ads_cnc::address::Group::Class(class)) = group.parts() else { panic!() };
                let element = ElementAddress::new(class, offset);
                assert!(WriteElement::new(element, &[][..]).is_err());
                assert_eq!(CountElements::new(element).unwrap_err().found(), offset.get());
                ReadElement::new(element, 4).unwrap_err()
            }
        };
        assert_eq!((error.kind(), error.found()), (ErrorKind::Function, offset.get()));
    }
    // A Read of the decoder at the offsets 0x02 to 0x05 is dispatched to `CountDynamic`, and a Read
    // of the HLD at element 0 to `CountElements`.
    for offset in 2..=5 {
        let reached = content(0x12_2301, offset).dispatch().unwrap();
        assert_eq!(reached.function(), Function::CountDynamic);
    }
    assert_eq!(content(0x12_3301, 0).dispatch().unwrap().function(), Function::CountElements);
    // Element 0x44 of another class, element 0x44 of channel 0, and element 7 of the decoder are
    // content.
    for (group, offset) in [(0x12_1301, 0x44), (0x12_2300, 0x44), (0x12_2301, 7)] {
        assert_eq!(content(group, offset).dispatch().unwrap().function(), Function::ReadElement);
    }
}

/// A server dispatches a count of elements with the stride 0x1000 as a read of content, which
/// encodes to the same call (E-01).
#[test]
fn the_count_of_a_platform_axis_is_a_read_of_content() {
    let axis = content(0x12_3300, 0x1000);
    let Some(ads_cnc::address::Group::Class(class)) = axis.index_group.parts() else { panic!() };
    let element = ElementAddress::new(class, axis.index_offset);
    let sent = Request::from(CountElements::new(element).unwrap()).encode(&mut []).unwrap();
    let canonical = ReadElement::new(element, 4).unwrap().into();
    assert_eq!(sent.dispatch(), Ok(canonical));
    assert_eq!(canonical.encode(&mut []), Ok(sent));
}

/// With logical addressing, the content of a platform axis has two addresses: that of the table in
/// section 2.1, and that of the example in section 2.1.2 (E-04). Its descriptors have only one
/// address: their group without an axis is rejected.
#[test]
fn content_of_a_platform_axis_has_two_addresses() {
    let call = |group, offset| Call {
        port: AmsPort::COM,
        service: AdsService::Read,
        index_group: IndexGroup::new(group),
        index_offset: IndexOffset::new(offset),
        read_length: 8,
        data: &[],
    };
    for call in [call(0x12_0201, 1), call(0x12_0200, 0x1_0001)] {
        let request = call.dispatch().unwrap();
        assert_eq!(request.function(), Function::ReadObject);
        assert_eq!(request.encode(&mut []), Ok(call));
    }
    let group = IndexGroup::new(0x13_0200);
    let rejected = Call { index_group: group, ..call(0, 0) }.dispatch();
    assert_eq!(rejected, Err(DispatchError::Group(group)));
}

#[test]
fn content_has_a_valid_address_and_at_most_the_read_length() {
    let group = IndexGroup::new;
    let offset = IndexOffset::new(3);
    let read = ReadObject::new(group(0x12_0101), offset, 2).unwrap();
    assert_eq!(read.decode_reply(&[1]).unwrap().bytes, [1]);
    let error = read.decode_reply(&[1, 2, 3]).unwrap_err();
    assert_eq!((error.kind(), error.expected(), error.found()), (ErrorKind::TooLong, 2, 3));
    let element = ElementAddress::for_channel(Channel::new(1).unwrap(), Class::Hld, 1).unwrap();
    assert!(ReadElement::new(element, 1).unwrap().decode_reply(&[0, 0]).is_err());

    for (wrong, near) in [(0x13_0101, 0x12_0101), (0x12_2301, 0x12_0100), (0xF005, 0x12_0100)] {
        let error = ReadObject::new(group(wrong), offset, 2).unwrap_err();
        assert_eq!((error.kind(), error.expected()), (ErrorKind::Mismatch, near));
        assert_eq!(WriteObject::new(group(wrong), offset, &[][..]), Err(error));
    }
    assert!(ReadObject::new(group(0x12_0101), offset, 0x40_0000).is_ok());
    assert_eq!(
        ReadObject::new(group(0x12_0101), offset, 0x40_0001).unwrap_err().kind(),
        ErrorKind::TooLong
    );
    assert!(ReadElement::new(element, 0x40_0001).is_err());
}
