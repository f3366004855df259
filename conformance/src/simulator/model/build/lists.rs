//! Builds the lists of COM objects with their IDs and addresses.

use std::collections::BTreeSet;

use ads_cnc::address::{
    Access, Addressing, AxisStride, ComGroup, ComTable, IndexGroup, IndexOffset,
};
use ads_cnc::{Descriptor, Descriptors, Error, WriteAccess};

use super::super::document::{Document, ObjectRow};
use super::super::error::Source;
use super::super::item::{Item, Objects};
use super::super::{ChannelModel, Model, ModelError};
use crate::number::to_u32;
use crate::text::plural;

/// Maximum number of objects in a list, so that all descriptors fit into one reply.
pub(super) const OBJECTS_MAX: usize = 780;

/// Builds all lists of a model.
pub(super) fn fill(
    source: Source<'_>,
    document: &Document,
    model: &mut Model,
) -> Result<(), ModelError> {
    let mut ids = IdAllocator::of(source, document)?;
    let unencodable = |error: Error| source.error(&(0..0), error);
    let platform = own(&model.platform, 0, Some(&document.platform.objects), &mut ids);
    let platform = platform.map_err(unencodable)?;
    let mut channels = std::mem::take(&mut model.channels);
    for channel in &mut channels {
        let mut tables = document.channel.iter();
        let table = tables.find(|table| *table.number.get_ref() == u32::from(channel.number));
        let rows = table.map(|table| table.objects.as_slice());
        let of_places = channel.places.len() * model.channel_axis.items.len();
        let count = channel.objects.items.len() + of_places + platform.len();
        if count > OBJECTS_MAX {
            let span = table.map(|table| table.number.span()).unwrap_or_default();
            let why =
                format!("{} in a list; the maximum is {OBJECTS_MAX}", plural(count, "object"));
            return Err(source.error(&span, why));
        }
        let list = of_channel(channel, &model.channel_axis, rows, &mut ids);
        let mut list: Vec<Descriptor> = list.map_err(unencodable)?;
        channel.list = list.iter().copied().collect();
        list.extend(&platform);
        channel.list_of_first = list.into_iter().collect();
    }
    model.channels = channels;
    model.platform_list = platform.into_iter().collect();
    if model.platform_axis.items.len() > OBJECTS_MAX {
        let rows = document.platform_axis.objects.get(OBJECTS_MAX);
        let span = rows.map(|row| row.name.span()).unwrap_or_default();
        return Err(
            source.error(&span, format!("expected at most {OBJECTS_MAX} objects in a list"))
        );
    }
    let axes = (1_u32..).zip(&model.axes).map(|(place, _)| {
        // The offset contains the axis, as in the manual's example; in the manual's table, the
        // group contains the axis (E-04).
        let group = content(ComTable::Axis, 0);
        of_axis(&model.platform_axis, group, place, &mut ids)
            .collect::<Result<Descriptors, Error>>()
    });
    model.axis_lists = axes.collect::<Result<_, _>>().map_err(unencodable)?;
    Ok(())
}

/// Assigns an unused ID, from 1 on, to each object without a declared ID.
struct IdAllocator {
    taken: BTreeSet<u32>,
    next: u32,
}

impl IdAllocator {
    fn of(source: Source<'_>, document: &Document) -> Result<Self, ModelError> {
        let mut taken = BTreeSet::new();
        let channels = document.channel.iter().flat_map(|channel| &channel.objects);
        for row in document.platform.objects.iter().chain(channels) {
            let Some(id) = &row.id else { continue };
            if !taken.insert(*id.get_ref()) {
                let why = format!("two objects have the ID {}", id.get_ref());
                return Err(source.error(&id.span(), why));
            }
        }
        Ok(Self { taken, next: 1 })
    }

    fn next(&mut self) -> u32 {
        while self.taken.contains(&self.next) {
            self.next = self.next.saturating_add(1);
        }
        let id = self.next;
        self.next = id.saturating_add(1);
        id
    }
}

fn descriptor(
    item: &Item,
    id: u32,
    group: IndexGroup,
    offset: IndexOffset,
) -> Result<Descriptor, Error> {
    let access = if item.writable { WriteAccess::WRITABLE } else { WriteAccess::READ_ONLY };
    Ok(Descriptor::new(&item.name.to_string(), item.type_name)?
        .with_id(id)
        .with_size(to_u32(item.initial.size))
        .with_write_access(access)
        .with_content(group, offset))
}

/// Descriptors of the objects of a channel, without those at its places; for the number 0, those of
/// the objects of the platform.
fn own(
    objects: &Objects,
    number: u8,
    rows: Option<&[ObjectRow]>,
    ids: &mut IdAllocator,
) -> Result<Vec<Descriptor>, Error> {
    let group = content(ComTable::Channel, number);
    let mut list = Vec::new();
    for (place, (item, &element)) in objects.items.iter().zip(&objects.elements).enumerate() {
        let given = rows.and_then(|rows| rows.get(place)?.id.as_ref());
        let id = given.map_or_else(|| ids.next(), |id| *id.get_ref());
        list.push(descriptor(item, id, group, IndexOffset::new(element))?);
    }
    Ok(list)
}

/// Descriptors of the objects of a channel, and then of the objects at each of its places.
fn of_channel(
    channel: &ChannelModel,
    of_places: &Objects,
    rows: Option<&[ObjectRow]>,
    ids: &mut IdAllocator,
) -> Result<Vec<Descriptor>, Error> {
    let mut list = own(&channel.objects, channel.number, rows, ids)?;
    let group = content(ComTable::Channel, channel.number);
    for (place, _) in (1_u32..).zip(&channel.places) {
        let of_place = of_axis(of_places, group, place, ids).collect::<Result<Vec<_>, _>>()?;
        list.extend(of_place);
    }
    Ok(list)
}

fn of_axis(
    objects: &Objects,
    group: IndexGroup,
    place: u32,
    ids: &mut IdAllocator,
) -> impl Iterator<Item = Result<Descriptor, Error>> {
    objects.items.iter().zip(&objects.elements).map(move |(item, &element)| {
        let offset = IndexOffset::for_axis(AxisStride::X10000, place, element)?;
        descriptor(item, ids.next(), group, offset)
    })
}

/// The index group of the contents of a channel, of the platform (instance 0), or of the platform
/// axes.
fn content(table: ComTable, instance: u8) -> IndexGroup {
    let (addressing, access) = (Addressing::Logical, Access::Element);
    ComGroup { addressing, access, table, instance }.index_group()
}
