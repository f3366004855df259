//! The simulated CNCs that the suite tests as if they were devices.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use ads_cnc::address::{Channel, ChannelAxis};

use super::detection_result::Mode;
use super::requests::{Compare, RecordedAnswers, ask_everything};
use crate::edition::Edition;
use crate::faults::{Faulty, FieldDefect, SeededDefect};
use crate::gate::{Allowed, Entry, Gate, Moment};
use crate::judge::{CaseOutcome, Needs, Selection};
use crate::mutex::lock;
use crate::objects::{self, ListedValue, Options};
use crate::profile::Profile;
use crate::session::{Session, ToolError};
use crate::simulator::{Cnc, DEFAULT_MODEL, Model, NET_ID, Settings};
use crate::suite::{self, ClaimsBy, PLACES_MAX};

/// A simulated CNC that the suite tests like a device, with its correct replies.
pub(super) struct Device {
    /// The TOML text of the data model.
    pub(super) model: &'static str,
    settings: Settings,
    profile: Profile,
    /// The contents of an `--allow-write` file that names the writable values that the profile does
    /// not exclude. The profile excludes the axis numbers, because writing them exchanges axes.
    allowed: Allowed,
    /// The digests of the correct replies, by the requests that the gate allows: queries; queries
    /// and writes; queries, writes and malformed requests.
    correct_digests: [OnceLock<Vec<u64>>; 3],
    /// Digests like those in `correct_digests`, but without the values that the configuration of a
    /// CNC determines.
    configured_digests: [OnceLock<Vec<u64>>; 3],
}

impl Device {
    fn new(model: &'static str, settings: Settings) -> Result<Self, ToolError> {
        let built = built(model, settings)?;
        let profile = built.profile();
        let allowed = everything_writable(Cnc::new(built), &profile)?;
        Ok(Self {
            model,
            settings,
            profile,
            allowed,
            correct_digests: Default::default(),
            configured_digests: Default::default(),
        })
    }

    /// The device with the default model and this edition.
    pub(super) fn of_edition(edition: Edition) -> Result<&'static Self, ToolError> {
        static ENGLISH: OnceLock<Device> = OnceLock::new();
        static GERMAN: OnceLock<Device> = OnceLock::new();
        let device = match edition {
            Edition::German => &GERMAN,
            _ => &ENGLISH,
        };
        if device.get().is_none() {
            let settings = Settings { edition: Some(edition), version: None };
            // `set` fails if another thread has already set the device, which is equal.
            let _same = device.set(Self::new(DEFAULT_MODEL, settings)?);
        }
        device.get().ok_or_else(|| ToolError::Internal("no device".to_owned()))
    }

    /// A new simulated CNC with the model of this device, without a defect.
    fn correct_cnc(&self) -> Result<Cnc, ToolError> {
        Ok(Cnc::new(built(self.model, self.settings)?).with_stopped_clock())
    }

    /// A new simulated CNC with the model of this device, optionally with a defect.
    pub(super) fn cnc(&self, defect: Option<&SeededDefect>) -> Result<Arc<Faulty>, ToolError> {
        Ok(Arc::new(Faulty::new(self.correct_cnc()?, defect)))
    }

    /// A simulated CNC with another model and edition, optionally a valid variant; `None` if the
    /// mode uses the profile of this device and this profile does not apply to that CNC.
    pub(super) fn cnc_with_model(
        &self,
        model: &str,
        edition: Option<Edition>,
        variant: Option<&SeededDefect>,
        mode: Mode,
    ) -> Result<Option<Arc<Faulty>>, ToolError> {
        let settings = Settings { edition: edition.or(self.settings.edition), ..self.settings };
        let model = built(model, settings)?;
        // The profiles may differ in `unwritten`, which only lists values that the suite does not
        // write.
        let unwritten = self.profile.unwritten.clone();
        let profile = Profile { unwritten, ..model.profile() };
        if mode.has_profile() && format!("{profile:?}") != format!("{:?}", self.profile) {
            return Ok(None);
        }
        Ok(Some(Arc::new(Faulty::new(Cnc::new(model).with_stopped_clock(), variant))))
    }

    /// The digests of the replies without a defect to the generated requests that the gate of a
    /// mode allows.
    pub(super) fn correct_answers(
        &self,
        mode: Mode,
        compare: Compare,
    ) -> Result<&[u64], ToolError> {
        let [queries, writes, all] = match compare {
            Compare::Bytes => &self.correct_digests,
            Compare::Configured => &self.configured_digests,
        };
        let correct_digests = match mode {
            Mode::ReadOnly | Mode::Profiled => queries,
            Mode::Writes => writes,
            Mode::All => all,
        };
        if correct_digests.get().is_none() {
            let answers = answers(self, self.cnc(None)?, mode, None, compare)?.answers;
            let _same = correct_digests.set(answers);
        }
        Ok(correct_digests.get().map_or(&[], Vec::as_slice))
    }

    /// The axis indices to which the suite does not write, as channel and index: those that have no
    /// axis according to the profile; without a profile, all in channels other than the first.
    fn unwritten_places(&self, mode: Mode) -> Vec<(u32, u32)> {
        if mode.has_profile() {
            return self.profile.empty_places.to_vec();
        }
        let others = self.profile.channels.iter().skip(1);
        others.flat_map(|&number| (1..=PLACES_MAX).map(move |place| (number, place))).collect()
    }

    /// The outcomes of the suite against this device, optionally with a defect, in a mode.
    pub(super) fn outcomes(
        &self,
        defect: Option<&SeededDefect>,
        mode: Mode,
    ) -> Result<Vec<CaseOutcome>, ToolError> {
        self.outcomes_of(self.cnc(defect)?, mode)
    }

    /// The outcomes of the suite against this device with several field defects, in a mode.
    pub(super) fn outcomes_with(
        &self,
        fields: Vec<FieldDefect>,
        mode: Mode,
    ) -> Result<Vec<CaseOutcome>, ToolError> {
        self.outcomes_of(Arc::new(Faulty::with_fields(self.correct_cnc()?, fields)), mode)
    }

    fn outcomes_of(&self, cnc: Arc<Faulty>, mode: Mode) -> Result<Vec<CaseOutcome>, ToolError> {
        let profile = if mode.has_profile() { self.profile.clone() } else { Profile::DEVICE };
        let mut session = Session::in_process(cnc, mode.gate(&self.allowed))?;
        if session.check_reachable(&profile).is_err() {
            // `run` writes no report for a device that does not reply at all.
            return Ok(Vec::new());
        }
        let (client, _) = session.into_parts();
        let mut session = suite::TargetState::new(client, profile);
        let by = if mode.has_profile() { ClaimsBy::Profile } else { ClaimsBy::Queries };
        suite::discover(&mut session, by);
        let cases = suite::cases().into_iter().filter(|case| case.needs != Needs::Codec).collect();
        let plan = Selection::default().plan(cases, 1);
        let plan = plan.map_err(|error| ToolError::Internal(error.to_string()))?;
        let outcomes = suite::run(plan.cases.clone(), Some(&mut session), None, 1);
        Ok(plan.finish(outcomes).0)
    }
}

fn built(model: &str, settings: Settings) -> Result<Model, ToolError> {
    let model = Model::with_settings(model, "the model", settings);
    model.map_err(|error| ToolError::Internal(format!("the model: {error}")))
}

/// The contents of an `--allow-write` file. It names the listed values that the CNC describes as
/// writable, unless the profile excludes them; writable values that no list of the CNC contains;
/// and the stream and the Service Interface of each channel.
fn everything_writable(cnc: Cnc, profile: &Profile) -> Result<Allowed, ToolError> {
    let cnc = Arc::new(cnc.with_stopped_clock());
    let mut session = Session::in_process(cnc, Gate::queries())?;
    let mut entries = Vec::new();
    for variables in [false, true] {
        let options = Options { variables, exact: true, ..Options::default() };
        let found = objects::walk(&mut session, &options, &mut |_| {})?;
        let writable = found.objects.iter().filter(|one| one.is_writable());
        let writable = writable.filter(|one| !profile.leaves(&one.name.to_string()));
        entries.extend(writable.map(ListedValue::entry));
    }
    let parse = |name: &str| name.parse().map_err(|_| ToolError::Internal(name.to_owned()));
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

/// The digests of a CNC's replies to the generated requests that the gate of a mode allows.
pub(super) fn answers(
    device: &Device,
    cnc: Arc<Faulty>,
    mode: Mode,
    correct_digests: Option<&[u64]>,
    compare: Compare,
) -> Result<RecordedAnswers, ToolError> {
    let session = Session::in_process(cnc.clone(), mode.gate(&device.allowed))?;
    let (client, _) = session.into_parts();
    let places = device.unwritten_places(mode);
    Ok(ask_everything(client, Arc::clone(cnc.cnc()), correct_digests, compare, &places))
}

/// The device with the model of a valid variant.
fn of_model(model: &'static str) -> Result<&'static Device, ToolError> {
    static DEVICES: OnceLock<Mutex<BTreeMap<&'static str, &'static Device>>> = OnceLock::new();
    let devices = DEVICES.get_or_init(Mutex::default);
    let mut devices = lock(devices);
    if let Some(device) = devices.get(model) {
        return Ok(device);
    }
    // At most one device for each variant with its own model is leaked.
    let device: &Device = Box::leak(Box::new(Device::new(model, Settings::default())?));
    devices.insert(model, device);
    Ok(device)
}

/// The devices on which a defect is tried: for a variant with its own model, the device with this
/// model; otherwise the device of the edition of the defect, or of both editions if the defect has
/// no edition.
pub(super) fn devices(defect: &SeededDefect) -> Result<Vec<&'static Device>, ToolError> {
    if let Some(model) = defect.own_model() {
        return of_model(model).map(|device| vec![device]);
    }
    let editions = match defect.edition {
        Some(edition) => vec![edition],
        None => vec![Edition::English, Edition::German],
    };
    editions.into_iter().map(Device::of_edition).collect()
}
