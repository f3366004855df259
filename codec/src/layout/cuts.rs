//! Where a record is cut that ends too early.

use super::spec::FieldSpec;

/// The field in which a record ends: its place in the table, where it begins, how long it is.
#[derive(Clone, Copy)]
pub(crate) struct Cut {
    pub(crate) field: u8,
    pub(crate) offset: u8,
    pub(crate) size: u8,
}

impl Cut {
    /// The bytes of the fixed fields that a record begins with.
    pub(crate) const fn count(fields: &[FieldSpec]) -> usize {
        let (mut count, mut left) = (0_usize, fields);
        while let [row, rest @ ..] = left {
            let mut size = row.size.fixed();
            if size == 0 || row.per_item > 0 {
                break;
            }
            while size > 0 {
                (count, size) = (count.saturating_add(1), size.saturating_sub(1));
            }
            left = rest;
        }
        count
    }

    /// That of each length that is too short.
    pub(super) const fn all<const COUNT: usize>(fields: &[FieldSpec]) -> [Self; COUNT] {
        let mut cuts = [Self { field: 0, offset: 0, size: 0 }; COUNT];
        let (mut left, mut len): (&mut [_], _) = (&mut cuts, 0_u32);
        while let [cut, rest @ ..] = left {
            *cut = Self::of(fields, len);
            (left, len) = (rest, len.saturating_add(1));
        }
        cuts
    }

    /// That of a length: the last field that begins in time.
    const fn of(fields: &[FieldSpec], len: u32) -> Self {
        let mut cut = Self { field: 0, offset: 0, size: 0 };
        let (mut left, mut field) = (fields, 0_u8);
        while let [row, rest @ ..] = left {
            if row.offset > len {
                break;
            }
            let ([offset, ..], [size, ..]) =
                (row.offset.to_le_bytes(), row.size.fixed().to_le_bytes());
            cut = Self { field, offset, size };
            (left, field) = (rest, field.saturating_add(1));
        }
        cut
    }
}

#[cfg(test)]
mod tests {
    use super::Cut;
    use crate::layout::{Field, Stream};

    /// Every length that ends in the fixed fields in front, and no other.
    #[test]
    fn cuts_are_in_the_last_field_that_begins_in_time() {
        for stream in Stream::all() {
            let rows = stream.layout().fields;
            let front = rows.iter().take_while(|row| row.per_item == 0 && row.size.fixed() > 0);
            let end = front.map(|row| row.offset + row.size.fixed()).last().unwrap_or(0);
            assert_eq!(stream.cuts().len(), usize::try_from(end).unwrap(), "{stream}");
            // Made anew, they are what the compiler has made.
            assert_eq!(Cut::count(rows), stream.cuts().len(), "{stream}");
            for (one, two) in Cut::all::<128>(rows).iter().zip(stream.cuts()) {
                assert_eq!((one.field, one.offset), (two.field, two.offset), "{stream}");
            }
            for (len, cut) in (0..).zip(stream.cuts()) {
                let row = Field::new(stream, cut.field).spec().unwrap();
                assert_eq!((row.offset, row.size.fixed()), (cut.offset.into(), cut.size.into()));
                assert!(
                    (row.offset..row.offset + row.size.fixed()).contains(&len),
                    "{stream} {len}"
                );
            }
        }
    }
}
