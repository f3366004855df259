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
mod message;
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

use std::process::ExitCode;

use clap::{CommandFactory as _, Parser, Subcommand};

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
            Some(Subcommands::Completions(completions)) => {
                completions.execute(Self::command()).into()
            }
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
