//! `ads-cnc serve`: the simulated CNC as a process.

use std::io::{self, Write as _};
use std::net::SocketAddr;
use std::process::ExitCode;
use std::sync::Arc;

use super::model::ModelArgs;
use super::{find_defect, refuse};
use crate::cnc::program::{Pace, ProgramConfig, Repeat, Script, ScriptConfig, Start};
use crate::cnc::{Cnc, DEFAULT_MODEL, Server};
use crate::defect::Defect;
use crate::net;
use crate::verdict::Exit;

/// Options of `serve`.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Loopback address and port to listen on; with port 0 the system picks one.
    #[arg(long, value_name = "ADDR", default_value = "127.0.0.1:48898")]
    listen: SocketAddr,

    #[command(flatten)]
    model: ModelArgs,

    /// Write the default model out, with comments that say what a model can be, and end.
    #[arg(long)]
    print_model: bool,

    /// How fast streamed NC lines are run: so many lines a second, or `fast`.
    #[arg(long, value_name = "LINES", default_value = "1000", value_parser = pace)]
    pace: Pace,

    /// Let an NC program of channel 1 ask the manual's service for square roots, again and again.
    #[arg(long)]
    ask_square_roots: bool,

    /// Answer with a seeded defect, such as variable-description.size.flip.
    #[arg(long, value_name = "ID")]
    defect: Option<String>,

    /// List the IDs of all defects and end.
    #[arg(long)]
    list_defects: bool,
}

pub(super) fn serve(args: &Args) -> ExitCode {
    if args.list_defects {
        return list_defects();
    }
    if args.print_model {
        return print_model();
    }
    if !args.listen.ip().is_loopback() {
        let addr = args.listen;
        return refuse(
            Exit::Usage,
            format_args!(
                "{addr} is not a loopback address; the simulated CNC asks nobody who he is, so it is \
             served on this machine only, for example on 127.0.0.1:48898"
            ),
        );
    }
    let defect = match find_defect(args.defect.as_deref()) {
        Ok(defect) => defect,
        Err(why) => return refuse(Exit::Usage, why),
    };
    log_to_stderr();
    let cnc = match args.model.cnc() {
        Ok(cnc) => cnc,
        Err(why) => return refuse(Exit::Usage, why),
    };
    if let Err(why) = programs(&cnc, args) {
        return refuse(Exit::Internal, why);
    }
    let server = match start(args.listen, cnc, defect) {
        Ok(server) => server,
        Err(why) => return refuse(Exit::Internal, why),
    };
    let line = format!("listening on {}, AMS NetId {}\n", server.addr(), server.net_id());
    let mut out = io::stdout().lock();
    if let Err(error) = out.write_all(line.as_bytes()).and_then(|()| out.flush()) {
        return refuse(
            Exit::Internal,
            format_args!("nobody can be told where it listens: {error}"),
        );
    }
    // Until interrupted: the threads of the server do the rest.
    loop {
        std::thread::park();
    }
}

fn start(addr: SocketAddr, cnc: Cnc, defect: Option<Defect>) -> Result<Server, String> {
    if let Some(defect) = &defect {
        tracing::warn!("serving with a seeded defect: {defect}");
    }
    let listener =
        net::listen(addr).map_err(|error| format!("cannot listen on {addr}: {error}"))?;
    let cnc = Arc::new(cnc.with_defect(defect));
    Server::start(listener, cnc).map_err(|error| format!("cannot serve on {addr}: {error}"))
}

fn pace(text: &str) -> Result<Pace, String> {
    let lines = match text {
        "fast" => return Ok(Pace::Fast),
        lines => lines.parse().ok().and_then(Pace::lines_per_second),
    };
    lines.ok_or_else(|| "a number of lines from 1 on, or `fast`".to_owned())
}

/// The NC programs of the channels.
fn programs(cnc: &Cnc, args: &Args) -> Result<(), Box<dyn std::error::Error>> {
    for channel in cnc.model().channels() {
        let (pace, start) = (args.pace, Start::Again);
        cnc.set_program(channel, ProgramConfig { pace, start, ..ProgramConfig::default() })?;
    }
    if args.ask_square_roots {
        let script = ScriptConfig { repeat: Repeat::Endless, ..ScriptConfig::square_root()? };
        cnc.set_script(1, Some(Script::new(script)?))?;
    }
    Ok(())
}

fn print_model() -> ExitCode {
    let mut out = io::stdout().lock();
    match out.write_all(DEFAULT_MODEL.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => refuse(Exit::Internal, format_args!("the model is not written: {error}")),
    }
}

fn list_defects() -> ExitCode {
    let mut out = io::stdout().lock();
    for defect in Defect::all() {
        if writeln!(out, "{}", defect.id).is_err() {
            // Whoever reads has seen enough.
            break;
        }
    }
    ExitCode::SUCCESS
}

fn log_to_stderr() {
    // Only the first in a process sets it; there is no other.
    let _already_set = tracing_subscriber::fmt()
        .with_writer(io::stderr)
        .with_ansi(false)
        .without_time()
        .try_init();
}
