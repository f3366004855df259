//! A server dispatches the encoded call of any valid operation to the same operation:
//! `dispatch(encode(op)) = op`. [`check_operation`] has an exception for `CountElements`.

use ads_cnc::address::{
    Access, Channel, ChannelAxis, Class, ElementAddress, IndexGroup, IndexOffset, PlatformAxis,
    Spindle,
};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::*;
use ads_cnc::text::cp1252_to_char;
use ads_cnc::{ErrorKind, Handle, Kind, U32List};
use proptest::prelude::*;

use super::common::{Parameters, check_made, check_operation};
use super::kept;

fn channel() -> impl Strategy<Value = Channel> {
    (1..=255_u32, any::<bool>()).prop_map(|(number, logical)| {
        let channel = if logical { Channel::new(number) } else { Channel::by_index(number) };
        channel.expect("in range")
    })
}

/// A text of at most 255 characters of code page 1252, without NUL.
fn text() -> impl Strategy<Value = String> {
    prop::collection::vec((1..=u8::MAX).prop_map(cp1252_to_char), 0..=255)
        .prop_map(|characters| characters.into_iter().collect())
}

proptest! {
    #![proptest_config(kept::cases(256, file!()))]

    /// Operations of `CountObjects` and `ReadDescriptors`, for each kind of list.
    #[test]
    fn operations_on_objects(
        channel in channel(),
        axis in (1..=255_u32).prop_map(|place| PlatformAxis::new(place).expect("in range")),
        first in 1..=u32::MAX,
        count in 1..=ReadDescriptors::COUNT_MAX,
    ) {
        for list in [ObjectList::PLATFORM, channel.into(), axis.into()] {
            check_operation(CountObjects::new(list));
            check_operation(ReadDescriptors::new(list, first, count).unwrap());
        }
    }

    /// Operations that write variables, operations of the axis interface, `DescribeByName` and
    /// `DescribeExtended`.
    #[test]
    fn operations_that_write_and_of_axes(
        (channel, place) in (channel(), 1..=0xFFFF_u32),
        text in text(),
        number in any::<u32>(),
        indices in prop::collection::vec(any::<u32>(), 0..=250),
        value in prop::collection::vec(any::<u8>(), 0..=1040),
    ) {
        let axis = ChannelAxis::new(place).unwrap();
        let indices = U32List::from(&indices[..]);
        check_operation(WriteByHandle::new(channel, Handle(number), indices, &value[..]));
        check_operation(WriteByName::new(channel, &text, &value[..]).unwrap());
        check_operation(DescribeByName::new(channel, &text).unwrap());
        check_operation(AxisHandleByName::new(channel, axis, &text).unwrap());
        check_operation(AxisReadByName::new(channel, axis, &text).unwrap());
        check_operation(AxisWriteByName::new(channel, axis, &text, &value[..]).unwrap());
        check_operation(DescribeExtended::new(channel, number, Kind::new(&text).unwrap()));
    }

    /// Operations of the channel interface that count, describe, find or read variables, with
    /// channels by number and by index.
    #[test]
    fn operations_on_variables(
        channel in channel(),
        text in text(),
        number in any::<u32>(),
        indices in prop::collection::vec(any::<u32>(), 0..=510),
    ) {
        let kind = Kind::new(&text).unwrap();
        check_operation(CountVariables::new(channel, kind));
        check_operation(DescribeByIndex::new(channel, number, kind));
        check_operation(HandleByName::new(channel, &text).unwrap());
        let indices = U32List::from(&indices[..]);
        check_operation(ReadByHandle::new(channel, Handle(number), indices));
        check_operation(ReadByName::new(channel, &text).unwrap());
    }

    /// Operations on dynamic parameters of each kind.
    #[test]
    fn operations_on_dynamic_parameters(
        channel in channel(), index in 1..=u32::MAX, text in text(),
    ) {
        let name: String = text.chars().take(95).collect();
        for kind in DynamicKind::ALL {
            check_operation(CountDynamic::new(channel, kind));
            check_operation(DynamicNameByIndex::new(channel, kind, index).unwrap());
            check_operation(DynamicValueByIndex::new(channel, kind, index).unwrap());
            check_operation(DynamicValueByName::new(channel, kind, &name).unwrap());
        }
    }

    /// Operations on instances and elements of each class, with channels by number and by index.
    #[test]
    fn operations_on_elements(
        channel in channel(), (number, axis) in any::<(u32, u32)>(), element in 0..=0xFFFF_u32,
        place in 1..=0xFFFF_u32, spindle in 0..=255_u32, length in 0..=4096_u32,
        content in prop::collection::vec(any::<u8>(), 0..40),
    ) {
        let place = ChannelAxis::new(place).unwrap();
        let spindle = ElementAddress::for_spindle(Spindle::new(spindle).unwrap(), element).unwrap();
        for class in Class::ALL {
            check_operation(FindInstance::new(class, number, axis));
            if class != Class::Spindle {
                check_operation(FindInstance::new(class, number, axis).by_index());
            }
            for address in [
                ElementAddress::for_channel(channel, class, element).unwrap(),
                ElementAddress::for_axis(channel, class, place, element).unwrap(),
                spindle,
            ] {
                check_operation(ReadElementName::new(address));
                check_operation(ReadElementType::new(address));
                check_operation(ReadElementLength::new(address));
                check_operation(ReadElementUnit::new(address));
                check_operation(ReadElementWriteFlag::new(address));
                // If the offset belongs to a function of the decoder or to a count of elements, the
                // constructor rejects the address.
                match ReadElement::new(address, length) {
                    Ok(read) => {
                        check_operation(read);
                        check_operation(WriteElement::new(address, &content[..]).unwrap());
                    }
                    Err(error) => {
                        assert_eq!(error.kind(), ErrorKind::Function);
                        assert_eq!(error.found(), address.index_offset().get());
                        assert!(WriteElement::new(address, &content[..]).is_err());
                    }
                }
            }
        }
        let first = ElementAddress::for_channel(channel, Class::Hld, 0).unwrap();
        check_operation(CountElements::new(first).unwrap());
    }

    /// Operations on the content of COM objects, and `WriteProgramStream`.
    #[test]
    fn operations_on_content(
        channel in channel(), axis in 1..=255_u32, offset in 0..0x2_0000_u32,
        length in 0..=4096_u32, content in prop::collection::vec(any::<u8>(), 1..=992),
    ) {
        let axis = PlatformAxis::new(axis).unwrap().com(Access::Element);
        let platform = IndexGroup::new(0x12_0100);
        // In the group of all platform axes, the offset contains the axis (E-04).
        let axes = IndexGroup::new(0x12_0200);
        let offset = IndexOffset::new(offset);
        for group in [platform, axis, axes, channel.com(Access::Element)] {
            if let Ok(read) = ReadObject::new(group, offset, length) {
                check_operation(read);
                check_operation(WriteObject::new(group, offset, &content[..]).unwrap());
            } else {
                assert_eq!(offset.get(), 0x90);
            }
        }
        check_operation(WriteProgramStream::new(channel, &content));
    }

    /// The operation of every function.
    #[test]
    fn operations_of_every_function(
        channel in channel(),
        (platform_axis, axis, spindle) in (1..=255_u32, 1..=0xFFFF_u32, 0..=255_u32),
        (class, dynamic) in (prop::sample::select(&Class::ALL[..]), prop::sample::select(&DynamicKind::ALL[..])),
        (place, element) in (any::<u8>(), 0..=0xFFFF_u32),
        (number, count) in (1..=u32::MAX, 1..=ReadDescriptors::COUNT_MAX),
        text in "[A-Za-zäß€.]{0,95}",
        indices in prop::collection::vec(any::<u32>(), 0..=250),
        bytes in prop::collection::vec(any::<u8>(), 1..=992),
    ) {
        let of = Parameters {
            channel, class, dynamic, place, element, number, count,
            platform_axis: PlatformAxis::new(platform_axis).unwrap(),
            axis: ChannelAxis::new(axis).unwrap(),
            spindle: Spindle::new(spindle).unwrap(),
            text: &text, indices: &indices, bytes: &bytes,
        };
        for &function in Function::ALL {
            if let Err(error) = check_made(function, &of, &|_| ()) {
                // An operation is only rejected if its address belongs to a different function.
                prop_assert_eq!(error.kind(), ErrorKind::Function, "{:?}: {}", function, error);
                prop_assert!(function.spec().is_content() || function == Function::CountElements);
            }
        }
    }
}
