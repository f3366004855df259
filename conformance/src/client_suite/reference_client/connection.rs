//! Sends the requests of this project's client and receives the replies; a defect may change their
//! bytes.

use std::io::{self, Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use ads_cnc::ads::{AmsAddr, AmsHeader, AmsPort, FrameRef, StateFlags};
use ads_cnc::operation::{AdsService, Operation};

use super::ClientFault;
use super::apply_defect::{OutgoingRequest, apply_to_frame, misread, skip_check};
use super::error::ActionError;
use crate::client::{SOURCE_PORT, answer, frame, net_id_of};
use crate::client_suite::CncAddress;
use crate::net;
use crate::number::to_usize;
use crate::simulator::DATA_MAX;
use crate::text::plural;

/// How long to wait for a connection and for the bytes of each read; also the time after which an
/// incomplete reply is no longer awaited.
const TIMEOUT: Duration = Duration::from_secs(3);

pub(super) struct Connection {
    stream: TcpStream,
    header: AmsHeader,
    received: Vec<u8>,
    pub(super) fault: Option<ClientFault>,
}

impl Connection {
    pub(super) fn connect(
        cnc_address: &CncAddress,
        fault: Option<ClientFault>,
    ) -> Result<Self, ActionError> {
        let stream = net::connect_ungated(cnc_address.addr, TIMEOUT)?;
        let source = AmsAddr { net_id: net_id_of(stream.local_addr()?.ip()), port: SOURCE_PORT };
        let target = AmsAddr { net_id: cnc_address.net_id, port: AmsPort::SDA };
        let header = AmsHeader::request(target, source, AdsService::Read.command(), 0);
        Ok(Self { stream, header, received: Vec::new(), fault })
    }

    pub(super) fn has(&self, fault: ClientFault) -> bool {
        self.fault == Some(fault)
    }

    /// Calls a function and decodes its reply, which borrows from `reply`.
    pub(super) fn call<'r, O: Operation>(
        &mut self,
        operation: &O,
        reply: &'r mut Vec<u8>,
    ) -> Result<O::Reply<'r>, ActionError> {
        let spec = O::FUNCTION.spec();
        let mut buf = vec![0; operation.encoded_len()];
        let data = operation.encode(&mut buf)?.to_vec();
        let mut outgoing = OutgoingRequest {
            port: spec.task.port(),
            service: spec.service,
            group: operation.index_group().get(),
            offset: operation.index_offset().get(),
            length: operation.read_length(),
            data,
        };
        if let Some(fault) = self.fault {
            outgoing.apply_fault(fault);
        }
        *reply = self.exchange(&outgoing)?;
        if let Some(fault) = self.fault {
            misread(fault, &outgoing, reply);
        }
        Ok(operation.decode_reply(reply)?)
    }

    fn exchange(&mut self, outgoing: &OutgoingRequest) -> Result<Vec<u8>, ActionError> {
        let call = outgoing.call();
        let invoke_id = self.header.invoke_id.wrapping_add(1);
        self.header = AmsHeader {
            target: AmsAddr { port: call.port, ..self.header.target },
            command: call.service.command(),
            invoke_id,
            ..self.header
        };
        let mut bytes = frame(self.header, &call)?;
        if let Some(fault) = self.fault {
            apply_to_frame(fault, &mut bytes);
        }
        self.stream.write_all(&bytes)?;
        let begun = Instant::now();
        let mut chunk = [0; 8192];
        loop {
            if let Some(reply) = self.reply(outgoing)? {
                return Ok(reply);
            }
            if begun.elapsed() > TIMEOUT {
                return Err(self.timeout());
            }
            match self.stream.read(&mut chunk) {
                Ok(0) if self.has(ClientFault::CutFrame) => return self.cut(),
                Ok(0) => return Err("the connection was closed".into()),
                Ok(count) => self.received.extend(chunk.iter().take(count)),
                Err(error) => match error.kind() {
                    io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => {
                        return Err(self.timeout());
                    }
                    _ => return Err(error.into()),
                },
            }
            if self.has(ClientFault::OneRead)
                && matches!(FrameRef::split(&self.received, DATA_MAX), Ok(None))
            {
                return Err("an incomplete frame".into());
            }
        }
    }

    fn timeout(&self) -> ActionError {
        if self.has(ClientFault::Hangs) {
            ActionError::Hangs
        } else {
            "no reply within the time limit".into()
        }
    }

    /// The received data after the headers, result and length, although the frame is incomplete.
    fn cut(&mut self) -> Result<Vec<u8>, ActionError> {
        Ok(self.received.get(46..).unwrap_or_default().to_vec())
    }

    /// The data of the reply; `None` if the reply has not yet arrived completely.
    fn reply(&mut self, outgoing: &OutgoingRequest) -> Result<Option<Vec<u8>>, ActionError> {
        loop {
            if let Some(fault) = self.fault {
                skip_check(fault, &mut self.received)?;
            }
            let Some((frame, len)) = FrameRef::split(&self.received, DATA_MAX)? else {
                return Ok(None);
            };
            let header = frame.header();
            let is_mine = header.invoke_id == self.header.invoke_id;
            if !is_mine && !self.has(ClientFault::AnyInvokeId) {
                self.received.drain(..len);
                continue;
            }
            let any = self.has(ClientFault::AnyCommand);
            if header.command != self.header.command && !any {
                return Err("a reply to another command".into());
            }
            if header.state_flags != StateFlags::RESPONSE && !self.has(ClientFault::AnyFlags) {
                return Err("the frame is not a response".into());
            }
            if frame.data().is_empty() && self.has(ClientFault::DiesOfError) {
                return Err(ActionError::Dies);
            }
            if !header.error.is_ok() && self.has(ClientFault::NoError) {
                return Ok(Some(Vec::new()));
            }
            let sent = AmsHeader { command: header.command, ..self.header };
            let read = answer(sent, header, frame.data());
            let answer = read?;
            self.received.drain(..len);
            if !answer.ams_error.is_ok() {
                return Err(ActionError::Rejected(answer.ams_error));
            }
            if !answer.result.is_ok() && !self.has(ClientFault::NoResult) {
                return Err(ActionError::Rejected(answer.result));
            }
            let data = answer.data.unwrap_or_default();
            let lenient =
                [ClientFault::CutsOff, ClientFault::FillsUpValue].map(Some).contains(&self.fault);
            let most = to_usize(outgoing.length);
            if data.len() > most && !lenient {
                return Err(
                    format!("{} for a read length of {most}", plural(data.len(), "byte")).into()
                );
            }
            return Ok(Some(data));
        }
    }
}
