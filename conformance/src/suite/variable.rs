//! Cases of variables: their number, descriptions and names.

use std::collections::HashSet;

use ads_cnc::address::Channel;
use ads_cnc::operation::{
    CountVariables, DescribeByIndex, HandleByName, ReadByHandle, ReadByName, Request,
};
use ads_cnc::{Decode as _, Description, Kind, TextRef, U32List, VariableCount, VariablePath};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::kit::{ItemKind, Probe, VARIABLES_MAX, name_of};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, OrStop as _, Step, Stop, assumed};
use crate::objects::KINDS;
use crate::rules::check_description;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("var-count", &[VAR_1, VAR_2], Needs::Queries, count,
        "Each kind has a number of variables, and an empty kind returns their sum"),
    case("var-descriptions",
        &[VAR_1, VAR_2, VAR_3, VAR_4, VAR_5, VAR_6, VAR_7, VAR_8, VAR_9, GEN_1, GEN_3],
        Needs::Queries, descriptions,
        "Every index from 0 to the last has a consistent description"),
    case("var-index-beyond-last", &[VAR_1, VAR_2], Needs::Queries, index_beyond_last,
        "A request with the index after the last returns an error"),
    case("var-other-channel", &[VAR_2, VAR_3, VAR_14], Needs::Queries, other_channel,
        "A channel that does not exist has no variables"),
    case("var-structures-are-resolved", &[VAR_20], Needs::Queries, structures_are_resolved,
        "The name of a structure alone addresses no variable"),
    case("var-padded-name", &[VAR_1, VAR_9], Needs::Malformed, padded_name,
        "A name or a kind may be padded with NULs to 256 bytes"),
];

/// Requests the number of variables of a kind. A reply without a number fails a check and ends the
/// case.
fn number(probe: &mut Probe<'_>, channel: Channel, kind: Kind<'_>) -> Step<u32> {
    let data = probe.ask([VAR_1, VAR_2], CountVariables::new(channel, kind))?;
    let count = VariableCount::decode(&data);
    let found = || plural(data.len(), "byte");
    probe.require(VAR_2, count.is_ok(), "a number of 4 bytes", found)?;
    Ok(count?.0)
}

fn count(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let mut sum = 0_u32;
        for (_, kind) in probe.kinds() {
            sum = sum.saturating_add(number(probe, channel, kind)?);
        }
        let VariableCount(all) = probe.read(VAR_1, CountVariables::new(channel, Kind::ALL))?;
        let found = || format!("{all} of channel {}", channel.number());
        // The sum does not include kinds that are not claimed, but the target may have variables of
        // them.
        let whole = probe.kinds().len() == KINDS.len();
        let passed = if whole { all == sum } else { all >= sum };
        probe.check(VAR_1, passed, || format!("{} of all kinds", plural(sum, "variable")), found);
        if !probe.target.client.gate().lets_malformed_pass() {
            continue;
        }
        // It is assumed that a request without data returns the same number as one with an empty
        // kind.
        let absent = Kind::from_field(TextRef::with_tail(ads_cnc::CncStr::EMPTY, None));
        let exchange = probe.send(CountVariables::new(channel, absent))?;
        let data = exchange.reply().and_then(|reply| reply.success().map(<[u8]>::to_vec));
        let same = data.as_deref() == Some(&all.to_le_bytes());
        probe.check(assumed(VAR_1), same, || format!("{all}, as for a single NUL"), &exchange);
    }
    Ok(())
}

fn descriptions(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for (name, kind) in probe.kinds() {
            let number = number(probe, channel, kind)?;
            let chosen = probe.sample(ItemKind::Variable, 0..number);
            let mut names = HashSet::new();
            let mut all = Vec::new();
            // Names must be unique among all variables, so the first `VARIABLES_MAX` variables are
            // read, too, not only those of the sample.
            let last = chosen.iter().copied().filter(|index| *index >= VARIABLES_MAX);
            for index in (0..number.min(VARIABLES_MAX)).chain(last) {
                let is_chosen = chosen.binary_search(&index).is_ok();
                let variable: Description = if is_chosen {
                    probe.read(VAR_4, DescribeByIndex::new(channel, index, kind))?
                } else {
                    probe.judged_description(VAR_4, channel, (name, kind), index)?
                };
                probe.set_subject(&variable.name.text);
                check_description(probe, &variable, name);
                let unique = names.insert(variable.name.text.clone());
                let found = || format!("{} again at index {index}", variable.name.text);
                probe.check(VAR_3, unique, "a different variable at each index", found);
                all.extend(is_chosen.then_some((index, variable)));
            }
            probe.end_subject();
            descriptions_backwards(probe, channel, kind, &all)?;
        }
    }
    Ok(())
}

/// Reads the descriptions from the last index to the first. A difference counts only if the next
/// read returns the first description again; otherwise an axis may have moved to another axis index
/// meanwhile.
fn descriptions_backwards(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: Kind<'_>,
    all: &[(u32, Description)],
) -> Step {
    for &(index, ref first) in all.iter().rev() {
        let mut is_first = || -> Step<bool> {
            let read = probe.try_read(DescribeByIndex::new(channel, index, kind))?;
            Ok(read.as_ref() == Some(first))
        };
        let same = is_first()?;
        if same || is_first()? {
            let expected = || format!("{} at index {index} again", first.name.text);
            probe.check(VAR_3, same, expected, "another description");
        }
    }
    Ok(())
}

fn index_beyond_last(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for (_, kind) in probe.kinds() {
            let number = number(probe, channel, kind)?;
            let Some(last) = number.checked_sub(1) else {
                let first = DescribeByIndex::new(channel, 0, kind);
                probe.rejects_alone(VAR_2, "index 0 of an empty list", first)?;
                continue;
            };
            for index in probe.beyond(number) {
                probe.rejects(
                    VAR_2,
                    "the index after the last",
                    DescribeByIndex::new(channel, index, kind),
                    DescribeByIndex::new(channel, last, kind),
                )?;
            }
        }
    }
    Ok(())
}

fn other_channel(probe: &mut Probe<'_>) -> Step {
    let Some(absent) = probe.target.profile.absent_channel else {
        return Err(Stop::not_applicable(
            "no channel is known to be absent; a profile can name one",
        ));
    };
    let (channel, absent) = (probe.channel()?, Channel::new(absent)?);
    let what = format!("channel {}", absent.number());
    for (_, kind) in probe.kinds().into_iter().chain([("", Kind::ALL)]) {
        let count = |channel| CountVariables::new(channel, kind);
        probe.rejects(VAR_2, &what, count(absent), count(channel))?;
    }
    let variables = probe.variables(channel)?;
    let Some(known) = variables.first() else { return Ok(()) };
    let kind = VariablePath::from_text(known.name.text.as_cnc_str()).map(|path| path.kind());
    if let Some((_, kind)) = probe.kinds().into_iter().find(|(_, one)| Ok(*one) == kind) {
        let first = |channel| DescribeByIndex::new(channel, 0, kind);
        probe.rejects(VAR_3, &what, first(absent), first(channel))?;
    }
    let read = |channel| ReadByName { channel, name: name_of(known) };
    probe.rejects(VAR_14, &what, read(absent), read(channel))?;
    let read = |channel| ReadByHandle::new(channel, known.handle, U32List::EMPTY);
    probe.rejects(VAR_14, &what, read(absent), read(channel))
}

/// The structures that contain a variable, such as `V.E.a[0].b`, `V.E.a[0]` and `V.E.a` for
/// `V.E.a[0].b.c`.
fn structures(name: &str) -> Vec<&str> {
    let mut all = Vec::new();
    let mut rest = name;
    while let Some((structure, _)) = rest.rsplit_once('.') {
        // The rest of the name is a kind such as `V.E`, which is not a structure.
        if structure.matches('.').count() < 2 {
            break;
        }
        all.push(structure);
        if let Some((array, _)) = structure.rsplit_once('[').filter(|_| structure.ends_with(']')) {
            all.push(array);
        }
        rest = structure;
    }
    all
}

fn structures_are_resolved(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let Some(all) = probe.all_variables(channel)? else { continue };
        let names: HashSet<String> =
            all.iter().map(|variable| variable.name.text.to_string()).collect();
        let variables = probe.variables(channel)?;
        let mut tried = HashSet::new();
        for leaf in &variables {
            let name = leaf.name.text.to_string();
            // The name of an axis variable ends with the axis's name; the part before it is not a
            // structure.
            if name.starts_with("V.A.") {
                continue;
            }
            for structure in structures(&name) {
                if names.contains(structure) || !tried.insert(structure.to_owned()) {
                    continue;
                }
                let what = format!("the structure {structure}");
                let (name, valid) = (TextRef::new(structure)?, name_of(leaf));
                let handle = |name| HandleByName { channel, name };
                probe.rejects(VAR_20, &what, handle(name), handle(valid))?;
                let read = |name| ReadByName { channel, name };
                probe.rejects(VAR_20, &what, read(name), read(valid))?;
            }
        }
    }
    probe.finish("no variable is part of a structure")
}

fn padded_name(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let variable = variables.first().or_inconclusive("no variable")?;
    let text = variable.name.text.as_cnc_str();
    let plain = HandleByName { channel, name: text.into() };
    let zeros = [0; 256];
    let tail = zeros.get(..255_usize.saturating_sub(text.len()));
    let padded = HandleByName { channel, name: TextRef::with_tail(text, tail) };
    same(probe, VAR_9, plain.into(), padded.into())?;
    let tail = zeros.get(..252);
    let kind = Kind::from_field(TextRef::with_tail(Kind::V_E.text(), tail));
    let plain = CountVariables::new(channel, Kind::V_E);
    same(probe, VAR_1, plain.into(), CountVariables::new(channel, kind).into())
}

/// Sends a request in its usual form (`plain`) and in a form that is assumed to be permitted
/// (`odd`), and checks that both replies have the same data.
fn same(probe: &mut Probe<'_>, rule: ClauseId, plain: Request<'_>, odd: Request<'_>) -> Step {
    let expected = probe.send(plain)?;
    let exchange = probe.send(odd)?;
    let data = |exchange: &crate::exchange::Exchange| {
        exchange.reply().and_then(|reply| reply.success().map(<[u8]>::to_vec))
    };
    let passed = data(&exchange).is_some() && data(&exchange) == data(&expected);
    probe.check(assumed(rule), passed, "the same reply as without padding", &exchange);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_is_a_structure() {
        assert_eq!(structures("V.E.a"), [""; 0]);
        assert_eq!(structures("V.G.NP[0].V"), ["V.G.NP[0]", "V.G.NP"]);
        let all = ["V.E.a[0].b[12]", "V.E.a[0].b", "V.E.a[0]", "V.E.a"];
        assert_eq!(structures("V.E.a[0].b[12].c"), all);
    }
}
