//! The state machines: the sender of an NC program and the host of services, in memory of the
//! caller.

use core::mem::MaybeUninit;

use codec::ads::AdsError;
use codec::limits::SERVICE_TEXT_MAX;
use codec::service::{Host, HostStep, Outcome, ServiceId, ServiceVariable};
use codec::streaming::{Ack, LineErrorKind, NcText, Sender, SenderState};
use codec::{CncStr, Error};

use crate::error::{AdsCncError, Fault, told};
use crate::memory::{AdsCncBytes, bytes, put, slice, to_u32};

/// Declares a state machine in memory of the caller. A number before the state marks the machine as
/// started. A program in C may copy a machine, because it has no pointer into itself.
macro_rules! machine {
    ($(#[$doc:meta])* $memory:ident, $words:literal, $state:ty, $started:literal) => {
        $(#[$doc])*
        #[repr(C)]
        pub struct $memory {
            started: u64,
            state: MaybeUninit<[u64; $words]>,
        }

        const _: () = assert!(size_of::<$state>() <= $words * 8 && align_of::<$state>() <= 8);

        impl $memory {
            /// # Safety
            /// `it` is null, or points to memory for a machine that is not accessed elsewhere
            /// during the call.
            unsafe fn start(it: *mut Self, state: Result<$state, Fault>) -> Result<(), Fault> {
                if it.is_null() {
                    return Err(Fault::Pointer);
                }
                // SAFETY: not null, and the state fits; the rest is the caller's contract.
                unsafe {
                    // The data of an earlier start may be freed, so an error must not leave it in use.
                    (&raw mut (*it).started).write(0);
                    (&raw mut (*it).state).cast::<$state>().write(state?);
                    (&raw mut (*it).started).write($started);
                }
                Ok(())
            }

            /// # Safety
            /// `it` is null, or points to a machine that was started, or to memory that is zero.
            unsafe fn state(it: *const Self) -> Result<*mut $state, Fault> {
                if it.is_null() {
                    return Err(Fault::Pointer);
                }
                // SAFETY: not null; the rest is the caller's contract.
                match unsafe { (&raw const (*it).started).read() } {
                    // SAFETY: not null.
                    $started => Ok(unsafe { &raw const (*it).state }.cast::<$state>().cast_mut()),
                    _ => Err(Fault::NotStarted),
                }
            }

            /// # Safety
            /// As for `state`; the machine is not written during `'a`.
            unsafe fn get<'a>(it: *const Self) -> Result<&'a $state, Fault> {
                // SAFETY: the caller's contract; `start` has written a state there.
                unsafe { Ok(&*Self::state(it)?) }
            }

            /// # Safety
            /// As for `state`; only the returned reference accesses the machine during `'a`.
            unsafe fn get_mut<'a>(it: *mut Self) -> Result<&'a mut $state, Fault> {
                // SAFETY: the caller's contract; `start` has written a state there.
                unsafe { Ok(&mut *Self::state(it)?) }
            }
        }
    };
}

machine! {
    /// A sender of an NC program.
    AdsCncSender, 151, Sender<'static>, 0x0AD5_C001_5E4D_E201
}

machine! {
    /// A host of services.
    AdsCncHost, 71, Services, 0x0AD5_C001_4057_0001
}

/// A host, its services, and the text of the last request that it has read.
#[derive(Clone)]
struct Services {
    host: Host<'static>,
    ids: &'static [ServiceId],
    request: [u8; SERVICE_TEXT_MAX],
    length: usize,
}

impl Services {
    fn new(ids: &'static [ServiceId]) -> Self {
        Self { host: Host::new(ids), ids, request: [0; SERVICE_TEXT_MAX], length: 0 }
    }

    fn read(&mut self, value: &[u8]) -> Result<(), Error> {
        let is_request = self.host.step() == HostStep::Read(ServiceVariable::Request);
        self.host.read(value)?;
        if is_request {
            let text = value.split(|byte| *byte == 0).next().unwrap_or_default();
            self.length = text.len().min(SERVICE_TEXT_MAX);
            self.request.iter_mut().zip(text).for_each(|(to, from)| *to = *from);
        }
        Ok(())
    }
}

/// The UUID of a service: 36 characters.
#[repr(transparent)]
pub struct AdsCncServiceId(ServiceId);

const _: () = assert!(size_of::<AdsCncServiceId>() == 36 && align_of::<AdsCncServiceId>() == 1);

/// The progress of a sender.
#[repr(C)]
pub struct AdsCncProgress {
    /// `ADS_CNC_SENDER_READY` and so on.
    pub state: u32,
    /// The number of accepted packets.
    pub packets: u32,
    /// The number of accepted lines.
    pub lines: u32,
    /// The number of accepted bytes, including CR LF after each line.
    pub bytes: u32,
    /// The number of lines that are not accepted yet.
    pub left_lines: u32,
    /// The number of bytes that are not accepted yet, including CR LF after each line.
    pub left_bytes: u32,
    /// The number of busy results for the current packet.
    pub busy_count: u32,
}

/// The next step of a host.
#[repr(C)]
pub struct AdsCncHostStep {
    /// `ADS_CNC_STEP_WAIT` and so on.
    pub kind: u32,
    /// For a request to serve: the index of the service, from 0.
    pub service: u32,
    /// For a request to serve: its state.
    pub request_state: u32,
    /// For a read or write: the name of the variable.
    pub variable: AdsCncBytes,
    /// For a write: the value. For a request to serve: its text, in CP1252.
    pub data: AdsCncBytes,
}

fn line_fault(kind: LineErrorKind) -> (u32, &'static str) {
    match kind {
        LineErrorKind::TooLong { length } => (length, "more than 990 characters"),
        LineErrorKind::NotAscii { byte } => (byte.into(), "a byte that is not ASCII"),
        LineErrorKind::Nul => (0, "a NUL"),
        _ => (0, "another error"),
    }
}

/// Starts sending an NC program. The text must stay in place while the sender is used. If a line
/// cannot be sent, `expected` of the error is the line, and `offset` the column. After an error, the
/// sender is not started, even if it was before.
///
/// # Safety
/// `sender` points to memory for a sender; `text` points to `length` bytes, which stay valid as
/// long as the sender is used; `error` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_sender_start(
    sender: *mut AdsCncSender,
    text: *const u8,
    length: u32,
    error: *mut AdsCncError,
) -> bool {
    let new = || -> Result<Sender<'static>, Fault> {
        // SAFETY: the caller's contract: the bytes last as long as the sender.
        let text = NcText::new(unsafe { bytes(text, length)? }).map_err(|error| {
            let (found, text) = line_fault(error.kind());
            Fault::Line(error.line(), error.column(), found, text)
        })?;
        Ok(Sender::new(text))
    };
    // SAFETY: the caller's contract.
    unsafe { told(AdsCncSender::start(sender, new()), error) }
}

/// Writes the packet that is to be sent now to `packet`. Returns false if all packets were
/// accepted, a packet was rejected, or the sender is not started.
///
/// # Safety
/// `sender` points to memory that is zero, or to a sender that was started and whose text is still
/// valid; `packet` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_sender_packet(
    sender: *mut AdsCncSender,
    packet: *mut AdsCncBytes,
) -> bool {
    // SAFETY: the caller's contract.
    let found = unsafe { AdsCncSender::get_mut(sender) }.ok().and_then(|it| it.packet());
    // SAFETY: the caller's contract.
    unsafe { put(packet, found.map_or(AdsCncBytes::NONE, AdsCncBytes::of)) };
    found.is_some()
}

/// Reports the result of the packet in flight. Returns false if no packet is in flight, or for an
/// unknown acknowledgement.
///
/// # Safety
/// `sender` points to memory that is zero, or to a sender that was started and whose text is still
/// valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_sender_acknowledge(
    sender: *mut AdsCncSender,
    acknowledgement: u32,
) -> bool {
    let ack = match acknowledgement {
        0 => Ack::Accepted,
        1 => Ack::Busy,
        2 => Ack::Rejected,
        _ => return false,
    };
    // SAFETY: the caller's contract.
    unsafe { AdsCncSender::get_mut(sender) }.is_ok_and(|it| it.acknowledge(ack).is_ok())
}

/// The acknowledgement for the ADS result of a write.
#[unsafe(no_mangle)]
pub extern "C" fn ads_cnc_acknowledgement(ads_error: u32) -> u32 {
    match Ack::from_result(AdsError(ads_error)) {
        Ack::Accepted => 0,
        Ack::Busy => 1,
        Ack::Rejected => 2,
    }
}

/// Returns the progress of a sender in `progress`; returns false if the sender is not started.
///
/// # Safety
/// `sender` points to memory that is zero, or to a sender that was started and whose text is still
/// valid; `progress` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_sender_progress(
    sender: *const AdsCncSender,
    progress: *mut AdsCncProgress,
) -> bool {
    // SAFETY: the caller's contract.
    let Ok(it) = (unsafe { AdsCncSender::get(sender) }) else { return false };
    let sent = it.sent();
    let found = AdsCncProgress {
        state: match it.state() {
            SenderState::Ready => 0,
            SenderState::InFlight => 1,
            SenderState::Waiting => 2,
            SenderState::Stopped => 3,
            SenderState::Done => 4,
        },
        packets: to_u32(sent.packets),
        lines: to_u32(sent.lines),
        bytes: to_u32(sent.bytes),
        left_lines: to_u32(it.left_lines()),
        left_bytes: to_u32(it.left_bytes()),
        busy_count: it.busy_count(),
    };
    // SAFETY: the caller's contract.
    unsafe { put(progress, found) };
    true
}

/// Parses the UUID of a service.
///
/// # Safety
/// `text` points to `length` bytes; `id` and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_service_id(
    text: *const u8,
    length: u32,
    id: *mut AdsCncServiceId,
    error: *mut AdsCncError,
) -> bool {
    let parse = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let text = CncStr::from_bytes(unsafe { bytes(text, length)? })?;
        // SAFETY: the caller's contract.
        unsafe { put(id, AdsCncServiceId(ServiceId::from_text(text)?)) };
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(parse(), error) }
}

/// Starts a host of services on one channel. After an error, the host is not started, even if it was
/// before.
///
/// # Safety
/// `host` points to memory for a host; `ids` points to `count` IDs, which stay valid as long as the
/// host is used; `error` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_host_start(
    host: *mut AdsCncHost,
    ids: *const AdsCncServiceId,
    count: u32,
    error: *mut AdsCncError,
) -> bool {
    // SAFETY: the caller's contract: the IDs last as long as the host. `AdsCncServiceId` is
    // transparent.
    let new = unsafe { slice(ids.cast::<ServiceId>(), count) }.map(Services::new);
    // SAFETY: the caller's contract.
    unsafe { told(AdsCncHost::start(host, new), error) }
}

/// Returns the next step in `step`. The step stays the same until a read value, an answer or an
/// event is reported. Returns false if the host is not started.
///
/// # Safety
/// `host` points to memory that is zero, or to a host that was started and whose IDs are still
/// valid; `step` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_host_step(
    host: *const AdsCncHost,
    step: *mut AdsCncHostStep,
) -> bool {
    // SAFETY: the caller's contract.
    let Ok(it) = (unsafe { AdsCncHost::get(host) }) else { return false };
    let name = |variable: ServiceVariable| AdsCncBytes::of(variable.name().as_bytes());
    let none = AdsCncHostStep {
        kind: 0,
        service: 0,
        request_state: 0,
        variable: AdsCncBytes::NONE,
        data: AdsCncBytes::NONE,
    };
    let found = match it.host.step() {
        HostStep::Wait => none,
        HostStep::Read(variable) => AdsCncHostStep { kind: 1, variable: name(variable), ..none },
        HostStep::Write(variable, value) => AdsCncHostStep {
            kind: 2,
            variable: name(variable),
            data: AdsCncBytes::of(value),
            ..none
        },
        HostStep::Serve { uuid, request_state, .. } => AdsCncHostStep {
            kind: 3,
            service: it.ids.iter().position(|id| core::ptr::eq(id, uuid)).map_or(0, to_u32),
            request_state,
            // The request to serve is the last request that was read, because a host returns it
            // after two equal reads.
            data: it.request.get(..it.length).map_or(AdsCncBytes::NONE, AdsCncBytes::of),
            ..none
        },
    };
    // SAFETY: the caller's contract.
    unsafe { put(step, found) };
    true
}

/// Reports the value that was read.
///
/// # Safety
/// `host` points to memory that is zero, or to a host that was started and whose IDs are still
/// valid; `value` points to `length` bytes; `error` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_host_read(
    host: *mut AdsCncHost,
    value: *const u8,
    length: u32,
    error: *mut AdsCncError,
) -> bool {
    let read = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let (it, value) = unsafe { (AdsCncHost::get(host)?, bytes(value, length)?) };
        // The value may be in the host, so a copy of the host reads it.
        let mut changed = it.clone();
        let result = changed.read(value);
        // SAFETY: the caller's contract.
        unsafe { *AdsCncHost::get_mut(host)? = changed };
        Ok(result?)
    };
    // SAFETY: the caller's contract.
    unsafe { told(read(), error) }
}

/// Answers the request that the last step has returned, with a CP1252 text without a NUL and a
/// state that is not 0.
///
/// # Safety
/// `host` points to memory that is zero, or to a host that was started and whose IDs are still
/// valid; `response` points to `length` bytes; `error` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_host_answer(
    host: *mut AdsCncHost,
    response: *const u8,
    length: u32,
    response_state: u32,
    error: *mut AdsCncError,
) -> bool {
    let answer = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let (it, response) = unsafe { (AdsCncHost::get(host)?, bytes(response, length)?) };
        // The response may be the request in the host, so a copy of the host is answered.
        let mut changed = it.host.clone();
        changed.answer(CncStr::from_bytes(response)?, response_state)?;
        // SAFETY: the caller's contract.
        unsafe { AdsCncHost::get_mut(host)?.host = changed };
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(answer(), error) }
}

/// Reports an event: `ADS_CNC_WRITTEN`, `ADS_CNC_FAILED`, `ADS_CNC_POLL` or `ADS_CNC_RESTART`.
/// Returns false for an unknown event, or if the host is not started.
///
/// # Safety
/// `host` points to memory that is zero, or to a host that was started and whose IDs are still
/// valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_host_event(host: *mut AdsCncHost, event: u32) -> bool {
    // SAFETY: the caller's contract.
    let Ok(it) = (unsafe { AdsCncHost::get_mut(host) }) else { return false };
    match event {
        0 => it.host.written(),
        1 => it.host.failed(),
        2 => it.host.poll(),
        3 => it.host.restart(),
        _ => return false,
    }
    true
}

/// The outcome of the last answer: `ADS_CNC_ANSWERED`, `ADS_CNC_ABANDONED`, or `ADS_CNC_NO_OUTCOME`
/// before the first answer, until the outcome of an answer is known, and if the host is not
/// started.
///
/// # Safety
/// `host` points to memory that is zero, or to a host that was started and whose IDs are still
/// valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_host_outcome(host: *const AdsCncHost) -> u32 {
    // SAFETY: the caller's contract.
    match unsafe { AdsCncHost::get(host) }.map(|it| it.host.outcome()) {
        Ok(Some(Outcome::Answered)) => 1,
        Ok(Some(Outcome::Abandoned)) => 2,
        _ => 0,
    }
}
