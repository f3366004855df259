//! The simulated CNC under load for a limited time: clients with mixed operations, a long NC program
//! with a slow decoder, and malformed frames in parallel with a working client.
//!
//! ```text
//! cargo run --release -p ads-cnc-load --bin soak [SECONDS [FRAMES [MEGABYTES]]]
//! ```
//!
//! Any failure ends the program with an error. The seed of the malformed frames is fixed.

#![allow(clippy::disallowed_methods, reason = "clients of a server in this process")]

use std::error::Error;
use std::fmt::Write as _;
use std::io::{Read as _, Write as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::Kind;
use ads_cnc::address::{Channel, Class, ElementAddress};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::*;
use ads_cnc::streaming::{Ack, NcText, Sender};
use ads_cnc_conformance::client::Target;
use ads_cnc_conformance::gate::{Allowed, Gate};
use ads_cnc_conformance::number::digest;
use ads_cnc_conformance::session::{Session, ToolError};
use ads_cnc_conformance::simulator::program::{Pace, ProgramConfig};
use ads_cnc_conformance::simulator::{Cnc, NET_ID, Server};

type Result<T> = std::result::Result<T, Box<dyn Error + Send + Sync>>;

/// Request for the number of V.E variables of channel 1: ReadWrite at 0x122301, 0x44.
const REQUEST: &[u8] = b"\0\0\x34\0\0\0\x7f\0\0\x01\x01\x01\x28\x02\x7f\0\0\x01\x01\x02\x01\x80\
    \x09\0\x04\0\x14\0\0\0\0\0\0\0\x07\0\0\0\x01\x23\x12\0\x44\0\0\0\x04\0\0\0\x04\0\0\0V.E\0";

fn main() -> Result<()> {
    let mut args = std::env::args().skip(1);
    let seconds: u64 = args.next().map_or(Ok(60), |text| text.parse())?;
    let frames: u64 = args.next().map_or(Ok(100_000), |text| text.parse())?;
    let megabytes: usize = args.next().map_or(Ok(10), |text| text.parse())?;

    let cnc = Arc::new(Cnc::with_default_model().map_err(|error| error.to_string())?);
    let listener = TcpListener::bind(SocketAddr::from(([127, 0, 0, 1], 0)))?;
    let server = Server::start(listener, cnc.clone())?;
    mixed(server.addr(), Duration::from_secs(seconds))?;
    malformed(server.addr(), frames)?;
    streamed(&cnc, server.addr(), megabytes)?;
    Ok(())
}

fn session(addr: SocketAddr, tables: &str) -> Result<Session> {
    let file = format!("target = \"{NET_ID}\"\nexpires = 9999-12-31T23:59:59Z\n{tables}");
    let allowed = Allowed::from_toml(&file).map_err(|error| error.to_string())?;
    let gate = Gate::queries().with_allowed(Some(allowed));
    Session::connect(Target::local(addr, NET_ID), gate).map_err(|error| error.to_string().into())
}

/// Runs eight clients for this time; each writes its own variable and reads it back.
fn mixed(addr: SocketAddr, time: Duration) -> Result<()> {
    const NAMES: [&str; 8] = [
        "V.E.sgn32",
        "V.E.test[0]",
        "V.E.test[1]",
        "V.E.test[2]",
        "V.E.test[3]",
        "V.E.test[4]",
        "V.E.array_sgn32[0]",
        "V.E.array_sgn32[1]",
    ];
    let (begun, warm) = (Instant::now(), Duration::from_secs(1).min(time / 4));
    let operations = thread::scope(|scope| {
        let clients: Vec<_> = NAMES
            .into_iter()
            .map(|name| scope.spawn(move || client(addr, name, begun + time)))
            .collect();
        thread::sleep(warm);
        let before = resident();
        let done: Result<Vec<u64>> =
            clients.into_iter().map(|client| client.join().expect("no client panics")).collect();
        Ok::<_, Box<dyn Error + Send + Sync>>((done?.iter().sum::<u64>(), before, resident()))
    })?;
    let (count, before, after) = operations;
    match (before, after) {
        (Some(before), Some(after)) => {
            println!(
                "8 clients, {time:?}: {count} operations, {before} KiB resident, then {after}"
            );
            if after > before + 8 * 1024 {
                return Err(format!("{} KiB more than before", after - before).into());
            }
        }
        _ => println!("8 clients, {time:?}: {count} operations; memory is not measured here"),
    }
    Ok(())
}

fn client(addr: SocketAddr, name: &str, end: Instant) -> Result<u64> {
    let mut cnc = session(addr, &format!("[[variable]]\nchannel = 1\nname = \"{name}\"\n"))?;
    let failed = |trouble: ToolError| format!("{name}: {trouble}");
    let channel = Channel::new(1)?;
    let element = ElementAddress::for_channel(channel, Class::Hld, 1)?;
    let mut count = 0_u64;
    while Instant::now() < end {
        let value = (count as i32).to_le_bytes();
        cnc.call(&WriteByName::new(channel, name, &value[..])?).map_err(failed)?;
        let read = cnc.call(&ReadByName::new(channel, name)?).map_err(failed)?;
        if read.bytes != value {
            return Err(format!("{name}: {value:?} written, {:?} read", read.bytes).into());
        }
        let index = (count % 123) as u32;
        cnc.call(&DescribeByIndex::new(channel, index, Kind::V_E)).map_err(failed)?;
        cnc.call(&CountVariables::new(channel, Kind::ALL)).map_err(failed)?;
        cnc.call(&ReadDescriptors::new(channel, 1, 10)?).map_err(failed)?;
        cnc.call(&ReadElementName::new(element)).map_err(failed)?;
        cnc.call(&FindInstance::new(Class::Decoder, 1, 2)).map_err(failed)?;
        cnc.call(&CountDynamic::new(channel, DynamicKind::P)).map_err(failed)?;
        count += 8;
    }
    Ok(count)
}

/// Resident memory of this process in KiB, if the system provides it.
fn resident() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// Sends malformed frames, and checks that another client gets correct replies at the same time.
fn malformed(addr: SocketAddr, frames: u64) -> Result<()> {
    let over = AtomicBool::new(false);
    let (asked, connections) = thread::scope(|scope| {
        let undisturbed = scope.spawn(|| {
            let mut cnc = session(addr, "")?;
            let (channel, mut asked) = (Channel::new(1)?, 0_u64);
            while !over.load(Ordering::Relaxed) {
                let count = cnc.call(&CountVariables::new(channel, Kind::V_E));
                let count = count.map_err(|trouble| trouble.to_string())?.0;
                if count != 123 {
                    return Err(format!("{count} variables").into());
                }
                asked += 1;
            }
            Ok::<u64, Box<dyn Error + Send + Sync>>(asked)
        });
        let disturbed = disturb(addr, frames);
        over.store(true, Ordering::Relaxed);
        let asked = undisturbed.join().expect("no client panics")?;
        Ok::<_, Box<dyn Error + Send + Sync>>((asked, disturbed?))
    })?;
    println!(
        "{frames} malformed frames over {connections} connections, {asked} answers beside them"
    );
    if asked == 0 { Err("the other client was not answered".into()) } else { Ok(()) }
}

/// Sends `frames` frames with random changes, which make nearly all of them malformed; returns the
/// number of connections that this needs.
fn disturb(addr: SocketAddr, frames: u64) -> Result<u64> {
    // The generator of Numerical Recipes, for the same frames each time.
    let mut state = 0x5EED_u32;
    let mut random = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        state >> 8
    };
    let mut connections = 0;
    let mut sent = 0;
    while sent < frames {
        connections += 1;
        let mut stream = TcpStream::connect(addr)?;
        stream.set_read_timeout(Some(Duration::from_millis(1)))?;
        while sent < frames {
            let mut frame = REQUEST.to_vec();
            // Most frames have wrong bytes after the headers and are answered. On average, 3 of 64
            // frames have a wrong length, are truncated, or are noise; after such a frame, this
            // client disconnects.
            match random() % 64 {
                0 => frame[2..6].copy_from_slice(&random().to_le_bytes()),
                1 => frame.truncate(random() as usize % REQUEST.len()),
                2 => frame.iter_mut().for_each(|byte| *byte = random() as u8),
                _ => {
                    for _ in 0..1 + random() % 4 {
                        let place = 38 + random() as usize % (frame.len() - 38);
                        frame[place] = random() as u8;
                    }
                }
            }
            let framed = frame.len() == REQUEST.len() && frame[..6] == REQUEST[..6];
            sent += 1;
            if stream.write_all(&frame).is_err() {
                break;
            }
            if !framed {
                break;
            }
            // Read available bytes, so that neither side waits for the other.
            let _nothing_yet = stream.read(&mut [0; 4096]);
        }
    }
    Ok(connections)
}

/// Streams a long program to a decoder that is slower than the sender.
fn streamed(cnc: &Cnc, addr: SocketAddr, megabytes: usize) -> Result<()> {
    let mut program = String::new();
    let mut line = 0_u32;
    while program.len() < megabytes * 1_000_000 {
        line += 1;
        writeln!(program, "N{line} G01 X{} Y-{}.{line} F1000", line % 997, line % 89)?;
    }
    let pace = Pace::bytes_per_second(2_000_000).expect("not 0");
    cnc.set_program(1, ProgramConfig { pace, kept: 4096, ..ProgramConfig::default() })?;
    let mut session = session(addr, "[[stream]]\nchannel = 1\n")?;
    let text = NcText::new(program.as_bytes())?;
    let wire = program.replace('\n', "\r\n");
    let mut sender = Sender::new(text);
    let begun = Instant::now();
    while let Some(packet) = sender.packet() {
        let ack = match session.call(&WriteProgramStream::new(Channel::new(1)?, packet)) {
            Ok(_) => Ack::Accepted,
            Err(ToolError::Ads { error, .. }) => Ack::from_result(error),
            Err(trouble) => return Err(trouble.to_string().into()),
        };
        sender.acknowledge(ack)?;
        match ack {
            Ack::Accepted => {}
            Ack::Busy => thread::sleep(Duration::from_micros(500)),
            Ack::Rejected => return Err("the stream was rejected".into()),
        }
    }
    let (lines, bytes, found, busy_count) = loop {
        let now = cnc.with_program(1, |program| {
            let run = program.executed();
            (run.line_count(), run.byte_count(), run.digest(), program.busy_count())
        })?;
        if now.1 >= wire.len() as u64 || begun.elapsed() > Duration::from_secs(600) {
            break now;
        }
        thread::sleep(Duration::from_millis(10));
    };
    println!(
        "{bytes} bytes in {lines} lines executed within {:.1} s, after {busy_count} rejections as busy",
        begun.elapsed().as_secs_f64()
    );
    if (lines, bytes, found) != (line.into(), wire.len() as u64, digest(wire.as_bytes())) {
        return Err("the executed lines differ from the sent ones".into());
    }
    Ok(())
}
