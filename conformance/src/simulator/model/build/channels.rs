//! Builds and checks channels.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use ads_cnc::{Descriptors, Handle};

use super::super::document::ChannelTable;
use super::super::error::Source;
use super::super::item::Objects;
use super::super::variable::{VariableRef, Variables, handle_at};
use super::super::{AxisModel, ChannelModel, ModelError};
use super::variables::{self, handle_span};
use super::{items, parameters, programs};
use crate::edition::{CncVersion, Feature};

/// Maximum number of platform axes, of spindles and of places of a channel. The index of a further
/// axis or place would not fit into index groups and handles.
pub(super) const INSTANCES_MAX: usize = 255;

/// The parts of the model that are needed to build and check channels.
pub(super) struct Channels<'a> {
    pub(super) source: Source<'a>,
    pub(super) axes: &'a [AxisModel],
    pub(super) platform: &'a Objects,
    pub(super) axis_variables: &'a Variables,
    pub(super) version: Option<CncVersion>,
}

impl Channels<'_> {
    pub(super) fn build(&self, tables: &[ChannelTable]) -> Result<Vec<ChannelModel>, ModelError> {
        let mut channels = BTreeMap::new();
        let mut taken = BTreeSet::new();
        for table in tables {
            let number = self.number(table)?;
            // Check this before handles are derived from the number.
            if channels.contains_key(&number) {
                let why = format!("channel {number} is configured twice");
                return Err(self.source.error(&table.number.span(), why));
            }
            channels.insert(number, self.channel(number, table, &mut taken)?);
        }
        if channels.is_empty() {
            return Err(self.source.error(&(0..0), "expected at least one channel"));
        }
        Ok(channels.into_values().collect())
    }

    fn number(&self, table: &ChannelTable) -> Result<u8, ModelError> {
        let number = *table.number.get_ref();
        u8::try_from(number).ok().filter(|&number| number > 0).ok_or_else(|| {
            let why = format!("expected a channel number from 1 to 255, found {number}");
            self.source.error(&table.number.span(), why)
        })
    }

    fn channel(
        &self,
        number: u8,
        table: &ChannelTable,
        taken: &mut BTreeSet<usize>,
    ) -> Result<ChannelModel, ModelError> {
        let (source, span) = (self.source, table.number.span());
        let places = self.places(table, taken)?;
        let objects = items::objects(source, &table.objects, None, 1)?;
        for (row, &element) in table.objects.iter().zip(&objects.elements) {
            // The group of the first channel also contains the platform's objects (COM-4).
            if self.platform.at(element).is_some() {
                let why = format!("an object of the platform has the offset {element:#x}");
                return Err(source.error(&row.offset.span(), why));
            }
            if let Some(values) = &row.values {
                let why = "values is only for items with several instances; expected value";
                return Err(source.error(&values.span(), why));
            }
        }
        let service =
            self.version.is_none_or(|version| version.has(Feature::ServiceInterface).available);
        let variables = variables::of_channel(source, number, &table.variables, service)?;
        let mut by_handle = HashMap::new();
        // A handle belongs to its channel, so that another channel may have the same handle.
        let mut take = |handle: Handle, at: VariableRef| by_handle.insert(handle.0, at).is_none();
        for (place, variable) in variables.list.iter().enumerate() {
            let free =
                variable.handle.is_none_or(|handle| take(handle, VariableRef::Channel(place)));
            if !free {
                let span = table.variables.get(place).map_or(span.clone(), handle_span);
                let handle = variable.handle.map_or(0, |handle| handle.0);
                let why = format!("{} has the same handle {handle:#x} as another", variable.name);
                return Err(source.error(&span, why));
            }
        }
        for (variable, of) in self.axis_variables.list.iter().enumerate() {
            for (place, at) in (0..places.len()).zip(1_u8..) {
                let handle = of.handle.map(|handle| handle_at(handle, number, at));
                let free =
                    handle.is_none_or(|handle| take(handle, VariableRef::Axis { place, variable }));
                if !free {
                    let handle = handle.map_or(0, |handle| handle.0);
                    let why = format!(
                        "{} at place {at} has the same handle {handle:#x} as another",
                        of.name
                    );
                    return Err(source.error(&span, why));
                }
            }
        }
        let parameters = parameters::of_channel(source, &table.parameters, &objects)?;
        let program = programs::streaming(source, &table.streaming)?;
        let script = match &table.service {
            Some(table) if !service => {
                let why = "a CNC of this version has no Service Interface";
                return Err(source.error(&table.span(), why));
            }
            Some(table) => Some(programs::service(source, table.get_ref())?),
            None => None,
        };
        let of_kind = |kind: &str| {
            let named = variables.list.iter().enumerate();
            let named = named.filter(|(_, one)| one.name.as_bytes().starts_with(kind.as_bytes()));
            named.map(|(place, _)| place).collect::<Vec<_>>()
        };
        Ok(ChannelModel {
            number,
            active: table.active.unwrap_or(true),
            places,
            external: of_kind("V.E."),
            global: of_kind("V.G."),
            objects,
            variables,
            by_handle,
            parameters,
            program,
            script,
            list: Descriptors::default(),
            list_of_first: Descriptors::default(),
        })
    }

    /// The axis at each place (axis index) of a channel, as its index in the model; `None` for a
    /// place without an axis.
    fn places(
        &self,
        table: &ChannelTable,
        taken: &mut BTreeSet<usize>,
    ) -> Result<Vec<Option<usize>>, ModelError> {
        let (mut places, mut names) = (Vec::new(), BTreeSet::new());
        for at in &table.places {
            let (number, error) =
                (*at.get_ref(), |why: String| Err(self.source.error(&at.span(), why)));
            if places.len() >= INSTANCES_MAX {
                return error("expected at most 255 places".to_owned());
            }
            if number == 0 {
                places.push(None);
                continue;
            }
            let axis = self.axes.iter().enumerate().find(|(_, axis)| axis.number == number);
            let Some((axis, model)) = axis else {
                return error(format!("no axis has the logical number {number}"));
            };
            if !taken.insert(axis) {
                return error(format!(
                    "the axis with the logical number {number} already has another place"
                ));
            }
            if !names.insert(&model.name) {
                return error(format!("two axes of a channel are named {}", model.name));
            }
            places.push(Some(axis));
        }
        Ok(places)
    }
}
