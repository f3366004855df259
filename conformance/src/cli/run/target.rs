//! Runs the suite against a device or the simulated CNC, and fills in a profile for a device.

use std::path::Path;
use std::time::Instant;

use ads_cnc::operation::Task;

use super::{Run, Stopped};
use crate::cli::message::print_error;
use crate::cli::output::show;
use crate::cli::progress::Watch;
use crate::cli::run_dry;
use crate::faults::{Faulty, SeededDefect};
use crate::judge::{
    Case, CaseOutcome, CaseSubject, Needs, Plan, RequirementVerdict, Verdict, Waivers,
};
use crate::number::to_usize;
use crate::profile::Profile;
use crate::report::{DeviceReport, Report, RunInfo, TargetReport};
use crate::session::{self, ToolError};
use crate::simulator::{Cnc, DEFAULT_MODEL, Model, Settings};
use crate::suite::{self, Changes, ClaimsBy, Discovery, Sample, TargetState, Unwritable};
use crate::text::{Moment, plural};

impl Run {
    pub(super) fn device(
        &self,
        seed: u32,
        waivers: Waivers,
        profile: Profile,
        changes: &Changes,
    ) -> Result<Report, Stopped> {
        let plan = self.plan(seed)?;
        let target = self.target.clone().of_suite().with_timeout(profile.timeout);
        let deadline = self.deadline.begin();
        let session = target.with_malformed(self.malformed).open()?;
        let mut session = session.with_deadline(deadline);
        // The run ends if the device does not reply to a first query. Afterwards, the cases judge
        // missing replies.
        match session.check_reachable(&profile) {
            Ok(()) => {}
            Err(ToolError::NotSent) => {
                let (client, _) = session.into_parts();
                let (has_file, allowed) = (self.profile.is_some(), client.gate().allowed());
                let listed = show(|out| run_dry::list(&profile, has_file, allowed, out));
                listed.map_err(|error| ToolError::Internal(error.to_string()))?;
                return Err(ToolError::NotSent.into());
            }
            Err(error) => return Err(error.into()),
        }
        let (target, device) = (*session.target(), of_itself(&mut session));
        let (client, _) = session.into_parts();
        // Without --profile, the report says that no profile was used.
        let name = self.profile.is_none().then_some("none (judged by what was found)".into());
        let profile = Profile { name: name.unwrap_or(profile.name), ..profile };
        let session = TargetState::new(client, profile);
        let sample =
            if self.all || self.target.has_file() { Sample::All } else { Sample::BySeed(seed) };
        let session = session.with_changes(changes.clone()).with_deadline(deadline);
        let mut session = session.with_sample(sample);
        let by = if self.profile.is_some() { ClaimsBy::Profile } else { ClaimsBy::Queries };
        let discovery = suite::discover(&mut session, by);
        if !self.display.is_quiet() {
            let about = if self.only.is_empty() { "about" } else { "at most about" };
            print_forecast(&discovery, about);
        }
        let target = TargetReport {
            name: "device".to_owned(),
            address: Some(target.addr.to_string()),
            net_id: Some(target.net_id.to_string()),
            device,
            ..TargetReport::default()
        };
        let about = self.about(target, seed, waivers);
        let about = RunInfo { found: Some(discovery.found), ..about };
        self.judge(plan, session, None, about)
    }

    /// The text of a profile that is filled in with the answers of the device.
    pub(super) fn profile_of_device(&self) -> Result<String, ToolError> {
        let deadline = self.deadline.begin();
        let mut session = self.target.open()?.with_deadline(deadline);
        session.check_reachable(&Profile::DEVICE)?;
        let (client, _) = session.into_parts();
        let mut state = TargetState::new(client, Profile::DEVICE).with_deadline(deadline);
        let discovery = suite::discover(&mut state, ClaimsBy::Queries);
        if let Some(why) = discovery.found.stopped {
            print_error(format_args!("the profile is not complete: {why}"));
        }
        Ok(state.profile.filled())
    }

    /// Starts the simulated CNC, runs the plan against it and stops it.
    pub(super) fn simulated(
        &self,
        seed: u32,
        waivers: Waivers,
        profile: Profile,
        defect: Option<SeededDefect>,
    ) -> Result<Report, Stopped> {
        let plan = self.plan(seed)?;
        let internal = |error| ToolError::Internal(format!("the default model: {error}"));
        let settings = Settings { edition: Some(profile.edition), version: None };
        let model = Model::with_settings(DEFAULT_MODEL, "the default model", settings);
        let faulty = Faulty::new(Cnc::new(model.map_err(internal)?), defect.as_ref());
        let session = session::Session::simulated_to_try(faulty)?;
        let mut session = self.target.clone().of_suite().recorded(session)?;
        let (target, device) = (*session.target(), of_itself(&mut session));
        // The CNC runs until `_running` is dropped.
        let (client, _running) = session.into_parts();
        let session = TargetState::new(client, profile);
        let target = TargetReport {
            name: match &defect {
                None => "simulated CNC".to_owned(),
                Some(defect) => format!("simulated CNC with the defect {}", defect.id),
            },
            address: Some(target.addr.to_string()),
            net_id: Some(target.net_id.to_string()),
            device,
            ..TargetReport::default()
        };
        self.judge(plan, session, defect.as_ref(), self.about(target, seed, waivers))
    }

    fn judge(
        &self,
        plan: Plan,
        mut session: TargetState,
        defect: Option<&SeededDefect>,
        about: RunInfo,
    ) -> Result<Report, Stopped> {
        let (client, allow) = (&session.client, self.target.has_file());
        let usable = client.gate().check_target(client.target().net_id, Moment::now());
        let mut rejected = Vec::new();
        if let Err(why) = &usable {
            print_error(format_args!("nothing will be written: {why}"));
            rejected.push(format!("allow-write: nothing was written: {why}"));
        }
        let (of_codec, of_target): (Vec<Case>, Vec<Case>) =
            plan.cases.iter().cloned().partition(|case| case.needs == Needs::Codec);
        let mut times = Vec::new();
        let mut outcomes: Vec<CaseOutcome> = Vec::new();
        {
            let _watch = Watch::start("cases");
            for (subject, cases) in
                [(CaseSubject::Codec, of_codec), (CaseSubject::Target, of_target)]
            {
                let begin = Instant::now();
                if let Some(most) = self.max_fail {
                    let failed = outcomes.iter().filter(|one| one.verdict().is_failure()).count();
                    session.stop_after(to_usize(most).saturating_sub(failed));
                }
                let target = (subject == CaseSubject::Target).then_some(&mut session);
                outcomes.extend(suite::run(cases, target, defect, about.seed));
                times.push((subject, begin.elapsed()));
            }
        }
        if usable.is_ok() {
            let Unwritable { absent, read_only } = suite::unwritable(&mut session);
            rejected.extend(absent);
            if !read_only.is_empty() {
                let names = read_only.join(", ");
                print_error(format_args!(
                    "read-only, so the run only verifies that a write is rejected: {names}"
                ));
            }
        }
        session.client.end_capture().map_err(|error| self.lost_capture(&error))?;
        let is_whole = outcomes.iter().all(|one| one.verdict() != Verdict::Interrupted);
        if allow && usable.is_ok() && is_whole && !outcomes.iter().any(has_written) {
            print_error(
                "nothing was written: the device has no item of the file for --allow-write",
            );
        }
        let (outcomes, left_out) = plan.finish(outcomes);
        let (left_changed, written) = (session.changes().left(), session.changes().written());
        let written = if allow { written } else { Vec::new() };
        let ended = self.ended(&outcomes).or_else(|| session.ended().map(str::to_owned));
        let (frames, profile) = (session.frames, Some(session.profile));
        let about = RunInfo { frames, profile, times, left_changed, ended, ..about };
        Ok(Report::new(about, &outcomes, &left_out).with_writes(rejected, written))
    }

    fn lost_capture(&self, error: &std::io::Error) -> ToolError {
        let file = self.target.capture().unwrap_or(Path::new("the capture"));
        ToolError::Internal(format!("{}: {error}", file.display()))
    }
}

/// Prints what the discovery found, and the expected number and duration of the queries of all
/// cases. `about` is the text before the number: "about", or "at most about" with --only.
fn print_forecast(discovery: &Discovery, about: &str) {
    let found = &discovery.found;
    print_error(format_args!("found {}", found.summary()));
    if let Some(sampled) = found.sampled() {
        print_error(format_args!("sampled (--all reads all): {sampled}"));
    }
    let requests = found.expected;
    if requests == 0 {
        return;
    }
    let (seconds, each) = (discovery.time_for(requests).as_secs(), discovery.time_for(1));
    let time = if seconds > 0 {
        let each = each.as_secs_f64() * 1000.0;
        format!(", {each:.1} ms each: {} min {} s", seconds / 60, seconds % 60)
    } else {
        String::new()
    };
    let requests = plural(requests, "request");
    print_error(format_args!("the queries of the cases: {about} {requests}{time}"));
}

/// Whether the case writes and at least one of its verdicts is judged.
fn has_written(outcome: &CaseOutcome) -> bool {
    let judged = |one: &RequirementVerdict| one.verdict.is_judged();
    outcome.case.needs == Needs::Writes && outcome.verdicts.iter().any(judged)
}

/// The device information and the ADS state of the COM task; `None` if the target returns no device
/// information.
fn of_itself(session: &mut session::Session) -> Option<DeviceReport> {
    let info = session.device_info(Task::Com).ok()?;
    let state = session.device_state(Task::Com).ok();
    Some(DeviceReport::new(&info, state.map(|state| state.ads_state)))
}
