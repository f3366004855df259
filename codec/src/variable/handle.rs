//! Handles, and the requests to read and write by handle.

use core::fmt;

use crate::declare::stream;

stream! {
    /// The handle of a variable.
    ///
    /// A handle is valid until the controller restarts. The handle of an axis variable belongs to the
    /// index of the axis, not to the axis.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.3.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Decode, Handle};
    ///
    /// assert_eq!(Handle::decode(&[4, 0, 0, 2])?, Handle(0x2000004));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableHandle "variable-handle", "Variable handle by name, reply", "VAR-10", max 4;
    tuple Handle {
        @0 handle: UNS32, "VAR-10", "handle of the variable";
    }
}

/// Displays the number in hexadecimal.
impl fmt::Display for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#x}", self.0)
    }
}

impl fmt::Debug for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Handle({:#x})", self.0)
    }
}

stream! {
    /// The request to read the value of a variable by its handle.
    ///
    /// A request without indices reads the whole variable. Otherwise, it has one index for each
    /// dimension, which the decoder cannot check.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.4.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`TooMany`](crate::ErrorKind::TooMany), [`Trailing`](crate::ErrorKind::Trailing) or
    /// [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Encode, Handle, HandleReadRef, U32List};
    ///
    /// let element = HandleReadRef { handle: Handle(0x20012341), indices: U32List::from(&[4]) };
    /// let mut buf = [0; 12];
    /// assert_eq!(element.encode(&mut buf)?, [0x41, 0x23, 1, 0x20, 1, 0, 0, 0, 4, 0, 0, 0]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableHandleRead "variable-handle-read", "Read variable value by handle, request", "VAR-11", max 2048;
    struct HandleReadRef<'a> / HandleRead {
              @0 handle: UNS32 as Handle, "VAR-11", "handle of the variable";
        count @4 index_count,             "VAR-11", "indices n that follow; 0 for the whole variable";
              @8 indices: LIST(510),      "VAR-11", "index in each dimension, from 0";
    }
}

stream! {
    /// The request to write the value of a variable by its handle.
    ///
    /// A request without indices writes the whole variable. Otherwise, it has one index for each
    /// dimension, which the decoder cannot check.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.6.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`TooMany`](crate::ErrorKind::TooMany) or [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Encode, Handle, HandleWriteRef, U32List};
    ///
    /// let write = HandleWriteRef {
    ///     handle: Handle(0x2001234),
    ///     indices: U32List::from(&[4]),
    ///     value: &123_i32.to_le_bytes(),
    /// };
    /// let mut buf = [0; 16];
    /// assert_eq!(write.encode(&mut buf)?, b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7b\0\0\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableHandleWrite "variable-handle-write", "Write variable value by handle, request", "VAR-12", max 2048;
    struct HandleWriteRef<'a> / HandleWrite {
              @0      handle: UNS32 as Handle, "VAR-12", "handle of the variable";
        count @4      index_count,             "VAR-12", "indices n that follow; 0 for the whole variable";
              @8      indices: LIST(510),      "VAR-12", "index in each dimension, from 0";
              @8 + 4n value: REST(0, 2040),   "VAR-12", "one element, or all of the array";
    }
}

crate::number::from_number!(Handle);
