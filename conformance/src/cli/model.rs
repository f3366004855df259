//! Options that choose the data model, the edition and the version of the simulated CNC.

use std::path::PathBuf;

use super::target::TargetArgs;
use crate::edition::{CncVersion, Edition};
use crate::session::{Session, ToolError};
use crate::simulator::{Cnc, DEFAULT_MODEL, Model, ModelError, Settings};

/// The heading of these options in the help.
const MODEL: &str = "Simulated CNC";

/// Options that choose the data model, the edition and the version.
#[derive(Debug, clap::Args)]
pub(super) struct ModelArgs {
    /// Read the data model from this file [default: the built-in model].
    #[arg(long, help_heading = MODEL, value_name = "FILE")]
    model: Option<PathBuf>,

    /// Edition of the manual that the CNC follows: en-1.05 or de-1.051 [default: as in the model].
    #[arg(long, help_heading = MODEL, value_name = "EDITION", value_parser = Edition::by_name)]
    edition: Option<Edition>,

    /// Version that the CNC reports, such as V4.29.0 [default: as in the model].
    #[arg(long, help_heading = MODEL, value_name = "VERSION", value_parser = cnc_version)]
    cnc_version: Option<CncVersion>,
}

fn cnc_version(text: &str) -> Result<CncVersion, String> {
    CncVersion::new(text).map_err(|_| "expected three or four numbers, such as V4.29.0".to_owned())
}

impl ModelArgs {
    /// Connects to the device, or starts the simulated CNC with this model and connects to it. A
    /// dry run does not connect.
    ///
    /// # Errors
    /// Those of [`TargetArgs::open_or`]; wrong usage if the options are given for a device.
    pub(super) fn open(&self, target: &TargetArgs) -> Result<Session, ToolError> {
        let is_given = self.model.is_some() || self.edition.is_some() || self.cnc_version.is_some();
        if is_given && target.is_device() {
            let why =
                "--model, --edition and --cnc-version apply to the simulated CNC, not to --target";
            return Err(ToolError::Usage(why.to_owned()));
        }
        target.open_or(|| self.cnc().map_err(|error| ToolError::Usage(error.to_string())))
    }

    pub(super) fn cnc(&self) -> Result<Cnc, ModelError> {
        let settings = Settings { edition: self.edition, version: self.cnc_version };
        let model = match &self.model {
            Some(file) => Model::load(file, settings),
            None => Model::with_settings(DEFAULT_MODEL, "the default model", settings),
        };
        model.map(Cnc::new)
    }
}
