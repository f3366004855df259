//! Asking for a variable by name (VAR-9).

use crate::layout::field::variable_name::NAME;
use crate::limits::TEXT_MAX;

crate::text::text_stream! {
    #[doc = include_str!("../../doc/variable-name.md")]
    ///
    /// NULs may pad the name up to 256 bytes (E-34).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.3 and 4.3.5.
    ///
    /// `decode` refuses with [`MissingNul`](crate::ErrorKind::MissingNul),
    /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, VariableNameRef};
    ///
    /// assert_eq!(VariableNameRef::decode(b"V.E.vartest\0")?.name.text(), "V.E.vartest");
    /// assert_eq!(
    ///     VariableNameRef::decode(b"V.E.vartest").unwrap_err().to_string(),
    ///     "variable-name: name at offset 0: no NUL, one expected within 256 bytes, 11 there without"
    /// );
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableNameRef,
    ///
    /// ```
    /// use ads_cnc::{Encode, VariableName};
    ///
    /// let request = VariableName { name: "V.E.vartest".parse()? };
    /// assert_eq!(request.to_vec()?, b"V.E.vartest\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableName, VariableName {
        /// Name of the variable.
        name: NAME
    }
    read terminated(crate::bytes::to_u32(TEXT_MAX)),
    check check_terminated(crate::bytes::to_u32(TEXT_MAX))
}
