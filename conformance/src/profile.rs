//! What a target claims. What it does not claim is not applicable; what it claims must work.

use serde::Serialize;

/// The claims of a target.
#[derive(Clone, Debug, Serialize)]
pub struct Profile {
    /// The profile's name.
    pub name: &'static str,
    /// Logical numbers of the active channels, in the order of their ranks.
    pub channels: &'static [u32],
    /// A channel number that is not configured.
    pub absent_channel: Option<u32>,
    /// Platform axes, from 1.
    pub platform_axes: u32,
    /// Answers the examples the manuals print, with the values they print.
    pub printed_examples: bool,
}

impl Profile {
    /// The embedded CNC with its default model.
    pub const EMBEDDED: Self = Self {
        name: "embedded",
        channels: &[1, 2, 6],
        absent_channel: Some(5),
        platform_axes: 5,
        printed_examples: true,
    };

    /// A device of which nothing is known but that it has a first channel.
    pub const DEVICE: Self = Self {
        name: "device",
        channels: &[1],
        absent_channel: None,
        platform_axes: 0,
        printed_examples: false,
    };
}
