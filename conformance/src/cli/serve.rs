//! `ads-cnc serve`: serves the simulated CNC.

use std::io::{self, Write as _};
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::ads::AmsNetId;

use super::executed::{self, ExecutedTo};
use super::message::{exit_with_error, print_error};
use super::model::ModelArgs;
use super::numbers::whole;
use super::output::print_output;
use super::target::net_id;
use crate::exit::Exit;
use crate::faults::{self, Faulty, SeededDefect};
use crate::net;
use crate::process::interrupt::Interrupt;
use crate::session::ToolError;
use crate::simulator::program::{Pace, ProgramConfig, Repeat, Script, ScriptConfig};
use crate::simulator::{
    CONNECTION_BYTES_MAX, CONNECTIONS_MAX, Cnc, DEFAULT_MODEL, NET_ID, Server, ServerOptions,
};
use crate::text::did_you_mean;

/// The end of the help text of `serve`.
const AFTER_HELP: &str = "\
Examples:
  ads-cnc serve
  ads-cnc serve --print-model > mine.toml
  ads-cnc serve --model mine.toml --listen 127.0.0.1:0 --log debug
  ads-cnc serve --edition de-1.051 --cnc-version V3.1.3131.0 --pace 20
  ads-cnc serve --executed 1=executed.nc

The simulated CNC uses AMS/TCP, like a device, and answers at the AMS ports 551 (GEO), 552 (SDA) and
553 (COM). A client needs no route. SIGINT (Ctrl-C), SIGTERM and SIGHUP end it.

At most 64 connections are open at a time. Each uses at most 192 KiB for requests and replies,
64 KiB for the reply being built, and 1 MiB for the stack of a thread. A frame that is longer than
64 KiB or inconsistent closes its own connection, with an entry in the log. So does a new connection
that sends no complete request within 10 s, and a frame that is not complete within 10 s.

Exit codes: 0 ended by a signal; 2 wrong usage, an invalid model, or an address that cannot be
listened on; 70 internal error.";

/// The help text contains these limits: if one changes, change the help text, too.
const _: () = assert!(CONNECTIONS_MAX == 64 && CONNECTION_BYTES_MAX <= 192 * 1024);
const _: () = assert!(ServerOptions::FRAME.as_secs() == 10);

/// Options of `serve`.
#[derive(Debug, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct ServeArgs {
    /// Listen on this address and port; port 0 lets the system choose a port.
    #[arg(long, value_name = "ADDR", default_value = "127.0.0.1:48898", value_parser = address)]
    listen: SocketAddr,

    /// Allow an address other than loopback. Any machine that reaches it can read and write.
    #[arg(long)]
    allow_remote: bool,

    /// Answer for this AMS NetId.
    #[arg(long, value_name = "ID", default_value_t = NET_ID, value_parser = net_id)]
    net_id: AmsNetId,

    /// Close a connection after this many seconds without a request; 0 keeps it open.
    #[arg(long, value_name = "SECONDS", default_value_t = ServerOptions::IDLE.as_secs(),
        allow_negative_numbers = true, value_parser = whole(0..=u64::from(u32::MAX)))]
    idle: u64,

    #[command(flatten)]
    model: ModelArgs,

    /// Print the default model, with comments that explain the settings, and exit.
    #[arg(long, conflicts_with_all = ["model", "edition", "cnc_version"])]
    print_model: bool,

    /// Set the pace at which all channels run streamed NC lines: lines per second, `4000 bytes/s`,
    /// `fast` or `hold` [default: the pace of the model; 1000 in the default model].
    #[arg(long, value_name = "PACE")]
    pace: Option<Pace>,

    /// At the end, write the streamed lines that this channel ran to this file; of more than 1 MiB,
    /// at least the last MiB; repeatable for several channels.
    #[arg(long, value_name = "CHANNEL=FILE")]
    executed: Vec<ExecutedTo>,

    /// Run an NC program in channel 1 that repeatedly requests square roots from the manual's
    /// service, instead of the requests of the model.
    #[arg(long)]
    ask_square_roots: bool,

    /// Enable a seeded defect, such as variable-description.size.flip [default: none].
    #[arg(long, value_name = "ID")]
    defect: Option<String>,

    /// List the defects, or those whose ID contains PART or that violate the requirement PART, and
    /// exit. Columns, separated by tabs: ID, violated requirements, effect.
    #[arg(long, value_name = "PART", num_args = 0..=1, default_missing_value = "")]
    list_defects: Option<String>,
}

pub(super) fn serve(args: &ServeArgs) -> Exit {
    if let Some(part) = &args.list_defects {
        return list_defects(part);
    }
    if args.print_model {
        return print_output(|out| out.write_all(DEFAULT_MODEL.as_bytes()));
    }
    if let Err(why) = check_address(args.listen, args.allow_remote) {
        return exit_with_error(Exit::Usage, why);
    }
    let defect = match find_defect(args.defect.as_deref()) {
        Ok(defect) => defect,
        Err(why) => return exit_with_error(Exit::Usage, why),
    };
    if let Some(defect) = defect.as_ref().filter(|defect| !defect.is_for_cnc()) {
        return exit_with_error(
            Exit::Usage,
            format_args!("{} is a defect of a codec, not of a CNC", defect.id),
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
        return exit_with_error(Exit::Internal, format_args!("cannot print the address: {error}"));
    }
    drop(out);
    // The threads of the server handle the connections until a signal arrives.
    interrupt.wait();
    tracing::info!("stopped by a signal");
    drop(server);
    executed::log(&cnc);
    match executed.into_iter().try_for_each(|one| one.write(&cnc)) {
        Ok(()) => Exit::Success,
        Err(why) => exit_with_error(Exit::Internal, why),
    }
}

impl ServeArgs {
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
/// If the address is not a loopback address and --allow-remote is not set.
pub(super) fn check_address(addr: SocketAddr, allow_remote: bool) -> Result<(), String> {
    if addr.ip().is_loopback() {
        return Ok(());
    }
    let open = "the simulated CNC does not authenticate clients";
    if allow_remote {
        print_error(format_args!(
            "warning: {addr} is not a loopback address: {open}, and any machine that reaches it \
             can read and write"
        ));
        return Ok(());
    }
    Err(format!(
        "{addr} is not a loopback address: {open}. Listen on a loopback address, such as \
         127.0.0.1:48898, or set --allow-remote"
    ))
}

fn start(addr: SocketAddr, cnc: Faulty, options: ServerOptions) -> Result<Server, String> {
    let listener = net::listen(addr).map_err(|error| cannot_listen("--listen", addr, &error))?;
    let server = Server::with_options(listener, Arc::new(cnc), options);
    server.map_err(|error| format!("cannot serve on {addr}: {error}"))
}

/// The error message if the tool cannot listen on the address of this option.
pub(super) fn cannot_listen(option: &str, addr: SocketAddr, error: &io::Error) -> String {
    let next = match error.kind() {
        io::ErrorKind::AddrInUse => format!(
            "; is another CNC or an ADS router running on this machine? With {option} 127.0.0.1:0 \
             the system chooses a port"
        ),
        _ => String::new(),
    };
    format!("{option}: cannot listen on {addr}: {error}{next}")
}

pub(super) fn address(text: &str) -> Result<SocketAddr, String> {
    text.parse().map_err(|_| {
        "expected an IP address and a port, such as 127.0.0.1:48898 or [::1]:48898".to_owned()
    })
}

/// Applies the options about NC programs to the channels.
fn programs(cnc: &Cnc, args: &ServeArgs) -> Result<(), Box<dyn std::error::Error>> {
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

fn list_defects(part: &str) -> Exit {
    let fits = |defect: &&SeededDefect| {
        defect.id.contains(part)
            || defect.requirements.iter().any(|id| id.eq_ignore_ascii_case(part))
    };
    let mut listed = faults::all().iter().filter(fits).peekable();
    if listed.peek().is_none() {
        let parts = faults::all().iter().flat_map(|defect| defect.id.split('.'));
        let near = did_you_mean(part, parts);
        let why =
            format!("no defect contains {part} in its ID or violates the requirement {part}{near}");
        return exit_with_error(Exit::Usage, why);
    }
    print_output(|out| {
        for defect in listed {
            writeln!(out, "{}\t{}\t{defect}", defect.id, defect.requirements.join(" "))?;
        }
        Ok(())
    })
}

/// The defect with this ID; `None` without an ID.
///
/// # Errors
/// If no defect has the ID; the error suggests similar IDs, if any.
pub(super) fn find_defect(id: Option<&str>) -> Result<Option<SeededDefect>, String> {
    let Some(id) = id else { return Ok(None) };
    faults::by_id(id).cloned().map(Some).ok_or_else(|| unknown_defect(id))
}

fn unknown_defect(id: &str) -> String {
    let all = faults::all().iter().map(|defect| defect.id.as_str());
    let near = did_you_mean(id, all);
    format!(
        "no defect has the ID {id}{near}\nserve --list-defects PART lists those that contain PART"
    )
}
