//! The TOML files of the tools.

use std::fmt::Debug;

use ads_cnc::operation::Function;
use ads_cnc_conformance::gate::Allowed;
use ads_cnc_conformance::judge::Waivers;
use ads_cnc_conformance::profile::{Claim, Profile, Section};
use serde_json::Value;

use crate::{Defect, Outcome};

/// The defects of a target for a TOML file: two that all these targets have, then those of this
/// target.
macro_rules! placed {
    ($($more:literal),*) => {
        &["a file is parsed differently after a comment", "the line of an error is one too low", $($more),*]
    };
}

pub(crate) const WAIVER_DEFECTS: &[&str] = placed!("a waiver is taken twice");
pub(crate) const PROFILE_DEFECTS: &[&str] = placed!(
    "a profile is shown without its last channel",
    "functions of a port that is not there are claimed"
);
pub(crate) const ALLOW_DEFECTS: &[&str] =
    placed!("an entry of a rank is shown as one of a channel");

/// Input: a file of waivers. A file that contains the same waiver twice is rejected.
pub(crate) fn waiver(data: &[u8], defect: Defect) -> Outcome {
    let Some(text) = text(data) else { return Outcome::unread() };
    let read = placed(text, LINE, defect, Waivers::from_toml, alike);
    if let Ok(waivers) = &read {
        let again = if defect.is(3) { text.replace("\"VAR-8", "\"VAR-9") } else { text.to_owned() };
        // Two waivers of the same failure are an error.
        let twice = Waivers::from_toml(&format!("{text}\n{again}"));
        assert_eq!(twice.is_err(), !waivers.is_empty(), "{text}");
    }
    Outcome::of(read.map(|waivers| format!("{waivers:?}")))
}

/// Input: a profile. An accepted profile is read again as it is printed, and claims no function of
/// a task whose port it does not list.
pub(crate) fn profile(data: &[u8], defect: Defect) -> Outcome {
    let Some(text) = text(data) else { return Outcome::unread() };
    let read = placed(text, LINE, defect, Profile::from_toml, alike);
    if let Ok(profile) = &read {
        let mut shown = shown(profile);
        if defect.is(3) && profile.channels.len() > 2 {
            let channels = serde_json::to_string(&profile.channels).expect("JSON");
            let fewer = serde_json::to_string(&profile.channels[1..]).expect("JSON");
            shown = shown.replace(&channels, &fewer);
        }
        let again = Profile::from_toml(&shown).unwrap_or_else(|error| panic!("{error}\n{shown}"));
        assert_eq!(format!("{again:?}"), format!("{profile:?}"), "{shown}");
        for &function in Function::ALL {
            let there = profile.ports.contains(&function.spec().task.port().0);
            let there = there && profile.sections.contains(&Section::of(function));
            let claims = profile.claims(function);
            let claims = if defect.is(4) && claims == Claim::No { Claim::Open } else { claims };
            assert!(there || claims == Claim::No, "{} in {profile:?}", function.spec().name);
        }
    }
    Outcome::of(read.map(|profile| format!("{profile:?}")))
}

/// Input: a file for `--allow-write`. An accepted file is read again as it is printed.
pub(crate) fn allow(data: &[u8], defect: Defect) -> Outcome {
    let Some(text) = text(data) else { return Outcome::unread() };
    let read = placed(text, LINE, defect, Allowed::from_toml, alike);
    if let Ok(allowed) = &read {
        let Allowed { target, address, malformed, expires, entries } = allowed;
        let mut shown = format!("target = \"{target}\"\nexpires = {expires}\n");
        shown.extend(address.map(|address| format!("address = \"{address}\"\n")));
        shown.push_str(&format!("malformed = {malformed}\n"));
        for entry in entries {
            let table = entry.to_string();
            let table = if defect.is(3) { table.replace("rank", "channel") } else { table };
            shown.push_str(&format!("{table}\n"));
        }
        // TOML has no dates outside the years 0 to 9999, so such an expiry cannot be parsed again.
        if expires.to_string().len() == "2026-05-04T17:30:00Z".len() {
            let again =
                Allowed::from_toml(&shown).unwrap_or_else(|error| panic!("{error}\n{shown}"));
            assert_eq!((again.target, again.expires), (*target, *expires), "{shown}");
            assert_eq!((again.address, again.malformed), (*address, *malformed), "{shown}");
            assert_eq!(&again.entries, entries, "{shown}");
        }
    }
    Outcome::of(read.map(|allowed| format!("{allowed:?}")))
}

/// Prints a profile as a file. The keys of a serialised profile have `_` where those of a file have
/// `-`.
fn shown(profile: &Profile) -> String {
    let Value::Object(all) = serde_json::to_value(profile).expect("JSON") else { panic!("a map") };
    let lines = all.iter().filter(|(_, value)| !value.is_null()).map(|(key, value)| {
        // A string in JSON is also a string in TOML, except that TOML requires an escape for
        // U+007F.
        let value = value.to_string().replace('\u{7F}', "\\u007f");
        format!("{} = {value}\n", key.replace('_', "-"))
    });
    lines.collect()
}

pub(super) fn text(data: &[u8]) -> Option<&str> {
    // A byte order mark is valid only at the beginning, and `placed` inserts lines before the text.
    std::str::from_utf8(data).ok().filter(|text| !text.starts_with('\u{FEFF}'))
}

/// Reads a file, and the same file after two additional lines. Both readings give the same value, or errors
/// whose line numbers, which follow `word`, differ by two or are both 1.
pub(super) fn placed<T, E: ToString>(
    text: &str,
    word: &str,
    defect: Defect,
    read: impl Fn(&str) -> Result<T, E>,
    same: impl Fn(&T, &T) -> bool,
) -> Result<T, String> {
    let said = |result: Result<T, E>| result.map_err(|error| error.to_string());
    let mut behind = format!("# A comment.\n\n{text}");
    if defect.is(1) {
        behind = behind.replace("2027", "2029").replace("= 1\n", "= 2\n").replace("[1, ", "[3, ");
    }
    let (one, other) = (said(read(text)), said(read(&behind)));
    let moved = if defect.is(2) && text.lines().count() > 2 { 1 } else { 2 };
    match (&one, &other) {
        (Ok(value), Ok(again)) => assert!(same(value, again), "different value: {text}"),
        (Err(error), Err(again)) => {
            let at = line(error, word).unwrap_or_else(|| panic!("no line: {error}"));
            assert!(at as usize <= text.matches('\n').count() + 1, "{error}");
            // The error for a missing key names the first line of both files.
            let first = at == 1 && line(again, word) == Some(1) && !defect.is(2);
            assert!(first || line(again, word) == Some(at + moved), "{error}\n{again}");
        }
        (one, other) => panic!("{:?} {:?}: {text}", one.as_ref().err(), other.as_ref().err()),
    }
    one
}

/// Whether two values have the same debug form.
fn alike<T: Debug>(one: &T, other: &T) -> bool {
    format!("{one:?}") == format!("{other:?}")
}

/// The word before the number of the line in an error.
const LINE: &str = "line ";

/// The line number in an error.
fn line(error: &str, word: &str) -> Option<u32> {
    let (_, rest) = error.split_once(word)?;
    let end = rest.find(|one: char| !one.is_ascii_digit()).unwrap_or(rest.len());
    rest[..end].parse().ok()
}
