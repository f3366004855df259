//! Variables and parts of their values.

use std::collections::HashMap;
use std::ops::Range;

use ads_cnc::service::ServiceVariable;
use ads_cnc::{CncString, ExtendedDescription, Handle, U32List, VariableAccess, VariableType};

use super::item::Initial;
use crate::number::to_usize;

/// A variable, or the V.A variable of every axis.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::simulator) struct Variable {
    /// The name with its kind, without the name of an axis.
    pub(in crate::simulator) name: CncString,
    /// The handle; `None` if the variable is accessible by name only. For V.A, the handle without
    /// the place and the channel, which [`handle_at`] adds.
    pub(in crate::simulator) handle: Option<Handle>,
    pub(in crate::simulator) var_type: VariableType,
    pub(in crate::simulator) access: VariableAccess,
    /// Number of elements in each dimension; empty for an elementary variable.
    pub(in crate::simulator) dimensions: Vec<u32>,
    /// The initial values of all elements; the last index changes fastest.
    pub(in crate::simulator) initial: Initial,
    /// The extended description; only for V.E.
    pub(in crate::simulator) extended: Option<ExtendedDescription>,
    /// The corresponding variable of the Service Interface, if any.
    pub(in crate::simulator) service: Option<ServiceVariable>,
}

impl Variable {
    pub(in crate::simulator) fn is_writable(&self) -> bool {
        self.access == VariableAccess::READ_WRITE
    }

    /// The byte range in the value: without indices, the whole value; with one index for each
    /// dimension, one element. `None` for another number of indices, or an index out of bounds.
    pub(in crate::simulator) fn part(&self, indices: U32List<'_>) -> Option<Range<usize>> {
        if indices.is_empty() {
            return Some(0..self.initial.size);
        }
        if indices.len() != self.dimensions.len() {
            return None;
        }
        let (mut place, mut count) = (0_usize, 1_usize);
        for (index, &elements) in indices.iter().zip(&self.dimensions) {
            if index >= elements {
                return None;
            }
            place = place.checked_mul(to_usize(elements))?.checked_add(to_usize(index))?;
            count = count.checked_mul(to_usize(elements))?;
        }
        let size = self.initial.size.checked_div(count)?;
        let start = place.checked_mul(size)?;
        Some(start..start.checked_add(size)?)
    }

    /// Whether the indices select one STRING, for which a written value may be shorter.
    pub(in crate::simulator) fn is_text(&self, indices: U32List<'_>) -> bool {
        self.var_type == VariableType::STRING && indices.len() == self.dimensions.len()
    }
}

/// Variables, which can be found by their names.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::simulator) struct Variables {
    pub(in crate::simulator) list: Vec<Variable>,
    pub(super) by_name: HashMap<Vec<u8>, usize>,
}

impl Variables {
    /// The index in `list` of the variable with exactly this name.
    pub(in crate::simulator) fn named(&self, name: &[u8]) -> Option<usize> {
        self.by_name.get(name).copied()
    }
}

/// A variable of a channel or of an axis of the channel, by its index in [`Variables::list`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::simulator) enum VariableRef {
    /// A variable of the channel.
    Channel(usize),
    /// The variable of the axis at a place (axis index less 1) of the channel (VAR-10).
    Axis { place: usize, variable: usize },
}

/// The handle of an axis variable at a place (counted from 1) of a channel. The manual prints
/// 0x0102001B for the second place of channel 1.
pub(in crate::simulator) fn handle_at(of_axis: Handle, channel: u8, place: u8) -> Handle {
    let channel = u32::from(channel).saturating_sub(1);
    Handle(of_axis.0 | u32::from(place) << 16 | channel << 8)
}

#[cfg(test)]
mod tests {
    use super::super::item::InitialValues;
    use super::*;

    fn cube() -> Variable {
        Variable {
            name: "V.E.cube".parse().unwrap(),
            handle: None,
            var_type: VariableType::SGN16,
            access: VariableAccess::READ_ONLY,
            dimensions: vec![2, 3, 4],
            initial: Initial { size: 48, values: InitialValues::Same(vec![0; 48]) },
            extended: None,
            service: None,
        }
    }

    #[test]
    fn the_last_index_changes_fastest() {
        let cube = cube();
        assert_eq!(cube.part(U32List::from(&[0, 0, 1])), Some(2..4));
        assert_eq!(cube.part(U32List::from(&[0, 1, 0])), Some(8..10));
        assert_eq!(cube.part(U32List::from(&[1, 2, 3])), Some(46..48));
        assert_eq!(cube.part(U32List::EMPTY), Some(0..48));
    }

    #[test]
    fn wrong_indices_have_no_part() {
        let cube = cube();
        for indices in [&[2, 0, 0][..], &[0, 3, 0], &[0, 0, 4], &[u32::MAX; 3], &[0], &[0; 4]] {
            assert_eq!(cube.part(U32List::from(indices)), None, "{indices:?}");
        }
        let elementary = Variable { dimensions: vec![], ..cube };
        assert_eq!(elementary.part(U32List::from(&[0])), None);
    }
}
