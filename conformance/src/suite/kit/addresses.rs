//! The addresses of the simulated CNC's contents, according to the manuals.

use ads_cnc::address::{
    Access, Addressing, Attribute, AxisStride, Class, ClassGroup, ComGroup, ComTable,
    ElementAddress, IndexGroup, IndexOffset,
};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use crate::judge::{IfPresent as _, Rule, Step, assumed};
use crate::objects::{Object, ValueAddress};
use crate::simulator::{ContentOwner, StoredContent};
use crate::suite::kit::{Instance, Probe};

/// Facts about addresses from the target, where the manuals state none.
pub(crate) struct Addresses {
    /// The channel numbers, in the order of their ranks.
    channels: Vec<u32>,
    objects: Vec<Object>,
    instances: Vec<Instance>,
}

/// An address of a content, and the rules that state it.
pub(crate) type JudgedAddress = (ValueAddress, Vec<Rule>);

fn rules(ids: &[ClauseId]) -> Vec<Rule> {
    ids.iter().map(|&id| Rule::from(id)).collect()
}

fn object(held: &StoredContent, group: IndexGroup, offset: IndexOffset) -> Step<ValueAddress> {
    let size = u32::try_from(held.value.len())?;
    Ok(ValueAddress::Object { group, offset, size })
}

fn com(addressing: Addressing, table: ComTable, instance: u8) -> IndexGroup {
    ComGroup { addressing, access: Access::Element, table, instance }.index_group()
}

fn element(
    held: &StoredContent,
    (addressing, class, instance): (Addressing, Class, u8),
    offset: IndexOffset,
) -> Step<ValueAddress> {
    let length = u32::try_from(held.value.len())?;
    let group = ClassGroup { addressing, class, attribute: Attribute::Content, instance };
    Ok(ValueAddress::of_element(ElementAddress::new(group, offset), length))
}

impl Addresses {
    pub(crate) fn new(probe: &mut Probe<'_>) -> Step<Self> {
        Ok(Self {
            channels: probe.target.profile.channels.to_vec(),
            // A target without objects or elements has no addresses to judge.
            objects: probe.objects().if_applicable()?.unwrap_or_default(),
            instances: probe.instances().if_applicable()?.unwrap_or_default(),
        })
    }

    /// Each address of a content that a manual prints or the target returns.
    pub(crate) fn of(&self, held: &StoredContent) -> Step<Vec<JudgedAddress>> {
        use Addressing::{Index, Logical};
        let at = |stride, axis: u8| -> Step<IndexOffset> {
            Ok(IndexOffset::for_axis(stride, axis.into(), held.element)?)
        };
        let own = at(AxisStride::X10000, 0)?;
        match held.holder {
            ContentOwner::Platform => {
                let of = |addressing, instance| {
                    object(held, com(addressing, ComTable::Channel, instance), own)
                };
                let mut all = vec![
                    (of(Logical, 0)?, rules(&[COM_5, COM_4, ADR_3])),
                    (of(Index, 0)?, rules(&[ADR_12])),
                ];
                // Channel 1 has the platform's objects.
                if self.channels.first() == Some(&1) {
                    all.push((of(Logical, 1)?, rules(&[COM_4, ADR_3])));
                }
                Ok(all)
            }
            ContentOwner::Channel(channel) => {
                self.by_number_and_rank(channel, &[COM_5, ADR_3], |by, instance| {
                    object(held, com(by, ComTable::Channel, instance), own)
                })
            }
            ContentOwner::PlatformAxis(axis) => {
                let of = |addressing| object(held, com(addressing, ComTable::Axis, axis), own);
                Ok(vec![
                    (of(Logical)?, rules(&[COM_5, ADR_3, ADR_13, GEN_6])),
                    (of(Index)?, rules(&[ADR_12])),
                ])
            }
            ContentOwner::ChannelAxis { channel, place } => {
                let strides = [AxisStride::X10000, AxisStride::X1000];
                let offsets = strides.map(|stride| at(stride, place));
                let group = com(Logical, ComTable::Channel, channel);
                // Both strides are printed: the descriptor decides.
                let described = |offset: &IndexOffset| {
                    let here = |one: &&Object| one.address.content() == Some((group, *offset));
                    self.objects.iter().find(here).is_some_and(|one| one.name == held.name)
                };
                let described = offsets.into_iter().flatten().find(described);
                let offset = described.map_or_else(|| at(AxisStride::X10000, place), Ok)?;
                self.by_number_and_rank(channel, &[COM_5, ADR_13], |by, instance| {
                    object(held, com(by, ComTable::Channel, instance), offset)
                })
            }
            ContentOwner::OfChannel { class, channel } => {
                self.by_number_and_rank(channel, &[ADR_5, ADR_6], |by, instance| {
                    element(held, (by, class, instance), own)
                })
            }
            ContentOwner::OfAxis { class, axis } => {
                let first = self.first(class, 0, axis);
                // As printed, E-01.
                let stride = match class {
                    Class::Hld => AxisStride::X1000,
                    _ => AxisStride::X10000,
                };
                let offset =
                    first.map_or_else(|| at(stride, axis), |first| offset_of(first, held))?;
                let mut rules = rules(&[ADR_5, ADR_13, GEN_6]);
                rules.push(assumed(ADR_7));
                Ok(vec![(element(held, (Logical, class, 0), offset)?, rules)])
            }
            ContentOwner::OfPlace { class: Class::Decoder, channel, place } => {
                let offset = at(AxisStride::X10000, place)?;
                self.by_number_and_rank(channel, &[ADR_7, ADR_13, GEN_6], |by, instance| {
                    element(held, (by, Class::Decoder, instance), offset)
                })
            }
            ContentOwner::OfPlace { class, channel, place } => {
                let first = self.first(class, channel, place);
                let offset = first.map_or_else(
                    || at(AxisStride::X10000, place),
                    |first| offset_of(first, held),
                )?;
                self.by_number_and_rank(channel, &[ADR_5, ADR_13, GEN_6], |by, instance| {
                    element(held, (by, class, instance), offset)
                })
            }
            ContentOwner::Spindle(index) => {
                let place = element(held, (Index, Class::Spindle, index), own)?;
                Ok(vec![(place, rules(&[ADR_2, ADR_5, GEN_6]))])
            }
        }
    }

    /// The first address of a content that is an element.
    pub(crate) fn element(&self, held: &StoredContent) -> Step<Option<ElementAddress>> {
        let first = self.of(held)?.into_iter().next();
        Ok(first.and_then(|(place, _)| match place {
            ValueAddress::Element { element, .. } => Some(element),
            _ => None,
        }))
    }

    pub(crate) fn objects(&self) -> &[Object] {
        &self.objects
    }

    /// By the number of a channel and by its rank; none for a channel that is not claimed.
    fn by_number_and_rank(
        &self,
        channel: u8,
        logical: &[ClauseId],
        of: impl Fn(Addressing, u8) -> Step<ValueAddress>,
    ) -> Step<Vec<JudgedAddress>> {
        let mut ranks = (1_u8..).zip(&self.channels);
        let Some((rank, _)) = ranks.find(|(_, number)| **number == u32::from(channel)) else {
            return Ok(Vec::new());
        };
        Ok(vec![
            (of(Addressing::Logical, channel)?, rules(logical)),
            (of(Addressing::Index, rank)?, rules(&[ADR_1, ADR_12])),
        ])
    }

    /// The number of elements of the content's instance according to the target.
    pub(crate) fn count(&self, held: &StoredContent) -> Option<u32> {
        let found = match held.holder {
            ContentOwner::OfChannel { class, channel } => self.instance(class, channel, 0),
            ContentOwner::OfAxis { class, axis } => self.instance(class, 0, axis),
            ContentOwner::OfPlace { class, channel, place } => self.instance(class, channel, place),
            ContentOwner::Spindle(index) => self.instance(Class::Spindle, index, 0),
            _ => None,
        };
        found.map(|one| one.count)
    }

    /// The offset of the first element of an instance according to the target.
    fn first(&self, class: Class, channel: u8, axis: u8) -> Option<IndexOffset> {
        self.instance(class, channel, axis).map(|one| one.first.index_offset())
    }

    fn instance(&self, class: Class, channel: u8, axis: u8) -> Option<&Instance> {
        let asked = (class, u32::from(channel), u32::from(axis));
        self.instances.iter().find(|one| (one.class, one.channel, one.axis) == asked)
    }
}

fn offset_of(first: IndexOffset, held: &StoredContent) -> Step<IndexOffset> {
    Ok(IndexOffset::new(first.get().saturating_add(held.element)))
}

/// Whether the bytes are the same in another order.
pub(crate) fn is_permutation(one: &[u8], other: &[u8]) -> bool {
    let sorted = |bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        bytes.sort_unstable();
        bytes
    };
    one != other && sorted(one) == sorted(other)
}
