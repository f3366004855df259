//! Decodes values and contents by a type that the caller specifies.

use ads_cnc::value::{DataType, Element, Elements};
use ads_cnc::{Error, U32List};

use super::codes::text_of;
use crate::number::to_usize;
use crate::values::element_label;

/// An element of a value.
pub(super) struct TypedElement {
    /// Length in bytes.
    pub(super) len: usize,
    /// The indices in brackets; empty for a single value.
    pub(super) place: String,
    pub(super) value: String,
}

pub(super) fn elements(
    ty: DataType,
    dimensions: &[u32],
    bytes: &[u8],
) -> Result<Vec<TypedElement>, Error> {
    let elements = Elements::new(ty, U32List::from(dimensions), bytes)?;
    let len = to_usize(elements.shape().element_size());
    let placed = (0_usize..).zip(elements);
    Ok(placed
        .map(|(item, one)| TypedElement {
            len,
            place: element_label(item, dimensions),
            value: element(one),
        })
        .collect())
}

fn element(element: Element<'_>) -> String {
    match element {
        Element::Boolean(flag) => super::codes::boolean(flag.0),
        Element::String(text) => text_of(text),
        other => crate::values::number(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value_format::type_by_name;

    #[test]
    fn the_last_index_changes_fastest() {
        let bytes: Vec<u8> = (1..=6).collect();
        let typed = elements(type_by_name("uns08").unwrap(), &[2, 3], &bytes).unwrap();
        let shown: Vec<_> =
            typed.iter().map(|one| format!("{}={}", one.place, one.value)).collect();
        assert_eq!(shown, ["[0][0]=1", "[0][1]=2", "[0][2]=3", "[1][0]=4", "[1][1]=5", "[1][2]=6"]);
    }

    #[test]
    fn types_of_objects_are_known() {
        for (name, bytes, value) in [
            ("LINT", &[0xFF; 8][..], "-1"),
            ("LWORD", &[0xFF; 8], "18446744073709551615"),
            ("REAL", &[0, 0, 0xC0, 0x3F], "1.5"),
            ("BOOL", &[2], "TRUE (2)"),
        ] {
            let typed = elements(type_by_name(name).unwrap(), &[], bytes).unwrap();
            assert_eq!(typed.first().map(|one| one.value.as_str()), Some(value), "{name}");
        }
        assert!(type_by_name("TIME").is_err());
    }
}
