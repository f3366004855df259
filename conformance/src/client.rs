//! An AMS/TCP client of a target. It returns the bytes of each request and its reply, checks the
//! headers of the reply, and can capture the bytes sent and received.

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
use ads_cnc::operation::{AdsService, Call, Task};
use ads_cnc_vectors::ids::*;

use crate::ads_service::{decode_reply, service_of};
use crate::exchange::{AdsReply, Exchange, ExchangeError, Violation, incomplete_frame};
use crate::gate::{Gate, Permit};
use crate::net::{LocalPeers, Wire};
use crate::process::progress;
use crate::text::{Moment, hex, plural};

pub use inquiry::{Inquired, Inquiry, InquiryReply};
pub use tap::Tap;
pub use target::Target;
pub(crate) use target::net_id_of;

/// The first of the 16 AMS ports from which a [`Client`] sends its requests. The client of
/// `client_suite` uses only this port.
pub(crate) const SOURCE_PORT: AmsPort = AmsPort(0x8000);

/// A connection to a target, or a dry run without a connection. The [`Gate`] decides which frames
/// may be sent.
#[derive(Debug)]
pub struct Client {
    target: Target,
    source: AmsNetId,
    gate: Gate,
    wire: Option<Wire>,
    connect_method: ConnectMethod,
    capture: Option<Box<dyn Tap>>,
    dry: bool,
    last: Option<Instant>,
    invoke_id: u32,
    piece: Option<usize>,
}

/// How to open the first connection, and a new connection after a connection was closed.
#[derive(Clone, Debug)]
enum ConnectMethod {
    /// Over TCP, to the target's address.
    Tcp,
    /// To a CNC in this process, without a socket.
    InProcess(Arc<dyn LocalPeers>),
}

/// The pause after each piece of a frame that is sent in pieces.
const PAUSE: Duration = Duration::from_millis(1);

/// Maximum number of frames for each request that are reported as separate violations because they
/// are not taken for the reply, due to their invoke IDs. Further ones are only counted.
const STRAYS_MAX: u64 = 3;

/// Maximum time to wait for the reply after a second frame that is not the reply.
const AFTER_STRAY: Duration = Duration::from_millis(250);

/// The number before the first invoke ID. None of its bytes is 0, so that the client detects a
/// device that returns 0 for some bytes of an ID.
const FIRST_INVOKE_ID: u32 = 0x5403_0201;

impl Client {
    /// Connects to a target. A gate that allows malformed requests is accepted only for a loopback
    /// address.
    ///
    /// # Errors
    /// If the connection cannot be opened, the gate allows malformed requests although the address
    /// is not a loopback address, or the gate is for the address of another simulated CNC.
    pub fn connect(target: Target, gate: Gate) -> io::Result<Self> {
        Self::connected(target, gate, ConnectMethod::Tcp)
    }

    /// Connects to a CNC in this process without a socket. The clock of the CNC must be stopped: if
    /// the CNC does not reply, the connection advances the clock by the timeout instead of waiting.
    ///
    /// # Errors
    /// If the gate allows malformed requests and the address is not a loopback address, or the gate
    /// is for the address of another simulated CNC.
    pub fn in_process(target: Target, gate: Gate, cnc: Arc<dyn LocalPeers>) -> io::Result<Self> {
        Self::connected(target, gate, ConnectMethod::InProcess(cnc))
    }

    fn connected(target: Target, gate: Gate, connect_method: ConnectMethod) -> io::Result<Self> {
        let mut client = Self { connect_method, ..Self::unconnected(target, gate)? };
        let wire = client.open_wire()?;
        client.source = target.source.unwrap_or(net_id_of(wire.local().ip()));
        client.wire = Some(wire);
        Ok(client)
    }

    /// Creates a client for a dry run: it never connects, and sends no request, but the gate checks
    /// each request.
    ///
    /// # Errors
    /// If the gate allows malformed requests and the address is not a loopback address, or the gate
    /// is for the address of a simulated CNC other than the target.
    pub fn dry(target: Target, gate: Gate) -> io::Result<Self> {
        Ok(Self { dry: true, ..Self::unconnected(target, gate)? })
    }

    fn open_wire(&self) -> io::Result<Wire> {
        match &self.connect_method {
            ConnectMethod::Tcp => Wire::connect(self.target.addr, self.target.timeout),
            ConnectMethod::InProcess(cnc) => Ok(Wire::over(cnc.connect())),
        }
    }

    fn unconnected(target: Target, gate: Gate) -> io::Result<Self> {
        let gate = gate.to_address(target.addr.ip());
        if gate.lets_malformed_pass() && !target.addr.ip().to_canonical().is_loopback() {
            let why = "malformed requests can be sent only to a CNC on this machine";
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, why));
        }
        if gate.simulated().is_some_and(|only| only != target.addr) {
            let why = "writes of all kinds can be sent only to the simulated CNC";
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, why));
        }
        Ok(Self {
            target,
            source: target.source.unwrap_or(net_id_of(target.addr.ip())),
            gate,
            wire: None,
            connect_method: ConnectMethod::Tcp,
            capture: None,
            dry: false,
            last: None,
            invoke_id: FIRST_INVOKE_ID,
            piece: None,
        })
    }

    /// From now on, captures the frames sent and the bytes received.
    #[must_use]
    pub fn with_capture(mut self, capture: impl Into<Box<dyn Tap>>) -> Self {
        let mut capture = capture.into();
        if let Some(wire) = &self.wire {
            capture.opened(wire.local(), self.target.addr);
        }
        self.capture = Some(capture);
        self
    }

    /// Removes and returns the capture, so that another client can continue it.
    pub(crate) fn take_capture(&mut self) -> Option<Box<dyn Tap>> {
        let mut capture = self.capture.take()?;
        capture.closed();
        Some(capture)
    }

    /// Ends the capture, if any.
    ///
    /// # Errors
    /// The first error of the system while the capture was written.
    pub fn end_capture(&mut self) -> io::Result<()> {
        self.capture.take().map_or(Ok(()), Tap::finish)
    }

    /// From now on, sends frames in pieces of at most this many bytes, or whole if `None`.
    pub(crate) const fn set_piece(&mut self, piece: Option<usize>) {
        self.piece = piece;
    }

    /// Waits for this time. A client [in process](Self::in_process), without a socket, advances the
    /// CNC's clock instead of waiting.
    pub(crate) fn wait(&self, time: Duration) {
        match &self.connect_method {
            ConnectMethod::Tcp => thread::sleep(time),
            ConnectMethod::InProcess(cnc) => cnc.pass(time),
        }
    }

    /// The gate, which decides which frames this client may send.
    pub const fn gate(&self) -> &Gate {
        &self.gate
    }

    pub const fn target(&self) -> &Target {
        &self.target
    }

    /// The NetId from which requests are sent.
    pub const fn source(&self) -> AmsNetId {
        self.source
    }

    /// Whether this is a dry run.
    pub const fn is_dry(&self) -> bool {
        self.dry
    }

    /// Checks whether the gate would allow a call now. Nothing is sent.
    ///
    /// # Errors
    /// [`ExchangeError::NotPermitted`] or [`ExchangeError::Unsendable`].
    pub fn check(&self, call: &Call<'_>) -> Result<(), ExchangeError> {
        let bytes = frame(self.header(call.port, call.service.command()), call)?;
        self.gate.check(&bytes, Moment::now())?;
        Ok(())
    }

    /// Sends a call and waits for its reply. Sends nothing for example if the gate rejects the call
    /// or this is a dry run.
    pub fn call(&mut self, call: &Call<'_>) -> Exchange {
        let mut exchange = Exchange::new(call);
        match self.sent(call, &mut exchange) {
            Ok(header) => self.judge(&header, &mut exchange),
            Err(fault) => exchange.outcome = Err(fault),
        }
        tracing::debug!(
            sent = %hex::spaced(&exchange.sent),
            received = %hex::spaced(&exchange.received),
            "{exchange}: {}",
            exchange.result()
        );
        exchange
    }

    /// Sends a call, and stores the result in `exchange`. Returns the header of the frame, or the
    /// reason why the frame was not to be sent.
    fn sent(
        &mut self,
        call: &Call<'_>,
        exchange: &mut Exchange,
    ) -> Result<AmsHeader, ExchangeError> {
        let header = self.next_header(call.port, call.service.command());
        let bytes = frame(header, call)?;
        let Exchange { sent, received, violations, .. } = exchange;
        let came = self.deliver(&bytes, header, sent, received, violations)?;
        progress::requests(1);
        exchange.outcome = came.and_then(|got| {
            let data = exchange.received.get(FrameRef::HEADERS_LEN..).unwrap_or_default();
            answer(header, got, data).map(|answer| (answer, got))
        });
        // A handle or an address from a reply with another invoke ID must not permit a write.
        let reply = exchange.outcome.as_ref().ok();
        let reply = reply.filter(|(_, got)| got.invoke_id == header.invoke_id);
        if let Some(data) = reply.and_then(|(reply, _)| reply.success()) {
            self.gate.observe(call, data);
        }
        Ok(header)
    }

    /// Sends a frame if the gate allows it and this is not a dry run, and waits for its reply. If a
    /// connection was open or could be opened, `sent` then contains the frame, and `received` the
    /// reply or the bytes that arrived instead. The outer error is the reason why the frame was not
    /// to be sent.
    fn deliver(
        &mut self,
        bytes: &[u8],
        header: AmsHeader,
        sent: &mut Vec<u8>,
        received: &mut Vec<u8>,
        violations: &mut Vec<Violation>,
    ) -> Result<Result<AmsHeader, ExchangeError>, ExchangeError> {
        let permit = self.gate.check(bytes, Moment::now())?;
        if self.dry {
            return Err(ExchangeError::NotSent);
        }
        let mut strays = 0;
        let mut came = self.exchange(permit, header, received, violations, &mut strays);
        if matches!(came, Err(ExchangeError::NotPermitted(_))) {
            return came.map(Ok);
        }
        if !matches!(came, Err(ExchangeError::Disconnected(_))) {
            sent.extend(bytes);
        }
        let lost = matches!(came, Err(ExchangeError::Closed | ExchangeError::Io(_)));
        if lost && permit.is_repeatable() {
            // The CNC may have closed an idle connection. Whether it executed a write before that
            // is unknown, so a write is not sent twice.
            received.clear();
            self.disconnect();
            came = self.exchange(permit, header, received, violations, &mut strays);
        }
        let is_incomplete = matches!(
            came,
            Err(ExchangeError::Silence(_) | ExchangeError::Closed | ExchangeError::Io(_))
        );
        if is_incomplete && let Some(whole) = incomplete_frame(received) {
            let len = plural(received.len(), "byte");
            let what = format!("{len} of a frame of {}", plural(whole, "byte"));
            violations.push(Violation { requirement: ADS_5, what });
        }
        if let Some(more) = strays.checked_sub(STRAYS_MAX).filter(|more| *more > 0) {
            let what = format!(
                "{} to other invoke IDs; {STRAYS_MAX} are shown",
                plural(more, "more reply")
            );
            violations.push(Violation { requirement: ADS_5, what });
        }
        if let Ok(reply) = &came
            && is_of_router(reply.error, header.target.port)
        {
            // Another CNC may answer after the router has connected again.
            self.gate.forget();
        }
        Ok(came)
    }

    /// The header of the next request, with a new invoke ID.
    fn next_header(&mut self, port: AmsPort, command: Command) -> AmsHeader {
        self.invoke_id = self.invoke_id.wrapping_add(1);
        self.header(port, command)
    }

    fn header(&self, port: AmsPort, command: Command) -> AmsHeader {
        let low = u16::try_from(self.invoke_id & 0xF).unwrap_or_default();
        let target = AmsAddr { net_id: self.target.net_id, port };
        // The source port changes, to check that a reply is addressed to the source of its request.
        let source = AmsAddr { net_id: self.source, port: AmsPort(SOURCE_PORT.0 | low) };
        AmsHeader::request(target, source, command, self.invoke_id)
    }

    /// Closes the connection. The gate forgets the observations that allow writes, because another
    /// CNC may answer on the next connection, or the same CNC after a restart.
    fn disconnect(&mut self) {
        self.wire = None;
        if let Some(capture) = &mut self.capture {
            capture.closed();
        }
        self.gate.forget();
    }

    /// Waits until the minimum time between requests has passed.
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
                let wire = self.open_wire().map_err(ExchangeError::disconnected)?;
                if let Some(capture) = &mut self.capture {
                    capture.opened(wire.local(), self.target.addr);
                }
                wire
            }
        };
        let wire = self.wire.insert(wire);
        // The file for `--allow-write` may have expired while the client waited for the pace or the
        // connection.
        let permit = if permit.is_repeatable() {
            permit
        } else {
            self.gate.check(permit.frame(), Moment::now())?
        };
        let timeout = self.target.timeout;
        let sent_all = match self.piece {
            Some(piece) => wire.send_in_pieces(permit, piece, PAUSE, timeout),
            None => wire.send(permit, timeout),
        };
        if let Err(error) = sent_all {
            // The device must not take the start of the next frame for the rest of this one.
            self.disconnect();
            return Err(of_wire(error, timeout));
        }
        if let Some(capture) = &mut self.capture {
            capture.sent(permit.frame());
        }
        let (started, mut timeout) = (Instant::now(), timeout);
        let mut chunk = [0; 4096];
        loop {
            let split = FrameRef::split(received, u32::MAX).map_err(ExchangeError::Malformed)?;
            if let Some((frame, len)) = split {
                let header = frame.header();
                let (id, asked_id) = (header.invoke_id, sent.invoke_id);
                let is_other = id != asked_id;
                if !is_other || is_reply(&sent, &header) {
                    if is_other {
                        violations.push(Violation::of_invoke_id(id, asked_id));
                    }
                    let more = received.get(len..).unwrap_or_default();
                    if !more.is_empty() {
                        let what =
                            format!("{} after the reply", plural(more.len(), "unexpected byte"));
                        violations.push(Violation { requirement: ADS_5, what });
                        // If these bytes are not whole frames, the start of the next reply is
                        // unknown.
                        if !are_frames(more) {
                            self.disconnect();
                        }
                    }
                    received.truncate(len);
                    return Ok(header);
                }
                *strays = strays.saturating_add(1);
                if *strays <= STRAYS_MAX {
                    violations.push(Violation::of_invoke_id(id, asked_id));
                }
                received.drain(..len);
                // The first such frame may be a late reply. After the second, the client waits for
                // at most `AFTER_STRAY`.
                if *strays > 1 {
                    timeout = timeout.min(started.elapsed().saturating_add(AFTER_STRAY));
                }
                if started.elapsed() >= timeout {
                    return Err(ExchangeError::Silence(timeout));
                }
                continue;
            }
            let left = timeout.saturating_sub(started.elapsed());
            if left.is_zero() {
                return Err(ExchangeError::Silence(timeout));
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
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(of_wire(error, timeout)),
            }
        }
    }
}

/// The error of sending or receiving within `timeout`.
fn of_wire(error: io::Error, timeout: Duration) -> ExchangeError {
    match error.kind() {
        io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => ExchangeError::Silence(timeout),
        _ => ExchangeError::io(error),
    }
}

/// Whether an AMS router returned the error in reply to a request at this port, because it does not
/// reach the CNC, for example. The errors of ADS devices are 0x700 or higher. A CNC may have no
/// task at the port of GEO, where the gate observes nothing.
fn is_of_router(error: AdsError, port: AmsPort) -> bool {
    matches!(error.0, 1..0x700)
        && Task::from_port(port).is_some()
        && (error, port) != (AdsError::TARGET_PORT_NOT_FOUND, AmsPort::GEO)
}

/// Whether the bytes are whole frames.
fn are_frames(mut bytes: &[u8]) -> bool {
    while let Ok(Some((_, len))) = FrameRef::split(bytes, u32::MAX) {
        bytes = bytes.get(len..).unwrap_or_default();
    }
    bytes.is_empty()
}

/// Whether a frame that has a wrong invoke ID and the header `got` is taken for the reply to the
/// request with the header `sent`. A late reply to one of the 15 previous requests has another
/// target port, and an invoke ID that this client has sent.
fn is_reply(sent: &AmsHeader, got: &AmsHeader) -> bool {
    let has_addresses = (got.target, got.source) == (sent.source, sent.target);
    let was_sent = FIRST_INVOKE_ID < got.invoke_id && got.invoke_id < sent.invoke_id;
    got.command == sent.command && (has_addresses || !was_sent)
}

pub(crate) fn frame(header: AmsHeader, call: &Call<'_>) -> Result<Vec<u8>, ExchangeError> {
    whole(header, &call.encode_to_vec().map_err(ExchangeError::Unsendable)?)
}

fn whole(header: AmsHeader, payload: &[u8]) -> Result<Vec<u8>, ExchangeError> {
    FrameRef::new(header, payload)
        .and_then(|frame| frame.encode_to_vec())
        .map_err(ExchangeError::Unsendable)
}

/// Decodes the reply with this header and data to a request with the header `sent`.
pub(crate) fn answer(
    sent: AmsHeader,
    header: AmsHeader,
    payload: &[u8],
) -> Result<AdsReply, ExchangeError> {
    if !header.error.is_ok() && payload.is_empty() {
        return Ok(AdsReply { ams_error: header.error, result: AdsError::NO_ERROR, data: None });
    }
    // A reply to a command that is not a service is decoded like a reply to a Write: a result
    // without data.
    let service = service_of(sent.command).unwrap_or(AdsService::Write);
    let (result, data) = decode_reply(service, payload).map_err(ExchangeError::Malformed)?;
    Ok(AdsReply { ams_error: header.error, result, data: data.map(<[u8]>::to_vec) })
}
