//! Parses texts of a model file.

use std::time::Duration;

use ads_cnc::CncString;
use toml::Spanned;

use crate::simulator::model::ModelError;
use crate::simulator::model::error::Source;
use crate::text::duration;

/// Encodes a text in CP1252.
pub(super) fn text(source: Source<'_>, text: &Spanned<String>) -> Result<CncString, ModelError> {
    text.get_ref().parse().map_err(|error| source.error(&text.span(), error))
}

/// Parses a number with a unit of time.
pub(super) fn time(source: Source<'_>, given: &Spanned<String>) -> Result<Duration, ModelError> {
    duration(given.get_ref()).map_err(|why| source.error(&given.span(), why))
}
