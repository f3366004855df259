//! The profile of a target, which lists the claims of the target. A claimed feature must work; a
//! feature that is not claimed is not tested (not applicable); [`Claim::Open`] is between both.

mod file;

use std::borrow::Cow;
use std::time::Duration;

use ads_cnc::Kind;
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{Function, Task};
use serde::{Deserialize, Serialize, Serializer};

use crate::edition::{CncVersion, Edition, Feature};

pub use file::EXAMPLE;

/// The claims of a target.
#[derive(Clone, Debug, Serialize)]
pub struct Profile {
    /// The profile's name.
    pub name: Cow<'static, str>,
    /// The edition of the manual that the target follows.
    #[serde(serialize_with = "edition")]
    pub edition: Edition,
    /// The version of the CNC, if known.
    #[serde(serialize_with = "version")]
    pub cnc_version: Option<CncVersion>,
    /// The AMS ports that answer.
    pub ports: Cow<'static, [u16]>,
    /// Logical numbers of the active channels, in the order of their ranks.
    pub channels: Cow<'static, [u32]>,
    /// A channel number that is not configured.
    pub absent_channel: Option<u32>,
    /// Number of platform axes; 0 if unknown.
    pub platform_axes: u32,
    /// Number of spindles; `None` if unknown.
    pub spindles: Option<u32>,
    /// The axis indices of a channel that have no axis: channel number and axis index, both from 1.
    pub empty_places: Cow<'static, [(u32, u32)]>,
    /// The kinds of variables that can be listed.
    pub kinds: Cow<'static, [Cow<'static, str>]>,
    /// Variables of the first channel that are accessible by name only.
    pub by_name_only: Cow<'static, [Cow<'static, str>]>,
    /// Names of objects, elements and variables that the suite never writes, even if the file of
    /// `--allow-write` allows it.
    pub unwritten: Cow<'static, [Cow<'static, str>]>,
    /// The sections of the manuals that the target claims.
    pub sections: Cow<'static, [Section]>,
    /// The claimed functions of these sections, by their names in the function table; `None` for
    /// all, except that the version decides about the description by name.
    pub functions: Option<Cow<'static, [Cow<'static, str>]>>,
    /// Whether the target answers the printed examples with the printed values.
    pub printed_examples: bool,
    /// The maximum time to wait for a connection and for a reply; `None` if the profile does not
    /// set it. A report states it in milliseconds.
    #[serde(serialize_with = "milliseconds", skip_serializing_if = "Option::is_none")]
    pub timeout: Option<Duration>,
}

/// A part of the manuals that a target may support or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Section {
    /// Objects of the COM task: `ads-*`, section 2.1.
    Objects,
    /// Elements of the classes of SDA and GEO: `ads-*`, section 2.2.
    Elements,
    /// Dynamic parameters: `ads-*`, section 3.
    Parameters,
    /// Variables with flexible data type: `ads-*`, section 4.
    Variables,
    /// Data streaming.
    Streaming,
    /// The Service Interface, which consists of variables.
    Service,
}

impl Section {
    /// All sections.
    pub const ALL: &'static [Self] = &[
        Self::Objects,
        Self::Elements,
        Self::Parameters,
        Self::Variables,
        Self::Streaming,
        Self::Service,
    ];

    /// The section of a function.
    pub fn of(function: Function) -> Self {
        let section = function.spec().section;
        match section.get(..3) {
            Some("2.1") => Self::Objects,
            Some("2.2") => Self::Elements,
            Some("str") => Self::Streaming,
            Some(section) if section.starts_with('3') => Self::Parameters,
            // Section 4, and the functions that only the vendors' help pages describe, concern
            // variables.
            _ => Self::Variables,
        }
    }
}

/// Whether a target claims a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// The feature must work.
    Yes,
    /// The feature is optional; if present, it must work.
    Open,
    /// The feature is not tested.
    No,
}

const LISTED: &[Cow<'static, str>] =
    &[Cow::Borrowed("V.G"), Cow::Borrowed("V.E"), Cow::Borrowed("V.A")];

const PORTS: &[u16] = &[AmsPort::GEO.0, AmsPort::SDA.0, AmsPort::COM.0];

impl Profile {
    /// The profile of an unknown device before the run queries the device. It claims channel 1, all
    /// ports and all sections.
    pub const DEVICE: Self = Self {
        name: Cow::Borrowed("device"),
        edition: Edition::English,
        cnc_version: None,
        ports: Cow::Borrowed(PORTS),
        channels: Cow::Borrowed(&[1]),
        absent_channel: None,
        platform_axes: 0,
        spindles: None,
        empty_places: Cow::Borrowed(&[]),
        kinds: Cow::Borrowed(LISTED),
        by_name_only: Cow::Borrowed(&[]),
        unwritten: Cow::Borrowed(&[]),
        sections: Cow::Borrowed(Section::ALL),
        functions: None,
        printed_examples: false,
        timeout: None,
    };

    /// Whether the profile claims a function.
    ///
    /// ```
    /// use ads_cnc::operation::Function;
    /// use ads_cnc_conformance::profile::{Claim, Profile};
    ///
    /// assert_eq!(Profile::DEVICE.claims(Function::ReadByName), Claim::Yes);
    /// // Only some versions have this function, and no manual describes it.
    /// assert_eq!(Profile::DEVICE.claims(Function::DescribeByName), Claim::Open);
    /// let newest = Profile { cnc_version: "V4.29.0".parse().ok(), ..Profile::DEVICE };
    /// assert_eq!(newest.claims(Function::DescribeByName), Claim::Yes);
    /// ```
    pub fn claims(&self, function: Function) -> Claim {
        let spec = function.spec();
        if !self.has_task(spec.task) || !self.has_section(Section::of(function)) {
            return Claim::No;
        }
        match &self.functions {
            Some(_) if self.names(function) => Claim::Yes,
            Some(_) => Claim::No,
            None => Feature::of(function).map_or(Claim::Yes, |feature| self.has(feature)),
        }
    }

    /// Whether the list `functions` of the profile contains the name of a function.
    pub fn names(&self, function: Function) -> bool {
        let functions = self.functions.as_deref().unwrap_or_default();
        functions.iter().any(|name| name == function.spec().name)
    }

    /// Whether the profile claims a feature that depends on the version.
    pub fn has(&self, feature: Feature) -> Claim {
        match self.cnc_version.map(|version| version.has(feature)) {
            Some(answer) if answer.available && !answer.assumed => Claim::Yes,
            Some(answer) if !answer.available && !answer.assumed => Claim::No,
            _ => Claim::Open,
        }
    }

    /// Whether the profile claims a section of the manuals.
    pub fn has_section(&self, section: Section) -> bool {
        self.sections.contains(&section)
    }

    /// Whether the profile claims a port.
    pub fn has_port(&self, port: AmsPort) -> bool {
        self.ports.contains(&port.0)
    }

    /// Whether the profile claims a task.
    pub fn has_task(&self, task: Task) -> bool {
        self.has_port(task.port())
    }

    /// Whether the profile claims that a kind of variables can be listed.
    pub fn has_kind(&self, kind: Kind<'_>) -> bool {
        self.kinds.iter().any(|name| kind.text() == **name)
    }

    /// Whether the suite must not write a value with this name.
    pub fn leaves(&self, name: &str) -> bool {
        let is_in = |one: &str, all: &str| {
            one.strip_prefix(all).is_some_and(|indices| indices.starts_with('['))
        };
        self.unwritten.iter().any(|one| one == name || is_in(one, name) || is_in(name, one))
    }
}

/// Serializes an edition in the form of the value of `--edition`, such as `en-1.05`.
fn edition<S: Serializer>(edition: &Edition, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&edition.name())
}

fn version<S: Serializer>(version: &Option<CncVersion>, serializer: S) -> Result<S::Ok, S::Error> {
    match version {
        Some(version) => serializer.collect_str(version),
        None => serializer.serialize_none(),
    }
}

fn milliseconds<S: Serializer>(time: &Option<Duration>, serializer: S) -> Result<S::Ok, S::Error> {
    let time = time.unwrap_or_default().as_millis();
    serializer.serialize_u64(u64::try_from(time).unwrap_or(u64::MAX))
}
