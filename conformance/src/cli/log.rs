//! Logging to stderr.

use std::io;

use tracing_subscriber::filter::Targets;
use tracing_subscriber::fmt;
use tracing_subscriber::layer::SubscriberExt as _;
use tracing_subscriber::util::SubscriberInitExt as _;

/// The filter of --log.
#[derive(Clone, Debug)]
pub(super) struct Filter(Targets);

impl std::str::FromStr for Filter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let invalid = || {
            "expected a level (off, error, warn, info, debug, trace) or a list of module=level, \
             as ads_cnc_conformance::simulator=debug"
                .to_owned()
        };
        // Check the words here, because the parser of the filter accepts any word as the name of a
        // module.
        let is_level = |word: &str| word.parse::<tracing::level_filters::LevelFilter>().is_ok();
        let words = text.split(',');
        let known = |word: &str| {
            is_level(word) || word.split_once('=').is_some_and(|(_, level)| is_level(level))
        };
        if !words.into_iter().all(known) {
            return Err(invalid());
        }
        text.parse().map(Self).map_err(|_| invalid())
    }
}

/// Starts logging to stderr.
pub(super) fn to_stderr(filter: Filter) {
    let lines = fmt::layer().with_writer(io::stderr).with_ansi(false);
    // This fails only if a logger is already set; the tool sets a logger at most once.
    let _already_set = tracing_subscriber::registry().with(lines).with(filter.0).try_init();
}
