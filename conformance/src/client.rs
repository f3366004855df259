//! An AMS/TCP client that keeps every byte it sends and receives, and judges each frame.

mod inquiry;
mod judge;
mod tap;
mod target;

use std::io;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::Encode;
use ads_cnc::ads::{AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef};
use ads_cnc::operation::{Call, Service};

use crate::exchange::{AdsReply, Exchange, ExchangeError, Violation};
use crate::gate::{Gate, Permit};
use crate::net::Wire;
use crate::simulator::{InProcess, Responder, Server};
use crate::text::Moment;
use crate::wire_service::{decode_reply, service_of};

pub use inquiry::{Inquired, Inquiry, InquiryReply};
pub use tap::Tap;
pub use target::Target;
pub(crate) use target::net_id_of;

/// The AMS port to ask as; nobody has to listen there.
pub(crate) const SOURCE_PORT: AmsPort = AmsPort(0x8000);

/// A connection to a target, through the gate.
#[derive(Debug)]
pub struct Client {
    target: Target,
    source: AmsNetId,
    gate: Gate,
    wire: Option<Wire>,
    dial: Dial,
    capture: Option<Box<dyn Tap>>,
    dry: bool,
    last: Option<Instant>,
    invoke_id: u32,
    piece: Option<usize>,
}

/// How a connection is opened, the first one and those after a lost one.
#[derive(Clone, Debug)]
enum Dial {
    /// Over TCP, to the target's address.
    Tcp,
    /// To a CNC of this process, without a socket.
    InProcess(Arc<dyn Responder>),
}

/// Between the pieces of a frame that is sent in pieces.
const PAUSE: Duration = Duration::from_millis(1);

/// The most frames with another invoke ID, before an answer, that are told one by one.
const STRAYS_TOLD: u64 = 3;

/// Before the first: no byte of it is 0 or like another, as a response has to have all four.
const FIRST_INVOKE_ID: u32 = 0x5403_0201;

impl Gate {
    /// Anything but what is never sent: for the CNC that this server of this process has, which
    /// moves nothing. [`Client`] takes no other address with it.
    pub fn of_server(server: &Server) -> Self {
        Self::of_address(server.addr())
    }
}

impl Client {
    /// Connects. What no client should send goes to this machine only.
    ///
    /// # Errors
    /// If nobody listens there, or the gate is open wider than is safe for another machine.
    pub fn connect(target: Target, gate: Gate) -> io::Result<Self> {
        Self::dialled(target, gate, Dial::Tcp)
    }

    /// Connects to a CNC of this process without a socket. The CNC's clock, which must be stopped,
    /// runs while an answer is awaited in vain.
    ///
    /// # Errors
    /// If the gate is open wider than is safe for another machine.
    pub fn in_process(target: Target, gate: Gate, cnc: Arc<dyn Responder>) -> io::Result<Self> {
        Self::dialled(target, gate, Dial::InProcess(cnc))
    }

    fn dialled(target: Target, gate: Gate, dial: Dial) -> io::Result<Self> {
        let mut client = Self { dial, ..Self::unconnected(target, gate)? };
        let wire = client.dial()?;
        client.source = target.source.unwrap_or(net_id_of(wire.local().ip()));
        client.wire = Some(wire);
        Ok(client)
    }

    /// A dry run: it connects to nobody and sends nothing, but asks the gate.
    ///
    /// # Errors
    /// If the gate is open wider than is safe for another machine.
    pub fn dry(target: Target, gate: Gate) -> io::Result<Self> {
        Ok(Self { dry: true, ..Self::unconnected(target, gate)? })
    }

    fn dial(&self) -> io::Result<Wire> {
        match &self.dial {
            Dial::Tcp => Wire::connect(self.target.addr, self.target.timeout),
            Dial::InProcess(cnc) => {
                Ok(Wire::over(Box::new(InProcess::new(Arc::clone(cnc), self.target.net_id))))
            }
        }
    }

    fn unconnected(target: Target, gate: Gate) -> io::Result<Self> {
        let gate = gate.to_address(target.addr.ip());
        if gate.lets_malformed_pass() && !target.addr.ip().to_canonical().is_loopback() {
            let why = "malformed requests are sent to a CNC on this machine only";
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, why));
        }
        if gate.simulated().is_some_and(|only| only != target.addr) {
            let why = "writes of all kinds are sent to the simulated CNC only";
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, why));
        }
        Ok(Self {
            target,
            source: target.source.unwrap_or(net_id_of(target.addr.ip())),
            gate,
            wire: None,
            dial: Dial::Tcp,
            capture: None,
            dry: false,
            last: None,
            invoke_id: FIRST_INVOKE_ID,
            piece: None,
        })
    }

    /// With another time to wait for a connection and for an answer.
    #[must_use]
    pub(crate) const fn with_timeout(mut self, timeout: Duration) -> Self {
        self.target.timeout = timeout;
        self
    }

    /// With a capture of all that is sent and received from now on.
    #[must_use]
    pub fn with_capture(mut self, capture: impl Into<Box<dyn Tap>>) -> Self {
        let mut capture = capture.into();
        if let Some(wire) = &self.wire {
            capture.opened(wire.local(), self.target.addr);
        }
        self.capture = Some(capture);
        self
    }

    /// The capture, for another connection; on this one nothing more is kept.
    pub(crate) fn take_capture(&mut self) -> Option<Box<dyn Tap>> {
        let mut capture = self.capture.take()?;
        capture.closed();
        Some(capture)
    }

    /// Ends the capture, if there is one.
    pub fn end_capture(&mut self) -> io::Result<()> {
        self.capture.take().map_or(Ok(()), Tap::finish)
    }

    /// Sends frames in pieces of this size from now on, or whole again.
    pub(crate) const fn set_piece(&mut self, piece: Option<usize>) {
        self.piece = piece;
    }

    /// Lets time pass, for the target too.
    pub(crate) fn wait(&self, time: Duration) {
        match &self.dial {
            Dial::Tcp => thread::sleep(time),
            Dial::InProcess(cnc) => cnc.pass(time),
        }
    }

    /// The gate in front of the target.
    pub const fn gate(&self) -> &Gate {
        &self.gate
    }

    pub const fn target(&self) -> &Target {
        &self.target
    }

    /// The NetId it asks as.
    pub const fn source(&self) -> AmsNetId {
        self.source
    }

    /// Whether nothing is sent.
    pub const fn is_dry(&self) -> bool {
        self.dry
    }

    /// Whether the gate would let a call pass now; nothing is sent.
    ///
    /// # Errors
    /// [`ExchangeError::Refused`], [`ExchangeError::Unsendable`].
    pub fn check(&self, call: &Call<'_>) -> Result<(), ExchangeError> {
        let bytes = frame(self.header(call.port, call.service.command()), call)?;
        let permit = self.gate.check(&bytes, Moment::now());
        permit.map(drop).map_err(|refusal| ExchangeError::Refused(Box::new(refusal)))
    }

    /// Sends a call and waits for its answer.
    pub fn call(&mut self, call: &Call<'_>) -> Exchange {
        let mut exchange = Exchange::new(call);
        exchange.outcome = match self.sent(call, &mut exchange) {
            Ok(header) => {
                self.judge(&header, &mut exchange);
                return exchange;
            }
            Err(fault) => Err(fault),
        };
        exchange
    }

    /// Sends a call if it may be, and keeps what comes of it; the header it went out with.
    fn sent(
        &mut self,
        call: &Call<'_>,
        exchange: &mut Exchange,
    ) -> Result<AmsHeader, ExchangeError> {
        let header = self.next_header(call.port, call.service.command());
        let bytes = frame(header, call)?;
        let Exchange { received, violations, .. } = exchange;
        let came = self.deliver(&bytes, header, received, violations)?;
        exchange.outcome = came.and_then(|got| {
            let data = exchange.received.get(FrameRef::HEADERS_LEN..).unwrap_or_default();
            answer(header, got, data).map(|answer| (answer, got))
        });
        exchange.sent = bytes;
        if let Some(data) = exchange.answer().and_then(AdsReply::success) {
            self.gate.learn(call, data);
        }
        Ok(header)
    }

    /// Sends a frame if it may be sent, and waits for the one that answers it, which is then all
    /// that was received. The outer error is why nothing was sent.
    fn deliver(
        &mut self,
        bytes: &[u8],
        header: AmsHeader,
        received: &mut Vec<u8>,
        violations: &mut Vec<Violation>,
    ) -> Result<Result<AmsHeader, ExchangeError>, ExchangeError> {
        let permit = self.gate.check(bytes, Moment::now());
        let permit = permit.map_err(|refusal| ExchangeError::Refused(Box::new(refusal)))?;
        if self.dry {
            return Err(ExchangeError::NotSent);
        }
        let mut strays = 0;
        let mut came = self.exchange(permit, header, received, violations, &mut strays);
        let lost = matches!(came, Err(ExchangeError::Closed | ExchangeError::Io(_)));
        if lost && permit.is_repeatable() {
            // A connection may have been closed for being idle. Whether a write was done before
            // that nobody knows: it is not sent twice.
            received.clear();
            self.disconnect();
            came = self.exchange(permit, header, received, violations, &mut strays);
        }
        if let Some(more) = strays.checked_sub(STRAYS_TOLD).filter(|more| *more > 0) {
            let what = format!("{more} more answers to other invoke IDs; {STRAYS_TOLD} are shown");
            violations.push(Violation { requirement: "ADS-5", what });
        }
        Ok(came)
    }

    /// With an invoke ID that the request before did not have.
    fn next_header(&mut self, port: AmsPort, command: Command) -> AmsHeader {
        self.invoke_id = self.invoke_id.wrapping_add(1);
        self.header(port, command)
    }

    fn header(&self, port: AmsPort, command: Command) -> AmsHeader {
        let low = u16::try_from(self.invoke_id & 0xF).unwrap_or_default();
        let target = AmsAddr { net_id: self.target.net_id, port };
        // Not always the same: an answer goes to where its request came from.
        let source = AmsAddr { net_id: self.source, port: AmsPort(SOURCE_PORT.0 | low) };
        AmsHeader::request(target, source, command, self.invoke_id)
    }

    /// Ends the connection. Who answers on the next may be another, or have restarted.
    fn disconnect(&mut self) {
        self.wire = None;
        if let Some(capture) = &mut self.capture {
            capture.closed();
        }
        self.gate.forget();
    }

    /// Waits until the target may be asked again.
    fn keep_pace(&mut self) {
        if let Some(last) = self.last {
            thread::sleep(self.target.pace.saturating_sub(last.elapsed()));
        }
        self.last = Some(Instant::now());
    }

    fn exchange(
        &mut self,
        permit: Permit<'_>,
        sent: AmsHeader,
        received: &mut Vec<u8>,
        violations: &mut Vec<Violation>,
        strays: &mut u64,
    ) -> Result<AmsHeader, ExchangeError> {
        self.keep_pace();
        let wire = match self.wire.take() {
            Some(wire) => wire,
            None => {
                let wire = self.dial().map_err(ExchangeError::disconnected)?;
                if let Some(capture) = &mut self.capture {
                    capture.opened(wire.local(), self.target.addr);
                }
                wire
            }
        };
        let wire = self.wire.insert(wire);
        let sent_all = match self.piece {
            Some(piece) => wire.send_in_pieces(permit, piece, PAUSE),
            None => wire.send(permit),
        };
        sent_all.map_err(ExchangeError::io)?;
        if let Some(capture) = &mut self.capture {
            capture.sent(permit.frame());
        }
        let asked = Instant::now();
        let mut chunk = [0; 4096];
        loop {
            let split = FrameRef::split(received, u32::MAX).map_err(ExchangeError::Malformed)?;
            if let Some((frame, len)) = split {
                let header = frame.header();
                if header.invoke_id == sent.invoke_id {
                    if let Some(more) = received.len().checked_sub(len).filter(|more| *more > 0) {
                        let what =
                            format!("{more} bytes after the answer that no request asked for");
                        violations.push(Violation { requirement: "ADS-5", what });
                        self.disconnect();
                    }
                    received.truncate(len);
                    return Ok(header);
                }
                *strays = strays.saturating_add(1);
                if *strays <= STRAYS_TOLD {
                    let (id, asked) = (header.invoke_id, sent.invoke_id);
                    let what = format!("an answer to invoke ID {id:#x}, asked was {asked:#x}");
                    violations.push(Violation { requirement: "ADS-5", what });
                }
                received.drain(..len);
                if asked.elapsed() >= self.target.timeout {
                    return Err(ExchangeError::Silence(self.target.timeout));
                }
                continue;
            }
            let left = self.target.timeout.saturating_sub(asked.elapsed());
            if left.is_zero() {
                return Err(ExchangeError::Silence(self.target.timeout));
            }
            match wire.receive(&mut chunk, left) {
                Ok(0) => return Err(ExchangeError::Closed),
                Ok(len) => {
                    let came = chunk.get(..len).unwrap_or_default();
                    received.extend(came);
                    if let Some(capture) = &mut self.capture {
                        capture.received(came);
                    }
                }
                Err(error)
                    if matches!(
                        error.kind(),
                        io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut
                    ) =>
                {
                    return Err(ExchangeError::Silence(self.target.timeout));
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(ExchangeError::io(error)),
            }
        }
    }
}

pub(crate) fn frame(header: AmsHeader, call: &Call<'_>) -> Result<Vec<u8>, ExchangeError> {
    whole(header, &call.encode_to_vec().map_err(ExchangeError::Unsendable)?)
}

fn whole(header: AmsHeader, payload: &[u8]) -> Result<Vec<u8>, ExchangeError> {
    FrameRef::new(header, payload)
        .and_then(|frame| frame.encode_to_vec())
        .map_err(ExchangeError::Unsendable)
}

/// What a frame with this header and data answers.
pub(crate) fn answer(
    sent: AmsHeader,
    header: AmsHeader,
    payload: &[u8],
) -> Result<AdsReply, ExchangeError> {
    if !header.error.is_ok() && payload.is_empty() {
        return Ok(AdsReply { ams_error: header.error, result: AdsError::NO_ERROR, data: None });
    }
    // Whatever else is asked has a result in its reply as a Write has, and maybe more.
    let service = service_of(sent.command).unwrap_or(Service::Write);
    let (result, data) = decode_reply(service, payload).map_err(ExchangeError::Malformed)?;
    Ok(AdsReply { ams_error: header.error, result, data: data.map(<[u8]>::to_vec) })
}
