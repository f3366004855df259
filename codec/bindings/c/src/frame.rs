//! AMS/TCP frames, for programs without an ADS library.

use codec::Encode as _;
use codec::ads::{AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef, StateFlags};
use codec::operation::Call;

use crate::error::{AdsCncError, Fault, told};
use crate::memory::{AdsCncBytes, bytes, fill, get, put, to_u32};
use crate::request::AdsCncCall;

/// The address of the sender or receiver of a frame.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct AdsCncAddress {
    /// The AMS NetId.
    pub net_id: [u8; 6],
    /// The AMS port.
    pub port: u16,
}

/// A frame.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct AdsCncFrame {
    /// The address of the receiver.
    pub target: AdsCncAddress,
    /// The address of the sender.
    pub source: AdsCncAddress,
    /// The AMS command.
    pub command: u32,
    /// The state flags, such as `ADS_CNC_REQUEST` or `ADS_CNC_RESPONSE`.
    pub state_flags: u32,
    /// The AMS error number, 0 for none.
    pub error: u32,
    /// The number that matches a response to its request.
    pub invoke_id: u32,
    /// The data after the header.
    pub data: AdsCncBytes,
}

impl AdsCncAddress {
    fn get(self) -> AmsAddr {
        AmsAddr { net_id: AmsNetId(self.net_id), port: AmsPort(self.port) }
    }

    fn of(it: AmsAddr) -> Self {
        Self { net_id: it.net_id.0, port: it.port.0 }
    }
}

impl AdsCncFrame {
    fn header(&self) -> Result<AmsHeader, Fault> {
        let short = |number, name| u16::try_from(number).map_err(|_| Fault::Argument(name));
        Ok(AmsHeader {
            target: self.target.get(),
            source: self.source.get(),
            command: Command(short(self.command, "command")?),
            state_flags: StateFlags(short(self.state_flags, "state_flags")?),
            data_length: 0,
            error: AdsError(self.error),
            invoke_id: self.invoke_id,
        })
    }
}

/// Encodes a frame, including both lengths.
///
/// # Safety
/// `frame` points to a frame, and the frame to its data; `buffer` points to `room` bytes; `length`
/// and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_frame_write(
    frame: *const AdsCncFrame,
    buffer: *mut u8,
    room: u32,
    length: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let write = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let frame = unsafe { get(frame)? };
        // SAFETY: the caller's contract.
        let frame = FrameRef::new(frame.header()?, unsafe { frame.data.get()? })?;
        // SAFETY: the caller's contract.
        unsafe { fill(buffer, room, length, |buffer| Ok(frame.encode(buffer)?.len())) }
    };
    // SAFETY: the caller's contract.
    unsafe { told(write(), error) }
}

/// Decodes the first received frame; `used` is its length, or 0 if the frame is not complete yet.
///
/// # Safety
/// `data` points to `length` bytes; `frame`, `used` and `error` are null or point to memory for one
/// value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_frame_read(
    data: *const u8,
    length: u32,
    max_data: u32,
    frame: *mut AdsCncFrame,
    used: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let read = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let received = unsafe { bytes(data, length)? };
        let Some((found, size)) = FrameRef::split(received, max_data)? else {
            // SAFETY: the caller's contract.
            unsafe { put(used, 0) };
            return Ok(());
        };
        let header = found.header();
        let it = AdsCncFrame {
            target: AdsCncAddress::of(header.target),
            source: AdsCncAddress::of(header.source),
            command: header.command.0.into(),
            state_flags: header.state_flags.0.into(),
            error: header.error.0,
            invoke_id: header.invoke_id,
            data: AdsCncBytes::of(found.data()),
        };
        // SAFETY: the caller's contract.
        unsafe {
            put(frame, it);
            put(used, to_u32(size));
        }
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(read(), error) }
}

/// Encodes the data of the frame for a call: a Read, Write or ReadWrite request.
///
/// # Safety
/// `call` points to a call, and the call to its data; `buffer` points to `room` bytes; `length` and
/// `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_call_write(
    call: *const AdsCncCall,
    buffer: *mut u8,
    room: u32,
    length: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let write = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let call = unsafe { get(call)?.call()? };
        // SAFETY: the caller's contract.
        unsafe { fill(buffer, room, length, |buffer| Ok(call.encode(buffer)?.len())) }
    };
    // SAFETY: the caller's contract.
    unsafe { told(write(), error) }
}

/// Decodes the call in a frame with the request of a Read, Write or ReadWrite. The state flags are
/// not checked.
///
/// # Safety
/// `frame` points to a frame, and the frame to its data; `call` and `error` are null or point to
/// memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_call_read(
    frame: *const AdsCncFrame,
    call: *mut AdsCncCall,
    error: *mut AdsCncError,
) -> bool {
    let read = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let frame = unsafe { get(frame)? };
        // SAFETY: the caller's contract.
        let data = unsafe { frame.data.get()? };
        let found = FrameRef::new(frame.header()?, data)?;
        let it = Call::from_frame(&found)?.ok_or(Fault::Argument("command"))?;
        // SAFETY: the caller's contract.
        unsafe { put(call, AdsCncCall::of(&it)) };
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(read(), error) }
}
