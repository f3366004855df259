//! The state of a target during a run, which all cases share.

use std::collections::BTreeMap;
use std::sync::Arc;

use ads_cnc::Description;
use ads_cnc::operation::Service;

use crate::client::Client;
use crate::deadline::Deadline;
use crate::judge::Record;
use crate::objects::Object;
use crate::profile::Profile;
use crate::simulator::Cnc;
use crate::suite::kit::{Changes, Instance};

/// A connection to a target, and the state that the cases of a run have found so far.
#[derive(Debug)]
pub struct TargetState {
    /// The connection.
    pub client: Client,
    /// What the target claims.
    pub profile: Profile,
    /// Descriptions of the variables of each kind and channel.
    pub(in crate::suite) variables: BTreeMap<(u32, &'static str), Vec<Description>>,
    /// Its objects, read when a case first needs them.
    pub(in crate::suite) objects: Option<Vec<Object>>,
    /// Its instances, read when a case first needs them.
    pub(in crate::suite) instances: Option<Vec<Instance>>,
    /// The CNC itself, if it is in this process.
    pub(in crate::suite) cnc: Option<Arc<Cnc>>,
    /// Requests sent.
    pub frames: usize,
    /// Services that were answered.
    pub(in crate::suite) answered: Vec<Service>,
    /// Requests in a row that were not.
    pub(in crate::suite) silences: usize,
    /// Why nothing more is to be had of the target.
    pub(in crate::suite) gone: Option<String>,
    /// What frames themselves broke.
    pub(in crate::suite) broken: Record,
    /// After which only cases that write come to their end.
    pub(in crate::suite) deadline: Option<Deadline>,
    /// What came of requests that had to be refused.
    pub(in crate::suite) refusals: Refusals,
    /// Values that are not as they were.
    pub(in crate::suite) changes: Changes,
}

/// How a target refuses.
#[derive(Debug, Default)]
pub(in crate::suite) struct Refusals {
    /// By an error number, in whichever header.
    pub(in crate::suite) by_number: usize,
    /// By a success without data.
    pub(in crate::suite) by_nothing: Record,
}

impl TargetState {
    /// The state at the start, over a connection.
    pub fn new(client: Client, profile: Profile) -> Self {
        Self {
            client,
            profile,
            variables: BTreeMap::new(),
            objects: None,
            instances: None,
            cnc: None,
            frames: 0,
            answered: Vec::new(),
            silences: 0,
            gone: None,
            broken: Record::default(),
            deadline: None,
            refusals: Refusals::default(),
            changes: Changes::default(),
        }
    }

    /// With a list of what is changed that others look at too.
    #[must_use]
    pub fn with_changes(self, changes: Changes) -> Self {
        Self { changes, ..self }
    }

    /// What is not as it was.
    pub const fn changes(&self) -> &Changes {
        &self.changes
    }

    /// With a moment after which nothing more is asked for.
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { deadline: Some(deadline), ..self }
    }

    /// With the CNC that is asked, as it is in this process: some cases do to it from within what
    /// a machine or an NC program does.
    #[must_use]
    pub fn with_cnc(self, cnc: Arc<Cnc>) -> Self {
        Self { cnc: Some(cnc), ..self }
    }
}
