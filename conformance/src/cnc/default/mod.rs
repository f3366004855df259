//! The default model: what the manuals print, and something of everything else.
//!
//! Channels 1, 2 and 6, so that ranks differ from numbers; three platform axes. The printed
//! examples belong to channel 1. One of them is told in two states: `V.E.Testvar` is read whole
//! here, 123 234 345 456 567, so its element 3 is 456, not the 333 of the other example (E-27).

mod objects;
mod rows;
mod variables;

use super::{ChannelModel, Model, ModelError};

/// The default model.
///
/// # Errors
/// None: a test builds it.
pub fn default_model() -> Result<Model, ModelError> {
    let channels = [1, 2, 6].map(|number| {
        Ok(ChannelModel {
            number,
            active: true,
            objects: objects::of_channel(number)?,
            variables: variables::of_channel(number)?,
            axes: ["X", "Y", "Z"].map(str::parse).into_iter().collect::<Result<_, _>>()?,
        })
    });
    let channels = channels.into_iter().collect::<Result<_, ModelError>>()?;
    let axes = (1..=3).map(objects::of_platform_axis).collect::<Result<_, _>>()?;
    Model::new(channels, objects::of_platform()?, axes)
}
