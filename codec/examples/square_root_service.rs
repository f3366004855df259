//! Hosts the example service of the manual on a channel: the square root of a number.
//!
//!     cargo run -p ads-cnc --example square_root_service -- 127.0.0.1:48898 127.0.0.1.1.1 1 [ANSWERS]
//!
//! With ANSWERS, the program ends after it has written this number of answers. An answer whose last
//! write fails is counted only if the write is repeated.

mod transport;

use std::time::Duration;
use std::{env, thread};

use ads_cnc::CncStr;
use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, WriteByName};
use ads_cnc::service::{Host, HostStep, Outcome, ServiceId};
use transport::{Cnc, Result};

/// The interval at which the service polls for a request.
const POLL: Duration = Duration::from_millis(50);

fn main() -> Result<()> {
    let cnc = Cnc::from_args()?;
    let channel = Channel::new(env::args().nth(3).ok_or("no channel")?.parse()?)?;
    let mut answers: u64 = env::args().nth(4).map_or(Ok(u64::MAX), |count| count.parse())?;

    let services = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?];
    let mut host = Host::new(&services);
    let mut reply = Vec::new();
    while answers > 0 {
        match host.step() {
            HostStep::Read(variable) => {
                let value = cnc.call(&ReadByName::new(channel, variable.name())?, &mut reply)?;
                host.read(value.bytes)?;
            }
            HostStep::Write(variable, value) => {
                let write = WriteByName::new(channel, variable.name(), value)?;
                match cnc.call(&write, &mut reply) {
                    Ok(_) => {
                        host.written();
                        answers -= u64::from(host.outcome() == Some(Outcome::Answered));
                    }
                    Err(error) => {
                        eprintln!("{variable}: {error}");
                        host.failed();
                    }
                }
            }
            HostStep::Serve { request, .. } => {
                let (response, state) = square_root(&request.to_string());
                println!("{request} -> {response}, state {state}");
                host.answer(CncStr::new(&response)?, state)?;
            }
            HostStep::Wait => {
                thread::sleep(POLL);
                host.poll();
            }
        }
    }
    Ok(())
}

/// Computes the response and the response state, which must not be 0.
fn square_root(request: &str) -> (String, u32) {
    match request.trim().parse::<f64>() {
        Ok(number) if number < 0.0 => {
            (format!("ERROR: cannot calc square root of negative number {number:.6}"), 99)
        }
        Ok(number) => (format!("{:.6}", number.sqrt()), 1),
        Err(_) => (format!("ERROR: {request} is no number"), 98),
    }
}
