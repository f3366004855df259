//! What takes more than a question: NC programs and services.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::address::Channel;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::{ReadByName, WriteByName, WriteProgramStream};
use ads_cnc::service::{ServiceId, ServiceVariable};
use ads_cnc::streaming::{Ack, NcText};
use serde_json::Value;

use super::wire::{Fail, Wire};
use super::{DONE, Flaw};
use crate::values::until_nul;

/// From one look to the next.
const PAUSE: Duration = Duration::from_millis(10);

/// How long it writes a packet again, and waits for a response.
const PATIENCE: Duration = Duration::from_secs(10);

pub(super) fn stream(wire: &mut Wire, channel: Channel, file: &str) -> Result<Value, Fail> {
    let program = fs::read(file)?;
    let packets = packets(wire.flaw, &program)?;
    for packet in packets {
        let begun = Instant::now();
        loop {
            let write = WriteProgramStream::new(channel, &packet);
            let ack = match wire.call(&write, &mut Vec::new()) {
                Ok(_) => break,
                Err(Fail::Refused(error)) => (Ack::from_result(error), error),
                Err(fail) => return Err(fail),
            };
            match ack {
                (Ack::Busy, _) if wire.has(Flaw::StreamSkips) => break,
                (Ack::Busy, _) if begun.elapsed() < PATIENCE => thread::sleep(PAUSE),
                (_, error) => return Err(Fail::Refused(error)),
            }
        }
    }
    Ok(DONE)
}

/// What is written, packet by packet.
fn packets(flaw: Option<Flaw>, program: &[u8]) -> Result<Vec<Vec<u8>>, Fail> {
    let is = |one: Flaw| flaw == Some(one);
    if is(Flaw::StreamAny) || is(Flaw::StreamLine) {
        return Ok(program.chunks(STREAM_PACKET_MAX).map(<[u8]>::to_vec).collect());
    }
    let text = NcText::new(program)?;
    if let Some(finding) = text.diagnostics().find(|finding| finding.kind.ends_streaming()) {
        return Err(finding.into());
    }
    let (mut packets, mut buf) = (Vec::new(), [0; STREAM_PACKET_MAX]);
    let mut cut = text.packets();
    while let Some(packet) = cut.next_into(&mut buf) {
        packets.push(packet.to_vec());
    }
    let whole = packets.concat();
    Ok(match flaw {
        Some(Flaw::StreamSplit) => whole.chunks(500).map(<[u8]>::to_vec).collect(),
        Some(Flaw::StreamLineFeed) => {
            let without =
                |packet: &Vec<u8>| packet.iter().copied().filter(|&byte| byte != b'\r').collect();
            packets.iter().map(without).collect()
        }
        Some(Flaw::StreamUnended) => {
            if let Some(last) = packets.last_mut() {
                last.truncate(last.len().saturating_sub(2));
            }
            packets
        }
        Some(Flaw::StreamNul) => {
            packets.iter_mut().for_each(|packet| packet.push(0));
            packets
        }
        Some(Flaw::StreamOrder) => {
            if let [first, second, ..] = packets.as_mut_slice() {
                std::mem::swap(first, second);
            }
            packets
        }
        Some(Flaw::LineByLine) => text_lines(&whole),
        _ => packets,
    })
}

fn text_lines(wire: &[u8]) -> Vec<Vec<u8>> {
    wire.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect()
}

fn read(wire: &mut Wire, channel: Channel, variable: ServiceVariable) -> Result<Vec<u8>, Fail> {
    let mut reply = Vec::new();
    let read = ReadByName::new(channel, variable.name())?;
    Ok(wire.call(&read, &mut reply)?.bytes.to_vec())
}

fn write(
    wire: &mut Wire,
    channel: Channel,
    variable: ServiceVariable,
    value: &[u8],
) -> Result<(), Fail> {
    let write = WriteByName::new(channel, variable.name(), value)?;
    wire.call(&write, &mut Vec::new()).map(drop)
}

/// A service that answers with what it is asked.
pub(super) fn serve(
    wire: &mut Wire,
    channel: Channel,
    uuid: &str,
    requests: u32,
    seconds: f64,
) -> Result<Value, Fail> {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let own = ServiceId::new(uuid)?;
    let limit = Duration::try_from_secs_f64(seconds)?;
    let (begun, mut answered) = (Instant::now(), 0_u32);
    while answered < requests && begun.elapsed() < limit {
        let state = read(wire, channel, RequestState)?;
        let is_request = state.iter().any(|&byte| byte != 0) || wire.has(Flaw::ServiceIdle);
        let asked = read(wire, channel, Uuid)?;
        let asked =
            std::str::from_utf8(until_nul(&asked)).ok().and_then(|id| ServiceId::new(id).ok());
        if !is_request || asked != Some(own) && !wire.has(Flaw::ServiceAny) {
            thread::sleep(PAUSE);
            continue;
        }
        let request = read(wire, channel, Request)?;
        let mut response = until_nul(&request).to_vec();
        let mut len = response.len().saturating_add(1);
        if wire.has(Flaw::ServiceText) {
            len = 200;
        }
        response.resize(len, 0);
        let one = [if wire.has(Flaw::ServiceZero) { 0 } else { 1 }, 0, 0, 0];
        let mut writes =
            [(Response, response.as_slice()), (RequestState, &[0; 4]), (ResponseState, &one)];
        match wire.flaw {
            Some(Flaw::ServiceOrder) => writes.swap(0, 2),
            Some(Flaw::ServiceClears) => writes.swap(1, 2),
            _ => {}
        }
        for (variable, value) in writes {
            write(wire, channel, variable, value)?;
        }
        answered = answered.saturating_add(1);
    }
    Ok(answered.into())
}

/// Asks a service, as a CNC's program does.
pub(super) fn ask(
    wire: &mut Wire,
    channel: Channel,
    uuid: &str,
    request: &str,
) -> Result<Value, Fail> {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let with_nul = |text: &str| [text.as_bytes(), b"\0"].concat();
    let (uuid, request) = (with_nul(uuid), with_nul(request));
    let mut writes: [(ServiceVariable, &[u8]); 3] =
        [(Uuid, &uuid), (Request, &request), (RequestState, &[1, 0, 0, 0])];
    if wire.has(Flaw::CallerOrder) {
        writes.rotate_right(1);
    }
    for (variable, value) in writes {
        write(wire, channel, variable, value)?;
    }
    let begun = Instant::now();
    while !wire.has(Flaw::CallerWaits) {
        if read(wire, channel, ResponseState)?.iter().any(|&byte| byte != 0) {
            break;
        }
        if begun.elapsed() > PATIENCE {
            return Err("no response in time".into());
        }
        thread::sleep(PAUSE);
    }
    let response = read(wire, channel, Response)?;
    Ok(String::from_utf8_lossy(until_nul(&response)).into_owned().into())
}
