//! Codes of the AMS header: command, state flags and error (ADS-5). The results of ADS services use
//! the same error numbers (ADS-4).

use crate::number::code;

code! {
    /// An AMS command; unknown numbers are kept.
    ///
    /// Source: the vendors' public help pages; the manuals do not describe it.
    ///
    /// ```
    /// use ads_cnc::ads::Command;
    ///
    /// let commands = [Command::READ, Command::WRITE, Command::READ_WRITE];
    /// assert_eq!(commands.map(|command| command.0), [2, 3, 9]);
    /// assert_ne!(Command(77), Command::READ);
    /// ```
    Command(u16) {
        /// ReadDeviceInfo.
        READ_DEVICE_INFO = 1;
        /// Read.
        READ = 2;
        /// Write.
        WRITE = 3;
        /// ReadState.
        READ_STATE = 4;
        /// WriteControl. No operation of this crate uses this command.
        WRITE_CONTROL = 5;
        /// AddDeviceNotification.
        ADD_NOTIFICATION = 6;
        /// DeleteDeviceNotification.
        DELETE_NOTIFICATION = 7;
        /// DeviceNotification.
        NOTIFICATION = 8;
        /// ReadWrite.
        READ_WRITE = 9;
    }
}

code! {
    /// The state flags of an AMS header; unknown bits are kept.
    ///
    /// Source: the vendors' public help pages; the manuals do not describe it.
    ///
    /// ```
    /// use ads_cnc::ads::StateFlags;
    ///
    /// // The flags of a response are those of a request, plus the response bit.
    /// assert_eq!(StateFlags::RESPONSE, StateFlags(StateFlags::REQUEST.0 | 1));
    /// ```
    StateFlags(u16) in hex {
        /// A request.
        REQUEST = 0x0004;
        /// A response.
        RESPONSE = 0x0005;
    }
}

code! {
    /// An ADS or AMS error number; 0 is success (ADS-4).
    ///
    /// The manuals do not document which numbers a CNC returns; the constants are the numbers that
    /// this crate assumes (ADS-7). A client should rely only on whether the number is 0.
    ///
    /// Source: the vendors' public help pages; the manuals do not describe it.
    ///
    /// ```
    /// use ads_cnc::ads::{AdsError, WriteReply};
    /// use ads_cnc::Decode;
    ///
    /// let reply = WriteReply::decode(&[0x03, 0x07, 0, 0])?;
    /// assert_eq!(reply.result, AdsError::INVALID_OFFSET);
    /// let error = reply.result.into_result().unwrap_err();
    /// assert_eq!(error.to_string(), "ADS error 0x703 (1795, INVALID_OFFSET)");
    /// assert_eq!(format!("{error:#x}"), "0x703");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// The type implements `Error`, for use with `?`:
    ///
    /// ```
    /// # use ads_cnc::{Decode, ads::WriteReply};
    /// fn written(reply: &[u8]) -> Result<(), Box<dyn std::error::Error>> {
    ///     let reply = WriteReply::decode(reply)?;
    ///     reply.result.into_result()?;
    ///     Ok(())
    /// }
    ///
    /// assert!(written(&[0; 4]).is_ok());
    /// let error = written(&[4, 7, 0, 0]).unwrap_err();
    /// assert_eq!(error.to_string(), "ADS error 0x704 (1796, INVALID_ACCESS)");
    /// ```
    AdsError(u32) in error {
        /// Success.
        NO_ERROR = 0;
        /// AMS: no such port on the target.
        TARGET_PORT_NOT_FOUND = 0x6;
        /// AMS: no such machine.
        TARGET_MACHINE_NOT_FOUND = 0x7;
        /// The service is not supported.
        SERVICE_NOT_SUPPORTED = 0x701;
        /// Invalid index group.
        INVALID_GROUP = 0x702;
        /// Invalid index offset.
        INVALID_OFFSET = 0x703;
        /// Reading or writing is not permitted.
        INVALID_ACCESS = 0x704;
        /// The size is wrong.
        INVALID_SIZE = 0x705;
        /// The request cannot be executed at present.
        INVALID_DATA = 0x706;
        /// Unknown name.
        SYMBOL_NOT_FOUND = 0x710;
    }
}

impl AdsError {
    /// Whether the number is 0: success.
    pub const fn is_ok(self) -> bool {
        self.0 == 0
    }

    /// Converts success to `Ok` and any other number to `Err`.
    ///
    /// # Errors
    /// This error, unless it is [`NO_ERROR`](Self::NO_ERROR).
    pub const fn into_result(self) -> Result<(), Self> {
        if self.is_ok() { Ok(()) } else { Err(self) }
    }
}

impl core::error::Error for AdsError {}
