//! Which data model the simulated CNC has: options of `serve`.

use std::path::PathBuf;

use ads_cnc::edition::{CncVersion, Edition};

use crate::cnc::{self, Cnc, DEFAULT_MODEL, Model, ModelError, Settings};

/// Options that choose the data model.
#[derive(Debug, clap::Args)]
pub(super) struct ModelArgs {
    /// Data model to serve instead of the default one.
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,

    /// Edition of the manual that the CNC follows, whatever the model says: en-1.05 or de-1.051.
    #[arg(long, value_name = "EDITION", value_parser = cnc::edition)]
    edition: Option<Edition>,

    /// Version that the CNC claims to be, whatever the model says: V4.29.0 for one.
    #[arg(long, value_name = "VERSION")]
    cnc_version: Option<CncVersion>,
}

impl ModelArgs {
    /// The CNC with this model.
    pub(super) fn cnc(&self) -> Result<Cnc, ModelError> {
        let settings = Settings { edition: self.edition, version: self.cnc_version };
        let model = match &self.model {
            Some(file) => Model::load(file, settings),
            None => Model::with_settings(DEFAULT_MODEL, "the default model", settings),
        };
        model.map(Cnc::new)
    }
}
