//! The contents of a file of `--allow-write`: target, expiry and allowed writes.

use std::net::IpAddr;

use ads_cnc::ads::AmsNetId;

use super::{Entry, Moment, Reason};

/// The default AMS NetId of the simulated CNC. Every AMS router uses it for its own machine.
pub const NET_ID: AmsNetId = AmsNetId([127, 0, 0, 1, 1, 1]);

/// The contents of a file of `--allow-write`: the target, the values that may be written, and the
/// expiry.
///
/// Every table of the file, such as `[[variable]]`, may be repeated. The file uses the channel
/// numbers and axis indices of the CNC:
///
/// ```
/// let file = r#"
/// target = "192.0.2.7.1.1"             # the AMS NetId of the device
/// address = "192.0.2.7"                # the IP address of the device; default: any
/// expires = 2026-05-04T17:30:00+02:00  # no writes from then on
/// malformed = false                    # whether run --malformed may send malformed requests
///
/// [[variable]]                 # including its elements; "V.E.list[3]" is only one element
/// channel = 1                  # or rank = 1, the first of the active channels
/// name = "V.E.list"
///
/// [[variable]]                 # over the axis interface
/// channel = 1
/// axis = 2
/// name = "V.A.WCS"
///
/// [[object]]                   # the content of a COM object by its address
/// group = 0x120101
/// offset = 0x1
///
/// [[object]]                   # or by its name in the list of a channel (0: the platform);
/// channel = 1                  # or rank = 1, or axis = 1: a platform axis
/// name = "mc_command_single_block_w"
///
/// [[element]]                  # the content of an element of a class
/// group = 0x123301
/// offset = 1
///
/// [[stream]]                   # NC programs, which may move the machine
/// channel = 1
///
/// [[service]]                  # the variables of the Service Interface that a service writes
/// channel = 1
/// "#;
/// let allowed = ads_cnc_conformance::gate::Allowed::from_toml(file)?;
/// assert_eq!(allowed.entries.len(), 7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Allowed {
    /// The AMS NetId of the only allowed target.
    pub target: AmsNetId,
    /// The IP address of the target; `None` for any.
    pub address: Option<IpAddr>,
    /// Whether malformed requests may be sent to the target.
    pub malformed: bool,
    /// From this time on, the file allows nothing.
    pub expires: Moment,
    /// The allowed writes.
    pub entries: Vec<Entry>,
}

impl Allowed {
    /// Checks whether the file applies to this target now. `address` is the IP address of the
    /// connection, if it is known.
    ///
    /// # Errors
    /// The first reason why the file does not apply.
    pub(super) fn check_target(
        &self,
        target: AmsNetId,
        address: Option<IpAddr>,
        now: Moment,
    ) -> Result<(), Reason> {
        if self.target != target {
            return Err(Reason::OtherTarget { allowed: self.target, target });
        }
        if self.address.is_some() && self.address != address {
            return Err(Reason::OtherAddress { allowed: self.address, address });
        }
        // Every AMS router uses this NetId for the machine on which it runs, so over a connection
        // to another machine the NetId means that other machine.
        if target == NET_ID && !address.is_some_and(|address| address.is_loopback()) {
            return Err(Reason::LocalNetId(address));
        }
        if now >= self.expires { Err(Reason::Expired(self.expires)) } else { Ok(()) }
    }
}
