//! `ads-cnc serve`: the simulated CNC as a process.

use std::io::{self, Write as _};
use std::net::SocketAddr;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::ads::AmsNetId;

use super::executed::{self, ExecutedTo};
use super::message::{exit_with_error, print_error};
use super::model::ModelArgs;
use super::target::net_id;
use crate::faults::{self, Faulty, Seed};
use crate::judge::Exit;
use crate::net;
use crate::process::interrupt::Interrupt;
use crate::session::ToolError;
use crate::simulator::program::{Pace, ProgramConfig, Repeat, Script, ScriptConfig};
use crate::simulator::{
    CONNECTION_BYTES_MAX, CONNECTIONS_MAX, Cnc, DEFAULT_MODEL, NET_ID, Server, ServerOptions,
};
use crate::text::did_you_mean;

/// The end of the help.
const AFTER_HELP: &str = "\
Examples:
  ads-cnc serve
  ads-cnc serve --print-model > mine.toml
  ads-cnc serve --model mine.toml --listen 127.0.0.1:0 --log debug
  ads-cnc serve --edition de-1.051 --cnc-version V3.1.3131.0 --pace 20
  ads-cnc serve --executed 1=executed.nc

It speaks AMS/TCP, as a device does, and answers at the AMS ports 551 (GEO), 552 (SDA) and 553
(COM). A client needs no route. SIGINT (Ctrl-C), SIGTERM and SIGHUP end it.

There are at most 64 connections. Each holds at most 192 KiB of requests and answers, one answer in
the making of at most 64 KiB, and a thread's stack of 1 MiB. A frame that is longer than 64 KiB or
does not hold together ends its own connection, as the log says. So does a new connection without
a whole request for 10 s, and one that leaves a frame unfinished for 10 s.

Exit codes: 0 ended by a signal; 2 wrong usage, a model that is refused, and an address that cannot be
listened on; 70 internal error.";

/// The help states these limits.
const _: () = assert!(CONNECTIONS_MAX == 64 && CONNECTION_BYTES_MAX <= 192 * 1024);
const _: () = assert!(ServerOptions::FRAME.as_secs() == 10);

/// Options of `serve`.
#[derive(Debug, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Args {
    /// Address and port to listen on; with port 0 the system picks one.
    #[arg(long, value_name = "ADDR", default_value = "127.0.0.1:48898", value_parser = address)]
    listen: SocketAddr,

    /// Listen on another address than loopback too. Whoever reaches it can read and write.
    #[arg(long)]
    allow_remote: bool,

    /// AMS NetId to answer for.
    #[arg(long, value_name = "ID", default_value_t = NET_ID, value_parser = net_id)]
    net_id: AmsNetId,

    /// Seconds after which a connection without another request ends; 0 for never.
    #[arg(long, value_name = "SECONDS", default_value_t = ServerOptions::IDLE.as_secs())]
    idle: u64,

    #[command(flatten)]
    model: ModelArgs,

    /// Write the default model out, with comments that say what a model can be, and end.
    #[arg(long, conflicts_with_all = ["model", "edition", "cnc_version"])]
    print_model: bool,

    /// How fast streamed NC lines are run in all channels, instead of the pace of the model: a number
    /// of lines a second (1000 in the default model), `4000 bytes/s`, `fast` or `hold`.
    #[arg(long, value_name = "PACE")]
    pace: Option<Pace>,

    /// Write what streaming ran in this channel to this file in the end, its last MiB if there is
    /// more; for several channels more than once.
    #[arg(long, value_name = "CHANNEL=FILE")]
    executed: Vec<ExecutedTo>,

    /// Let an NC program of channel 1 ask the manual's service for square roots, again and again,
    /// instead of what the model has it ask.
    #[arg(long)]
    ask_square_roots: bool,

    /// Answer with a seeded defect, such as variable-description.size.flip.
    #[arg(long, value_name = "ID")]
    defect: Option<String>,

    /// List the defects, or those whose ID or requirements contain this, and end: ID, the requirements
    /// it breaks, and what it does; separated by tabs.
    #[arg(long, value_name = "PART", num_args = 0..=1, default_missing_value = "")]
    list_defects: Option<String>,
}

pub(super) fn serve(args: &Args) -> ExitCode {
    if let Some(part) = &args.list_defects {
        return list_defects(part);
    }
    if args.print_model {
        return print_model();
    }
    if let Err(why) = check_address(args.listen, args.allow_remote) {
        return exit_with_error(Exit::Usage, why);
    }
    let defect = match find_defect(args.defect.as_deref()) {
        Ok(defect) => defect,
        Err(why) => return exit_with_error(Exit::Usage, why),
    };
    if let Some(seed) = defect.as_ref().filter(|seed| !seed.is_for_cnc()) {
        return exit_with_error(
            Exit::Usage,
            format_args!("{} is a defect of a codec, not of a CNC", seed.id),
        );
    }
    let faulty = match args.model.cnc() {
        Ok(cnc) => Faulty::new(cnc, defect.as_ref()),
        Err(why) => return exit_with_error(Exit::Usage, why),
    };
    let cnc = Arc::clone(faulty.cnc());
    if let Err(why) = programs(&cnc, args) {
        return exit_with_error(Exit::Internal, why);
    }
    let executed: Result<Vec<_>, _> = args.executed.iter().map(|one| one.open(&cnc)).collect();
    let executed = match executed {
        Ok(executed) => executed,
        Err(why) => return exit_with_error(Exit::Usage, format_args!("--executed: {why}")),
    };
    let interrupt = match Interrupt::catch() {
        Ok(interrupt) => interrupt,
        Err(error) => return exit_with_error(Exit::Internal, ToolError::uncaught(&error)),
    };
    if let Some(defect) = &defect {
        tracing::warn!("serving with a seeded defect: {defect}");
    }
    let server = match start(args.listen, faulty, args.options()) {
        Ok(server) => server,
        Err(why) => return exit_with_error(Exit::Usage, why),
    };
    let line = format!("listening on {}, AMS NetId {}\n", server.addr(), server.net_id());
    let mut out = io::stdout().lock();
    if let Err(error) = out.write_all(line.as_bytes()).and_then(|()| out.flush()) {
        return exit_with_error(
            Exit::Internal,
            format_args!("the address cannot be printed: {error}"),
        );
    }
    drop(out);
    // The threads of the server do the work.
    interrupt.wait();
    tracing::info!("interrupted, ending");
    drop(server);
    executed::log(&cnc);
    match executed.into_iter().try_for_each(|one| one.write(&cnc)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => exit_with_error(Exit::Internal, why),
    }
}

impl Args {
    const fn options(&self) -> ServerOptions {
        let idle = match self.idle {
            0 => None,
            seconds => Some(Duration::from_secs(seconds)),
        };
        ServerOptions { net_id: self.net_id, idle, frame: Some(ServerOptions::FRAME) }
    }
}

/// Checks the address that the simulated CNC listens on.
///
/// # Errors
/// If other machines can reach it and --allow-remote is not set.
pub(super) fn check_address(addr: SocketAddr, allow_remote: bool) -> Result<(), String> {
    if addr.ip().is_loopback() {
        return Ok(());
    }
    let open = "the simulated CNC does not authenticate clients";
    if allow_remote {
        print_error(format_args!(
            "warning: {addr} is not a loopback address: {open}, and whoever reaches it can read \
             and write"
        ));
        return Ok(());
    }
    Err(format!(
        "{addr} is not a loopback address; {open}, so it is served on this machine only, for \
         example on 127.0.0.1:48898, unless --allow-remote says otherwise"
    ))
}

fn start(addr: SocketAddr, cnc: Faulty, options: ServerOptions) -> Result<Server, String> {
    let listener = net::listen(addr).map_err(|error| {
        let next = match error.kind() {
            io::ErrorKind::AddrInUse => {
                "; does another CNC or an ADS router run here? --listen 127.0.0.1:0 lets the system \
                 pick a port"
            }
            _ => "",
        };
        format!("cannot listen on {addr}: {error}{next}")
    })?;
    let server = Server::with_options(listener, cnc, options);
    server.map_err(|error| format!("cannot serve on {addr}: {error}"))
}

fn address(text: &str) -> Result<SocketAddr, String> {
    text.parse().map_err(|_| {
        "an IP address and a port are needed, as 127.0.0.1:48898 or [::1]:48898".to_owned()
    })
}

/// Applies the options about NC programs to the channels.
fn programs(cnc: &Cnc, args: &Args) -> Result<(), Box<dyn std::error::Error>> {
    if let Some(pace) = args.pace {
        for channel in cnc.model().channels() {
            let of_model = cnc.model().program(channel).cloned().unwrap_or_default();
            cnc.set_program(channel, ProgramConfig { pace, ..of_model })?;
        }
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
        Err(error) => {
            exit_with_error(Exit::Internal, format_args!("the model is not written: {error}"))
        }
    }
}

fn list_defects(part: &str) -> ExitCode {
    let mut out = io::stdout().lock();
    let fits = |seed: &&Seed| {
        seed.id.contains(part) || seed.requirements.iter().any(|id| id.eq_ignore_ascii_case(part))
    };
    let mut listed = faults::all().iter().filter(fits).peekable();
    if listed.peek().is_none() {
        let parts = faults::all().iter().flat_map(|seed| seed.id.split('.'));
        let near = did_you_mean(part, parts);
        let why =
            format!("no defect contains {part} in its ID, or breaks such a requirement{near}");
        return exit_with_error(Exit::Usage, why);
    }
    for seed in listed {
        let broken = seed.requirements.join(" ");
        if writeln!(out, "{}\t{broken}\t{seed}", seed.id).is_err() {
            // A broken pipe: the reader has seen enough.
            break;
        }
    }
    ExitCode::SUCCESS
}

/// The defect with this ID, if an ID is given.
pub(super) fn find_defect(id: Option<&str>) -> Result<Option<Seed>, String> {
    let Some(id) = id else { return Ok(None) };
    faults::by_id(id).cloned().map(Some).ok_or_else(|| unknown_defect(id))
}

fn unknown_defect(id: &str) -> String {
    let all = faults::all().iter().map(|seed| seed.id.as_str());
    let near = did_you_mean(id, all);
    format!(
        "no defect has the ID {id}{near}\nserve --list-defects PART shows those that contain PART"
    )
}
