//! The lists of a target, which are stored after they were read: objects of the COM task, instances
//! of the classes of SDA and GEO, and descriptions of variables.

mod variables;

use std::ops::Range;

use ads_cnc::address::{
    Addressing, Channel, Class, ClassGroup, ComGroup, ComTable, ElementAddress, Group, PlatformAxis,
};
use ads_cnc::operation::{
    CountObjects, FindInstance, Function, ObjectList, ReadDescriptors, ReadElementLength,
    ReadElementName, ReadElementType, ReadElementUnit, ReadElementWriteFlag, Request,
};
use ads_cnc::sda::{ElementLength, ObjectAddress};
use ads_cnc::{Descriptors, ObjectCount};

pub(crate) use variables::{VARIABLES_MAX, name_of};

use crate::judge::{OrStop as _, Step, Stop};
use crate::objects::{CLASSES, ListedValue, ValueAddress, ValueList, Walker};
use crate::profile::Claim;
use crate::suite::kit::{Instance, ItemKind, Probe};

/// Limit of the number of objects of a list, and of elements of an instance, in most reads without
/// sampling. The case `com-descriptors-in-sequence` also reads a longer list with one request.
pub(crate) const OBJECTS_MAX: u32 = 10_000;
/// The highest axis number and spindle index that the search for instances requests.
pub(crate) const INSTANCES_MAX: u32 = 255;

/// Classes that have an instance for each channel, and one for each axis index of the channel.
pub(crate) const OF_PLACES: [Class; 3] =
    [Class::Interpolator, Class::Decoder, Class::PathPreparation];

/// The requests for the name, type, length, unit and write flag of an element.
pub(crate) fn attribute_reads(element: ElementAddress) -> [Request<'static>; 5] {
    [
        ReadElementName::new(element).into(),
        ReadElementType::new(element).into(),
        ReadElementLength::new(element).into(),
        ReadElementUnit::new(element).into(),
        ReadElementWriteFlag::new(element).into(),
    ]
}

/// The same element, addressed by the rank of its channel.
pub(crate) fn element_by_rank(element: ElementAddress, rank: u8) -> ElementAddress {
    let group =
        ClassGroup { addressing: Addressing::Index, instance: rank, ..element.class_group() };
    ElementAddress::new(group, element.index_offset())
}

impl Walker for Probe<'_> {
    type Error = Stop;

    fn request<'r>(&mut self, request: impl Into<Request<'r>>) -> Step<Option<Vec<u8>>> {
        self.try_ask(request)
    }
}

impl Probe<'_> {
    /// Each claimed channel, addressed by its rank among the claimed channels and by its number.
    pub(crate) fn ranks(&self) -> Step<Vec<(Channel, Channel)>> {
        let ranked = (1..).zip(self.channels()?);
        ranked.map(|(rank, channel)| Ok((Channel::by_index(rank)?, channel))).collect()
    }

    /// The rank of the channel with this number; `None` if the channel is not claimed.
    pub(crate) fn rank_of(&self, number: u32) -> Option<u8> {
        let channels = self.target.profile.channels.iter();
        (1..).zip(channels).find(|(_, channel)| **channel == number).map(|(rank, _)| rank)
    }

    /// The address of an object in the group that addresses its channel by rank; `None` if the
    /// group of the object is not a logical group of COM, or if its channel is not claimed. The
    /// platform and its axes have the same numbers in both groups.
    pub(crate) fn address_by_rank(&self, object: &ListedValue) -> Option<ValueAddress> {
        let (group, offset) = object.address.content()?;
        let Some(Group::Com(com)) = group.parts() else { return None };
        let instance = match (com.table, com.instance) {
            (ComTable::Channel, 1..) => self.rank_of(com.instance.into())?,
            (_, instance) => instance,
        };
        let by_rank = ComGroup { addressing: Addressing::Index, instance, ..com };
        let (group, size) = (by_rank.index_group(), object.size());
        (com.addressing == Addressing::Logical).then_some(ValueAddress::Object {
            group,
            offset,
            size,
        })
    }

    /// Axis indices, each as channel number and axis index: those without an axis according to the
    /// profile, and those of `unwritten_places`, which may or may not have an axis.
    fn empty_places(&self) -> impl Iterator<Item = &(u32, u32)> {
        self.target.profile.empty_places.iter().chain(&self.target.unwritten_places)
    }

    /// Whether an object of a channel may belong to an axis index that has no axis, or may have
    /// none. A value that is written at an axis index without an axis may be lost.
    pub(crate) fn is_blank(&self, object: &ListedValue) -> bool {
        let ValueList::Channel(number) = object.list else { return false };
        self.empty_places().filter(|at| at.0 == u32::from(number)).any(|at| object.is_of_axis(at.1))
    }

    /// The length of an element in bytes, read from its length attribute; `None` if it cannot be
    /// read.
    pub(crate) fn length_of(&mut self, element: ElementAddress) -> Step<Option<u32>> {
        let length: Option<ElementLength> = self.try_read(ReadElementLength::new(element))?;
        Ok(length.map(ElementLength::get))
    }

    /// The object lists of the platform, of the claimed channels and of the claimed platform axes.
    pub(crate) fn lists(&self) -> Step<Vec<ObjectList>> {
        let channels = self.channels()?.into_iter().map(ObjectList::from);
        let axes = (1..=self.target.profile.platform_axes).map(PlatformAxis::new);
        let axes: Result<Vec<_>, _> = axes.map(|axis| axis.map(ObjectList::from)).collect();
        let platform = std::iter::once(ObjectList::PLATFORM);
        Ok(platform.chain(channels).chain(axes?).collect())
    }

    /// The numbers or indices in the range `items` that the cases read, in ascending order.
    pub(crate) fn sample(&self, kind: ItemKind, items: Range<u32>) -> Vec<u32> {
        self.target.sample.of(items, self.target.sample_sizes.of(kind))
    }

    /// The numbers of the objects that the cases read in a list of `count` objects; the first
    /// object has the number 1.
    pub(crate) fn object_numbers(&self, count: u32) -> Vec<u32> {
        self.sample(ItemKind::Object, 1..count.saturating_add(1))
    }

    /// The objects that the cases read, of all [`lists`](Self::lists). Ends the case as not
    /// applicable if there are none, or if the profile does not claim the requests. Other cases
    /// judge descriptors that cannot be read.
    pub(crate) fn objects(&mut self) -> Step<Vec<ListedValue>> {
        if self.target.objects.is_none() {
            let mut all = Vec::new();
            for list in self.lists()? {
                let count: Option<ObjectCount> = self.try_read(CountObjects::new(list))?;
                let numbers = self.object_numbers(count.map_or(0, |count| count.0));
                self.each(numbers, |probe, number| {
                    let Ok(read) = ReadDescriptors::new(list, number, 1) else { return Ok(false) };
                    let one: Option<Descriptors> = probe.try_read(read)?;
                    let one = one.filter(|one| one.len() == 1);
                    let objects = one.iter().flat_map(|one| one.iter());
                    all.extend(objects.map(|one| ListedValue::of_descriptor(list.into(), one)));
                    Ok(one.is_some())
                })?;
            }
            self.target.objects = Some(all);
            self.end_comparison();
        }
        let all = self.target.objects.clone();
        all.filter(|all| !all.is_empty()).or_not_applicable("the target has no object")
    }

    /// Whether an instance is at an axis index that has no axis, or may have none.
    pub(crate) fn is_at_empty_place(&self, instance: &Instance) -> bool {
        let at = (instance.channel, instance.axis);
        OF_PLACES.contains(&instance.class) && self.empty_places().any(|empty| *empty == at)
    }

    /// The instances of the claimed channels, of the platform and of the spindles, for which the
    /// target returns an address. Axes and spindles are requested until the target returns no
    /// address of an element, or the address of a known instance of the same class, but at most up
    /// to the number or index [`INSTANCES_MAX`]. Ends the case as not applicable if there are no
    /// instances, or if the profile does not claim the requests for their addresses, their numbers
    /// of elements and the names of elements. Other cases judge the addresses.
    pub(crate) fn instances(&mut self) -> Step<Vec<Instance>> {
        if self.claims(Function::FindInstance) == Claim::No {
            return Err(Stop::not_applicable("the profile does not claim object addresses"));
        }
        if self.target.instances.is_none() {
            let (mut all, channels) = (Vec::new(), self.channels()?);
            for class in CLASSES {
                self.instances_of(class, &channels, true, &mut |probe, channel, axis| {
                    probe.has_instance(class, channel, axis, &mut all)
                })?;
            }
            self.target.instances = Some(all);
            self.end_comparison();
        }
        let all = self.target.instances.clone();
        all.filter(|all| !all.is_empty()).or_not_applicable("the target names no instance")
    }

    fn has_instance(
        &mut self,
        class: Class,
        channel: u32,
        axis: u32,
        all: &mut Vec<Instance>,
    ) -> Step<bool> {
        let Some(address) = self.address_of(class, channel, axis)? else { return Ok(false) };
        let Ok(Some(first)) = address.first_element() else { return Ok(false) };
        // Without this check, a target that returns the same address for every axis would have an
        // instance for each axis number up to `INSTANCES_MAX`.
        if all.iter().any(|known| known.class == class && known.first == first) {
            return Ok(false);
        }
        let reported = self.count_elements(first)?.unwrap_or_default();
        let reached = self.last_named(first, reported.min(OBJECTS_MAX))?;
        // If an element has a name, and the number of the last one is one less than the reported
        // number, the reported number is taken to include element 0.
        let is_itself = (1..=OBJECTS_MAX).contains(&reported)
            && reached.saturating_add(1) == reported
            && (reached > 0 || self.is_named(first, 0)?);
        let count = if is_itself { reached } else { reported };
        let sample = (self.target.sample, self.target.sample_sizes.of(ItemKind::Element));
        all.push(Instance { class, channel, axis, first, reported, count, reached, sample });
        Ok(true)
    }

    /// Chooses again the elements that the cases read of each known instance, after the sample
    /// sizes have changed.
    pub(crate) fn choose_elements(&mut self) {
        let sample = (self.target.sample, self.target.sample_sizes.of(ItemKind::Element));
        for one in self.target.instances.iter_mut().flatten() {
            one.sample = sample;
        }
    }

    /// The number of the last element that has a name, at most `count`; 0 if no name of an element
    /// after element 0 is found. If element `count` has no name, the search starts at element 1 and
    /// ends after [`GAP`](crate::objects::GAP) consecutive elements without a name.
    fn last_named(&mut self, first: ElementAddress, count: u32) -> Step<u32> {
        if self.is_named(first, count)? {
            return Ok(count);
        }
        let mut reached = 0;
        self.each(1..count, |probe, number| {
            let is_named = probe.is_named(first, number)?;
            if is_named {
                reached = number;
            }
            Ok(is_named)
        })?;
        Ok(reached)
    }

    fn is_named(&mut self, first: ElementAddress, place: u32) -> Step<bool> {
        match first.nth(place) {
            Ok(element) => Ok(self.try_ask(ReadElementName::new(element))?.is_some()),
            Err(_) => Ok(false),
        }
    }

    /// The address of an instance, which may be (0, 0); `None` unless the reply is an address.
    pub(crate) fn address_of(
        &mut self,
        class: Class,
        channel: u32,
        axis: u32,
    ) -> Step<Option<ObjectAddress>> {
        self.try_read(FindInstance::new(class, channel, axis))
    }
}
