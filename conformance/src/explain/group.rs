//! Describes index groups in words.

use ads_cnc::address::{
    Access, Addressing, Attribute, Class, ClassGroup, ComGroup, ComTable, Group, IndexGroup,
};

/// Describes an index group in words.
///
/// ```
/// use ads_cnc::address::IndexGroup;
/// use ads_cnc_conformance::explain::describe;
///
/// assert_eq!(describe(IndexGroup::new(0x12_3801)), "HLD of channel 1, write flag");
/// assert_eq!(
///     describe(IndexGroup::new(0x2_1302)),
///     "interpolator of the active channel number 2, content; by index, which moves when a channel is deactivated (ADR-11)"
/// );
/// assert_eq!(describe(IndexGroup::new(0xF005)), "no index group of the manuals");
/// ```
pub fn describe(group: IndexGroup) -> String {
    match group.parts() {
        None => "no index group of the manuals".to_owned(),
        Some(Group::Com(com)) => describe_com(com),
        Some(Group::Class(class)) => describe_class(class),
    }
}

/// The end of the description of a group that addresses a channel by index.
const BY_INDEX: &str = "; by index, which moves when a channel is deactivated (ADR-11)";

fn channel(addressing: Addressing, instance: u8) -> String {
    match addressing {
        Addressing::Logical => format!("channel {instance}"),
        Addressing::Index => format!("the active channel number {instance}"),
    }
}

fn describe_com(com: ComGroup) -> String {
    let access = match com.access {
        Access::Element => "content",
        Access::Object => "object list",
    };
    let (who, by_index) = match (com.table, com.instance) {
        (ComTable::Channel, 0) => ("the platform".to_owned(), false),
        (ComTable::Channel, 1) => {
            let first = channel(com.addressing, 1);
            (format!("{first}, and of the platform, which channel 1 drives (COM-4, E-04)"), true)
        }
        (ComTable::Channel, other) => (channel(com.addressing, other), true),
        (ComTable::Axis, 0) => ("platform axes, the axis in the offset (E-04)".to_owned(), false),
        (ComTable::Axis, place) => (format!("platform axis {place}"), false),
    };
    let moves = by_index && com.addressing == Addressing::Index;
    format!("COM, {access} of {who}{}", if moves { BY_INDEX } else { "" })
}

fn describe_class(group: ClassGroup) -> String {
    let class = group.class;
    let attribute = match group.attribute {
        Attribute::Content => "content",
        Attribute::Name => "name",
        Attribute::Type => "type",
        Attribute::Length => "length",
        Attribute::Unit => "unit",
        Attribute::WriteFlag => "write flag",
        Attribute::ObjectAddress => "object address",
    };
    let instance = group.instance;
    let asked = group.attribute == Attribute::ObjectAddress && instance == 0;
    match (group.class, instance) {
        _ if asked => format!("{class}, {attribute}: the instance is in the request"),
        (Class::Spindle, index) => format!("spindle of index {index}, counted from 0, {attribute}"),
        (_, 0) => format!("{class} of the platform, {attribute}"),
        (_, number) => {
            let moves = if group.addressing == Addressing::Index { BY_INDEX } else { "" };
            format!("{class} of {}, {attribute}{moves}", channel(group.addressing, number))
        }
    }
}
