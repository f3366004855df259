//! A channel with the five variables of the Service Interface, through which an NC program and services
//! communicate.

use std::time::Duration;

use ads_cnc::CncStr;
use ads_cnc::service::ServiceVariable::{Request, RequestState, Uuid};
use ads_cnc::service::*;
use ads_cnc_conformance::simulator::program::service::*;

pub(crate) const ROOT: &str = "560AACBF-6335-44a9-895A-8B27F3ED5E47";
pub(crate) const COMMAND: &str = "19719079-BA06-4740-BC02-DE5215211751";

pub(crate) fn id(text: &str) -> ServiceId {
    ServiceId::new(text).unwrap()
}

pub(crate) fn text(text: &str) -> CncStr<'_> {
    CncStr::new(text).unwrap()
}

pub(crate) fn millis(millis: u64) -> Duration {
    Duration::from_millis(millis)
}

/// The interface of a channel, with a record of the writes to it.
#[derive(Default)]
pub(crate) struct Channel {
    pub(crate) interface: ServiceInterface,
    pub(crate) written: Vec<(ServiceVariable, Vec<u8>)>,
}

impl Channel {
    pub(crate) fn with(clears: Clears) -> Self {
        Self { interface: ServiceInterface::with(clears), written: Vec::new() }
    }

    pub(crate) fn write(&mut self, variable: ServiceVariable, value: &[u8]) {
        self.interface.write(variable, value).unwrap();
        self.written.push((variable, value.to_vec()));
    }

    /// Writes a request in the order in which an NC program writes it, and clears the record of writes.
    pub(crate) fn ask(&mut self, uuid: &str, request: &str) {
        self.write(Uuid, format!("{uuid}\0").as_bytes());
        self.write(Request, format!("{request}\0").as_bytes());
        self.write(RequestState, &[1, 0, 0, 0]);
        self.written.clear();
    }

    /// Executes the next step of a host, unless it is to serve a request, and returns the kind of the step.
    pub(crate) fn step(&mut self, host: &mut Host<'_>) -> HostEvent {
        match host.step() {
            HostStep::Read(variable) => {
                host.read(self.interface.read(variable)).unwrap();
                HostEvent::Read(variable)
            }
            HostStep::Write(variable, value) => {
                self.write(variable, value);
                host.written();
                HostEvent::Write(variable)
            }
            HostStep::Serve { .. } => HostEvent::Serve,
            HostStep::Wait => {
                host.poll();
                HostEvent::Wait
            }
        }
    }

    /// Executes steps of a host until the next step is not a read; returns the kind of that step.
    pub(crate) fn skip_reads(&mut self, host: &mut Host<'_>) -> HostEvent {
        for _ in 0..50 {
            match host.step() {
                HostStep::Read(_) => self.step(host),
                HostStep::Write(variable, _) => return HostEvent::Write(variable),
                HostStep::Serve { .. } => return HostEvent::Serve,
                HostStep::Wait => return HostEvent::Wait,
            };
        }
        panic!("reads and reads: {:?}", host.step());
    }

    /// Executes steps of a host until the next step is a write of this variable.
    pub(crate) fn reach(&mut self, host: &mut Host<'_>, variable: ServiceVariable) {
        let there = (0..50).any(|_| {
            let there = self.skip_reads(host) == HostEvent::Write(variable);
            if !there {
                self.step(host);
            }
            there
        });
        assert!(there, "{variable} is not written: {:?}", host.step());
    }

    /// Executes steps up to and including the first wait of the host.
    pub(crate) fn rest(&mut self, host: &mut Host<'_>) {
        assert!((0..50).any(|_| self.step(host) == HostEvent::Wait), "{:?}", host.step());
    }

    /// Polls for a request, serves it and executes steps up to the next wait; returns whether a request was
    /// found.
    pub(crate) fn serve(
        &mut self,
        host: &mut Host<'_>,
        service: impl Fn(&str) -> (String, u32),
    ) -> bool {
        host.poll();
        if self.skip_reads(host) != HostEvent::Serve {
            return false;
        }
        let HostStep::Serve { request, .. } = host.step() else { unreachable!() };
        let (response, state) = service(&request.to_string());
        host.answer(text(&response), state).unwrap();
        self.rest(host);
        true
    }

    /// Executes the steps of the program up to a wait or the end; returns the outcome if the program ended.
    pub(crate) fn run(
        &mut self,
        call: &mut ServiceCall,
        now: Duration,
    ) -> Option<Result<(u32, String), ()>> {
        call.poll();
        loop {
            match call.step() {
                CallStep::Read(variable) => call.read(self.interface.read(variable), now).unwrap(),
                CallStep::Write(variable, value) => {
                    self.write(variable, value);
                    call.written(now);
                }
                CallStep::Wait { .. } => return None,
                CallStep::Done { state, response } => {
                    return Some(Ok((state, response.to_string())));
                }
                CallStep::TimedOut => return Some(Err(())),
            }
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum HostEvent {
    Read(ServiceVariable),
    Write(ServiceVariable),
    Serve,
    Wait,
}

pub(crate) fn call(uuid: &str, request: &str, parameters: [Option<u32>; 3]) -> ServiceCall {
    let [p1, p2, p3] = parameters;
    let wait = SysServiceWait::from_parameters(p1, p2, p3).unwrap();
    ServiceCall::new(id(uuid), text(request), wait).unwrap()
}
