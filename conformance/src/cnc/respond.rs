//! From a frame to the frame that answers it.

use std::ops::Range;

use ads_cnc::ads::{
    AdsError, AmsHeader, AmsNetId, AmsPort, Command, FrameRef, ReadReplyRef, ReadRequest,
    ReadWriteReplyRef, ReadWriteRequestRef, StateFlags, WriteReply, WriteRequestRef,
};
use ads_cnc::layout::Stream;
use ads_cnc::limits::AMS_TCP_HEADER_LEN;
use ads_cnc::operation::{Call, Service, Task};
use ads_cnc::{Decode, Encode, Error};

use super::Cnc;

/// The most bytes behind the AMS header of a frame that is taken or sent: more ends a connection.
pub const DATA_MAX: u32 = 0x1_0000;

/// The AMS NetId of the simulated CNC.
pub const NET_ID: AmsNetId = AmsNetId([127, 0, 0, 1, 1, 1]);

/// The bit that a response has and a request has not.
const RESPONSE_BIT: u16 = StateFlags::REQUEST.0 ^ StateFlags::RESPONSE.0;

impl Cnc {
    /// The frame to answer with; none for a frame that is no request.
    ///
    /// A frame for another NetId or a port that no task has is answered with an error in the AMS
    /// header and no data, all other refusals with a result.
    pub fn respond(&self, frame: &FrameRef<'_>) -> Option<Vec<u8>> {
        let header = frame.header();
        if header.state_flags.0 & RESPONSE_BIT != 0 {
            let flags = header.state_flags.0;
            tracing::warn!("ignored, no request: state_flags {flags:#06x} from {}", header.source);
            return None;
        }
        let (error, data) = if header.target.net_id != NET_ID {
            (AdsError::TARGET_MACHINE_NOT_FOUND, Vec::new())
        } else if Task::from_port(header.target.port).is_none() {
            (AdsError::TARGET_PORT_NOT_FOUND, Vec::new())
        } else {
            let reply = self.serve(header.command, header.target.port, frame.data());
            (AdsError::NONE, reply.map_err(unencodable).ok()?)
        };
        let answer = AmsHeader {
            target: header.source,
            source: header.target,
            state_flags: StateFlags::RESPONSE,
            error,
            ..header
        };
        let encoded = FrameRef::new(answer, &data).and_then(|frame| frame.to_vec());
        let mut bytes = encoded.map_err(unencodable).ok()?;
        self.change_part(Stream::AmsTcpHeader, &mut bytes, 0..AMS_TCP_HEADER_LEN);
        self.change_part(Stream::AmsHeader, &mut bytes, AMS_TCP_HEADER_LEN..FrameRef::HEADERS_LEN);
        Some(bytes)
    }

    /// The data of the response to a command for a port that a task has.
    fn serve(&self, command: Command, port: AmsPort, data: &[u8]) -> Result<Vec<u8>, Error> {
        match command {
            Command::READ => {
                let reply = self.misread(
                    data,
                    |data| {
                        let ReadRequest { index_group, index_offset, length } = decode(data)?;
                        self.answer(&Call {
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
                self.reply_stream(&ReadReplyRef { result, data }, Stream::ReadReply)
            }
            Command::READ_WRITE => {
                let reply = self.misread(
                    data,
                    |data| {
                        let request: ReadWriteRequestRef<'_> = decode(data)?;
                        self.answer(&Call {
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
                self.reply_stream(&ReadWriteReplyRef { result, data }, Stream::ReadWriteReply)
            }
            Command::WRITE => {
                let reply = self.misread(
                    data,
                    |data| {
                        let request: WriteRequestRef<'_> = decode(data)?;
                        self.answer(&Call {
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
                self.reply_stream(&WriteReply { result }, Stream::WriteReply)
            }
            // No other command has a stream yet; a result alone is the reply that all have.
            _ => {
                let result = AdsError::SERVICE_NOT_SUPPORTED;
                self.reply_stream(&WriteReply { result }, Stream::WriteReply)
            }
        }
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

    fn reply_stream(&self, reply: &impl Encode, stream: Stream) -> Result<Vec<u8>, Error> {
        let bytes = reply.to_vec()?;
        Ok(self.change(stream, &bytes).unwrap_or(bytes))
    }

    fn change_part(&self, stream: Stream, bytes: &mut [u8], part: Range<usize>) {
        let Some(part) = bytes.get_mut(part) else { return };
        if let Some(changed) = self.change(stream, part) {
            part.iter_mut().zip(changed).for_each(|(byte, new)| *byte = new);
        }
    }
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

fn unencodable(error: Error) {
    tracing::error!("no answer, it does not encode: {error}");
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
        let bytes = cnc.respond(&FrameRef::new(header, data).unwrap())?;
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
        for command in [0, 1, 4, 5, 6, 7, 8, 10, 0xFFFF] {
            assert_eq!(ask(Command(command), 552, &[]).1, [1, 7, 0, 0], "{command}");
        }
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
        let bytes = cnc("ams-tcp-header.length.flip").respond(&frame).unwrap();
        assert_eq!(bytes[..6], [0, 0, 45, 0, 0, 0]);
    }
}
