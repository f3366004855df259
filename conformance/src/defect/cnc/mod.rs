//! What a CNC can get wrong: how it answers is changed around the simulated one.

mod across;
mod address;
mod ads;
mod area;
mod axis;
mod border;
mod code;
mod com;
mod content;
mod crossed;
mod device;
mod dynamic;
mod element;
mod frame;
mod handle;
mod indices;
mod instance;
mod lasting;
mod look;
mod name;
mod neighbour;
mod number;
mod object;
mod program;
mod repeated;
mod running;
mod seldom;
mod service;
mod value;
mod variable;
mod write;

pub(in crate::defect) use crate::values::until_nul as text;
pub(in crate::defect) use frame::measured;

use std::fmt;
use std::sync::{Mutex, MutexGuard, PoisonError};

use ads_cnc::address::{ClassGroup, ComGroup, Group, IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsPort, FrameRef};
use ads_cnc::edition::Edition;
use ads_cnc::operation::{Call, Function, Service};

use crate::cnc::Cnc;
use crate::cnc::program::Habit;

/// Data, or the error number.
pub(super) type Answer = Result<Vec<u8>, AdsError>;

/// How a CNC does something wrong, or otherwise.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Twist {
    /// Around each request.
    Answer(fn(&Right<'_>, &Call<'_>) -> Answer),
    /// Behind each frame that answers one: what is sent in its place.
    Frame(fn(&Right<'_>, &FrameRef<'_>, Vec<u8>) -> Vec<u8>),
    /// Bytes leave in pieces of so many at most.
    Pieces(usize),
    /// In its NC programs.
    Program(Habit),
    /// It is another CNC: one with this model.
    Model(&'static str),
}

/// A row of the tables of defects.
pub(super) struct Row {
    pub(super) id: &'static str,
    pub(super) breaks: &'static [&'static str],
    pub(super) what: &'static str,
    pub(super) twist: Twist,
    /// The edition it shows in, if it does not in any.
    pub(super) edition: Option<Edition>,
    /// Whether printed examples are answered as printed, as far as it is about.
    pub(super) printed: bool,
}

/// A row about requests.
pub(super) const fn row(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    answer: fn(&Right<'_>, &Call<'_>) -> Answer,
) -> Row {
    twisted(id, breaks, what, Twist::Answer(answer))
}

/// A row about something else.
pub(super) const fn twisted(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    twist: Twist,
) -> Row {
    Row { id, breaks, what, twist, edition: None, printed: true }
}

/// A row about the NC program.
pub(super) const fn habit(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    habit: Habit,
) -> Row {
    twisted(id, breaks, what, Twist::Program(habit))
}

/// All rows.
pub(super) fn rows() -> impl Iterator<Item = &'static Row> {
    let areas: [&'static [Row]; 30] = [
        across::ROWS,
        address::ROWS,
        ads::ROWS,
        area::ROWS,
        axis::ROWS,
        border::ROWS,
        code::ROWS,
        com::ROWS,
        content::ROWS,
        crossed::ROWS,
        device::ROWS,
        dynamic::ROWS,
        element::ROWS,
        frame::ROWS,
        handle::ROWS,
        indices::ROWS,
        instance::ROWS,
        lasting::ROWS,
        name::ROWS,
        neighbour::ROWS,
        number::ROWS,
        object::ROWS,
        program::ROWS,
        repeated::ROWS,
        running::ROWS,
        seldom::ROWS,
        service::ROWS,
        value::ROWS,
        variable::ROWS,
        write::ROWS,
    ];
    areas.into_iter().flatten()
}

/// The CNC without the defect, and what the defect has kept in mind.
pub(crate) struct Right<'a> {
    cnc: &'a Cnc,
    memory: &'a Mutex<Memory>,
}

/// An address and a name.
pub(super) type Key = (u32, u32, Vec<u8>);

/// What a defect keeps in mind.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    pub(super) count: u32,
    /// Bytes under an address and a name.
    kept: Vec<(Key, Vec<u8>)>,
    /// Requests that were put off.
    pub(super) later: Vec<Later>,
    /// A frame that was put off.
    pub(super) frame: Vec<u8>,
}

/// A request that was put off.
#[derive(Clone, Debug)]
pub(super) struct Later {
    port: AmsPort,
    service: Service,
    group: u32,
    offset: u32,
    data: Vec<u8>,
}

impl Memory {
    pub(super) fn get(&self, key: &Key) -> Option<Vec<u8>> {
        self.kept.iter().find(|(known, _)| known == key).map(|(_, bytes)| bytes.clone())
    }

    pub(super) fn forget(&mut self) {
        self.kept.clear();
    }

    pub(super) fn keep(&mut self, key: Key, bytes: Vec<u8>) {
        self.kept.retain(|(known, _)| *known != key);
        self.kept.push((key, bytes));
    }
}

impl<'a> Right<'a> {
    pub(crate) const fn new(cnc: &'a Cnc, memory: &'a Mutex<Memory>) -> Self {
        Self { cnc, memory }
    }

    /// The right answer.
    pub(super) fn answer(&self, call: &Call<'_>) -> Answer {
        self.cnc.answer_right(call)
    }

    /// The right answer at another address.
    pub(super) fn at(&self, call: &Call<'_>, group: u32, offset: u32) -> Answer {
        self.answer(&at(call, group, offset))
    }

    /// The right answer to other data.
    pub(super) fn with(&self, call: &Call<'_>, data: &[u8]) -> Answer {
        self.answer(&Call { data, ..*call })
    }

    /// The right answer, however long it is.
    pub(super) fn whole(&self, call: &Call<'_>) -> Answer {
        self.answer(&Call { read_length: u32::MAX, ..*call })
    }

    /// The right answer of SDA to a name or the like.
    pub(super) fn ask(&self, group: u32, offset: u32, data: &[u8]) -> Answer {
        self.answer(&Call {
            port: AmsPort::SDA,
            service: Service::ReadWrite,
            index_group: IndexGroup::new(group),
            index_offset: IndexOffset::new(offset),
            read_length: u32::MAX,
            data,
        })
    }

    /// The right answer of this task to a Read.
    pub(super) fn read(&self, port: AmsPort, group: u32, offset: u32) -> Answer {
        self.answer(&Call {
            port,
            service: Service::Read,
            index_group: IndexGroup::new(group),
            index_offset: IndexOffset::new(offset),
            read_length: u32::MAX,
            data: &[],
        })
    }

    /// The right answer to what was put off.
    pub(super) fn late(&self, later: &Later) -> Answer {
        self.answer(&Call {
            port: later.port,
            service: later.service,
            index_group: IndexGroup::new(later.group),
            index_offset: IndexOffset::new(later.offset),
            read_length: 0,
            data: &later.data,
        })
    }

    pub(super) fn memory(&self) -> MutexGuard<'_, Memory> {
        // Whole whatever happened.
        self.memory.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The numbers of its channels.
    pub(super) fn channels(&self) -> Vec<u8> {
        self.cnc.model().channels().collect()
    }
}

impl fmt::Debug for Right<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Right")
    }
}

/// The request, kept.
pub(super) fn later(call: &Call<'_>) -> Later {
    Later {
        port: call.port,
        service: call.service,
        group: group(call),
        offset: offset(call),
        data: call.data.to_vec(),
    }
}

/// The same request at another address.
pub(super) fn at<'c>(call: &Call<'c>, group: u32, offset: u32) -> Call<'c> {
    let (index_group, index_offset) = (IndexGroup::new(group), IndexOffset::new(offset));
    Call { index_group, index_offset, ..*call }
}

pub(super) const fn group(call: &Call<'_>) -> u32 {
    call.index_group.get()
}

pub(super) const fn offset(call: &Call<'_>) -> u32 {
    call.index_offset.get()
}

/// The bit of logical addressing.
pub(super) const LOGICAL: u32 = 0x10_0000;

/// Which function is asked, if any is.
pub(super) fn function(call: &Call<'_>) -> Option<Function> {
    call.dispatch().ok().map(|request| request.function())
}

pub(super) fn is(call: &Call<'_>, functions: &[Function]) -> bool {
    function(call).is_some_and(|function| functions.contains(&function))
}

/// The group, if it is one of SDA and GEO.
pub(super) fn class(call: &Call<'_>) -> Option<ClassGroup> {
    match call.index_group.parts() {
        Some(Group::Class(class)) => Some(class),
        _ => None,
    }
}

/// The group, if it is one of COM.
pub(super) fn com_group(call: &Call<'_>) -> Option<ComGroup> {
    match call.index_group.parts() {
        Some(Group::Com(com)) => Some(com),
        _ => None,
    }
}

/// The UNS32 at a place.
pub(super) fn u32_at(bytes: &[u8], place: usize) -> Option<u32> {
    let four = bytes.get(place..)?.first_chunk::<4>()?;
    Some(u32::from_le_bytes(*four))
}

/// Puts an UNS32 at a place, if there is room.
pub(super) fn put(bytes: &mut [u8], place: usize, number: u32) {
    if let Some(four) = bytes.get_mut(place..).and_then(<[u8]>::first_chunk_mut::<4>) {
        *four = number.to_le_bytes();
    }
}

/// The answer with the UNS32 at a place made another.
pub(super) fn number(answer: Answer, place: usize, other: fn(u32) -> u32) -> Answer {
    answer.map(|mut bytes| {
        if let Some(number) = u32_at(&bytes, place) {
            put(&mut bytes, place, other(number));
        }
        bytes
    })
}

/// Keeps the write for the next one, and does that which was kept before.
pub(super) fn put_off(cnc: &Right<'_>, call: &Call<'_>) -> Answer {
    let before = std::mem::replace(&mut cnc.memory().later, vec![later(call)]);
    before.iter().for_each(|one| _ = cnc.late(one));
    Ok(Vec::new())
}

/// From behind the first NUL on.
pub(super) fn behind(bytes: &[u8]) -> &[u8] {
    bytes.get(text(bytes).len().saturating_add(1)..).unwrap_or_default()
}

/// The UNS32 of a sequence.
pub(super) fn fours(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).filter_map(|four| u32_at(four, 0)).collect()
}

/// The records of a sequence of descriptors.
pub(in crate::defect) fn records(bytes: &[u8]) -> Vec<[u8; 84]> {
    bytes.chunks_exact(84).filter_map(|record| record.first_chunk::<84>()).copied().collect()
}

/// The same, to be changed.
pub(in crate::defect) fn records_mut(bytes: &mut [u8]) -> impl Iterator<Item = &mut [u8; 84]> {
    bytes.chunks_exact_mut(84).filter_map(|record| record.first_chunk_mut::<84>())
}

/// The numbers of dimensions of a description, and where its name is.
pub(super) fn dimensions(description: &[u8]) -> (Vec<u32>, usize) {
    let count = u32_at(description, 16).and_then(|m| usize::try_from(m).ok()).unwrap_or_default();
    let end = count.saturating_mul(4).saturating_add(20).min(description.len());
    let numbers = description.get(20..end).unwrap_or_default();
    (fours(numbers), end)
}

/// The number of a function of the decoder, whatever channel and way of addressing; none for
/// another group.
pub(super) fn of_decoder(call: &Call<'_>) -> Option<u32> {
    (group(call) & 0xFFEF_FF00 == 0x02_2300).then(|| offset(call))
}

/// The answer no longer than asked for.
pub(super) fn fits(call: &Call<'_>, answer: Answer) -> Answer {
    answer.and_then(|bytes| {
        match u32::try_from(bytes.len()).is_ok_and(|len| len <= call.read_length) {
            true => Ok(bytes),
            false => Err(AdsError::INVALID_SIZE),
        }
    })
}

/// The reply to these functions, made another.
pub(super) fn reply(
    cnc: &Right<'_>,
    call: &Call<'_>,
    of: &[Function],
    other: impl FnOnce(Vec<u8>) -> Vec<u8>,
) -> Answer {
    match is(call, of) {
        true => fits(call, cnc.whole(call).map(other)),
        false => cnc.answer(call),
    }
}
