//! The NC program that sends requests to services.

use std::time::Duration;

use ads_cnc::service::ServiceId;
use ads_cnc::service::ServiceVariable::{RequestState, ResponseState, Uuid};
use ads_cnc::{CncStr, CncString, Error};

use super::completed_request::{CompletedRequest, CompletedRequests, ServiceOutcome};
use super::policy::Policy;
use super::service::{CallError, CallStep, ServiceCall, ServiceInterface, SysServiceWait};

/// The requests of an NC program to services, and their repetition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptConfig {
    /// The requests in their order; may be empty.
    pub requests: Vec<ServiceRequest>,
    /// The number of times that the list of requests is executed.
    pub repeat: Repeat,
    /// The pause between a response, or the end of the maximum wait, and the next request; a pause
    /// that is shorter than `cycle` lasts one cycle.
    pub pause: Duration,
    /// The time between two steps, each of which writes or reads a variable; a time below a
    /// microsecond is raised to one microsecond.
    pub cycle: Duration,
}

/// A request to a service: `V.G.SERVICE.UUID`, `.REQUEST` and `.REQUEST_STATE`, and the wait.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceRequest {
    pub uuid: ServiceId,
    /// The text of the request.
    pub text: CncString,
    /// The request state; not 0.
    pub state: u32,
    /// The way in which the program waits for the response.
    pub wait: Wait,
}

/// The way in which a program waits for a response.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wait {
    /// Without the cycle: the program reads RESPONSE_STATE until it is not 0 (SVC-6).
    #[default]
    Loop,
    /// With the cycle SysServiceWait and these parameters (SVC-8).
    Cycle {
        /// @P1: the response state for which the cycle keeps waiting.
        p1: Option<u32>,
        /// @P2: the maximum wait in milliseconds.
        p2: Option<u32>,
        /// @P3: ID of the timer; required with @P2.
        p3: Option<u32>,
    },
}

/// The number of times that the list of requests is executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeat {
    /// The list is executed without end.
    Endless,
    /// The list is executed this number of times.
    Times(u32),
}

impl ScriptConfig {
    /// The manual's example: requests to its square root service, in turn for 3 and for a negative
    /// number. Each is sent a second after the response to the previous request.
    ///
    /// Manual: `service-en` and `service-de` 1.03, section 2 (SVC-9). The manuals print neither the
    /// interval nor that a program requests both.
    ///
    /// # Errors
    /// No error occurs: texts and UUID are valid.
    pub fn square_root() -> Result<Self, Error> {
        let uuid = ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?;
        let request = |text| {
            let text = CncString::from(CncStr::new(text)?);
            Ok(ServiceRequest { uuid, text, state: 1, wait: Wait::Loop })
        };
        Ok(Self {
            requests: vec![request("3")?, request("-3")?],
            repeat: Repeat::Endless,
            pause: Duration::from_secs(1),
            cycle: Duration::from_millis(1),
        })
    }
}

/// The reason why a script is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("request {} of the script: {error}", request.saturating_add(1))]
pub struct ScriptError {
    /// Index of the request.
    pub request: usize,
    pub error: CallError,
}

/// The state of a script.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScriptState {
    /// The script writes the request with this index.
    Asking(usize),
    /// The script waits for the response to this request, or reads the response.
    Waiting(usize),
    /// The script has read the response, or has stopped waiting, and pauses before the next
    /// request.
    Pausing,
    /// The script has no more requests to send.
    Finished,
}

/// An NC program that sends requests to services through the Service Interface of its channel.
///
/// The script executes one step per cycle, so that a service sees the intermediate states. It
/// writes UUID, REQUEST and REQUEST_STATE. Then it reads RESPONSE_STATE in each cycle until a
/// response exists or the maximum wait has ended, and reads RESPONSE if one exists.
///
/// [Advance](Self::advance) the script before anything else accesses the interface; then the result
/// is the same as if the script ran continuously. The number of steps in one call is limited: after
/// a long time, the remaining steps are executed later than they were due.
///
/// ```
/// use std::time::Duration;
///
/// use ads_cnc::CncStr;
/// use ads_cnc::service::{Host, HostStep};
/// use ads_cnc_conformance::simulator::program::service::ServiceInterface;
/// use ads_cnc_conformance::simulator::program::{ServiceOutcome, Script, ScriptConfig};
///
/// let config = ScriptConfig::square_root()?;
/// let ids = [config.requests[0].uuid];
/// let (mut script, mut interface, mut host) = (Script::new(config)?, ServiceInterface::new(), Host::new(&ids));
/// for milliseconds in 0..2000 {
///     script.advance(Duration::from_millis(milliseconds), &mut interface);
///     match host.step() {
///         HostStep::Read(variable) => host.read(interface.read(variable))?,
///         HostStep::Write(variable, value) => {
///             interface.write(variable, value)?;
///             host.written();
///         }
///         HostStep::Serve { request, .. } if request == "3" => host.answer(CncStr::new("1.732051")?, 1)?,
///         HostStep::Serve { .. } => host.answer(CncStr::new("ERROR")?, 99)?,
///         HostStep::Wait => host.poll(),
///     }
/// }
/// let states: Vec<u32> = script
///     .answers()
///     .filter_map(|answer| match &answer.outcome {
///         ServiceOutcome::Response { state, .. } => Some(*state),
///         ServiceOutcome::TimedOut => None,
///     })
///     .collect();
/// assert_eq!(states, [1, 99]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Manual: `service-en` and `service-de` 1.03, section 2; `service-en`, section 3.
#[derive(Clone, Debug)]
pub struct Script {
    /// The requests, each in its initial state.
    requests: Vec<ServiceCall>,
    pause: Duration,
    cycle: Duration,
    repeat: Repeat,
    passes: u32,
    /// The current request with its index; `None` if no request is left.
    present: Option<(usize, ServiceCall)>,
    /// The time at which the next step is due; `None` before the first step, which is due at once.
    due: Option<Duration>,
    pausing: bool,
    answers: CompletedRequests,
    policy: Policy,
}

impl Script {
    /// Maximum number of stored outcomes.
    pub const ANSWERS_MAX: usize = CompletedRequests::STORED_MAX;

    /// Maximum number of steps that one call of [`advance`](Self::advance) executes. Reads of
    /// RESPONSE_STATE that cannot find a response are skipped.
    const STEPS: u32 = 100_000;

    /// Creates a program that begins when it is first [advanced](Self::advance).
    ///
    /// # Errors
    /// [`ScriptError`] for a request of more than 128 bytes including its NUL, a request state of
    /// 0, or @P2 without @P3.
    pub fn new(config: ScriptConfig) -> Result<Self, ScriptError> {
        let calls = config.requests.iter().enumerate();
        let calls = calls.map(|(at, request)| {
            request.call().map_err(|error| ScriptError { request: at, error })
        });
        let mut script = Self {
            requests: calls.collect::<Result<_, _>>()?,
            pause: config.pause,
            cycle: config.cycle.max(Duration::from_micros(1)),
            repeat: config.repeat,
            passes: 0,
            present: None,
            due: None,
            pausing: false,
            answers: CompletedRequests::default(),
            policy: Policy::DEFAULT,
        };
        script.restart();
        Ok(script)
    }

    /// Replaces the policy, which determines the behaviour that seeded defects can change.
    pub(crate) fn with_policy(self, policy: Policy) -> Self {
        Self { policy, ..self }
    }

    /// Restarts with the first request, as after an NC reset and a start. Keeps the outcomes.
    pub fn restart(&mut self) {
        (self.passes, self.due, self.pausing) = (0, None, false);
        let any = self.repeat != Repeat::Times(0);
        self.present = self.requests.first().filter(|_| any).map(|call| (0, call.clone()));
    }

    /// Executes the steps that are due, at most a fixed number of them.
    pub fn advance(&mut self, now: Duration, interface: &mut ServiceInterface) {
        for _ in 0..Self::STEPS {
            let due = *self.due.get_or_insert(now);
            if due > now || self.present.is_none() {
                return;
            }
            self.step(due, interface);
            if let Some(CallStep::Wait { until }) = self.next_step() {
                // RESPONSE_STATE does not change before `now`, so skip polls until then, but at
                // most until the timeout.
                let next = until.filter(|until| *until <= now);
                let next = next.unwrap_or(now.saturating_add(NANOSECOND));
                self.due = Some(self.cycle_at(due, next));
            }
        }
        self.due = self.due.map(|due| due.max(now));
    }

    /// Executes one step now, even if it is not due.
    pub fn step(&mut self, now: Duration, interface: &mut ServiceInterface) {
        self.pausing = false;
        self.due = Some(now.saturating_add(self.cycle));
        let Some((at, call)) = &mut self.present else { return };
        call.poll();
        let time = if self.policy.times_out { now } else { Duration::ZERO };
        // The values of a call are always valid for the interface; after an error, the step would
        // be repeated.
        match call.step() {
            CallStep::Write(variable, value) => {
                let first = self.policy.state_first && variable == Uuid;
                if first && interface.write(RequestState, &[1, 0, 0, 0]).is_err() {
                    return;
                }
                if interface.write(variable, value).is_ok() {
                    call.written(time);
                }
            }
            CallStep::Read(ResponseState) if !self.policy.awaits_response => {
                let _ = call.read(&[1, 0, 0, 0], time);
            }
            CallStep::Read(variable) => {
                let _ = call.read(interface.read(variable), time);
            }
            CallStep::Wait { .. } | CallStep::Done { .. } | CallStep::TimedOut => {}
        }
        let outcome = match call.step() {
            CallStep::Done { state, response } => {
                ServiceOutcome::Response { state, text: CncString::from(response) }
            }
            CallStep::TimedOut => ServiceOutcome::TimedOut,
            _ => return,
        };
        let at = *at;
        self.answers.push(at, now, outcome);
        self.go_on(at, now);
    }

    /// The next step; `None` if no request is left.
    pub fn next_step(&self) -> Option<CallStep<'_>> {
        self.present.as_ref().map(|(_, call)| call.step())
    }

    /// The state after the last call of `advance`, `step` or `restart`.
    pub fn state(&self) -> ScriptState {
        match (&self.present, self.next_step()) {
            (Some(_), _) if self.pausing => ScriptState::Pausing,
            (Some((at, _)), Some(CallStep::Write(..))) => ScriptState::Asking(*at),
            (Some((at, _)), _) => ScriptState::Waiting(*at),
            (None, _) => ScriptState::Finished,
        }
    }

    /// The latest outcomes, at most [`ANSWERS_MAX`](Self::ANSWERS_MAX), in their order.
    pub fn answers(&self) -> impl DoubleEndedIterator<Item = &CompletedRequest> {
        self.answers.stored.iter()
    }

    /// Number of all outcomes, including timeouts.
    pub fn answer_count(&self) -> u64 {
        self.answers.count
    }

    /// Number of requests that timed out.
    pub fn timed_out(&self) -> u64 {
        self.answers.timed_out
    }

    /// Continues with the request after the one with the index `at`; after the last request, with
    /// the first one, unless the list has been executed as often as configured.
    fn go_on(&mut self, at: usize, now: Duration) {
        let mut next = at.saturating_add(1);
        if next >= self.requests.len() {
            next = 0;
            self.passes = self.passes.saturating_add(1);
        }
        let over = matches!(self.repeat, Repeat::Times(times) if self.passes >= times);
        self.present = self.requests.get(next).filter(|_| !over).map(|call| (next, call.clone()));
        self.pausing = self.present.is_some();
        self.due = Some(now.saturating_add(self.pause.max(self.cycle)));
    }

    /// The first cycle after `due` that is not before `time`.
    fn cycle_at(&self, due: Duration, time: Duration) -> Duration {
        let cycle = self.cycle.as_nanos();
        let cycles = time.saturating_sub(due).as_nanos().div_ceil(cycle).max(1);
        let after = u64::try_from(cycles.saturating_mul(cycle)).unwrap_or(u64::MAX);
        due.saturating_add(Duration::from_nanos(after))
    }
}

const NANOSECOND: Duration = Duration::from_nanos(1);

impl ServiceRequest {
    fn call(&self) -> Result<ServiceCall, CallError> {
        let wait = match self.wait {
            Wait::Loop => SysServiceWait::default(),
            Wait::Cycle { p1, p2, p3 } => SysServiceWait::from_parameters(p1, p2, p3)?,
        };
        ServiceCall::with_state(self.uuid, self.text.as_cnc_str(), self.state, wait)
    }
}
