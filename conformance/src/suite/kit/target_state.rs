//! The state of a target during a run, shared by all cases.

use std::collections::{BTreeMap, HashSet};

use ads_cnc::operation::{AdsService, Function};

use crate::client::Client;
use crate::deadline::Deadline;
use crate::evidence::Evidence;
use crate::judge::Record;
use crate::objects::ListedValue;
use crate::profile::Profile;
use crate::rules::RuleBook;
use crate::suite::kit::{Changes, DescribedList, Instance, Sample, SampleSizes};
use crate::text::plural;

/// A connection to a target, and what the cases of a run have found about it.
#[derive(Debug)]
pub struct TargetState {
    /// The connection.
    pub client: Client,
    /// The claims of the target.
    pub profile: Profile,
    /// Axis places (channel and place) to which the run does not write. Without a profile, it is unknown
    /// whether they have an axis, and a value written to a place without an axis is lost.
    pub(in crate::suite) unwritten_places: Vec<(u32, u32)>,
    /// Which items of a long list the cases read.
    pub(in crate::suite) sample: Sample,
    /// Maximum number of items of a long list that the cases read.
    pub(in crate::suite) sample_sizes: SampleSizes,
    /// Descriptions of the variables of each kind and channel.
    pub(in crate::suite) variables: BTreeMap<(u32, &'static str), DescribedList>,
    /// The objects, read when a case first needs them.
    pub(in crate::suite) objects: Option<Vec<ListedValue>>,
    /// The instances, read when a case first needs them.
    pub(in crate::suite) instances: Option<Vec<Instance>>,
    /// Number of requests sent.
    pub frames: usize,
    /// Services to which the target has replied.
    pub(in crate::suite) answered: Vec<AdsService>,
    /// The functions that the target rejects for the index of a channel, although it accepts the logical
    /// number, and both are equal: the target lacks the groups for indices (ADR-12).
    pub(in crate::suite) without_index_groups: HashSet<Function>,
    /// Whether any reply was a success.
    pub(in crate::suite) any_success: bool,
    /// The last error reply that contained data.
    pub(in crate::suite) error_with_data: Option<Evidence>,
    /// Consecutive requests without a reply.
    pub(in crate::suite) silences: usize,
    /// Why no more requests are sent.
    pub(in crate::suite) disconnect_reason: Option<String>,
    /// The text that names the case in which the target stopped answering, and the number of requests.
    pub(in crate::suite) ended: Option<String>,
    /// Number of further failed cases after which the remaining cases are not run; `None` for no limit.
    pub(in crate::suite) failures_left: Option<usize>,
    /// Violations of the rules for frame headers.
    pub(in crate::suite) broken: Record,
    /// The checks of all replies.
    pub(in crate::suite) rules: RuleBook,
    /// The deadline of the run; a case that has begun to write is completed after it.
    pub(in crate::suite) deadline: Option<Deadline>,
    /// The replies to requests that must be rejected.
    pub(in crate::suite) rejections: Rejections,
    /// Values that are changed at the moment.
    pub(in crate::suite) changes: Changes,
}

/// How a target rejects requests.
#[derive(Debug, Default)]
pub(in crate::suite) struct Rejections {
    /// Number of rejections with an error number, in the AMS header or in the service.
    pub(in crate::suite) by_number: usize,
    /// Checks of successes without data.
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

    /// Shares the list of changed values with other threads.
    #[must_use]
    pub fn with_changes(self, changes: Changes) -> Self {
        Self { changes, ..self }
    }

    /// The values that are changed at the moment.
    pub const fn changes(&self) -> &Changes {
        &self.changes
    }

    /// Sets the number of failed cases after which the remaining cases are not run.
    pub const fn stop_after(&mut self, failures: usize) {
        self.failures_left = Some(failures);
    }

    /// Why no more requests were sent to the target, if it stopped answering.
    pub fn ended(&self) -> Option<&str> {
        self.ended.as_deref()
    }

    /// Notes the case in which the target stopped answering.
    pub(in crate::suite) fn end_in(&mut self, case: &str) {
        if let (Some(why), None) = (&self.disconnect_reason, &self.ended) {
            let requests = plural(self.frames, "request");
            let ended = format!("the target stopped answering in {case}, after {requests}: {why}");
            self.ended = Some(ended);
        }
    }

    /// Sets a deadline after which no more requests are sent.
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { deadline: Some(deadline), ..self }
    }
}
