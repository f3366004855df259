//! The lists with a number of items, and the request for an item.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind};
use ads_cnc::operation::{
    CountDynamic, CountElements, CountObjects, CountVariables, DescribeByIndex, DynamicNameByIndex,
    ObjectList, ReadDescriptors, ReadElementName, Request,
};
use ads_cnc::sda::ElementCount;
use ads_cnc::{Kind, ObjectCount, VariableCount};

use crate::judge::Step;
use crate::suite::kit::{Instance, Probe};

/// A list whose items are requested by their number from 1.
#[derive(Clone, Debug)]
pub(crate) enum Counted {
    Objects(ObjectList),
    Variables(Channel, &'static str, Kind<'static>),
    Parameters(Channel, DynamicKind),
    Elements(Instance),
}

impl std::fmt::Display for Counted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Objects(list) => write!(f, "objects of {}", list.parts().index_group()),
            Self::Variables(channel, kind, _) => {
                write!(f, "{kind} of channel {}", channel.number())
            }
            Self::Parameters(channel, kind) => {
                write!(f, "{kind:?} of channel {}", channel.number())
            }
            Self::Elements(instance) => write!(f, "elements of {instance}"),
        }
    }
}

impl Counted {
    /// The number of items according to the target.
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

    /// Whether the target has an item with this number.
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
