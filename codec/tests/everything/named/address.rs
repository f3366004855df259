//! Calls the functions of channels, axes, spindles and elements, and of index groups and index
//! offsets.

use ads_cnc::address::{Access, Attribute, AxisStride, Class};
use ads_cnc::*;

use super::{any, seen};

pub(super) fn runs() -> Result<(), Error> {
    let (class, attribute) = (any(Class::Decoder), any(Attribute::Name));
    let (access, stride) = (any(Access::Object), any(AxisStride::X1000));
    seen(address::Channel::by_index(any(1)));
    let channel = address::Channel::new(any(1))?;
    seen((address::Channel::number(channel), address::Channel::addressing(channel)));
    seen(address::Channel::class(channel, class, attribute));
    seen(address::Channel::com(channel, access));
    let axis = address::ChannelAxis::new(any(1))?;
    seen((address::ChannelAxis::index(axis), address::ChannelAxis::offset(axis, any(5))));
    let platform = address::PlatformAxis::new(any(1))?;
    seen((address::PlatformAxis::index(platform), address::PlatformAxis::com(platform, access)));
    let spindle = address::Spindle::new(any(1))?;
    seen((address::Spindle::index(spindle), address::Spindle::class(spindle, attribute)));

    let offset = address::IndexOffset::for_axis(stride, any(1), any(2))?;
    seen((
        address::IndexOffset::get(offset),
        address::IndexOffset::axis_and_element(offset, stride),
    ));
    let offset = address::IndexOffset::new(any(7));
    let group = address::IndexGroup::new(any(0x12_2301));
    seen(address::IndexGroup::get(group));
    if let Some(parts) = address::IndexGroup::parts(group) {
        seen(address::Group::index_group(parts));
    }
    let group = address::ClassGroup::object_address(class);
    seen(address::ClassGroup::index_group(group));
    let com = address::ComGroup::platform(access);
    seen(address::ComGroup::index_group(com));

    seen(address::ElementAddress::for_channel(channel, class, any(3)));
    seen(address::ElementAddress::for_axis(channel, class, axis, any(3)));
    seen(address::ElementAddress::for_spindle(spindle, any(3)));
    let element = address::ElementAddress::new(group, offset);
    seen(address::ElementAddress::class_group(element));
    seen(address::ElementAddress::group(element, attribute));
    seen(address::ElementAddress::index_offset(element));
    seen(address::ElementAddress::nth(element, any(1)));
    Ok(())
}
