//! The number and the sizes of the fixed fields at the start of a record. The error for a truncated
//! record computes its offset from them.

use super::spec::FieldSpec;
use crate::bytes::to_usize;

/// The number of fixed fields at the start of a record.
pub(super) const fn count(fields: &[FieldSpec]) -> usize {
    measure(fields).0
}

/// The size of each fixed field at the start of a record, in bytes. The fields have no gaps between
/// them.
pub(super) const fn sizes<const COUNT: usize>(fields: &[FieldSpec]) -> [u8; COUNT] {
    let mut sizes = [0; COUNT];
    let (mut left, mut rows): (&mut [u8], _) = (&mut sizes, fields);
    while let ([size, others @ ..], [row, rest @ ..]) = (left, rows) {
        [*size, ..] = row.size.fixed().to_le_bytes();
        (left, rows) = (others, rest);
    }
    sizes
}

/// The length of the fixed fields at the start of a record, in bytes.
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

    /// The sizes equal the sizes of the rows, and the sums of the sizes equal the offsets of the rows.
    #[test]
    fn heads_consist_of_the_leading_fixed_fields() {
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
