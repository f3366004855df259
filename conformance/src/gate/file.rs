//! Reads the file of `--allow-write`.

use std::fs::File;
use std::net::IpAddr;
use std::path::Path;

use ads_cnc::address::{
    Attribute, Channel, ChannelAxis, ClassGroup, ElementAddress, Group, IndexGroup, IndexOffset,
    PlatformAxis,
};
use ads_cnc::ads::AmsNetId;
use ads_cnc::limits::{DESCRIPTOR_TEXT_LEN, NAME_MAX};
use ads_cnc::operation::{WriteElement, WriteObject};
use ads_cnc::{CncString, streaming};
use serde::Deserialize;
use serde::de::{Deserializer, Error as _};
use toml::Value;

use super::{Allowed, AllowedList, Entry, Moment};
use crate::text::{FileError, found, plural, toml_error};

impl Allowed {
    /// Reads a file.
    ///
    /// # Errors
    /// If the file cannot be read, or [`from_toml`](Self::from_toml) fails.
    pub fn from_file(file: &Path) -> Result<Self, FileError> {
        FileError::parse(file, File::open(file), Self::from_toml)
    }

    /// Parses the text of a file.
    ///
    /// # Errors
    /// Invalid TOML, unknown or missing keys, invalid values, or an address that cannot be written.
    /// The error contains the number of the line, if it is known.
    pub fn from_toml(text: &str) -> Result<Self, FileError> {
        let file: AllowListFile =
            toml::from_str(text).map_err(|error| FileError::new(toml_error(&error)))?;
        let AllowListFile {
            target,
            address,
            malformed,
            expires,
            variable,
            object,
            element,
            stream,
            service,
        } = file;
        let mut entries: Vec<Entry> =
            variable.into_iter().map(|AllowedVariable(one)| one).collect();
        entries.extend(object.into_iter().map(|AllowedObject(one)| one));
        entries.extend(element.into_iter().map(|AllowedElement(one)| one));
        entries.extend(stream.into_iter().map(|AllowedChannel(channel)| Entry::Stream(channel)));
        entries.extend(service.into_iter().map(|AllowedChannel(channel)| Entry::Service(channel)));
        Ok(Self { target, address, malformed, expires, entries })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AllowListFile {
    #[serde(deserialize_with = "net_id")]
    target: AmsNetId,
    #[serde(default, deserialize_with = "address")]
    address: Option<IpAddr>,
    #[serde(default)]
    malformed: bool,
    #[serde(deserialize_with = "moment")]
    expires: Moment,
    #[serde(default)]
    variable: Vec<AllowedVariable>,
    #[serde(default)]
    object: Vec<AllowedObject>,
    #[serde(default)]
    element: Vec<AllowedElement>,
    #[serde(default)]
    stream: Vec<AllowedChannel>,
    #[serde(default)]
    service: Vec<AllowedChannel>,
}

fn net_id<'de, D: Deserializer<'de>>(value: D) -> Result<AmsNetId, D::Error> {
    let text = String::deserialize(value)?;
    let shaped =
        |_| D::Error::custom("expected an AMS NetId, six numbers with dots: \"192.0.2.7.1.1\"");
    text.parse().map_err(shaped)
}

fn address<'de, D: Deserializer<'de>>(value: D) -> Result<Option<IpAddr>, D::Error> {
    let text = String::deserialize(value)?;
    let shaped = |_| D::Error::custom("expected an IP address without a port: \"192.0.2.7\"");
    text.parse().map(|address: IpAddr| Some(address.to_canonical())).map_err(shaped)
}

fn moment<'de, D: Deserializer<'de>>(value: D) -> Result<Moment, D::Error> {
    let value = Value::deserialize(value)?;
    value.as_datetime().and_then(|datetime| Moment::from_datetime(*datetime)).ok_or_else(|| {
        D::Error::custom(format!(
            "expected a date and time with a UTC offset and without quotes, such as \
             2026-05-04T17:30:00+02:00, found {}",
            found(&value)
        ))
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawVariable {
    channel: Option<u32>,
    rank: Option<u32>,
    axis: Option<u32>,
    name: String,
}

#[derive(Deserialize)]
#[serde(try_from = "RawVariable")]
struct AllowedVariable(Entry);

impl TryFrom<RawVariable> for AllowedVariable {
    type Error = String;

    fn try_from(raw: RawVariable) -> Result<Self, String> {
        let RawVariable { channel, rank, axis, name } = raw;
        let axis = axis.map(ChannelAxis::new).transpose().map_err(|error| error.to_string())?;
        let name = text(&name, NAME_MAX)?;
        Ok(Self(Entry::Variable { channel: one_of(channel, rank)?, axis, name }))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawObject {
    channel: Option<u32>,
    rank: Option<u32>,
    axis: Option<u32>,
    name: Option<String>,
    group: Option<u32>,
    offset: Option<u32>,
}

#[derive(Deserialize)]
#[serde(try_from = "RawObject")]
struct AllowedObject(Entry);

impl TryFrom<RawObject> for AllowedObject {
    type Error = String;

    fn try_from(raw: RawObject) -> Result<Self, String> {
        let RawObject { channel, rank, axis, name, group, offset } = raw;
        match (name, group, offset, channel.is_some() || rank.is_some() || axis.is_some()) {
            (Some(name), None, None, _) => {
                let list = match (channel, rank, axis) {
                    (Some(0), None, None) => AllowedList::Platform,
                    (None, None, Some(axis)) => AllowedList::Axis(
                        PlatformAxis::new(axis).map_err(|error| error.to_string())?,
                    ),
                    (channel, rank, None) => AllowedList::Channel(one_of(channel, rank)?),
                    _ => return Err("expected either a channel or an axis for the object".into()),
                };
                Ok(Self(Entry::Object { list, name: text(&name, DESCRIPTOR_TEXT_LEN)? }))
            }
            (None, Some(group), Some(offset), false) => {
                let (group, offset) = (IndexGroup::new(group), IndexOffset::new(offset));
                if offset == streaming::INDEX_OFFSET {
                    return Err("use a table [[stream]] to allow the program stream".into());
                }
                let invalid = |_| format!("no content of a COM object is at {group}, {offset}");
                WriteObject::new(group, offset, &[][..]).map_err(invalid)?;
                Ok(Self(Entry::Content { group, offset }))
            }
            _ => Err("expected either group and offset, or channel and name".into()),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawElement {
    group: u32,
    offset: u32,
}

#[derive(Deserialize)]
#[serde(try_from = "RawElement")]
struct AllowedElement(Entry);

impl TryFrom<RawElement> for AllowedElement {
    type Error = String;

    fn try_from(raw: RawElement) -> Result<Self, String> {
        let (group, offset) = (IndexGroup::new(raw.group), IndexOffset::new(raw.offset));
        let invalid = || format!("no content of an element is at {group}, {offset}");
        let Some(Group::Class(class @ ClassGroup { attribute: Attribute::Content, .. })) =
            group.parts()
        else {
            return Err(invalid());
        };
        WriteElement::new(ElementAddress::new(class, offset), &[][..]).map_err(|_| invalid())?;
        Ok(Self(Entry::Content { group, offset }))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawChannel {
    channel: Option<u32>,
    rank: Option<u32>,
}

#[derive(Deserialize)]
#[serde(try_from = "RawChannel")]
struct AllowedChannel(Channel);

impl TryFrom<RawChannel> for AllowedChannel {
    type Error = String;

    fn try_from(RawChannel { channel, rank }: RawChannel) -> Result<Self, String> {
        one_of(channel, rank).map(Self)
    }
}

fn one_of(channel: Option<u32>, rank: Option<u32>) -> Result<Channel, String> {
    let channel = match (channel, rank) {
        (Some(number), None) => Channel::new(number),
        (None, Some(rank)) => Channel::by_index(rank),
        _ => return Err("expected either channel (the number) or rank".into()),
    };
    channel.map_err(|error| error.to_string())
}

fn text(text: &str, max: usize) -> Result<CncString, String> {
    let name: CncString = text.parse().map_err(|error: ads_cnc::Error| error.to_string())?;
    match name.as_bytes().len() {
        len if (1..=max).contains(&len) => Ok(name),
        _ => Err(format!("expected a name of 1 to {}", plural(max, "character"))),
    }
}
