//! The description of a variable, by its index and by its name.

use super::{Handle, VariableAccess, VariableType};
use crate::declare::stream;

stream! {
    /// The description of a variable: the reply to a request by index.
    ///
    /// The manuals do not document how the name ends (E-17). The decoder accepts a name that ends
    /// in a NUL or at the end of the stream, and keeps the bytes after the first NUL, up to 256
    /// bytes in all. The field has at least one byte, which is the NUL if the name is empty. A new
    /// description, whose name is made by [`TextRef::new`](crate::TextRef::new), ends in one NUL.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`TooMany`](crate::ErrorKind::TooMany) or [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, DescriptionRef, VariableType};
    ///
    /// let bytes = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";
    /// let variable = DescriptionRef::decode(bytes)?;
    /// assert_eq!(variable.handle.0, 0x2000002);
    /// assert_eq!(variable.var_type, VariableType::BOOLEAN);
    /// assert_eq!(variable.dimensions.get(0), Some(2));
    /// assert_eq!(variable.name.text(), "V.E.Variable_3");
    /// // To keep the description longer than the bytes, copy it.
    /// # #[cfg(feature = "alloc")]
    /// assert_eq!(variable.to_owned().dimensions, [2]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableDescription "variable-description", "Variable description by index, reply", "VAR-4", max 2048;
    struct DescriptionRef<'a> / Description {
              @0       handle: UNS32 as Handle,                "VAR-10", "handle of the variable";
              @4       var_type "type": UNS32 as VariableType, "VAR-5",  "1 BOOLEAN … 9 STRING";
              @8       access: UNS32 as VariableAccess,        "VAR-6",  "1 READ_ONLY, 2 READ_WRITE";
              @12      size: UNS32,                            "VAR-8",  "bytes of the whole variable";
        count @16      dimension_count,                        "VAR-7",  "array dimensions m; 0 for an elementary variable";
              @20      dimensions: LIST(506),                  "VAR-4",  "elements in each dimension";
              @20 + 4m name: TEXT_AND_TAIL(1, 256),                     "VAR-4",  "name of the variable";
    }
}

stream! {
    /// The description of a variable by its name: [`DescriptionRef`] without the name.
    ///
    /// Only the public help pages document this reply, for CNC versions from V3.1.3132.0 and V4.29.0 on;
    /// `ads-en` 1.05 and `ads-de` 1.051 reserve the offset of the function in section 4.2.1.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated),
    /// [`TooMany`](crate::ErrorKind::TooMany), [`Trailing`](crate::ErrorKind::Trailing) or
    /// [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{Decode, DescriptionByNameRef, VariableType};
    ///
    /// let bytes = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0";
    /// let variable = DescriptionByNameRef::decode(bytes)?;
    /// assert_eq!(variable.var_type, VariableType::BOOLEAN);
    /// assert_eq!(variable.dimensions.get(0), Some(2));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    VariableDescriptionByName "variable-description-by-name", "Variable description by name, reply", "VAR-28", max 2048;
    struct DescriptionByNameRef<'a> / DescriptionByName {
              @0  handle: UNS32 as Handle,                "VAR-10", "handle of the variable";
              @4  var_type "type": UNS32 as VariableType, "VAR-5",  "1 BOOLEAN … 9 STRING";
              @8  access: UNS32 as VariableAccess,        "VAR-6",  "1 READ_ONLY, 2 READ_WRITE";
              @12 size: UNS32,                            "VAR-8",  "bytes of the whole variable";
        count @16 dimension_count,                        "VAR-7",  "array dimensions m; 0 for an elementary variable";
              @20 dimensions: LIST(507),                  "VAR-7",  "elements in each dimension";
    }
}

impl<'a> DescriptionRef<'a> {
    /// The description without the name, as in a description by name.
    pub const fn without_name(&self) -> DescriptionByNameRef<'a> {
        DescriptionByNameRef {
            handle: self.handle,
            var_type: self.var_type,
            access: self.access,
            size: self.size,
            dimensions: self.dimensions,
        }
    }
}
