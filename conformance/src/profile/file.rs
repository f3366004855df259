//! The file of `--profile`.

use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt;
use std::fs::File;
use std::hash::Hash;
use std::path::Path;
use std::time::Duration;

use ads_cnc::address::{Channel, ChannelAxis, PlatformAxis, Spindle};
use ads_cnc::ads::AmsPort;
use ads_cnc::limits::TEXT_MAX;
use ads_cnc::operation::{Function, Task};
use ads_cnc::{CncString, VariablePath};
use serde::Deserialize;
use serde::de::{Deserializer, Error as _};
use toml::Spanned;

use super::{LISTED, Profile, Section};
use crate::edition::{CncVersion, Edition};
use crate::text::{FileError, did_you_mean, toml_error};

/// A profile with a comment on each key. Its values are the defaults for a device.
pub const EXAMPLE: &str = include_str!("device.toml");

impl Profile {
    /// Reads a profile from a file.
    ///
    /// # Errors
    /// If the file cannot be read, and the errors of [`from_toml`](Self::from_toml).
    pub fn from_file(file: &Path) -> Result<Self, FileError> {
        FileError::parse(file, File::open(file), Self::from_toml)
    }

    /// Parses the text of a file. Missing keys have the values of [`DEVICE`](Self::DEVICE).
    ///
    /// ```
    /// use ads_cnc_conformance::profile::Profile;
    ///
    /// let profile = Profile::from_toml("channels = [1, 6]\nsections = [\"variables\"]")?;
    /// assert_eq!(profile.channels[..], [1, 6]);
    /// let error = Profile::from_toml("channels = [1]\nkinds = [\"V.X\"]").unwrap_err();
    /// assert!(error.to_string().contains("line 2"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Invalid TOML, an unknown key, or an invalid value, each with its line.
    pub fn from_toml(text: &str) -> Result<Self, FileError> {
        let file: ProfileFile =
            toml::from_str(text).map_err(|error| FileError::new(toml_error(&error)))?;
        let absent = file.absent_channel.as_ref().map(|absent| (*absent.get_ref(), absent.span()));
        let profile = Self::from(file);
        match absent {
            Some((number, place)) if profile.channels.contains(&number) => {
                let before = text.as_bytes().iter().take(place.start);
                let line = before.filter(|byte| **byte == b'\n').count().saturating_add(1);
                let why = format!("line {line}: channel {number} is also in `channels`");
                Err(FileError::new(why))
            }
            _ => Ok(profile),
        }
    }
}

impl Profile {
    /// Returns [`EXAMPLE`] with the ports, channels, absent channel, number of axes, number of
    /// spindles and empty axis indices of this profile.
    pub fn filled(&self) -> String {
        let places: Vec<[u32; 2]> =
            self.empty_places.iter().map(|&(channel, place)| [channel, place]).collect();
        let axes = Some(self.platform_axes).filter(|axes| *axes > 0);
        let values = [
            ("ports", Some(format!("{:?}", self.ports))),
            ("channels", Some(format!("{:?}", self.channels))),
            ("absent-channel", self.absent_channel.map(|number| number.to_string())),
            ("platform-axes", axes.map(|axes| axes.to_string())),
            ("spindles", self.spindles.map(|spindles| spindles.to_string())),
            ("empty-places", Some(format!("{places:?}"))),
        ];
        let line = |line: &str| {
            let key = line.trim_start_matches("# ").split(" = ").next().unwrap_or_default();
            let value = values.iter().find(|(name, _)| *name == key);
            match value.and_then(|(name, value)| Some((name, value.as_ref()?))) {
                Some((name, value)) => format!("{name} = {value}\n"),
                None => format!("{line}\n"),
            }
        };
        EXAMPLE.lines().map(line).collect()
    }
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
struct ProfileFile {
    name: Option<String>,
    #[serde(default, deserialize_with = "edition")]
    edition: Option<Edition>,
    #[serde(default, deserialize_with = "version")]
    cnc_version: Option<CncVersion>,
    #[serde(default, deserialize_with = "ports")]
    ports: Option<Vec<u16>>,
    #[serde(default, deserialize_with = "channels")]
    channels: Option<Vec<u32>>,
    #[serde(default, deserialize_with = "channel")]
    absent_channel: Option<Spanned<u32>>,
    #[serde(default, deserialize_with = "axes")]
    platform_axes: Option<u32>,
    #[serde(default, deserialize_with = "spindles")]
    spindles: Option<u32>,
    #[serde(default, deserialize_with = "places")]
    empty_places: Option<Vec<(u32, u32)>>,
    #[serde(default, deserialize_with = "kinds")]
    kinds: Option<Vec<String>>,
    #[serde(default, deserialize_with = "names")]
    by_name_only: Option<Vec<String>>,
    #[serde(default, deserialize_with = "texts")]
    unwritten: Option<Vec<String>>,
    sections: Option<Vec<Section>>,
    #[serde(default, deserialize_with = "functions")]
    functions: Option<Vec<String>>,
    printed_examples: Option<bool>,
    #[serde(default, deserialize_with = "timeout")]
    timeout: Option<Duration>,
}

impl From<ProfileFile> for Profile {
    fn from(file: ProfileFile) -> Self {
        let all = |texts: Vec<String>| texts.into_iter().map(Cow::Owned).collect::<Vec<_>>();
        let device = Self::DEVICE;
        Self {
            name: file.name.map_or(device.name, Cow::Owned),
            edition: file.edition.unwrap_or(device.edition),
            cnc_version: file.cnc_version,
            ports: file.ports.map_or(device.ports, Cow::Owned),
            channels: file.channels.map_or(device.channels, Cow::Owned),
            absent_channel: file.absent_channel.map(Spanned::into_inner),
            platform_axes: file.platform_axes.unwrap_or(device.platform_axes),
            spindles: file.spindles,
            empty_places: file.empty_places.map_or(device.empty_places, Cow::Owned),
            kinds: file.kinds.map_or(device.kinds, |kinds| Cow::Owned(all(kinds))),
            by_name_only: Cow::Owned(all(file.by_name_only.unwrap_or_default())),
            unwritten: Cow::Owned(all(file.unwritten.unwrap_or_default())),
            sections: file.sections.map_or(device.sections, Cow::Owned),
            functions: file.functions.map(|functions| Cow::Owned(all(functions))),
            printed_examples: file.printed_examples.unwrap_or(device.printed_examples),
            timeout: file.timeout,
        }
    }
}

/// Deserializes and checks a value. The check is part of the deserialization, so that its error
/// contains the line of the value.
fn checked<'de, D, T, U>(
    value: D,
    check: impl FnOnce(T) -> Result<U, String>,
) -> Result<Option<U>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    check(T::deserialize(value)?).map(Some).map_err(D::Error::custom)
}

/// Like [`checked`], for a list with at least one item and without duplicates. `shape` is the error
/// for a value of another type.
fn checked_list<'de, D, T>(
    value: D,
    noun: &str,
    shape: &str,
    check: impl Fn(&T) -> Result<(), String>,
) -> Result<Option<Vec<T>>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de> + Eq + Hash + fmt::Debug,
{
    let list = toml::Value::deserialize(value)?;
    let list = list.try_into::<Vec<T>>().map_err(|_| D::Error::custom(shape))?;
    if list.is_empty() {
        return Err(D::Error::custom(format!("at least one {noun} is required")));
    }
    each(list, noun, check).map(Some).map_err(D::Error::custom)
}

fn edition<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Edition>, D::Error> {
    checked(value, |name: String| Edition::by_name(&name))
}

fn version<'de, D: Deserializer<'de>>(value: D) -> Result<Option<CncVersion>, D::Error> {
    checked(value, |text: String| {
        CncVersion::new(&text).map_err(|_| format!("{text:?} is not a version such as V4.29.0"))
    })
}

fn ports<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Vec<u16>>, D::Error> {
    checked_list(value, "port", "expected a list of ports such as [551, 552, 553]", |&port| {
        match Task::from_port(AmsPort(port)) {
            Some(_) => Ok(()),
            None => Err(format!("{port} is not a port of a CNC; ports: 551, 552 and 553")),
        }
    })
}

fn is_channel(number: u32) -> Result<(), String> {
    let invalid = |_| format!("{number} is not a channel; channels are numbered from 1 to 255");
    Channel::new(number).map(drop).map_err(invalid)
}

fn channels<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Vec<u32>>, D::Error> {
    let shape = "expected a list of channel numbers such as [1, 2]";
    checked_list(value, "channel", shape, |&number| is_channel(number))
}

fn channel<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Spanned<u32>>, D::Error> {
    checked(value, |number: Spanned<u32>| is_channel(*number.get_ref()).map(|()| number))
}

fn axes<'de, D: Deserializer<'de>>(value: D) -> Result<Option<u32>, D::Error> {
    checked(value, |axes: u32| match axes {
        0 => Ok(0),
        _ => PlatformAxis::new(axes)
            .map(|_| axes)
            .map_err(|_| "a platform has at most 255 axes".to_owned()),
    })
}

fn spindles<'de, D: Deserializer<'de>>(value: D) -> Result<Option<u32>, D::Error> {
    checked(value, |spindles: u32| match spindles.checked_sub(1).map(Spindle::new) {
        Some(Err(_)) => Err("a CNC has at most 256 spindles".to_owned()),
        _ => Ok(spindles),
    })
}

fn places<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Vec<(u32, u32)>>, D::Error> {
    checked(value, |places: Vec<(u32, u32)>| {
        each(places, "place", |&(channel, place)| {
            is_channel(channel)?;
            let invalid =
                |_| format!("{place} is not an axis index; axis indices are counted from 1");
            ChannelAxis::new(place).map(drop).map_err(invalid)
        })
    })
}

fn kinds<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Vec<String>>, D::Error> {
    checked(value, |kinds: Vec<String>| {
        each(kinds, "kind", |kind| {
            if LISTED.iter().any(|known| known == kind) {
                Ok(())
            } else {
                Err(format!("{kind:?} cannot be listed; only V.G, V.E and V.A can"))
            }
        })
    })
}

fn names<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Vec<String>>, D::Error> {
    checked(value, |names: Vec<String>| {
        each(names, "name", |name| match VariablePath::new(name) {
            Ok(_) if name.chars().count() < TEXT_MAX => Ok(()),
            Ok(_) => Err(format!("a name has at most {} characters", TEXT_MAX - 1)),
            Err(error) => Err(format!("{name:?}: {error}")),
        })
    })
}

fn texts<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Vec<String>>, D::Error> {
    checked(value, |names: Vec<String>| {
        each(names, "name", |name| {
            name.parse::<CncString>().map(drop).map_err(|error| format!("{name:?}: {error}"))
        })
    })
}

fn functions<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Vec<String>>, D::Error> {
    checked(value, |names: Vec<String>| {
        each(names, "function", |name| {
            let all = || Function::ALL.iter().map(|function| function.spec().name);
            if all().any(|known| known == name) {
                Ok(())
            } else {
                let mut hint = did_you_mean(name, all());
                if hint.is_empty() {
                    hint = format!("; functions: {}", all().collect::<Vec<_>>().join(", "));
                }
                Err(format!("{name:?} is not a function{hint}"))
            }
        })
    })
}

fn timeout<'de, D: Deserializer<'de>>(value: D) -> Result<Option<Duration>, D::Error> {
    checked(value, |milliseconds: u64| match milliseconds {
        0 => Err("the time must be greater than 0".to_owned()),
        _ => Ok(Duration::from_millis(milliseconds)),
    })
}

/// Checks every item of a list, and that no item occurs twice.
fn each<T: Eq + Hash + fmt::Debug>(
    list: Vec<T>,
    noun: &str,
    check: impl Fn(&T) -> Result<(), String>,
) -> Result<Vec<T>, String> {
    list.iter().try_for_each(check)?;
    let mut seen = HashSet::new();
    match list.iter().find(|item| !seen.insert(*item)) {
        Some(item) => Err(format!("duplicate {noun} {item:?}")),
        None => Ok(list),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;

    /// [`EXAMPLE`] has the values of [`Profile::DEVICE`].
    #[test]
    fn the_example_is_the_device() {
        let profile = Profile::from_toml(EXAMPLE).unwrap();
        assert_eq!(format!("{profile:?}"), format!("{:?}", Profile::DEVICE));
        // Lines that are commented out must be valid, too.
        let is_key = |rest: &str| rest.contains(" = ") || rest.starts_with(['\"', ']']);
        let shown = |line: &'static str| {
            let rest = line.strip_prefix('#').map(str::trim_start);
            rest.filter(|rest| is_key(rest)).unwrap_or(line)
        };
        let all = EXAMPLE.lines().map(shown).collect::<Vec<_>>().join("\n");
        let profile = Profile::from_toml(&all).unwrap();
        assert_eq!((profile.absent_channel, profile.platform_axes), (Some(5), 5));
        assert_eq!(profile.spindles, Some(2));
        assert_eq!(profile.functions.map(|all| all.len()), Some(Function::ALL.len()));
        assert_eq!(profile.timeout, Some(Duration::from_secs(2)));
    }

    /// An invalid value is rejected with its line and the reason.
    #[test]
    fn an_error_has_its_line_and_a_reason() {
        for (line, why) in [
            ("edition = \"fr-1.0\"", "en-1.05 and de-1.051"),
            ("cnc-version = \"4\"", "V4.29.0"),
            ("ports = [552, 851]", "551, 552 and 553"),
            ("ports = [552, 552]", "duplicate port 552"),
            ("ports = []", "at least one port is required"),
            ("channels = []", "at least one channel is required"),
            ("channels = \"1\"", "a list of channel numbers such as [1, 2]"),
            ("channels = [1, 1]", "duplicate channel 1"),
            ("absent-channel = 1", "line 2: channel 1 is also in `channels`"),
            ("channels = [0]", "channel"),
            ("channels = [1, 256]", "channel"),
            ("absent-channel = 0", "channel"),
            ("platform-axes = 256", "255 axes"),
            ("spindles = 257", "256 spindles"),
            ("empty-places = [[1, 0]]", "axis"),
            ("empty-places = [[1]]", "expected a list of 2 items, found 1 item"),
            ("kinds = [\"V.CYC\"]", "cannot be listed"),
            ("by-name-only = [\"V.CYC.\"]", "V.CYC."),
            ("unwritten = [\"\u{3A9}\"]", "\u{3A9}"),
            ("sections = [\"everything\"]", "objects"),
            ("functions = [\"read\"]", "read variable value by name"),
            ("timeout = 0", "greater than 0"),
            ("timeout = \"2 s\"", "expected a whole number, found the text"),
            ("colour = \"red\"", "the key colour is unknown"),
            ("printed-examples = maybe", "line 2"),
        ] {
            let error = Profile::from_toml(&format!("name = \"x\"\n{line}\n")).unwrap_err();
            let shown = error.to_string();
            assert!(shown.contains("line 2") && shown.contains(why), "{line}: {shown}");
        }
    }

    /// Duplicates are found in a time that is not proportional to the square of the number of names.
    #[test]
    fn a_profile_may_have_many_names() {
        let names: Vec<String> = (0..60_000).map(|number| format!("V.E.x{number}")).collect();
        let begun = Instant::now();
        let profile = Profile::from_toml(&format!("unwritten = {names:?}\n")).unwrap();
        assert_eq!(profile.unwritten.len(), names.len());
        assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
    }
}
