//! Codes in descriptions; unknown codes are kept (VAR-23).

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
        /// The variable can only be read.
        READ_ONLY = 1;
        /// The variable can be read and written.
        READ_WRITE = 2;
    }
}

impl VariableAccess {
    /// Whether the variable may be written: `false` for undocumented codes.
    pub const fn is_writable(self) -> bool {
        self.0 == Self::READ_WRITE.0
    }
}

code! {
    /// Whether access to a variable is synchronised (VAR-15).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8; the name of the second code is
    /// spelled SYNCHRONISED or SYNCHRONIZED (E-23).
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
    /// The scope of a variable (VAR-15).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8.
    ///
    /// ```
    /// assert_eq!(ads_cnc::Validity(1), ads_cnc::Validity::CHANNEL);
    /// ```
    Validity(u32) {
        /// The variable is valid in its channel.
        CHANNEL = 1;
        /// The variable is valid in all channels.
        GLOBAL = 2;
    }
}
