//! Reads the lists of a CNC; [`objects`](super) documents the requests.

mod channels;
mod com;
mod elements;
mod variables;
mod walker;

use std::collections::HashMap;

use ads_cnc::CncString;
use ads_cnc::address::{Channel, Class, ElementAddress};
use ads_cnc::operation::{Request, Task};

use super::{ListedValue, Pattern, ReportedAccess, ValueList};
use crate::session::{Session, ToolError};
use crate::values::Type;
pub(crate) use channels::{active_channels, decoder_of, has_variables};
pub use walker::GAP;
pub(crate) use walker::{CLASSES, KINDS, Walker, decode_element_count};
use walker::{NUMBER_MAX, Requested};

/// Maximum number of descriptors that are read with one request.
pub const RANGE: u32 = 256;

/// Maximum number of values that a walk lists. Also the maximum number of objects, variables or
/// parameters that are read of one list.
pub const OBJECTS_MAX: u32 = 100_000;
/// Maximum number of bytes of the names, units and dimensions of all listed values.
pub const NAMES_MAX: usize = 8 << 20;
/// Maximum number of requests of a walk.
pub const REQUESTS_MAX: u64 = 1_000_000;
/// Maximum number of notes about lists.
const NOTES_MAX: usize = 1_000;

/// The selection of lists and objects for a walk.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The channels to walk; empty for all active channels.
    pub channels: Vec<Channel>,
    /// A pattern of the names of the lists to walk, such as "HLD channel 1"; `None` for all.
    pub lists: Option<Pattern>,
    /// A pattern of the names of the objects to list; `None` for all.
    pub names: Option<Pattern>,
    /// Whether to list variables and parameters instead of objects and elements.
    pub variables: bool,
    /// Whether to read every attribute of every element, even if an element with the same name and
    /// number was read in another instance.
    pub exact: bool,
}

#[derive(Clone, Debug, Default)]
pub struct WalkResult {
    /// The objects, in the order of their lists.
    pub objects: Vec<ListedValue>,
    /// Number of selected lists that were read. Lists of objects and instances that the target
    /// lacks are not counted.
    pub lists: u32,
    /// Number of requests sent.
    pub requests: u64,
    /// Notes, for example about objects that could not be read.
    pub notes: Vec<String>,
    /// Whether a limit or the deadline ended the walk, or a limit shortened a list; a note states
    /// this.
    pub is_cut: bool,
}

/// The progress of a walk.
#[derive(Clone, Copy, Debug)]
pub struct WalkProgress {
    /// The selected list that was begun last.
    pub list: ValueList,
    /// Number of objects that were added so far.
    pub objects: usize,
    /// Number of requests so far, including the one that is sent next.
    pub requests: u64,
}

/// Finds all selected objects. Objects that the CNC rejects are left out, with a note.
///
/// ```
/// use ads_cnc_conformance::simulator::Cnc;
/// use ads_cnc_conformance::gate::Gate;
/// use ads_cnc_conformance::objects::{Options, Pattern, walk};
/// use ads_cnc_conformance::session::Session;
///
/// let mut session = Session::simulated(Cnc::with_default_model()?, Gate::queries())?;
/// let options = Options { names: Some(Pattern::part("feedhold")), ..Options::default() };
/// let found = walk(&mut session, &options, &mut |_| {})?;
/// let lists: Vec<String> = found.objects.iter().map(|object| object.list.to_string()).collect();
/// assert_eq!(lists, ["HLD channel 1", "HLD channel 2", "HLD channel 6"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`Session::request`], except ADS errors, [`ToolError::Enough`], and AMS errors and
/// missing replies of the task GEO.
pub fn walk(
    session: &mut Session,
    options: &Options,
    watch: &mut dyn FnMut(WalkProgress),
) -> Result<WalkResult, ToolError> {
    let mut walk = Walk::new(session, options, watch);
    match walk.all() {
        Ok(()) => {}
        Err(ToolError::Enough(why)) => {
            walk.found.notes.push(format!("the list is incomplete: {why}"));
            walk.found.is_cut = true;
        }
        Err(error) => return Err(error),
    }
    Ok(walk.found)
}

/// The active channels of the CNC.
pub(crate) fn channels_of(session: &mut Session) -> Result<Vec<Channel>, ToolError> {
    Walk::new(session, &Options::default(), &mut |_| {}).channels()
}

/// Returns those of `channels` that the CNC does not have, each once, in ascending order.
pub(crate) fn absent_of(
    session: &mut Session,
    channels: &[Channel],
) -> Result<Vec<Channel>, ToolError> {
    let options = Options { channels: channels.to_vec(), ..Options::default() };
    let there = Walk::new(session, &options, &mut |_| {}).channels_given()?;
    let mut absent = channels.to_vec();
    absent.retain(|channel| !there.contains(channel));
    absent.sort_unstable();
    absent.dedup();
    Ok(absent)
}

struct Walk<'w> {
    session: &'w mut Session,
    options: &'w Options,
    watch: &'w mut dyn FnMut(WalkProgress),
    found: WalkResult,
    /// The selected list that was begun last, if any.
    list: Option<ValueList>,
    /// Number of bytes of all names, units and dimensions so far.
    names: usize,
    /// The first elements of the instances found so far.
    instances: Vec<ElementAddress>,
    /// The task that serves the current class: SDA or GEO.
    task: Task,
    /// The error after which the task GEO is no longer queried; `Ok` until such an error occurs.
    geo: Result<(), ToolError>,
    /// The attributes that were read. The key is the class, whether the instance is that of an
    /// axis, and the element number. Elements with the same key and name are assumed to have the
    /// same attributes.
    alike: HashMap<(Class, bool, u32), Vec<Attributes>>,
}

/// The attributes of an element.
#[derive(Clone, Debug)]
struct Attributes {
    name: CncString,
    ty: Type,
    unit: Option<CncString>,
    access: ReportedAccess,
}

impl<'w> Walk<'w> {
    fn new(
        session: &'w mut Session,
        options: &'w Options,
        watch: &'w mut dyn FnMut(WalkProgress),
    ) -> Self {
        let (found, instances, alike) = (WalkResult::default(), Vec::new(), HashMap::new());
        let (list, names, task, geo) = (None, 0, Task::Sda, Ok(()));
        Self { session, options, watch, found, list, names, instances, alike, task, geo }
    }

    fn all(&mut self) -> Result<(), ToolError> {
        let channels = self.channels()?;
        if self.options.variables {
            return self.variables(&channels);
        }
        self.com(&channels)?;
        self.elements(&channels)
    }

    fn note(&mut self, list: ValueList, what: impl std::fmt::Display) {
        match self.found.notes.len() {
            0..NOTES_MAX => self.found.notes.push(format!("{list}: {what}")),
            NOTES_MAX => self.found.notes.push("more notes are not shown".to_owned()),
            _ => {}
        }
    }

    /// Adds a note if the CNC has rejected requests for entries of a list, and another note if not
    /// all of the `count` entries were requested. The walk is incomplete if the limit `most` is
    /// smaller than `count`.
    fn note_missing(&mut self, list: ValueList, count: u32, most: u32, requested: Requested) {
        let Requested { sent, rejected } = requested;
        self.found.is_cut |= count > most;
        if rejected > 0 {
            self.note(list, format_args!("the CNC rejects the requests for {rejected} of {sent}"));
        }
        if sent < count {
            self.note(list, format_args!("only the first {sent} of {count} were requested"));
        }
    }

    fn is_selected(&self, list: ValueList) -> bool {
        self.options.lists.as_ref().is_none_or(|lists| lists.matches(&list.to_string()))
    }

    /// Begins a list if the options select it. Returns whether they do.
    fn enter(&mut self, list: ValueList) -> bool {
        let is_selected = self.is_selected(list);
        if is_selected {
            self.found.lists = self.found.lists.saturating_add(1);
            self.list = Some(list);
        }
        is_selected
    }

    fn is_named(&self, name: impl std::fmt::Display) -> bool {
        self.options.names.as_ref().is_none_or(|names| names.matches(&name.to_string()))
    }

    fn add(&mut self, object: ListedValue) -> Result<(), ToolError> {
        if usize::try_from(OBJECTS_MAX).is_ok_and(|most| self.found.objects.len() >= most) {
            return Err(ToolError::Enough(format!("the limit is {OBJECTS_MAX} objects")));
        }
        let unit = object.unit.as_ref().map_or(0, |unit| unit.as_bytes().len());
        let names = object.name.as_bytes().len().saturating_add(unit);
        let dimensions = size_of_val(object.ty.dimensions.as_slice());
        self.names = self.names.saturating_add(names).saturating_add(dimensions);
        if self.names > NAMES_MAX {
            let why = format!("the limit is {} MiB of names and dimensions", NAMES_MAX >> 20);
            return Err(ToolError::Enough(why));
        }
        self.found.objects.push(object);
        Ok(())
    }

    /// The channels that the options name and the target has; all active channels if the options
    /// name none.
    fn channels(&mut self) -> Result<Vec<Channel>, ToolError> {
        if !self.options.channels.is_empty() {
            return self.channels_given();
        }
        active_channels(self, |walk, number, has_objects| match has_objects {
            true => Ok(walk.count_objects(number)?.is_some()),
            false => walk.is_instance(decoder_of(number)),
        })
    }

    /// The channels that the options name and the target has, each once.
    fn channels_given(&mut self) -> Result<Vec<Channel>, ToolError> {
        let mut found = Vec::new();
        for &channel in &self.options.channels {
            if !found.contains(&channel)
                && (self.count_objects(channel)?.is_some()
                    || self.is_instance(decoder_of(channel))?)
            {
                found.push(channel);
            }
        }
        Ok(found)
    }
}

impl Walker for Walk<'_> {
    type Error = ToolError;

    fn request<'r>(
        &mut self,
        request: impl Into<Request<'r>>,
    ) -> Result<Option<Vec<u8>>, ToolError> {
        let (request, is_geo) = (request.into(), self.task == Task::Geo);
        if is_geo && self.geo.is_err() {
            return Ok(None);
        }
        if self.found.requests >= REQUESTS_MAX {
            return Err(ToolError::Enough(format!("the limit is {REQUESTS_MAX} requests")));
        }
        self.found.requests = self.found.requests.saturating_add(1);
        if let Some(list) = self.list {
            let (objects, requests) = (self.found.objects.len(), self.found.requests);
            (self.watch)(WalkProgress { list, objects, requests });
        }
        let task = if is_geo { Task::Geo } else { request.function().spec().task };
        match self.session.request(task, request) {
            Ok(data) => Ok(Some(data)),
            Err(ToolError::Ads { .. }) => Ok(None),
            // A CNC need not have the task GEO.
            Err(error @ (ToolError::Ams { .. } | ToolError::NoReply(_))) if is_geo => {
                self.geo = Err(error);
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }
}
