//! Cases of the lookup of variables by name, and of types that another manual states.

use ads_cnc::address::Channel;
use ads_cnc::limits::TEXT_MAX;
use ads_cnc::operation::{HandleByName, ReadByName};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{CncStr, CncString, TextRef};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use super::kit::{Probe, name_of};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, OrStop as _, Step};

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("var-unknown-name", &[ADS_4, VAR_9, VAR_10], Needs::Queries, unknown_name,
        "A request with an unknown name returns an error"),
    case("var-similar-name", &[VAR_9, VAR_20], Needs::Queries, similar_name,
        "A name with a different character or index does not address the variable"),
    case("var-known-types", &[VAR_5], Needs::Queries, known_types,
        "A variable with a documented type has the number of that type"),
];

fn unknown_name(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let known = variables.first().or_inconclusive("no variable")?;
    let known = name_of(known);
    for name in ["V.E.no such variable", "V.E.", "V.X.a", "no kind", ""] {
        let (what, name) = (format!("the name {name:?}"), TextRef::new(name)?);
        let (handle, valid) =
            (HandleByName { channel, name }, HandleByName { channel, name: known });
        probe.rejects(ADS_4, &what, handle, valid)?;
        let valid = ReadByName { channel, name: known };
        probe.rejects(ADS_4, &what, ReadByName { channel, name }, valid)?;
        // A success, even without data, would mean that a variable has this name.
        let given = probe.try_ask(handle)?;
        let none = given.is_none();
        let found = || Hex(given.clone().unwrap_or_default());
        probe.check(
            [VAR_9, VAR_10],
            none,
            || format!("no handle for {what}"),
            || format!("{} for this name", found()),
        );
    }
    Ok(())
}

/// Maximum number of names of a channel that are tried, the longest first.
const NAMES_MAX: usize = 64;

/// Names similar to `name`: one character longer, one character shorter, with another last
/// character, and with another character in the middle.
fn similar_names(name: &[u8]) -> Vec<Vec<u8>> {
    let other = |at: usize| {
        let mut other = name.to_vec();
        other.iter_mut().skip(at).take(1).for_each(|byte| {
            *byte = if *byte == b'q' { b'x' } else { b'q' };
        });
        other
    };
    let Some((_, shorter)) = name.split_last() else { return Vec::new() };
    let longer = [name, &b"q"[..]].concat();
    // The changed character in the middle is after the kind (`V.E.`), because a name with a wrong
    // kind would be rejected for its kind.
    let middle =
        name.len().saturating_sub(4).checked_div(2).map_or(4, |half| half.saturating_add(4));
    vec![longer, shorter.to_vec(), other(name.len().saturating_sub(1)), other(middle)]
}

/// Names in which an index is far out of bounds; some of these indices have the lower bytes of the
/// valid index.
fn other_structures(name: &str) -> Vec<String> {
    let mut all = Vec::new();
    for (at, _) in name.match_indices('[') {
        let (head, tail) = name.split_at_checked(at.saturating_add(1)).unwrap_or_default();
        let Some((index, tail)) = tail.split_once(']') else { continue };
        let Ok(index) = index.parse::<u32>() else { continue };
        for other in [index | 0x1_0000, index | 0x100_0000, u32::MAX] {
            all.push(format!("{head}{other}]{tail}"));
        }
    }
    all
}

fn similar_name(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let Some(all) = probe.all_variables(channel)? else { continue };
        let mut variables = probe.variables(channel)?;
        // Upper and lower case are taken as equal, because no manual states whether names are
        // case-sensitive.
        let is_there =
            |name: &[u8]| all.iter().any(|one| one.name.text.as_bytes().eq_ignore_ascii_case(name));
        variables.sort_by_key(|one| std::cmp::Reverse(one.name.text.as_bytes().len()));
        for known in variables.iter().take(NAMES_MAX) {
            let others = similar_names(known.name.text.as_bytes()).into_iter();
            let fits = |name: &Vec<u8>| name.len() < TEXT_MAX && !is_there(name);
            let name = known.name.text.to_string();
            for other in other_structures(&name) {
                let Ok(other) = other.parse::<CncString>() else { continue };
                if fits(&other.as_bytes().to_vec()) {
                    apart(probe, channel, VAR_20, other.as_cnc_str(), name_of(known))?;
                }
            }
            for other in others.filter(fits) {
                let Ok(other) = CncStr::from_bytes(&other) else { continue };
                apart(probe, channel, VAR_9, other, name_of(known))?;
            }
        }
    }
    probe.finish("the target has too many variables to know all names")
}

fn apart(
    probe: &mut Probe<'_>,
    channel: Channel,
    rule: ClauseId,
    other: CncStr<'_>,
    known: TextRef<'_>,
) -> Step {
    let (what, name) = (format!("the name {other}"), TextRef::from(other));
    let valid = HandleByName { channel, name: known };
    probe.rejects(rule, &what, HandleByName { channel, name }, valid)?;
    let valid = ReadByName { channel, name: known };
    probe.rejects(rule, &what, ReadByName { channel, name }, valid)
}

/// Checks the types of the variables of the Service Interface, which the manual of the Service
/// Interface states.
fn known_types(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            let name = variable.name.text.to_string();
            let Some(of_service) = ServiceVariable::by_name(&name) else { continue };
            let expected = || format!("the type {} of {name}", of_service.var_type());
            let found = || variable.var_type.to_string();
            probe.check(VAR_5, variable.var_type == of_service.var_type(), expected, found);
        }
    }
    probe.finish("no variable has a documented type")
}
