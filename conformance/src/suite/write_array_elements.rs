//! Cases that write single elements of arrays and restore them.

use ads_cnc::address::Channel;
use ads_cnc::{Description, VariableAccess, VariablePath, VariableType};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use super::kit::{Probe, each_of_access, handle_of, same, write_check};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Rule, Step, assumed};
use crate::number::to_usize;
use crate::objects::ValueAddress;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-elements-by-handle", &[VAR_12], Needs::Writes, by_handle,
        "A write with a handle and an index changes the element at that position, and no other"),
    case("write-elements-by-name", &[VAR_13, VAR_20], Needs::Writes, by_name,
        "A write with a name and [index] changes the element at that position, and no other"),
];

/// The indices of the first and the last element. For several dimensions, also the indices of the
/// elements that have the last index in one dimension and index 0 in all others.
fn ends(dimensions: &[u32]) -> Vec<Vec<u32>> {
    let last = |count: &u32| count.saturating_sub(1);
    let mut places = vec![vec![0; dimensions.len()]];
    if dimensions.len() > 1 {
        for (axis, count) in dimensions.iter().enumerate() {
            let mut place = vec![0; dimensions.len()];
            place.iter_mut().skip(axis).take(1).for_each(|index| *index = last(count));
            places.push(place);
        }
    }
    places.push(dimensions.iter().map(last).collect());
    places.dedup();
    places
}

/// The position of an element in the array, counted from 0; the last index changes fastest.
fn number_of(place: &[u32], dimensions: &[u32]) -> usize {
    let number = place
        .iter()
        .zip(dimensions)
        .fold(0_u32, |number, (&index, &count)| number.saturating_mul(count).saturating_add(index));
    to_usize(number)
}

fn elements(
    probe: &mut Probe<'_>,
    rules: impl Fn(&Description) -> Vec<Rule>,
    place_of: impl Fn(&mut Probe<'_>, Channel, &Description, Vec<u32>) -> Step<Option<ValueAddress>>,
) -> Step {
    each_of_access(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let whole = ValueAddress::of_handle(channel, variable.handle);
        let arrays =
            if variable.dimensions.is_empty() { Vec::new() } else { ends(&variable.dimensions) };
        for indices in arrays {
            let brackets: String = indices.iter().map(|index| format!("[{index}]")).collect();
            let name = format!("{}{brackets}", variable.name.text);
            let number = number_of(&indices, &variable.dimensions);
            let Some(place) = place_of(probe, channel, variable, indices)? else { continue };
            if !probe.may_write(&place, &name)? {
                continue;
            }
            let before = probe.value_at(&whole)?.unwrap_or_default();
            let rules = rules(variable);
            let write_check = write_check(variable, &name, &rules);
            probe.try_write(&write_check, &place, |probe, old, new| {
                // Reading back an accepted value does not depend on the assumed layout of the
                // array. This check therefore has the level of the clauses, even if `rules` are
                // assumed.
                let read = probe.value_at(&place)?.unwrap_or_default();
                let is_text = variable.var_type == VariableType::STRING;
                let passed = same(&read, new, is_text);
                let expected = || format!("{} of {name}, as written", Hex(new.to_vec()));
                let stated: Vec<Rule> =
                    write_check.rules.iter().map(|rule| Rule::of(rule.id)).collect();
                probe.check(&stated[..], passed, expected, || Hex(read.clone()));
                // In the whole array, only this element must have changed.
                let mut expected = before.clone();
                let size = old.len();
                let start = number.saturating_mul(size);
                let part = expected.get_mut(start..start.saturating_add(size));
                part.unwrap_or_default().iter_mut().zip(new).for_each(|(byte, new)| *byte = *new);
                let after = probe.value_at(&whole)?.unwrap_or_default();
                let shown = || Hex(expected.clone());
                probe.check(write_check.rules, after == expected, shown, || Hex(after.clone()));
                Ok(())
            })?;
        }
        Ok(())
    })
}

/// The rules with these IDs. They are assumed for arrays with several dimensions and for arrays of
/// texts, whose layout is not documented.
fn of_order(variable: &Description, ids: &[ClauseId]) -> Vec<Rule> {
    let is_assumed = variable.dimensions.len() > 1 || variable.var_type == VariableType::STRING;
    ids.iter().map(|&id| if is_assumed { assumed(id) } else { id.into() }).collect()
}

fn by_handle(probe: &mut Probe<'_>) -> Step {
    let rules = |variable: &Description| of_order(variable, &[VAR_12]);
    elements(probe, rules, |probe, channel, variable, indices| {
        let handle = handle_of(probe, channel, variable)?;
        Ok(Some(ValueAddress::Handle { channel, handle, indices }))
    })
}

fn by_name(probe: &mut Probe<'_>) -> Step {
    let rules = |variable: &Description| of_order(variable, &[VAR_13, VAR_20]);
    elements(probe, rules, |_, channel, variable, indices| {
        let path = VariablePath::from_text(variable.name.text.as_cnc_str()).ok();
        let name = path.and_then(|path| path.element(indices.as_slice().into()).ok());
        Ok(name.map(|name| ValueAddress::Name { channel, name }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_tried_once_each() {
        assert_eq!(ends(&[5]), [[0], [4]]);
        assert_eq!(ends(&[1]), [[0]]);
        assert_eq!(ends(&[2, 3]), [[0, 0], [1, 0], [0, 2], [1, 2]]);
    }

    #[test]
    fn the_last_index_runs_fastest() {
        assert_eq!(number_of(&[1, 0, 2], &[2, 3, 4]), 14);
        assert_eq!(number_of(&[], &[]), 0);
    }
}
