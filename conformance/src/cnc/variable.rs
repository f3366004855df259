//! A variable, and what its name addresses.

use ads_cnc::{CncString, DescriptionRef, Handle, TextRef, VariableAccess, VariableType};

use super::{to_len, to_u32};

/// A variable of a channel.
///
/// [`Model::new`](super::Model::new) checks that the parts fit each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Handle, unique in its channel.
    pub handle: Handle,
    /// Name, with `V.E.`, `V.G.` or `V.A.` in front; for an axis variable the axis's name behind.
    pub name: CncString,
    /// Type of the variable or of its elements.
    pub var_type: VariableType,
    /// Whether it may be written.
    pub access: VariableAccess,
    /// Elements in each dimension; none for an elementary variable.
    pub dimensions: Vec<u32>,
    /// The value: all elements, the last index running fastest. Each STRING has the bytes it is
    /// declared with, a NUL among them.
    pub bytes: Vec<u8>,
}

impl Variable {
    /// Its description.
    pub fn description(&self) -> DescriptionRef<'_> {
        DescriptionRef {
            handle: self.handle,
            var_type: self.var_type,
            access: self.access,
            size: to_u32(self.bytes.len()),
            dimensions: self.dimensions.as_slice().into(),
            name: TextRef::from(self.name.as_cnc_str()),
        }
    }

    /// The whole value without indices, one element with one index for each dimension.
    ///
    /// None for another number of indices, and for an index that is out of bounds.
    pub fn element(&self, indices: &[u32]) -> Option<&[u8]> {
        if indices.is_empty() {
            return Some(&self.bytes);
        }
        if indices.len() != self.dimensions.len() {
            return None;
        }
        let (mut place, mut count) = (0_usize, 1_usize);
        for (&index, &elements) in indices.iter().zip(&self.dimensions) {
            if index >= elements {
                return None;
            }
            place = place.checked_mul(to_len(elements))?.checked_add(to_len(index))?;
            count = count.checked_mul(to_len(elements))?;
        }
        let size = self.bytes.len().checked_div(count)?;
        let start = place.checked_mul(size)?;
        self.bytes.get(start..start.checked_add(size)?)
    }

    /// `V.E`, `V.G` or `V.A`; none for a name of another kind.
    pub(super) fn kind(&self) -> Option<&'static str> {
        KINDS.into_iter().find(|kind| {
            let rest = self.name.as_bytes().strip_prefix(kind.as_bytes());
            rest.is_some_and(|rest| rest.len() > 1 && rest.starts_with(b"."))
        })
    }
}

/// The kinds that have numbers and descriptions.
pub(super) const KINDS: [&str; 3] = ["V.E", "V.G", "V.A"];

/// Takes the `[i]` at the end of a name off: what is left, and the indices in their order.
///
/// None if they are no numbers. An `[i]` before a dot is part of the name.
pub(super) fn split_indices(mut name: &[u8]) -> Option<(&[u8], Vec<u32>)> {
    let mut indices = Vec::new();
    while let Some(inner) = name.strip_suffix(b"]") {
        let bracket = inner.iter().rposition(|&byte| byte == b'[')?;
        let (rest, digits) = inner.split_at_checked(bracket)?;
        indices.push(number(digits.strip_prefix(b"[")?)?);
        name = rest;
    }
    indices.reverse();
    Some((name, indices))
}

/// Digits and nothing else: `from_str` would take a sign.
fn number(digits: &[u8]) -> Option<u32> {
    if !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    std::str::from_utf8(digits).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Variable {
        Variable {
            handle: Handle(1),
            name: "V.E.cube".parse().unwrap(),
            var_type: VariableType::SGN16,
            access: VariableAccess::READ_ONLY,
            dimensions: vec![2, 3, 4],
            bytes: (0_i16..24).flat_map(i16::to_le_bytes).collect(),
        }
    }

    #[test]
    fn the_last_index_runs_fastest() {
        let cube = cube();
        assert_eq!(cube.element(&[0, 0, 1]), Some(&[1, 0][..]));
        assert_eq!(cube.element(&[0, 1, 0]), Some(&[4, 0][..]));
        assert_eq!(cube.element(&[1, 2, 3]), Some(&[23, 0][..]));
        assert_eq!(cube.element(&[]).map(<[u8]>::len), Some(48));
    }

    #[test]
    fn indices_out_of_bounds_or_of_another_number_address_nothing() {
        let cube = cube();
        for indices in [&[2, 0, 0][..], &[0, 3, 0], &[0, 0, 4], &[u32::MAX; 3], &[0], &[0; 4]] {
            assert_eq!(cube.element(indices), None, "{indices:?}");
        }
        let elementary = Variable { dimensions: vec![], ..cube };
        assert_eq!(elementary.element(&[0]), None);
    }

    #[test]
    fn only_indices_at_the_end_are_split_off() {
        let split = |name: &'static str| split_indices(name.as_bytes());
        assert_eq!(split("V.E.a"), Some((&b"V.E.a"[..], vec![])));
        assert_eq!(split("V.G.NP[0].V"), Some((&b"V.G.NP[0].V"[..], vec![])));
        assert_eq!(split("V.G.NP[0].V[1]"), Some((&b"V.G.NP[0].V"[..], vec![1])));
        assert_eq!(split("V.E.a[1][20]"), Some((&b"V.E.a"[..], vec![1, 20])));
        for name in ["V.E.a[]", "V.E.a[x]", "V.E.a[+1]", "V.E.a]", "]", "V.E.a[4294967296]"] {
            assert_eq!(split(name), None, "{name}");
        }
    }
}
