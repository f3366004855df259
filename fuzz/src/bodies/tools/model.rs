//! Data models of the simulated CNC.

use std::time::Duration;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::operation::{Call, Reply, Request};
use ads_cnc_conformance::simulator::{Cnc, Model};

use super::toml::{placed, text};
use crate::common::CALLS;
use crate::{Defect, Outcome};

pub(crate) const DEFECTS: &[&str] = &[
    "a file is parsed differently after a comment",
    "the line of an error is one too low",
    "more objects are counted than can be read",
    "an answer loses its last byte",
    "the same requests get different answers as time passes",
];

/// Any file is a model or an error. The codec reads the answers of a CNC with this model. The CNC
/// gives the same answers to the same requests. In four lists, it has no object at the number after
/// the last one that it counts.
pub(crate) fn check(data: &[u8], defect: Defect) -> Outcome {
    let Some(text) = text(data) else { return Outcome::unread() };
    let read = placed(text, "a file:", defect, |text| Model::from_toml(text, "a file"), Model::eq);
    let model = match read {
        Ok(model) => model,
        Err(error) => return Outcome::rejected(error),
    };
    let said = serve(model.clone(), defect, 0);
    assert_eq!(said, serve(model, defect, 1));
    Outcome::accepted(said)
}

/// The answers of a CNC with this model to the sample calls, and the first objects of four lists,
/// at three times.
fn serve(model: Model, defect: Defect, turn: usize) -> Vec<Option<Vec<u8>>> {
    let cnc = Cnc::new(model).with_stopped_clock();
    let mut said = Vec::new();
    for _ in 0..3 {
        said.extend(CALLS.iter().map(|sample| answer(&cnc, &sample.call, defect)));
        for group in [0x13_0100, 0x13_0101, 0x13_0102, 0x13_0201] {
            objects(&cnc, group, defect, &mut said);
        }
        let late = if defect.is(5) { turn * 900 } else { 0 };
        cnc.pass(Duration::from_millis(1500 + late as u64));
    }
    said
}

/// Appends the first objects of a list to `said`, and verifies that a read after the last object fails.
fn objects(cnc: &Cnc, group: u32, defect: Defect, said: &mut Vec<Option<Vec<u8>>>) {
    let ask = |offset, read_length| {
        let (index_group, index_offset) = (IndexGroup::new(group), IndexOffset::new(offset));
        answer(cnc, &Call { index_group, index_offset, read_length, ..CALLS[0].call }, defect)
    };
    let Some(Ok(count)) = ask(0, 4).map(<[u8; 4]>::try_from) else { return };
    let count = u32::from_le_bytes(count) + u32::from(defect.is(3));
    for place in 1..=count.min(4) {
        let object = ask(place, 84);
        assert!(object.as_ref().is_some_and(|object| object.len() == 84), "{group:#x} {place}");
        said.push(object);
    }
    assert_eq!(ask(count + 1, 84), None, "{group:#x} has more than {count}");
}

/// The answer to a call, which the codec must accept.
fn answer(cnc: &Cnc, call: &Call<'_>, defect: Defect) -> Option<Vec<u8>> {
    let mut answer = cnc.answer(call).ok()?;
    if defect.is(4) && answer.len() > 4 {
        answer.pop();
    }
    assert!(answer.len() <= call.read_length as usize, "{call:?}");
    let request: Request<'_> = call.dispatch().expect("an answered call");
    let reply: Result<Reply<'_>, _> = request.decode_reply(&answer);
    assert!(reply.is_ok(), "{call:?}: {reply:?}");
    Some(answer)
}
