//! Values (VAR-14). What their bytes mean is in the variable's description.

use crate::bytes_stream::bytes_stream;
use crate::layout::field::variable_value::VALUE;
use crate::limits::VARIABLE_MAX;

bytes_stream! {
    #[doc = include_str!("../../doc/variable-value.md")]
    ///
    /// One element, or the whole array if no index was given.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.4 and 4.3.5.
    ///
    /// `decode` refuses with [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, ValueRef};
    ///
    /// assert_eq!(ValueRef::decode(&[77, 1, 0, 0])?.bytes, 333_i32.to_le_bytes());
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ValueRef,
    ///
    /// ```
    /// use ads_cnc::{Decode, Value};
    ///
    /// assert_eq!(Value::decode(&[123, 0, 0, 0])?.bytes, 123_i32.to_le_bytes());
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    Value, VariableValue {
        /// The bytes.
        bytes: VALUE, 0 to VARIABLE_MAX
    }
}
