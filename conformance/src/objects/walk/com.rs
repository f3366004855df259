//! Objects of the COM task.

use std::collections::BTreeSet;

use ads_cnc::Descriptor;
use ads_cnc::address::{Channel, IndexGroup, IndexOffset, PlatformAxis};
use ads_cnc::operation::{ObjectList, ReadDescriptors};

use super::super::{Access, List, Object, Place};
use super::{NUMBER_MAX, OBJECTS_MAX, RANGE, Walk};
use crate::session::Trouble;
use crate::values::Type;

impl Walk<'_> {
    pub(super) fn com(&mut self, channels: &[Channel]) -> Result<(), Trouble> {
        let platform = self.list(List::Platform, ObjectList::PLATFORM, &[])?.unwrap_or_default();
        for &channel in channels {
            // The first channel lists the platform's objects once more (COM-4).
            let list = List::Channel(channel.number());
            if self.is_meant(list) {
                self.list(list, channel.into(), &platform)?;
            }
        }
        for axis in (1..=NUMBER_MAX).map_while(|place| PlatformAxis::new(place).ok()) {
            if self.list(List::Axis(axis.index()), axis.into(), &[])?.is_none() {
                break;
            }
        }
        Ok(())
    }

    /// The objects of a list but for those at known places; the places of all. None if there is no
    /// such list.
    fn list(
        &mut self,
        list: List,
        asked: ObjectList,
        known: &[(IndexGroup, IndexOffset)],
    ) -> Result<Option<Vec<(IndexGroup, IndexOffset)>>, Trouble> {
        let Some(count) = self.count_objects(asked)? else { return Ok(None) };
        let meant = self.enter(list);
        // That of the platform is asked for what it shares with the first channel's, too.
        if !meant && list != List::Platform {
            return Ok(Some(Vec::new()));
        }
        let objects = self.descriptors(list, asked, count)?;
        let known: BTreeSet<_> = known.iter().copied().collect();
        let mut places = Vec::with_capacity(objects.len());
        for object in objects {
            let place = (object.index_group(), object.index_offset());
            places.push(place);
            if meant && !known.contains(&place) && self.is_named(object.name()) {
                self.found(row(list, &object))?;
            }
        }
        Ok(Some(places))
    }

    fn descriptors(
        &mut self,
        list: List,
        asked: ObjectList,
        count: u32,
    ) -> Result<Vec<Descriptor>, Trouble> {
        let mut objects: Vec<Descriptor> = Vec::new();
        let (mut first, mut range) = (1_u32, RANGE);
        let most = count.min(OBJECTS_MAX);
        while first <= most {
            let left = most.saturating_sub(first).saturating_add(1);
            let op = ReadDescriptors::new(asked, first, range.min(left));
            let all = self.ask(&op.map_err(Trouble::Unsendable)?)?;
            let given = all.map(|all| all.iter().map(|object| object.to_owned()).collect());
            let given: Vec<Descriptor> = given.unwrap_or_default();
            match u32::try_from(given.len()) {
                Ok(len @ 1..) => first = first.saturating_add(len),
                // Who does not give several may give one.
                _ if range > 1 => range = 1,
                _ => break,
            }
            objects.extend(given);
            self.tell(list);
        }
        let given = objects.len();
        if u32::try_from(given) != Ok(count) {
            self.note(list, format_args!("{given} of {count} objects were described"));
        }
        Ok(objects)
    }
}

fn row(list: List, object: &Descriptor) -> Object {
    Object {
        list,
        name: object.name().into(),
        place: Place::Object { group: object.index_group(), offset: object.index_offset() },
        ty: Type::of_content(object.type_name(), object.size()),
        unit: None,
        access: Access::of_flag(object.write_access().is_writable()),
        handle: None,
    }
}
