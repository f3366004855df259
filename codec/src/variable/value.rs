//! Values of variables; the types of the values are in the descriptions.

use crate::declare::stream;

stream! {
    /// The value of a variable: one element, or the whole variable if the request has no indices of
    /// an element.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.4 and 4.3.5.
    ///
    /// `decode` can fail with [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, ValueRef};
    ///
    /// assert_eq!(ValueRef::decode(&[77, 1, 0, 0])?.bytes, 333_i32.to_le_bytes());
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableValue "variable-value", "Variable value, reply", "VAR-14", max 2048;
    struct ValueRef<'a> / Value {
        @0 bytes "value": REST(0, 2048), "VAR-14", "one element, or all of the array";
    }
}
