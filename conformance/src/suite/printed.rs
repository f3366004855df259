//! Cases made from the manuals' printed examples, compared byte for byte.

use ads_cnc::address::{Group, IndexGroup, IndexOffset};
use ads_cnc::layout::Stream;
use ads_cnc::operation::{AdsService, Task};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Direction, Hex, ProvenanceKind, Vector, vector, vectors};

use super::kit::{Probe, RawCall};
use crate::evidence::Evidence;
use crate::judge::{Body, Case, Needs, Rule, Step, Stop, case_of, typed};
use crate::number::to_usize;
use crate::text::hex::spaced;

/// The vector of an example that contradicts another example of the same variable (E-27): no CNC
/// returns both values at the same time.
const CONTRADICTED: &str = "value-printed-name-element";

/// One case for each printed reply whose request is also a vector.
pub(super) fn cases() -> Vec<Case> {
    vectors()
        .iter()
        .filter(|vector| {
            vector.provenance.kind == ProvenanceKind::Manual
                && vector.direction == Direction::Reply
                && vector.context.request.is_some()
        })
        .map(|vector| case_of(vector, "printed", Needs::PrintedExamples, Body::Printed(vector)))
        .collect()
}

/// Sends a printed request and compares the reply with the printed one. The case of the vector
/// [`CONTRADICTED`] is not applicable.
pub(super) fn ask(probe: &mut Probe<'_>, reply: &'static Vector) -> Step {
    if reply.id == CONTRADICTED {
        return Err(Stop::not_applicable(
            "the manual has two contradictory examples (E-27); this CNC returns the other one",
        ));
    }
    let lacks = |what: &str| Stop::Harness(format!("{} has no {what}", reply.id));
    let context = &reply.context;
    let request = context.request.as_deref().and_then(vector).ok_or_else(|| lacks("request"))?;
    let group = context.index_group.ok_or_else(|| lacks("index group"))?;
    let offset = context.index_offset.ok_or_else(|| lacks("index offset"))?;
    let expected = reply.bytes();
    let read = context.service == Some(ads_cnc_vectors::AdsService::Read);
    let data = if read { Vec::new() } else { request.bytes() };
    let length = u32::try_from(expected.len())?;
    let stream = Stream::by_name(&reply.stream).ok_or_else(|| lacks("stream"))?;
    let index_group = IndexGroup::new(group);
    let task = match index_group.parts() {
        Some(Group::Com(_)) => Task::Com,
        _ => Task::Sda,
    };
    let call = RawCall {
        port: task.port(),
        service: if read { AdsService::Read } else { AdsService::ReadWrite },
        index_group,
        index_offset: IndexOffset::new(offset),
        read_length: if read { length } else { stream.layout().max },
        data,
    };
    let exchange = probe.call(&call)?;
    let values = typed(context);
    probe.set_evidence(probe.evidence().map(|evidence| Evidence { values, ..evidence }));
    let received = exchange.success();
    let found = received.map_or_else(|| exchange.result(), |bytes| Hex(bytes.to_vec()).to_string());
    let wrong = wrong_requirements(reply, stream, &expected, received);
    // A target that claims the printed examples is judged at the level of the example.
    let level = Some(reply.level());
    let rules = reply.cited().into_iter().map(|one| Rule { id: one.id.as_str(), level });
    let (failed, passed): (Vec<Rule>, Vec<Rule>) = rules.partition(|rule| match received {
        Some(bytes) => bytes != expected && wrong.contains(&rule.id),
        None => true,
    });
    let printed = || format!("{} as printed", spaced(&expected));
    probe.check_reply(&passed[..], true, &expected, printed, &found);
    probe.check_reply(&failed[..], false, &expected, printed, &found);
    Ok(())
}

/// Requirements that consist of a printed example: a difference in any field violates them.
const EXAMPLES: [ClauseId; 3] = [SDA_3, SDA_10, DYN_7];

/// The requirements of the vector that a difference from the printed reply violates: those of the
/// fields that differ, and those that consist of the whole example. If no requirement of the vector
/// is about a field that differs, these are all requirements of the vector.
fn wrong_requirements<'v>(
    reply: &'v Vector,
    stream: Stream,
    expected: &[u8],
    received: Option<&[u8]>,
) -> Vec<&'v str> {
    let received = received.unwrap_or_default();
    let mut clauses = Vec::new();
    // A printed reply always decodes completely, so the result is ignored.
    let _walked = stream.walk(expected, |segment| {
        let at = to_usize(segment.offset);
        let same = received.get(at..at.saturating_add(segment.bytes.len())) == Some(segment.bytes);
        if !same {
            clauses.extend(segment.field.spec().map(|spec| spec.clause));
        }
    });
    let all = || reply.cited().into_iter().map(|one| one.id.as_str());
    if !all().any(|id| clauses.contains(&id)) {
        return all().collect();
    }
    let is_example = |id: &str| EXAMPLES.iter().any(|example| example.as_str() == id);
    all().filter(|id| clauses.contains(id) || is_example(id)).collect()
}
