//! The host of external services.

use super::value::{ServiceText, not_zero};
use super::{ServiceId, ServiceVariable};
use crate::error::Error;
use crate::text::CncStr;

/// A host of one or more services on the Service Interface of a channel.
///
/// The host reads REQUEST_STATE. If the state is not 0, it reads UUID; if the UUID is that of one
/// of its services, it reads REQUEST. It then reads the three variables again, because the NC
/// program may have called another service between two reads. If the values are unchanged, the host
/// returns the request in [`HostStep::Serve`] (SVC-2). After a call of [`answer`](Self::answer),
/// the host
/// 1. reads the three variables once more, and drops the answer if a value has changed, for example
///    because the program gave up or called another service, or the CNC was reset,
/// 2. writes RESPONSE,
/// 3. writes 0 to REQUEST_STATE, because it is not documented how and when a CNC does so (SVC-4),
/// 4. writes RESPONSE_STATE, for which the program waits (SVC-5, SVC-6). This write is last,
///    because any write of REQUEST_STATE is assumed to reset RESPONSE_STATE (SVC-3).
///
/// The order of the last two writes and the repeated reads are assumed. Between the last read and the
/// writes, the program may still give up and make another request: it may then take the answer to
/// the first request for the answer to the second. The host does not distinguish two requests with
/// the same UUID, text and state.
///
/// # Failed steps
/// [`step`](Self::step) returns the same step until the caller reports its result with
/// [`read`](Self::read), [`written`](Self::written), [`failed`](Self::failed),
/// [`answer`](Self::answer) or [`poll`](Self::poll), or calls [`restart`](Self::restart). A failed
/// read can be repeated. Report a failed write with [`failed`](Self::failed). The value may have
/// been written and the program may have continued, so the host then reads one or more of the
/// variables before it writes again.
///
/// The host does not detect the following: two hosts share a channel, and a write of RESPONSE_STATE
/// by the first host is reported as failed but took effect. While the first host reads, the program
/// calls a service of the second host, which answers, and then the same service of the first host
/// as before. The first host then writes the state again, and may end a request that it has not
/// served. To avoid this, use one host for all services of a channel.
///
/// After a reset of the CNC or on a new connection, call [`restart`](Self::restart).
///
/// Manual: `service-en` and `service-de` 1.03, section 2.
///
/// ```
/// use ads_cnc::CncStr;
/// use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable::*};
///
/// let ids = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?];
/// let mut host = Host::new(&ids);
/// for _ in 0..2 {
///     assert_eq!(host.step(), HostStep::Read(RequestState));
///     host.read(&[1, 0, 0, 0])?;
///     assert_eq!(host.step(), HostStep::Read(Uuid));
///     host.read(b"560aacbf-6335-44a9-895a-8b27f3ed5e47\0")?;
///     assert_eq!(host.step(), HostStep::Read(Request));
///     host.read(b"3\0")?;
/// }
/// let HostStep::Serve { request, .. } = host.step() else { panic!() };
/// assert_eq!(request, "3");
///
/// // A state of 0 is rejected before anything is written: the program would wait forever.
/// assert!(host.answer(CncStr::new("1.732051")?, 0).is_err());
/// host.answer(CncStr::new("1.732051")?, 1)?;
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Host<'s> {
    services: &'s [ServiceId],
    phase: Phase,
    /// The request: the index of the service, the text and the state.
    service: usize,
    request: ServiceText,
    request_state: u32,
    /// The answer: the text and the state. While a request has no answer, the state is 0.
    response: ServiceText,
    response_state: [u8; 4],
    outcome: Option<Outcome>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Idle,
    // Reads the variables until they contain a request to one of the services.
    PollState,
    PollUuid,
    PollRequest,
    // Checks that the request is unchanged, before it is served and before it is answered.
    CheckState,
    CheckUuid,
    CheckRequest,
    Serving,
    /// Writes RESPONSE.
    Respond,
    /// Writes REQUEST_STATE.
    Clear,
    /// Writes RESPONSE_STATE.
    Finish,
    /// The write of REQUEST_STATE failed: reads REQUEST_STATE, to check whether the write took effect.
    LookCleared,
    // The write of RESPONSE_STATE failed: reads the variables, to check whether the write took effect.
    LookResponseState,
    LookRequestState,
    LookUuid,
}

impl Phase {
    /// The variable to read in this phase; `None` if the host does not read in this phase.
    const fn asks(self) -> Option<ServiceVariable> {
        Some(match self {
            Self::PollState | Self::CheckState | Self::LookCleared | Self::LookRequestState => {
                ServiceVariable::RequestState
            }
            Self::PollUuid | Self::CheckUuid | Self::LookUuid => ServiceVariable::Uuid,
            Self::PollRequest | Self::CheckRequest => ServiceVariable::Request,
            Self::LookResponseState => ServiceVariable::ResponseState,
            Self::Idle | Self::Serving | Self::Respond | Self::Clear | Self::Finish => return None,
        })
    }
}

/// The next step of a host. [`Host`] has an example.
///
/// Manual: `service-en` and `service-de` 1.03, section 2.
///
/// ```
/// use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
///
/// let ids = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?];
/// let mut host = Host::new(&ids);
/// assert_eq!(host.step(), HostStep::Read(ServiceVariable::RequestState));
/// host.read(&[0, 0, 0, 0])?; // no request
/// assert_eq!(host.step(), HostStep::Wait);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HostStep<'a> {
    /// Read this variable and pass its value to [`Host::read`]. If it cannot be read, try again.
    Read(ServiceVariable),
    /// Write this value to the variable, then call [`Host::written`] or [`Host::failed`].
    Write(ServiceVariable, &'a [u8]),
    /// Serve the request, then call [`Host::answer`].
    Serve {
        /// The called service, as passed to [`Host::new`].
        uuid: &'a ServiceId,
        /// The text of the request.
        request: CncStr<'a>,
        /// The request state; not 0.
        request_state: u32,
    },
    /// Wait for some time, then call [`Host::poll`].
    Wait,
}

/// The outcome of an answer, returned by [`Host::outcome`]. The manuals describe only `Answered`;
/// `Abandoned` is assumed.
///
/// ```
/// use ads_cnc::CncStr;
/// use ads_cnc::service::{Host, HostStep, Outcome, ServiceId, ServiceVariable::*};
///
/// let ids = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?];
/// let mut host = Host::new(&ids);
/// while let HostStep::Read(variable) = host.step() {
///     host.read(match variable {
///         Uuid => b"560AACBF-6335-44a9-895A-8B27F3ED5E47\0",
///         RequestState => &[1, 0, 0, 0],
///         _ => b"\0",
///     })?;
/// }
/// host.answer(CncStr::new("too late")?, 1)?;
/// host.read(&[0; 4])?; // REQUEST_STATE: the CNC was reset while the service was working
/// assert_eq!(host.outcome(), Some(Outcome::Abandoned));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// The answer was written.
    Answered,
    /// The variables showed that the program no longer waited for the answer to this request. The
    /// answer was dropped or written in part; after a failed write of RESPONSE_STATE, it may also
    /// have been written completely.
    Abandoned,
}

impl<'s> Host<'s> {
    /// Creates a host of these services. If two services have the same UUID, the first of them is
    /// called.
    pub const fn new(services: &'s [ServiceId]) -> Self {
        Self {
            services,
            phase: Phase::PollState,
            service: 0,
            request: ServiceText::EMPTY,
            request_state: 0,
            response: ServiceText::EMPTY,
            response_state: [0; 4],
            outcome: None,
        }
    }

    /// The next step. Returns the same step until the caller reports the result of the step.
    #[must_use = "the step has to be executed"]
    pub fn step(&self) -> HostStep<'_> {
        if let Some(variable) = self.phase.asks() {
            return HostStep::Read(variable);
        }
        match self.phase {
            Phase::Respond => HostStep::Write(ServiceVariable::Response, self.response.value()),
            Phase::Clear => HostStep::Write(ServiceVariable::RequestState, &[0; 4]),
            Phase::Finish => HostStep::Write(ServiceVariable::ResponseState, &self.response_state),
            Phase::Serving => {
                // The index was found in this list, so it is valid.
                self.services.get(self.service).map_or(HostStep::Wait, |uuid| HostStep::Serve {
                    uuid,
                    request: self.request.text(),
                    request_state: self.request_state,
                })
            }
            _ => HostStep::Wait,
        }
    }

    /// The outcome of the last answer; `None` before the first answer, and while the outcome of an
    /// answer that [`answer`](Self::answer) has accepted is not known.
    pub const fn outcome(&self) -> Option<Outcome> {
        self.outcome
    }

    /// Processes the value that was read. Does nothing if the step is not a read.
    ///
    /// # Errors
    /// - [`Truncated`](crate::ErrorKind::Truncated), [`Trailing`](crate::ErrorKind::Trailing): a state
    ///   that does not have four bytes,
    /// - [`TooLong`](crate::ErrorKind::TooLong): a new request of more than 128 bytes including its
    ///   NUL.
    ///
    /// After an error, a host that looks for a request waits for the next [`poll`](Self::poll); in
    /// any later phase, it reads the same variable again.
    pub fn read(&mut self, value: &[u8]) -> Result<(), Error> {
        let Some(variable) = self.phase.asks() else {
            return Ok(());
        };
        let state = || variable.state(value);
        let request = || ServiceText::decode(value, variable);
        let phase = self.phase;
        if matches!(phase, Phase::PollState | Phase::PollRequest) {
            // A malformed value counts as "no request".
            self.phase = Phase::Idle;
        }
        self.phase = match phase {
            Phase::PollState => {
                self.response_state = [0; 4];
                self.request_state = state()?;
                if self.request_state == 0 { Phase::Idle } else { Phase::PollUuid }
            }
            Phase::PollUuid => match self.service_of(value) {
                Some(service) => {
                    self.service = service;
                    Phase::PollRequest
                }
                None => Phase::Idle,
            },
            Phase::PollRequest => {
                self.request = request()?;
                Phase::CheckState
            }
            Phase::LookCleared if state()? == 0 => Phase::Finish,
            Phase::CheckState | Phase::LookCleared => {
                self.go_on(state()? == self.request_state, Phase::CheckUuid)
            }
            Phase::CheckUuid => self.go_on(self.is_own(value), Phase::CheckRequest),
            Phase::CheckRequest => {
                let next = if self.has_answer() { Phase::Respond } else { Phase::Serving };
                // If the text is too long, `request()` is an error, and the text differs from the
                // request.
                self.go_on(request() == Ok(self.request), next)
            }
            Phase::LookResponseState if state()?.to_le_bytes() == self.response_state => {
                self.end(Outcome::Answered)
            }
            Phase::LookResponseState => self.go_on(state()? == 0, Phase::LookRequestState),
            Phase::LookRequestState => self.go_on(state()? == 0, Phase::LookUuid),
            Phase::LookUuid => self.go_on(self.is_own(value), Phase::Finish),
            other => other,
        };
        Ok(())
    }

    /// The phase `next` if the value that was read is as expected; otherwise the phase after the
    /// end of the request.
    fn go_on(&mut self, is_unchanged: bool, next: Phase) -> Phase {
        match is_unchanged {
            true => next,
            false if self.has_answer() => self.end(Outcome::Abandoned),
            false => Phase::Idle,
        }
    }

    fn has_answer(&self) -> bool {
        self.response_state != [0; 4]
    }

    fn service_of(&self, value: &[u8]) -> Option<usize> {
        let id = ServiceId::from_text(CncStr::until_nul(value)).ok()?;
        self.services.iter().position(|service| *service == id)
    }

    /// Whether this value of UUID is that of the service of the current request.
    fn is_own(&self, value: &[u8]) -> bool {
        self.service_of(value) == Some(self.service)
    }

    fn end(&mut self, outcome: Outcome) -> Phase {
        self.outcome = Some(outcome);
        Phase::Idle
    }

    /// Answers the request that [`step`](Self::step) has returned. If the step is not
    /// [`HostStep::Serve`], only checks the arguments.
    ///
    /// # Errors
    /// After an error, nothing is written, and the caller can pass another answer:
    /// - [`TooLong`](crate::ErrorKind::TooLong): a response of more than 128 bytes including its NUL,
    /// - [`OutOfRange`](crate::ErrorKind::OutOfRange): a response state of 0 (SVC-5, E-35).
    pub fn answer(&mut self, response: CncStr<'_>, response_state: u32) -> Result<(), Error> {
        let response = ServiceText::new(response, ServiceVariable::Response)?;
        let response_state = not_zero(response_state, ServiceVariable::ResponseState)?;
        if self.phase == Phase::Serving {
            (self.response, self.response_state) = (response, response_state);
            self.outcome = None;
            self.phase = Phase::CheckState;
        }
        Ok(())
    }

    /// Reports that the variable was written. Does nothing if the step is not a write.
    pub fn written(&mut self) {
        self.phase = match self.phase {
            Phase::Respond => Phase::Clear,
            Phase::Clear => Phase::Finish,
            Phase::Finish => self.end(Outcome::Answered),
            other => other,
        };
    }

    /// Reports that the step failed. A failed write may have taken effect, so the host reads one or
    /// more of the variables before it writes again. Any other step remains the next step.
    pub fn failed(&mut self) {
        self.phase = match self.phase {
            Phase::Respond => Phase::CheckState,
            Phase::Clear => Phase::LookCleared,
            Phase::Finish => Phase::LookResponseState,
            other => other,
        };
    }

    /// Ends a [`HostStep::Wait`]; the host looks for a request again.
    pub fn poll(&mut self) {
        if self.phase == Phase::Idle {
            self.phase = Phase::PollState;
        }
    }

    /// Discards the current request and its answer, and looks for a request. If the discarded
    /// request is still in the variables, it is served again.
    pub fn restart(&mut self) {
        self.phase = Phase::PollState;
    }
}
