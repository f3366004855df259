//! The typed connection of a command to a CNC, through the gate.

mod error;

use std::io::{self, Write as _};
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::ads::{DeviceInfoReply, DeviceStateReply};
use ads_cnc::operation::{
    Call, CountObjects, CountVariables, Function, ObjectList, Operation, Request, Task,
};
use ads_cnc::{Kind, address::Channel};

use crate::client::{Client, Inquiry, InquiryReply, Tap, Target};
use crate::deadline::Deadline;
use crate::exchange::{Exchange, ExchangeError, is_of_ads, other_invoke_id};
use crate::gate::Gate;
use crate::net;
use crate::profile::{Claim, Profile};
use crate::simulator::{LocalCnc, NET_ID, Responder, Server};

pub use error::ToolError;

/// A connection to a CNC (a device or a simulated CNC), or a dry run without a connection.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::{ReadByName, WriteByName};
/// use ads_cnc_conformance::simulator::Cnc;
/// use ads_cnc_conformance::gate::Gate;
/// use ads_cnc_conformance::session::{Session, ToolError};
///
/// let mut session = Session::simulated(Cnc::with_default_model()?, Gate::queries())?;
/// let channel = Channel::new(1)?;
/// let value = session.call(&ReadByName::new(channel, "V.E.Testvar")?)?;
/// assert_eq!(value.bytes[..4], [123, 0, 0, 0]);
///
/// let write = WriteByName::new(channel, "V.E.Testvar[0]", 1_i32)?;
/// assert!(matches!(session.call(&write), Err(ToolError::NotPermitted(_))));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Session {
    // Fields are dropped in order: the client must be dropped before the server, which waits for
    // the threads of its connections.
    client: Client,
    simulated: Option<Server>,
    reply: Vec<u8>,
    answered: bool,
    deadline: Option<Deadline>,
    /// Prints a request in a dry run.
    print: fn(&Exchange),
}

impl Session {
    /// Connects to a target.
    ///
    /// # Errors
    /// If the connection fails, or the gate must not be used for this target.
    pub fn connect(target: Target, gate: Gate) -> Result<Self, ToolError> {
        match Client::connect(target, gate) {
            Ok(client) => Ok(Self::over(client, None)),
            Err(error) => Err(ToolError::unreachable(&target, &error)),
        }
    }

    /// Creates a session that prints requests instead of sending them. Writes that the gate allows
    /// seem to succeed; allowed calls of functions whose reply has data fail with
    /// [`ToolError::NotSent`].
    ///
    /// # Errors
    /// If the gate allows malformed requests and the target is not at a loopback address, or the
    /// gate is for the address of a simulated CNC other than the target.
    pub fn dry(target: Target, gate: Gate, print: fn(&Exchange)) -> Result<Self, ToolError> {
        let client = Client::dry(target, gate);
        let client = client.map_err(|error| ToolError::Usage(error.to_string()))?;
        Ok(Self { print, ..Self::over(client, None) })
    }

    /// Starts a simulated CNC in this process, on loopback, and connects to it.
    ///
    /// # Errors
    /// If the system cannot provide a socket or a thread, or the gate is for another address.
    pub fn simulated(cnc: impl Responder + 'static, gate: Gate) -> Result<Self, ToolError> {
        let failed = |error: io::Error| {
            ToolError::Internal(format!("the simulated CNC could not be started: {error}"))
        };
        let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).map_err(failed)?;
        let server = Server::start(listener, Arc::new(cnc)).map_err(failed)?;
        // The timeout is longer than for a device: a busy machine may delay a reply of the
        // simulated CNC, and such a delay is not a fault of the CNC.
        let target =
            Target { timeout: SIMULATED_TIMEOUT, ..Target::local(server.addr(), server.net_id()) };
        let client = Client::connect(target, gate).map_err(failed)?;
        Ok(Self::over(client, Some(server)))
    }

    /// Connects to a simulated CNC of this process without a socket. The clock of the CNC must be
    /// stopped.
    ///
    /// # Errors
    /// If the gate is for the address of another simulated CNC.
    pub(crate) fn in_process(cnc: Arc<dyn Responder>, gate: Gate) -> Result<Self, ToolError> {
        let target = Target::local(IN_PROCESS, NET_ID);
        let client = Client::in_process(target, gate, LocalCnc::new(cnc, NET_ID));
        let client = client.map_err(|error| ToolError::unreachable(&target, &error))?;
        Ok(Self::over(client, None))
    }

    /// Connects to a simulated CNC of this process without a socket, with a gate like that of
    /// [`Gate::of_server`]. The clock of the CNC must be stopped.
    ///
    /// # Errors
    /// No error occurs: the gate is made for this address.
    pub fn in_process_to_try(cnc: Arc<dyn Responder>) -> Result<Self, ToolError> {
        Self::in_process(cnc, Gate::of_address(IN_PROCESS))
    }

    /// Starts a simulated CNC in this process, and connects to it with the gate of
    /// [`Gate::of_server`].
    ///
    /// # Errors
    /// Those of [`simulated`](Self::simulated) and [`with_gate`](Self::with_gate).
    pub fn simulated_to_try(cnc: impl Responder + 'static) -> Result<Self, ToolError> {
        let session = Self::simulated(cnc, Gate::queries())?;
        match session.simulated.as_ref().map(Gate::of_server) {
            Some(gate) => session.with_gate(gate),
            None => Ok(session),
        }
    }

    /// Like [`dry`](Self::dry), with the NetId of a simulated CNC, which is not started.
    ///
    /// # Errors
    /// Those of [`dry`](Self::dry).
    pub fn dry_simulated(gate: Gate, print: fn(&Exchange)) -> Result<Self, ToolError> {
        Self::dry(Target::local(SocketAddr::from(([127, 0, 0, 1], 0)), NET_ID), gate, print)
    }

    /// Closes the connection, and connects to the same simulated CNC with another gate. The session
    /// must have started the simulated CNC: for a device, only the file of `--allow-write` can
    /// allow more.
    ///
    /// # Errors
    /// [`ToolError::Usage`] for any other session, and those of [`connect`](Self::connect).
    pub fn with_gate(self, gate: Gate) -> Result<Self, ToolError> {
        let Self { client, simulated: Some(server), deadline, print, .. } = self else {
            return Err(ToolError::Usage("only a simulated CNC can have another gate".to_owned()));
        };
        let target = *client.target();
        let mut before = client;
        let capture = before.take_capture();
        drop(before);
        let client = Client::connect(target, gate);
        let client = client.map_err(|error| ToolError::unreachable(&target, &error))?;
        let session = Self { deadline, print, ..Self::over(client, Some(server)) };
        Ok(match capture {
            Some(capture) => session.with_capture(capture),
            None => session,
        })
    }

    fn over(client: Client, simulated: Option<Server>) -> Self {
        Self {
            client,
            simulated,
            reply: Vec::new(),
            answered: false,
            deadline: None,
            print: |_| {},
        }
    }

    /// From now on, captures the frames sent and the bytes received.
    #[must_use]
    pub fn with_capture(self, capture: impl Into<Box<dyn Tap>>) -> Self {
        Self { client: self.client.with_capture(capture), ..self }
    }

    /// Sets a deadline after which [`call`](Self::call) and [`request`](Self::request) fail with
    /// [`ToolError::Enough`].
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { deadline: Some(deadline), ..self }
    }

    /// Calls a function and decodes its reply.
    ///
    /// # Errors
    /// The reason why the request was not sent, the ADS error of the reply, or the reason why there
    /// is no valid reply.
    pub fn call<'s, O: Operation>(&'s mut self, operation: &O) -> Result<O::Reply<'s>, ToolError> {
        let mut data = vec![0; operation.encoded_len()];
        let call = operation.call(&mut data).map_err(ToolError::Unsendable)?;
        self.reply = self.exchange(O::FUNCTION, &call)?;
        operation.decode_reply(&self.reply).map_err(ToolError::Reply)
    }

    /// Sends a request to `task`, and returns the data of the reply as received. The caller names
    /// the task, because SDA and GEO share the functions of classes.
    ///
    /// # Errors
    /// Those of [`call`](Self::call).
    pub fn request<'r>(
        &mut self,
        task: Task,
        request: impl Into<Request<'r>>,
    ) -> Result<Vec<u8>, ToolError> {
        let request = request.into();
        let mut data = vec![0; request.encoded_len()];
        self.exchange(request.function(), &encode(task, &request, &mut data)?)
    }

    fn exchange(&mut self, function: Function, call: &Call<'_>) -> Result<Vec<u8>, ToolError> {
        let exchange = self.send(call)?;
        self.reply(function, exchange)
    }

    fn send(&mut self, call: &Call<'_>) -> Result<Exchange, ToolError> {
        if let Some(deadline) = self.deadline.filter(Deadline::is_over) {
            return Err(ToolError::Enough(deadline.to_string()));
        }
        let exchange = self.client.call(call);
        if self.client.is_dry() {
            (self.print)(&exchange);
        }
        Ok(exchange)
    }

    fn reply(&mut self, function: Function, exchange: Exchange) -> Result<Vec<u8>, ToolError> {
        self.answered |= is_of_ads(&exchange.sent, &exchange.received);
        match exchange.outcome {
            Ok((answer, _)) => {
                self.answered = true;
                if let Some(other) = other_invoke_id(&exchange.sent, &exchange.received) {
                    return Err(ToolError::Frame(other.what));
                }
                if !answer.ams_error.is_ok() {
                    return Err(ToolError::ams(
                        self.client.target(),
                        exchange.port,
                        answer.ams_error,
                    ));
                }
                if !answer.result.is_ok() {
                    return Err(ToolError::Ads { function, error: answer.result });
                }
                Ok(answer.data.unwrap_or_default())
            }
            // A dry run can continue after a write, whose reply has no data.
            Err(ExchangeError::NotSent) if function.spec().reply.is_none() => Ok(Vec::new()),
            Err(fault) => Err(ToolError::fault(&self.client, fault, self.answered)),
        }
    }

    /// Checks that the device replies to a query: the number of objects of the platform or, if the
    /// profile does not claim this function, the number of V.E variables of the first channel. A
    /// device that does not reply cannot be judged.
    ///
    /// # Errors
    /// If the request is not sent, or there is no reply. An ADS error is a reply, and so is an AMS
    /// frame that violates a rule of AMS/TCP. An AMS error alone is not.
    pub(crate) fn check_reachable(&mut self, profile: &Profile) -> Result<(), ToolError> {
        let request: Request<'_> = match profile.claims(Function::CountObjects) {
            Claim::No => {
                let first = profile.channels.first().copied().unwrap_or(1);
                let channel =
                    Channel::new(first).map_err(|error| ToolError::Internal(error.to_string()))?;
                CountVariables::new(channel, Kind::V_E).into()
            }
            _ => CountObjects::new(ObjectList::PLATFORM).into(),
        };
        let mut data = vec![0; request.encoded_len()];
        let call = request.encode(&mut data).map_err(ToolError::Unsendable)?;
        let exchange = self.send(&call)?;
        let is_broken =
            !exchange.violations.is_empty() && is_of_ads(&exchange.sent, &exchange.received);
        match self.reply(request.function(), exchange) {
            Err(ToolError::Ads { .. }) => Ok(()),
            Err(_) if is_broken => Ok(()),
            reply => reply.map(drop),
        }
    }

    /// Name and version of the device, requested from a task.
    ///
    /// ```
    /// use ads_cnc::operation::Task;
    /// use ads_cnc_conformance::simulator::Cnc;
    /// use ads_cnc_conformance::gate::Gate;
    /// use ads_cnc_conformance::session::Session;
    ///
    /// let mut session = Session::simulated(Cnc::with_default_model()?, Gate::queries())?;
    /// assert_eq!(session.device_info(Task::Com)?.name(), "ads-cnc serve");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the request is not sent, or the CNC does not send a valid reply or rejects the command: a
    /// CNC need not support it.
    pub fn device_info(&mut self, task: Task) -> Result<DeviceInfoReply, ToolError> {
        self.inquire(task)
    }

    /// The ADS state of a task.
    ///
    /// ```
    /// use ads_cnc::ads::AdsState;
    /// use ads_cnc::operation::Task;
    /// use ads_cnc_conformance::simulator::Cnc;
    /// use ads_cnc_conformance::gate::Gate;
    /// use ads_cnc_conformance::session::Session;
    ///
    /// let mut session = Session::simulated(Cnc::with_default_model()?, Gate::queries())?;
    /// assert_eq!(session.device_state(Task::Sda)?.ads_state, AdsState::RUN);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the request is not sent, or the CNC does not send a valid reply or rejects the command: a
    /// CNC need not support it.
    pub fn device_state(&mut self, task: Task) -> Result<DeviceStateReply, ToolError> {
        self.inquire(task)
    }

    fn inquire<R: Inquiry>(&mut self, task: Task) -> Result<R, ToolError> {
        let inquired = self.client.inquire::<R>(task.port());
        if self.client.is_dry() {
            // A closed stdout is not an error.
            let _unread = writeln!(io::stdout(), "would be sent\n  {} ({})", inquired, R::CLAUSE);
        }
        self.answered |= is_of_ads(&inquired.sent, &inquired.received);
        match inquired.outcome {
            Ok(reply) => {
                self.answered = true;
                if let Some(other) = other_invoke_id(&inquired.sent, &inquired.received) {
                    return Err(ToolError::Frame(other.what));
                }
                match reply {
                    InquiryReply::Reply(reply) => Ok(reply),
                    InquiryReply::Rejected(error) => {
                        Err(ToolError::Device { command: R::NAME, error })
                    }
                    InquiryReply::Ams(error) => {
                        Err(ToolError::ams(self.client.target(), inquired.port, error))
                    }
                }
            }
            Err(fault) => Err(ToolError::fault(&self.client, fault, self.answered)),
        }
    }

    /// Checks whether the gate allows a request now. Nothing is sent. A tool calls this function
    /// before it begins a sequence of requests that the gate might interrupt.
    ///
    /// # Errors
    /// [`ToolError::NotPermitted`], [`ToolError::Unsendable`].
    pub fn check<'r>(&self, task: Task, request: impl Into<Request<'r>>) -> Result<(), ToolError> {
        let request = request.into();
        let mut data = vec![0; request.encoded_len()];
        let checked = self.client.check(&encode(task, &request, &mut data)?);
        checked.map_err(|fault| ToolError::fault(&self.client, fault, self.answered))
    }

    /// Whether this session has started a simulated CNC with a socket.
    pub const fn is_simulated(&self) -> bool {
        self.simulated.is_some()
    }

    /// Whether this is a dry run.
    pub const fn is_dry(&self) -> bool {
        self.client.is_dry()
    }

    pub const fn target(&self) -> &Target {
        self.client.target()
    }

    /// The client, for untyped requests, and the simulated CNC if the session has started one. The
    /// simulated CNC must outlive the client.
    pub fn into_parts(self) -> (Client, Option<Server>) {
        (self.client, self.simulated)
    }
}

fn encode<'d>(
    task: Task,
    request: &Request<'_>,
    data: &'d mut [u8],
) -> Result<Call<'d>, ToolError> {
    let call = request.encode(data).map_err(ToolError::Unsendable)?;
    Ok(Call { port: task.port(), ..call })
}

/// The placeholder address of a simulated CNC that has no socket.
const IN_PROCESS: SocketAddr = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 0);

/// Timeout for a connection to, and a reply of, a simulated CNC that the session has started.
const SIMULATED_TIMEOUT: Duration = Duration::from_secs(6);

/// Default timeout for a connection to a device and for its replies; in a run, also for the answers
/// of a testee.
pub const TIMEOUT: Duration = Duration::from_secs(2);
