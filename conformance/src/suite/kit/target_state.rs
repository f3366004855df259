//! The state of a target during a run, shared by the cases that are run on the target.

use std::collections::{BTreeMap, HashSet};

use ads_cnc::Description;
use ads_cnc::operation::{AdsService, Function};

use crate::client::Client;
use crate::deadline::Deadline;
use crate::evidence::Evidence;
use crate::judge::Record;
use crate::objects::ListedValue;
use crate::profile::Profile;
use crate::rules::RuleBook;
use crate::suite::kit::{Changes, Instance, Sample, SampleSizes};
use crate::text::plural;

/// A connection to a target, the settings of a run, and the data that the run has collected about
/// the target.
#[derive(Debug)]
pub struct TargetState {
    /// The connection.
    pub client: Client,
    /// The claims of the target.
    pub profile: Profile,
    /// Axis indices (each as channel number and axis index) that a run without a profile, if it may
    /// write, treats as possibly without an axis, see
    /// [`Probe::is_blank`](crate::suite::Probe::is_blank). A value that is written at an axis index
    /// without an axis may be lost.
    pub(in crate::suite) unwritten_places: Vec<(u32, u32)>,
    /// Which items of a long list the cases read.
    pub(in crate::suite) sample: Sample,
    /// Maximum number of items that the cases read in each list if they read a sample, by kind of
    /// item.
    pub(in crate::suite) sample_sizes: SampleSizes,
    /// The variables that were counted or described, by the number of the channel and the kind.
    pub(in crate::suite) variables: BTreeMap<(u32, &'static str), DescribedList>,
    /// The objects that the cases read; `None` until they are first needed.
    pub(in crate::suite) objects: Option<Vec<ListedValue>>,
    /// The instances; `None` until they are first needed.
    pub(in crate::suite) instances: Option<Vec<Instance>>,
    /// Number of requests sent, including all attempts to restore values, even if the gate rejects
    /// a request of such an attempt.
    pub frames: usize,
    /// Services to which the target has sent a valid reply.
    pub(in crate::suite) answered: Vec<AdsService>,
    /// The functions for which the target accepts the number of a channel, but has returned no
    /// success for its equal rank. The target is taken to lack their groups without the bit for
    /// logical addressing.
    /// ADR-12
    pub(in crate::suite) without_index_groups: HashSet<Function>,
    /// Whether any reply to a Read, Write or ReadWrite was a success, not counting requests that
    /// restore values after a change.
    pub(in crate::suite) any_success: bool,
    /// The last error reply that contained data.
    pub(in crate::suite) error_with_data: Option<Evidence>,
    /// Number of consecutive requests without a reply, up to now, not counting requests that
    /// restore values after a change.
    pub(in crate::suite) silences: usize,
    /// Why only requests that restore values are sent from now on, because the target no longer
    /// answers; `None` while it answers.
    pub(in crate::suite) disconnect_reason: Option<String>,
    /// A text with the case in which the target stopped answering, the number of requests until
    /// then, and the reason.
    pub(in crate::suite) ended: Option<String>,
    /// Number of further failed cases after which the remaining cases are not run, except those
    /// that judge frames; `None` for no limit.
    pub(in crate::suite) failures_left: Option<usize>,
    /// Violations in received frames, found by the client.
    /// ADS-1 to ADS-5, ADS-8, ADS-9
    pub(in crate::suite) broken: Record,
    /// The checks of the valid replies without a violation to requests that
    /// [`Probe::call`](crate::suite::Probe::call) sends, and what these replies have shown about
    /// the target.
    pub(in crate::suite) rules: RuleBook,
    /// The deadline of the run. After it, only requests that restore values are sent.
    pub(in crate::suite) deadline: Option<Deadline>,
    /// How the target rejects the requests of [`rejects`](crate::suite::Probe::rejects).
    pub(in crate::suite) rejections: Rejections,
    /// Values that cases have changed and not restored.
    pub(in crate::suite) changes: Changes,
}

/// The variables of a kind in a channel.
#[derive(Clone, Debug, Default)]
pub(crate) struct DescribedList {
    /// The number of variables according to the target.
    pub(crate) count: u32,
    /// The descriptions that were read, by index; `None` if the name of the variable is too long
    /// for a request.
    pub(crate) read: BTreeMap<u32, Option<Description>>,
    /// Approximate number of bytes of the descriptions that were read.
    pub(crate) bytes: usize,
}

/// How a target rejects the requests of [`Probe::rejects`](crate::suite::Probe::rejects) whose
/// `sibling` has succeeded.
#[derive(Debug, Default)]
pub(in crate::suite) struct Rejections {
    /// Number of rejections with an error number, in the AMS header or in the service.
    pub(in crate::suite) by_number: usize,
    /// Failed checks of replies that are successes without data, although a rule of the level
    /// *must* requires a rejection.
    pub(in crate::suite) by_nothing: Record,
}

impl TargetState {
    /// The initial state for a connection.
    pub fn new(client: Client, profile: Profile) -> Self {
        Self {
            client,
            profile,
            unwritten_places: Vec::new(),
            sample: Sample::All,
            sample_sizes: SampleSizes::DEFAULT,
            variables: BTreeMap::new(),
            objects: None,
            instances: None,
            frames: 0,
            answered: Vec::new(),
            without_index_groups: HashSet::new(),
            any_success: false,
            error_with_data: None,
            silences: 0,
            disconnect_reason: None,
            ended: None,
            failures_left: None,
            broken: Record::default(),
            rules: RuleBook::of_run(),
            deadline: None,
            rejections: Rejections::default(),
            changes: Changes::default(),
        }
    }

    /// Sets which items of a long list the cases read.
    #[must_use]
    pub fn with_sample(self, sample: Sample) -> Self {
        Self { sample, ..self }
    }

    /// Sets the list of changed values. The caller keeps a clone to read it in other threads.
    #[must_use]
    pub fn with_changes(self, changes: Changes) -> Self {
        Self { changes, ..self }
    }

    /// The values that cases have changed and not restored.
    pub const fn changes(&self) -> &Changes {
        &self.changes
    }

    /// Sets the number of failed cases after which the remaining cases are not run, except those
    /// that judge frames.
    pub const fn stop_after(&mut self, failures: usize) {
        self.failures_left = Some(failures);
    }

    /// If the target stopped answering, a text with the case in which it stopped, the number of
    /// requests until then, and the reason.
    pub fn ended(&self) -> Option<&str> {
        self.ended.as_deref()
    }

    /// If the target no longer answers, stores the text for [`ended`](Self::ended), unless it is
    /// already stored for an earlier case.
    pub(in crate::suite) fn end_in(&mut self, case: &str) {
        if let (Some(why), None) = (&self.disconnect_reason, &self.ended) {
            let requests = plural(self.frames, "request");
            let ended = format!("the target stopped answering in {case}, after {requests}: {why}");
            self.ended = Some(ended);
        }
    }

    /// Sets a deadline after which only requests that restore values are sent.
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { deadline: Some(deadline), ..self }
    }
}
