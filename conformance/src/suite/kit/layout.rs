//! The layout of the elements of an array.

use ads_cnc::limits::TEXT_MAX;
use ads_cnc::{CncString, Description, VariableType};
use ads_cnc_vectors::Level;
use ads_cnc_vectors::ids::*;

use crate::judge::{Rule, Step, assumed};
use crate::number::to_usize;
use crate::rules::element_count;

/// Size of one element in bytes; `None` if it is unknown. For a type without a fixed size, such as
/// a text, this is the size of the array divided by the number of its elements.
pub(crate) fn element_size(variable: &Description) -> Option<usize> {
    let share =
        variable.size.checked_div(element_count(&variable.dimensions)).filter(|size| *size > 0);
    usize::try_from(variable.var_type.element_size().or(share)?).ok()
}

/// Maximum number of elements at the start of an array that are read one by one.
const ELEMENTS_MAX: usize = 64;

/// Whether the element at this position, counted from 0, is read: the first 64 elements, those at
/// the positions 255 to 257 (the limit of one byte), and the last two of `count` elements.
fn is_tried(number: usize, count: usize) -> bool {
    number < ELEMENTS_MAX || (255..=257).contains(&number) || number.saturating_add(2) >= count
}

/// The elements of an array that are read one by one: for each, its position in the array, counted
/// from 0, and its indices.
pub(crate) fn places_tried(
    dimensions: &[u32],
) -> impl Iterator<Item = (usize, Vec<u32>)> + use<'_> {
    let count = to_usize(element_count(dimensions));
    // The value that a reply returns has at most 2048 bytes, so it has at most 2048 elements.
    let all = places(dimensions).take(2048).enumerate();
    all.filter(move |(number, _)| is_tried(*number, count))
}

/// Indices of the elements of an array in row-major order: the last index changes fastest.
fn places(dimensions: &[u32]) -> impl Iterator<Item = Vec<u32>> + use<'_> {
    let mut next = Some(vec![0; dimensions.len()]);
    std::iter::from_fn(move || {
        let indices = next.take()?;
        let mut following = indices.clone();
        let axes = following.iter_mut().zip(dimensions).rev();
        for (index, &dimension) in axes {
            let index: &mut u32 = index;
            *index = index.saturating_add(1);
            if *index < dimension {
                next = Some(following);
                break;
            }
            *index = 0;
        }
        Some(indices)
    })
}

/// The rule for the order of the elements in an array: for several dimensions and for texts, the
/// assumed order (VAR-21); otherwise the requirement on values, which the manuals state (VAR-14).
pub(crate) fn order(variable: &Description) -> Rule {
    let texts = variable.var_type == VariableType::STRING;
    if variable.dimensions.len() > 1 || texts { assumed(VAR_21) } else { VAR_14.into() }
}

/// Returns a function that extracts one element from the bytes of the whole array. `number` is the
/// position of the element, counted from 0; `size` is the size of an element in bytes, not 0. The
/// function returns no bytes if the array ends before the element.
pub(crate) fn part(number: usize, size: usize) -> impl Fn(&[u8]) -> Vec<u8> {
    move |whole| whole.chunks(size).nth(number).unwrap_or_default().to_vec()
}

/// The rule for names with indices: assumed for several dimensions, and for texts in an array.
/// VAR-20
pub(crate) fn brackets(variable: &Description) -> Rule {
    match order(variable).level {
        Some(Level::Info) => assumed(VAR_20),
        _ => VAR_20.into(),
    }
}

/// The name of a variable, followed by indices in brackets; `None` if it is too long for a request.
pub(crate) fn element_name(variable: &Description, indices: &[u32]) -> Step<Option<CncString>> {
    let mut name = variable.name.text.to_string();
    indices.iter().for_each(|index| name.push_str(&format!("[{index}]")));
    let name: CncString = name.parse()?;
    Ok(Some(name).filter(|name| name.as_bytes().len() < TEXT_MAX))
}
