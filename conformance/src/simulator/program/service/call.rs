//! The NC program's side of the Service Interface.

use std::time::Duration;

use ads_cnc::service::{ServiceId, ServiceVariable};
use ads_cnc::{CncStr, Error, ErrorKind};

use super::{NoTimer, SysServiceWait, WaitStep, Waiting, text_value, value_of};

/// An NC program's request to a service: it writes UUID, REQUEST and finally REQUEST_STATE, waits
/// for RESPONSE_STATE (SVC-6, E-20), and reads RESPONSE.
///
/// The step does not change until the caller reports it as done, so that a failed step can be
/// repeated. But writing REQUEST_STATE twice sends the request twice, and discards a response that
/// arrived in between (SVC-3).
///
/// Manual: `service-en` and `service-de` 1.03, section 2.
///
/// ```
/// use std::time::Duration;
///
/// use ads_cnc::CncStr;
/// use ads_cnc::service::{ServiceId, ServiceVariable};
/// use ads_cnc_conformance::simulator::program::service::{CallStep, ServiceCall, SysServiceWait};
///
/// let id = ServiceId::new("19719079-BA06-4740-BC02-DE5215211751")?;
/// let wait = SysServiceWait::from_parameters(None, Some(5000), Some(1))?;
/// let mut call = ServiceCall::new(id, CncStr::new("some-command")?, wait)?;
///
/// let uuid = &b"19719079-BA06-4740-BC02-DE5215211751\0"[..];
/// assert_eq!(call.step(), CallStep::Write(ServiceVariable::Uuid, uuid));
/// call.written(Duration::ZERO);
/// assert_eq!(call.step(), CallStep::Write(ServiceVariable::Request, b"some-command\0"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ServiceCall {
    uuid: Vec<u8>,
    request: Vec<u8>,
    state: [u8; 4],
    wait: SysServiceWait,
    response: Vec<u8>,
    phase: CallPhase,
}

#[derive(Clone, Debug)]
enum CallPhase {
    Uuid,
    Request,
    State,
    Waiting(Waiting),
    Response(u32),
    Done(u32),
}

/// The next step of a call; for a longer example, see [`ServiceCall`].
///
/// Manual: `service-en` and `service-de` 1.03, section 2.
///
/// ```
/// use ads_cnc::CncStr;
/// use ads_cnc::service::{ServiceId, ServiceVariable};
/// use ads_cnc_conformance::simulator::program::service::{CallStep, ServiceCall, SysServiceWait};
///
/// let id = ServiceId::new("19719079-BA06-4740-BC02-DE5215211751")?;
/// let call = ServiceCall::new(id, CncStr::new("some-command")?, SysServiceWait::default())?;
/// assert!(matches!(call.step(), CallStep::Write(ServiceVariable::Uuid, _)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CallStep<'a> {
    /// Read this variable and pass its value to [`ServiceCall::read`].
    Read(ServiceVariable),
    /// Write this value to this variable, then call [`ServiceCall::written`].
    Write(ServiceVariable, &'a [u8]),
    /// Wait, then call [`ServiceCall::poll`].
    Wait {
        /// The time at which the maximum wait ends; `None` without a limit. Poll at this time at
        /// the latest.
        until: Option<Duration>,
    },
    /// The service has responded.
    Done { state: u32, response: CncStr<'a> },
    /// No response arrived within the maximum wait. The program leaves the request in the
    /// variables, so a service may still respond.
    TimedOut,
}

/// The reason why a request cannot be sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CallError {
    /// The request is too long.
    #[error(transparent)]
    Text(#[from] Error),
    /// The request state is 0.
    #[error("service: request_state at offset 0: expected at least 1, found 0")]
    State,
    /// The cycle SysServiceWait has @P2 without @P3.
    #[error(transparent)]
    Timer(#[from] NoTimer),
}

impl CallError {
    /// The class of the error.
    pub const fn kind(&self) -> ErrorKind {
        match self {
            Self::Text(error) => error.kind(),
            Self::State => ErrorKind::OutOfRange,
            Self::Timer(_) => ErrorKind::Missing,
        }
    }
}

impl ServiceCall {
    /// Creates a request with the request state 1, as in the examples of the manual.
    ///
    /// # Errors
    /// [`CallError::Text`] for a request of more than 128 bytes including its NUL.
    pub fn new(
        id: ServiceId,
        request: CncStr<'_>,
        wait: SysServiceWait,
    ) -> Result<Self, CallError> {
        Self::with_state(id, request, 1, wait)
    }

    /// Creates a request with another request state.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), and [`CallError::State`] for a state of 0.
    pub fn with_state(
        id: ServiceId,
        request: CncStr<'_>,
        state: u32,
        wait: SysServiceWait,
    ) -> Result<Self, CallError> {
        if state == 0 {
            return Err(CallError::State);
        }
        Ok(Self {
            uuid: value_of(id.text()),
            request: text_value(&value_of(request), ServiceVariable::Request)?,
            state: state.to_le_bytes(),
            wait,
            response: Vec::new(),
            phase: CallPhase::Uuid,
        })
    }

    /// The next step; it does not change until it is reported as done.
    pub fn step(&self) -> CallStep<'_> {
        match &self.phase {
            CallPhase::Uuid => CallStep::Write(ServiceVariable::Uuid, &self.uuid),
            CallPhase::Request => CallStep::Write(ServiceVariable::Request, &self.request),
            CallPhase::State => CallStep::Write(ServiceVariable::RequestState, &self.state),
            CallPhase::Waiting(waiting) => match waiting.step() {
                WaitStep::Read(variable) => CallStep::Read(variable),
                WaitStep::Wait { until } => CallStep::Wait { until },
                // `Done` cannot occur here: when a response exists, the phase changes to
                // `Response`.
                WaitStep::TimedOut | WaitStep::Done { .. } => CallStep::TimedOut,
            },
            CallPhase::Response(_) => CallStep::Read(ServiceVariable::Response),
            CallPhase::Done(state) => CallStep::Done { state: *state, response: self.response() },
        }
    }

    fn response(&self) -> CncStr<'_> {
        // The text was checked when it was read.
        ServiceVariable::Response.text(&self.response).unwrap_or(CncStr::EMPTY)
    }

    /// Reports that a write was done at `now`; the wait begins after the last write. Ignored if the
    /// step is not a write.
    pub fn written(&mut self, now: Duration) {
        match self.phase {
            CallPhase::Uuid => self.phase = CallPhase::Request,
            CallPhase::Request => self.phase = CallPhase::State,
            CallPhase::State => self.phase = CallPhase::Waiting(self.wait.start(now)),
            CallPhase::Waiting(_) | CallPhase::Response(_) | CallPhase::Done(_) => {}
        }
    }

    /// Reports the value that was read at `now`; ignored if the step is not a read.
    ///
    /// # Errors
    /// For a state that does not have exactly four bytes, or a response of more than 128 bytes
    /// including its NUL; then the step must be repeated.
    pub fn read(&mut self, value: &[u8], now: Duration) -> Result<(), Error> {
        match &mut self.phase {
            CallPhase::Waiting(waiting) => {
                waiting.read(value, now)?;
                if let WaitStep::Done { state } = waiting.step() {
                    self.phase = CallPhase::Response(state);
                }
            }
            CallPhase::Response(state) => {
                self.response = text_value(value, ServiceVariable::Response)?;
                self.phase = CallPhase::Done(*state);
            }
            CallPhase::Uuid | CallPhase::Request | CallPhase::State | CallPhase::Done(_) => {}
        }
        Ok(())
    }

    /// Ends a [`CallStep::Wait`]: the next step is a read.
    pub fn poll(&mut self) {
        if let CallPhase::Waiting(waiting) = &mut self.phase {
            waiting.poll();
        }
    }
}
