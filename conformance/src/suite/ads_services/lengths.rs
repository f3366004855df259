//! Lengths of replies, and splitting of frames.

use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{
    CountDynamic, CountObjects, CountVariables, DescribeByIndex, DynamicNameByIndex, ReadByName,
    Request,
};
use ads_cnc::{Kind, VariableType};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Step};
use crate::profile::Claim;
use crate::suite::kit::{Probe, RawCall, ask_if_claimed, name_of};
use crate::wire_service::clause;

/// TCP may split a frame anywhere: its length determines its end.
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
            let expected = || format!("the same to a frame in pieces of {piece} bytes");
            probe.check(ADS_5, same, expected, &exchange);
        }
    }
    probe.finish("nothing to be asked is claimed")
}

/// Whether the length of a reply is documented, or given by a text.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LengthRule {
    /// Fixed by this requirement.
    Fixed(ClauseId),
    Open,
}

pub(super) fn read_length(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for kind in DynamicKind::ALL {
            lengths_of(probe, CountDynamic::new(channel, kind).into(), LengthRule::Fixed(DYN_1))?;
            let name = DynamicNameByIndex::new(channel, kind, 1)?;
            lengths_of(probe, name.into(), LengthRule::Open)?;
        }
        for (_, kind) in probe.kinds() {
            let count = CountVariables::new(channel, kind);
            lengths_of(probe, count.into(), LengthRule::Fixed(VAR_2))?;
            for index in 0..2 {
                let described = DescribeByIndex::new(channel, index, kind);
                lengths_of(probe, described.into(), LengthRule::Open)?;
            }
        }
        let Ok(variables) = probe.variables(channel) else { continue };
        for variable in variables {
            if variable.var_type != VariableType::STRING {
                let read = ReadByName { channel, name: name_of(&variable) };
                lengths_of(probe, read.into(), LengthRule::Fixed(VAR_14))?;
            }
        }
    }
    Ok(())
}

fn lengths_of(probe: &mut Probe<'_>, request: Request<'_>, extent: LengthRule) -> Step {
    if probe.claims(request.function()) != Claim::Yes {
        return Ok(());
    }
    let call = RawCall::new(request)?;
    let rule = clause(call.service);
    let Some(whole) = ask_if_claimed(probe, request)?.filter(|data| !data.is_empty()) else {
        return Ok(());
    };
    let there = u32::try_from(whole.len()).unwrap_or(u32::MAX);
    let answer = |probe: &mut Probe<'_>, read_length: u32| -> Step<Option<Option<usize>>> {
        let call = call.with(|call| call.read_length = read_length);
        // The gate may reject other lengths.
        if probe.target.client.check(&call.call()).is_err() {
            return Ok(None);
        }
        let exchange = probe.call(&call)?;
        Ok(Some(exchange.success().map(<[u8]>::len)))
    };
    let what = request.function().spec().name;
    // For a text at the end of a reply the CNC may require room for a NUL.
    if let LengthRule::Fixed(own) = extent
        && let Some(found) = answer(probe, there)?
    {
        let expected = || format!("{there} bytes of {what}, as many as are asked for");
        probe.check([rule, own], found == Some(whole.len()), expected, || format!("{found:?}"));
    }
    // A success with a shorter read length must not have more data.
    if let Some(found) = answer(probe, there.saturating_sub(1))? {
        let fits = found.is_none_or(|len| len < whole.len());
        let expected = || format!("fewer than {there} bytes of {what}");
        probe.check(rule, fits, expected, || format!("{found:?}"));
    }
    let LengthRule::Fixed(own) = extent else { return Ok(()) };
    if !probe.target.client.gate().lets_malformed_pass() {
        return Ok(());
    }
    // No data follows the reply.
    if let Some(found) = answer(probe, there.saturating_add(5))? {
        let fits = found.is_none_or(|len| len <= whole.len());
        let expected = || format!("{there} bytes of {what}, or an error");
        probe.check([rule, own], fits, expected, || format!("{found:?}"));
    }
    // If a large read length is accepted, one byte less makes no difference.
    let much = there.saturating_add(0x1_0000);
    if own != VAR_14
        && let Some(Some(len)) = answer(probe, much)?
        && let Some(found) = answer(probe, much.saturating_sub(1))?
    {
        let expected = || format!("{len} bytes of {what}, as with more room");
        probe.check([rule, ADS_4], found == Some(len), expected, || format!("{found:?}"));
    }
    Ok(())
}
