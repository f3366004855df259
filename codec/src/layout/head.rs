//! The fixed fields that a record begins with, as numbers: an error is built without their names.

use super::spec::FieldSpec;
use crate::limits::to_usize;

/// Number of the fixed fields that a record begins with.
pub(super) const fn count(fields: &[FieldSpec]) -> usize {
    measure(fields).0
}

/// Their sizes, one after the other without a gap.
pub(super) const fn sizes<const COUNT: usize>(fields: &[FieldSpec]) -> [u8; COUNT] {
    let mut sizes = [0; COUNT];
    let (mut left, mut rows): (&mut [u8], _) = (&mut sizes, fields);
    while let ([size, others @ ..], [row, rest @ ..]) = (left, rows) {
        [*size, ..] = row.size.fixed().to_le_bytes();
        (left, rows) = (others, rest);
    }
    sizes
}

/// The bytes of the fixed fields that a record begins with.
pub(super) const fn head(fields: &[FieldSpec]) -> usize {
    measure(fields).1
}

const fn measure(mut fields: &[FieldSpec]) -> (usize, usize) {
    let (mut count, mut bytes) = (0_usize, 0_usize);
    while let [row, rest @ ..] = fields {
        let size = to_usize(row.size.fixed());
        if size == 0 || row.per_item > 0 {
            break;
        }
        (count, bytes, fields) = (count.saturating_add(1), bytes.saturating_add(size), rest);
    }
    (count, bytes)
}

#[cfg(test)]
mod tests {
    use crate::layout::Stream;

    /// The sizes are those of the rows, and the offsets of the rows are their sums.
    #[test]
    fn heads_are_the_fixed_fields_in_front() {
        for stream in Stream::all().chain([Stream::NoData]) {
            let rows = stream.layout().fields;
            let front = rows.iter().take_while(|row| row.per_item == 0 && row.size.fixed() > 0);
            assert_eq!(front.clone().count(), stream.head_sizes().len(), "{stream}");
            let mut end = 0;
            for (row, &size) in front.zip(stream.head_sizes()) {
                assert_eq!((row.offset, row.size.fixed()), (end, size.into()), "{stream}");
                end += row.size.fixed();
            }
            assert_eq!(stream.layout().head(), usize::try_from(end).unwrap(), "{stream}");
        }
    }
}
