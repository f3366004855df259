//! Compares the CNC's side of data streaming and of the Service Interface, with any input, with simple
//! models: of the queue of a stream, of a program's request, and of the five variables. The fuzz
//! targets include this file.

#![allow(dead_code, reason = "the fuzz targets use more than the tests")]

use std::time::Duration;

use ads_cnc::CncStr;
use ads_cnc::limits::STREAM_MAX;
use ads_cnc::service::*;
use ads_cnc::streaming::{Ack, LineError, LineErrorKind};
use ads_cnc_conformance::simulator::program::StreamingInterface;
use ads_cnc_conformance::simulator::program::service::*;

/// The text of a value, up to its NUL.
fn text(value: &[u8]) -> &[u8] {
    value.split(|&byte| byte == 0).next().unwrap_or(value)
}

fn state(value: &[u8]) -> Option<u32> {
    value.try_into().ok().map(u32::from_le_bytes)
}

fn is_text(variable: ServiceVariable) -> bool {
    !matches!(variable, ServiceVariable::RequestState | ServiceVariable::ResponseState)
}

#[derive(Clone, Debug, PartialEq)]
enum Phase {
    Write(usize),
    Read,
    Wait,
    Response(u32),
    StepResult(u32, Vec<u8>),
    TimedOut,
}

/// A program's request, and a model of it. Each method calls both and compares them.
pub(crate) struct CheckedCall {
    call: ServiceCall,
    values: [(ServiceVariable, Vec<u8>); 3],
    keep_waiting: u32,
    /// The maximum wait; the next field is the time at which the wait ends.
    longest: Option<Duration>,
    until: Option<Duration>,
    phase: Phase,
}

impl CheckedCall {
    /// Creates a request with the parameters @P1, @P2 and @P3 of the cycle.
    pub(crate) fn new(
        id: ServiceId,
        request: &[u8],
        asked: u32,
        [p1, p2, p3]: [Option<u32>; 3],
    ) -> Result<Self, CallError> {
        let wait = SysServiceWait::from_parameters(p1, p2, p3);
        assert_eq!(wait.is_err(), p2.is_some() && p3.is_none());
        let request = text(request);
        let call = ServiceCall::with_state(id, CncStr::from_bytes(request).unwrap(), asked, wait?);
        assert_eq!(call.is_ok(), request.len() < 128 && asked != 0);
        let ended = |text: &[u8]| [text, b"\0"].concat();
        let values = [
            (ServiceVariable::Uuid, ended(id.to_string().as_bytes())),
            (ServiceVariable::Request, ended(request)),
            (ServiceVariable::RequestState, asked.to_le_bytes().into()),
        ];
        let longest = p2.map(|millis| Duration::from_millis(millis.into()));
        let (keep_waiting, phase) = (p1.unwrap_or(0), Phase::Write(0));
        let checked = Self { call: call?, values, keep_waiting, longest, until: None, phase };
        checked.check();
        Ok(checked)
    }

    fn check(&self) {
        let wanted = match &self.phase {
            Phase::Write(place) => {
                let (variable, value) = &self.values[*place];
                CallStep::Write(*variable, value)
            }
            Phase::Read => CallStep::Read(ServiceVariable::ResponseState),
            Phase::Wait => CallStep::Wait { until: self.until },
            Phase::Response(_) => CallStep::Read(ServiceVariable::Response),
            Phase::StepResult(state, text) => {
                CallStep::Done { state: *state, response: CncStr::from_bytes(text).unwrap() }
            }
            Phase::TimedOut => CallStep::TimedOut,
        };
        assert_eq!(self.call.step(), wanted);
    }

    pub(crate) fn written(&mut self, now: Duration) {
        self.call.written(now);
        self.phase = match self.phase {
            Phase::Write(2) => {
                self.until = self.longest.map(|longest| now + longest);
                Phase::Read
            }
            Phase::Write(place) => Phase::Write(place + 1),
            ref other => other.clone(),
        };
        self.check();
    }

    /// Lets the program read a value. The model gets `value` and `now`; the request gets `told`,
    /// which only a seeded defect makes different.
    pub(crate) fn read(&mut self, value: &[u8], now: Duration, told: (&[u8], Duration)) {
        let taken = self.call.read(told.0, told.1);
        let (phase, valid) = match (&self.phase, state(value)) {
            (Phase::Read, Some(state)) if state != self.keep_waiting => {
                (Phase::Response(state), true)
            }
            (Phase::Read, Some(_)) if self.until.is_some_and(|until| now >= until) => {
                (Phase::TimedOut, true)
            }
            (Phase::Read, Some(_)) => (Phase::Wait, true),
            (Phase::Read, None) => (Phase::Read, false),
            (Phase::Response(state), _) if text(value).len() < 128 => {
                (Phase::StepResult(*state, text(value).to_vec()), true)
            }
            (phase, _) => (phase.clone(), !matches!(phase, Phase::Response(_))),
        };
        assert_eq!(taken.is_ok(), valid, "{value:x?}");
        self.phase = phase;
        self.check();
    }

    pub(crate) fn poll(&mut self) {
        self.call.poll();
        if self.phase == Phase::Wait {
            self.phase = Phase::Read;
        }
        self.check();
    }
}

/// A Service Interface, and a model of it: five byte strings. Each method calls both and compares
/// them.
pub(crate) struct CheckedVariables {
    interface: ServiceInterface,
    clears: Clears,
    values: [Vec<u8>; 5],
}

impl CheckedVariables {
    pub(crate) fn new(clears: Clears) -> Self {
        Self { interface: ServiceInterface::with(clears), clears, values: Self::start() }
    }

    fn start() -> [Vec<u8>; 5] {
        ServiceVariable::ALL.map(|variable| vec![0; if is_text(variable) { 1 } else { 4 }])
    }

    fn value(&mut self, of: ServiceVariable) -> &mut Vec<u8> {
        let place = ServiceVariable::ALL.iter().position(|variable| *variable == of);
        &mut self.values[place.expect("it is one")]
    }

    /// Writes a variable. The model gets `value`; the interface gets `told`, which only a seeded
    /// defect makes different.
    pub(crate) fn write(&mut self, variable: ServiceVariable, value: &[u8], told: &[u8]) {
        let taken = self.interface.write(variable, told);
        let valid = if is_text(variable) { text(value).len() < 128 } else { value.len() == 4 };
        assert_eq!(taken.is_ok(), valid, "{variable}: {value:x?}");
        if valid {
            let is_text = is_text(variable);
            *self.value(variable) =
                if is_text { [text(value), b"\0"].concat() } else { value.to_vec() };
            match variable {
                // A request resets the response state (SVC-3).
                ServiceVariable::RequestState => self.value(ServiceVariable::ResponseState).fill(0),
                // A response ends the request (SVC-4).
                ServiceVariable::ResponseState if self.clears == Clears::OnResponseState => {
                    self.value(ServiceVariable::RequestState).fill(0);
                }
                _ => {}
            }
        }
        self.check();
    }

    pub(crate) fn reset(&mut self) {
        self.interface.reset();
        self.values = Self::start();
        self.check();
    }

    fn check(&self) {
        let found = ServiceVariable::ALL.map(|variable| self.interface.read(variable).to_vec());
        assert_eq!(found, self.values);
    }
}

/// A seeded defect: functions that are called instead of those of a streaming interface.
#[derive(Clone, Copy)]
pub(crate) struct InterfaceMutation {
    /// Called to write to the interface.
    pub(crate) write: fn(&mut StreamingInterface, &[u8]) -> Ack,
    pub(crate) reset: fn(&mut StreamingInterface),
}

impl InterfaceMutation {
    pub(crate) const NONE: Self =
        Self { write: StreamingInterface::write, reset: StreamingInterface::reset };
}

/// Line, column and kind of an error.
pub(crate) type TextFault = (usize, usize, LineErrorKind);

fn fault_of(error: LineError) -> TextFault {
    (error.line() as usize, error.column() as usize, error.kind())
}

/// A streaming interface, and a model of it: a vector of bytes. Each method calls both and compares
/// them.
pub(crate) struct CheckedInterface {
    interface: StreamingInterface,
    buffered: Vec<u8>,
    mutation: InterfaceMutation,
}

impl CheckedInterface {
    pub(crate) fn new(mutation: InterfaceMutation) -> Self {
        Self { interface: StreamingInterface::new(), buffered: Vec::new(), mutation }
    }

    /// Checks that a write stores all bytes or none.
    pub(crate) fn write(&mut self, data: &[u8]) -> Ack {
        let wanted = match data.len() {
            0 | 993.. => Ack::Rejected,
            len if self.buffered.len() + len > STREAM_MAX => Ack::Busy,
            _ => Ack::Accepted,
        };
        assert_eq!((self.mutation.write)(&mut self.interface, data), wanted);
        if wanted == Ack::Accepted {
            self.buffered.extend_from_slice(data);
        }
        self.check();
        wanted
    }

    /// Checks that a read returns all written bytes, or an error for the first line with a wrong line end.
    pub(crate) fn read(&mut self) -> Result<Vec<u8>, TextFault> {
        let buffered = std::mem::take(&mut self.buffered);
        let wanted = match missing_end(&buffered) {
            None => Ok(buffered),
            Some(fault) => Err(fault),
        };
        let found = self.interface.read().map_err(fault_of);
        assert_eq!(found, wanted.as_deref().map_err(|fault| *fault));
        self.check();
        wanted
    }

    pub(crate) fn reset(&mut self) {
        (self.mutation.reset)(&mut self.interface);
        self.buffered.clear();
        self.check();
    }

    fn check(&self) {
        let (len, is_empty) = (self.interface.len(), self.interface.is_empty());
        assert_eq!((len, is_empty), (self.buffered.len(), self.buffered.is_empty()));
    }
}

/// The error for the first line that does not end in CR LF, found by a simple search byte by byte.
fn missing_end(bytes: &[u8]) -> Option<TextFault> {
    let (mut line, mut column) = (1, 1);
    for (at, &byte) in bytes.iter().enumerate() {
        match byte {
            b'\r' if bytes.get(at + 1) != Some(&b'\n') => {
                return Some((line, column, LineErrorKind::BareCr));
            }
            b'\n' if at == 0 || bytes[at - 1] != b'\r' => {
                return Some((line, column, LineErrorKind::BareLf));
            }
            b'\n' => (line, column) = (line + 1, 1),
            b'\r' => {}
            _ => column += 1,
        }
    }
    (column > 1).then_some((line, column, LineErrorKind::NoLineEnd))
}
