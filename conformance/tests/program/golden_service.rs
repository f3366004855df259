//! The golden sequences of the Service Interface without a wire: with a script as the program, and with
//! a single request.

use std::collections::BTreeMap;
use std::time::Duration;

use ads_cnc::CncString;
use ads_cnc::service::ServiceVariable;
use ads_cnc_conformance::simulator::program::service::*;
use ads_cnc_conformance::simulator::program::{ServiceOutcome, ServiceRequest, Wait};
use ads_cnc_conformance::suite::replay::*;
use ads_cnc_vectors::Given;

use crate::{cases, stated_fault};

/// The cases that say when the interface sets REQUEST_STATE to 0 of itself.
const ABOUT_CLEARING: [&str; 2] = ["interface-clears", "interface-clears-not"];

fn goes_as_stated<P: RequestingProgram>(
    ask: fn(ServiceRequest) -> Result<P, CallError>,
    clears: Clears,
) {
    for case in cases("service", 50) {
        let Given::Service(given) = &case.given else { unreachable!() };
        if clears == Clears::Never && ABOUT_CLEARING.contains(&case.id.as_str()) {
            continue;
        }
        let mut actor = Interfaces { ask, clears, channels: BTreeMap::new() };
        let fault = play_service(&mut actor, given).expect(&case.id);
        assert_eq!(fault, stated_fault(case), "{}, {clears:?}", case.id);
    }
}

#[test]
fn services_go_as_stated() {
    goes_as_stated(script, Clears::default());
}

#[test]
fn single_requests_go_as_stated() {
    for clears in [Clears::OnResponseState, Clears::Never] {
        goes_as_stated(call, clears);
    }
}

struct Interfaces<P> {
    ask: fn(ServiceRequest) -> Result<P, CallError>,
    clears: Clears,
    channels: BTreeMap<u32, ServiceInterface>,
}

impl<P> Interfaces<P> {
    fn channel(&mut self, channel: u32) -> &mut ServiceInterface {
        self.channels.entry(channel).or_insert_with(|| ServiceInterface::with(self.clears))
    }
}

impl<P: RequestingProgram> ServiceActor for Interfaces<P> {
    type Program = P;

    fn ask(&self, request: ServiceRequest) -> Result<P, CallError> {
        (self.ask)(request)
    }

    fn read(&mut self, channel: u32, variable: ServiceVariable) -> StepResult<Vec<u8>> {
        Ok(self.channel(channel).read(variable).to_vec())
    }

    fn write(
        &mut self,
        channel: u32,
        variable: ServiceVariable,
        value: &[u8],
    ) -> StepResult<Option<&'static str>> {
        let error = self.channel(channel).write(variable, value).err();
        Ok(error.map(|error| fault_class(error.kind())))
    }

    fn with(&mut self, channel: u32, then: impl FnOnce(&mut ServiceInterface)) -> StepResult<()> {
        then(self.channel(channel));
        Ok(())
    }
}

fn call(request: ServiceRequest) -> Result<Call, CallError> {
    let ServiceRequest { uuid, text, state, wait } = request;
    let wait = match wait {
        Wait::Loop => SysServiceWait::default(),
        Wait::Cycle { p1, p2, p3 } => SysServiceWait::from_parameters(p1, p2, p3)?,
    };
    match state {
        1 => ServiceCall::new(uuid, text.as_cnc_str(), wait),
        state => ServiceCall::with_state(uuid, text.as_cnc_str(), state, wait),
    }
    .map(Call)
}

struct Call(ServiceCall);

impl RequestingProgram for Call {
    fn step(&mut self, now: Duration, interface: &mut ServiceInterface) {
        let Self(call) = self;
        call.poll();
        match call.step() {
            CallStep::Read(variable) => call.read(interface.read(variable), now).unwrap(),
            CallStep::Write(variable, value) => {
                interface.write(variable, value).unwrap();
                call.written(now);
            }
            _ => {}
        }
    }

    fn next_step(&self) -> Option<CallStep<'_>> {
        Some(self.0.step())
    }

    fn outcome(&self) -> Option<ServiceOutcome> {
        match self.0.step() {
            CallStep::Done { state, response } => {
                Some(ServiceOutcome::Response { state, text: CncString::from(response) })
            }
            CallStep::TimedOut => Some(ServiceOutcome::TimedOut),
            _ => None,
        }
    }
}
