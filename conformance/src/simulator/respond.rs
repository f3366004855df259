//! Answers frames.

use ads_cnc::ads::{
    AdsError, AdsState, AmsHeader, AmsNetId, AmsTcpHeader, Command, DeviceInfoReply,
    DeviceStateReply, FrameRef, ReadReplyRef, ReadWriteReplyRef, StateFlags, WriteReply,
};
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};
use ads_cnc::operation::{AdsService, Call, Task};
use ads_cnc::{Encode, Error};

use crate::ads_service::service_of;
use crate::number::{to_u32, to_usize};

/// Maximum number of bytes after the AMS header. A longer received frame ends the connection; a
/// request with a longer reply is rejected.
pub const DATA_MAX: u32 = 0x1_0000;

/// Maximum length of a frame in bytes, including its headers.
pub(crate) const FRAME_MAX: usize = FrameRef::HEADERS_LEN + 0x1_0000;

const _: () = assert!(DATA_MAX == 0x1_0000);

/// The bit of the state flags that marks a response.
const RESPONSE_BIT: u16 = StateFlags::REQUEST.0 ^ StateFlags::RESPONSE.0;

/// The data of a reply, or the error number.
pub type ReplyData = Result<Vec<u8>, AdsError>;

/// Answers a request with data or an error number.
type Answering<'a> = &'a mut dyn FnMut(&Call<'_>) -> ReplyData;

/// Appends the frame of the reply; see [`Responder::respond`](super::Responder::respond).
pub(crate) fn respond(
    cnc: Answering<'_>,
    net_id: AmsNetId,
    frame: &FrameRef<'_>,
    answers: &mut Vec<u8>,
) {
    let header = frame.header();
    if header.state_flags.0 & RESPONSE_BIT != 0 {
        let flags = header.state_flags.0;
        tracing::debug!("ignored, not a request: state_flags {flags:#06x} from {}", header.source);
        return;
    }
    let start = answers.len();
    // Reserve room for the headers, which are written when the length of the data is known.
    answers.resize(start.saturating_add(FrameRef::HEADERS_LEN), 0);
    let after = answers.len();
    let error = if header.target.net_id != net_id {
        Ok(AdsError::TARGET_MACHINE_NOT_FOUND)
    } else if Task::from_port(header.target.port).is_none() {
        Ok(AdsError::TARGET_PORT_NOT_FOUND)
    } else {
        serve(cnc, frame, answers).map(|()| AdsError::NO_ERROR)
    };
    let data_length = to_u32(answers.len().saturating_sub(after));
    let done = error.and_then(|error| {
        let answer = AmsHeader { error, data_length, ..header.response() };
        write_headers(answer, answers, start)
    });
    if let Err(error) = done {
        tracing::error!("no reply, because it cannot be encoded: {error}");
        answers.truncate(start);
    }
}

fn write_headers(header: AmsHeader, answers: &mut [u8], start: usize) -> Result<(), Error> {
    let middle = start.saturating_add(AMS_TCP_HEADER_LEN);
    let end = start.saturating_add(FrameRef::HEADERS_LEN);
    let length = header.data_length.saturating_add(to_u32(AMS_HEADER_LEN));
    let tcp = AmsTcpHeader { reserved: 0, length };
    tcp.encode(answers.get_mut(start..middle).unwrap_or_default())?;
    header.encode(answers.get_mut(middle..end).unwrap_or_default())?;
    Ok(())
}

/// Appends the data of the reply to a command at the port of a task.
fn serve(cnc: Answering<'_>, frame: &FrameRef<'_>, answers: &mut Vec<u8>) -> Result<(), Error> {
    let (command, data) = (frame.header().command, frame.data());
    if let Some(service) = service_of(command) {
        let reply = ask(cnc, frame);
        // Include the length 0 in an error reply to a Read or ReadWrite, because not all clients
        // accept a reply that ends before the length.
        let (result, data) = match &reply {
            Ok(data) => (AdsError::NO_ERROR, Some(data.as_slice())),
            Err(result) => (*result, Some(&[][..])),
        };
        return match service {
            AdsService::Read => append(&ReadReplyRef { result, data }, answers),
            AdsService::Write => append(&WriteReply { result }, answers),
            AdsService::ReadWrite => append(&ReadWriteReplyRef { result, data }, answers),
        };
    }
    match command {
        Command::READ_DEVICE_INFO => {
            append(&DeviceInfoReply { result: without_data(data), ..INFO }, answers)
        }
        Command::READ_STATE => {
            let (result, ads_state) = (without_data(data), AdsState::RUN);
            append(&DeviceStateReply { result, ads_state, device_state: 0 }, answers)
        }
        _ => {
            tracing::debug!("rejected: command {}", command.0);
            let result = AdsError::SERVICE_NOT_SUPPORTED;
            match command {
                // Include the notification handle 0, like the length 0 of a Read: both are four
                // bytes.
                Command::ADD_NOTIFICATION => {
                    append(&ReadReplyRef { result, data: Some(&[]) }, answers)
                }
                _ => append(&WriteReply { result }, answers),
            }
        }
    }
}

/// Calls the CNC. A request with an invalid header of its service, and a reply that does not fit
/// into a frame, become errors.
fn ask(cnc: Answering<'_>, frame: &FrameRef<'_>) -> ReplyData {
    let call = Call::from_frame(frame).map_err(|error| {
        // Answer an invalid header of a service like a request of the wrong size.
        tracing::debug!("rejected: {error}");
        AdsError::INVALID_SIZE
    })?;
    let answer = cnc(&call.ok_or(AdsError::SERVICE_NOT_SUPPORTED)?)?;
    let room = to_usize(DATA_MAX).saturating_sub(SERVICE_LEN);
    if answer.len() > room { Err(AdsError::INVALID_SIZE) } else { Ok(answer) }
}

/// Number of bytes before the data of a reply to a Read or ReadWrite: result and length.
const SERVICE_LEN: usize = 8;

/// The device information of the simulated CNC: a name, and the version of this program.
const INFO: DeviceInfoReply = DeviceInfoReply {
    result: AdsError::NO_ERROR,
    major: number(env!("CARGO_PKG_VERSION_MAJOR")),
    minor: number(env!("CARGO_PKG_VERSION_MINOR")),
    build: match u16::from_str_radix(env!("CARGO_PKG_VERSION_PATCH"), 10) {
        Ok(number) => number,
        Err(_) => u16::MAX,
    },
    name: *b"ads-cnc serve\0\0\0",
};

/// Parses a number of the version; 255 if the number is greater.
const fn number(text: &str) -> u8 {
    match u8::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => u8::MAX,
    }
}

/// The result of a command that must not have data.
const fn without_data(data: &[u8]) -> AdsError {
    if data.is_empty() { AdsError::NO_ERROR } else { AdsError::INVALID_SIZE }
}

fn append(reply: &impl Encode, answers: &mut Vec<u8>) -> Result<(), Error> {
    let start = answers.len();
    answers.resize(start.saturating_add(reply.encoded_len()), 0);
    reply.encode(answers.get_mut(start..).unwrap_or_default())?;
    Ok(())
}

#[cfg(test)]
mod tests;
