//! Codes of a description; unknown codes are kept (VAR-23).

use crate::number::code;

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
