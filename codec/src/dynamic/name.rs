//! Names of dynamic parameters.

use crate::declare::stream;

stream! {
    /// The name of a dynamic parameter.
    ///
    /// The name ends at its first NUL, or at the end of the reply (assumed). Bytes after the NUL are
    /// kept. The reply has at least one byte.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::dynamic::DynamicNameRef;
    ///
    /// assert_eq!(DynamicNameRef::decode(b"P1\0")?.name.text(), "P1");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicName "dynamic-name", "Name of a dynamic parameter, reply", "DYN-2", max 96;
    struct DynamicNameRef<'a> / DynamicName {
        @0 name: TEXT_AND_TAIL(1, 96), "DYN-2", "name of the parameter";
    }
}

stream! {
    /// The request for a dynamic parameter by its name.
    ///
    /// A new request ends in one NUL. A decoded request may lack the NUL, or have several of them as
    /// padding (assumed).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`Trailing`](crate::ErrorKind::Trailing) or [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, Encode, TextRef};
    /// use ads_cnc::dynamic::DynamicNameRequestRef;
    ///
    /// let request = DynamicNameRequestRef { name: TextRef::new("P1")? };
    /// assert_eq!(request.encode(&mut [0; 96])?, b"P1\0");
    /// assert_eq!(DynamicNameRequestRef::decode(b"P1")?.name.text(), "P1");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicNameRequest "dynamic-name-request", "Dynamic parameter by name, request", "DYN-3", max 96;
    struct DynamicNameRequestRef<'a> / DynamicNameRequest {
        @0 name: OPTIONAL_NUL(96), "DYN-3", "name of the parameter";
    }
}
