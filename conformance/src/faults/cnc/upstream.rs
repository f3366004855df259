//! The CNC without the defect, and the memory of a defect.

use std::sync::{Mutex, MutexGuard};

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::{AdsService, Call, Function};

use super::ReplyData;
use super::request::{at, group, is, offset};
use crate::mutex::lock;
use crate::simulator::Cnc;

/// The CNC without the defect, and the memory of the defect.
pub(crate) struct Upstream<'a> {
    pub(super) cnc: &'a Cnc,
    pub(super) memory: &'a Mutex<Memory>,
}

/// The key of stored bytes, such as an index group, an index offset and a name. Each defect chooses
/// its own keys.
pub(in crate::faults) type Key = (u32, u32, Vec<u8>);

/// The memory of a defect between requests.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    /// A number that the defect keeps, such as a count of requests or the handle of an earlier
    /// request.
    pub(in crate::faults) count: u32,
    /// Bytes that the defect stored, with their keys.
    stored: Vec<(Key, Vec<u8>)>,
    /// Requests whose execution the defect delays.
    pub(in crate::faults) later: Vec<DelayedRequest>,
    /// A response frame that the defect delays, or an AMS address of an earlier response.
    pub(in crate::faults) frame: Vec<u8>,
}

/// A delayed request.
#[derive(Clone, Debug)]
pub(in crate::faults) struct DelayedRequest {
    port: AmsPort,
    service: AdsService,
    group: u32,
    offset: u32,
    data: Vec<u8>,
}

impl Memory {
    pub(in crate::faults) fn get(&self, key: &Key) -> Option<Vec<u8>> {
        self.stored.iter().find(|(known, _)| known == key).map(|(_, bytes)| bytes.clone())
    }

    pub(in crate::faults) fn forget(&mut self) {
        self.stored.clear();
    }

    pub(in crate::faults) fn store(&mut self, key: Key, bytes: Vec<u8>) {
        self.stored.retain(|(known, _)| *known != key);
        self.stored.push((key, bytes));
    }
}

impl Upstream<'_> {
    /// The correct reply.
    pub(in crate::faults) fn answer(&self, call: &Call<'_>) -> ReplyData {
        self.cnc.answer(call)
    }

    /// The correct reply to the same request at another address.
    pub(in crate::faults) fn at(&self, call: &Call<'_>, group: u32, offset: u32) -> ReplyData {
        self.answer(&at(call, group, offset))
    }

    /// The correct reply to the same request with other data.
    pub(in crate::faults) fn with(&self, call: &Call<'_>, data: &[u8]) -> ReplyData {
        self.answer(&Call { data, ..*call })
    }

    /// The correct reply to the same request with the maximum read length.
    pub(in crate::faults) fn whole(&self, call: &Call<'_>) -> ReplyData {
        self.answer(&Call { read_length: u32::MAX, ..*call })
    }

    /// The correct reply of SDA to a ReadWrite with this data.
    pub(in crate::faults) fn ask(&self, group: u32, offset: u32, data: &[u8]) -> ReplyData {
        self.answer(&Call {
            port: AmsPort::SDA,
            service: AdsService::ReadWrite,
            index_group: IndexGroup::new(group),
            index_offset: IndexOffset::new(offset),
            read_length: u32::MAX,
            data,
        })
    }

    /// The correct reply of the task with this AMS port to a Read.
    pub(in crate::faults) fn read(&self, port: AmsPort, group: u32, offset: u32) -> ReplyData {
        self.answer(&Call {
            port,
            service: AdsService::Read,
            index_group: IndexGroup::new(group),
            index_offset: IndexOffset::new(offset),
            read_length: u32::MAX,
            data: &[],
        })
    }

    /// The correct reply to a delayed request.
    pub(in crate::faults) fn late(&self, later: &DelayedRequest) -> ReplyData {
        self.answer(&Call {
            port: later.port,
            service: later.service,
            index_group: IndexGroup::new(later.group),
            index_offset: IndexOffset::new(later.offset),
            read_length: 0,
            data: &later.data,
        })
    }

    pub(in crate::faults) fn memory(&self) -> MutexGuard<'_, Memory> {
        lock(self.memory)
    }

    /// The numbers of the CNC's channels.
    pub(in crate::faults) fn channels(&self) -> Vec<u8> {
        self.cnc.model().channels().collect()
    }
}

/// A delayed copy of the request.
pub(in crate::faults) fn later(call: &Call<'_>) -> DelayedRequest {
    DelayedRequest {
        port: call.port,
        service: call.service,
        group: group(call),
        offset: offset(call),
        data: call.data.to_vec(),
    }
}

/// Stores a write, executes the write that the previous call stored, and replies with success.
pub(in crate::faults) fn delay_write(cnc: &Upstream<'_>, call: &Call<'_>) -> ReplyData {
    let before = std::mem::replace(&mut cnc.memory().later, vec![later(call)]);
    before.iter().for_each(|one| _ = cnc.late(one));
    Ok(Vec::new())
}

/// The reply; the error `INVALID_SIZE` if the reply is longer than the read length.
pub(in crate::faults) fn within_length(call: &Call<'_>, answer: ReplyData) -> ReplyData {
    answer.and_then(|bytes| {
        if u32::try_from(bytes.len()).is_ok_and(|len| len <= call.read_length) {
            Ok(bytes)
        } else {
            Err(AdsError::INVALID_SIZE)
        }
    })
}

/// The correct reply, changed by `other`.
pub(in crate::faults) fn changed(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    other: impl FnOnce(&mut Vec<u8>),
) -> ReplyData {
    let mut bytes = cnc.answer(call)?;
    other(&mut bytes);
    Ok(bytes)
}

/// The reply, changed by `other` if the call requests one of these functions; the error
/// `INVALID_SIZE` if the changed reply is longer than the read length.
pub(in crate::faults) fn reply(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    of: &[Function],
    other: impl FnOnce(&mut Vec<u8>),
) -> ReplyData {
    if is(call, of) {
        let mut bytes = cnc.whole(call)?;
        other(&mut bytes);
        within_length(call, Ok(bytes))
    } else {
        cnc.answer(call)
    }
}

/// The reply; success without data if the reply is this error.
pub(in crate::faults) fn forgiven(answer: ReplyData, error: AdsError) -> ReplyData {
    if answer == Err(error) { Ok(Vec::new()) } else { answer }
}

/// The changed reply `answer`; the correct reply if `answer` is longer than the read length or an
/// error.
pub(in crate::faults) fn or_short(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    answer: ReplyData,
) -> ReplyData {
    within_length(call, answer).or_else(|_| cnc.answer(call))
}
