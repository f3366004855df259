//! What the CNC has: channels with objects and variables, the platform, its axes.

use ads_cnc::address::{Addressing, ChannelAxis, ComTable};
use ads_cnc::operation::ObjectList;
use ads_cnc::{CncStr, CncString, Descriptors, DescriptorsRef, Handle, VariablePath};

use super::check::{self, ModelError};
use super::variable::{Variable, split_indices};

/// A channel: what it is configured with.
#[derive(Clone, Debug)]
pub struct ChannelModel {
    /// Logical number, from 1.
    pub number: u8,
    /// An inactive channel has no rank and answers nothing.
    pub active: bool,
    /// Its COM objects, without those of the platform.
    pub objects: Descriptors,
    /// Its variables; of each kind, the order is that of their indices.
    pub variables: Vec<Variable>,
    /// Instance identifiers of the axes at its places, from place 1 on.
    pub axes: Vec<CncString>,
}

/// A checked data model.
#[derive(Clone, Debug)]
pub struct Model {
    channels: Vec<ChannelModel>,
    platform: Descriptors,
    axes: Vec<Descriptors>,
    /// Objects of the first active channel and behind them those of the platform.
    first: Descriptors,
}

impl Model {
    /// A model of these channels, platform objects and objects of each platform axis.
    ///
    /// # Errors
    /// [`ModelError`] if the parts do not fit each other or what the streams can carry.
    pub fn new(
        mut channels: Vec<ChannelModel>,
        platform: Descriptors,
        axes: Vec<Descriptors>,
    ) -> Result<Self, ModelError> {
        channels.sort_by_key(|channel| channel.number);
        let active = channels.iter().find(|channel| channel.active);
        let own = active.map(|channel| channel.objects.as_ref());
        let listed = own.iter().flat_map(DescriptorsRef::iter).chain(platform.as_ref().iter());
        let first = listed.map(|object| object.to_owned()).collect();
        check::channels(&channels)?;
        check::objects(&channels, &platform, &axes)?;
        check::list(&first)?;
        Ok(Self { channels, platform, axes, first })
    }

    /// All channels in the order of their numbers.
    pub fn channels(&self) -> &[ChannelModel] {
        &self.channels
    }

    /// The channel with this logical number, if it is active.
    pub fn by_number(&self, number: u8) -> Option<&ChannelModel> {
        self.active().find(|channel| channel.number == number)
    }

    /// The channel of this rank, from 1, among the active ones (ADR-11).
    pub fn by_rank(&self, rank: u8) -> Option<&ChannelModel> {
        self.active().nth(usize::from(rank).checked_sub(1)?)
    }

    fn active(&self) -> impl Iterator<Item = &ChannelModel> {
        self.channels.iter().filter(|channel| channel.active)
    }

    /// The channel an address means.
    pub fn channel(&self, at: ads_cnc::address::Channel) -> Option<&ChannelModel> {
        self.addressed(at.addressing(), at.number())
    }

    fn addressed(&self, addressing: Addressing, number: u8) -> Option<&ChannelModel> {
        match addressing {
            Addressing::Logical => self.by_number(number),
            Addressing::Index => self.by_rank(number),
        }
    }

    /// The COM objects of a list; the platform's are in that of the first channel too (COM-4).
    pub fn objects(&self, list: ObjectList) -> Option<DescriptorsRef<'_>> {
        let parts = list.parts();
        match (parts.table, parts.instance) {
            (ComTable::Channel, 0) => Some(self.platform.as_ref()),
            (ComTable::Channel, number) => {
                let channel = self.addressed(parts.addressing, number)?;
                let first = self.by_rank(1)?;
                let drives = first.number == channel.number;
                Some(if drives { self.first.as_ref() } else { channel.objects.as_ref() })
            }
            (ComTable::Axis, place) => {
                let place = usize::from(place).checked_sub(1)?;
                self.axes.get(place).map(Descriptors::as_ref)
            }
        }
    }
}

impl ChannelModel {
    /// The variables of a kind in the order of their indices; none for a kind that has no index.
    pub fn of_kind(&self, kind: CncStr<'_>) -> Option<impl Iterator<Item = &Variable>> {
        let kind = super::variable::KINDS.into_iter().find(|known| kind == **known)?;
        Some(self.variables.iter().filter(move |variable| variable.kind() == Some(kind)))
    }

    /// The variable with this handle.
    pub fn by_handle(&self, handle: Handle) -> Option<&Variable> {
        self.variables.iter().find(|variable| variable.handle == handle)
    }

    /// The variable with just this name.
    pub fn by_name(&self, name: CncStr<'_>) -> Option<&Variable> {
        self.variables.iter().find(|variable| variable.name.as_cnc_str() == name)
    }

    /// The name on the channel interface of what has this name on the axis interface: with the
    /// identifier of the axis that is at the place.
    pub fn axis_name(&self, place: ChannelAxis, name: CncStr<'_>) -> Option<CncString> {
        let axis = self.axes.get(usize::from(place.place()).checked_sub(1)?)?;
        VariablePath::from_text(name).ok()?.with_axis(axis.as_cnc_str()).ok()
    }

    /// The variable of which this name means the whole or an element, and the element's indices.
    pub fn by_element_name(&self, name: CncStr<'_>) -> Option<(&Variable, Vec<u32>)> {
        let bytes: Vec<u8> = name.bytes().collect();
        let (whole, indices) = split_indices(&bytes)?;
        let variable = self.variables.iter().find(|variable| variable.name.as_bytes() == whole)?;
        Some((variable, indices))
    }
}

#[cfg(test)]
mod tests {
    use ads_cnc::Descriptor;
    use ads_cnc::address::{Channel, PlatformAxis};

    use super::*;

    fn objects(ids: &[u32]) -> Descriptors {
        let object = |&id: &u32| Descriptor::new("o", "BOOL").unwrap().with_id(id).with_size(1);
        ids.iter().map(object).collect()
    }

    fn model(actives: [bool; 3]) -> Model {
        let channel = |(number, active): (u8, bool)| ChannelModel {
            number,
            active,
            objects: objects(&[number.into()]),
            variables: Vec::new(),
            axes: Vec::new(),
        };
        let channels = [6, 1, 2].into_iter().zip(actives).map(channel).collect();
        Model::new(channels, objects(&[100]), vec![objects(&[200]), objects(&[201, 202])]).unwrap()
    }

    fn ids(model: &Model, list: impl Into<ObjectList>) -> Option<Vec<u32>> {
        let objects = model.objects(list.into())?;
        Some(objects.iter().map(|object| object.id()).collect())
    }

    #[test]
    fn a_rank_counts_active_channels_and_a_number_does_not() {
        let all = model([true, true, true]);
        assert_eq!(all.by_rank(3).map(|channel| channel.number), Some(6));
        let without_1 = model([true, false, true]);
        assert_eq!(without_1.by_rank(2).map(|channel| channel.number), Some(6));
        assert_eq!(without_1.by_number(6).map(|channel| channel.number), Some(6));
        assert!(without_1.by_number(1).is_none() && without_1.by_rank(3).is_none());
        assert!(without_1.by_rank(0).is_none());
    }

    #[test]
    fn platform_objects_are_in_two_lists() {
        let all = model([true, true, true]);
        assert_eq!(ids(&all, ObjectList::PLATFORM), Some(vec![100]));
        assert_eq!(ids(&all, Channel::new(1).unwrap()), Some(vec![1, 100]));
        assert_eq!(ids(&all, Channel::by_index(1).unwrap()), Some(vec![1, 100]));
        assert_eq!(ids(&all, Channel::new(2).unwrap()), Some(vec![2]));
        let without_1 = model([true, false, true]);
        assert_eq!(ids(&without_1, Channel::new(1).unwrap()), None);
        assert_eq!(ids(&without_1, Channel::new(2).unwrap()), Some(vec![2, 100]));
    }

    #[test]
    fn platform_axes_are_counted_from_1() {
        let all = model([true, true, true]);
        assert_eq!(ids(&all, PlatformAxis::new(2).unwrap()), Some(vec![201, 202]));
        assert_eq!(ids(&all, PlatformAxis::new(3).unwrap()), None);
    }
}
