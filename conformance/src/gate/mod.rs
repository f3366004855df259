//! What may leave for a target. A machine may move: everything not allowed is refused.
//!
//! A frame reaches a socket only with the [`Permit`] that [`Gate::check`] gave for its bytes, see
//! [`Wire::send`](crate::net::Wire::send). What passes by default comes from the function table:
//! queries to the port they are documented for, ReadDeviceInfo and ReadState. Whatever changes
//! something needs an entry in a file that says what, on whom and until when: [`Allowed`].
//!
//! A file names variables and objects, a write has a handle or an address, and which that is the
//! device says. So the gate learns each name that a reply gives to a handle or an address, and lets
//! no write pass by one that any reply gives to what the file does not name: see [`Doubt`].
//!
//! ```
//! use ads_cnc::Encode;
//! use ads_cnc_conformance::gate;
//!
//! // ReadState of the COM task
//! let state = b"\0\0\x20\0\0\0\x7f\0\0\x01\x01\x01\x29\x02\x7f\0\0\x01\x01\x02\0\x80\
//!               \x04\0\x04\0\0\0\0\0\0\0\0\0\x01\0\0\0";
//! assert!(gate::check(state).is_ok());
//! // WriteControl of the same
//! let mut control = state.to_vec();
//! control[22] = 5;
//! assert!(gate::check(&control).is_err());
//! ```

mod allowed;
mod entry;
mod file;
mod observed;
mod refusal;

pub use crate::text::Moment;
pub use allowed::{Allowed, NET_ID};
pub use entry::{AllowedList, Entry};
pub use file::AllowFileError;
pub use refusal::{Doubt, Reason, Refusal};

use std::net::{IpAddr, SocketAddr};
use std::ops::RangeInclusive;

use ads_cnc::Handle;
use ads_cnc::address::{Access, Channel, ComTable, Group};
use ads_cnc::ads::{AmsNetId, AmsPort, Command, FrameRef, StateFlags};
use ads_cnc::operation::{Call, Effect, Function, Request, Service, Task};
use ads_cnc::streaming;

use observed::Observed;

/// Decides over every frame before a byte of it is sent.
#[derive(Clone, Debug, Default)]
pub struct Gate {
    /// Whether malformed frames pass, if a file permits them.
    malformed: bool,
    /// Of a CNC in this process, which is thrown away.
    simulated: Option<SocketAddr>,
    /// Where the frames go, if that is known.
    peer: Option<IpAddr>,
    allowed: Option<Allowed>,
    observed: Observed,
}

/// Leave for one frame to go to a target. Only a gate gives it.
#[derive(Clone, Copy, Debug)]
pub struct Permit<'f> {
    frame: &'f [u8],
    repeatable: bool,
}

impl<'f> Permit<'f> {
    pub const fn frame(&self) -> &'f [u8] {
        self.frame
    }

    /// Whether sending it twice does no more than sending it once.
    pub const fn is_repeatable(&self) -> bool {
        self.repeatable
    }
}

/// Whether a frame may be sent by default, without any file: see [`Gate::queries`]. It depends on
/// nothing but the bytes.
///
/// # Errors
/// Why not, and which entry would allow it.
pub fn check(frame: &[u8]) -> Result<Permit<'_>, Refusal> {
    Gate::queries().check(frame, Moment::EPOCH)
}

impl Gate {
    /// Well-formed queries of the function table only.
    pub fn queries() -> Self {
        Self::default()
    }

    /// Anything but what is never sent, to this address only: that of a
    /// [`Server`](crate::simulator::Server) of this process, see [`Gate::of_server`].
    pub(crate) fn of_address(simulated: SocketAddr) -> Self {
        Self { simulated: Some(simulated), ..Self::default() }
    }

    /// The only address that it allows, if there is but one.
    pub const fn simulated(&self) -> Option<SocketAddr> {
        self.simulated
    }

    /// Whether any write may pass at all.
    pub const fn may_let_writes_pass(&self) -> bool {
        self.simulated.is_some() || self.allowed.is_some()
    }

    /// What a file allows.
    pub const fn allowed(&self) -> Option<&Allowed> {
        self.allowed.as_ref()
    }

    /// And the writes that a file allows.
    #[must_use]
    pub fn with_allowed(self, allowed: Option<Allowed>) -> Self {
        Self { allowed, ..self }
    }

    /// And what no client should send, to the target that a file permits that for.
    /// [`Client`](crate::client::Client) takes no target with it but a CNC on this machine.
    #[must_use]
    pub fn and_malformed(self) -> Self {
        Self { malformed: true, ..self }
    }

    /// With the address that the frames go to, which a file may bind.
    #[must_use]
    pub fn to_address(self, peer: IpAddr) -> Self {
        Self { peer: Some(peer.to_canonical()), ..self }
    }

    /// Whether malformed frames may pass: some of them may be writes to whoever takes them.
    pub fn lets_malformed_pass(&self) -> bool {
        let permits = |allowed: &Allowed| allowed.malformed;
        self.simulated.is_some() || self.malformed && self.allowed.as_ref().is_some_and(permits)
    }

    /// Why nothing of what the file allows may be sent to this target now.
    ///
    /// # Errors
    /// The first reason; none if there is no file.
    pub fn check_target(&self, target: AmsNetId, now: Moment) -> Result<(), Refusal> {
        let Some(allowed) = &self.allowed else { return Ok(()) };
        allowed.check_target(target, self.peer, now).map_err(Refusal::from)
    }

    /// Whether malformed requests may be sent to this target now.
    pub fn check_malformed(&self, target: AmsNetId, now: Moment) -> Result<(), Refusal> {
        match &self.allowed {
            _ if self.simulated.is_some() => Ok(()),
            Some(allowed) if allowed.malformed => self.check_target(target, now),
            _ => Err(Reason::NoMalformed(target).into()),
        }
    }

    /// Whether this frame may be sent now. It depends on nothing but the gate and what is given.
    ///
    /// # Errors
    /// Why not, and which entry would allow it.
    pub fn check<'f>(&self, frame: &'f [u8], now: Moment) -> Result<Permit<'f>, Refusal> {
        let permit = |repeatable| Ok(Permit { frame, repeatable });
        let whole = match whole(frame) {
            Ok(whole) => whole,
            // To whom it goes is not known either.
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
        // What is never sent is not sent with odd flags either.
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

    /// Keeps what a reply says of handles and of addresses of objects: whether a write by one is of
    /// what the file names.
    pub fn learn(&mut self, call: &Call<'_>, reply: &[u8]) {
        if let Some(allowed) = &self.allowed {
            self.observed.learn(allowed, call, reply);
        }
    }

    /// Whether a reply on this connection gave this handle to any name.
    pub fn knows_handle(&self, channel: Channel, handle: Handle) -> bool {
        self.observed.knows_handle(channel, handle)
    }

    /// Forgets what would let writes pass, as the next answers may come from another device. What
    /// keeps writes from passing stays.
    pub fn forget(&mut self) {
        self.observed.forget();
    }

    /// Whether it can be repeated.
    fn check_call(&self, call: &Call<'_>, to: AmsNetId, now: Moment) -> Result<bool, Refusal> {
        never(call)?;
        let lets_malformed_pass = self.lets_malformed_pass();
        let request = match call.dispatch() {
            Ok(request) => request,
            Err(_) if lets_malformed_pass => return self.check_malformed(to, now).map(|()| false),
            Err(refusal) => return Err(Reason::Unknown(refusal).into()),
        };
        let spec = request.function().spec();
        let at_home = call.port == spec.task.port()
            || (call.port == AmsPort::GEO && OF_CLASSES.contains(&request.function()));
        match spec.effect {
            Effect::Query if at_home => Ok(true),
            Effect::Query if lets_malformed_pass => self.check_malformed(to, now).map(|()| true),
            // An entry does not tell the tasks apart: it is about SDA and COM.
            _ if call.port != spec.task.port() => {
                Err(Reason::Port(call.port, request.function()).into())
            }
            _ if self.simulated.is_some() => Ok(false),
            _ => self.check_change(&request, to, now).map(|()| false),
        }
    }

    /// Whether the file names this, this target and no time gone by.
    fn check_change(
        &self,
        request: &Request<'_>,
        to: AmsNetId,
        now: Moment,
    ) -> Result<(), Refusal> {
        let function = request.function();
        let needed = Entry::needed(request);
        let Some(allowed) = &self.allowed else {
            return Err(Refusal::needing(Reason::NoFile(function, to), needed));
        };
        let mut doubt = None;
        let mut named = false;
        for entry in &allowed.entries {
            match entry.allows(request, &self.observed) {
                Ok(allows) => named |= allows,
                Err(why) => doubt = Some(why),
            }
        }
        match (named, doubt) {
            (true, _) => self.check_target(to, now),
            (false, Some(doubt)) => Err(Reason::Doubtful(function, doubt).into()),
            (false, None) => Err(Refusal::needing(Reason::NoEntry(function), needed)),
        }
    }
}

/// The queries of classes, which the manual has for SDA and GEO alike (section 2.2). That the rest of
/// SDA's functions are answered by GEO too is assumed, and nothing is sent there for it.
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

/// What no opt-in and no entry lets through.
fn never(call: &Call<'_>) -> Result<(), Refusal> {
    // Requests with requests inside, writes among them.
    if SUMS.contains(&call.index_group.get()) {
        return Err(Reason::Sum(call.index_group).into());
    }
    let Some(Group::Com(com)) = call.index_group.parts() else { return Ok(()) };
    let stream = call.index_offset == streaming::INDEX_OFFSET
        && com.access == Access::Element
        && com.table == ComTable::Channel;
    // As channel 0 the platform may be what channel 1 is, and what a read does nobody says, nor what a
    // write does at another port than COM's.
    let documented =
        call.service == Service::Write && com.instance != 0 && call.port == AmsPort::COM;
    if stream && !documented { Err(Reason::Stream.into()) } else { Ok(()) }
}

/// The index groups of ADS for several requests in one.
const SUMS: RangeInclusive<u32> = 0xF080..=0xF08F;

/// The one frame that these bytes are.
fn whole(bytes: &[u8]) -> Result<FrameRef<'_>, Reason> {
    match FrameRef::split(bytes, u32::MAX) {
        Ok(Some((frame, len))) if len == bytes.len() => Ok(frame),
        Ok(_) => Err(Reason::NoFrame),
        Err(error) => Err(Reason::Malformed(error)),
    }
}

#[cfg(test)]
mod tests;
