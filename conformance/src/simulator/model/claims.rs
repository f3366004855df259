//! The profile (the claims) of a device with a model.

use std::collections::BTreeSet;

use super::{ContentSource, Model};
use crate::number::to_u32;
use crate::profile::Profile;

impl Model {
    /// The profile of a device with this model. It claims the active channels, the axes and the
    /// spindles of the model, and all sections of the manuals. It does not claim that the device
    /// answers the printed examples with the printed values.
    pub fn profile(&self) -> Profile {
        let active = || self.channels.iter().filter(|channel| channel.active);
        let is_absent = |number: &u8| !self.channels.iter().any(|one| one.number == *number);
        let empty = active().flat_map(|channel| {
            let places = (1_u32..).zip(&channel.places);
            let empty = places.filter(|(_, axis)| axis.is_none());
            empty.map(|(place, _)| (u32::from(channel.number), place))
        });
        let by_name_only = active().take(1).flat_map(|channel| &channel.variables.list);
        let by_name_only = by_name_only.filter(|variable| variable.handle.is_none());
        let elements = self.classes.iter();
        let elements =
            elements.flat_map(|class| class.channel.items.iter().chain(&class.axis.items));
        // A write to these contents exchanges axes; writing the old number does not always undo the
        // exchange.
        let exchange = self.channel_axis.items.iter().chain(elements);
        let exchange =
            exchange.filter(|item| item.writable && item.meaning == ContentSource::AxisNumber);
        let unwritten: BTreeSet<String> = exchange.map(|item| item.name.to_string()).collect();
        Profile {
            name: "simulated".into(),
            edition: self.edition,
            cnc_version: self.version,
            channels: active().map(|channel| channel.number.into()).collect(),
            absent_channel: (1..=u8::MAX).find(is_absent).map(u32::from),
            platform_axes: to_u32(self.axes.len()),
            spindles: Some(to_u32(self.spindles)),
            empty_places: empty.collect(),
            by_name_only: by_name_only.map(|one| one.name.to_string().into()).collect(),
            unwritten: unwritten.into_iter().map(Into::into).collect(),
            ..Profile::DEVICE
        }
    }
}
