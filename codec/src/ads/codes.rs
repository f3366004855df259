//! Numbers of the AMS header: what is asked, which way it goes, and what came of it (ADS-5).

/// An AMS command; unknown numbers stay what they are.
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct Command(pub u16);

impl Command {
    /// ReadDeviceInfo.
    pub const READ_DEVICE_INFO: Self = Self(1);
    /// Read.
    pub const READ: Self = Self(2);
    /// Write.
    pub const WRITE: Self = Self(3);
    /// ReadState.
    pub const READ_STATE: Self = Self(4);
    /// WriteControl. Nothing in this project sends it.
    pub const WRITE_CONTROL: Self = Self(5);
    /// AddDeviceNotification.
    pub const ADD_NOTIFICATION: Self = Self(6);
    /// DeleteDeviceNotification.
    pub const DELETE_NOTIFICATION: Self = Self(7);
    /// DeviceNotification.
    pub const NOTIFICATION: Self = Self(8);
    /// ReadWrite.
    pub const READ_WRITE: Self = Self(9);
}

/// The state flags of an AMS header; unknown bits stay what they are.
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// ```
/// use ads_cnc::ads::StateFlags;
///
/// // A response has the bit that says so, and else the flags of its request.
/// assert_eq!(StateFlags::RESPONSE, StateFlags(StateFlags::REQUEST.0 | 1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct StateFlags(pub u16);

impl StateFlags {
    /// A request.
    pub const REQUEST: Self = Self(0x0004);
    /// A response.
    pub const RESPONSE: Self = Self(0x0005);
}

/// An ADS or AMS error number; 0 is success (ADS-4).
///
/// Which number a CNC gives is not documented (ADS-7): those named here are assumed, and a
/// client should only tell 0 from not 0.
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// ```
/// use ads_cnc::ads::{AdsError, WriteReply};
/// use ads_cnc::Decode;
///
/// let reply = WriteReply::decode(&[0x03, 0x07, 0, 0])?;
/// assert_eq!(reply.result, AdsError::INVALID_OFFSET);
/// assert!(!reply.result.is_none());
/// assert_eq!(reply.result.to_string(), "0x703");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct AdsError(pub u32);

impl AdsError {
    /// Success.
    pub const NONE: Self = Self(0);
    /// AMS: no such port on the target.
    pub const TARGET_PORT_NOT_FOUND: Self = Self(0x6);
    /// AMS: no such machine.
    pub const TARGET_MACHINE_NOT_FOUND: Self = Self(0x7);
    /// Service is not supported.
    pub const SERVICE_NOT_SUPPORTED: Self = Self(0x701);
    /// Invalid index group.
    pub const INVALID_GROUP: Self = Self(0x702);
    /// Invalid index offset.
    pub const INVALID_OFFSET: Self = Self(0x703);
    /// Must not be read or written.
    pub const INVALID_ACCESS: Self = Self(0x704);
    /// The size is wrong.
    pub const INVALID_SIZE: Self = Self(0x705);
    /// The job cannot be executed.
    pub const INVALID_DATA: Self = Self(0x706);
    /// Unknown name.
    pub const SYMBOL_NOT_FOUND: Self = Self(0x710);

    /// Whether this is success.
    pub const fn is_none(self) -> bool {
        self.0 == 0
    }
}

impl core::fmt::Display for AdsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{:#x}", self.0)
    }
}

impl core::fmt::Debug for AdsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{:#x}", self.0)
    }
}

crate::number::from_number!(AdsError);
