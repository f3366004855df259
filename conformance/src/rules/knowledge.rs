//! The known state of a CNC, and the context in which an exchange is judged.

use std::collections::BTreeMap;
use std::time::Duration;

use ads_cnc::operation::{Call, Request};
use ads_cnc::streaming::Checker;
use ads_cnc::value::DataType;
use ads_cnc::{Description, Descriptor};

use super::observation::Observation;
use super::topic::{Topic, TopicRecords};
use crate::evidence::Describe;
use crate::judge::{Checks as _, Rule, assumed};

/// The context of the judgement of one exchange.
pub(super) struct ExchangeJudge<'j> {
    pub(super) observation: &'j dyn Observation,
    pub(super) call: &'j Call<'j>,
    pub(super) records: &'j mut TopicRecords,
    pub(super) cnc: &'j mut Knowledge,
    pub(super) budget: &'j mut MemoryBudget,
}

impl ExchangeJudge<'_> {
    /// Records a failed check of a client's request for an index that does not exist according to
    /// an earlier reply. No manual forbids such a request, so the rule is assumed.
    pub(super) fn judge_nonexistent(
        &mut self,
        request: &Request<'_>,
        rule: impl Into<Rule>,
        expected: impl Describe,
        found: impl Describe,
    ) {
        let topic = Topic::of_request(request.function());
        self.records.on(topic, self.observation).check(assumed(rule), false, expected, found);
    }
}

/// The remaining memory for the stored state of all CNCs.
#[derive(Debug)]
pub(super) struct MemoryBudget {
    /// Number of bytes.
    pub(super) left: usize,
    /// Number of entries that were not stored.
    pub(super) missed: u64,
    /// Number of further channels whose NC programs can be checked.
    pub(super) programs: usize,
    /// Number of packets of NC programs that were not checked.
    pub(super) unchecked: u64,
}

impl MemoryBudget {
    pub(super) const ALL: usize = 0x180_0000;
    pub(super) const OF_RUN: usize = 0x40_0000;
    /// Maximum number of channels whose NC programs are checked, because the labels of one program
    /// can need more than 1 MiB.
    pub(super) const PROGRAMS: usize = 32;

    /// Reserves memory for an entry with `bytes` bytes of text and 512 bytes of overhead. Returns
    /// whether enough memory was left.
    pub(super) fn take(&mut self, bytes: usize) -> bool {
        let left = self.left.checked_sub(bytes.saturating_add(512));
        match left {
            Some(left) => self.left = left,
            None => self.missed = self.missed.saturating_add(1),
        }
        left.is_some()
    }

    /// Reserves the memory for the check of the NC programs of a channel. Returns whether the
    /// maximum number of channels was not reached.
    pub(super) fn take_program(&mut self) -> bool {
        let left = self.programs.checked_sub(1);
        self.programs = left.unwrap_or(0);
        left.is_some()
    }
}

/// The state of a CNC as far as observed.
#[derive(Debug, Default)]
pub(super) struct Knowledge {
    pub(super) objects: Objects,
    /// By index group and index offset of the content.
    pub(super) elements: BTreeMap<(u32, u32), ObservedElement>,
    /// The numbers of dynamic parameters, by index group and kind.
    pub(super) parameter_counts: BTreeMap<(u32, String), ObservedCount>,
    pub(super) variables: Variables,
    /// By index group of the channel.
    pub(super) streams: BTreeMap<u32, ObservedProgramStream>,
    /// The Service Interfaces, by index group of the channel.
    pub(super) services: BTreeMap<u32, ObservedInterface>,
    /// Whether the CNC may have received requests before the first observed request.
    pub(super) is_lost: bool,
}

impl Knowledge {
    pub(super) fn new(is_lost: bool) -> Self {
        Self { is_lost, ..Self::default() }
    }
}

/// The objects of a CNC as far as observed.
#[derive(Debug, Default)]
pub(super) struct Objects {
    /// By index group.
    pub(super) lists: BTreeMap<u32, ObservedList>,
    /// By address of the content.
    pub(super) contents: BTreeMap<(u32, u32), ObservedContent>,
}

#[derive(Debug, Default)]
pub(super) struct ObservedList {
    pub(super) count: Option<u32>,
    /// By index: the descriptor, and whether it was read alone.
    pub(super) known: BTreeMap<u32, (Descriptor, bool)>,
    /// By ID of an object: its index.
    pub(super) ids: BTreeMap<u32, u32>,
}

#[derive(Clone, Debug)]
pub(super) struct ObservedContent {
    pub(super) name: String,
    pub(super) size: u32,
    /// Size of the type in bytes; `None` for an unknown type and for a type without a fixed size.
    pub(super) type_size: Option<u32>,
    pub(super) writable: bool,
}

#[derive(Clone, Debug, Default)]
pub(super) struct ObservedElement {
    pub(super) data_type: Option<DataType>,
    pub(super) length: Option<u32>,
    pub(super) writable: Option<bool>,
}

/// The number of parameters of a kind, which a program may change at any time.
#[derive(Debug)]
pub(super) struct ObservedCount {
    pub(super) number: u32,
    /// An index greater than `number` for which a request has succeeded since the number was read.
    pub(super) answered_beyond: Option<u32>,
}

/// The variables of a CNC as far as observed.
#[derive(Debug, Default)]
pub(super) struct Variables {
    /// By index group of the channel.
    pub(super) channels: BTreeMap<u32, ChannelVariables>,
}

#[derive(Debug, Default)]
pub(super) struct ChannelVariables {
    /// By kind: the number of variables. For the empty kind, the sum for V.E, V.G and V.A.
    pub(super) counts: BTreeMap<String, u32>,
    /// By name: the description, and the kind and index with which it was requested.
    pub(super) described: BTreeMap<String, (Description, String, u32)>,
    /// By handle: the name.
    pub(super) handles: BTreeMap<u32, String>,
    /// By name: the first known handle.
    pub(super) names: BTreeMap<String, u32>,
}

#[derive(Debug, Default)]
pub(super) struct ObservedProgramStream {
    /// The packet of the previous write and its time, if known; only if the write was rejected and
    /// the packet has whole lines and at most 992 bytes.
    pub(super) rejected: Option<(Vec<u8>, Option<Duration>)>,
    /// Checks the current program; `None` before the first accepted packet, while packets may be
    /// missing, and after [`MemoryBudget::PROGRAMS`] other channels.
    pub(super) checker: Option<Checker>,
}

/// The state of one channel's interface.
#[derive(Debug, Default)]
pub(super) struct ObservedInterface {
    /// Whether accesses for the current request may be missing.
    pub(super) is_lost: bool,
    /// Whether the service has read REQUEST_STATE != 0, and the UUID.
    pub(super) read_state: bool,
    pub(super) read_id: bool,
    /// Whether the service has written RESPONSE, REQUEST_STATE = 0 and RESPONSE_STATE != 0 for the
    /// current request.
    pub(super) response: bool,
    pub(super) reset: bool,
    pub(super) answered: bool,
    /// Whether a client that acts as the NC program has written UUID and REQUEST.
    pub(super) wrote_id: bool,
    pub(super) wrote_request: bool,
    /// Whether a client that acts as the NC program has written REQUEST_STATE != 0, and no
    /// RESPONSE_STATE was written since.
    pub(super) has_request: bool,
}

/// The variable that a request is about.
#[derive(Clone, Debug)]
pub(crate) struct TargetVariable {
    pub(crate) description: Description,
    /// The indices that select an element; empty for the whole variable.
    pub(crate) indices: Vec<u32>,
}
