//! What a target claims. What it does not claim is not applicable; what it claims must work.

use std::borrow::Cow;

use ads_cnc::Kind;
use ads_cnc::ads::AmsPort;
use ads_cnc::edition::{CncVersion, Edition, Feature};
use ads_cnc::operation::{Function, Task};
use serde::{Serialize, Serializer};

/// The claims of a target.
#[derive(Clone, Debug, Serialize)]
pub struct Profile {
    /// The profile's name.
    pub name: Cow<'static, str>,
    /// The edition of the manual it follows.
    #[serde(serialize_with = "edition")]
    pub edition: Edition,
    /// The version of its CNC, if that is known.
    #[serde(serialize_with = "version")]
    pub cnc_version: Option<CncVersion>,
    /// The ports that answer.
    pub ports: Cow<'static, [u16]>,
    /// Logical numbers of the active channels, in the order of their ranks.
    pub channels: Cow<'static, [u32]>,
    /// A channel number that is not configured.
    pub absent_channel: Option<u32>,
    /// Platform axes, from 1; 0 if nobody says.
    pub platform_axes: u32,
    /// Spindles, from 0; nobody says if there is none.
    pub spindles: Option<u32>,
    /// Places where no axis is: channel and place.
    pub empty_places: Cow<'static, [(u32, u32)]>,
    /// The kinds of variables that can be listed.
    pub kinds: Cow<'static, [Cow<'static, str>]>,
    /// Names of variables of the first channel that are by name only.
    pub by_name_only: Cow<'static, [Cow<'static, str>]>,
    /// What is never written, whatever may be: names of objects, elements and variables.
    pub unwritten: Cow<'static, [Cow<'static, str>]>,
    /// The functions it has, by their names in the function table; those of the manuals if nobody
    /// says.
    pub functions: Option<Cow<'static, [Cow<'static, str>]>>,
    /// Answers the examples the manuals print, with the values they print.
    pub printed_examples: bool,
}

/// Whether a target claims something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// It has to work.
    Yes,
    /// It may be there: what there is of it has to be right.
    Open,
    /// It is not asked for.
    No,
}

const LISTED: &[Cow<'static, str>] =
    &[Cow::Borrowed("V.G"), Cow::Borrowed("V.E"), Cow::Borrowed("V.A")];

const PORTS: &[u16] = &[AmsPort::GEO.0, AmsPort::SDA.0, AmsPort::COM.0];

impl Profile {
    /// The embedded CNC with its default model.
    pub const EMBEDDED: Self = Self {
        name: Cow::Borrowed("embedded"),
        edition: Edition::English,
        cnc_version: Some(CncVersion::from_parts(4, 29, 0, 0)),
        ports: Cow::Borrowed(PORTS),
        channels: Cow::Borrowed(&[1, 2, 6]),
        absent_channel: Some(5),
        platform_axes: 5,
        spindles: Some(2),
        empty_places: Cow::Borrowed(&[(2, 2), (2, 3), (6, 2), (6, 3)]),
        kinds: Cow::Borrowed(LISTED),
        by_name_only: Cow::Borrowed(&[Cow::Borrowed("V.CYC.count"), Cow::Borrowed("V.CYC.matrix")]),
        // To write them is axis exchange, which writing the old number does not undo.
        unwritten: Cow::Borrowed(&[
            Cow::Borrowed("example_axis_number_w"),
            Cow::Borrowed("example.axis_number"),
        ]),
        functions: None,
        printed_examples: true,
    };

    /// A device of which nothing is known but that it has a first channel.
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
        functions: None,
        printed_examples: false,
    };

    /// Whether it claims to have a function.
    ///
    /// ```
    /// use ads_cnc::operation::Function;
    /// use ads_cnc_conformance::profile::{Claim, Profile};
    ///
    /// assert_eq!(Profile::DEVICE.claims(Function::ReadByName), Claim::Yes);
    /// // No manual has it, and not every version.
    /// assert_eq!(Profile::DEVICE.claims(Function::DescribeByName), Claim::Open);
    /// assert_eq!(Profile::EMBEDDED.claims(Function::DescribeByName), Claim::Yes);
    /// ```
    pub fn claims(&self, function: Function) -> Claim {
        let spec = function.spec();
        if !self.has_port(spec.task.port()) {
            return Claim::No;
        }
        match &self.functions {
            Some(functions) if functions.iter().any(|name| name == spec.name) => Claim::Yes,
            Some(_) => Claim::No,
            None if function == Function::DescribeByName => self.has(Feature::DescriptionByName),
            None => Claim::Yes,
        }
    }

    /// Whether it claims what comes with a version.
    pub fn has(&self, feature: Feature) -> Claim {
        match self.cnc_version.map(|version| version.has(feature)) {
            Some(answer) if answer.yes && !answer.assumed => Claim::Yes,
            Some(answer) if !answer.yes && !answer.assumed => Claim::No,
            _ => Claim::Open,
        }
    }

    /// Whether a port answers.
    pub fn has_port(&self, port: AmsPort) -> bool {
        self.ports.contains(&port.0)
    }

    /// Whether a task answers.
    pub fn has_task(&self, task: Task) -> bool {
        self.has_port(task.port())
    }

    /// Whether a kind of variables can be listed.
    pub fn has_kind(&self, kind: Kind<'_>) -> bool {
        self.kinds.iter().any(|name| kind.text() == **name)
    }

    /// Whether something of this name is never to be written.
    pub fn leaves(&self, name: &str) -> bool {
        self.unwritten.iter().any(|one| one == name)
    }
}

/// As `--edition` has it.
fn edition<S: Serializer>(edition: &Edition, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(edition_name(*edition))
}

fn edition_name(edition: Edition) -> &'static str {
    match edition {
        Edition::German => "de-1.051",
        _ => "en-1.05",
    }
}

fn version<S: Serializer>(version: &Option<CncVersion>, serializer: S) -> Result<S::Ok, S::Error> {
    match version {
        Some(version) => serializer.collect_str(version),
        None => serializer.serialize_none(),
    }
}
