//! Compile-time checks of the declaration of a stream.

use super::spec::{FieldSpec, Layout, Size, is_same};

impl Layout {
    /// Whether all fixed fields are in the head of the stream (the fixed fields at its start),
    /// where the decoders expect them.
    pub(crate) const fn is_headed(&self) -> bool {
        let (mut fields, mut is_head) = (self.fields, true);
        while let [row, rest @ ..] = fields {
            is_head = is_head && row.size.fixed() > 0 && row.per_item == 0;
            if !is_head && row.size.fixed() > 0 {
                return false;
            }
            fields = rest;
        }
        true
    }

    /// Whether the field with this name begins where the rows before it end: `offset` must be their
    /// length with empty lists and texts, `per_item` the sum of the lengths of an item of each
    /// list.
    pub(crate) const fn is_at(&self, name: &str) -> bool {
        let (mut fields, mut end, mut per_item) = (self.fields, 0_u32, 0_u32);
        while let [row, rest @ ..] = fields {
            if is_same(row.name, name) {
                return row.offset == end && row.per_item == per_item;
            }
            match row.size {
                Size::Items { each, .. } => per_item = per_item.saturating_add(each),
                Size::CStringPrefix { .. } => end = end.saturating_add(1),
                size => end = end.saturating_add(size.fixed()),
            }
            fields = rest;
        }
        false
    }

    /// Whether the maximum length of the stream leaves room for the maximum length of each row, if
    /// the other rows have their minimum lengths. A list must fill this room except for a part of
    /// an item. A row whose maximum `Row::read` does not check must fill the room exactly.
    pub(crate) const fn is_filled(&self) -> bool {
        let (mut fields, mut before) = (self.fields, 0_u32);
        while let [row, rest @ ..] = fields {
            let left = self.max.saturating_sub(before).saturating_sub(least(rest));
            let is_filled = match row.size {
                Size::Items { each, max } => matches!(left.checked_div(each), Some(n) if n == max),
                Size::CString { max, .. } | Size::OptionalNul { max } | Size::Rest { max, .. } => {
                    left == max
                }
                Size::TextAndTail { max, .. } | Size::CStringPrefix { max } => max <= left,
                _ => true,
            };
            if !is_filled {
                return false;
            }
            before = before.saturating_add(row.size.least());
            fields = rest;
        }
        true
    }
}

#[cfg(feature = "arbitrary")]
impl Layout {
    /// The number of bytes by which a stream may exceed the minimum length of its rows.
    pub(crate) fn room(&self) -> usize {
        crate::bytes::to_usize(self.max.saturating_sub(least(self.fields)))
    }
}

/// The minimum length of these rows in bytes.
const fn least(mut fields: &[FieldSpec]) -> u32 {
    let mut least = 0_u32;
    while let [row, rest @ ..] = fields {
        (least, fields) = (least.saturating_add(row.size.least()), rest);
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::Declared;
    use crate::layout::Type;
    use crate::{DescriptionRef, HandleWriteRef, NameWriteRef};
    use std::{sync::Mutex, vec::Vec};

    fn layout(rows: &[(&'static str, u32, u32, Size)]) -> Layout {
        let row = |&(name, offset, per_item, size)| {
            let (ty, meaning, clause) = (Type::Uns32, "", "");
            FieldSpec { name, offset, per_item, size, ty, meaning, clause }
        };
        // Keep the leaked fields reachable from a static, so that Miri reports no leak.
        static LEAKED: Mutex<Vec<&[FieldSpec]>> = Mutex::new(Vec::new());
        let fields = &*rows.iter().map(row).collect::<Vec<_>>().leak();
        LEAKED.lock().expect("no test panics with it").push(fields);
        Layout { fields, ..DescriptionRef::LAYOUT }
    }

    #[test]
    fn checks_detect_wrong_tables() {
        const LIST: Size = Size::Items { each: 4, max: 5 };
        const FOUR: Size = Size::Fixed(4);
        const REST: Size = Size::Rest { min: 0, max: 9 };
        let rows =
            [("a", 0, 0, FOUR), ("n", 4, 0, FOUR), ("list", 8, 0, LIST), ("rest", 8, 4, REST)];
        let right = layout(&rows);
        assert!(["a", "n", "list", "rest"].iter().all(|name| right.is_at(name)));
        assert!(right.is_headed() && right.head() == 8);
        assert!(!right.is_at("b"));
        assert_eq!([right.index("list"), right.index("lost")], [2, u8::MAX]);
        let shifted = layout(&[("a", 0, 0, FOUR), ("b", 5, 0, FOUR)]);
        assert!(shifted.is_at("a") && !shifted.is_at("b"));
        let counted = layout(&[("list", 0, 0, LIST), ("rest", 0, 0, REST)]);
        assert!(!counted.is_at("rest"));
        let after = layout(&[("list", 0, 0, LIST), ("a", 0, 4, FOUR)]);
        assert!(!after.is_headed());
        assert!(NameWriteRef::LAYOUT.is_at("value") && HandleWriteRef::LAYOUT.is_at("value"));
    }

    #[test]
    fn checks_detect_a_maximum_that_no_row_enforces() {
        let filled = |max, rows: &[_]| Layout { max, ..layout(rows) }.is_filled();
        let list = [("n", 0, 0, Size::Fixed(4)), ("list", 4, 0, Size::Items { each: 4, max: 5 })];
        assert_eq!([23, 24, 27, 28].map(|max| filled(max, &list)), [false, true, true, false]);
        let open = ("name", 4, 4, Size::TextAndTail { min: 1, max: 4 });
        let named = [list[0], list[1], open];
        assert_eq!([24, 25, 28, 29].map(|max| filled(max, &named)), [false, true, true, false]);
        for size in [Size::TextAndTail { min: 1, max: 9 }, Size::CStringPrefix { max: 9 }] {
            let rows = [("first", 0, 0, Size::Fixed(4)), ("last", 4, 0, size)];
            assert_eq!([12, 13, 99].map(|max| filled(max, &rows)), [false, true, true]);
        }
        for size in [
            Size::Rest { min: 0, max: 9 },
            Size::OptionalNul { max: 9 },
            Size::CString { max: 9, is_optional: false },
        ] {
            let rows = [("first", 0, 0, Size::CStringPrefix { max: 4 }), ("last", 1, 0, size)];
            assert_eq!([9, 10, 11].map(|max| filled(max, &rows)), [false, true, false]);
        }
    }

    #[test]
    fn limits_and_offsets_equal_those_of_the_rows() {
        for (size, most) in [
            (Size::Fixed(4), 4),
            (Size::Items { each: 4, max: 5 }, 5),
            (Size::TextAndTail { min: 1, max: 9 }, 9),
            (Size::Rest { min: 0, max: 8 }, 8),
            (Size::CStringPrefix { max: 7 }, 7),
            (Size::OptionalNul { max: 6 }, 6),
            (Size::CString { max: 3, is_optional: true }, 3),
            (Size::Uns8To32, 4),
        ] {
            let rows = layout(&[("first", 0, 0, Size::Fixed(2)), ("last", 2, 0, size)]);
            assert_eq!((rows.most("last"), rows.offset("last")), (most, 2));
            assert_eq!((rows.most("first"), rows.offset("first")), (2, 0));
        }
    }

    #[test]
    #[should_panic = "no field of this name"]
    fn maximum_of_an_unknown_field_panics() {
        layout(&[]).most("value");
    }
}
