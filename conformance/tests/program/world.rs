//! Executes the steps of an NC program and of one or two hosts of services in any order, with failing
//! writes and reads, and compares the responses with a model that counts requests. The fuzz targets
//! include this file.

#![allow(dead_code, reason = "the fuzz targets use more than the tests")]

use std::time::Duration;

use ads_cnc::CncStr;
use ads_cnc::service::*;
use ads_cnc_conformance::simulator::program::service::*;

const NOW: Duration = Duration::ZERO;

/// Whether a step of a host succeeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StepOutcome {
    Fine,
    /// The read or write does not reach the CNC, and the host gets an error.
    Fails,
    /// A write reaches the CNC, but the host gets an error; a read fails as with `Fails`.
    FailsLate,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Action {
    Program,
    Host(usize, StepOutcome),
    /// The program gives up waiting for a response.
    GiveUp,
    ResetCnc,
    Restart(usize),
}

/// A request: the index of the service, and a number as text. The tests use only two numbers, so
/// that requests repeat.
pub(crate) type TestRequest = (usize, u8);

/// A seeded defect: functions that are called instead of those of the hosts and of the interface.
#[derive(Clone, Copy)]
pub(crate) struct ServiceMutation {
    /// Called to report a failed step to a host.
    pub(crate) failed: fn(&mut Host<'_>),
    pub(crate) restart: fn(&mut Host<'_>),
    /// Called to write a variable of the interface.
    pub(crate) write: fn(&mut ServiceInterface, ServiceVariable, &[u8]),
    /// Returns the index of the service that the host reports for a request.
    pub(crate) asked: fn(usize, &str) -> usize,
}

impl ServiceMutation {
    pub(crate) const NONE: Self = Self {
        failed: |host| host.failed(),
        restart: |host| host.restart(),
        write: |interface, variable, value| interface.write(variable, value).unwrap(),
        asked: |service, _| service,
    };
}

/// The NC program, the hosts and the interface, and the model: the number of requests to each service,
/// and the number of requests that each service has served.
pub(crate) struct World<'s> {
    interface: ServiceInterface,
    hosts: Vec<Host<'s>>,
    ids: &'s [ServiceId],
    call: Option<(TestRequest, ServiceCall)>,
    asked: Vec<usize>,
    served: Vec<usize>,
    /// Whether each response must be right; false while time-outs, resets and restarts may cause wrong
    /// responses.
    strict: bool,
    mutation: ServiceMutation,
}

impl<'s> World<'s> {
    /// Creates one host for all services if `together`, otherwise one host for each service.
    pub(crate) fn new(
        ids: &'s [ServiceId],
        together: bool,
        clears: Clears,
        strict: bool,
        mutation: ServiceMutation,
    ) -> Self {
        let hosts = match together {
            true => vec![Host::new(ids)],
            false => ids.chunks(1).map(Host::new).collect(),
        };
        let (interface, count) = (ServiceInterface::with(clears), vec![0; ids.len()]);
        Self {
            interface,
            hosts,
            ids,
            call: None,
            asked: count.clone(),
            served: count,
            strict,
            mutation,
        }
    }

    /// The number of requests that each service has served.
    pub(crate) fn served(&self) -> &[usize] {
        &self.served
    }

    /// The response of a service: the index of the service, the request, and the number of requests that
    /// the service has served.
    fn answer(service: usize, request: &str, times: usize) -> String {
        format!("{service} {request} {times}")
    }

    fn program(&mut self, next: &mut impl Iterator<Item = TestRequest>) {
        let Some(((service, text), call)) = &mut self.call else {
            let Some((service, text)) = next.next() else { return };
            let request = format!("{service}{text}");
            let (id, request) = (self.ids[service], CncStr::new(&request).unwrap());
            let call = ServiceCall::new(id, request, SysServiceWait::default()).unwrap();
            self.asked[service] += 1;
            self.call = Some(((service, text), call));
            return;
        };
        match call.step() {
            CallStep::Read(variable) => call.read(self.interface.read(variable), NOW).unwrap(),
            CallStep::Write(variable, value) => {
                (self.mutation.write)(&mut self.interface, variable, value);
                call.written(NOW);
            }
            CallStep::Wait { .. } => call.poll(),
            CallStep::Done { state, response } => {
                if self.strict {
                    let (service, times) = (*service, self.asked[*service]);
                    let wanted = Self::answer(service, &format!("{service}{text}"), times);
                    assert_eq!((state, response), (7, CncStr::new(&wanted).unwrap()));
                    assert_eq!(self.served, self.asked);
                }
                self.call = None;
            }
            CallStep::TimedOut => unreachable!("there is no maximum wait"),
        }
    }

    fn host(&mut self, place: usize, outcome: StepOutcome) {
        let place = place % self.hosts.len();
        let host = &mut self.hosts[place];
        match host.step() {
            HostStep::Read(_) | HostStep::Wait if outcome != StepOutcome::Fine => {
                (self.mutation.failed)(host)
            }
            HostStep::Read(variable) => host.read(self.interface.read(variable)).unwrap(),
            HostStep::Wait => host.poll(),
            HostStep::Write(variable, value) => {
                if outcome != StepOutcome::Fails {
                    (self.mutation.write)(&mut self.interface, variable, value);
                }
                if outcome == StepOutcome::Fine {
                    host.written()
                } else {
                    (self.mutation.failed)(host)
                }
            }
            HostStep::Serve { uuid, request, .. } => {
                let service = self.ids.iter().position(|id| id == uuid).unwrap();
                let request = request.to_string();
                let service = (self.mutation.asked)(service, &request);
                if self.strict {
                    // SVC-2: the program has just sent this request to this service.
                    let ((asked, text), _) = self.call.as_ref().expect("somebody asks");
                    assert_eq!((*asked, format!("{asked}{text}")), (service, request.clone()));
                }
                self.served[service] += 1;
                let answer = Self::answer(service, &request, self.served[service]);
                host.answer(CncStr::new(&answer).unwrap(), 7).unwrap();
            }
        }
    }

    pub(crate) fn act(&mut self, action: Action, next: &mut impl Iterator<Item = TestRequest>) {
        match action {
            Action::Program => self.program(next),
            Action::Host(place, outcome) => self.host(place, outcome),
            Action::GiveUp => self.call = None,
            Action::ResetCnc => {
                self.call = None;
                self.interface.reset();
            }
            Action::Restart(place) => {
                let place = place % self.hosts.len();
                (self.mutation.restart)(&mut self.hosts[place]);
            }
        }
    }

    /// Only for runs with two independent hosts, which the caller ensures. Changes a failing write
    /// of RESPONSE_STATE that arrives into one that does not arrive. Otherwise, the host could not
    /// distinguish its own request from a later request that the other host is about to answer.
    pub(crate) fn luck_of_two(&self, action: Action) -> Action {
        let Action::Host(place, StepOutcome::FailsLate) = action else { return action };
        match self.hosts[place % self.hosts.len()].step() {
            HostStep::Write(ServiceVariable::ResponseState, _) => {
                Action::Host(place, StepOutcome::Fails)
            }
            _ => action,
        }
    }

    /// Lets the program give up, and the hosts execute steps in turn until they are idle. From then on,
    /// each response must be right.
    pub(crate) fn settle(&mut self) {
        self.call = None;
        // After about twenty steps a host is idle: then it only reads REQUEST_STATE and waits.
        let mut calm = 0;
        for round in 0.. {
            assert!(round < 200, "the hosts do not come to rest");
            let before = (self.interface.clone(), self.served.clone());
            for place in 0..self.hosts.len() {
                self.host(place, StepOutcome::Fine);
            }
            let same = before == (self.interface.clone(), self.served.clone());
            calm = if same { calm + 1 } else { 0 };
            // A host that is not idle executes at most 12 reads without a write.
            if calm > 12 {
                break;
            }
        }
        for place in 0..self.hosts.len() {
            let steps = (0..10).find(|_| {
                let waits = self.hosts[place].step() == HostStep::Wait;
                if !waits {
                    self.host(place, StepOutcome::Fine);
                }
                waits
            });
            assert!(steps.is_some(), "host {place} does not come to rest");
        }
        (self.strict, self.asked) = (true, self.served.clone());
    }

    /// Lets the program and the hosts execute steps in turn until the program has all responses.
    pub(crate) fn finish(&mut self, next: &mut impl Iterator<Item = TestRequest>) {
        let mut idle = 0;
        for _ in 0..2000 {
            self.program(next);
            (0..self.hosts.len()).for_each(|place| self.host(place, StepOutcome::Fine));
            // The program has no more requests if it sends none for several steps. In these steps, a
            // host may still complete the last response.
            idle = if self.call.is_none() { idle + 1 } else { 0 };
            if idle > 12 {
                break;
            }
        }
        assert!(self.call.is_none(), "the program still waits");
        assert!(next.next().is_none());
    }
}
