//! Laws of a host of the Service Interface, for any input.

use ads_cnc::CncStr;
use ads_cnc::service::*;

pub(crate) fn service_ids() -> [ServiceId; 2] {
    [
        ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47").unwrap(),
        ServiceId::new("19719079-ba06-4740-bc02-de5215211751").unwrap(),
    ]
}

/// The bytes of a value before its first NUL, or all bytes of a value without a NUL.
pub(super) fn text(value: &[u8]) -> &[u8] {
    value.split(|&byte| byte == 0).next().unwrap_or(value)
}

pub(super) fn state(value: &[u8]) -> Option<u32> {
    value.try_into().ok().map(u32::from_le_bytes)
}

pub(super) fn is_text(variable: ServiceVariable) -> bool {
    !matches!(variable, ServiceVariable::RequestState | ServiceVariable::ResponseState)
}

/// A fault that is added to a host, to verify that the laws detect it.
#[derive(Clone, Copy)]
pub(crate) struct HostMutation {
    /// Returns the value to pass to the host instead of the read value. The second argument is the
    /// previous value of the same variable.
    pub(crate) read: for<'v> fn(&'v [u8], Option<&'v [u8]>) -> &'v [u8],
    pub(crate) state: fn(u32) -> u32,
    pub(crate) written: fn(&mut Host<'_>),
    pub(crate) failed: fn(&mut Host<'_>),
    pub(crate) poll: fn(&mut Host<'_>),
    /// Changes the host after it rejected an invalid value.
    pub(crate) rejected: fn(&mut Host<'_>),
}

impl HostMutation {
    pub(crate) const NONE: Self = Self {
        read: |value, _| value,
        state: |state| state,
        written: |host| host.written(),
        failed: |host| host.failed(),
        poll: |host| host.poll(),
        rejected: |_| (),
    };
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Step {
    Read(ServiceVariable),
    Write(ServiceVariable, Vec<u8>),
    Serve(ServiceId, Vec<u8>, u32),
    Wait,
}

/// A host with its inputs since its start or restart. Each method that reports something to the
/// host then checks the state of the host.
pub(crate) struct CheckedHost<'s> {
    host: Host<'s>,
    ids: &'s [ServiceId],
    /// The variables and values that the host has read, in order, without values that it rejected.
    reads: Vec<(ServiceVariable, Vec<u8>)>,
    asked: Option<Step>,
    answer: (Vec<u8>, u32),
    mutation: HostMutation,
}

impl<'s> CheckedHost<'s> {
    pub(crate) fn new(ids: &'s [ServiceId], mutation: HostMutation) -> Self {
        let (reads, answer) = (Vec::new(), (Vec::new(), 0));
        Self { host: Host::new(ids), ids, reads, asked: None, answer, mutation }
    }

    pub(crate) fn step(&self) -> Step {
        match self.host.step() {
            HostStep::Read(variable) => Step::Read(variable),
            HostStep::Write(variable, value) => Step::Write(variable, value.to_vec()),
            HostStep::Serve { uuid, request, request_state } => {
                Step::Serve(*uuid, request.bytes().collect(), request_state)
            }
            HostStep::Wait => Step::Wait,
        }
    }

    /// Checks that only an invalid value is an error. A request must only be handed out if it was
    /// read twice in sequence, and only be answered if it was read once more.
    pub(crate) fn read(&mut self, value: &[u8]) {
        let before = self.step();
        let Step::Read(variable) = before else {
            assert_eq!((self.host.read(value), self.step()), (Ok(()), before));
            return;
        };
        let last = self.reads.iter().rev().find(|(of, _)| *of == variable);
        let told = (self.mutation.read)(value, last.map(|(_, value)| &value[..]));
        let read = self.host.read(told);
        if let Err(error) = read {
            (self.mutation.rejected)(&mut self.host);
            let valid = if is_text(variable) { text(value).len() < 128 } else { value.len() == 4 };
            assert!(!valid, "{error}: {value:x?}");
            assert!(self.step() == Step::Wait || self.step() == before);
            return;
        }
        self.reads.push((variable, value.to_vec()));
        match self.step() {
            Step::Read(_) | Step::Wait => {}
            // The host must have read the same request twice in sequence (SVC-2).
            Step::Serve(id, request, asked) => {
                assert!(asked != 0 && request.len() < 128 && self.ids.contains(&id));
                assert!(self.found(2, &id, &request, asked), "{:x?}", self.reads);
                self.asked = Some(self.step());
            }
            // The host must have read the same request once more after it was handed out.
            Step::Write(ServiceVariable::Response, value) => {
                assert_eq!(value, [&self.answer.0[..], b"\0"].concat());
                let Some(Step::Serve(id, request, asked)) = &self.asked else { unreachable!() };
                assert!(self.found(1, id, request, *asked), "{:x?}", self.reads);
            }
            Step::Write(variable, value) => {
                assert_eq!(variable, ServiceVariable::ResponseState);
                assert_eq!(value, self.answer.1.to_le_bytes());
            }
        }
    }

    /// Returns true if the last reads returned this request, `times` times in sequence.
    fn found(&self, times: usize, id: &ServiceId, request: &[u8], asked: u32) -> bool {
        let values =
            [ServiceVariable::RequestState, ServiceVariable::Uuid, ServiceVariable::Request];
        let of_id = |value: &[u8]| ServiceId::from_text(CncStr::from_bytes(text(value)).unwrap());
        let is = |reads: &[(ServiceVariable, Vec<u8>)]| {
            reads.iter().map(|(variable, _)| *variable).eq(values)
                && state(&reads[0].1) == Some(asked)
                && of_id(&reads[1].1).as_ref() == Ok(id)
                && text(&reads[2].1) == request
        };
        let from = self.reads.len().checked_sub(3 * times);
        from.is_some_and(|from| self.reads[from..].chunks(3).all(is))
    }

    /// Checks the order of the writes: RESPONSE, REQUEST_STATE, RESPONSE_STATE.
    pub(crate) fn written(&mut self) {
        let before = self.step();
        (self.mutation.written)(&mut self.host);
        let wanted = match &before {
            Step::Write(ServiceVariable::Response, _) => {
                Step::Write(ServiceVariable::RequestState, vec![0; 4])
            }
            Step::Write(ServiceVariable::RequestState, _) => {
                Step::Write(ServiceVariable::ResponseState, self.answer.1.to_le_bytes().into())
            }
            Step::Write(..) => {
                assert_eq!(self.host.outcome(), Some(Outcome::Answered));
                Step::Wait
            }
            _ => before,
        };
        assert_eq!(self.step(), wanted);
    }

    /// Checks that the step after a failed write is a read, and that any other failed step is
    /// repeated.
    pub(crate) fn failed(&mut self) {
        let before = self.step();
        (self.mutation.failed)(&mut self.host);
        match before {
            Step::Write(..) => assert!(matches!(self.step(), Step::Read(_))),
            _ => assert_eq!(self.step(), before),
        }
    }

    pub(crate) fn poll(&mut self) {
        let before = self.step();
        (self.mutation.poll)(&mut self.host);
        let waited = before == Step::Wait;
        let looks = Step::Read(ServiceVariable::RequestState);
        assert_eq!(self.step(), if waited { looks } else { before });
    }

    pub(crate) fn restart(&mut self) {
        self.host.restart();
        self.reads.clear();
        assert_eq!(self.step(), Step::Read(ServiceVariable::RequestState));
    }

    /// Checks that the host accepts exactly the valid answers, and that an answer only changes its
    /// step if a request is handed out.
    pub(crate) fn answer(&mut self, response: &[u8], response_state: u32) {
        let before = self.step();
        let response = text(response);
        let told = (self.mutation.state)(response_state);
        let taken = self.host.answer(CncStr::from_bytes(response).unwrap(), told);
        let valid = response.len() < 128 && response_state != 0;
        assert_eq!(taken.is_ok(), valid, "{response:x?}, {response_state}");
        if valid && matches!(before, Step::Serve(..)) {
            self.answer = (response.to_vec(), response_state);
            assert_eq!(self.step(), Step::Read(ServiceVariable::RequestState));
            assert_eq!(self.host.outcome(), None);
        } else {
            assert_eq!(self.step(), before);
        }
    }
}
