//! Queries about the first variables, parameters, elements and objects of a channel.

use ads_cnc::address::{Channel, ChannelAxis, Class, ClassGroup, ComGroup, ComTable, Group};
use ads_cnc::dynamic::{DynamicKind, DynamicName};
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, CountDynamic, CountElements, DescribeByName,
    DescribeExtended, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, HandleByName,
    ReadByHandle, ReadByName, ReadElement, ReadElementType, Request,
};
use ads_cnc::sda::ElementText;
use ads_cnc::{CncString, Decode as _, Description, Kind, U32List};

use crate::judge::{IfPresent as _, Step};
use crate::suite::kit::{
    Probe, RawCall, answering_places, ask_if_claimed, attribute_reads, is_sendable, name_of,
    name_on_axes,
};

/// The first variables and parameters of a channel.
pub(crate) struct ChannelItems {
    /// The first variables, at most three. Axis variables are left out, because it is only assumed
    /// that they can be read by their handles.
    variables: Vec<Description>,
    /// The first axis variable: the first axis index at which it has a handle, and its name on the
    /// axis interface.
    of_axis: Option<(ChannelAxis, CncString)>,
    parameters: Vec<(DynamicKind, CncString)>,
}

impl ChannelItems {
    /// Reads the first items of a channel. A list that cannot be read is left empty; other cases
    /// judge it.
    pub(crate) fn read(probe: &mut Probe<'_>, channel: Channel) -> Step<Self> {
        let all = probe.variables(channel).if_known()?.unwrap_or_default();
        let name = all.iter().find_map(name_on_axes);
        let places =
            name.as_ref().map(|name| answering_places(probe, channel, name)).transpose()?;
        let axis = places.and_then(|places| places.first().map(|at| at.axis));
        let mut parameters = Vec::new();
        for kind in DynamicKind::ALL {
            let name = ask_if_claimed(probe, DynamicNameByIndex::new(channel, kind, 1)?)?;
            let name = name.and_then(|name| DynamicName::decode(&name).ok());
            parameters.extend(name.map(|name| (kind, name.name.text)));
        }
        let is_of_axis = |one: &Description| one.name.text.to_string().starts_with("V.A.");
        let variables = all.into_iter().filter(|one| !is_of_axis(one)).take(3).collect();
        Ok(Self { variables, of_axis: axis.zip(name), parameters })
    }

    /// Queries about these items and about the first entries of the lists of variables and
    /// parameters. The queries address `channel`, usually the channel of the items, by its number
    /// or by its rank.
    pub(crate) fn requests(&self, channel: Channel) -> Step<Vec<Request<'_>>> {
        let mut requests = Vec::new();
        for variable in &self.variables {
            let name = name_of(variable);
            requests.push(HandleByName { channel, name }.into());
            requests.push(ReadByName { channel, name }.into());
            requests.push(ReadByHandle::new(channel, variable.handle, U32List::EMPTY).into());
            requests.push(DescribeByName { channel, name }.into());
        }
        if let Some((axis, name)) = &self.of_axis {
            let (axis, name) = (*axis, name.as_cnc_str().into());
            requests.push(AxisHandleByName { channel, axis, name }.into());
            requests.push(AxisReadByName { channel, axis, name }.into());
        }
        let extended = (0..4).map(|index| DescribeExtended::new(channel, index, Kind::V_E));
        requests.extend(extended.map(Request::from));
        for kind in DynamicKind::ALL {
            requests.push(CountDynamic::new(channel, kind).into());
            requests.push(DynamicNameByIndex::new(channel, kind, 1)?.into());
            requests.push(DynamicValueByIndex::new(channel, kind, 1)?.into());
        }
        for (kind, name) in &self.parameters {
            let name = name.as_cnc_str().into();
            requests.push(DynamicValueByName { channel, kind: *kind, name }.into());
        }
        // A device may have returned a name that is too long for a request.
        requests.retain(is_sendable);
        Ok(requests)
    }
}

/// Maximum number of objects of a channel, and of elements of an instance, that [`content_reads`]
/// requests.
const CONTENTS_MAX: usize = 2;

/// Queries about the first elements of each instance of a channel, and about the first objects of
/// the channel. The contents of texts are left out, because the length of a reply with a text is
/// not documented.
pub(crate) fn content_reads(probe: &mut Probe<'_>, channel: Channel) -> Step<Vec<RawCall>> {
    let mut calls = Vec::new();
    for instance in probe.instances().if_applicable()?.unwrap_or_default() {
        if instance.channel != u32::from(channel.number()) || instance.class == Class::Spindle {
            continue;
        }
        calls.extend(CountElements::new(instance.first).ok().map(RawCall::new).transpose()?);
        for element in instance.elements().take(CONTENTS_MAX) {
            let length = probe.length_of(element)?;
            let ty = probe.try_read::<ElementText>(ReadElementType::new(element))?;
            let is_text = ty.is_some_and(|ty| ty.text.text == *"STRING");
            let content = length.filter(|_| !is_text);
            let content = content.and_then(|length| ReadElement::new(element, length).ok());
            let requests = attribute_reads(element).into_iter().chain(content.map(Request::from));
            calls.extend(requests.map(RawCall::new).collect::<Step<Vec<_>>>()?);
        }
    }
    let objects = probe.objects().if_applicable()?.unwrap_or_default();
    let numbers = objects.iter().filter(|object| !object.is_text());
    let reads = numbers.filter_map(|object| RawCall::new(object.address.read().ok()?).ok());
    calls.extend(
        reads.filter(|call| in_channel(call, channel, channel).is_some()).take(CONTENTS_MAX),
    );
    Ok(calls)
}

/// The call with the channel number in its index group replaced by that of `other`; `None` if the
/// index group is not one of `channel`.
pub(crate) fn in_channel(call: &RawCall, channel: Channel, other: Channel) -> Option<RawCall> {
    let instance = other.number();
    let group = match call.index_group.parts()? {
        Group::Com(com) if com.table == ComTable::Channel && com.instance == channel.number() => {
            ComGroup { instance, ..com }.index_group()
        }
        Group::Class(class) if class.instance == channel.number() => {
            ClassGroup { instance, ..class }.index_group()
        }
        _ => return None,
    };
    Some(call.with(|call| call.index_group = group))
}
