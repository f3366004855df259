//! Generated defects of one function. For example, an operator rejects the request, executes
//! another one instead or in addition, or changes the correct reply.
//!
//! ```
//! use ads_cnc_conformance::faults;
//!
//! let defect = faults::by_id("describe-by-index.next-index").unwrap();
//! assert!(defect.requirements.contains(&"VAR-4"));
//! ```

mod change;
mod functions;

use ads_cnc::ads::AdsError;
use ads_cnc::layout::Stream;
use ads_cnc::operation::{AdsService, Call, Function, FunctionSpec, GroupRule};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use self::change::Argument::{Axis, Channel, Index};
use self::change::{asked, instead, kept, least, mistaken, of_first_kind, rewritten};
use self::functions::{
    differs_by_channel, differs_by_rank, has_axis, has_end, has_fields, has_index, has_kind,
    has_rank, has_reply, has_unknown, is_alike, is_attribute, writes,
};
use super::cnc::{
    CncFault, LOGICAL, ReplyData, Upstream, changed, delay_write, first, forgiven, group, offset,
    or_short, within_length,
};
use super::seeded_defect::{DefectKind, Mechanism, SeededDefect};

/// A kind of defect. `defects` generates one defect for each function for which `applies` returns
/// true, except for `WriteProgramStream`.
struct Operator {
    name: &'static str,
    what: &'static str,
    /// Requirements that the defect violates in addition to those of the function and its streams,
    /// if they concern the function (see `concerns`).
    breaks: &'static [ClauseId],
    applies: fn(&FunctionSpec) -> bool,
    answer: fn(&Upstream<'_>, &Call<'_>) -> ReplyData,
}

const fn operator(
    name: &'static str,
    what: &'static str,
    breaks: &'static [ClauseId],
    applies: fn(&FunctionSpec) -> bool,
    answer: fn(&Upstream<'_>, &Call<'_>) -> ReplyData,
) -> Operator {
    Operator { name, what, breaks, applies, answer }
}

/// Defects that treat a request as another request, reject it, or answer a rejected request with
/// success. They also violate the requirement of the stream of the request, if the function has
/// one.
const OF_REQUESTS: &[Operator] = &[
    operator(
        "reject",
        "the CNC rejects every request",
        &[],
        |_| true,
        |_, _| Err(AdsError::INVALID_DATA),
    ),
    operator(
        "rank-rejected",
        "the CNC rejects index groups without the bit of logical addressing",
        &[ADR_12],
        has_rank,
        |cnc, call| {
            if group(call) & LOGICAL == 0 { Err(AdsError::INVALID_GROUP) } else { cnc.answer(call) }
        },
    ),
    operator(
        "rank-is-number",
        "the CNC treats the rank of a channel (addressing by index) as the number of a channel",
        &[ADR_1, ADR_11],
        differs_by_rank,
        |cnc, call| cnc.at(call, group(call) | LOGICAL, offset(call)),
    ),
    operator(
        "number-is-rank",
        "the CNC treats the number of a channel (logical addressing) as the rank of a channel",
        &[ADR_1],
        differs_by_rank,
        |cnc, call| cnc.at(call, group(call) & !LOGICAL, offset(call)),
    ),
    operator(
        "first-channel",
        "the CNC uses channel 1 instead of the requested channel, unless that fails",
        &[SDA_1],
        differs_by_channel,
        |cnc, call| mistaken(cnc, call, Channel, |_| 1),
    ),
    operator(
        "unknown-channel-is-first",
        "the CNC executes a request that fails, as for an unknown channel, in channel 1",
        &[ADS_4],
        has_unknown,
        |cnc, call| instead(cnc, call, Channel, |_| 1),
    ),
    operator(
        "first-axis",
        "the CNC uses axis 1 instead of the requested axis, unless that fails",
        &[ADR_7, SDA_1, SDA_13],
        |spec| {
            has_axis(spec)
                && (spec.service != AdsService::Write || spec.clause != "COM-5")
                && !is_alike(spec)
        },
        |cnc, call| mistaken(cnc, call, Axis, |_| 1),
    ),
    operator(
        "next-axis",
        "the CNC uses the next axis instead of the requested axis, unless that fails",
        &[ADR_7, SDA_1, SDA_13],
        |spec| has_axis(spec) && !is_alike(spec),
        |cnc, call| mistaken(cnc, call, Axis, |axis| axis.wrapping_add(1)),
    ),
    operator(
        "unknown-axis-is-first",
        "the CNC executes a request that fails, as for an unknown axis, for axis 1",
        &[ADR_7, ADS_4],
        |spec| has_unknown(spec) && has_axis(spec),
        |cnc, call| instead(cnc, call, Axis, |_| 1),
    ),
    operator(
        "next-index",
        "the CNC uses the next index instead of the requested index, unless that fails",
        &[DYN_5, VAR_2, VAR_20],
        has_index,
        |cnc, call| mistaken(cnc, call, Index, |index| index.wrapping_add(1)),
    ),
    operator(
        "first-index",
        "the CNC uses the first index instead of the requested index, unless that fails",
        &[DYN_5, VAR_2, VAR_20],
        |spec| has_index(spec) && spec.clause != "SDA-9",
        |cnc, call| mistaken(cnc, call, Index, |_| least(call)),
    ),
    operator(
        "index-8-bit",
        "the CNC uses only the lowest 8 bits of the index",
        &[DYN_5, VAR_2, VAR_20, SDA_4],
        has_index,
        |cnc, call| {
            asked(cnc, call, Index, |index| index & 0xFF).unwrap_or_else(|| cnc.answer(call))
        },
    ),
    operator(
        "index-beyond-is-last",
        "the CNC executes a request that fails, as after the last index, with the previous index",
        &[DYN_5, VAR_2, VAR_20, SDA_4, ADS_4],
        has_index,
        |cnc, call| instead(cnc, call, Index, |index| index.wrapping_sub(1)),
    ),
    operator(
        "first-kind",
        "the CNC uses the first kind (V.E or P) instead of the requested kind",
        &[VAR_16],
        has_kind,
        of_first_kind,
    ),
    operator(
        "other-attribute",
        "the CNC returns the attribute after the requested one, or the name after the write flag",
        &[ADR_6],
        is_attribute,
        |cnc, call| {
            let next = if group(call) & 0xF00 == 0x800 {
                0x400
            } else {
                (group(call) & 0xF00).wrapping_add(0x100)
            };
            cnc.at(call, group(call) & !0xF00 | next, offset(call)).or_else(|_| cnc.answer(call))
        },
    ),
    operator(
        "error-is-empty",
        "the CNC answers a request that it rejects with success and no data",
        &[ADS_4, ADS_7, SDA_2],
        has_reply,
        |cnc, call| cnc.answer(call).or(Ok(Vec::new())),
    ),
    operator(
        "error-is-last-reply",
        "the CNC answers a request that it rejects with its last successful reply",
        &[ADS_4, DYN_5, VAR_2, SDA_4],
        |spec| has_reply(spec) && !matches!(spec.group, GroupRule::Instances),
        |cnc, call| {
            let last = cnc.memory().get(&kept());
            let answer =
                cnc.answer(call).inspect(|correct| cnc.memory().store(kept(), correct.clone()));
            within_length(call, answer.or_else(|error| last.ok_or(error)))
        },
    ),
];

/// Defects that decode the request correctly, but send a wrong reply or execute the request
/// wrongly.
const OF_ANSWERS: &[Operator] = &[
    operator("empty", "a successful reply has no data", &[], has_reply, |cnc, call| {
        changed(cnc, call, Vec::clear)
    }),
    operator("zeros", "every byte of the reply's data is 0", &[SDA_5], has_fields, |cnc, call| {
        changed(cnc, call, |bytes| bytes.fill(0))
    }),
    operator("short", "the reply lacks the last byte of its data", &[], has_end, |cnc, call| {
        changed(cnc, call, |bytes| _ = bytes.pop())
    }),
    operator(
        "long",
        "the reply has an extra byte, 0, after its data if the read length permits",
        &[SDA_8],
        has_end,
        |cnc, call| or_short(cnc, call, changed(cnc, call, |bytes| bytes.push(0))),
    ),
    operator(
        "stale",
        "a successful reply is the one to the previous request for this function",
        &[VAR_16],
        has_reply,
        |cnc, call| {
            let correct = cnc.answer(call)?;
            let before = cnc.memory().get(&kept()).unwrap_or_else(|| correct.clone());
            cnc.memory().store(kept(), correct);
            within_length(call, Ok(before))
        },
    ),
    operator(
        "frozen",
        "every successful reply repeats the first one of this function",
        &[VAR_16],
        has_reply,
        |cnc, call| {
            let correct = cnc.answer(call)?;
            let first = cnc.memory().get(&kept()).unwrap_or(correct);
            cnc.memory().store(kept(), first.clone());
            within_length(call, Ok(first))
        },
    ),
    operator(
        "length-ignored",
        "the CNC ignores the read length, so that a reply may be longer",
        &[ADS_1, ADS_3],
        |spec| {
            has_reply(spec)
                && !matches!(spec.group, GroupRule::ComObjects)
                && !matches!(spec.clause, "SDA-4" | "SDA-9" | "VAR-15" | "VAR-26")
        },
        |cnc, call| cnc.whole(call),
    ),
    operator("ignored", "a write succeeds and changes nothing", &[], writes, |cnc, call| {
        rewritten(cnc, call, |_, old| old.to_vec())
    }),
    operator("first-byte", "a write changes only the first byte", &[], writes, |cnc, call| {
        rewritten(cnc, call, |new, old| {
            [new.get(..1), old.get(1..)].map(Option::unwrap_or_default).concat()
        })
    }),
    operator(
        "late",
        "a write succeeds, but is executed only at the next write",
        &[],
        writes,
        delay_write,
    ),
    operator(
        "also-first-channel",
        "a write is executed in channel 1 too",
        &[],
        |spec| {
            writes(spec)
                && spec.clause != "VAR-26"
                && differs_by_channel(spec)
                && !matches!(spec.group, GroupRule::ComContent)
        },
        |cnc, call| {
            let reply = cnc.answer(call)?;
            let _ = asked(cnc, call, Channel, |_| 1);
            Ok(reply)
        },
    ),
    operator(
        "also-next-index",
        "a write is executed for the next index too",
        &[],
        |spec| writes(spec) && matches!(spec.clause, "VAR-12" | "VAR-13"),
        |cnc, call| {
            let reply = cnc.answer(call)?;
            let _ = asked(cnc, call, Index, |index| index.wrapping_add(1));
            Ok(reply)
        },
    ),
    operator(
        "also-next-axis",
        "a write is executed for the next axis too",
        &[ADR_7],
        |spec| writes(spec) && has_axis(spec) && !matches!(spec.group, GroupRule::ComContent),
        |cnc, call| {
            let reply = cnc.answer(call)?;
            let _ = asked(cnc, call, Axis, |axis| axis.wrapping_add(1));
            Ok(reply)
        },
    ),
    operator(
        "read-only-accepted",
        "a write to a read-only value succeeds and changes nothing",
        &[VAR_6, COM_2],
        |spec| writes(spec) && spec.clause != "VAR-26",
        |cnc, call| forgiven(cnc.answer(call), AdsError::INVALID_ACCESS),
    ),
    operator(
        "size-ignored",
        "a write of a value of a wrong size succeeds and changes nothing",
        &[],
        |spec| writes(spec) && !matches!(spec.clause, "SDA-9" | "VAR-26"),
        |cnc, call| forgiven(cnc.answer(call), AdsError::INVALID_SIZE),
    ),
    operator(
        "once",
        "the CNC rejects every write after the first successful one",
        &[],
        writes,
        |cnc, call| {
            if cnc.memory().get(&kept()).is_some() {
                return Err(AdsError::INVALID_DATA);
            }
            cnc.answer(call).inspect(|reply| cnc.memory().store(kept(), reply.clone()))
        },
    ),
];

/// The generated defects of all functions except the write of data streaming.
pub(super) fn defects() -> impl Iterator<Item = SeededDefect> {
    // The defects of streaming are written by hand: a CNC may reject a packet temporarily, and the
    // suite cannot read a packet back.
    let functions = Function::ALL.iter().filter(|one| **one != Function::WriteProgramStream);
    functions.flat_map(|function| {
        let of_requests = OF_REQUESTS.iter().map(|operator| (operator, function.spec().request));
        let all = of_requests.chain(OF_ANSWERS.iter().map(|operator| (operator, None)));
        let mine = all.filter(|(operator, _)| (operator.applies)(function.spec()));
        mine.map(|(operator, request)| defect(function, operator, request))
    })
}

fn defect(
    function: &'static Function,
    operator: &Operator,
    misread: Option<Stream>,
) -> SeededDefect {
    let Operator { name, what, breaks, answer, .. } = operator;
    let spec = function.spec();
    let streams = spec.reply.filter(|_| !spec.is_content()).into_iter().chain(misread);
    let mut requirements = vec![spec.clause];
    requirements.extend(streams.map(|stream| stream.layout().clause));
    requirements.extend(breaks.iter().filter(|id| concerns(**id, spec)).map(|id| id.as_str()));
    if *function == Function::ReadElementName {
        // The name of element 0 is the name of the instance (SDA-4).
        requirements.push(SDA_4.as_str());
    }
    requirements.sort_unstable();
    requirements.dedup();
    SeededDefect {
        id: format!("{}.{name}", kebab(*function)),
        requirements,
        what: format!("{}: {what}", spec.name),
        kind: DefectKind::Cnc,
        edition: None,
        printed: true,
        how: Mechanism::Cnc(CncFault::Function(std::slice::from_ref(function), *answer)),
    }
}

/// Whether a requirement of an operator concerns the function.
fn concerns(clause: ClauseId, spec: &FunctionSpec) -> bool {
    let area = |id: &'static str| id.split('-').next();
    match clause {
        ADR_7 => !matches!(spec.group, GroupRule::ComContent),
        VAR_2 | DYN_5 => {
            first(spec.request) == b"index" && area(clause.as_str()) == area(spec.clause)
        }
        SDA_2 | SDA_5 => spec.clause == SDA_1.as_str(),
        SDA_8 | SDA_13 => spec.clause == SDA_4.as_str(),
        VAR_20 => first(spec.request) == b"name",
        VAR_16 => spec.clause == "VAR-15",
        ADS_1 | ADS_3 => clause == crate::ads_service::clause(spec.service),
        ADR_1 | ADR_6 | ADR_11 | ADR_12 | ADS_4 | ADS_7 => true,
        of_area => area(of_area.as_str()) == area(spec.clause),
    }
}

/// The part of a defect's ID that names the function: `describe-by-index` for `DescribeByIndex`.
fn kebab(function: Function) -> String {
    let mut text = String::new();
    for letter in format!("{function:?}").chars() {
        if letter.is_ascii_uppercase() && !text.is_empty() {
            text.push('-');
        }
        text.push(letter.to_ascii_lowercase());
    }
    text
}
