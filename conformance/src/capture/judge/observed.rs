//! What is known of one CNC, and what a judgement of an exchange with it needs.

use std::collections::BTreeMap;
use std::fmt;

use ads_cnc::streaming::Checker;
use ads_cnc::value::DataType;
use ads_cnc::{Description, Descriptor};

use crate::capture::findings::TopicRecords;
use crate::capture::tally::count;
use crate::capture::time::Time;

/// What a judgement of one exchange needs.
pub(super) struct Bench<'j> {
    pub(super) records: &'j mut TopicRecords,
    pub(super) cnc: &'j mut ObservedCnc,
    pub(super) room: &'j mut Room,
}

/// Memory for the names, objects and elements of all CNCs.
#[derive(Debug)]
pub(super) struct Room {
    pub(super) left: usize,
    /// How many were not kept.
    pub(super) missed: u64,
}

impl Room {
    pub(super) const ALL: usize = 0x180_0000;

    /// Whether there is room for one more of this size, beside what each takes.
    pub(super) fn take(&mut self, bytes: usize) -> bool {
        let left = self.left.checked_sub(bytes.saturating_add(512));
        match left {
            Some(left) => self.left = left,
            None => count(&mut self.missed),
        }
        left.is_some()
    }
}

/// What is known of one CNC.
#[derive(Debug, Default)]
pub(super) struct ObservedCnc {
    pub(super) objects: Objects,
    pub(super) elements: ObservedElements,
    pub(super) parameters: ObservedParameters,
    pub(super) variables: Variables,
    pub(super) streams: Streams,
    pub(super) services: Services,
}

impl ObservedCnc {
    /// Of a CNC that may have been sent requests before the capture began.
    pub(super) fn new(is_lost: bool) -> Self {
        Self { streams: Streams::new(is_lost), services: Services::new(is_lost), ..Self::default() }
    }
}

/// What is known of the objects of a CNC.
#[derive(Debug, Default)]
pub(super) struct Objects {
    /// By the index group of the list.
    pub(super) lists: BTreeMap<u32, ObservedList>,
    /// By the address of the content.
    pub(super) contents: BTreeMap<(u32, u32), ObservedContent>,
}

#[derive(Debug, Default)]
pub(super) struct ObservedList {
    pub(super) count: Option<u32>,
    /// By index: the descriptor, and whether it was read alone.
    pub(super) known: BTreeMap<u32, (Descriptor, bool)>,
    pub(super) ids: BTreeMap<u32, u32>,
}

#[derive(Clone, Debug)]
pub(super) struct ObservedContent {
    pub(super) name: String,
    pub(super) size: u32,
    /// Bytes of its type, if it has a fixed size.
    pub(super) type_size: Option<u32>,
    pub(super) writable: bool,
}

/// What is known of the elements of a CNC.
#[derive(Debug, Default)]
pub(super) struct ObservedElements {
    /// By the group of the content, and the offset.
    pub(super) known: BTreeMap<(u32, u32), ObservedElement>,
}

#[derive(Clone, Debug, Default)]
pub(super) struct ObservedElement {
    pub(super) data_type: Option<DataType>,
    pub(super) length: Option<u32>,
    pub(super) writable: Option<bool>,
}

/// What is known of the dynamic parameters of a CNC.
#[derive(Debug, Default)]
pub(super) struct ObservedParameters {
    /// By index group and kind.
    pub(super) counts: BTreeMap<(u32, String), u32>,
}

/// What is known of the variables of a CNC.
#[derive(Debug, Default)]
pub(super) struct Variables {
    /// By the index group of the channel.
    pub(super) channels: BTreeMap<u32, ChannelVariables>,
}

#[derive(Debug, Default)]
pub(super) struct ChannelVariables {
    /// By kind; that of no kind is the sum.
    pub(super) counts: BTreeMap<String, u32>,
    /// By name: with the kind and index it was described at.
    pub(super) described: BTreeMap<String, (Description, String, u32)>,
    pub(super) handles: BTreeMap<u32, String>,
    /// The first handle of each name.
    pub(super) names: BTreeMap<String, u32>,
}

/// What is known of the streams of a CNC, by the index group of the channel.
#[derive(Debug, Default)]
pub(super) struct Streams {
    pub(super) known: BTreeMap<u32, ObservedStream>,
    /// Whether what was written before may not have been captured.
    pub(super) is_lost: bool,
}

impl Streams {
    pub(super) const fn new(is_lost: bool) -> Self {
        Self { known: BTreeMap::new(), is_lost }
    }
}

#[derive(Default)]
pub(super) struct ObservedStream {
    /// What was refused last, and when.
    pub(super) refused: Option<(Vec<u8>, Option<Time>)>,
    /// What is wrong with the program so far; none while its beginning is not known.
    pub(super) checker: Option<Checker>,
}

impl fmt::Debug for ObservedStream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ObservedStream").field("refused", &self.refused).finish_non_exhaustive()
    }
}

/// What is known of the Service Interface of each channel, by its index group.
#[derive(Debug, Default)]
pub(super) struct Services {
    pub(super) known: BTreeMap<u32, ObservedInterface>,
    /// Whether requests before may not have been captured.
    pub(super) is_lost: bool,
}

impl Services {
    pub(super) const fn new(is_lost: bool) -> Self {
        Self { known: BTreeMap::new(), is_lost }
    }
}

/// One channel's, as a client left it.
#[derive(Debug, Default)]
pub(super) struct ObservedInterface {
    /// More may have been read and written than was captured, for what is asked now.
    pub(super) is_lost: bool,
    /// A service has read that it is asked, and who is.
    pub(super) read_state: bool,
    pub(super) read_id: bool,
    /// The response, REQUEST_STATE = 0 and RESPONSE_STATE were written for what is asked now.
    pub(super) response: bool,
    pub(super) reset: bool,
    pub(super) answered: bool,
    /// A client that plays the program has written these.
    pub(super) wrote_id: bool,
    pub(super) wrote_request: bool,
    /// REQUEST_STATE was written last, and nothing of the answer since.
    pub(super) asked: bool,
}
