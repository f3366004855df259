//! The addresses of contents according to the manuals.

use ads_cnc::address::{
    Access, Addressing, Attribute, AxisStride, Class, ClassGroup, ComGroup, ComTable,
    ElementAddress, IndexOffset,
};
use ads_cnc::operation::FindInstance;
use ads_cnc::sda::ObjectAddress;
use ads_cnc_conformance::objects::ValueAddress;
use ads_cnc_conformance::simulator::{ContentOwner, StoredContent};

use crate::target::{CheckResult, TestCnc};

/// The addresses of a content. For a content of a channel: by the number of the channel, and then
/// by its rank; none if the CNC does not have this channel.
pub(crate) fn addresses(
    target: &TestCnc,
    content: &StoredContent,
) -> CheckResult<Vec<ValueAddress>> {
    use Addressing::{Index, Logical};
    let length = u32::try_from(content.value.len())?;
    let at = |stride, axis: u8| IndexOffset::for_axis(stride, axis.into(), content.element);
    let object = |addressing, table, instance, offset| {
        let group = ComGroup { addressing, access: Access::Element, table, instance };
        ValueAddress::Object { group: group.index_group(), offset, size: length }
    };
    let element = |addressing, class, instance, offset| {
        let group = ClassGroup { addressing, class, attribute: Attribute::Content, instance };
        ValueAddress::of_element(ElementAddress::new(group, offset), length)
    };
    let both = |channel, of: &dyn Fn(Addressing, u8) -> ValueAddress| {
        let mut ranks = (1_u8..).zip(target.channels());
        match ranks.find(|(_, number)| *number == channel) {
            Some((rank, _)) => vec![of(Logical, channel), of(Index, rank)],
            None => Vec::new(),
        }
    };
    // The index offset of an element, calculated from the address of the instance, which the
    // target returns.
    let of_first = |class, channel: u8, axis: u8| -> CheckResult<IndexOffset> {
        let find = FindInstance::new(class, channel.into(), axis.into());
        let first = target.read::<ObjectAddress>(find)?.first_element()?;
        let first = first.map_or(0, |first| first.index_offset().get());
        Ok(IndexOffset::new(first.saturating_add(content.element)))
    };
    let own = at(AxisStride::X10000, 0)?;
    Ok(match content.holder {
        // The objects of the platform also have addresses of channel 1.
        ContentOwner::Platform => [(Logical, 0), (Index, 0), (Logical, 1)]
            .map(|(by, instance)| object(by, ComTable::Channel, instance, own))
            .to_vec(),
        ContentOwner::Channel(channel) => {
            both(channel, &|by, instance| object(by, ComTable::Channel, instance, own))
        }
        ContentOwner::PlatformAxis(axis) => {
            [Logical, Index].map(|by| object(by, ComTable::Axis, axis, own)).to_vec()
        }
        ContentOwner::ChannelAxis { channel, place } => {
            let offset = at(AxisStride::X10000, place)?;
            both(channel, &|by, instance| object(by, ComTable::Channel, instance, offset))
        }
        ContentOwner::OfChannel { class, channel } => {
            both(channel, &|by, instance| element(by, class, instance, own))
        }
        ContentOwner::OfAxis { class, axis } => {
            vec![element(Logical, class, 0, of_first(class, 0, axis)?)]
        }
        ContentOwner::OfPlace { class: Class::Decoder, channel, place } => {
            let offset = at(AxisStride::X10000, place)?;
            both(channel, &|by, instance| element(by, Class::Decoder, instance, offset))
        }
        ContentOwner::OfPlace { class, channel, place } => {
            let offset = of_first(class, channel, place)?;
            both(channel, &|by, instance| element(by, class, instance, offset))
        }
        ContentOwner::Spindle(index) => vec![element(Index, Class::Spindle, index, own)],
    })
}

/// The first address of an element; `None` for an object.
pub(crate) fn element(
    target: &TestCnc,
    content: &StoredContent,
) -> CheckResult<Option<ElementAddress>> {
    Ok(addresses(target, content)?.into_iter().find_map(|address| match address {
        ValueAddress::Element { element, .. } => Some(element),
        _ => None,
    }))
}
