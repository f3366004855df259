//! Names of dynamic parameters (DYN-2, DYN-3, DYN-6).

use crate::bytes::to_u32;
use crate::layout::field::{dynamic_name, dynamic_name_request};
use crate::limits::DYNAMIC_NAME_MAX;

crate::text::text_stream! {
    #[doc = include_str!("../../doc/dynamic-name.md")]
    ///
    /// The name ends at its first NUL or with the reply (assumed); what follows the NUL is kept,
    /// and there is one byte at least.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.
    ///
    /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::dynamic::DynamicNameRef;
    ///
    /// assert_eq!(DynamicNameRef::decode(b"P1\0")?.name.text(), "P1");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicNameRef,
    ///
    /// ```
    /// use ads_cnc::Encode;
    /// use ads_cnc::dynamic::DynamicName;
    ///
    /// let reply = DynamicName { name: "P1".parse()? };
    /// assert_eq!(reply.to_vec()?, b"P1\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicName, DynamicName {
        /// Name of the parameter.
        name: dynamic_name::NAME
    }
    read open(1, to_u32(DYNAMIC_NAME_MAX)),
    check check_open(1, to_u32(DYNAMIC_NAME_MAX))
}

crate::text::text_stream! {
    #[doc = include_str!("../../doc/dynamic-name-request.md")]
    ///
    /// A NUL is sent; that it may be missing, and that more may pad the name, is assumed.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.
    ///
    /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
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
    DynamicNameRequestRef,
    ///
    /// ```
    /// use ads_cnc::Encode;
    /// use ads_cnc::dynamic::DynamicNameRequest;
    ///
    /// let request = DynamicNameRequest { name: "P1".parse()? };
    /// assert_eq!(request.to_vec()?, b"P1\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicNameRequest, DynamicNameRequest {
        /// Name of the parameter.
        name: dynamic_name_request::NAME
    }
    read may_terminate(),
    check check_may_terminate(to_u32(DYNAMIC_NAME_MAX))
}
