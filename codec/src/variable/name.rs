//! Requests that contain the name of a variable.

use crate::declare::stream;

stream! {
    /// The request for the handle, the value or the description of a variable by its name.
    ///
    /// NULs may pad the name to at most 256 bytes (E-34).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.3 and 4.3.5.
    ///
    /// `decode` can fail with [`MissingNul`](crate::ErrorKind::MissingNul),
    /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, VariableNameRef};
    ///
    /// assert_eq!(VariableNameRef::decode(b"V.E.vartest\0")?.name.text(), "V.E.vartest");
    /// assert_eq!(
    ///     VariableNameRef::decode(b"V.E.vartest").unwrap_err().to_string(),
    ///     "variable-name: name at offset 0: no NUL, expected one within 256 bytes, found 11 without"
    /// );
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableName "variable-name", "Variable by name, request", "VAR-9", max 256;
    struct VariableNameRef<'a> / VariableName {
        @0 name: CSTRING(256), "VAR-9", "name of the variable";
    }
}

stream! {
    /// The request to write the value of a variable by its name.
    ///
    /// The value begins directly after the NUL of the name, so NULs cannot pad the name.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.7 and 4.3.11.
    ///
    /// `decode` can fail with [`MissingNul`](crate::ErrorKind::MissingNul) or
    /// [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{CncStr, Encode, NameWriteRef};
    ///
    /// let name = CncStr::new("V.E.test[4]")?;
    /// let mut buf = [0; 16];
    /// let bytes = NameWriteRef { name, value: &123_i32.to_le_bytes() }.encode(&mut buf)?;
    /// assert_eq!(bytes, b"V.E.test[4]\0\x7b\0\0\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableNameWrite "variable-name-write", "Write variable value by name, request", "VAR-13", max 2048;
    struct NameWriteRef<'a> / NameWrite {
        @0        name: CSTRING_PREFIX(256), "VAR-13", "name of the variable";
        @1 + text value: REST(0, 2047), "VAR-13", "one element, or all of the array";
    }
}
