//! Decides which frames may be sent to a target. A frame may move a machine, so a frame to a device
//! must be allowed by the following defaults or by a file of `--allow-write`.
//!
//! [`Wire::send`](crate::net::Wire::send) sends a frame only with the [`Permit`] that
//! [`Gate::check`] returns for the bytes of the frame. By default, the gate allows the queries of
//! the function table at their documented ports, and ReadDeviceInfo and ReadState at the ports of
//! GEO, SDA and COM. A write to a device needs a file of `--allow-write` that names the value, the
//! target and an expiry: see [`Allowed`].
//!
//! The file may contain a name, while a write contains a handle or an address instead. Only the
//! device knows the name that belongs to it. Therefore, the gate records the names in replies. It
//! rejects a write by a handle if a reply of the same channel contained the handle for a variable
//! that is not in the file. It rejects a write to the address of an object if replies contained two
//! names for the address: see [`Ambiguity`].
//!
//! ```
//! use ads_cnc::Encode;
//! use ads_cnc_conformance::gate;
//!
//! // ReadState of the COM task
//! let state = b"\0\0\x20\0\0\0\x7f\0\0\x01\x01\x01\x29\x02\x7f\0\0\x01\x01\x02\0\x80\
//!               \x04\0\x04\0\0\0\0\0\0\0\0\0\x01\0\0\0";
//! assert!(gate::check(state).is_ok());
//! // WriteControl of the COM task
//! let mut control = state.to_vec();
//! control[22] = 5;
//! assert!(gate::check(&control).is_err());
//! ```

mod allowed;
mod entry;
mod file;
mod observed;
mod rejection;

pub use crate::text::Moment;
pub use allowed::{Allowed, NET_ID};
pub use entry::{AllowedList, Entry};
pub use rejection::{Ambiguity, GateRejection, Reason};

use std::net::{IpAddr, SocketAddr};
use std::ops::RangeInclusive;

use ads_cnc::Handle;
use ads_cnc::address::{Access, Channel, ComTable, Group};
use ads_cnc::ads::{AmsNetId, AmsPort, Command, FrameRef, StateFlags};
use ads_cnc::operation::{AdsService, Call, Effect, Function, Request, Task};
use ads_cnc::streaming;

use observed::Observed;

/// Checks every frame before it is sent.
#[derive(Clone, Debug, Default)]
pub struct Gate {
    /// Whether the user allows malformed frames with `--malformed`; the file must permit them, too.
    malformed: bool,
    /// The address of a simulated CNC in this process, to which writes need no file.
    simulated: Option<SocketAddr>,
    /// The IP address to which the frames are sent, if known.
    peer: Option<IpAddr>,
    allowed: Option<Allowed>,
    observed: Observed,
}

/// The permission to send one frame. Only a gate can create a permit.
#[derive(Clone, Copy, Debug)]
pub struct Permit<'f> {
    frame: &'f [u8],
    repeatable: bool,
}

impl<'f> Permit<'f> {
    pub const fn frame(&self) -> &'f [u8] {
        self.frame
    }

    /// Whether sending the frame twice has the same effect as sending it once. The gate states this
    /// only for well-formed queries, ReadDeviceInfo and ReadState.
    pub const fn is_repeatable(&self) -> bool {
        self.repeatable
    }
}

/// Checks a frame without a file, see [`Gate::queries`].
///
/// # Errors
/// The reason why the frame must not be sent, and the entry that would allow it, if any.
pub fn check(frame: &[u8]) -> Result<Permit<'_>, GateRejection> {
    Gate::queries().check(frame, Moment::EPOCH)
}

impl Gate {
    /// Creates a gate that allows only ReadDeviceInfo, ReadState and well-formed queries of the
    /// function table, at their documented ports.
    pub fn queries() -> Self {
        Self::default()
    }

    /// Creates a gate that allows every request except WriteControl, notifications, sum commands,
    /// undocumented access to a program stream, and writes at a port other than the documented one.
    /// The gate is only for `simulated`, the address of a simulated CNC of this process; see
    /// [`Gate::of_server`].
    pub(crate) fn of_address(simulated: SocketAddr) -> Self {
        Self { simulated: Some(simulated), ..Self::default() }
    }

    /// The only address to which a [`Client`](crate::client::Client) with this gate connects;
    /// `None` if the gate does not restrict the address.
    pub const fn simulated(&self) -> Option<SocketAddr> {
        self.simulated
    }

    /// Whether the gate is for a simulated CNC, to which writes need no file, or has a file of
    /// `--allow-write`.
    pub const fn may_let_writes_pass(&self) -> bool {
        self.simulated.is_some() || self.allowed.is_some()
    }

    /// The contents of the file of `--allow-write`; `None` without a file.
    pub const fn allowed(&self) -> Option<&Allowed> {
        self.allowed.as_ref()
    }

    /// Also allows the writes that a file names; `None` removes the file.
    #[must_use]
    pub fn with_allowed(self, allowed: Option<Allowed>) -> Self {
        Self { allowed, ..self }
    }

    /// Also allows malformed requests to the target for which the file permits them. If the file
    /// permits malformed requests, [`Client`](crate::client::Client) accepts such a gate only for a
    /// CNC on this machine.
    #[must_use]
    pub fn and_malformed(self) -> Self {
        Self { malformed: true, ..self }
    }

    /// Sets the IP address to which the frames are sent; the file may require an address.
    #[must_use]
    pub fn to_address(self, peer: IpAddr) -> Self {
        Self { peer: Some(peer.to_canonical()), ..self }
    }

    /// Whether the gate may allow malformed frames. A CNC may execute some malformed frames as
    /// writes.
    pub fn lets_malformed_pass(&self) -> bool {
        let permits = |allowed: &Allowed| allowed.malformed;
        self.simulated.is_some() || self.malformed && self.allowed.as_ref().is_some_and(permits)
    }

    /// Checks whether the file applies to this target now.
    ///
    /// # Errors
    /// The reason why the file does not apply. Without a file, no error is returned.
    pub fn check_target(&self, target: AmsNetId, now: Moment) -> Result<(), GateRejection> {
        let Some(allowed) = &self.allowed else { return Ok(()) };
        allowed.check_target(target, self.peer, now).map_err(GateRejection::from)
    }

    /// Checks whether the file permits malformed requests to this target now. No file is needed for
    /// a simulated CNC of this process.
    ///
    /// # Errors
    /// The reason why malformed requests are not permitted.
    pub fn check_malformed(&self, target: AmsNetId, now: Moment) -> Result<(), GateRejection> {
        match &self.allowed {
            _ if self.simulated.is_some() => Ok(()),
            Some(allowed) if allowed.malformed => self.check_target(target, now),
            _ => Err(Reason::NoMalformed(target).into()),
        }
    }

    /// Checks whether this frame may be sent at the time `now`. The result depends only on the gate
    /// and the arguments.
    ///
    /// # Errors
    /// The reason why the frame must not be sent, and the entry that would allow it, if any.
    pub fn check<'f>(&self, frame: &'f [u8], now: Moment) -> Result<Permit<'f>, GateRejection> {
        let permit = |repeatable| Ok(Permit { frame, repeatable });
        let whole = match whole(frame) {
            Ok(whole) => whole,
            // The target is read only from one whole frame, so no file can permit other bytes.
            Err(_) if self.simulated.is_some() => return permit(false),
            Err(reason) => return Err(reason.into()),
        };
        let target = whole.header().target.net_id;
        let malformed = |reason: Reason| {
            if self.lets_malformed_pass() {
                self.check_malformed(target, now).and_then(|()| permit(false))
            } else {
                Err(reason.into())
            }
        };
        let header = whole.header();
        // The command is checked before the flags: otherwise a command that is never sent would
        // pass as a malformed request if its flags are invalid.
        let repeatable = match header.command {
            Command::WRITE_CONTROL
            | Command::ADD_NOTIFICATION
            | Command::DELETE_NOTIFICATION
            | Command::NOTIFICATION => return Err(Reason::Never(header.command).into()),
            Command::READ_DEVICE_INFO | Command::READ_STATE => {
                if Task::from_port(header.target.port).is_none() {
                    return malformed(Reason::NoTask(header.target.port));
                } else if !whole.data().is_empty() {
                    return malformed(Reason::Data(header.command));
                }
                true
            }
            command => match Call::from_frame(&whole) {
                Ok(Some(call)) => self.check_call(&call, header.target.net_id, now)?,
                Ok(None) => return malformed(Reason::Never(command)),
                Err(error) => return malformed(Reason::Malformed(error)),
            },
        };
        if !header.error.is_ok() || header.state_flags != StateFlags::REQUEST {
            return malformed(Reason::NoRequest(header.state_flags));
        }
        permit(repeatable)
    }

    /// Records the handles and object addresses in a reply, if the gate has a file. With these
    /// records, the gate checks whether a later write by a handle or an address affects only names
    /// in the file.
    pub fn observe(&mut self, call: &Call<'_>, reply: &[u8]) {
        if let Some(allowed) = &self.allowed {
            self.observed.observe(allowed, call, reply);
        }
    }

    /// Whether the gate has recorded a name of the channel interface for this handle, or two names
    /// or axes of the axis interface. Also true if the gate has received more names than it can
    /// store. [`forget`](Self::forget) discards names that are in the file.
    pub fn knows_handle(&self, channel: Channel, handle: Handle) -> bool {
        self.observed.knows_handle(channel, handle)
    }

    /// Discards the observations that allow writes, because the next replies may come from another
    /// device. Keeps the observations that forbid writes.
    pub fn forget(&mut self) {
        self.observed.forget();
    }

    /// Checks a call; returns whether the call is repeatable, see [`Permit::is_repeatable`].
    fn check_call(
        &self,
        call: &Call<'_>,
        to: AmsNetId,
        now: Moment,
    ) -> Result<bool, GateRejection> {
        never(call)?;
        let lets_malformed_pass = self.lets_malformed_pass();
        let request = match call.dispatch() {
            Ok(request) => request,
            Err(_) if lets_malformed_pass => return self.check_malformed(to, now).map(|()| false),
            Err(rejection) => return Err(Reason::Unknown(rejection).into()),
        };
        let spec = request.function().spec();
        let at_home = call.port == spec.task.port()
            || (call.port == AmsPort::GEO && OF_CLASSES.contains(&request.function()));
        match spec.effect {
            Effect::Query if at_home => Ok(true),
            Effect::Query if lets_malformed_pass => self.check_malformed(to, now).map(|()| true),
            // An entry allows a write only at the documented port of its function.
            _ if call.port != spec.task.port() => {
                Err(Reason::Port(call.port, request.function()).into())
            }
            _ if self.simulated.is_some() => Ok(false),
            _ => self.check_change(&request, to, now).map(|()| false),
        }
    }

    /// Checks whether an entry of the file allows a write, and whether the file applies to the
    /// target now.
    fn check_change(
        &self,
        request: &Request<'_>,
        to: AmsNetId,
        now: Moment,
    ) -> Result<(), GateRejection> {
        let function = request.function();
        let needed = Entry::needed(request);
        let Some(allowed) = &self.allowed else {
            return Err(GateRejection::needing(Reason::NoFile(function, to), needed));
        };
        let mut ambiguity = None;
        let mut named = false;
        for entry in &allowed.entries {
            match entry.allows(request, &self.observed) {
                Ok(allows) => named |= allows,
                Err(why) => ambiguity = Some(why),
            }
        }
        match (named, ambiguity) {
            (true, _) => self.check_target(to, now),
            (false, Some(ambiguity)) => Err(Reason::Ambiguous(function, ambiguity).into()),
            (false, None) => Err(GateRejection::needing(Reason::NoEntry(function), needed)),
        }
    }
}

/// The queries of classes, which section 2.2 of the manual documents for both SDA and GEO. The gate
/// allows the other queries of SDA at GEO only as malformed requests, because the manual does not
/// say that GEO serves them.
const OF_CLASSES: [Function; 8] = [
    Function::FindInstance,
    Function::CountElements,
    Function::ReadElement,
    Function::ReadElementName,
    Function::ReadElementType,
    Function::ReadElementLength,
    Function::ReadElementUnit,
    Function::ReadElementWriteFlag,
];

/// Rejects calls that no option and no entry can allow.
fn never(call: &Call<'_>) -> Result<(), GateRejection> {
    // A sum command contains several requests, some of which may be writes.
    if SUMS.contains(&call.index_group.get()) {
        return Err(Reason::Sum(call.index_group).into());
    }
    let Some(Group::Com(com)) = call.index_group.parts() else { return Ok(()) };
    let stream = call.index_offset == streaming::INDEX_OFFSET
        && com.access == Access::Element
        && com.table == ComTable::Channel;
    // The only documented access to a program stream is a write to a channel at the port of COM. A
    // write to instance 0, the platform, may reach the stream of channel 1.
    let documented =
        call.service == AdsService::Write && com.instance != 0 && call.port == AmsPort::COM;
    if stream && !documented { Err(Reason::Stream.into()) } else { Ok(()) }
}

/// A range that contains the index groups of all ADS sum commands.
const SUMS: RangeInclusive<u32> = 0xF080..=0xF08F;

/// Decodes the bytes as exactly one frame.
fn whole(bytes: &[u8]) -> Result<FrameRef<'_>, Reason> {
    match FrameRef::split(bytes, u32::MAX) {
        Ok(Some((frame, len))) if len == bytes.len() => Ok(frame),
        Ok(_) => Err(Reason::NoFrame),
        Err(error) => Err(Reason::Malformed(error)),
    }
}

#[cfg(test)]
mod tests;
