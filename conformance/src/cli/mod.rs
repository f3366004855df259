//! The command line of `ads-cnc`.

mod run;
mod serve;

use std::io::Write as _;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Wrong use of the command line.
pub const EXIT_USAGE: u8 = 2;

/// Something inside failed, or the system refused it.
pub const EXIT_INTERNAL: u8 = 70;

/// Reads, judges and simulates the ADS interface of ISG and TwinCAT CNCs.
#[derive(Debug, Parser)]
#[command(name = "ads-cnc", version)]
struct Cli {
    /// `run` if none is given.
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Start the simulated CNC and serve it over AMS/TCP until interrupted.
    Serve(serve::Args),
    Run(run::Run),
}

/// Runs the tool with the arguments of the process.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version are no errors: they have the code 0.
            let code = u8::try_from(error.exit_code()).unwrap_or(EXIT_USAGE);
            let _unprinted = error.print();
            return ExitCode::from(code);
        }
    };
    cli.run()
}

impl Cli {
    fn run(self) -> ExitCode {
        match self.command {
            Some(Command::Run(run)) => run.execute().into(),
            Some(Command::Serve(args)) => serve::serve(&args),
            // The suite against the embedded CNC, its options as they are by default.
            None => Self::parse_from(["ads-cnc", "run"]).run(),
        }
    }
}

/// Says why on stderr and ends with a code.
fn refuse(code: u8, why: impl std::fmt::Display) -> ExitCode {
    let _unprinted = writeln!(std::io::stderr(), "ads-cnc: {why}");
    ExitCode::from(code)
}
