//! Objects of the COM task.

use std::collections::BTreeSet;

use ads_cnc::address::{Channel, IndexGroup, IndexOffset, PlatformAxis};
use ads_cnc::operation::ObjectList;

use super::super::ValueList;
use super::{NUMBER_MAX, OBJECTS_MAX, RANGE, Walk, Walker as _};
use crate::session::ToolError;
use crate::text::plural;

type AddressSet = BTreeSet<(IndexGroup, IndexOffset)>;

impl Walk<'_> {
    pub(super) fn com(&mut self, channels: &[Channel]) -> Result<(), ToolError> {
        let none = BTreeSet::new();
        let platform = self.list(ObjectList::PLATFORM, &none)?.unwrap_or_default();
        for &channel in channels {
            // The list of the first channel repeats the platform's objects, which are not added
            // again (COM-4).
            if self.is_selected(ValueList::Channel(channel.number())) {
                self.list(channel.into(), &platform)?;
            }
        }
        for axis in (1..=NUMBER_MAX).map_while(|index| PlatformAxis::new(index).ok()) {
            if self.list(axis.into(), &none)?.is_none() {
                break;
            }
        }
        Ok(())
    }

    /// If a list is selected, adds its objects whose names are selected, except those at the
    /// addresses `known`. Returns the addresses of the objects that were read. The only list that
    /// is read without being selected is the platform's. `None` if the target does not have the
    /// list, or if it is empty.
    fn list(
        &mut self,
        objects: ObjectList,
        known: &AddressSet,
    ) -> Result<Option<AddressSet>, ToolError> {
        let Some(count) = self.count_objects(objects)? else { return Ok(None) };
        let list = ValueList::from(objects);
        let is_selected = self.enter(list);
        // The platform's list is always read, because the first channel repeats its objects.
        if !is_selected && list != ValueList::Platform {
            return Ok(Some(AddressSet::new()));
        }
        let all = self.objects_of(objects, count.min(OBJECTS_MAX), RANGE)?;
        self.found.is_cut |= count > OBJECTS_MAX;
        if u32::try_from(all.len()) != Ok(count) {
            self.note(
                list,
                format_args!("only {} listed, {} described", plural(count, "object"), all.len()),
            );
        }
        let addresses = all.iter().filter_map(|object| object.address.content()).collect();
        for object in all.into_iter().filter(|_| is_selected) {
            let is_known = object.address.content().is_some_and(|at| known.contains(&at));
            if !is_known && self.is_named(&object.name) {
                self.add(object)?;
            }
        }
        Ok(Some(addresses))
    }
}
