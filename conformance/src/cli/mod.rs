//! The command line of `ads-cnc`.

mod browse;
mod check;
mod client;
mod completions;
mod executed;
mod explain;
mod get;
mod list;
mod log;
mod model;
mod name;
mod progress;
mod report;
mod report_output;
mod requirements;
mod run;
mod run_client;
mod run_dry;
mod run_testee;
mod selftest;
mod serve;
mod service;
mod set;
mod stream;
mod target;
mod testee;

use std::io::Write as _;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::faults::{self, Seed};
use crate::judge::Exit;

/// Reads, judges and simulates the ADS interface of ISG and TwinCAT CNCs.
#[derive(Debug, Parser)]
#[command(name = "ads-cnc", version)]
struct Cli {
    /// Log to stderr: a level (error, warn, info, debug, trace), or a list of module=level
    #[arg(long, global = true, value_name = "LEVEL|FILTER")]
    log: Option<log::Filter>,

    /// `run` if none is specified.
    #[command(subcommand)]
    command: Option<Subcommands>,
}

#[derive(Debug, Subcommand)]
enum Subcommands {
    /// Start the simulated CNC and serve it over AMS/TCP until interrupted.
    Serve(serve::Args),
    Run(Box<run::Run>),
    Report(report::ReportArgs),
    Check(check::CheckArguments),
    Explain(explain::Explain),
    Requirements(requirements::Requirements),
    Stream(stream::StreamArguments),
    Service(service::ServiceArguments),
    Completions(completions::Completions),
    Browse(browse::Browse),
    Get(get::Get),
    Set(set::Set),
    Testee(testee::TesteeArguments),
    Selftest(selftest::SelfTestArguments),
    Client(client::ClientArguments),
}

impl Subcommands {
    /// The filter of --log, or the default of the command.
    fn log(&self) -> Option<log::Filter> {
        match self {
            Self::Serve(_) => "info".parse().ok(),
            _ => None,
        }
    }
}

/// Runs the tool with the arguments of the process.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version come as errors with the exit code 0.
            let code = u8::try_from(error.exit_code()).unwrap_or(Exit::Usage.code());
            let _unprinted = error.print();
            return ExitCode::from(code);
        }
    };
    cli.run()
}

impl Cli {
    fn run(self) -> ExitCode {
        if let Some(filter) = self.log.or_else(|| self.command.as_ref()?.log()) {
            log::to_stderr(filter);
        }
        match self.command {
            Some(Subcommands::Run(run)) => run.execute().into(),
            Some(Subcommands::Report(report)) => report.execute().into(),
            Some(Subcommands::Check(check)) => check.execute().into(),
            Some(Subcommands::Explain(explain)) => explain.execute().into(),
            Some(Subcommands::Requirements(requirements)) => requirements.execute().into(),
            Some(Subcommands::Stream(stream)) => stream.execute().into(),
            Some(Subcommands::Service(service)) => service.execute().into(),
            Some(Subcommands::Completions(completions)) => completions.execute().into(),
            Some(Subcommands::Browse(browse)) => browse.execute().into(),
            Some(Subcommands::Get(get)) => get.execute().into(),
            Some(Subcommands::Set(set)) => set.execute().into(),
            Some(Subcommands::Testee(testee)) => testee.execute().into(),
            Some(Subcommands::Selftest(selftest)) => selftest.execute().into(),
            Some(Subcommands::Client(client)) => client.execute().into(),
            Some(Subcommands::Serve(args)) => serve::serve(&args),
            // `run` with its default options: the suite against the simulated CNC.
            None => Self::parse_from(["ads-cnc", "run"]).run(),
        }
    }
}

/// Writes an error to stderr; a failure to do so is ignored.
fn complain(why: impl std::fmt::Display) {
    // The text may quote a device, a file or a testee.
    let why = crate::text::escape_lines(&why.to_string());
    let _unprinted = writeln!(std::io::stderr(), "ads-cnc: {why}");
}

/// Writes an error to stderr and returns the exit code.
fn refuse(exit: Exit, why: impl std::fmt::Display) -> ExitCode {
    complain(why);
    exit.into()
}

/// Parses a number, decimal or in hex with 0x.
fn number(text: &str) -> Result<u32, String> {
    let hex = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    let number = match hex {
        Some(digits) if digits.starts_with('+') => None,
        Some(digits) => u32::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    };
    number.ok_or_else(|| "a number of 32 bits, decimal or with 0x, is expected".to_owned())
}

/// The defect with this ID, if an ID is given.
fn find_defect(id: Option<&str>) -> Result<Option<Seed>, String> {
    let Some(id) = id else { return Ok(None) };
    faults::by_id(id).cloned().map(Some).ok_or_else(|| {
        let all = faults::all();
        // One ID of each stream or area, as examples.
        let mut some: Vec<&str> = all.iter().map(|seed| seed.id.as_str()).collect();
        some.dedup_by_key(|id| id.split('.').next().unwrap_or_default());
        let (some, all) = (some.join("\n  "), all.len());
        format!("no defect has the ID {id}; some that there are:\n  {some}\nserve --list-defects shows all {all}")
    })
}
