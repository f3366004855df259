//! The number of objects, at offset 0 of a list.

use crate::declare::stream;

stream! {
    /// The number of objects in a list.
    ///
    /// The number is read at offset 0 of a group with object access, and only counts the objects in
    /// the addressed list (E-36). The width of the number is not documented; 4 bytes are assumed.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.1.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Decode, ObjectCount};
    ///
    /// assert_eq!(ObjectCount::decode(&[16, 0, 0, 0])?, ObjectCount(16));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ObjectCount "object-count", "Number of objects, reply", "COM-1", max 4;
    tuple ObjectCount {
        @0 count: UNS32, "COM-1", "objects in the addressed list";
    }
}

crate::number::shown!(ObjectCount);
