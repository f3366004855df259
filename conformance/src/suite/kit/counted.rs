//! Lists whose number of items can be requested, and the request for an item.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind};
use ads_cnc::operation::{
    CountDynamic, CountElements, CountObjects, CountVariables, DescribeByIndex, DynamicNameByIndex,
    ObjectList, ReadDescriptors, ReadElementName, Request,
};
use ads_cnc::sda::ElementCount;
use ads_cnc::{Kind, ObjectCount, VariableCount};

use crate::judge::{IfPresent as _, Step};
use crate::objects::ValueList;
use crate::suite::kit::{Instance, ItemKind, Probe};

/// A list of items that are numbered from 1; the number of a variable is its index plus 1.
#[derive(Clone, Debug)]
pub(crate) enum Counted {
    Objects(ObjectList),
    Variables(Channel, &'static str, Kind<'static>),
    Parameters(Channel, DynamicKind),
    Elements(Instance),
}

impl std::fmt::Display for Counted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.list().fmt(f)
    }
}

impl Counted {
    /// All lists that the profile claims and for which the target returns the number of items, each
    /// with that number.
    pub(crate) fn all(probe: &mut Probe<'_>) -> Step<Vec<(Self, u32)>> {
        let mut all: Vec<Self> = probe.lists()?.into_iter().map(Self::Objects).collect();
        for channel in probe.channels()? {
            let listed = probe.kinds().into_iter();
            all.extend(listed.map(|(name, kind)| Self::Variables(channel, name, kind)));
            all.extend(DynamicKind::ALL.map(|kind| Self::Parameters(channel, kind)));
        }
        let instances = probe.instances().if_applicable()?.unwrap_or_default();
        all.extend(instances.into_iter().map(Self::Elements));
        let mut counted = Vec::new();
        for one in all {
            let number = one.number(probe).if_applicable()?.flatten();
            counted.extend(number.map(|number| (one, number)));
        }
        Ok(counted)
    }

    /// The kind of the items; `None` for parameters, of which the cases do not read a sample.
    pub(crate) const fn kind(&self) -> Option<ItemKind> {
        match self {
            Self::Objects(_) => Some(ItemKind::Object),
            Self::Variables(..) => Some(ItemKind::Variable),
            Self::Elements(_) => Some(ItemKind::Element),
            Self::Parameters(..) => None,
        }
    }

    /// The list in the form of the tools, whose `Display` is the name of the list.
    pub(crate) fn list(&self) -> ValueList {
        match *self {
            Self::Objects(list) => list.into(),
            Self::Variables(channel, kind, _) => {
                ValueList::Variables { kind, channel: channel.number(), axis: None }
            }
            Self::Parameters(channel, kind) => {
                ValueList::Parameters { kind, channel: channel.number() }
            }
            Self::Elements(ref one) => ValueList::of_instance(one.class, one.channel, one.axis),
        }
    }

    /// The number of items according to the target; `None` if the target does not return it.
    pub(crate) fn number(&self, probe: &mut Probe<'_>) -> Step<Option<u32>> {
        Ok(match self {
            Self::Objects(list) => {
                probe.try_read(CountObjects::new(*list))?.map(|count: ObjectCount| count.0)
            }
            Self::Variables(channel, _, kind) => {
                let request = CountVariables::new(*channel, *kind);
                probe.try_read(request)?.map(|count: VariableCount| count.0)
            }
            Self::Parameters(channel, kind) => {
                let request = CountDynamic::new(*channel, *kind);
                probe.try_read(request)?.map(|count: DynamicCount| count.0)
            }
            Self::Elements(instance) => match CountElements::new(instance.first) {
                Ok(request) => probe.try_read(request)?.map(|count: ElementCount| count.0),
                Err(_) => None,
            },
        })
    }

    /// Whether the target returns data for the item with this number: the descriptor of an object,
    /// the description of a variable, or the name of a parameter or an element.
    pub(crate) fn has(&self, probe: &mut Probe<'_>, number: u32) -> Step<bool> {
        let request: Option<Request<'_>> = match self {
            Self::Objects(list) => ReadDescriptors::new(*list, number, 1).ok().map(Into::into),
            Self::Variables(channel, _, kind) => {
                let index = number.checked_sub(1);
                index.map(|index| DescribeByIndex::new(*channel, index, *kind).into())
            }
            Self::Parameters(channel, kind) => {
                DynamicNameByIndex::new(*channel, *kind, number).ok().map(Into::into)
            }
            Self::Elements(instance) => {
                let element = instance.first.nth(number).ok();
                element.map(|element| ReadElementName::new(element).into())
            }
        };
        let Some(request) = request else { return Ok(false) };
        Ok(probe.try_ask(request)?.is_some_and(|data| !data.is_empty()))
    }
}
