//! Both sides of the Service Interface: a service, and an NC program that uses it.

use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, WriteByName};
use ads_cnc::service::{ServiceId, ServiceVariable};
use serde_json::Value;

use super::ClientFault;
use super::connection::Connection;
use super::error::ActionError;
use super::streaming::{PAUSE, WAIT_MAX};
use crate::values::until_nul;

fn read(
    wire: &mut Connection,
    channel: Channel,
    variable: ServiceVariable,
) -> Result<Vec<u8>, ActionError> {
    let mut reply = Vec::new();
    let read = ReadByName::new(channel, variable.name())?;
    Ok(wire.call(&read, &mut reply)?.bytes.to_vec())
}

fn write(
    wire: &mut Connection,
    channel: Channel,
    variable: ServiceVariable,
    value: &[u8],
) -> Result<(), ActionError> {
    let write = WriteByName::new(channel, variable.name(), value)?;
    wire.call(&write, &mut Vec::new()).map(drop)
}

/// Acts as the service with this UUID, which responds to a request with the text of the request.
/// Responds to at most `requests` requests, and to none after `seconds` seconds. Returns the number
/// of responses.
pub(super) fn serve(
    wire: &mut Connection,
    channel: Channel,
    uuid: &str,
    requests: u32,
    seconds: f64,
) -> Result<Value, ActionError> {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let own = ServiceId::new(uuid)?;
    let limit = Duration::try_from_secs_f64(seconds)?;
    let (begun, mut answered) = (Instant::now(), 0_u32);
    while answered < requests && begun.elapsed() < limit {
        let state = read(wire, channel, RequestState)?;
        let is_request = state.iter().any(|&byte| byte != 0) || wire.has(ClientFault::ServiceIdle);
        let asked = read(wire, channel, Uuid)?;
        let asked =
            std::str::from_utf8(until_nul(&asked)).ok().and_then(|id| ServiceId::new(id).ok());
        if !is_request || asked != Some(own) && !wire.has(ClientFault::ServiceAny) {
            thread::sleep(PAUSE);
            continue;
        }
        let request = read(wire, channel, Request)?;
        let mut response = until_nul(&request).to_vec();
        let mut len = response.len().saturating_add(1);
        if wire.has(ClientFault::ServiceText) {
            len = 200;
        }
        response.resize(len, 0);
        let one = [if wire.has(ClientFault::ServiceZero) { 0 } else { 1 }, 0, 0, 0];
        let mut writes =
            [(Response, response.as_slice()), (RequestState, &[0; 4]), (ResponseState, &one)];
        match wire.fault {
            Some(ClientFault::ServiceOrder) => writes.swap(0, 2),
            Some(ClientFault::ServiceClears) => writes.swap(1, 2),
            _ => {}
        }
        for (variable, value) in writes {
            write(wire, channel, variable, value)?;
        }
        answered = answered.saturating_add(1);
    }
    Ok(answered.into())
}

/// Acts as the NC program: sends a request to a service, and waits for the response.
pub(super) fn ask(
    wire: &mut Connection,
    channel: Channel,
    uuid: &str,
    request: &str,
) -> Result<Value, ActionError> {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let with_nul = |text: &str| [text.as_bytes(), b"\0"].concat();
    let (uuid, request) = (with_nul(uuid), with_nul(request));
    let mut writes: [(ServiceVariable, &[u8]); 3] =
        [(Uuid, &uuid), (Request, &request), (RequestState, &[1, 0, 0, 0])];
    if wire.has(ClientFault::CallerOrder) {
        writes.rotate_right(1);
    }
    for (variable, value) in writes {
        write(wire, channel, variable, value)?;
    }
    let begun = Instant::now();
    while !wire.has(ClientFault::CallerWaits) {
        if read(wire, channel, ResponseState)?.iter().any(|&byte| byte != 0) {
            break;
        }
        if begun.elapsed() > WAIT_MAX {
            return Err("no response within the time limit".into());
        }
        thread::sleep(PAUSE);
    }
    let response = read(wire, channel, Response)?;
    Ok(String::from_utf8_lossy(until_nul(&response)).into_owned().into())
}
