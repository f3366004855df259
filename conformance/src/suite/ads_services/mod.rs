//! Cases of the services Read, Write and ReadWrite: addresses and lengths, the match of request and
//! reply, requests in pieces, and agreement between services.

mod lengths;
mod own_reply;
mod write;

use ads_cnc::address::{Channel, Class};
use ads_cnc::dynamic::{DynamicCount, DynamicKind};
use ads_cnc::limits::DESCRIPTOR_LEN;
use ads_cnc::operation::{
    CountDynamic, CountElements, CountObjects, CountVariables, DescribeByIndex, DynamicNameByIndex,
    Function, ReadByHandle, ReadByName, ReadDescriptors, ReadElement, Request,
};
use ads_cnc::{Decode as _, Description, ObjectCount, U32List, VariableCount, VariableType};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step};
use crate::objects::decode_element_count;
use crate::profile::Claim;
use crate::suite::kit::{Probe, Steady, ask_if_claimed, compare, name_of};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("ads-read-addresses", &[ADS_1], Needs::Queries, read_addresses,
        "A Read returns the requested number of bytes from its own group and offset"),
    case("ads-read-write-addresses", &[ADS_3], Needs::Queries, read_write_addresses,
        "A ReadWrite returns the data for its own group, offset and write data"),
    case("ads-services-agree", &[ADS_1, ADS_3], Needs::Queries, services_agree,
        "The number that a Read returns equals the number of items that a ReadWrite returns"),
    case("ads-read-lengths", &[ADS_1, ADS_3, ADS_4, COM_1, COM_5, DYN_1, DYN_3, DYN_4, SDA_1, SDA_4, SDA_8,
        SDA_9, VAR_2, VAR_10, VAR_14, VAR_15, VAR_26], Needs::Queries, lengths::read_length,
        "A reply has at most the requested bytes, and at most the available bytes"),
    case("ads-own-reply", &[ADS_1, ADS_3, COM_1, COM_2, COM_5, DYN_1, DYN_2, DYN_3, DYN_4, SDA_4, SDA_6,
        SDA_7, SDA_8, SDA_9, VAR_2, VAR_4, VAR_10, VAR_11, VAR_14, VAR_26, VAR_28],
        Needs::Queries, own_reply::own_reply,
        "A reply belongs to its own request, not to an earlier request"),
    case("ads-in-pieces", &[ADS_5], Needs::Queries, lengths::in_pieces,
        "The reply to a request does not depend on the pieces in which the request arrives"),
    case("ads-write", &[ADS_2], Needs::Writes, write::arrives,
        "Another service reads an acknowledged value, and the value written before is unchanged"),
];

/// Maximum number of descriptors, descriptions and elements that are requested of a list in
/// [`read_addresses`], [`read_write_addresses`] and [`elements_agree`].
const ITEMS_MAX: u32 = 8;

/// Sends a request to a function that the target must have, and checks that it succeeds. Returns
/// the data of the reply; `None` if the check failed. Also `None`, without a request, if the
/// function is optional or not claimed.
fn ask_for_data<'a>(
    probe: &mut Probe<'_>,
    rule: ClauseId,
    request: impl Into<Request<'a>>,
) -> Step<Option<Vec<u8>>> {
    let request = request.into();
    if probe.claims(request.function()) != Claim::Yes {
        return Ok(None);
    }
    let exchange = probe.send(request)?;
    let data = exchange.success().map(<[u8]>::to_vec);
    let expected = || format!("{} with {}", request.function().spec().name, exchange.service);
    probe.check(rule, data.is_some(), expected, &exchange);
    Ok(data)
}

fn number(data: &[u8]) -> u32 {
    ObjectCount::decode(data).map_or(0, |count| count.0)
}

/// Checks that a Read returns a different descriptor at each of the first index offsets, the same
/// descriptors if several are read at once, and the numbers of objects and parameters.
fn read_addresses(probe: &mut Probe<'_>) -> Step {
    const RULE: ClauseId = ADS_1;
    for list in probe.lists()? {
        // It is assumed that platform axes have their own lists, so a missing list is not judged
        // here.
        let Some(data) = ask_if_claimed(probe, CountObjects::new(list))? else { continue };
        let count = number(&data).min(ITEMS_MAX);
        let mut all: Vec<Vec<u8>> = Vec::new();
        for index in 1..=count {
            let one = ReadDescriptors::new(list, index, 1)?;
            let Some(one) = ask_for_data(probe, RULE, one)? else { break };
            let found = || format!("{} at offset {index}", plural(one.len(), "byte"));
            probe.check(RULE, one.len() == DESCRIPTOR_LEN, "84 bytes", found);
            let other = !all.contains(&one);
            probe.check(RULE, other, "another descriptor at each offset", "the same descriptor");
            all.push(one);
        }
        if let (Ok(several), true) = (ReadDescriptors::new(list, 1, count), count > 1)
            && let Some(several) =
                ask_if_claimed(probe, several)?.filter(|data| data.len() > DESCRIPTOR_LEN)
        {
            let same = several == all.concat();
            probe.check(RULE, same, "the same descriptors as read one by one", "other descriptors");
        }
    }
    for channel in probe.channels()? {
        ask_for_data(probe, RULE, CountObjects::new(channel))?;
        for kind in DynamicKind::ALL {
            let count = ask_for_data(probe, RULE, CountDynamic::new(channel, kind))?;
            let Some(count) = count else { continue };
            let found = || format!("{} of a number", plural(count.len(), "byte"));
            probe.check(RULE, DynamicCount::decode(&count).is_ok(), "4 bytes", found);
        }
    }
    Ok(())
}

/// Checks that a ReadWrite returns the numbers of variables, a different variable at each of the
/// first indices, and the same value by handle and by name.
fn read_write_addresses(probe: &mut Probe<'_>) -> Step {
    const RULE: ClauseId = ADS_3;
    let mut steady = Steady::default();
    for channel in probe.channels()? {
        for (name, kind) in probe.kinds() {
            let data = ask_for_data(probe, RULE, CountVariables::new(channel, kind))?;
            let Some(data) = data else { continue };
            let count = VariableCount::decode(&data);
            let found = || format!("{} for {name}", plural(data.len(), "byte"));
            probe.check(RULE, count.is_ok(), "a number of 4 bytes", found);
            let mut all = Vec::new();
            for index in 0..count.map_or(0, |count| count.0.min(ITEMS_MAX)) {
                let one = ask_for_data(probe, RULE, DescribeByIndex::new(channel, index, kind))?;
                let Some(one) = one else { continue };
                let other = !all.contains(&one);
                let found = || format!("the same variable again at index {index} of {name}");
                probe.check(RULE, other, "another variable at each index", found);
                // It is assumed that the channel interface accepts handles of axis variables.
                if let Some(one) = Description::decode(&one).ok().filter(|_| name != "V.A") {
                    same_by_handle(probe, &mut steady, channel, &one)?;
                }
                all.push(one);
            }
        }
    }
    steady.finish()
}

fn same_by_handle(
    probe: &mut Probe<'_>,
    steady: &mut Steady,
    channel: Channel,
    variable: &Description,
) -> Step {
    let functions = [Function::ReadByName, Function::ReadByHandle];
    let claimed = functions.iter().all(|one| probe.claims(*one) == Claim::Yes);
    if variable.var_type == VariableType::STRING || !claimed {
        return Ok(());
    }
    let by_name = ReadByName { channel, name: name_of(variable) };
    let by_handle = ReadByHandle::new(channel, variable.handle, U32List::EMPTY);
    steady.same(probe, ADS_3, &variable.name.text, by_name, by_handle)
}

/// Compares the results of a Read with those of a ReadWrite, for parameters and for elements.
fn services_agree(probe: &mut Probe<'_>) -> Step {
    let rules = [ADS_1, ADS_3];
    let mut steady = Steady::default();
    for channel in probe.channels()? {
        for kind in DynamicKind::ALL {
            names_agree(probe, &mut steady, rules, channel, kind)?;
        }
    }
    elements_agree(probe, rules)?;
    steady.finish()?;
    probe.finish("no function with both services is claimed")
}

/// Compares the number of parameters from a Read with the names from a ReadWrite. An NC program may
/// create or delete a parameter meanwhile.
fn names_agree(
    probe: &mut Probe<'_>,
    steady: &mut Steady,
    rules: [ClauseId; 2],
    channel: Channel,
    kind: DynamicKind,
) -> Step {
    let count = |probe: &mut Probe<'_>| -> Step<Option<u32>> {
        let data = ask_if_claimed(probe, CountDynamic::new(channel, kind))?;
        Ok(data.and_then(|data| DynamicCount::decode(&data).ok()).map(|count| count.0))
    };
    let has = |probe: &mut Probe<'_>, index: u32| -> Step<bool> {
        let name = ask_if_claimed(probe, DynamicNameByIndex::new(channel, kind, index)?)?;
        Ok(name.is_some_and(|name| name.first().is_some_and(|&first| first != 0)))
    };
    let compared = compare(
        probe,
        count,
        |probe, &count| {
            let last = count == 0 || has(probe, count)?;
            let beyond = count.checked_add(1);
            let beyond = beyond.map(|beyond| has(probe, beyond)).transpose()?;
            Ok(Some((last, beyond.unwrap_or_default())))
        },
        |_, &(last, beyond)| last && !beyond,
    )?;
    let what = format!("the number of {kind:?} of channel {}", channel.number());
    steady.judge(probe, rules, &what, compared, |probe, rules, (count, (last, beyond), _)| {
        let expected = || format!("{count} names: one at the last index, and none after it");
        let found = || format!("name at the last index: {last}, name after it: {beyond}");
        probe.check(rules, false, expected, found);
    });
    Ok(())
}

/// Checks that a Read finds the elements at the address of an instance that a ReadWrite returns.
fn elements_agree(probe: &mut Probe<'_>, rules: [ClauseId; 2]) -> Step {
    let functions = [Function::FindInstance, Function::ReadElementLength];
    if functions.iter().any(|one| probe.claims(*one) != Claim::Yes) {
        return Ok(());
    }
    for channel in probe.channels()? {
        for class in [Class::Interpolator, Class::Decoder, Class::PathPreparation, Class::Hld] {
            let address = probe.address_of(class, channel.number().into(), 0)?;
            let first = address.and_then(|address| address.first_element().ok().flatten());
            let Some(first) = first else { continue };
            let Ok(count) = CountElements::new(first) else { continue };
            let data = ask_if_claimed(probe, count)?;
            let count = data.as_deref().and_then(decode_element_count);
            let expected = "a number of elements at the address of the object";
            probe.check(rules, count.is_some(), expected, || format!("{data:02x?}"));
            for place in 1..=count.unwrap_or_default().min(ITEMS_MAX) {
                let Ok(element) = first.nth(place) else { break };
                let Some(length) = probe.length_of(element)? else { continue };
                let Ok(read) = ReadElement::new(element, length) else { continue };
                let Some(data) = ask_if_claimed(probe, read)? else { continue };
                let found = || plural(data.len(), "byte");
                let same = u32::try_from(data.len()).is_ok_and(|len| len == length);
                probe.check(
                    ADS_1,
                    same,
                    || format!("{}, the length of the element", plural(length, "byte")),
                    found,
                );
            }
        }
    }
    Ok(())
}
