//! `ads-cnc run`: the suite against a target.

use std::fs::File;
use std::io::{self, BufWriter, Write as _};
use std::net::{IpAddr, SocketAddr, ToSocketAddrs as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::ads::{AmsAddr, AmsNetId, AmsPort};
use clap::Args;

use super::{complain, find_defect};
use crate::client::{Client, Target};
use crate::cnc::{Cnc, Server};
use crate::defect::Defect;
use crate::exchange::Fault;
use crate::gate::Gate;
use crate::net;
use crate::profile::Profile;
use crate::report::{self, Report, TargetReport};
use crate::suite::{self, Needs, Session};
use crate::verdict::Exit;

/// The TCP port of AMS.
const AMS_TCP_PORT: u16 = 48898;

/// Runs the conformance suite against the embedded CNC, or against a device.
///
/// Without --target a simulated CNC is started on this machine and judged together with the codec.
/// A device is only read: nothing is sent to it but documented queries, to the ports they are
/// documented for. Some ask for what is not there, by one beyond the last, to see it refused.
#[derive(Args, Debug)]
pub(super) struct Run {
    /// The device: host name or address, and the port if it is not 48898
    #[arg(long, value_name = "HOST[:PORT]", requires = "net_id")]
    target: Option<String>,

    /// AMS NetId of the device
    #[arg(long, value_name = "ID", requires = "target")]
    net_id: Option<AmsNetId>,

    /// AMS NetId to ask as; the device needs a route to it
    #[arg(long, value_name = "ID", default_value = "127.0.0.1.1.2")]
    source_net_id: AmsNetId,

    /// How long to wait for an answer, in milliseconds
    #[arg(long, value_name = "MS", default_value_t = 2000)]
    timeout: u64,

    /// Write the report as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,

    /// Show the cases of the codec one by one
    #[arg(long, short)]
    verbose: bool,

    /// Switch on a defect of the embedded CNC and of the codec's cases (see serve --list-defects)
    #[arg(long, value_name = "ID", conflicts_with = "target")]
    defect: Option<String>,
}

impl Run {
    /// Runs the suite and writes its reports.
    pub(super) fn execute(&self) -> Exit {
        let defect = match find_defect(self.defect.as_deref()) {
            Ok(defect) => defect,
            Err(why) => {
                complain(why);
                return Exit::Usage;
            }
        };
        let report = match &self.target {
            None => embedded(defect),
            Some(host) => self.device(host),
        };
        match report {
            Ok(report) => self.write(&report),
            Err((exit, message)) => {
                complain(message);
                exit
            }
        }
    }

    fn device(&self, host: &str) -> Result<Report, (Exit, String)> {
        let addr = resolve(host).map_err(|error| (Exit::Usage, format!("{host}: {error}")))?;
        let Some(net_id) = self.net_id else {
            return Err((Exit::Usage, "--target needs --net-id".to_owned()));
        };
        let target = Target {
            addr,
            net_id,
            source: AmsAddr { net_id: self.source_net_id, port: AmsPort(0x8000) },
            timeout: Duration::from_millis(self.timeout.max(1)),
        };
        let client = Client::connect(target, Gate::queries()).map_err(|error| {
            let message = format!(
                "no connection to {addr}: {error}. Is it reachable, and does it listen for AMS/TCP?"
            );
            (Exit::Nothing, message)
        })?;
        let mut session = Session::new(client, Profile::DEVICE);
        // Silence is judged case by case only of one that speaks at all.
        greet(&mut session, &target).map_err(|message| (Exit::Nothing, message))?;
        let cases = suite::cases().into_iter().filter(|case| case.needs != Needs::Codec).collect();
        let outcomes = suite::run(cases, Some(&mut session), None);
        let name = "device".to_owned();
        let target = TargetReport { name, address: addr.to_string(), net_id: net_id.to_string() };
        Ok(Report::new(target, session.profile, session.frames, outcomes))
    }

    fn write(&self, report: &Report) -> Exit {
        // The file first: whoever reads the console may stop reading.
        let written = self.json.as_ref().map_or(Ok(()), |file| write_json(report, file));
        let mut out = BufWriter::new(io::stdout().lock());
        let shown = report::print(report, self.verbose, &mut out).and_then(|()| out.flush());
        // A reader that has seen enough is no failure of ours, nor a success of the target's.
        let shown = shown.or_else(|error| match error.kind() {
            io::ErrorKind::BrokenPipe => Ok(()),
            _ => Err(error),
        });
        match written.and(shown) {
            Ok(()) => report.exit(),
            Err(error) => {
                complain(format_args!("the report could not be written: {error}"));
                Exit::Internal
            }
        }
    }
}

fn write_json(report: &Report, file: &Path) -> io::Result<()> {
    let mut out = BufWriter::new(File::create(file)?);
    serde_json::to_writer_pretty(&mut out, report)?;
    writeln!(out)?;
    out.flush()
}

/// Whether anybody answers, and as a CNC.
fn greet(session: &mut Session, target: &Target) -> Result<(), String> {
    let Target { addr, net_id, source, .. } = target;
    let route = format!(
        "Is its AMS NetId {net_id}, and does it have a route to {} at the address of this machine?",
        source.net_id
    );
    match session.greet() {
        Ok(answer) if answer.ams_error.is_none() => Ok(()),
        Ok(answer) => {
            Err(format!("{addr} answers with the AMS error {}. {route}", answer.ams_error))
        }
        Err(Fault::Malformed(error)) => {
            Err(format!("{addr} does not speak AMS/TCP: {error}. Is this the port of ADS?"))
        }
        Err(fault) => Err(format!("{addr} does not answer: {fault}. {route}")),
    }
}

/// Starts the embedded CNC, runs everything against it and stops it.
fn embedded(defect: Option<Defect>) -> Result<Report, (Exit, String)> {
    let internal = |error: &dyn std::fmt::Display| {
        (Exit::Internal, format!("the embedded CNC could not be started: {error}"))
    };
    let cnc = Cnc::with_default_model().map_err(|error| internal(&error))?;
    let cnc = Arc::new(cnc.with_defect(defect.clone()));
    let listener =
        net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).map_err(|error| internal(&error))?;
    let server = Server::start(listener, cnc).map_err(|error| internal(&error))?;
    let target = Target::local(server.addr(), server.net_id());
    let client =
        Client::connect(target, Gate::with_malformed()).map_err(|error| internal(&error))?;
    let mut session = Session::new(client, Profile::EMBEDDED);
    let outcomes = suite::run(suite::cases(), Some(&mut session), defect.as_ref());
    let name = match &defect {
        None => "embedded CNC".to_owned(),
        Some(defect) => format!("embedded CNC with the defect {}", defect.id),
    };
    let target = TargetReport {
        name,
        address: server.addr().to_string(),
        net_id: server.net_id().to_string(),
    };
    Ok(Report::new(target, session.profile, session.frames, outcomes))
}

/// The address of a host, with the port of AMS/TCP if none is given.
fn resolve(host: &str) -> io::Result<SocketAddr> {
    if let Ok(ip) = host.parse::<IpAddr>() {
        return Ok(SocketAddr::new(ip, AMS_TCP_PORT));
    }
    let found = match host.parse::<SocketAddr>() {
        Ok(addr) => return Ok(addr),
        Err(_) if host.contains(':') => host.to_socket_addrs()?.next(),
        Err(_) => (host, AMS_TCP_PORT).to_socket_addrs()?.next(),
    };
    found.ok_or_else(|| io::Error::new(io::ErrorKind::NotFound, "no such host"))
}
