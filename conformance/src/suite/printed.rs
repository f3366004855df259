//! Cases made of golden vectors: what is printed, byte for byte.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::layout::Stream;
use ads_cnc::operation::{Call, Service, Task};
use ads_cnc_vectors::{
    Direction, Expect, Hex, ProvenanceKind, Vector, requirement, vector, vectors,
};

use super::case::{Body, Case, Evidence, Judgement, Needs, Rule, Step, Stop};
use super::probe::Probe;
use crate::codec::{self, Refused};
use crate::defect::Defect;
use crate::verdict::Verdict;

/// One example contradicts another of the same variable (E-27): no CNC answers both.
const CONTRADICTED: &str = "value-printed-name-element";

/// One case for each vector, for the codec.
pub(super) fn vector_cases() -> Vec<Case> {
    vectors()
        .iter()
        .map(|vector| case_of(vector, "vec", Needs::Codec, Body::Vector(vector)))
        .collect()
}

/// One case for each printed reply, for the target.
pub(super) fn printed_cases() -> Vec<Case> {
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

fn case_of(vector: &Vector, prefix: &str, needs: Needs, body: Body) -> Case {
    let known = vector.requirements.iter().filter_map(|id| requirement(id));
    Case {
        id: format!("{prefix}-{}", vector.id),
        title: vector.title.clone(),
        requirements: known.map(|requirement| requirement.id.as_str()).collect(),
        needs,
        body,
    }
}

/// Sends a printed request and holds the reply against the printed one.
pub(super) fn ask_printed(probe: &mut Probe<'_>, reply: &'static Vector) -> Step {
    if reply.id == CONTRADICTED {
        let why = "contradicted by the example of the whole array (E-27), which is answered";
        return Err(Stop::NotApplicable(why.to_owned()));
    }
    let lacks = |what: &str| Stop::Harness(format!("{} has no {what}", reply.id));
    let context = &reply.context;
    let request = context.request.as_deref().and_then(vector).ok_or_else(|| lacks("request"))?;
    let group = context.index_group.ok_or_else(|| lacks("index group"))?;
    let offset = context.index_offset.ok_or_else(|| lacks("index offset"))?;
    let expected = reply.bytes();
    let read = context.service == Some(ads_cnc_vectors::Service::Read);
    let data = if read { Vec::new() } else { request.bytes() };
    let length = u32::try_from(expected.len()).map_err(super::probe::harness)?;
    let stream = Stream::by_name(&reply.stream).ok_or_else(|| lacks("stream"))?;
    let call = Call {
        port: if read { Task::Com.port() } else { Task::Sda.port() },
        service: if read { Service::Read } else { Service::ReadWrite },
        index_group: IndexGroup::new(group),
        index_offset: IndexOffset::new(offset),
        read_length: if read { length } else { stream.layout().max },
        data: &data,
    };
    let exchange = probe.call(&call)?;
    let received = exchange.answer().and_then(|answer| answer.success());
    // All requirements of a vector stand and fall together: its bytes are right, or they are not.
    for id in reply.requirements.iter().filter_map(|id| requirement(id)) {
        let kept = received == Some(&expected[..]);
        let rule = Rule { id: &id.id, level: Some(ads_cnc_vectors::Level::Must) };
        let found = match received {
            Some(bytes) => Hex(bytes.to_vec()).to_string(),
            None => exchange.result(),
        };
        probe.check(rule, kept, format!("{} as printed", Hex(expected.clone())), found);
    }
    Ok(())
}

/// Holds the codec against a vector.
pub(super) fn judge_vector(vector: &Vector, defect: Option<&Defect>) -> Judgement {
    let mut bytes = vector.bytes();
    let stream = Stream::by_name(&vector.stream);
    if let Some(defect) = defect.filter(|one| stream.is_some_and(|stream| one.touches(stream))) {
        bytes = defect.apply(&bytes);
    }
    let (kept, expected, found) = match (&vector.expect, codec::decode(vector, &bytes)) {
        (Expect::Accept(accept), Ok(decoded)) => {
            let again = decoded.bytes == vector.bytes();
            let kept = decoded.fields == accept.value && again;
            let found = match again {
                true => codec::show(&decoded.fields),
                false => format!("encoded again as {}", Hex(decoded.bytes)),
            };
            (kept, codec::show(&accept.value), found)
        }
        (Expect::Accept(accept), Err(refused)) => {
            (false, codec::show(&accept.value), describe(refused))
        }
        (Expect::Reject(reject), Ok(decoded)) => {
            let expected =
                format!("{} at offset {} in {}", reject.class, reject.offset, reject.field);
            (false, expected, format!("accepted: {}", codec::show(&decoded.fields)))
        }
        (Expect::Reject(reject), Err(refused)) => {
            // Class and place are advice; that it is refused by the codec is what counts.
            let kept = matches!(refused, Refused::Error(_));
            (kept, format!("{} in {}", reject.class, reject.field), describe(refused))
        }
    };
    let verdict = if kept { Verdict::Pass } else { Verdict::Fail };
    let evidence = Evidence {
        call: format!("vector {} to the codec", vector.id),
        request_stream: None,
        reply_stream: stream.map(|stream| stream.layout().name),
        sent: Vec::new(),
        received: Some(bytes),
        result: found.clone(),
        frame_sent: Vec::new(),
        frame_received: Vec::new(),
    };
    Judgement { requirement: "", verdict, expected, found, evidence: Some(evidence) }
}

fn describe(refused: Refused) -> String {
    match refused {
        Refused::Error(error) => format!("{}: {error}", codec::class(&error)),
        Refused::Unsupported(what) => format!("unsupported: {what}"),
    }
}
