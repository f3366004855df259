//! The detection of every seeded defect of a CNC over the wire, in each mode in which a user can
//! run the suite against a device.
//!
//! A CNC in this process is tested through the gate, as `ads-cnc run --target` tests a device: with
//! the same cases, defaults and limits, and without access to the simulator's state. Its clock
//! advances only while the client waits for a missing reply, so that a run takes little time and is
//! repeatable. No device holds the values of the manuals' examples, so no profile claims them.

mod check;
mod requests;
mod table;
mod witness;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, OnceLock};

use ads_cnc::address::{Channel, ChannelAxis};

use crate::edition::Edition;
use crate::faults::{Faulty, Seed};
use crate::gate::{Allowed, Entry, Gate, Moment};
use crate::judge::{CaseOutcome, Needs, Selection, Verdict};
use crate::objects::{self, Object, Options};
use crate::profile::Profile;
use crate::session::{self, Trouble};
use crate::simulator::{Cnc, DEFAULT_MODEL, Model, NET_ID, Settings};
use crate::suite;
use crate::text::named;

use super::Outcomes;
pub use check::{CheckedTable, SAMPLE, Scope};
pub use table::{DetectionRow, DetectionTable, Figures, inputs};

/// How the suite is run against a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mode {
    /// Queries only, without a profile.
    ReadOnly,
    /// Queries only, with a complete profile of the device.
    Profiled,
    /// Without a profile; the file of `--allow-write` names every writable value.
    Writes,
    /// The file of `Writes`, the profile of `Profiled`, and malformed requests.
    All,
}

named! { Mode: ReadOnly "read-only", Profiled "profiled", Writes "writes", All "all", }

impl Mode {
    const fn has_profile(self) -> bool {
        matches!(self, Self::Profiled | Self::All)
    }

    fn gate(self, allowed: &Allowed) -> Gate {
        let gate = Gate::queries();
        match self {
            Self::ReadOnly | Self::Profiled => gate,
            Self::Writes => gate.with_allowed(Some(allowed.clone())),
            Self::All => {
                let allowed = Allowed { malformed: true, ..allowed.clone() };
                gate.with_allowed(Some(allowed)).and_malformed()
            }
        }
    }
}

/// The result of a defect in a mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Detection {
    pub result: Found,
    pub requirements: BTreeSet<String>,
    pub cases: BTreeSet<String>,
}

/// The result of a defect in a mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Found {
    /// A requirement of the defect's row fails.
    Caught,
    /// Only other requirements fail.
    Elsewhere,
    /// No requirement fails; this request would detect the defect.
    Missed(String),
    /// No requirement fails, and no request of the mode distinguishes the CNC from a right one:
    /// from the CNC without the defect, or from this witness.
    Undetectable(String),
    /// A valid variant, and no requirement fails.
    Quiet,
    /// A valid variant, but a requirement fails.
    Alarm,
}

/// A CNC without a defect to run the suite against.
struct Device {
    model: &'static str,
    settings: Settings,
    profile: Profile,
    /// Every writable value, except axis numbers.
    allowed: Allowed,
    /// The answers of the CNC without a defect, by the requests its gate allows.
    right: [OnceLock<Vec<u64>>; 3],
    /// Its valid variants, by mode.
    variants: Mutex<BTreeMap<Mode, witness::Variants>>,
}

impl Device {
    fn new(model: &'static str, settings: Settings) -> Result<Self, Trouble> {
        let internal = |error| Trouble::Internal(format!("the model: {error}"));
        let built = Model::with_settings(model, "the model", settings).map_err(internal)?;
        let profile = built.profile();
        let allowed = everything_writable(Cnc::new(built), &profile)?;
        Ok(Self {
            model,
            settings,
            profile,
            allowed,
            right: Default::default(),
            variants: Mutex::default(),
        })
    }

    /// The CNC of the default model with an edition.
    fn of_edition(edition: Edition) -> Result<&'static Self, Trouble> {
        static ENGLISH: OnceLock<Device> = OnceLock::new();
        static GERMAN: OnceLock<Device> = OnceLock::new();
        let device = match edition {
            Edition::German => &GERMAN,
            _ => &ENGLISH,
        };
        if device.get().is_none() {
            let settings = Settings { edition: Some(edition), version: None };
            // Another thread may have set an equal one.
            let _same = device.set(Self::new(DEFAULT_MODEL, settings)?);
        }
        device.get().ok_or_else(|| Trouble::Internal("no device".to_owned()))
    }

    /// A CNC of this device, optionally with a defect.
    fn cnc(&self, seed: Option<&Seed>) -> Result<Arc<Faulty>, Trouble> {
        let internal = |error| Trouble::Internal(format!("the model: {error}"));
        let model = Model::with_settings(self.model, "the model", self.settings);
        let cnc = Cnc::new(model.map_err(internal)?).with_stopped_clock();
        Ok(Arc::new(Faulty::new(cnc, seed)))
    }

    /// The digests of the answers without a defect to every request that a mode may send.
    fn correct_answers(&self, mode: Mode) -> Result<&[u64], Trouble> {
        let [queries, writes, all] = &self.right;
        let right = match mode {
            Mode::ReadOnly | Mode::Profiled => queries,
            Mode::Writes => writes,
            Mode::All => all,
        };
        if right.get().is_none() {
            let _same = right.set(witness::answers(self, None, mode, None)?.answers);
        }
        Ok(right.get().map_or(&[], Vec::as_slice))
    }

    /// The outcomes of the suite, run as a user runs it.
    fn outcomes(&self, seed: Option<&Seed>, mode: Mode) -> Result<Vec<CaseOutcome>, Trouble> {
        let profile = if mode.has_profile() { self.profile.clone() } else { Profile::DEVICE };
        let mut session = session::Session::in_process(self.cnc(seed)?, mode.gate(&self.allowed))?;
        if session.greet(&profile).is_err() {
            // For a device without any answer `run` makes no report.
            return Ok(Vec::new());
        }
        let (client, _) = session.into_parts();
        let mut session = suite::TargetState::new(client, profile);
        let cases = suite::cases().into_iter().filter(|case| case.needs != Needs::Codec).collect();
        let plan = Selection::default().plan(cases, 1);
        let plan = plan.map_err(|error| Trouble::Internal(error.to_string()))?;
        let outcomes = suite::run(plan.cases.clone(), Some(&mut session), None, 1);
        Ok(plan.finish(outcomes).0)
    }
}

/// The complete file of `--allow-write`: each value that the CNC describes as writable, and the
/// writable values it does not list.
fn everything_writable(cnc: Cnc, profile: &Profile) -> Result<Allowed, Trouble> {
    let cnc = Arc::new(cnc.with_stopped_clock());
    let mut session = session::Session::in_process(cnc, Gate::queries())?;
    let mut entries = Vec::new();
    for variables in [false, true] {
        let options = Options { variables, exact: true, ..Options::default() };
        let found = objects::walk(&mut session, &options, &mut |_| {})?;
        let writable = found.objects.iter().filter(|one| one.is_writable());
        let writable = writable.filter(|one| !profile.leaves(&one.name.to_string()));
        entries.extend(writable.map(Object::entry));
    }
    let parse = |name: &str| name.parse().map_err(|_| Trouble::Internal(name.to_owned()));
    for channel in profile.channels.iter().filter_map(|&number| Channel::new(number).ok()) {
        entries.extend([Entry::Stream(channel), Entry::Service(channel)]);
        for axis in (1..=3).filter_map(|place| ChannelAxis::new(place).ok()) {
            let name = parse("V.A.WCS")?;
            entries.push(Entry::Variable { channel, axis: Some(axis), name });
        }
        for name in profile.by_name_only.iter() {
            entries.push(Entry::Variable { channel, axis: None, name: parse(name)? });
        }
    }
    let expires = Moment::from_rfc3339("9999-12-31T23:59:59Z").unwrap_or(Moment::EPOCH);
    Ok(Allowed { target: NET_ID, address: None, malformed: false, expires, entries })
}

/// Measures a defect, or a valid variant, in every mode.
///
/// # Errors
/// An error of the suite, or of the simulated CNC.
pub fn measure(seed: &Seed) -> Result<DetectionRow, Trouble> {
    let detect = |mode| detect(seed, mode).map(|detection| (mode, detection));
    let modes = Mode::ALL.into_iter().map(detect).collect::<Result<BTreeMap<_, _>, _>>()?;
    Ok(DetectionRow { id: seed.id.clone(), hash: hash(seed)?, modes })
}

/// A hash of the defect's row, and of the answers up to the first that differs from the CNC without
/// it.
///
/// # Errors
/// An error of the simulated CNC.
pub fn hash(seed: &Seed) -> Result<String, Trouble> {
    let devices = devices(seed)?;
    let Seed { id, requirements, what, edition, .. } = seed;
    let mut text = format!("{id} {requirements:?} {what} {edition:?}");
    for device in devices.iter().take(1) {
        let right = device.correct_answers(Mode::All)?;
        let answers = witness::answers(device, Some(seed), Mode::All, Some(right))?.answers;
        text = format!("{text} {answers:?}");
    }
    Ok(table::hash(&text))
}

/// The CNCs to try a defect on: with the edition in which it is detectable, or with both; for a
/// variant with a model of its own, that model.
fn devices(seed: &Seed) -> Result<Vec<&'static Device>, Trouble> {
    if let Some(model) = seed.own_model() {
        return witness::of_model(model).map(|device| vec![device]);
    }
    let editions = match seed.edition {
        Some(edition) => vec![edition],
        None => vec![Edition::English, Edition::German],
    };
    editions.into_iter().map(Device::of_edition).collect()
}

/// The result of a defect in a mode: on the CNC of each edition, until it is caught.
fn detect(seed: &Seed, mode: Mode) -> Result<Detection, Trouble> {
    let devices = devices(seed)?;
    let mut outcomes = Vec::new();
    for device in &devices {
        outcomes.extend(device.outcomes(Some(seed), mode)?);
        if super::judge(&seed.requirements, &outcomes).1 == Outcomes::Caught {
            break;
        }
    }
    let (failed, result) = super::judge(&seed.requirements, &outcomes);
    let result = match result {
        Outcomes::Caught | Outcomes::Elsewhere if witness::is_right(seed).is_some() => Found::Alarm,
        Outcomes::Caught => Found::Caught,
        Outcomes::Quiet => Found::Quiet,
        Outcomes::FalseAlarm => Found::Alarm,
        Outcomes::Broken => return Err(Trouble::Internal(failed.join(" "))),
        _ if !failed.is_empty() => Found::Elsewhere,
        _ => witness::of(seed, &devices, mode)?,
    };
    // A requirement below must is caught by a warning.
    let counts = |id: &str, verdict: Verdict| match verdict {
        Verdict::Fail | Verdict::Vacuous => true,
        Verdict::Warning | Verdict::Differs => {
            result == Found::Caught && seed.requirements.contains(&id)
        }
        _ => false,
    };
    let (mut requirements, mut cases) = (BTreeSet::new(), BTreeSet::new());
    for outcome in &outcomes {
        for one in outcome.verdicts.iter().filter(|one| counts(one.requirement, one.verdict)) {
            requirements.insert(one.requirement.to_owned());
            cases.insert(outcome.case.id.clone());
        }
    }
    Ok(Detection { result, requirements, cases })
}
