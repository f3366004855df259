//! Reads and writes the contents of objects and elements.

use std::borrow::Cow;

use ads_cnc::address::Class;
use ads_cnc::ads::AdsError;

use super::model::{ContentSource, Item, Model};
use super::owner::Owner;
use super::state::CncState;

/// The objects or elements of an owner.
pub(super) fn items(model: &Model, owner: Owner) -> &[Item] {
    let items = match owner {
        Owner::Platform => Some(&model.platform.items),
        Owner::Channel(channel) => {
            model.channels.get(channel).map(|channel| &channel.objects.items)
        }
        Owner::Axis(_) => Some(&model.platform_axis.items),
        Owner::Place { .. } => Some(&model.channel_axis.items),
        Owner::ClassChannel(class, _) => model.class(class).map(|class| &class.channel.items),
        Owner::ClassAxis(class, _) | Owner::ClassPlace { class, .. } => {
            model.class(class).map(|class| &class.axis.items)
        }
        Owner::Spindle(_) => model.class(Class::Spindle).map(|class| &class.channel.items),
    };
    items.map(Vec::as_slice).unwrap_or_default()
}

/// The content of an object or element; zeros for a place (axis index of a channel) without an axis
/// (SDA-11).
pub(super) fn read<'s>(
    model: &Model,
    state: &'s CncState,
    owner: Owner,
    index: usize,
) -> Result<Cow<'s, [u8]>, AdsError> {
    let item = items(model, owner).get(index).ok_or(AdsError::INVALID_OFFSET)?;
    let size = item.initial.size;
    match item.meaning {
        ContentSource::AxisNumber => {
            let number = axis(state, owner).and_then(|axis| model.axes.get(axis));
            let number = number.map_or(0, |axis| axis.number);
            Ok(u64::from(number).to_le_bytes().into_iter().take(size).collect())
        }
        ContentSource::Value => {
            let content = state.values(owner).and_then(|values| values.get(index));
            Ok(content.map_or_else(|| Cow::Owned(vec![0; size]), Cow::from))
        }
    }
}

/// Writes a content after checking its size and access.
pub(super) fn write(
    model: &Model,
    state: &mut CncState,
    owner: Owner,
    index: usize,
    bytes: &[u8],
) -> Result<(), AdsError> {
    let item = items(model, owner).get(index).ok_or(AdsError::INVALID_OFFSET)?;
    tracing::debug!(name = %item.name, ?owner, "write to a content");
    if !item.writable {
        return Err(AdsError::INVALID_ACCESS);
    }
    check_size(bytes, item.initial.size, item.is_text())?;
    match (item.meaning, owner) {
        (
            ContentSource::AxisNumber,
            Owner::Place { channel, place } | Owner::ClassPlace { channel, place, .. },
        ) => {
            let mut number = [0; 8];
            number.iter_mut().zip(bytes).for_each(|(byte, new)| *byte = *new);
            let number = u32::try_from(u64::from_le_bytes(number));
            state.exchange(model, channel, place, number.map_err(|_| AdsError::INVALID_DATA)?)
        }
        (ContentSource::AxisNumber, _) => Err(AdsError::INVALID_ACCESS),
        (ContentSource::Value, _) => {
            // At a place without an axis, only an axis number can be written.
            let changed = state.change(owner, index, |content| copy_padded(content, bytes));
            changed.ok_or(AdsError::INVALID_DATA)
        }
    }
}

/// Checks the size of a value: a text may be shorter than the content, but must contain a NUL if it
/// has the same size. Any other value must have the exact size.
pub(super) fn check_size(bytes: &[u8], size: usize, is_text: bool) -> Result<(), AdsError> {
    let ends = bytes.contains(&0) || bytes.len() < size;
    let fits = if is_text { bytes.len() <= size && ends } else { bytes.len() == size };
    if fits { Ok(()) } else { Err(AdsError::INVALID_SIZE) }
}

/// Copies bytes and fills the rest with zeros.
pub(super) fn copy_padded(place: &mut [u8], bytes: &[u8]) {
    let bytes = bytes.iter().copied().chain(std::iter::repeat(0));
    place.iter_mut().zip(bytes).for_each(|(byte, new)| *byte = new);
}

fn axis(state: &CncState, owner: Owner) -> Option<usize> {
    match owner {
        Owner::Axis(axis) | Owner::ClassAxis(_, axis) => Some(axis),
        Owner::Place { channel, place } | Owner::ClassPlace { channel, place, .. } => {
            state.axis_at(channel, place)
        }
        _ => None,
    }
}
