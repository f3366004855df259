//! Codes of a description; unknown codes are kept (VAR-23).

use crate::number::code;

code! {
    /// The type of a variable (VAR-5).
    ///
    /// | code | type | bytes of an element |
    /// |---|---|---|
    /// | 1 | BOOLEAN | 1 |
    /// | 2 | SGN08 | 1 |
    /// | 3 | UNS08 | 1 |
    /// | 4 | SGN16 | 2 |
    /// | 5 | UNS16 | 2 |
    /// | 6 | SGN32 | 4 |
    /// | 7 | UNS32 | 4 |
    /// | 8 | REAL64 | 8 |
    /// | 9 | STRING | variable |
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
    ///
    /// ```
    /// use ads_cnc::VariableType;
    ///
    /// assert_eq!(VariableType::REAL64.element_size(), Some(8));
    /// assert_eq!(VariableType::REAL64.to_string(), "REAL64");
    /// assert_eq!(VariableType(77).name(), None);
    /// ```
    VariableType(u32) {
        /// One byte, 0 or 1.
        BOOLEAN = 1;
        /// Signed, one byte.
        SGN08 = 2;
        /// Unsigned, one byte.
        UNS08 = 3;
        /// Signed, two bytes.
        SGN16 = 4;
        /// Unsigned, two bytes.
        UNS16 = 5;
        /// Signed, four bytes.
        SGN32 = 6;
        /// Unsigned, four bytes.
        UNS32 = 7;
        /// IEEE 754 binary64.
        REAL64 = 8;
        /// CP1252 text.
        STRING = 9;
    }
}

impl VariableType {
    /// Bytes of one element, if the type has a fixed size.
    pub const fn element_size(self) -> Option<u32> {
        match self.data_type() {
            Some(data_type) => data_type.size(),
            None => None,
        }
    }
}

code! {
    /// Whether a variable may be written (VAR-6).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
    ///
    /// ```
    /// use ads_cnc::VariableAccess;
    ///
    /// assert_eq!(VariableAccess(2), VariableAccess::READ_WRITE);
    /// assert!(VariableAccess::READ_WRITE.is_writable());
    /// assert_eq!(VariableAccess::READ_WRITE.to_string(), "READ_WRITE");
    /// ```
    VariableAccess(u32) {
        /// Reading only.
        READ_ONLY = 1;
        /// Reading and writing.
        READ_WRITE = 2;
    }
}

impl VariableAccess {
    /// Whether the variable may be written. An undocumented code does not permit it.
    pub const fn is_writable(self) -> bool {
        self.0 == Self::READ_WRITE.0
    }
}

code! {
    /// Whether access to a variable is synchronised (VAR-15).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8; the editions spell the second code's
    /// name SYNCHRONISED and SYNCHRONIZED (E-23).
    ///
    /// ```
    /// assert_eq!(ads_cnc::Synchronisation(2), ads_cnc::Synchronisation::SYNCHRONIZED);
    /// ```
    Synchronisation(u32) {
        /// Not synchronised.
        NO_SYNC = 1;
        /// Synchronised.
        SYNCHRONIZED = 2;
    }
}

code! {
    /// Where a variable is valid (VAR-15).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8.
    ///
    /// ```
    /// assert_eq!(ads_cnc::Validity(1), ads_cnc::Validity::CHANNEL);
    /// ```
    Validity(u32) {
        /// In its channel.
        CHANNEL = 1;
        /// In all channels.
        GLOBAL = 2;
    }
}
