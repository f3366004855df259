//! Offset 0: the number of objects.

use crate::layout::field::object_count::COUNT;

crate::number::number_stream! {
    #[doc = include_str!("../../doc/object-count.md")]
    ///
    /// Read at offset 0 of a group with object access. Its width is not documented: assumed.
    /// It counts the list that is addressed (E-36).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.1.
    ///
    /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Decode, ObjectCount};
    ///
    /// assert_eq!(ObjectCount::decode(&[16, 0, 0, 0])?, ObjectCount(16));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Debug)]
    ObjectCount, ObjectCount, COUNT
}
