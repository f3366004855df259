//! What the answers of a session say of the things that a file names.

use std::collections::{BTreeMap, BTreeSet};

use ads_cnc::address::{Channel, ChannelAxis, IndexGroup, IndexOffset};
use ads_cnc::operation::{Call, ObjectList, Reply, Request};
use ads_cnc::{CncStr, CncString, DescriptorsRef, Handle};

use super::{Allowed, Entry};

/// Handles and places of objects that a session came to know; of names that the file has only.
#[derive(Clone, Debug, Default)]
pub(super) struct Learnt {
    handles: BTreeMap<(Channel, u32), BTreeSet<Name>>,
    lists: BTreeMap<IndexGroup, Objects>,
}

/// A variable's name; with the axis if it was asked for over the axis interface.
type Name = (Option<ChannelAxis>, CncString);

/// What is known of a list of objects.
#[derive(Clone, Debug, Default)]
struct Objects {
    count: Option<u32>,
    seen: BTreeSet<u32>,
    places: BTreeMap<CncString, BTreeSet<(IndexGroup, IndexOffset)>>,
}

impl Learnt {
    /// The names by which a handle was asked for.
    pub(super) fn names(&self, channel: Channel, handle: Handle) -> impl Iterator<Item = &Name> {
        self.handles.get(&(channel, handle.0)).into_iter().flatten()
    }

    /// Where the object of this name is. Only a list that was seen whole tells that there is no
    /// other of the same name.
    pub(super) fn place(
        &self,
        list: ObjectList,
        name: &CncString,
    ) -> Option<(IndexGroup, IndexOffset)> {
        let objects = self.lists.get(&list.index_group())?;
        let seen = u32::try_from(objects.seen.len()).ok()?;
        let mut places = objects.places.get(name)?.iter();
        match (objects.count == Some(seen), places.next(), places.next()) {
            (true, Some(place), None) => Some(*place),
            _ => None,
        }
    }

    pub(super) fn learn(&mut self, allowed: &Allowed, call: &Call<'_>, reply: &[u8]) {
        let Ok(request) = call.dispatch() else { return };
        let Ok(reply) = request.decode_reply(reply) else { return };
        match (request, reply) {
            (Request::HandleByName(op), Reply::Handle(handle)) => {
                self.handle(allowed, op.channel, None, op.name.text(), handle);
            }
            (Request::AxisHandleByName(op), Reply::Handle(handle)) => {
                self.handle(allowed, op.channel, Some(op.axis), op.name.text(), handle);
            }
            (Request::CountObjects(op), Reply::ObjectCount(count)) => {
                if let Some(objects) = self.objects(allowed, op.list) {
                    // Another list than before, if it has another length.
                    if objects.count != Some(count.0) {
                        *objects = Objects { count: Some(count.0), ..Objects::default() };
                    }
                }
            }
            (Request::ReadDescriptors(op), Reply::Descriptors(all)) => {
                if let Some(objects) = self.objects(allowed, op.list()) {
                    objects.learn(op.first(), &all);
                }
            }
            _ => {}
        }
    }

    fn handle(
        &mut self,
        allowed: &Allowed,
        channel: Channel,
        axis: Option<ChannelAxis>,
        name: CncStr<'_>,
        handle: Handle,
    ) {
        // A handle reaches all elements, so the entry has to as well: an index in its name does not.
        let whole = |entry: &Entry| match entry {
            Entry::Variable { name, .. } => !name.as_bytes().ends_with(b"]"),
            _ => true,
        };
        let mut entries = allowed.entries.iter().filter(|entry| whole(entry));
        let is_named = entries.any(|entry| entry.allows_variable(channel, axis, name));
        if is_named {
            let names = self.handles.entry((channel, handle.0)).or_default();
            names.insert((axis, name.into()));
        }
    }

    /// The list, if the file has an object of it by name.
    fn objects(&mut self, allowed: &Allowed, asked: ObjectList) -> Option<&mut Objects> {
        let is_named = allowed
            .entries
            .iter()
            .any(|entry| matches!(entry, Entry::Object { list, .. } if list.list() == asked));
        is_named.then(|| self.lists.entry(asked.index_group()).or_default())
    }
}

impl Objects {
    fn learn(&mut self, first: u32, all: &DescriptorsRef<'_>) {
        for (index, object) in (first..).zip(all.iter()) {
            self.seen.insert(index);
            let place = (object.index_group(), object.index_offset());
            self.places.entry(object.name().into()).or_default().insert(place);
        }
    }
}
