//! Writes an NC program to the program stream of a channel.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::address::Channel;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::{Ack, NcText};
use serde_json::Value;

use super::ClientFault;
use super::connection::Connection;
use super::error::ActionError;
use crate::client_suite::message::DONE;

/// Pause before the client repeats a packet, or reads a state again.
pub(super) const PAUSE: Duration = Duration::from_millis(10);

/// Maximum time for which the client repeats a packet that the CNC rejects as busy, and for which
/// it waits for the response to a request over the Service Interface.
pub(super) const WAIT_MAX: Duration = Duration::from_secs(10);

pub(super) fn stream(
    wire: &mut Connection,
    channel: Channel,
    file: &str,
) -> Result<Value, ActionError> {
    let program = fs::read(file)?;
    let packets = packets(wire.fault, &program)?;
    for packet in packets {
        let begun = Instant::now();
        loop {
            let write = WriteProgramStream::new(channel, &packet);
            let ack = match wire.call(&write, &mut Vec::new()) {
                Ok(_) => break,
                Err(ActionError::Rejected(error)) => (Ack::from_result(error), error),
                Err(fail) => return Err(fail),
            };
            match ack {
                (Ack::Busy, _) if wire.has(ClientFault::StreamSkips) => break,
                (Ack::Busy, _) if begun.elapsed() < WAIT_MAX => thread::sleep(PAUSE),
                (_, error) => return Err(ActionError::Rejected(error)),
            }
        }
    }
    Ok(DONE)
}

/// Splits a program into packets; some defects split it wrongly.
fn packets(fault: Option<ClientFault>, program: &[u8]) -> Result<Vec<Vec<u8>>, ActionError> {
    let is = |one: ClientFault| fault == Some(one);
    if is(ClientFault::StreamAny) || is(ClientFault::StreamLine) {
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
    Ok(match fault {
        Some(ClientFault::StreamSplit) => whole.chunks(500).map(<[u8]>::to_vec).collect(),
        Some(ClientFault::StreamLineFeed) => {
            let without =
                |packet: &Vec<u8>| packet.iter().copied().filter(|&byte| byte != b'\r').collect();
            packets.iter().map(without).collect()
        }
        Some(ClientFault::StreamUnended) => {
            if let Some(last) = packets.last_mut() {
                last.truncate(last.len().saturating_sub(2));
            }
            packets
        }
        Some(ClientFault::StreamNul) => {
            packets.iter_mut().for_each(|packet| packet.push(0));
            packets
        }
        Some(ClientFault::StreamOrder) => {
            if let [first, second, ..] = packets.as_mut_slice() {
                std::mem::swap(first, second);
            }
            packets
        }
        Some(ClientFault::LineByLine) => text_lines(&whole),
        _ => packets,
    })
}

fn text_lines(wire: &[u8]) -> Vec<Vec<u8>> {
    wire.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect()
}
