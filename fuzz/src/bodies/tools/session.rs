//! A connection with the simulated CNC, without a socket.

use std::sync::OnceLock;
use std::time::Duration;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsPort, FrameRef, StateFlags};
use ads_cnc::operation::{AdsService, Call, Request};
use ads_cnc_conformance::ads_service::{decode_reply, service_of};
use ads_cnc_conformance::simulator::{CONNECTION_BYTES_MAX, Cnc, Model, NET_ID, ReceiveBuffer};

use super::Input;
use super::calls::{PORTS, call, frame};
use crate::common::CALLS;
use crate::{Defect, Outcome};

pub(crate) const DEFECTS: &[&str] = &[
    "an answer loses the upper byte of a large invoke ID",
    "the second answer of a piece is lost",
    "an answer with data is one byte shorter than its length",
    "a rejected write changes the first byte",
    "a write of several bytes changes nothing",
    "the bytes of an incomplete frame are buffered a thousand times",
];

/// A small model of a CNC with many kinds of data.
pub(crate) const MODEL: &str = include_str!("small.toml");

fn cnc() -> Cnc {
    static READ: OnceLock<Model> = OnceLock::new();
    let model = READ.get_or_init(|| Model::from_toml(MODEL, "a model").expect("a model"));
    Cnc::new(model.clone()).with_stopped_clock()
}

/// A session: every valid request gets one answer, which the codec reads; a malformed frame ends
/// the session.
struct Session {
    cnc: Cnc,
    received: ReceiveBuffer,
    /// All bytes that were sent.
    sent: Vec<u8>,
    answers: Vec<u8>,
    /// The bytes of the next piece.
    piece: Vec<u8>,
    is_over: bool,
    defect: Defect,
}

/// Input: records: a known call (0, its index, invoke ID), any call (1), a length and any bytes (2), a
/// changed byte in the current piece (3), the end of the piece (4), time that passes (5), a call in its
/// own piece whose effect is checked (6 and more).
pub(crate) fn check(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let mut session = Session {
        cnc: cnc(),
        received: ReceiveBuffer::new(),
        sent: Vec::new(),
        answers: Vec::new(),
        piece: Vec::new(),
        is_over: false,
        defect,
    };
    while !input.is_empty() && !session.is_over {
        match input.byte() {
            0 => {
                let call = CALLS[usize::from(input.byte()) % CALLS.len()].call;
                session.piece.extend(frame(&call, input.long()));
            }
            1 => {
                let call = call(&mut input, &PORTS);
                session.piece.extend(frame(&call, input.long()));
            }
            2 => session.piece.extend(input.piece()),
            3 => {
                let (place, bits) = (usize::from(input.word()), input.byte());
                if let Some(byte) = session.piece.get_mut(place) {
                    *byte ^= bits;
                }
            }
            4 => session.send(),
            5 => session.cnc.pass(Duration::from_millis(input.word().into())),
            _ => {
                session.send();
                let call = call(&mut input, &PORTS);
                session.change(&call);
            }
        }
    }
    session.send();
    session.judge()
}

impl Session {
    fn send(&mut self) {
        let piece = std::mem::take(&mut self.piece);
        if self.is_over {
            return;
        }
        for piece in piece.chunks(self.received.room().len()) {
            self.received.room()[..piece.len()].copy_from_slice(piece);
            self.sent.extend(piece);
            let before = self.answers.len();
            let answers = &mut self.answers;
            let taken = self.received.take(piece.len(), &self.cnc, NET_ID, |more| {
                answers.extend(more);
                Ok(())
            });
            mutation(&mut self.answers, before, self.defect);
            self.is_over = taken.is_err();
            let kept = if self.defect.is(6) { self.received.buffered() * 1000 } else { 0 };
            assert!(self.received.capacity() + kept <= CONNECTION_BYTES_MAX);
            assert!(!self.received.room().is_empty());
        }
    }

    /// Sends a call. If it is a write, checks that a rejected write changes nothing, and that a read after
    /// an accepted write returns the written value.
    fn change(&mut self, call: &Call<'_>) {
        let read = reading(call);
        let before = read.as_ref().map(|read| self.cnc.answer(&read.call()));
        let begin = self.answers.len();
        if self.received.buffered() > 0 {
            return;
        }
        self.piece.extend(frame(call, 1));
        self.send();
        let Some(answer) = self.answers.get(begin..).filter(|answer| answer.len() >= 42) else {
            return;
        };
        let rejected = answer[38..42] != [0; 4];
        let (Some(read), Some(before)) = (read, before) else { return };
        let mut after = self.cnc.answer(&read.call());
        if let (Ok(after), true) = (&mut after, self.defect.is(4) && rejected) {
            after.iter_mut().zip(read.value).take(1).for_each(|(byte, new)| *byte = *new);
        }
        if self.defect.is(5) && !rejected && read.value.len() > 1 {
            after.clone_from(&before);
        }
        match rejected {
            true => assert_eq!(before, after, "{call:?}"),
            false => check_written(&read, &after),
        }
    }

    /// Checks that the answers are those to the valid requests, in their order, and no others.
    fn judge(&self) -> Outcome {
        let (mut sent, mut answers) = (&self.sent[..], &self.answers[..]);
        let mut count = 0_usize;
        let broken = loop {
            match FrameRef::split(sent, 0x1_0000) {
                Err(_) => break true,
                Ok(None) => break false,
                Ok(Some((frame, len))) => {
                    sent = &sent[len..];
                    if frame.header().state_flags.0 & 1 == 0 {
                        answers = &answers[answered(&frame, answers)..];
                        count += 1;
                    }
                }
            }
        };
        assert_eq!(answers.len(), 0, "{} bytes without a request", answers.len());
        assert_eq!(broken, self.is_over, "after {count} frames");
        match (broken, count) {
            (false, 1..) => Outcome::accepted(&self.answers),
            _ => Outcome::rejected(&self.answers),
        }
    }
}

fn mutation(answers: &mut Vec<u8>, begin: usize, defect: Defect) {
    let first = answers[begin..].first_chunk().map_or(0, |six: &[u8; 6]| usize::from(six[2]) + 6);
    let second = begin + first;
    if defect.is(2) && answers.len() > second + 38 {
        answers.truncate(second);
    }
    let large = answers.len() > begin + 38 && answers[begin + 37] > 0;
    if defect.is(1) && large {
        answers[begin + 37] = 0;
    }
    if defect.is(3) && answers.len() > begin + 46 {
        answers.pop();
    }
}

/// Checks the next answer against its request, and returns its length.
fn answered(request: &FrameRef<'_>, answers: &[u8]) -> usize {
    let Ok(Some((answer, len))) = FrameRef::split(answers, u32::MAX) else {
        panic!("no answer to {request:?}");
    };
    let (asked, header) = (request.header(), answer.header());
    assert_eq!(header.invoke_id, asked.invoke_id);
    assert_eq!((header.command, header.target), (asked.command, asked.source));
    assert_eq!((header.source, header.state_flags), (asked.target, StateFlags::RESPONSE));
    if !header.error.is_ok() {
        assert!(answer.data().is_empty());
        return len;
    }
    let call = Call::from_frame(request);
    let Some(service) = service_of(header.command) else { return len };
    let (result, data) = decode_reply(service, answer.data()).expect("a reply of the service");
    if let (Ok(Some(call)), true) = (call, result.is_ok()) {
        let data = data.unwrap_or_default();
        assert!(data.len() <= call.read_length as usize);
        let request = call.dispatch().expect("an answered call is a function");
        assert!(request.decode_reply(data).is_ok(), "{call:?}: {data:02x?}");
    }
    len
}

/// A call that reads the value that another call writes.
struct ReadBack<'c> {
    port: AmsPort,
    service: AdsService,
    group: IndexGroup,
    offset: IndexOffset,
    data: Vec<u8>,
    /// The written value.
    value: &'c [u8],
    /// Whether a read must return the written value; false if the CNC interprets the value.
    is_plain: bool,
}

impl ReadBack<'_> {
    fn call(&self) -> Call<'_> {
        Call {
            port: self.port,
            service: self.service,
            index_group: self.group,
            index_offset: self.offset,
            read_length: 0xFFF8,
            data: &self.data,
        }
    }
}

fn reading<'c>(call: &Call<'c>) -> Option<ReadBack<'c>> {
    let (service, offset, data, value): (_, u32, &[u8], &[u8]) = match call.dispatch().ok()? {
        Request::WriteByName(_) => {
            let end = call.data.iter().position(|&byte| byte == 0)? + 1;
            let (name, value) = call.data.split_at(end);
            (AdsService::ReadWrite, 0x48, name, value)
        }
        Request::AxisWriteByName(_) => {
            let end = call.data.iter().position(|&byte| byte == 0)? + 1;
            let (name, value) = call.data.split_at(end);
            (AdsService::ReadWrite, call.index_offset.get() - 1, name, value)
        }
        Request::WriteByHandle(op) => {
            let len = op.value.as_bytes().len();
            let (handle, value) = call.data.split_at(call.data.len() - len);
            (AdsService::ReadWrite, 0x47, handle, value)
        }
        Request::WriteObject(_) | Request::WriteElement(_) => {
            (AdsService::Read, call.index_offset.get(), &[], call.data)
        }
        _ => return None,
    };
    // The CNC interprets axis numbers and the variables of the Service Interface, so that a read may return
    // another value than the written one.
    let is_number = call.index_offset.get() & 0xFFFF == 3;
    Some(ReadBack {
        port: call.port,
        service,
        group: call.index_group,
        offset: IndexOffset::new(offset),
        data: data.to_vec(),
        value,
        is_plain: !is_number && !data.starts_with(b"V.G.SERVICE"),
    })
}

fn check_written(read: &ReadBack<'_>, after: &Result<Vec<u8>, ads_cnc::ads::AdsError>) {
    if read.is_plain {
        assert_eq!(after.as_deref(), Ok(read.value), "{:?}", read.call());
    }
}
