//! Tests of index groups and index offsets, such as those that the manuals print: they are built
//! and parsed, and numbers that do not fit are rejected.

use ads_cnc::address::Addressing::{Index, Logical};
use ads_cnc::address::*;
use ads_cnc::operation::{FindInstance, Operation as _};
use ads_cnc::sda::ObjectAddress;
use ads_cnc::{Error, ErrorKind};
use proptest::prelude::*;

use super::kept;

fn channel(number: u32) -> Channel {
    Channel::new(number).unwrap()
}

/// Parses the number of a group, and checks that the parsed group has the same number.
fn parts(printed: u32) -> Group {
    let group = IndexGroup::new(printed).parts().unwrap_or_else(|| panic!("{printed:#x}"));
    assert_eq!(group.index_group().get(), printed);
    group
}

fn class(addressing: Addressing, class: Class, attribute: Attribute, instance: u8) -> Group {
    Group::Class(ClassGroup { addressing, class, attribute, instance })
}

fn com(addressing: Addressing, access: Access, table: ComTable, instance: u8) -> Group {
    Group::Com(ComGroup { addressing, access, table, instance })
}

/// A channel is addressed by its number or by its index (ADR-1, ADR-11).
#[test]
fn channels_by_number_and_by_index() {
    let group = |channel: Channel| channel.class(Class::Interpolator, Attribute::Content).get();
    assert_eq!(group(channel(1)), 0x12_1301);
    assert_eq!(group(channel(6)), 0x12_1306);
    assert_eq!(group(Channel::by_index(1).unwrap()), 0x2_1301);
    assert_eq!(group(Channel::by_index(2).unwrap()), 0x2_1302);
    for (printed, addressing, instance) in [
        (0x12_1301, Logical, 1),
        (0x12_1306, Logical, 6),
        (0x2_1301, Index, 1),
        (0x2_1302, Index, 2),
    ] {
        let wanted = class(addressing, Class::Interpolator, Attribute::Content, instance);
        assert_eq!(parts(printed), wanted);
    }
}

/// Spindles have no logical address: a [`ClassGroup`] of a spindle has the same number with logical
/// addressing as with addressing by index (ADR-2, ADR-5).
#[test]
fn spindles_are_addressed_by_index_only() {
    let spindle = Spindle::new(2).unwrap();
    assert_eq!(spindle.class(Attribute::Content).get(), 0x2_5302);
    assert_eq!(parts(0x2_5302), class(Index, Class::Spindle, Attribute::Content, 2));
    assert_eq!(parts(0x2_5300), class(Index, Class::Spindle, Attribute::Content, 0));
    assert_eq!(ClassGroup::object_address(Class::Spindle).index_group().get(), 0x2_5900);
    assert_eq!(class(Logical, Class::Spindle, Attribute::Content, 2).index_group().get(), 0x2_5302);
    assert_eq!(IndexGroup::new(0x12_5302).parts(), None);
}

/// Groups of the COM task are built from their parts and parsed into them (ADR-3, ADR-4, COM-6,
/// COM-7).
#[test]
fn groups_of_the_com_task() {
    let axis = PlatformAxis::new(1).unwrap();
    for (printed, access, table, instance, built) in [
        (
            0x12_0100,
            Access::Element,
            ComTable::Channel,
            0,
            ComGroup::platform(Access::Element).index_group(),
        ),
        (0x12_0101, Access::Element, ComTable::Channel, 1, channel(1).com(Access::Element)),
        (0x12_0201, Access::Element, ComTable::Axis, 1, axis.com(Access::Element)),
        (
            0x13_0100,
            Access::Object,
            ComTable::Channel,
            0,
            ComGroup::platform(Access::Object).index_group(),
        ),
        (0x13_0101, Access::Object, ComTable::Channel, 1, channel(1).com(Access::Object)),
        (0x13_0201, Access::Object, ComTable::Axis, 1, axis.com(Access::Object)),
    ] {
        assert_eq!(built.get(), printed);
        assert_eq!(parts(printed), com(Logical, access, table, instance));
    }
    // The manuals print this group as the base of all platform axes, and also as a complete group
    // (E-04).
    assert_eq!(parts(0x12_0200), com(Logical, Access::Element, ComTable::Axis, 0));
}

/// The group of a class without a channel is 0x120300 plus 0x1000 times the number of the class;
/// that of spindles, 0x25300, has no bit for logical addressing (ADR-5).
#[test]
fn bases_of_the_classes() {
    for (base, addressing, of) in [
        (0x12_0300, Logical, Class::PositionController),
        (0x12_1300, Logical, Class::Interpolator),
        (0x12_2300, Logical, Class::Decoder),
        (0x12_3300, Logical, Class::Hld),
        (0x12_4300, Logical, Class::PathPreparation),
        (0x2_5300, Index, Class::Spindle),
    ] {
        assert_eq!(parts(base), class(addressing, of, Attribute::Content, 0));
        // The group for queries of object addresses has no instance, and is 0x600 above the group
        // of content (ADR-6).
        assert_eq!(ClassGroup::object_address(of).index_group().get(), base + 0x600);
    }
}

/// The manuals print these groups for the attributes of feedhold.enable (ADR-6, SDA-10).
#[test]
fn attributes_of_an_element() {
    for (printed, attribute) in [
        (0x12_3301, Attribute::Content),
        (0x12_3401, Attribute::Name),
        (0x12_3501, Attribute::Type),
        (0x12_3601, Attribute::Length),
        (0x12_3701, Attribute::Unit),
        (0x12_3801, Attribute::WriteFlag),
    ] {
        assert_eq!(channel(1).class(Class::Hld, attribute).get(), printed);
        assert_eq!(parts(printed), class(Logical, Class::Hld, attribute, 1));
    }
}

/// Groups that the manuals print in queries of object addresses and in the replies are parsed
/// (ADR-10, SDA-3).
#[test]
fn object_addresses_are_as_printed() {
    let query = |of| class(Logical, of, Attribute::ObjectAddress, 0);
    assert_eq!(parts(0x12_3900), query(Class::Hld));
    assert_eq!(parts(0x12_2900), query(Class::Decoder));
    assert_eq!(parts(0x12_3302), class(Logical, Class::Hld, Attribute::Content, 2));
    assert_eq!(parts(0x12_2301), class(Logical, Class::Decoder, Attribute::Content, 1));
}

/// The address of an instance is queried by number or by index; that of a spindle, by index only
/// (SDA-1, E-02).
#[test]
fn queries_of_object_addresses() {
    let hld = FindInstance::new(Class::Hld, 1, 0);
    assert_eq!(hld.index_group().get(), 0x12_3900);
    assert_eq!(hld.by_index().index_group().get(), 0x2_3900);
    let spindle = FindInstance::new(Class::Spindle, 2, 0);
    assert_eq!(spindle.index_group().get(), 0x2_5900);
    assert_eq!(spindle.by_index(), spindle);
}

/// Only the reply (0, 0) means that the instance does not exist; another reply must have the group
/// of a class (SDA-2).
#[test]
fn only_address_0_0_has_no_first_element() {
    let first = |group, offset| {
        let (index_group, index_offset) = (IndexGroup::new(group), IndexOffset::new(offset));
        ObjectAddress { index_group, index_offset }.first_element()
    };
    assert_eq!(first(0, 0), Ok(None));
    let axis = first(0x12_3300, 0x1000).unwrap().expect("an instance");
    assert_eq!(axis.group(Attribute::Name).get(), 0x12_3400);
    assert_eq!(axis.index_offset().get(), 0x1000);
    for (group, offset) in [(0, 1), (0x12_0101, 0), (0x13_0101, 0), (0xF005, 0)] {
        let error = first(group, offset).unwrap_err();
        let numbers = (error.expected(), error.found());
        assert_eq!((error.kind(), numbers), (ErrorKind::Mismatch, (0x12_0300, group)));
    }
}

/// The manuals also print these groups without the logical bit; both groups differ only in this bit
/// (ADR-12).
#[test]
fn bases_without_the_logical_bit() {
    for (without, with) in [(0x2_0100, 0x12_0100), (0x2_0200, 0x12_0200), (0x2_0300, 0x12_0300)] {
        let by_index = match parts(with) {
            Group::Com(group) => Group::Com(ComGroup { addressing: Index, ..group }),
            Group::Class(group) => Group::Class(ClassGroup { addressing: Index, ..group }),
        };
        assert_eq!(parts(without), by_index);
    }
}

/// An undocumented group is not parsed, but its number is unchanged (ADR-10).
#[test]
fn undocumented_groups_do_not_parse() {
    for number in [
        0,
        0xF005,
        0x4020,
        0x12_0001,
        0x12_0A01,
        0x12_6301,
        0x13_0301,
        0x13_1101,
        0x22_2301,
        0x112_2301,
        u32::MAX,
    ] {
        assert_eq!(IndexGroup::new(number).parts(), None, "{number:#x}");
        assert_eq!(IndexGroup::new(number).get(), number);
    }
}

/// An offset is built and parsed with both printed strides; 0x10000 is the default (ADR-7, ADR-8).
#[test]
fn axes_with_both_strides() {
    let offset =
        |stride, axis, element| IndexOffset::for_axis(stride, axis, element).unwrap().get();
    assert_eq!(AxisStride::default(), AxisStride::X10000);
    for (axis, element, printed) in [
        (1, 4, 0x1_0004),
        (2, 4, 0x2_0004),
        (2, 5, 0x2_0005),
        (2, 0, 0x2_0000),
        (1, 1, 0x1_0001),
        (0, 0x48, 0x48),
    ] {
        assert_eq!(offset(AxisStride::X10000, axis, element), printed);
        let taken = IndexOffset::new(printed).axis_and_element(AxisStride::X10000);
        assert_eq!(taken, Ok((axis, element)));
    }
    // The stride 0x1000 is printed for the first platform axis of the HLD (E-01).
    assert_eq!(offset(AxisStride::X1000, 1, 0), 0x1000);
    assert_eq!(offset(AxisStride::X1000, 1, 1), 0x1001);
    // An offset does not show its stride.
    assert_eq!(offset(AxisStride::X10000, 1, 1), offset(AxisStride::X1000, 16, 1));
    assert_eq!(IndexOffset::new(0x1_0001).axis_and_element(AxisStride::X1000), Ok((16, 1)));
    // With the stride 0x1000, this offset would have an axis of 17 bits, which is invalid.
    let error = IndexOffset::new(0x1000_0000).axis_and_element(AxisStride::X1000).unwrap_err();
    assert_eq!((error.kind(), error.expected()), (ErrorKind::OutOfRange, 0xFFFF));
    assert_eq!((error.field().name(), error.found()), ("axis", 0x1_0000));
    // The offset of the largest axis and element with each stride.
    assert_eq!(offset(AxisStride::X10000, 0xFFFF, 0xFFFF), u32::MAX);
    assert_eq!(offset(AxisStride::X1000, 0xFFFF, 0xFFF), 0x0FFF_FFFF);
}

fn out_of_range<T: std::fmt::Debug>(result: Result<T, Error>) -> (&'static str, u32, u32) {
    let error = result.unwrap_err();
    assert_eq!(error.kind(), ErrorKind::OutOfRange);
    (error.field().name(), error.expected(), error.found())
}

/// A number that does not fit is rejected; the error contains the nearest valid number (ADR-9,
/// GEN-6).
#[test]
fn numbers_that_do_not_fit_are_rejected() {
    assert_eq!(out_of_range(Channel::new(0)), ("instance", 1, 0));
    assert_eq!(out_of_range(Channel::new(256)), ("instance", 255, 256));
    assert_eq!(out_of_range(Channel::by_index(0)), ("instance", 1, 0));
    assert_eq!(out_of_range(Channel::by_index(u32::MAX)), ("instance", 255, u32::MAX));
    assert_eq!(out_of_range(PlatformAxis::new(0)), ("instance", 1, 0));
    assert_eq!(out_of_range(PlatformAxis::new(256)), ("instance", 255, 256));
    assert_eq!(out_of_range(Spindle::new(256)), ("instance", 255, 256));
    let offset = IndexOffset::for_axis;
    let (wide, narrow) = (AxisStride::X10000, AxisStride::X1000);
    assert_eq!(out_of_range(offset(wide, 0x1_0000, 0)), ("axis", 0xFFFF, 0x1_0000));
    assert_eq!(out_of_range(offset(narrow, 0x1_0000, 0)), ("axis", 0xFFFF, 0x1_0000));
    assert_eq!(out_of_range(offset(wide, 1, 0x1_0000)), ("element", 0xFFFF, 0x1_0000));
    assert_eq!(out_of_range(offset(narrow, 1, 0x1000)), ("element", 0xFFF, 0x1000));
}

/// The number of an element has at most 16 bits: `nth` does not reach the next axis (SDA-4, ADR-9).
#[test]
fn elements_do_not_overflow_into_the_next_axis() {
    let axis = ChannelAxis::new(2).unwrap();
    let near = ElementAddress::for_axis(channel(1), Class::Decoder, axis, 0xFFFD).unwrap();
    let last = near.nth(2).unwrap();
    assert_eq!((last.class_group(), last.index_offset().get()), (near.class_group(), 0x2_FFFF));
    assert_eq!(last.nth(0), Ok(last));
    for places in [3, 0x1_0000, u32::MAX] {
        assert_eq!(out_of_range(near.nth(places)), ("element", 2, places));
    }
}

/// Class, attribute and instance do not change the other parts of a group (ADR-9).
#[test]
fn parts_of_a_group_are_independent() {
    for class in Class::ALL {
        for attribute in Attribute::ALL {
            for instance in 1..=u8::MAX {
                let number = u32::from(instance);
                let group = match class {
                    Class::Spindle => Spindle::new(number).unwrap().class(attribute),
                    _ => channel(number).class(class, attribute),
                };
                let one = match class {
                    Class::Spindle => Spindle::new(1).unwrap().class(attribute),
                    _ => channel(1).class(class, attribute),
                };
                assert_eq!((group.get() ^ one.get()) & !0xFF, 0);
                assert_eq!(group.get() & 0xFF, number);
                let Some(Group::Class(parts)) = group.parts() else { panic!("{group}") };
                let found = (parts.class, parts.attribute, parts.instance);
                assert_eq!(found, (class, attribute, instance));
            }
        }
    }
}

proptest! {
    #![proptest_config(kept::cases(1000, file!()))]

    /// An offset is parsed to the axis and element from which it was built. If one of them does not
    /// fit, the offset is not built (ADR-9).
    #[test]
    fn axis_and_element_are_independent(
        axis in prop_oneof![0..=0x2_0000_u32, any::<u32>()],
        element in prop_oneof![0..=0x2000_u32, 0..=0x2_0000_u32, any::<u32>()],
    ) {
        for (stride, element_max) in [(AxisStride::X10000, 0xFFFF), (AxisStride::X1000, 0xFFF)] {
            let fits = axis <= 0xFFFF && element <= element_max;
            match IndexOffset::for_axis(stride, axis, element) {
                Ok(offset) => {
                    prop_assert!(fits);
                    prop_assert_eq!(offset.axis_and_element(stride), Ok((axis, element)));
                }
                Err(error) => {
                    prop_assert!(!fits);
                    prop_assert_eq!(error.kind(), ErrorKind::OutOfRange);
                }
            }
        }
    }
}
