//! The configuration of the simulated CNC, which requests cannot change.
//!
//! The configuration is read from TOML. The comments of the default model, which
//! `ads-cnc serve --print-model` prints, describe the format.

#[allow(clippy::restriction)]
mod build;
mod claims;
mod configured;
mod data;
mod document;
mod error;
mod item;
mod parameter;
mod types;
mod variable;

use std::cell::Cell;
use std::fs::File;
use std::path::Path;

use ads_cnc::address::Class;

pub use configured::ConfiguredVariable;
pub(super) use data::{AxisModel, ChannelModel, class_place};
pub use data::{Model, Settings};
pub use error::ModelError;
pub(super) use item::{ClassModel, ContentSource, Item, Objects};
pub(super) use parameter::{Parameter, Times};
pub(super) use variable::{Variable, VariableRef, Variables, handle_at};

use super::program::ProgramConfig;
use crate::edition::{CncVersion, Edition};
use crate::text::{FILE_MAX, read_limited};
pub(super) use build::parameter_kind;
use error::Source;

/// The default model, as TOML: the values of the manuals' examples, and further examples.
pub const DEFAULT_MODEL: &str = include_str!("default.toml");

impl Model {
    /// The default model: [`DEFAULT_MODEL`].
    ///
    /// # Errors
    /// No error occurs: a test parses the default model.
    pub fn default_model() -> Result<Self, ModelError> {
        Self::from_toml(DEFAULT_MODEL, "the default model")
    }

    /// Parses a model from TOML; `file` is the name of the file in errors.
    ///
    /// # Errors
    /// [`ModelError`] for invalid TOML, unknown or missing keys, and invalid values, for example
    /// values that contradict each other or do not fit into the streams.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ModelError> {
        Self::with_settings(text, file, Settings::default())
    }

    /// Like [`from_toml`](Self::from_toml), with settings that override those of the file.
    ///
    /// # Errors
    /// Those of [`from_toml`](Self::from_toml).
    pub fn with_settings(text: &str, file: &str, settings: Settings) -> Result<Self, ModelError> {
        build::build(Source { file, text, memory: &Cell::new(0) }, settings)
    }

    /// Like [`with_settings`](Self::with_settings), but reads a file.
    ///
    /// # Errors
    /// Those of [`from_toml`](Self::from_toml), or if the file cannot be read, is too
    /// long or is not UTF-8.
    pub fn load(path: &Path, settings: Settings) -> Result<Self, ModelError> {
        let file = path.display().to_string();
        let bytes = File::open(path).and_then(|opened| read_limited(opened, FILE_MAX));
        let bytes = bytes.map_err(|error| ModelError::of_file(&file, error))?;
        match std::str::from_utf8(&bytes) {
            Ok(text) => Self::with_settings(text, &file, settings),
            Err(error) => Err(Source::not_text(&bytes, error.valid_up_to(), &file)),
        }
    }

    /// The edition of the manual that the CNC follows.
    pub const fn edition(&self) -> Edition {
        self.edition
    }

    /// The version of the CNC, which determines its features; with `None`, the CNC has all features
    /// of its edition.
    pub const fn version(&self) -> Option<CncVersion> {
        self.version
    }

    /// Logical numbers of all channels, including inactive ones.
    pub fn channels(&self) -> impl Iterator<Item = u8> {
        self.channels.iter().map(|channel| channel.number)
    }

    /// The streaming configuration of the channel with this logical number.
    pub fn program(&self, channel: u8) -> Option<&ProgramConfig> {
        let channel = self.channels.iter().find(|one| one.number == channel);
        channel.map(|channel| &channel.program)
    }

    /// The elements of the instances of a class.
    pub(super) fn class(&self, class: Class) -> Option<&ClassModel> {
        self.classes.get(class_place(class))
    }
}
