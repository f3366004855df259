//! Cases of index groups and ports, and the cases that judge the frames exchanged so far in a run.

use ads_cnc::address::{Addressing, Channel, ComGroup, Group};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{
    AdsService, CountObjects, CountVariables, DescribeByIndex, ReadDescriptors, Request,
};
use ads_cnc::{Decode as _, DescriptorsRef, Kind, ObjectCount};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use super::kit::{ChannelItems, Probe, RawCall, Steady, content_reads, in_channel, rules_by_index};
use super::row::{CaseRow, case};
use crate::evidence::Evidence;
use crate::exchange::Exchange;
use crate::judge::{Checks as _, Needs, OrStop as _, Record, Rule, Step, Stop, assumed, online};
use crate::number::to_u32;
use crate::objects::KINDS;
use crate::profile::Claim;
use crate::text::hex::spaced;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("adr-com-object-access", &[ADR_1, ADR_3, ADR_4, GEN_4], Needs::Queries, com_object_access,
        "Each channel's object list is in index group 0x130100 + channel, at the port of COM"),
    case("adr-decoder-group", &[ADR_1, ADR_5, GEN_4, GEN_6], Needs::Queries, decoder_group,
        "Each channel's variables are in index group 0x122300 + channel, at the port of SDA"),
    case("adr-logical-and-by-index", &[ADR_1, ADR_12], Needs::Queries, logical_and_by_index,
        "A channel returns the same data by its number and by its rank"),
    case("adr-rank-among-active", &[ADR_11, ADR_12], Needs::Queries, rank_among_active,
        "Channel ranks number the active channels without gaps"),
    case("adr-geo-answers-too", &[ADR_10], Needs::Malformed, geo_answers_too,
        "The ports of GEO and SDA return the same data for a class of the CNC"),
    case("adr-absent-channel", &[ADS_4], Needs::Queries, absent_channel,
        "A request to a channel that is not configured returns an error"),
];

#[rustfmt::skip]
pub(super) const FRAME_CASES: &[CaseRow] = &[
    case("ads-every-frame", &[ADS_1, ADS_2, ADS_3, ADS_4, ADS_5], Needs::Frames, every_frame,
        "Every frame of the run has the header and the length that its request requires"),
    case("ads-every-refusal", &[ADS_6, ADS_7], Needs::Frames, every_rejection,
        "Each request that the target rejects in the run returns an error number"),
];

fn com_object_access(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        // `channel` is a channel number, so the index group has the bit of logical addressing.
        let rules = [ADR_1, ADR_3, ADR_4, GEN_4];
        let count = probe.ask(rules, CountObjects::new(channel))?;
        let none = ObjectCount::decode(&count) == Ok(ObjectCount(0));
        let first = ReadDescriptors::new(channel, 1, 1)?;
        let Some(first) = probe.try_ask(first)?.filter(|_| !none) else { continue };
        // The reply must be the descriptor of the object, not the content of the element with the
        // same number.
        let described = DescriptorsRef::decode(&first).is_ok_and(|list| list.len() == 1);
        probe.check(ADR_4, described, "a description under 0x30000", || Hex(first));
    }
    Ok(())
}

fn decoder_group(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        // The manual states the group, and that channels start at 1. Port 552 of SDA is only an
        // assumption of a sample program, so the rule on ports (GEN-4) has the level *should* here.
        let rules = [ADR_1.into(), ADR_5.into(), GEN_6.into(), online(GEN_4)];
        probe.ask(rules, CountVariables::new(channel, Kind::V_E))?;
    }
    Ok(())
}

/// Queries whose replies identify a channel: the numbers of objects and variables, the first
/// object, and the first eight variables of each kind.
fn known_by(channel: Channel) -> Step<Vec<Request<'static>>> {
    let mut requests =
        vec![CountObjects::new(channel).into(), ReadDescriptors::new(channel, 1, 1)?.into()];
    for (_, kind) in KINDS {
        requests.push(CountVariables::new(channel, kind).into());
        let described = (0..8).map(|index| DescribeByIndex::new(channel, index, kind));
        requests.extend(described.map(Request::from));
    }
    Ok(requests)
}

/// Whether `found` differs from the descriptor `logical` only in the index group of the content,
/// which has the rank of the channel and no bit for logical addressing.
fn same_object(logical: &[u8], found: &[u8], rank: Channel) -> bool {
    let one = |bytes| Some(DescriptorsRef::decode(bytes).ok()?.get(0)?.to_owned());
    let (Some(logical), Some(found)) = (one(logical), one(found)) else { return false };
    let Some(Group::Com(com)) = logical.index_group().parts() else { return false };
    let by_rank = ComGroup { addressing: Addressing::Index, instance: rank.number(), ..com };
    let content = (by_rank.index_group(), logical.index_offset());
    (found.index_group(), found.index_offset()) == content
        && found == logical.with_content(content.0, content.1)
}

fn same_by_rank(probe: &mut Probe<'_>, clause: ClauseId, rank: Channel, number: Channel) -> Step {
    for (logical, by_index) in known_by(number)?.into_iter().zip(known_by(rank)?) {
        let function = logical.function().spec().name;
        let is_object = matches!(logical, Request::ReadDescriptors(_));
        let Some(by_number) = probe.try_ask(logical)? else { continue };
        let exchange = probe.send(by_index)?;
        let same = exchange
            .success()
            .map(|found| found == by_number || is_object && same_object(&by_number, found, rank));
        let rules = rules_by_index(probe, clause, logical, by_index, same)?;
        let by = number.number();
        let expected = || format!("{function}: {}, the answer of channel {by}", spaced(&by_number));
        probe.check_reply(&rules[..], same == Some(true), &by_number, expected, &exchange);
    }
    let items = ChannelItems::read(probe, number)?;
    let mut steady = Steady::default();
    for (one, other) in items.requests(number)?.into_iter().zip(items.requests(rank)?) {
        if probe.claims(one.function()) != Claim::No {
            let what = format!("{} of channel {}", one.function().spec().name, number.number());
            steady.by_index(probe, clause, what, one, other)?;
        }
    }
    steady.finish()
}

fn logical_and_by_index(probe: &mut Probe<'_>) -> Step {
    for (rank, number) in probe.ranks()? {
        same_by_rank(probe, ADR_1, rank, number)?;
    }
    Ok(())
}

fn rank_among_active(probe: &mut Probe<'_>) -> Step {
    let ranks = probe.ranks()?;
    let gap = ranks.iter().find(|(rank, number)| rank.number() != number.number());
    let &(rank, number) = gap.or_not_applicable("every channel's number is its rank")?;
    same_by_rank(probe, ADR_11, rank, number)?;
    let ranks = to_u32(ranks.len());
    let beyond = Channel::by_index(ranks.saturating_add(1))?;
    probe.rejects(
        ADR_11,
        "a rank after the last channel",
        CountVariables::new(beyond, Kind::V_E),
        CountVariables::new(rank, Kind::V_E),
    )
}

fn geo_answers_too(probe: &mut Probe<'_>) -> Step {
    let sda = RawCall::new(CountVariables::new(probe.channel()?, Kind::V_E))?;
    let geo = sda.with(|call| call.port = AmsPort::GEO);
    let by_sda = probe.call(&sda)?;
    let by_geo = probe.call(&geo)?;
    let data = |exchange: &Exchange| exchange.reply().and_then(|reply| reply.data.clone());
    let same = data(&by_geo) == data(&by_sda) && data(&by_sda).is_some();
    probe.check(assumed(ADR_10), same, &by_sda, &by_geo);
    Ok(())
}

fn absent_channel(probe: &mut Probe<'_>) -> Step {
    let absent = probe.target.profile.absent_channel;
    let number = absent.or_not_applicable("no channel is known to be absent")?;
    let absent = Channel::new(number)?;
    let present = probe.channel()?;
    let what = format!("channel {number}, which is not configured");
    let count = |channel| CountVariables::new(channel, Kind::V_E);
    probe.rejects(ADS_4, &what, count(absent), count(present))?;
    probe.rejects(ADS_4, &what, CountObjects::new(absent), CountObjects::new(present))?;
    let items = ChannelItems::read(probe, present)?;
    let queries = [known_by(present)?, items.requests(present)?].concat();
    let mut calls = queries.into_iter().map(RawCall::new).collect::<Step<Vec<_>>>()?;
    calls.extend(content_reads(probe, present)?);
    for valid in calls {
        let Some(invalid) = in_channel(&valid, present, absent) else { continue };
        let function = valid.call().dispatch().ok().map(|request| request.function());
        let is_claimed = function.is_some_and(|function| probe.claims(function) != Claim::No);
        if is_claimed
            && probe.target.client.check(&invalid.call()).is_ok()
            && probe.call(&valid)?.success().is_some_and(|data| !data.is_empty())
        {
            probe.rejects(ADS_4, &what, invalid, valid)?;
        }
    }
    Ok(())
}

fn every_frame(probe: &mut Probe<'_>) -> Step {
    let broken = std::mem::take(&mut probe.target.broken);
    let answered = probe.target.answered.clone();
    if answered.is_empty() && broken.checks == 0 {
        return Err(Stop::inconclusive("no request was answered"));
    }
    if let Some(last) = only_errors_with_data(probe) {
        probe.set_evidence(Some(last));
        let found = "only errors that carry data, and no success";
        probe.check(ADS_4, false, "the result 0 for a success", found);
    }
    let mut judged = Record::default();
    for (requirement, services) in [
        (ADS_1, &[AdsService::Read][..]),
        (ADS_2, &[AdsService::Write]),
        (ADS_3, &[AdsService::ReadWrite]),
        (ADS_4, &[AdsService::Read, AdsService::Write, AdsService::ReadWrite]),
        (ADS_5, &[AdsService::Read, AdsService::Write, AdsService::ReadWrite]),
    ] {
        let id = Rule::from(requirement).id;
        let is_broken = broken.judgements.iter().any(|one| one.requirement == id);
        judged.append(broken.of(id));
        let carried = services.iter().any(|service| answered.contains(service));
        if !is_broken && carried {
            probe.pass(requirement);
        }
    }
    probe.take_over(judged);
    Ok(())
}

/// The last error reply with data, if no reply to a Read, Write or ReadWrite was a success.
fn only_errors_with_data(probe: &mut Probe<'_>) -> Option<Evidence> {
    let last = probe.target.error_with_data.take();
    last.filter(|_| !probe.target.any_success)
}

/// Takes over the checks that [`Probe::rejects`] has recorded of successes without data in place of
/// errors. The manuals do not require a particular error number.
fn every_rejection(probe: &mut Probe<'_>) -> Step {
    let by_nothing = std::mem::take(&mut probe.target.rejections.by_nothing);
    if probe.target.rejections.by_number > 0 {
        // At least one error reply was decoded, with or without data.
        probe.pass([ADS_6, ADS_7]);
    }
    probe.take_over(by_nothing);
    Ok(())
}
