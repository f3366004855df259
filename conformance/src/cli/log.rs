//! Logging to stderr.

use std::io;

use tracing_subscriber::filter::Targets;
use tracing_subscriber::fmt;
use tracing_subscriber::layer::SubscriberExt as _;
use tracing_subscriber::util::SubscriberInitExt as _;

/// Parses the filter of --log.
pub(super) fn filter(text: &str) -> Result<Targets, String> {
    let invalid = || {
        "expected a level (off, error, warn, info, debug, trace) or a list of module=level, \
         as ads_cnc_conformance::simulator=debug"
            .to_owned()
    };
    // Check the words here, because the parser of the filter accepts any word as the name of a
    // module.
    let is_level = |word: &str| word.parse::<tracing::level_filters::LevelFilter>().is_ok();
    let is_known = |word: &str| {
        is_level(word) || word.split_once('=').is_some_and(|(_, level)| is_level(level))
    };
    if !text.split(',').all(is_known) {
        return Err(invalid());
    }
    text.parse().map_err(|_| invalid())
}

/// Starts logging to stderr.
pub(super) fn to_stderr(filter: Targets) {
    let lines = fmt::layer().with_writer(io::stderr).with_ansi(false);
    // This fails only if a logger is already set; the tool sets a logger at most once.
    let _already_set = tracing_subscriber::registry().with(lines).with(filter).try_init();
}
