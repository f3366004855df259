//! Records the names of handles and object addresses: those in replies, and those in requests whose
//! replies contain a handle.

use std::collections::{BTreeMap, BTreeSet};

use ads_cnc::address::{Addressing, Channel, ChannelAxis, Group, IndexGroup, IndexOffset};
use ads_cnc::operation::{Call, ObjectList, Operation as _, Reply, Request};
use ads_cnc::{CncStr, CncString, DescriptorsRef, Handle, VariablePath};

use super::rejection::OBSERVATIONS_MAX;
use super::{Allowed, Ambiguity, Entry};

/// The names for which replies contained handles and object addresses. They decide which writes by
/// a handle, and which writes to COM objects, the gate allows.
#[derive(Clone, Debug, Default)]
pub(super) struct Observed {
    /// The names of each handle, by channel and handle. A channel by rank and the same channel by
    /// number are different keys.
    handles: BTreeMap<(Channel, u32), HandleNames>,
    /// The handle that replies contained for each variable in the file; `None` for several handles.
    variables: BTreeMap<(Channel, CncString), Option<u32>>,
    /// The recorded part of each list from which the file allows an object by its name.
    lists: BTreeMap<IndexGroup, ObservedObjects>,
    /// For each object address: the first name that a list contained, and the first different name,
    /// if any.
    contents: BTreeMap<(IndexGroup, IndexOffset), (CncString, Option<CncString>)>,
    kept: usize,
    full: bool,
}

/// The names for which replies contained a handle.
#[derive(Clone, Debug, Default)]
struct HandleNames {
    /// The names that are in the file.
    allowed: BTreeMap<CncString, Sources>,
    /// The first axis and name for which a reply of the axis interface contained the handle.
    of_axis: Option<(ChannelAxis, CncString)>,
    /// The name that was recorded first: one that is not in the file, or one in a request to the
    /// axis interface whose axis or name is not that of `of_axis`.
    foreign: Option<CncString>,
}

/// Which kinds of replies contained the handle for a name.
#[derive(Clone, Copy, Debug, Default)]
struct Sources {
    handle_by_name: bool,
    description: bool,
}

impl Sources {
    const HANDLE_BY_NAME: Self = Self { handle_by_name: true, description: false };
    const DESCRIPTION: Self = Self { handle_by_name: false, description: true };
}

/// The part of a list of objects that has been recorded.
#[derive(Clone, Debug, Default)]
struct ObservedObjects {
    count: Option<u32>,
    seen: BTreeSet<u32>,
    addresses: BTreeMap<CncString, BTreeSet<(IndexGroup, IndexOffset)>>,
}

impl Observed {
    /// Discards the records that allow writes; keeps those that forbid writes, such as the names
    /// that are not in the file.
    pub(super) fn forget(&mut self) {
        // `None` means that the variable has several handles: writes by them remain forbidden.
        self.variables.retain(|_, handle| handle.is_none());
        self.lists.clear();
        self.handles.values_mut().for_each(|named| named.allowed.clear());
        self.handles.retain(|_, named| named.foreign.is_some() || named.of_axis.is_some());
        let kept = [self.handles.len(), self.contents.len(), self.variables.len()];
        self.kept = kept.into_iter().fold(0, usize::saturating_add);
    }

    /// Whether a name of this handle is recorded, not counting the first one of the axis interface;
    /// true for every handle after the limit was exceeded.
    pub(super) fn knows_handle(&self, channel: Channel, handle: Handle) -> bool {
        let has_names = |named: &HandleNames| !named.allowed.is_empty() || named.foreign.is_some();
        self.full || self.handles.get(&(channel, handle.0)).is_some_and(has_names)
    }

    /// Whether a handle belongs only to variables in the file; false if no reply contained the
    /// handle for such a variable.
    ///
    /// # Errors
    /// The reason why the handle may also belong to another variable.
    pub(super) fn is_variable(&self, channel: Channel, handle: Handle) -> Result<bool, Ambiguity> {
        let Some(named) = self.handles.get(&(channel, handle.0)) else { return Ok(false) };
        let Some(name) = named.allowed.keys().next() else { return Ok(false) };
        if self.full {
            return Err(Ambiguity::TooMuch);
        }
        if let Some(foreign) = &named.foreign {
            return Err(Ambiguity::Shared(foreign.clone()));
        }
        // In requests to the axis interface, the name of the variable does not contain the axis.
        let without_axis = |name: &CncString| {
            VariablePath::from_text(name.as_cnc_str()).and_then(|path| path.without_axis()).ok()
        };
        if let Some((_, of_axis)) = &named.of_axis
            && !named.allowed.keys().any(|name| without_axis(name).as_ref() == Some(of_axis))
        {
            return Err(Ambiguity::Shared(of_axis.clone()));
        }
        let several = |name: &&CncString| {
            self.variables.get(&(channel, (*name).clone())) != Some(&Some(handle.0))
        };
        if let Some(name) = named.allowed.keys().find(several) {
            return Err(Ambiguity::Several(name.clone()));
        }
        if named.allowed.values().any(|from| from.handle_by_name && from.description) {
            Ok(true)
        } else {
            Err(Ambiguity::Unconfirmed(name.clone()))
        }
    }

    /// Whether the only object with a name in a list has this address. False until the list was
    /// read completely, because an unread object may have the same name.
    ///
    /// # Errors
    /// The reason why the write may affect another object.
    pub(super) fn is_object(
        &self,
        list: ObjectList,
        name: &CncString,
        address: (IndexGroup, IndexOffset),
    ) -> Result<bool, Ambiguity> {
        let Some(objects) = self.lists.get(&list.index_group()) else { return Ok(false) };
        let addresses = objects.addresses.get(name);
        let Some(addresses) = addresses.filter(|all| all.contains(&address)) else {
            return Ok(false);
        };
        if self.full {
            return Err(Ambiguity::TooMuch);
        }
        if !objects.is_whole() {
            return Ok(false);
        }
        if addresses.len() > 1 {
            return Err(Ambiguity::Several(name.clone()));
        }
        if !is_of(list, address.0) {
            return Err(Ambiguity::Elsewhere(name.clone()));
        }
        match self.contents.get(&address) {
            Some((one, None)) if one == name => Ok(true),
            Some((one, other)) => {
                let other = other.as_ref().filter(|_| one == name).unwrap_or(one);
                Err(Ambiguity::Shared(other.clone()))
            }
            None => Ok(false),
        }
    }

    /// Checks that replies contained at most one name for an address in the file.
    ///
    /// # Errors
    /// [`Ambiguity::Shared`] with the second name.
    pub(super) fn has_one_name(&self, address: (IndexGroup, IndexOffset)) -> Result<(), Ambiguity> {
        match self.contents.get(&address) {
            Some((_, Some(other))) => Err(Ambiguity::Shared(other.clone())),
            _ => Ok(()),
        }
    }

    pub(super) fn observe(&mut self, allowed: &Allowed, call: &Call<'_>, reply: &[u8]) {
        let Ok(request) = call.dispatch() else { return };
        let Ok(reply) = request.decode_reply(reply) else { return };
        match (request, reply) {
            (Request::HandleByName(op), Reply::Handle(handle)) => {
                let from = Sources::HANDLE_BY_NAME;
                self.handle(allowed, (op.channel, handle), op.name.text(), from);
            }
            (Request::DescribeByIndex(op), Reply::Description(variable)) => {
                let (key, from) = ((op.channel, variable.handle), Sources::DESCRIPTION);
                self.handle(allowed, key, variable.name.text(), from);
            }
            (Request::DescribeByName(op), Reply::DescriptionByName(variable)) => {
                let (key, from) = ((op.channel, variable.handle), Sources::DESCRIPTION);
                self.handle(allowed, key, op.name.text(), from);
            }
            (Request::AxisHandleByName(op), Reply::Handle(handle)) => {
                self.handle_of_axis((op.channel, handle), (op.axis, op.name.text()));
            }
            (Request::CountObjects(op), Reply::ObjectCount(count))
                if is_named(allowed, op.list) =>
            {
                let objects = self.lists.entry(op.list.index_group()).or_default();
                // If the length has changed or was unknown, the recorded objects may be those of an
                // earlier list, so they are discarded.
                if objects.count != Some(count.0) {
                    *objects =
                        ObservedObjects { count: Some(count.0), ..ObservedObjects::default() };
                }
            }
            (Request::ReadDescriptors(op), Reply::Descriptors(all)) => {
                self.objects(allowed, op.list(), op.first(), &all);
            }
            _ => {}
        }
    }

    /// Counts a new record; returns whether the number of records is within `OBSERVATIONS_MAX`.
    fn has_room(&mut self) -> bool {
        self.full |= self.kept >= OBSERVATIONS_MAX;
        self.kept = self.kept.saturating_add(1);
        !self.full
    }

    /// The names of a handle, to which the caller adds a name; `None` if the handle is new and the
    /// limit is exceeded.
    fn named(&mut self, (channel, handle): (Channel, Handle)) -> Option<&mut HandleNames> {
        let key = (channel, handle.0);
        let is_new = !self.handles.contains_key(&key);
        if is_new && !self.has_room() {
            return None;
        }
        Some(self.handles.entry(key).or_default())
    }

    fn handle(
        &mut self,
        allowed: &Allowed,
        (channel, handle): (Channel, Handle),
        name: CncStr<'_>,
        from: Sources,
    ) {
        // A handle gives access to all elements of a variable, so an entry for one element does not
        // allow writes by the handle.
        let whole = |entry: &Entry| match entry {
            Entry::Variable { name, .. } => !name.as_bytes().ends_with(b"]"),
            _ => true,
        };
        let mut entries = allowed.entries.iter().filter(|entry| whole(entry));
        let is_allowed = entries.any(|entry| entry.allows_variable(channel, None, name));
        let text = CncString::from(name);
        if !is_allowed {
            if let Some(named) = self.named((channel, handle)) {
                named.foreign.get_or_insert(text);
            }
            return;
        }
        let variable = (channel, text.clone());
        if !self.variables.contains_key(&variable) && !self.has_room() {
            return;
        }
        let known = self.variables.entry(variable).or_insert(Some(handle.0));
        *known = known.filter(|known| *known == handle.0);
        if let Some(named) = self.named((channel, handle)) {
            let sources = named.allowed.entry(text).or_default();
            sources.handle_by_name |= from.handle_by_name;
            sources.description |= from.description;
        }
    }

    fn handle_of_axis(&mut self, key: (Channel, Handle), (axis, name): (ChannelAxis, CncStr<'_>)) {
        let asked = (axis, CncString::from(name));
        let Some(named) = self.named(key) else { return };
        let known = named.of_axis.get_or_insert_with(|| asked.clone());
        // Record that the handle belongs to two axes, or to two names of the axis interface: writes
        // by this handle are not allowed.
        if *known != asked {
            named.foreign.get_or_insert(asked.1);
        }
    }

    fn objects(
        &mut self,
        allowed: &Allowed,
        list: ObjectList,
        first: u32,
        all: &DescriptorsRef<'_>,
    ) {
        let is_of_list = |entry: &Entry, name: &CncString| matches!(entry, Entry::Object { list: of, name: one } if of.list() == list && one == name);
        // The index is recorded, because a CNC may return descriptors for indices after the last
        // one.
        for (object, index) in all.iter().zip(first..=u32::MAX) {
            let address = (object.index_group(), object.index_offset());
            let name = CncString::from(object.name());
            let is_new = !self.contents.contains_key(&address);
            if is_new && !self.has_room() {
                return;
            }
            let (one, other) = self.contents.entry(address).or_insert_with(|| (name.clone(), None));
            if *one != name {
                other.get_or_insert_with(|| name.clone());
            }
            if !is_named(allowed, list) {
                continue;
            }
            let group = list.index_group();
            let known = self.lists.get(&group).is_some_and(|list| list.seen.contains(&index));
            if !known && !self.has_room() {
                return;
            }
            let objects = self.lists.entry(group).or_default();
            objects.seen.insert(index);
            if allowed.entries.iter().any(|entry| is_of_list(entry, &name)) {
                objects.addresses.entry(name).or_default().insert(address);
            }
        }
    }
}

impl ObservedObjects {
    /// Whether all objects of the list were read.
    fn is_whole(&self) -> bool {
        let Some(count) = self.count else { return false };
        let seen = self.seen.range(1..=count.max(1)).count();
        count > 0 && u32::try_from(seen) == Ok(count)
    }
}

/// Whether the file allows an object of this list by its name.
fn is_named(allowed: &Allowed, asked: ObjectList) -> bool {
    let mut entries = allowed.entries.iter();
    entries.any(|entry| matches!(entry, Entry::Object { list, .. } if list.list() == asked))
}

/// Whether the address of a content may belong to an object of the list. The number of a channel
/// that is addressed by rank is unknown, so every channel number matches.
fn is_of(list: ObjectList, group: IndexGroup) -> bool {
    let (list, Some(Group::Com(content))) = (list.parts(), group.parts()) else { return false };
    let same = list.instance == content.instance;
    list.table == content.table
        && match (list.addressing, content.addressing) {
            (Addressing::Index, Addressing::Logical) => true,
            (list, content) => list == content && same,
        }
}

impl Entry {
    /// Whether the entry allows a request that is not a query.
    ///
    /// # Errors
    /// The reason why the write may affect a value other than that of the entry.
    pub(super) fn allows(
        &self,
        request: &Request<'_>,
        observed: &Observed,
    ) -> Result<bool, Ambiguity> {
        match (self, request) {
            (Self::Object { list, name }, Request::WriteObject(op)) => {
                observed.is_object(list.list(), name, (op.index_group(), op.index_offset()))
            }
            // `is_variable` checks all names of the handle against the whole file, not only this
            // entry.
            (Self::Variable { .. } | Self::Service(_), Request::WriteByHandle(op)) => {
                observed.is_variable(op.channel, op.handle)
            }
            (_, Request::WriteByName(op)) => Ok(self.allows_variable(op.channel, None, op.name)),
            (_, Request::AxisWriteByName(op)) => {
                Ok(self.allows_variable(op.channel, Some(op.axis), op.name))
            }
            (Self::Content { group, offset }, Request::WriteObject(op)) => {
                if (op.index_group(), op.index_offset()) == (*group, *offset) {
                    observed.has_one_name((*group, *offset)).map(|()| true)
                } else {
                    Ok(false)
                }
            }
            (Self::Content { .. } | Self::Stream(_), _) => {
                Ok(Self::needed(request).as_ref() == Some(self))
            }
            _ => Ok(false),
        }
    }
}
