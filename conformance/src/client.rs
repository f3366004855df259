//! An AMS/TCP client that keeps every byte it sends and receives, and judges each frame.

use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use ads_cnc::ads::{
    AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, FrameRef, ReadReply, ReadRequest,
    ReadWriteReply, ReadWriteRequestRef, StateFlags, WriteReply, WriteRequestRef,
};
use ads_cnc::layout::Stream;
use ads_cnc::limits::ADS_DATA_MAX;
use ads_cnc::operation::{Call, Service};
use ads_cnc::{Decode, Encode};

use crate::exchange::{Answer, Exchange, Fault, Violation};
use crate::gate::Gate;
use crate::net;

/// Whom to ask, and as whom.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Where it listens.
    pub addr: SocketAddr,
    /// Its AMS NetId.
    pub net_id: AmsNetId,
    /// The NetId to ask as; a device answers only those it has a route to.
    pub source: AmsAddr,
    /// How long to wait for a connection and for an answer.
    pub timeout: Duration,
}

impl Target {
    /// A target on this machine.
    pub const fn local(addr: SocketAddr, net_id: AmsNetId) -> Self {
        let source = AmsAddr { net_id: AmsNetId([127, 0, 0, 1, 1, 2]), port: AmsPort(0x8000) };
        Self { addr, net_id, source, timeout: Duration::from_secs(2) }
    }
}

/// A connection to a target, through the gate.
#[derive(Debug)]
pub struct Client {
    target: Target,
    gate: Gate,
    stream: Option<TcpStream>,
    invoke_id: u32,
}

impl Client {
    /// Connects. What no client should send goes to this machine only.
    ///
    /// # Errors
    /// If nobody listens there, or the gate is open wider than is safe for another machine.
    pub fn connect(target: Target, gate: Gate) -> io::Result<Self> {
        if gate.lets_malformed_pass() && !target.addr.ip().is_loopback() {
            let why = "malformed requests are sent to a CNC on this machine only";
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, why));
        }
        let stream = net::connect(target.addr, target.timeout)?;
        Ok(Self { target, gate, stream: Some(stream), invoke_id: 0 })
    }

    /// The gate in front of the target.
    pub const fn gate(&self) -> Gate {
        self.gate
    }

    /// Sends a call and waits for its answer.
    pub fn call(&mut self, call: &Call<'_>) -> Exchange {
        self.invoke_id = self.invoke_id.wrapping_add(1);
        let mut exchange = Exchange::new(call);
        if let Err(closed) = self.gate.check(call) {
            exchange.outcome = Err(Fault::Refused(closed.to_string()));
            return exchange;
        }
        let header = AmsHeader {
            target: AmsAddr { net_id: self.target.net_id, port: call.port },
            source: self.target.source,
            command: call.service.command(),
            state_flags: StateFlags::REQUEST,
            data_length: 0,
            error: AdsError::NONE,
            invoke_id: self.invoke_id,
        };
        exchange.sent = match frame(header, call) {
            Ok(bytes) => bytes,
            Err(fault) => {
                exchange.outcome = Err(fault);
                return exchange;
            }
        };
        exchange.outcome = self.exchange(header, &mut exchange);
        if matches!(exchange.outcome, Err(Fault::Closed | Fault::Io(_))) {
            // A connection may have been closed for being idle. A query can be asked twice.
            exchange.received.clear();
            self.stream = None;
            exchange.outcome = self.exchange(header, &mut exchange);
        }
        self.judge(&header, &mut exchange);
        exchange
    }

    /// What is wrong with the frames themselves.
    fn judge(&mut self, asked: &AmsHeader, exchange: &mut Exchange) {
        match &exchange.outcome {
            Ok((answer, header)) => {
                exchange.violations.extend(violations(asked, header));
                let given = answer.data.as_ref().map_or(0, Vec::len);
                let read = exchange.read_length;
                if usize::try_from(read).is_ok_and(|read| given > read) {
                    exchange.violations.push(Violation {
                        requirement: if exchange.service == Service::Read {
                            "ADS-1"
                        } else {
                            "ADS-3"
                        },
                        what: format!("{given} bytes of data for a read length of {read}"),
                    });
                }
            }
            Err(fault) => {
                if let Fault::Malformed(error) = fault {
                    let requirement = match error.field().stream() {
                        Stream::ReadReply => "ADS-1",
                        Stream::WriteReply => "ADS-2",
                        Stream::ReadWriteReply => "ADS-3",
                        _ => "ADS-5",
                    };
                    exchange.violations.push(Violation { requirement, what: error.to_string() });
                }
                // What comes next on this connection cannot be told apart any more.
                self.stream = None;
            }
        }
    }

    fn exchange(
        &mut self,
        sent: AmsHeader,
        exchange: &mut Exchange,
    ) -> Result<(Answer, AmsHeader), Fault> {
        let stream = match self.stream.take() {
            Some(stream) => stream,
            None => net::connect(self.target.addr, self.target.timeout).map_err(Fault::gone)?,
        };
        let stream = self.stream.insert(stream);
        stream.write_all(&exchange.sent).map_err(Fault::io)?;
        let received = &mut exchange.received;
        let asked = Instant::now();
        let mut chunk = [0; 4096];
        loop {
            let max = u32::try_from(ADS_DATA_MAX).unwrap_or(u32::MAX).saturating_add(16);
            if let Some((frame, len)) = FrameRef::split(received, max).map_err(Fault::Malformed)? {
                let header = frame.header();
                if header.invoke_id == sent.invoke_id {
                    let answer = answer(sent, &frame);
                    if let Some(more) = received.len().checked_sub(len).filter(|more| *more > 0) {
                        let what = format!("{more} bytes behind the answer that nobody asked for");
                        exchange.violations.push(Violation { requirement: "ADS-5", what });
                        self.stream = None;
                    }
                    received.truncate(len);
                    return answer.map(|answer| (answer, header));
                }
                let (id, asked) = (header.invoke_id, sent.invoke_id);
                let what = format!("an answer to invoke ID {id:#x}, asked was {asked:#x}");
                exchange.violations.push(Violation { requirement: "ADS-5", what });
                received.drain(..len);
                continue;
            }
            let left = self.target.timeout.saturating_sub(asked.elapsed());
            if left.is_zero() {
                return Err(Fault::Silence(self.target.timeout));
            }
            stream.set_read_timeout(Some(left)).map_err(Fault::io)?;
            match stream.read(&mut chunk) {
                Ok(0) => return Err(Fault::Closed),
                Ok(len) => received.extend(chunk.iter().take(len)),
                Err(error)
                    if matches!(
                        error.kind(),
                        io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut
                    ) =>
                {
                    return Err(Fault::Silence(self.target.timeout));
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(Fault::io(error)),
            }
        }
    }
}

/// The whole frame of a call.
fn frame(header: AmsHeader, call: &Call<'_>) -> Result<Vec<u8>, Fault> {
    let Call { index_group, index_offset, read_length, data, .. } = *call;
    let payload = match call.service {
        Service::Read => ReadRequest { index_group, index_offset, length: read_length }.to_vec(),
        Service::Write => WriteRequestRef { index_group, index_offset, data }.to_vec(),
        Service::ReadWrite => {
            ReadWriteRequestRef { index_group, index_offset, read_length, data }.to_vec()
        }
    };
    let payload = payload.map_err(Fault::Unsendable)?;
    let frame = FrameRef::new(header, &payload).map_err(Fault::Unsendable)?;
    let mut bytes = vec![0; frame.encoded_len()];
    frame.encode(&mut bytes).map_err(Fault::Unsendable)?;
    Ok(bytes)
}

/// What the frame answers.
fn answer(sent: AmsHeader, frame: &FrameRef<'_>) -> Result<Answer, Fault> {
    let header = frame.header();
    if !header.error.is_none() && frame.data().is_empty() {
        return Ok(Answer { ams_error: header.error, result: AdsError::NONE, data: None });
    }
    let (result, data) = match sent.command {
        command if command == Service::Read.command() => {
            ReadReply::decode(frame.data()).map(|reply| (reply.result, reply.data))
        }
        command if command == Service::ReadWrite.command() => {
            ReadWriteReply::decode(frame.data()).map(|reply| (reply.result, reply.data))
        }
        _ => WriteReply::decode(frame.data()).map(|reply| (reply.result, None)),
    }
    .map_err(Fault::Malformed)?;
    Ok(Answer { ams_error: header.error, result, data })
}

/// What of ADS-5 the response's header does not keep.
fn violations(sent: &AmsHeader, got: &AmsHeader) -> Vec<Violation> {
    let checks = [
        (
            got.command == sent.command,
            format!("command {} answered by {}", sent.command.0, got.command.0),
        ),
        (
            got.state_flags == StateFlags::RESPONSE,
            format!("state flags {:#06x} instead of 0x0005", got.state_flags.0),
        ),
        (
            got.target == sent.source,
            format!("answered to {}, asked by {}", got.target, sent.source),
        ),
        (got.source == sent.target, format!("answered by {}, asked {}", got.source, sent.target)),
    ];
    let broken = checks.into_iter().filter(|(kept, _)| !kept);
    broken.map(|(_, what)| Violation { requirement: "ADS-5", what }).collect()
}
