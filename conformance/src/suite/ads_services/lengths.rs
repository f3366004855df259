//! Cases of the lengths of replies, and of requests that are sent in pieces.

use ads_cnc::address::Class;
use ads_cnc::operation::{
    CountObjects, CountVariables, DescribeByIndex, FindInstance, Function, ReadByName, Request,
};
use ads_cnc::{Kind, VariableType};
use ads_cnc_vectors::ids::*;

use self::LengthRule::{Fixed, Open};
use crate::ads_service::clause;
use crate::judge::{Checks as _, IfPresent as _, Rule, Step, assumed};
use crate::number::to_u32;
use crate::profile::Claim;
use crate::suite::kit::{ChannelItems, Probe, RawCall, ask_if_claimed, content_reads, name_of};
use crate::text::plural;

/// Sends requests in pieces of at most 37, 6 and 1 bytes. TCP may split a frame anywhere, so only
/// the length field of the frame determines where the frame ends.
pub(super) fn in_pieces(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let requests: [Request<'_>; 2] =
        [CountVariables::new(channel, Kind::V_G).into(), CountObjects::new(channel).into()];
    for request in requests {
        let Some(whole) = ask_if_claimed(probe, request)? else { continue };
        for piece in [37, 6, 1] {
            probe.target.client.set_piece(Some(piece));
            let exchange = probe.send(request);
            probe.target.client.set_piece(None);
            let exchange = exchange?;
            let same = exchange.success() == Some(&whole[..]);
            let expected =
                || format!("the same reply to a frame sent in pieces of {}", plural(piece, "byte"));
            probe.check(ADS_5, same, expected, &exchange);
        }
    }
    probe.finish("the target claims no function that can be requested")
}

/// Whether a case judges the length of the data of a reply as fixed by a requirement.
#[derive(Clone, Copy)]
enum LengthRule {
    /// The length is fixed by this requirement.
    Fixed(Rule),
    /// The length is not judged as fixed, because it may depend on the length of a text.
    Open,
}

pub(super) fn read_length(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        lengths_of(probe, &RawCall::new(CountObjects::new(channel))?)?;
        for (_, kind) in probe.kinds() {
            lengths_of(probe, &RawCall::new(CountVariables::new(channel, kind))?)?;
            for index in 0..2 {
                lengths_of(probe, &RawCall::new(DescribeByIndex::new(channel, index, kind))?)?;
            }
        }
        for variable in probe.variables(channel).if_known()?.unwrap_or_default() {
            if variable.var_type != VariableType::STRING {
                let read = ReadByName { channel, name: name_of(&variable) }.into();
                lengths(probe, &RawCall::new(read)?, &read, Fixed(VAR_14.into()))?;
            }
        }
        let decoder = FindInstance::new(Class::Decoder, channel.number().into(), 0);
        lengths_of(probe, &RawCall::new(decoder)?)?;
        let items = ChannelItems::read(probe, channel)?;
        for request in items.requests(channel)? {
            lengths_of(probe, &RawCall::new(request)?)?;
        }
        for call in content_reads(probe, channel)? {
            lengths_of(probe, &call)?;
        }
    }
    Ok(())
}

/// Whether a requirement fixes the length of the reply to a request. The length of a variable's
/// value is `Open` here, because the variable may be a text. The callers leave out objects and
/// elements that are texts.
fn length_rule(request: &Request<'_>) -> LengthRule {
    let spec = request.function().spec();
    let is_number = spec.reply.is_some_and(|stream| stream.layout().is_fixed());
    match request.function() {
        Function::ReadElementLength | Function::ReadObject => Fixed(Rule::of(spec.clause)),
        Function::ReadElement => Fixed(SDA_8.into()),
        // Extended descriptions of V.G and V.A have no data and are not judged.
        Function::DescribeExtended => Fixed(assumed(VAR_15)),
        _ if is_number => Fixed(Rule::of(spec.clause)),
        _ => Open,
    }
}

fn lengths_of(probe: &mut Probe<'_>, call: &RawCall) -> Step {
    let Ok(request) = call.call().dispatch() else { return Ok(()) };
    lengths(probe, call, &request, length_rule(&request))
}

fn lengths(
    probe: &mut Probe<'_>,
    call: &RawCall,
    request: &Request<'_>,
    extent: LengthRule,
) -> Step {
    if probe.claims(request.function()) != Claim::Yes {
        return Ok(());
    }
    let what = request.function().spec().name;
    let rule = clause(call.service);
    let whole = probe.call(call)?;
    let Some(whole) = whole.success().filter(|data| !data.is_empty()) else { return Ok(()) };
    let there = to_u32(whole.len());
    let answer = |probe: &mut Probe<'_>, read_length: u32| -> Step<Option<Option<usize>>> {
        let call = call.with(|call| call.read_length = read_length);
        // The gate may reject other lengths.
        if probe.target.client.check(&call.call()).is_err() {
            return Ok(None);
        }
        let exchange = probe.call(&call)?;
        Ok(Some(exchange.success().map(<[u8]>::len)))
    };
    let shown = |found: Option<usize>| {
        move || found.map_or_else(|| "an error".to_owned(), |len| plural(len, "byte"))
    };
    // A read length that equals the length of the data is checked only for fixed lengths: for a
    // text at the end of a reply, the CNC may require space for a NUL.
    if let Fixed(own) = extent
        && let Some(found) = answer(probe, there)?
    {
        let expected = || format!("all {} of {what}", plural(there, "byte"));
        let rules = [rule.into(), own];
        probe.check(&rules[..], found == Some(whole.len()), expected, shown(found));
    }
    // A success with a shorter read length must have less data.
    if let Some(found) = answer(probe, there.saturating_sub(1))? {
        let fits = found.is_none_or(|len| len < whole.len());
        let expected = || format!("fewer than {} of {what}", plural(there, "byte"));
        probe.check(rule, fits, expected, shown(found));
    }
    let Fixed(own) = extent else { return Ok(()) };
    if !probe.target.client.gate().lets_malformed_pass() {
        return Ok(());
    }
    // A longer read length must not return more data.
    if let Some(found) = answer(probe, there.saturating_add(5))? {
        let fits = found.is_none_or(|len| len <= whole.len());
        let expected = || format!("{} of {what}, or an error", plural(there, "byte"));
        let rules = [rule.into(), own];
        probe.check(&rules[..], fits, expected, shown(found));
    }
    // If a large read length is accepted for a reply of fixed length, a read length that is one
    // byte smaller must return the same number of bytes.
    let is_number =
        request.function().spec().reply.is_some_and(|stream| stream.layout().is_fixed());
    let much = there.saturating_add(0x1_0000);
    if is_number
        && let Some(Some(len)) = answer(probe, much)?
        && let Some(found) = answer(probe, much.saturating_sub(1))?
    {
        let expected =
            || format!("{} of {what}, as with a longer read length", plural(len, "byte"));
        probe.check([rule, ADS_4], found == Some(len), expected, shown(found));
    }
    Ok(())
}
