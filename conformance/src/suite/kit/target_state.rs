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

/// A connection to a target, and the data that the cases of a run have collected about the target.
#[derive(Debug)]
pub struct TargetState {
    /// The connection.
    pub client: Client,
    /// The claims of the target.
    pub profile: Profile,
    /// Axis indices (each as channel and axis index) at which the run does not write. Without a
    /// profile, it is unknown whether they have an axis, and a value that is written without an
    /// axis is lost.
    pub(in crate::suite) unwritten_places: Vec<(u32, u32)>,
    /// Which items of a long list the cases read.
    pub(in crate::suite) sample: Sample,
    /// Maximum number of items that the cases read in each list of a sample, by kind of item.
    pub(in crate::suite) sample_sizes: SampleSizes,
    /// Descriptions of variables, by the number of the channel and the kind.
    pub(in crate::suite) variables: BTreeMap<(u32, &'static str), DescribedList>,
    /// The objects, read when a case first needs them.
    pub(in crate::suite) objects: Option<Vec<ListedValue>>,
    /// The instances, read when a case first needs them.
    pub(in crate::suite) instances: Option<Vec<Instance>>,
    /// Number of requests sent.
    pub frames: usize,
    /// Services to which the target has replied.
    pub(in crate::suite) answered: Vec<AdsService>,
    /// The functions that the target rejects for the rank of a channel whose rank equals its
    /// number, although it accepts the number: the target lacks the groups without the bit for
    /// logical addressing (ADR-12).
    pub(in crate::suite) without_index_groups: HashSet<Function>,
    /// Whether any reply was a success.
    pub(in crate::suite) any_success: bool,
    /// The last error reply that contained data.
    pub(in crate::suite) error_with_data: Option<Evidence>,
    /// Number of consecutive requests without a reply, up to now.
    pub(in crate::suite) silences: usize,
    /// The reason why the target counts as no longer answering, after which only requests that
    /// restore values are sent; `None` while the target answers.
    pub(in crate::suite) disconnect_reason: Option<String>,
    /// The text that names the case in which the target stopped answering, and the number of requests.
    pub(in crate::suite) ended: Option<String>,
    /// Number of further failed cases after which the remaining cases are not run; `None` for no limit.
    pub(in crate::suite) failures_left: Option<usize>,
    /// Violations of ADS-1 to ADS-5 in received frames, found by the client.
    pub(in crate::suite) broken: Record,
    /// The checks of all replies.
    pub(in crate::suite) rules: RuleBook,
    /// The deadline of the run. After it, only requests that restore values are sent.
    pub(in crate::suite) deadline: Option<Deadline>,
    /// How the target rejects requests that must be rejected.
    pub(in crate::suite) rejections: Rejections,
    /// Values that are changed at the moment.
    pub(in crate::suite) changes: Changes,
}

/// How a target rejects requests.
#[derive(Debug, Default)]
pub(in crate::suite) struct Rejections {
    /// Number of rejections with an error number, in the AMS header or in the service.
    pub(in crate::suite) by_number: usize,
    /// Failed checks of replies that are successes without data, in place of an error number.
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

    /// Sets the list of changed values, of which the caller keeps a clone to read it in other
    /// threads.
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

    /// If the target no longer answers, stores the case in which this was found; the first such
    /// case remains stored.
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
