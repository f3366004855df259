//! The cycle SysServiceWait.

use std::time::Duration;

use ads_cnc::Error;
use ads_cnc::service::ServiceVariable;

/// The parameters of the cycle SysServiceWait, with which an NC program waits for a response
/// (SVC-8).
///
/// | parameter | meaning | field |
/// |---|---|---|
/// | @P1 | response state for which the cycle keeps waiting; default 0 | `keep_waiting` |
/// | @P2 | maximum wait in milliseconds; no limit by default | `longest` |
/// | @P3 | ID of the timer in the CNC; required with @P2 | none: not used here |
///
/// A request sets RESPONSE_STATE to 0 (SVC-3). Therefore, a @P1 other than 0 ends the wait at once,
/// unless a service has already set that state.
///
/// Assumed: all parameters are UNS32; with a @P2 of 0, the cycle reads once; @P3 without @P2 has no
/// effect.
///
/// Manual: `service-en`, section 3; `service-de` 1.03 does not have the cycle.
///
/// ```
/// use ads_cnc_conformance::simulator::program::service::SysServiceWait;
///
/// // L CYCLE [NAME = "SysServiceWait.cyc", @P2 = 5000, @P3 = 1]
/// let wait = SysServiceWait::from_parameters(None, Some(5000), Some(1))?;
/// assert_eq!(wait.keep_waiting, 0);
/// assert_eq!(wait.longest.unwrap().as_secs(), 5);
/// assert_eq!(
///     SysServiceWait::from_parameters(None, Some(5000), None).unwrap_err().to_string(),
///     "sys-service-wait: @P3 at offset 8: missing"
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SysServiceWait {
    /// The response state for which the cycle keeps waiting.
    pub keep_waiting: u32,
    /// The maximum wait; `None` for no limit.
    pub longest: Option<Duration>,
}

/// The error for a cycle SysServiceWait that has @P2 without @P3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("sys-service-wait: @P3 at offset 8: missing")]
pub struct NoTimer;

impl SysServiceWait {
    /// Creates the cycle with these values of @P1, @P2 and @P3.
    ///
    /// # Errors
    /// [`NoTimer`] for @P2 without @P3.
    pub fn from_parameters(
        p1: Option<u32>,
        p2: Option<u32>,
        p3: Option<u32>,
    ) -> Result<Self, NoTimer> {
        if p2.is_some() && p3.is_none() {
            return Err(NoTimer);
        }
        let longest = p2.map(|millis| Duration::from_millis(millis.into()));
        Ok(Self { keep_waiting: p1.unwrap_or(0), longest })
    }

    /// Starts the wait. `now` is the time since any fixed point and must never decrease.
    pub fn start(self, now: Duration) -> Waiting {
        let deadline = self.longest.map(|longest| now.saturating_add(longest));
        Waiting { keep_waiting: self.keep_waiting, deadline, phase: WaitPhase::Read }
    }
}

/// A wait that has started.
///
/// Manual: `service-en`, section 3 (SVC-6, SVC-8).
///
/// ```
/// use std::time::Duration;
///
/// use ads_cnc::service::ServiceVariable;
/// use ads_cnc_conformance::simulator::program::service::{SysServiceWait, WaitStep};
///
/// let at = Duration::from_millis;
/// let wait = SysServiceWait::from_parameters(None, Some(5000), Some(1))?;
/// let mut waiting = wait.start(at(100));
///
/// assert_eq!(waiting.step(), WaitStep::Read(ServiceVariable::ResponseState));
/// waiting.read(&[0, 0, 0, 0], at(120))?;
/// assert_eq!(waiting.step(), WaitStep::Wait { until: Some(at(5100)) });
/// waiting.poll();
/// waiting.read(&[99, 0, 0, 0], at(5200))?;
/// assert_eq!(waiting.step(), WaitStep::Done { state: 99 });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Waiting {
    keep_waiting: u32,
    deadline: Option<Duration>,
    phase: WaitPhase,
}

#[derive(Clone, Copy, Debug)]
enum WaitPhase {
    Read,
    Idle,
    Done(u32),
    TimedOut,
}

/// The next step of a wait; for an example, see [`Waiting`].
///
/// Manual: `service-en`, section 3.
///
/// ```
/// use std::time::Duration;
///
/// use ads_cnc_conformance::simulator::program::service::{SysServiceWait, WaitStep};
///
/// // Without @P2, the wait has no limit.
/// let mut waiting = SysServiceWait::default().start(Duration::ZERO);
/// waiting.read(&[0, 0, 0, 0], Duration::ZERO)?;
/// assert_eq!(waiting.step(), WaitStep::Wait { until: None });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WaitStep {
    /// Read this variable and pass its value to [`Waiting::read`].
    Read(ServiceVariable),
    /// Wait, then call [`Waiting::poll`].
    Wait {
        /// The time at which the maximum wait ends; `None` without a limit. Poll at this time at
        /// the latest.
        until: Option<Duration>,
    },
    /// RESPONSE_STATE has this value, which is not the one for which the cycle keeps waiting.
    Done { state: u32 },
    /// No response arrived within the maximum wait.
    TimedOut,
}

impl Waiting {
    /// The next step; it does not change until it is reported as done.
    pub const fn step(&self) -> WaitStep {
        match self.phase {
            WaitPhase::Read => WaitStep::Read(ServiceVariable::ResponseState),
            WaitPhase::Idle => WaitStep::Wait { until: self.deadline },
            WaitPhase::Done(state) => WaitStep::Done { state },
            WaitPhase::TimedOut => WaitStep::TimedOut,
        }
    }

    /// Reports the value that was read at `now`; ignored if the step is not a read.
    ///
    /// The wait times out only after reading the value for which the cycle keeps waiting, so a
    /// response that exists after the maximum wait is still valid.
    ///
    /// # Errors
    /// [`Truncated`](ads_cnc::ErrorKind::Truncated) or [`Trailing`](ads_cnc::ErrorKind::Trailing)
    /// for a state that does not have exactly four bytes; then the step must be repeated.
    pub fn read(&mut self, value: &[u8], now: Duration) -> Result<(), Error> {
        if let WaitPhase::Read = self.phase {
            let state = ServiceVariable::ResponseState.state(value)?;
            self.phase = if state != self.keep_waiting {
                WaitPhase::Done(state)
            } else if self.deadline.is_some_and(|deadline| now >= deadline) {
                WaitPhase::TimedOut
            } else {
                WaitPhase::Idle
            };
        }
        Ok(())
    }

    /// Ends a [`WaitStep::Wait`]: the next step is a read.
    pub fn poll(&mut self) {
        if let WaitPhase::Idle = self.phase {
            self.phase = WaitPhase::Read;
        }
    }
}
