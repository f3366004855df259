//! From a frame to the frame that answers it.

use std::ops::Range;

use ads_cnc::ads::{
    AdsError, AdsState, AmsHeader, AmsNetId, AmsPort, AmsTcpHeader, Command, DeviceInfoReply,
    DeviceStateReply, FrameRef, ReadReplyRef, ReadRequest, ReadWriteReplyRef, ReadWriteRequestRef,
    StateFlags, WriteReply, WriteRequestRef,
};
use ads_cnc::layout::Stream;
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};
use ads_cnc::operation::{Call, Service, Task};
use ads_cnc::{Decode, Encode, Error};

use super::{Cnc, to_len, to_u32};

/// The most bytes behind the AMS header of a frame that is taken or sent: more ends a connection,
/// and is refused as the answer to a request.
pub const DATA_MAX: u32 = 0x1_0000;

/// The AMS NetId of the simulated CNC, unless it is given another.
pub const NET_ID: AmsNetId = AmsNetId([127, 0, 0, 1, 1, 1]);

/// The bit that a response has and a request has not.
const RESPONSE_BIT: u16 = StateFlags::REQUEST.0 ^ StateFlags::RESPONSE.0;

impl Cnc {
    /// Appends the frame to answer with, as the device of this NetId; nothing for a frame that is no
    /// request.
    ///
    /// A frame for another NetId or a port that no task has is answered with an error in the AMS
    /// header and no data, all other refusals with a result.
    pub fn respond(&self, net_id: AmsNetId, frame: &FrameRef<'_>, answers: &mut Vec<u8>) {
        let header = frame.header();
        if header.state_flags.0 & RESPONSE_BIT != 0 {
            let flags = header.state_flags.0;
            tracing::warn!("ignored, no request: state_flags {flags:#06x} from {}", header.source);
            return;
        }
        let start = answers.len();
        // The headers come when the length of what they stand before is known.
        answers.resize(start.saturating_add(FrameRef::HEADERS_LEN), 0);
        let behind = answers.len();
        let error = if header.target.net_id != net_id {
            Ok(AdsError::TARGET_MACHINE_NOT_FOUND)
        } else if Task::from_port(header.target.port).is_none() {
            Ok(AdsError::TARGET_PORT_NOT_FOUND)
        } else {
            let served = self.serve(header.command, header.target.port, frame.data(), answers);
            served.map(|()| AdsError::NONE)
        };
        let data_length = to_u32(answers.len().saturating_sub(behind));
        let done = error.and_then(|error| {
            let answer = AmsHeader {
                target: header.source,
                source: header.target,
                state_flags: StateFlags::RESPONSE,
                error,
                data_length,
                ..header
            };
            self.write_headers(answer, answers, start)
        });
        if let Err(error) = done {
            tracing::error!("no answer, it does not encode: {error}");
            answers.truncate(start);
        }
    }

    fn write_headers(
        &self,
        header: AmsHeader,
        answers: &mut [u8],
        start: usize,
    ) -> Result<(), Error> {
        let middle = start.saturating_add(AMS_TCP_HEADER_LEN);
        let end = start.saturating_add(FrameRef::HEADERS_LEN);
        let length = header.data_length.saturating_add(to_u32(AMS_HEADER_LEN));
        let tcp = AmsTcpHeader { reserved: 0, length };
        tcp.encode(answers.get_mut(start..middle).unwrap_or_default())?;
        header.encode(answers.get_mut(middle..end).unwrap_or_default())?;
        self.change_part(Stream::AmsTcpHeader, answers, start..middle);
        self.change_part(Stream::AmsHeader, answers, middle..end);
        Ok(())
    }

    /// Appends the data of the response to a command for a port that a task has.
    fn serve(
        &self,
        command: Command,
        port: AmsPort,
        data: &[u8],
        answers: &mut Vec<u8>,
    ) -> Result<(), Error> {
        match command {
            Command::READ => {
                let reply = self.misread(
                    data,
                    |data| {
                        let ReadRequest { index_group, index_offset, length } = decode(data)?;
                        self.ask(&Call {
                            port,
                            service: Service::Read,
                            index_group,
                            index_offset,
                            read_length: length,
                            data: &[],
                        })
                    },
                    Stream::ReadRequest,
                );
                let (result, data) = split(&reply);
                self.append(&ReadReplyRef { result, data }, Stream::ReadReply, answers)
            }
            Command::READ_WRITE => {
                let reply = self.misread(
                    data,
                    |data| {
                        let request: ReadWriteRequestRef<'_> = decode(data)?;
                        self.ask(&Call {
                            port,
                            service: Service::ReadWrite,
                            index_group: request.index_group,
                            index_offset: request.index_offset,
                            read_length: request.read_length,
                            data: request.data,
                        })
                    },
                    Stream::ReadWriteRequest,
                );
                let (result, data) = split(&reply);
                self.append(&ReadWriteReplyRef { result, data }, Stream::ReadWriteReply, answers)
            }
            Command::WRITE => {
                let reply = self.misread(
                    data,
                    |data| {
                        let request: WriteRequestRef<'_> = decode(data)?;
                        self.ask(&Call {
                            port,
                            service: Service::Write,
                            index_group: request.index_group,
                            index_offset: request.index_offset,
                            read_length: 0,
                            data: request.data,
                        })
                    },
                    Stream::WriteRequest,
                );
                let (result, _) = split(&reply);
                self.append(&WriteReply { result }, Stream::WriteReply, answers)
            }
            Command::READ_DEVICE_INFO => {
                let result = without_data(data);
                self.append(&DeviceInfoReply { result, ..INFO }, Stream::DeviceInfoReply, answers)
            }
            Command::READ_STATE => {
                let (result, ads_state) = (without_data(data), AdsState::RUN);
                let state = DeviceStateReply { result, ads_state, device_state: 0 };
                self.append(&state, Stream::DeviceStateReply, answers)
            }
            _ => {
                tracing::debug!("refused: command {}", command.0);
                self.refuse(command, answers)
            }
        }
    }

    /// What is not offered is refused in the shape that its reply has.
    fn refuse(&self, command: Command, answers: &mut Vec<u8>) -> Result<(), Error> {
        let result = AdsError::SERVICE_NOT_SUPPORTED;
        match command {
            // A result and the notification's handle, 0: as an empty Read has a result and length 0.
            Command::ADD_NOTIFICATION => {
                append(&ReadReplyRef { result, data: Some(&[]) }, answers).map(drop)
            }
            _ => self.append(&WriteReply { result }, Stream::WriteReply, answers),
        }
    }

    /// Asks the CNC; what no frame has room for is too much to ask.
    fn ask(&self, call: &Call<'_>) -> Result<Vec<u8>, AdsError> {
        let answer = self.answer(call)?;
        let room = to_len(DATA_MAX).saturating_sub(SERVICE_LEN);
        if answer.len() > room { Err(AdsError::INVALID_SIZE) } else { Ok(answer) }
    }

    /// Hands the request on, with the defect if it is about that stream.
    fn misread<T>(
        &self,
        data: &[u8],
        then: impl FnOnce(&[u8]) -> Result<T, AdsError>,
        stream: Stream,
    ) -> Result<T, AdsError> {
        match self.change(stream, data) {
            Some(changed) => then(&changed),
            None => then(data),
        }
    }

    fn append(
        &self,
        reply: &impl Encode,
        stream: Stream,
        answers: &mut Vec<u8>,
    ) -> Result<(), Error> {
        let part = append(reply, answers)?;
        self.change_part(stream, answers, part);
        Ok(())
    }

    fn change_part(&self, stream: Stream, bytes: &mut [u8], part: Range<usize>) {
        let Some(part) = bytes.get_mut(part) else { return };
        if let Some(changed) = self.change(stream, part) {
            part.iter_mut().zip(changed).for_each(|(byte, new)| *byte = new);
        }
    }
}

/// Result and length before the data of a reply.
const SERVICE_LEN: usize = 8;

/// What the simulated CNC says of itself: a name, and the version of this program.
const INFO: DeviceInfoReply = DeviceInfoReply {
    result: AdsError::NONE,
    major: number(env!("CARGO_PKG_VERSION_MAJOR")),
    minor: number(env!("CARGO_PKG_VERSION_MINOR")),
    build: match u16::from_str_radix(env!("CARGO_PKG_VERSION_PATCH"), 10) {
        Ok(number) => number,
        Err(_) => u16::MAX,
    },
    name: *b"ads-cnc serve\0\0\0",
};

/// The number of a version, or 255 if it is more.
const fn number(text: &str) -> u8 {
    match u8::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => u8::MAX,
    }
}

/// A command that takes none.
const fn without_data(data: &[u8]) -> AdsError {
    if data.is_empty() { AdsError::NONE } else { AdsError::INVALID_SIZE }
}

/// Appends a stream; where it stands.
fn append(reply: &impl Encode, answers: &mut Vec<u8>) -> Result<Range<usize>, Error> {
    let start = answers.len();
    let part = start..start.saturating_add(reply.encoded_len());
    answers.resize(part.end, 0);
    reply.encode(answers.get_mut(part.clone()).unwrap_or_default())?;
    Ok(part)
}

/// A service's header that does not hold together is a request of the wrong size.
fn decode<'a, T: Decode<'a>>(data: &'a [u8]) -> Result<T, AdsError> {
    T::decode(data).map_err(|error| {
        tracing::debug!("refused: {error}");
        AdsError::INVALID_SIZE
    })
}

/// An error has its length, 0, too: not all clients take a reply that stops before it.
fn split(reply: &Result<Vec<u8>, AdsError>) -> (AdsError, Option<&[u8]>) {
    match reply {
        Ok(data) => (AdsError::NONE, Some(data)),
        Err(result) => (*result, Some(&[])),
    }
}

#[cfg(test)]
mod tests {
    use ads_cnc::ads::AmsAddr;

    use super::*;
    use crate::defect::Defect;

    const CLIENT: AmsAddr =
        AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8001) };

    /// Number of V.E variables: group, offset, read length, write length, data.
    const COUNT: &[u8] = b"\x01\x23\x12\0\x44\0\0\0\x04\0\0\0\x04\0\0\0V.E\0";

    fn request(command: Command, port: u16, data: &[u8]) -> AmsHeader {
        AmsHeader {
            target: AmsAddr { net_id: NET_ID, port: AmsPort(port) },
            source: CLIENT,
            command,
            state_flags: StateFlags::REQUEST,
            data_length: u32::try_from(data.len()).unwrap(),
            error: AdsError::NONE,
            invoke_id: 0x0102_0304,
        }
    }

    fn respond(cnc: &Cnc, header: AmsHeader, data: &[u8]) -> Option<(AmsHeader, Vec<u8>)> {
        let mut bytes = Vec::new();
        cnc.respond(NET_ID, &FrameRef::new(header, data).unwrap(), &mut bytes);
        if bytes.is_empty() {
            return None;
        }
        let (frame, len) = FrameRef::split(&bytes, DATA_MAX).unwrap().unwrap();
        assert_eq!(len, bytes.len());
        Some((frame.header(), frame.data().to_vec()))
    }

    fn ask(command: Command, port: u16, data: &[u8]) -> (AmsHeader, Vec<u8>) {
        let cnc = Cnc::with_default_model().unwrap();
        respond(&cnc, request(command, port, data), data).unwrap()
    }

    #[test]
    fn a_response_goes_back_where_the_request_came_from() {
        let (header, data) = ask(Command::READ_WRITE, 552, COUNT);
        let expected = AmsHeader {
            target: CLIENT,
            source: AmsAddr { net_id: NET_ID, port: AmsPort::SDA },
            state_flags: StateFlags::RESPONSE,
            data_length: 12,
            ..request(Command::READ_WRITE, 552, COUNT)
        };
        assert_eq!(header, expected);
        assert_eq!(data, [0, 0, 0, 0, 4, 0, 0, 0, 123, 0, 0, 0]);
    }

    #[test]
    fn errors_are_answers_too() {
        // The error number, and the length 0 where there would be data.
        let refused = |error: u8| vec![error, 7, 0, 0, 0, 0, 0, 0];
        assert_eq!(ask(Command::READ_WRITE, 553, COUNT).1, refused(2));
        assert_eq!(ask(Command::READ_WRITE, 552, &COUNT[..19]).1, refused(5));
        assert_eq!(ask(Command::READ, 552, &COUNT[..12]).1, refused(1));
        assert_eq!(ask(Command::READ, 552, &[]).1, refused(5));
        // An object that may be written, and one that may not.
        let write = b"\x01\x01\x12\0\x01\0\0\0\x01\0\0\0\x01";
        assert_eq!(ask(Command::WRITE, 553, write).1, [0, 0, 0, 0]);
        let write = b"\x01\x01\x12\0\x03\0\0\0\x01\0\0\0\x01";
        assert_eq!(ask(Command::WRITE, 553, write).1, [4, 7, 0, 0]);
        for command in [0, 5, 7, 8, 10, 0xFFFF] {
            assert_eq!(ask(Command(command), 552, &[]).1, [1, 7, 0, 0], "{command}");
        }
        // Its reply has a handle.
        assert_eq!(ask(Command::ADD_NOTIFICATION, 552, &[0; 40]).1, refused(1));
    }

    #[test]
    fn it_says_what_it_is() {
        for port in [551, 552, 553] {
            let info = ask(Command::READ_DEVICE_INFO, port, &[]).1;
            assert_eq!(info[..8], [0, 0, 0, 0, 0, 1, 0, 0]);
            assert_eq!(info[8..], *b"ads-cnc serve\0\0\0");
            assert_eq!(ask(Command::READ_STATE, port, &[]).1, [0, 0, 0, 0, 5, 0, 0, 0]);
        }
        assert_eq!(ask(Command::READ_DEVICE_INFO, 552, &[0]).1[..4], [5, 7, 0, 0]);
        assert_eq!(ask(Command::READ_STATE, 552, &[0]).1[..4], [5, 7, 0, 0]);
        assert_eq!(ask(Command::READ_STATE, 10000, &[]).0.error, AdsError::TARGET_PORT_NOT_FOUND);
    }

    #[test]
    fn answers_are_gathered() {
        let cnc = Cnc::with_default_model().unwrap();
        let frame = FrameRef::new(request(Command::READ_WRITE, 552, COUNT), COUNT).unwrap();
        let mut answers = vec![0xAA; 3];
        for times in 1..4 {
            cnc.respond(NET_ID, &frame, &mut answers);
            assert_eq!(answers.len(), 3 + times * 50);
        }
        assert_eq!(answers[3..53], answers[103..]);
        assert_eq!(answers[..3], [0xAA; 3]);
    }

    #[test]
    fn who_is_not_there_has_no_data() {
        let (header, data) = ask(Command::READ_WRITE, 851, COUNT);
        assert_eq!((header.error, data.len()), (AdsError::TARGET_PORT_NOT_FOUND, 0));

        let cnc = Cnc::with_default_model().unwrap();
        let mut other = request(Command::READ_WRITE, 552, COUNT);
        other.target.net_id = AmsNetId([10, 0, 0, 1, 1, 1]);
        let (header, data) = respond(&cnc, other, COUNT).unwrap();
        assert_eq!((header.error, data.len()), (AdsError::TARGET_MACHINE_NOT_FOUND, 0));
        assert_eq!((header.source, header.target), (other.target, CLIENT));
    }

    #[test]
    fn a_response_is_not_answered() {
        let cnc = Cnc::with_default_model().unwrap();
        let header = AmsHeader {
            state_flags: StateFlags::RESPONSE,
            ..request(Command::READ_WRITE, 552, COUNT)
        };
        assert_eq!(respond(&cnc, header, COUNT), None);
    }

    #[test]
    fn defects_reach_the_headers_too() {
        let cnc = |id: &str| {
            Cnc::with_default_model().unwrap().with_defect(Some(Defect::by_id(id).unwrap()))
        };
        let ask =
            |id: &str| respond(&cnc(id), request(Command::READ_WRITE, 552, COUNT), COUNT).unwrap();
        assert_eq!(ask("ams-header.invoke_id.flip").0.invoke_id, 0x0102_0305);
        assert_eq!(ask("read-write-reply.result.flip").1[0], 1);
        // Read as offset 0x45.
        assert_eq!(ask("read-write-request.index_offset.flip").1[..2], [5, 7]);
        let frame = FrameRef::new(request(Command::READ_WRITE, 552, COUNT), COUNT).unwrap();
        let mut bytes = Vec::new();
        cnc("ams-tcp-header.length.flip").respond(NET_ID, &frame, &mut bytes);
        assert_eq!(bytes[..6], [0, 0, 45, 0, 0, 0]);
    }
}
