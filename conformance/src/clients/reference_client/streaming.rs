//! Writes an NC program into the stream of a channel.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::address::Channel;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::{Ack, NcText};
use serde_json::Value;

use super::Flaw;
use super::error::Fail;
use super::wire::Connection;
use crate::clients::message::DONE;

/// Interval of polling.
pub(super) const PAUSE: Duration = Duration::from_millis(10);

/// How long a packet is repeated, and how long it waits for a response.
pub(super) const PATIENCE: Duration = Duration::from_secs(10);

pub(super) fn stream(wire: &mut Connection, channel: Channel, file: &str) -> Result<Value, Fail> {
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

/// The packets of a program.
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
