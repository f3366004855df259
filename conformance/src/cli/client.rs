//! `ads-cnc client`: the reference client, driven by the protocol of `run --client`.

use std::io::{self, BufRead as _, Write as _};
use std::net::SocketAddr;
use std::thread;
use std::time::Duration;

use clap::Args;
use serde::Deserialize;

use super::message::exit_with_error;
use super::output::print_output;
use crate::client_suite::{
    self, Action, ActionResult, ClientHello, ClientReaction, CncAddress, ReferenceClient,
};
use crate::exit::Exit;
use crate::text::{did_you_mean, json_error};

/// Answer the protocol of `run --client` with this project's client
///
/// This client tests the suite and serves as an example. It connects only to this machine. See
/// conformance/adapters/CLIENTS.md.
#[derive(Args, Debug)]
pub(super) struct ClientCommandArgs {
    /// Enable a defect (see --list-defects)
    #[arg(long, value_name = "ID")]
    defect: Option<String>,

    /// Execute the action in the environment variable ADS_CNC_DO and exit
    #[arg(long)]
    once: bool,

    /// List the defects, each with the requirement that must fail
    #[arg(long)]
    list_defects: bool,
}

/// A line sent by the suite.
#[derive(Deserialize)]
#[serde(tag = "cmd", rename_all = "lowercase")]
enum Instruction {
    Do { address: SocketAddr, net_id: String, port: u16, action: String, args: Vec<String> },
    Bye,
}

/// Exit code with which a client with a defect crashes; a shell reports this code for a process
/// that SIGABRT ended.
const ABORT_EXIT_CODE: i32 = 134;

impl ClientCommandArgs {
    /// Executes the instructions of the suite until `bye` or the end of stdin; with --once,
    /// executes the action in `ADS_CNC_DO`; with --list-defects, lists the defects.
    pub(super) fn execute(&self) -> Exit {
        if self.list_defects {
            return print_output(list);
        }
        let defect = match self.defect.as_deref().map(|id| (id, client_suite::find_defect(id))) {
            Some((id, None)) => {
                let near = did_you_mean(id, client_suite::defects().iter().map(|defect| defect.id));
                let why =
                    format!("no defect has the ID {id}{near}; client --list-defects shows all");
                return exit_with_error(Exit::Usage, why);
            }
            Some((_, defect)) => defect,
            None => None,
        };
        let fault = defect.map(|defect| defect.fault);
        written(if self.once { once(fault) } else { answer(fault) })
    }
}

fn written(done: io::Result<()>) -> Exit {
    match done {
        Ok(()) => Exit::Success,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Exit::Success,
        Err(error) => exit_with_error(Exit::Internal, format_args!("stdin or stdout: {error}")),
    }
}

fn list(out: &mut dyn io::Write) -> io::Result<()> {
    client_suite::defects().iter().try_for_each(|defect| {
        writeln!(out, "{:<30} {:<7} {defect}", defect.id, defect.requirement)
    })
}

fn answer(fault: Option<client_suite::ClientFault>) -> io::Result<()> {
    let mut out = io::stdout().lock();
    let mut say = |line: String| {
        out.write_all(line.as_bytes())?;
        out.write_all(b"\n")?;
        out.flush()
    };
    say(serde_json::to_string(&ReferenceClient::hello())?)?;
    for line in io::stdin().lock().lines() {
        let line = line?;
        let (cnc_address, action) = match serde_json::from_str::<Instruction>(&line) {
            Ok(Instruction::Bye) => return Ok(()),
            Ok(Instruction::Do { address, net_id, port, action, args }) => {
                let Ok(net_id) = net_id.parse() else { continue };
                (CncAddress { addr: address, net_id, port }, Action { action, args })
            }
            Err(error) => {
                say(serde_json::to_string(&ActionResult::Error(json_error(&line, &error)))?)?;
                continue;
            }
        };
        say(done(fault, &cnc_address, &action)?)?;
    }
    Ok(())
}

/// Executes an action and returns the line with its result. With some defects, the line is not
/// JSON, or the process exits or hangs instead.
fn done(
    fault: Option<client_suite::ClientFault>,
    cnc_address: &CncAddress,
    action: &Action,
) -> io::Result<String> {
    match client_suite::answer(fault, cnc_address, action) {
        ClientReaction::Answer(answer) => Ok(serde_json::to_string(&answer)?),
        ClientReaction::Garbled(what) => Ok(what),
        ClientReaction::Died(_) => std::process::exit(ABORT_EXIT_CODE),
        _ => loop {
            thread::sleep(Duration::from_secs(1));
        },
    }
}

/// Executes the action in the environment variable `ADS_CNC_DO`, or answers `hello`.
fn once(fault: Option<client_suite::ClientFault>) -> io::Result<()> {
    let env_variable =
        |name| std::env::var(name).map_err(|_| io::Error::other(format!("{name} is not set")));
    let line = env_variable("ADS_CNC_DO")?;
    let line = match line.as_str() {
        "hello" => {
            serde_json::to_string(&ClientHello { stays: false, ..ReferenceClient::hello() })?
        }
        line => {
            let wrong = || io::Error::other("ADS_CNC_DO or the address of the CNC is invalid");
            let cnc_address = CncAddress {
                addr: env_variable("ADS_CNC_ADDRESS")?.parse().map_err(|_| wrong())?,
                net_id: env_variable("ADS_CNC_NET_ID")?.parse().map_err(|_| wrong())?,
                port: env_variable("ADS_CNC_PORT")?.parse().map_err(|_| wrong())?,
            };
            done(fault, &cnc_address, &Action::parse(line).ok_or_else(wrong)?)?
        }
    };
    let mut out = io::stdout().lock();
    writeln!(out, "{line}")
}
