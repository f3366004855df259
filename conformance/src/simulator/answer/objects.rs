//! Answers requests for COM objects: descriptors and contents (COM).

use ads_cnc::address::{AxisStride, ComGroup, ComTable, IndexOffset};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{CountObjects, ObjectList, ReadDescriptors, ReadObject, WriteObject};
use ads_cnc::{ContentRef, Descriptors, DescriptorsRef, ObjectCount};

use super::{AnsweringCnc, ReplyData, encode};
use crate::number::{to_u32, to_usize};
use crate::simulator::content;
use crate::simulator::owner::Owner;

impl AnsweringCnc<'_> {
    pub(super) fn count_objects(&self, op: &CountObjects) -> ReplyData {
        encode(ObjectCount(to_u32(self.objects(op.list)?.len())))
    }

    pub(super) fn descriptors(&self, op: &ReadDescriptors) -> ReplyData {
        let list = self.objects(op.list())?;
        let first = to_usize(op.first()).checked_sub(1).ok_or(AdsError::INVALID_OFFSET)?;
        let asked = list.slice(first, to_usize(op.count()));
        if asked.is_empty() { Err(AdsError::INVALID_OFFSET) } else { encode(asked) }
    }

    pub(super) fn read_object(&self, op: &ReadObject) -> ReplyData {
        let (owner, index) = self.object(op.address())?;
        let bytes = content::read(self.model, &self.state, owner, index)?;
        encode(ContentRef { bytes: &bytes })
    }

    pub(super) fn write_object(&mut self, op: &WriteObject<'_>) -> ReplyData {
        let (owner, index) = self.object(op.address())?;
        content::write(self.model, &mut self.state, owner, index, op.content().bytes)?;
        Ok(Vec::new())
    }

    /// The objects of a list; the list of the first active channel includes the objects of the
    /// platform (COM-4).
    fn objects(&self, list: ObjectList) -> Result<DescriptorsRef<'_>, AdsError> {
        let parts = list.parts();
        let list = match (parts.table, parts.instance) {
            (ComTable::Channel, 0) => Some(&self.model.platform_list),
            (ComTable::Channel, number) => {
                let channel = self.state.channel(self.model, parts.addressing, number)?;
                let first = self.state.is_first(channel);
                let channel = self.model.channels.get(channel);
                channel.map(|one| if first { &one.list_of_first } else { &one.list })
            }
            (ComTable::Axis, place) => {
                let place = usize::from(place).checked_sub(1);
                place.and_then(|place| self.model.axis_lists.get(place))
            }
        };
        list.map(Descriptors::as_ref).ok_or(AdsError::INVALID_GROUP)
    }

    /// Owner and index of the object at an address.
    ///
    /// For a platform axis, both forms are accepted: the axis either in the group or in the offset
    /// (E-04).
    fn object(&self, (com, offset): (ComGroup, IndexOffset)) -> Result<(Owner, usize), AdsError> {
        let split = offset.axis_and_element(AxisStride::X10000);
        let (axis, element) = split.map_err(|_| AdsError::INVALID_OFFSET)?;
        let at = to_usize(axis).checked_sub(1);
        let (owner, index) = match (com.table, com.instance) {
            (ComTable::Channel, 0) => {
                (Owner::Platform, self.model.platform.at(element).filter(|_| at.is_none()))
            }
            (ComTable::Channel, number) => {
                let channel = self.state.channel(self.model, com.addressing, number)?;
                let model = self.model.channels.get(channel).ok_or(AdsError::INVALID_GROUP)?;
                match (at, model.objects.at(element)) {
                    (Some(place), _) => {
                        let there = place < model.places.len();
                        let index = self.model.channel_axis.at(element).filter(|_| there);
                        (Owner::Place { channel, place }, index)
                    }
                    (None, Some(index)) => (Owner::Channel(channel), Some(index)),
                    (None, None) => {
                        let first = self.state.is_first(channel);
                        (Owner::Platform, self.model.platform.at(element).filter(|_| first))
                    }
                }
            }
            (ComTable::Axis, instance) => {
                let of_group = usize::from(instance).checked_sub(1);
                let axis = match (of_group, at) {
                    (Some(axis), None) if axis < self.model.axes.len() => axis,
                    (Some(_), None) => return Err(AdsError::INVALID_GROUP),
                    (None, Some(axis)) if axis < self.model.axes.len() => axis,
                    _ => return Err(AdsError::INVALID_OFFSET),
                };
                (Owner::Axis(axis), self.model.platform_axis.at(element))
            }
        };
        Ok((owner, index.ok_or(AdsError::INVALID_OFFSET)?))
    }
}
