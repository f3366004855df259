//! `ads-cnc client`: this project's client over the protocol of `run --client`.

use std::io::{self, BufRead as _, Write as _};
use std::net::SocketAddr;
use std::thread;
use std::time::Duration;

use clap::Args;
use serde::Deserialize;

use super::message::complain;
use crate::clients::{
    self, Action, ActionResult, ClientHello, ClientReaction, CncAddress, ReferenceClient,
};
use crate::judge::Exit;

/// Answers the protocol of `run --client` with this project's client, on stdin and stdout.
///
/// A client to try the suite with, and an example: it goes to this machine only. See
/// conformance/adapters/CLIENTS.md.
#[derive(Args, Debug)]
pub(super) struct ClientArguments {
    /// Do one thing wrong (see --list-defects)
    #[arg(long, value_name = "ID")]
    defect: Option<String>,

    /// Be started for each action, and do what ADS_CNC_DO says
    #[arg(long)]
    once: bool,

    /// List what it can do wrong, each with the requirement that has to fail
    #[arg(long)]
    list_defects: bool,
}

/// A line of the suite.
#[derive(Deserialize)]
#[serde(tag = "cmd", rename_all = "lowercase")]
enum Instruction {
    Do { address: SocketAddr, net_id: String, port: u16, action: String, args: Vec<String> },
    Bye,
}

/// Exit code of a process that is told to die.
const DEAD: i32 = 134;

impl ClientArguments {
    /// Answers until `bye` or the end of stdin.
    pub(super) fn execute(&self) -> Exit {
        if self.list_defects {
            return written(list());
        }
        let defect = match self.defect.as_deref().map(|id| (id, clients::find_defect(id))) {
            Some((id, None)) => {
                complain(format_args!(
                    "no defect has the ID {id}; client --list-defects shows all"
                ));
                return Exit::Usage;
            }
            Some((_, defect)) => defect,
            None => None,
        };
        let flaw = defect.map(|defect| defect.flaw);
        written(if self.once { once(flaw) } else { answer(flaw) })
    }
}

fn written(done: io::Result<()>) -> Exit {
    match done {
        Ok(()) => Exit::Success,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Exit::Success,
        Err(error) => {
            complain(format_args!("stdin or stdout: {error}"));
            Exit::Internal
        }
    }
}

fn list() -> io::Result<()> {
    let mut out = io::stdout().lock();
    clients::defects().iter().try_for_each(|defect| {
        writeln!(out, "{:<30} {:<7} {defect}", defect.id, defect.requirement)
    })
}

fn answer(flaw: Option<clients::Flaw>) -> io::Result<()> {
    let mut out = io::stdout().lock();
    let mut say = |line: String| {
        out.write_all(line.as_bytes())?;
        out.write_all(b"\n")?;
        out.flush()
    };
    say(serde_json::to_string(&ReferenceClient::hello())?)?;
    for line in io::stdin().lock().lines() {
        let (place, action) = match serde_json::from_str::<Instruction>(&line?) {
            Ok(Instruction::Bye) => return Ok(()),
            Ok(Instruction::Do { address, net_id, port, action, args }) => {
                let Ok(net_id) = net_id.parse() else { continue };
                (CncAddress { addr: address, net_id, port }, Action { action, args })
            }
            Err(error) => {
                say(serde_json::to_string(&ActionResult::Error(error.to_string()))?)?;
                continue;
            }
        };
        say(done(flaw, &place, &action)?)?;
    }
    Ok(())
}

/// The answer to an action; a client with such a defect exits or hangs here.
fn done(flaw: Option<clients::Flaw>, place: &CncAddress, action: &Action) -> io::Result<String> {
    match clients::answer(flaw, place, action) {
        ClientReaction::Answer(answer) => Ok(serde_json::to_string(&answer)?),
        ClientReaction::Garbled(what) => Ok(what),
        ClientReaction::Died(_) => std::process::exit(DEAD),
        _ => loop {
            thread::sleep(Duration::from_secs(1));
        },
    }
}

/// Does the action of the environment variable and ends.
fn once(flaw: Option<clients::Flaw>) -> io::Result<()> {
    let env_variable =
        |name| std::env::var(name).map_err(|_| io::Error::other(format!("{name} is not set")));
    let line = env_variable("ADS_CNC_DO")?;
    let line = match line.as_str() {
        "hello" => {
            serde_json::to_string(&ClientHello { stays: false, ..ReferenceClient::hello() })?
        }
        line => {
            let wrong = || io::Error::other("what it is told makes no sense");
            let place = CncAddress {
                addr: env_variable("ADS_CNC_ADDRESS")?.parse().map_err(|_| wrong())?,
                net_id: env_variable("ADS_CNC_NET_ID")?.parse().map_err(|_| wrong())?,
                port: env_variable("ADS_CNC_PORT")?.parse().map_err(|_| wrong())?,
            };
            done(flaw, &place, &Action::parse(line).ok_or_else(wrong)?)?
        }
    };
    let mut out = io::stdout().lock();
    writeln!(out, "{line}")
}
