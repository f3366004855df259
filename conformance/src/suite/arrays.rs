//! Cases of the bounds of arrays, and of the number of indices.

use ads_cnc::Description;
use ads_cnc::operation::{ReadByHandle, ReadByName};
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, brackets, each_array, each_variable, element_name};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step, assumed};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("val-array-has-elements", &[VAR_4, VAR_7], Needs::Queries, array_has_elements,
        "An array has all elements that its dimensions specify, up to the last of each dimension"),
    case("val-index-out-of-bounds", &[VAR_11, VAR_20], Needs::Queries, index_out_of_bounds,
        "A read with an index outside the array returns an error"),
    case("val-number-of-indices", &[VAR_11], Needs::Queries, number_of_indices,
        "A read with too few or too many indices returns an error"),
];

/// Returns `indices` with the index in the dimension `axis`, counted from 0, replaced by `index`.
fn with(indices: &[u32], axis: usize, index: u32) -> Vec<u32> {
    let mut indices = indices.to_vec();
    indices.iter_mut().skip(axis).take(1).for_each(|one| *one = index);
    indices
}

/// Checks that a variable with dimensions has elements. The last element of each dimension is read
/// only if the first element of the array can be read, because it is only assumed how elements are
/// addressed in several dimensions.
fn array_has_elements(probe: &mut Probe<'_>) -> Step {
    each_array(probe, |probe, channel, variable, _| {
        let Description { handle, dimensions, name, .. } = variable;
        let first = vec![0; dimensions.len()];
        let ask = |probe: &mut Probe<'_>, indices: &[u32]| {
            probe.try_ask(ReadByHandle::new(channel, *handle, indices))
        };
        let whole_is_there = ask(probe, &[])?.is_some();
        let has_first = ask(probe, &first)?.is_some();
        if dimensions.len() == 1 && whole_is_there {
            let expected = || format!("element 0 of {name}, or no dimension", name = name.text);
            probe.check([VAR_4, VAR_7], has_first, expected, "an error");
        }
        if !has_first {
            return Ok(());
        }
        for (axis, count) in dimensions.iter().enumerate() {
            let last = with(&first, axis, count.saturating_sub(1));
            let is_there = ask(probe, &last)?.is_some();
            let expected = || format!("{last:?} of the {dimensions:?} elements of {}", name.text);
            probe.check(VAR_4, is_there, expected, "an error");
        }
        Ok(())
    })
}

fn index_out_of_bounds(probe: &mut Probe<'_>) -> Step {
    each_array(probe, |probe, channel, variable, _| {
        let first = vec![0; variable.dimensions.len()];
        for (axis, &dimension) in variable.dimensions.iter().enumerate() {
            for beyond in probe.beyond(dimension) {
                let indices = with(&first, axis, beyond);
                let what = format!("{indices:?} of {:?}", variable.dimensions);
                let (invalid, valid) = (&indices, &first);
                probe.rejects(
                    VAR_11,
                    &what,
                    ReadByHandle::new(channel, variable.handle, invalid),
                    ReadByHandle::new(channel, variable.handle, valid),
                )?;
            }
            for beyond in probe.beyond(dimension) {
                let indices = with(&first, axis, beyond);
                let invalid = element_name(variable, &indices)?;
                let (Some(invalid), Some(valid)) = (invalid, element_name(variable, &first)?)
                else {
                    continue;
                };
                probe.rejects(
                    brackets(variable),
                    &format!("the name {invalid}"),
                    ReadByName { channel, name: invalid.as_cnc_str().into() },
                    ReadByName { channel, name: valid.as_cnc_str().into() },
                )?;
            }
        }
        Ok(())
    })
}

fn number_of_indices(probe: &mut Probe<'_>) -> Step {
    each_variable(probe, |probe, channel, variable| {
        let m = variable.dimensions.len();
        let zeros = vec![0; m.saturating_add(1)];
        for n in [m.saturating_sub(1), m.saturating_add(1)] {
            if n == 0 {
                continue;
            }
            let few = zeros.get(..n).unwrap_or_default();
            let valid = zeros.get(..m).unwrap_or_default();
            probe.rejects(
                assumed(VAR_11),
                &format!("{} for {}", plural(n, "index"), plural(m, "dimension")),
                ReadByHandle::new(channel, variable.handle, few),
                ReadByHandle::new(channel, variable.handle, valid),
            )?;
        }
        Ok(())
    })
}
