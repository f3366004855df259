//! Checks of the Service Interface.

use std::time::Duration;

use ads_cnc::CncStr;
use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, WriteByName};
use ads_cnc::service::{ServiceId, ServiceVariable};
use ads_cnc_conformance::simulator::program::{Script, ScriptConfig, ScriptState};

use crate::checks::checks;
use crate::target::{CheckResult, Failed, TestCnc, ensure, same};

checks! {
    a_request_is_over_when_it_is_answered,
    each_variable_is_its_own,
    an_answer_changes_no_other_channel,
    a_program_writes_its_state_last,
}

/// The value of a variable; empty if the read is rejected.
pub(crate) fn read_variable(
    target: &TestCnc,
    channel: u8,
    variable: ServiceVariable,
) -> CheckResult<Vec<u8>> {
    let request = ReadByName::new(Channel::new(channel.into())?, variable.name())?;
    Ok(target.ask(request)?.unwrap_or_default())
}

/// Whether a write is accepted.
pub(crate) fn write_variable(
    target: &TestCnc,
    channel: u8,
    variable: ServiceVariable,
    value: &[u8],
) -> CheckResult<bool> {
    let request = WriteByName::new(Channel::new(channel.into())?, variable.name(), value)?;
    Ok(target.ask(request)?.is_ok())
}

const ONE: [u8; 4] = [1, 0, 0, 0];

const NONE: [u8; 4] = [0; 4];

/// A state whose four bytes all differ, to detect a wrong byte order.
const WIDE: [u8; 4] = [0x63, 0x12, 0x34, 0x56];

const UUID: &[u8] = b"560AACBF-6335-44a9-895A-8B27F3ED5E47\0";

/// The value of a variable; for a text, up to and including its first NUL.
fn value(target: &TestCnc, channel: u8, variable: ServiceVariable) -> CheckResult<Vec<u8>> {
    let mut value = read_variable(target, channel, variable)?;
    if !matches!(variable, ServiceVariable::RequestState | ServiceVariable::ResponseState) {
        let len = value.iter().take_while(|byte| **byte != 0).count();
        value.truncate(len + 1);
    }
    Ok(value)
}

/// Ends the NC program of the model, resets the interface, and writes these values without ADS.
fn alone(target: &TestCnc, channel: u8, values: &[(ServiceVariable, &[u8])]) -> CheckResult {
    target.cnc().set_script(channel, None)?;
    target.cnc().with_service(channel, |service| {
        service.reset();
        values.iter().try_for_each(|(variable, value)| service.write(*variable, value))
    })??;
    Ok(())
}

/// Two requests one after the other: the write of a response state ends the request, and a new
/// request resets the response state.
fn a_request_is_over_when_it_is_answered(target: &TestCnc) -> CheckResult {
    use ServiceVariable::{Request, RequestState, Response, ResponseState};
    alone(target, 1, &[])?;
    for request in [ONE, [2, 0, 0, 0]] {
        for (variable, new) in [(Request, &b"1\0"[..]), (RequestState, &request)] {
            ensure(write_variable(target, 1, variable, new)?, "a write is rejected")?;
        }
        same("the state of the response before", value(target, 1, ResponseState)?, NONE.to_vec())?;
        ensure(write_variable(target, 1, Response, b"one\0")?, "the response is rejected")?;
        same("the state of the request", value(target, 1, RequestState)?, request.to_vec())?;
        ensure(write_variable(target, 1, ResponseState, &ONE)?, "the state is rejected")?;
        same("the state of the request", value(target, 1, RequestState)?, NONE.to_vec())?;
        same("the state of the response", value(target, 1, ResponseState)?, ONE.to_vec())?;
    }
    Ok(())
}

/// A write changes only its own variable, and a shorter text replaces the whole previous text.
fn each_variable_is_its_own(target: &TestCnc) -> CheckResult {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    alone(target, 1, &[])?;
    let mut all: Vec<(ServiceVariable, &[u8])> = Vec::new();
    for (variable, before, new) in [
        (RequestState, &NONE[..], &NONE[..]),
        (Uuid, b"a longer text than it is a UUID of a service\0", UUID),
        (Request, b"a longer request\0", b"the request\0"),
        (Response, b"a longer response\0", b"the response\0"),
        (ResponseState, &ONE, &WIDE),
    ] {
        for new in [before, new] {
            ensure(write_variable(target, 1, variable, new)?, variable.name())?;
        }
        all.push((variable, new));
        for &(one, expected) in &all {
            same(one.name(), value(target, 1, one)?, expected.to_vec())?;
        }
    }
    Ok(())
}

/// Two channels have a request; writes to the variables of one channel do not change the variables
/// of the other.
fn an_answer_changes_no_other_channel(target: &TestCnc) -> CheckResult {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let held: [(ServiceVariable, &[u8]); 4] = [
        (Uuid, UUID),
        (Request, b"asked here\0"),
        (Response, b"answered here\0"),
        (RequestState, &ONE),
    ];
    let all = target.channels();
    for &asking in &all {
        for &answered in all.iter().filter(|other| **other != asking) {
            alone(target, asking, &held)?;
            alone(target, answered, &held)?;
            for (written, new) in [
                (Uuid, &b"other\0"[..]),
                (Request, b"other\0"),
                (Response, b"other\0"),
                (ResponseState, &WIDE),
                (RequestState, &NONE),
            ] {
                ensure(write_variable(target, answered, written, new)?, written.name())?;
                for (variable, expected) in held {
                    let what = format!("{} in channel {asking}", variable.name());
                    same(what, value(target, asking, variable)?, expected.to_vec())?;
                }
            }
        }
    }
    Ok(())
}

/// REQUEST_STATE is 0 until UUID and REQUEST have the values of the program's request.
fn a_program_writes_its_state_last(target: &TestCnc) -> CheckResult {
    use ServiceVariable::{Request, RequestState, Uuid};
    let config = ScriptConfig::square_root()?;
    let asked = config.requests.first().cloned();
    let asked = asked.ok_or_else(|| Failed("no request".to_owned()))?;
    let mut script = target.cnc().as_run(Script::new(config)?);
    // The variables contain the values of an earlier request.
    alone(target, 1, &[(Uuid, b"other\0"), (Request, b"other\0")])?;
    while script.state() == ScriptState::Asking(0) {
        target.cnc().with_service(1, |service| script.step(Duration::ZERO, service))?;
        let (uuid, request) = (value(target, 1, Uuid)?, value(target, 1, Request)?);
        let uuid = uuid.strip_suffix(b"\0").unwrap_or_default();
        let own = CncStr::from_bytes(uuid).and_then(ServiceId::from_text) == Ok(asked.uuid);
        let is_there = own && request.strip_suffix(b"\0") == Some(asked.text.as_bytes());
        let state = value(target, 1, RequestState)?;
        ensure(is_there || state == NONE, format_args!("state {state:?}, request {request:02x?}"))?;
    }
    Ok(())
}
