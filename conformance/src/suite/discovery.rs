//! Finds the axes, spindles and lists of a target and, without a profile, its channels and ports,
//! before the cases run.

use std::time::{Duration, Instant};

use ads_cnc::Kind;
use ads_cnc::address::{Channel, Class, PlatformAxis};
use ads_cnc::ads::DeviceInfoReply;
use ads_cnc::operation::{CountObjects, CountVariables, ObjectList, Request, Task};

use super::kit::{
    Counted, Instance, ItemKind, OF_PLACES, PLACES_MAX, Probe, RawCall, SampleSizes, TargetState,
    VARIABLES_MAX, ask_if_claimed, has_dynamic_variables,
};
use crate::client::InquiryReply;
use crate::edition::Edition;
use crate::judge::{IfPresent as _, Step, Stop};
use crate::number::to_u32;
use crate::objects::{ValueList, Walker, active_channels, decoder_of, has_variables};
use crate::report::{FoundChannel, FoundList, FoundReport};

/// The source of the claims, which determine the judged parts of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClaimsBy {
    /// The file of `--profile`.
    Profile,
    /// The replies of the target.
    Queries,
}

/// The result of the discovery, and how long its queries took.
#[derive(Clone, Debug, Default)]
pub struct Discovery {
    pub found: FoundReport,
    pub time: Duration,
}

impl Discovery {
    /// Estimates the time for a number of requests from the time of the queries of the discovery.
    pub fn time_for(&self, requests: u64) -> Duration {
        let each = self.time.checked_div(to_u32(self.found.requests));
        let nanoseconds = each.unwrap_or_default().as_nanos().saturating_mul(requests.into());
        Duration::from_nanos(u64::try_from(nanoseconds).unwrap_or(u64::MAX))
    }
}

/// Finds the axes, spindles and lists of a target, and chooses the sizes of samples. With
/// [`ClaimsBy::Queries`], also finds its channels and ports. The replies of the target then
/// determine the channels, the absent channel, the axes, the spindles and the edition in
/// `target.profile`. The claims of ports, sections and functions do not change, even if the target
/// lacks them.
pub fn discover(target: &mut TargetState, by: ClaimsBy) -> Discovery {
    let (begun, frames) = (Instant::now(), target.frames);
    let mut probe = Probe::new(target);
    let deadline = probe.target.deadline;
    probe = probe.with_deadline(deadline);
    let mut found = FoundReport::default();
    let ended = find(&mut probe, by, &mut found).err().map(|stop| match stop {
        Stop::NotApplicable(why) | Stop::Inconclusive(why) => why,
        Stop::NotPermitted(why) | Stop::Harness(why) => why,
        Stop::Interrupted => "the run is being interrupted".to_owned(),
        Stop::Judged => "a reply is wrong".to_owned(),
    });
    found.stopped = found.stopped.or(ended);
    found.requests = target.frames.saturating_sub(frames);
    Discovery { found, time: begun.elapsed() }
}

/// Lets the discovery continue after a step that is inconclusive, and stores the first reason.
fn go_on<T>(found: &mut FoundReport, step: Step<T>) -> Step<Option<T>> {
    match step {
        Err(Stop::Inconclusive(why)) => {
            found.stopped.get_or_insert(why);
            Ok(None)
        }
        step => step.map(Some),
    }
}

fn find(probe: &mut Probe<'_>, by: ClaimsBy, found: &mut FoundReport) -> Step {
    if by == ClaimsBy::Queries {
        let found_ports = ports(probe);
        found.ports = go_on(found, found_ports)?.unwrap_or_default();
        let claimed = claim_channels(probe);
        go_on(found, claimed)?;
        let claimed = claim_axes(probe);
        go_on(found, claimed)?;
        let dynamic = has_dynamic_variables(probe);
        if go_on(found, dynamic)? == Some(true) {
            probe.target.profile.edition = Edition::German;
        }
        if probe.target.client.gate().may_let_writes_pass() {
            probe.target.unwritten_places = unwritten_places(probe)?;
        }
    }
    let instances = probe.instances().if_applicable();
    let instances = go_on(found, instances)?.flatten().unwrap_or_default();
    for number in probe.channels()?.into_iter().map(|channel| u32::from(channel.number())) {
        let places = instances.iter().filter(|one| OF_PLACES.contains(&one.class));
        let places = places.filter(|one| one.channel == number).map(|one| one.axis);
        found.channels.push(FoundChannel { number, axes: places.max().unwrap_or_default() });
    }
    let spindles = instances.iter().filter(|one| one.class == Class::Spindle).count();
    found.spindles = to_u32(spindles);
    let profile = &probe.target.profile;
    found.platform_axes = match by {
        ClaimsBy::Queries => profile.platform_axes,
        // `profile.platform_axes` is a claim here, so the highest axis number in the position
        // controller is reported instead.
        ClaimsBy::Profile => controlled_axes(&instances),
    };
    if by == ClaimsBy::Profile {
        found.claimed_axes = Some(profile.platform_axes).filter(|axes| *axes > 0);
        found.claimed_spindles = profile.spindles;
    }
    let channels = u64::try_from(found.channels.len()).unwrap_or_default();
    found.expected = channels.saturating_mul(PER_CHANNEL);
    let lists = Counted::all(probe)?;
    if by == ClaimsBy::Profile {
        let answers = |number: u32| {
            let placed = instances
                .iter()
                .map(|one| ValueList::of_instance(one.class, one.channel, one.axis));
            let mut all = placed.chain(lists.iter().map(|(list, _)| list.list()));
            all.any(|list| list.channel().is_some_and(|channel| u32::from(channel) == number))
        };
        let numbers = found.channels.iter().map(|channel| channel.number);
        found.silent_channels = numbers.filter(|number| !answers(*number)).collect();
    }
    let kinds = lists.iter().filter_map(|(list, items)| Some((list.kind()?, *items)));
    probe.target.sample_sizes = SampleSizes::new(&kinds.collect::<Vec<_>>());
    probe.choose_elements();
    for (list, items) in lists {
        let read = match list.kind() {
            Some(kind) => u32::try_from(probe.sample(kind, 0..items).len()).unwrap_or(items),
            None => items,
        };
        found.expected = found.expected.saturating_add(requests_for(list.kind(), items, read));
        found.lists.push(FoundList { name: list.list().to_string(), items, read });
    }
    Ok(())
}

/// Approximate number of requests that the cases send for a channel, independent of its lists.
const PER_CHANNEL: u64 = 3_400;

/// Approximate number of requests that the cases send for a list with `items` items, of which they
/// read `read`. `tests/library/large.rs` compares the sum with the number of requests sent.
fn requests_for(kind: Option<ItemKind>, items: u32, read: u32) -> u64 {
    let (list, item) = match kind {
        Some(ItemKind::Object) => (0, 13),
        Some(ItemKind::Variable) => (0, 29),
        Some(ItemKind::Element) => (35, 35),
        None => (0, 30),
    };
    // The descriptions of variables outside the sample, up to `VARIABLES_MAX` in total, are read
    // once, to learn their names.
    let names = match kind {
        Some(ItemKind::Variable) => items.min(VARIABLES_MAX).saturating_sub(read),
        _ => 0,
    };
    u64::from(read).saturating_mul(item).saturating_add(list).saturating_add(names.into())
}

/// The ports at which a task replies without an error in the AMS header. Other ports remain
/// claimed, so that a case fails for a missing port.
fn ports(probe: &mut Probe<'_>) -> Step<Vec<u16>> {
    let channel = Channel::new(1)?;
    let mut found_ports = Vec::new();
    for task in [Task::Geo, Task::Sda, Task::Com] {
        let request: Request<'_> = match task {
            Task::Com => CountObjects::new(ObjectList::PLATFORM).into(),
            Task::Sda => CountVariables::new(channel, Kind::ALL).into(),
            Task::Geo => decoder_of(channel).into(),
        };
        let request = RawCall::new(request)?.with(|call| call.port = task.port());
        let answered = probe.call(&request)?.reply().is_some_and(|reply| reply.ams_error.is_ok());
        // A task may reject this query with an error in the AMS header, so ReadDeviceInfo is tried
        // too.
        let answered = answered || {
            let inquired = probe.inquire::<DeviceInfoReply>(task)?;
            matches!(inquired.outcome, Ok(InquiryReply::Reply(_) | InquiryReply::Rejected(_)))
        };
        if answered {
            found_ports.push(task.port().0);
        }
    }
    Ok(found_ports)
}

/// Sends a request of a walk if the profile claims the function of the request. Other requests are
/// not sent, and are treated as rejected.
struct IfClaimed<'p, 's>(&'p mut Probe<'s>);

impl Walker for IfClaimed<'_, '_> {
    type Error = Stop;

    fn request<'r>(&mut self, request: impl Into<Request<'r>>) -> Step<Option<Vec<u8>>> {
        ask_if_claimed(self.0, request)
    }
}

/// Claims the channels that are found, and the lowest number without a channel, if one is found, as
/// the number of an absent channel. If no channel is found, the claims remain unchanged.
fn claim_channels(probe: &mut Probe<'_>) -> Step {
    let (mut absent, mut by_objects) = (None, false);
    let walker = &mut IfClaimed(probe);
    let channels = active_channels(walker, |walker, channel, has_objects| {
        by_objects = has_objects;
        let is_there = is_channel(walker, channel, has_objects)?;
        if !is_there && absent.is_none() {
            absent = Some(channel);
        }
        Ok(is_there)
    })?;
    let Some(last) = channels.last() else { return Ok(()) };
    if absent.is_none()
        && let Ok(next) = Channel::new(u32::from(last.number()).saturating_add(1))
        && !is_channel(walker, next, by_objects)?
    {
        absent = Some(next);
    }
    let numbers: Vec<u32> = channels.iter().map(|channel| channel.number().into()).collect();
    let profile = &mut probe.target.profile;
    profile.channels = numbers.into();
    profile.absent_channel = absent.map(|channel| channel.number().into());
    Ok(())
}

/// Whether a channel exists. If any channel has objects (`has_objects`), this channel must have
/// objects, or both a decoder and variables; otherwise a decoder or variables are sufficient.
fn is_channel(walker: &mut IfClaimed<'_, '_>, channel: Channel, has_objects: bool) -> Step<bool> {
    if has_objects && walker.count_objects(channel)?.is_some() {
        return Ok(true);
    }
    let has_decoder = walker.is_instance(decoder_of(channel))?;
    let has_variables = has_variables(walker, channel)?;
    Ok(if has_objects { has_decoder && has_variables } else { has_decoder || has_variables })
}

/// The highest axis number in the position controller; 0 without an axis.
fn controlled_axes(instances: &[Instance]) -> u32 {
    let all = instances.iter().filter(|one| one.class == Class::PositionController);
    all.map(|one| one.axis).max().unwrap_or_default()
}

/// Claims the spindles that are found, and the larger of the numbers of platform axes in COM and in
/// the position controller.
fn claim_axes(probe: &mut Probe<'_>) -> Step {
    let mut listed = 0_u32;
    for axis in (1..=u32::from(u8::MAX)).map_while(|place| PlatformAxis::new(place).ok()) {
        if IfClaimed(probe).count_objects(axis)?.is_none() {
            break;
        }
        listed = listed.saturating_add(1);
    }
    let instances = probe.instances().if_applicable()?.unwrap_or_default();
    let of = |class| instances.iter().filter(move |one| one.class == class);
    let controlled = controlled_axes(&instances);
    let spindles = u32::try_from(of(Class::Spindle).count()).ok().filter(|count| *count > 0);
    probe.target.profile.platform_axes = listed.max(controlled);
    probe.target.profile.spindles = spindles;
    Ok(())
}

/// The axis indices up to [`PLACES_MAX`] of all channels but the first, each as channel number and
/// axis index. Without a profile, a run treats these indices as possibly without an axis. No list
/// shows which of them have one, and a value that is written at an axis index without an axis may
/// be lost.
fn unwritten_places(probe: &Probe<'_>) -> Step<Vec<(u32, u32)>> {
    let others = probe.channels()?.into_iter().skip(1).map(|channel| u32::from(channel.number()));
    Ok(others.flat_map(|number| (1..=PLACES_MAX).map(move |place| (number, place))).collect())
}
