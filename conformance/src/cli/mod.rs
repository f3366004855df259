//! The command line of `ads-cnc`.

mod browse;
mod check;
mod client;
mod completions;
mod display;
mod executed;
mod explain;
mod get;
mod list;
mod log;
mod message;
mod model;
mod name_args;
mod not_sent;
mod numbers;
mod output;
mod progress;
mod repeat_command;
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
mod tables;
mod target;
mod testee;

use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use tracing::Level;
use tracing_subscriber::filter::Targets;

use crate::exit::Exit;
use crate::text::nearest;

/// Judge, simulate and inspect the ADS interface of ISG and TwinCAT CNCs
#[derive(Debug, Parser)]
#[command(name = "ads-cnc", version)]
struct Cli {
    /// Log to stderr: a level (error, warn, info, debug, trace), or a list of module=level
    #[arg(long, hide_short_help = true, global = true, value_name = "LEVEL|FILTER",
        value_parser = log::filter)]
    log: Option<Targets>,

    /// `run` if none is specified.
    #[command(subcommand)]
    command: Option<Subcommands>,
}

#[derive(Debug, Subcommand)]
enum Subcommands {
    /// Serve a simulated CNC over AMS/TCP
    Serve(serve::ServeArgs),
    Run(Box<run::Run>),
    Report(report::ReportArgs),
    Check(check::CheckArgs),
    Explain(explain::Explain),
    Tables(tables::TablesArgs),
    Wireshark(tables::WiresharkArgs),
    Requirements(requirements::Requirements),
    Stream(stream::StreamArgs),
    Service(service::ServiceArgs),
    Completions(completions::Completions),
    Browse(browse::Browse),
    Get(get::Get),
    Set(set::Set),
    Testee(testee::TesteeArgs),
    Selftest(selftest::SelfTestArgs),
    Client(client::ClientCommandArgs),
}

/// The subcommands by purpose, as the help lists them.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Judge", &["run", "check", "report", "requirements"]),
    ("Simulate", &["serve"]),
    ("Inspect, reading only", &["browse", "get", "explain", "tables", "wireshark"]),
    ("Write to a CNC", &["set", "stream", "service"]),
    ("Test the suite itself", &["selftest", "testee", "client", "completions"]),
];

/// The command line, with help that lists the subcommands by purpose.
fn command() -> clap::Command {
    let command = Cli::command();
    let mut template = "{about}\n\n{usage-heading} {usage}\n".to_owned();
    for (group, names) in GROUPS {
        template.push_str(&format!("\n{group}:\n"));
        for name in names {
            let about = command.find_subcommand(name).and_then(clap::Command::get_about);
            let about = about.map(ToString::to_string).unwrap_or_default();
            template.push_str(&format!("  {name:<13} {about}\n"));
        }
    }
    template.push_str(
        "\nOptions:\n{options}\n\n\
         The default command is run. See ads-cnc COMMAND --help for details.",
    );
    command.help_template(template)
}

/// Runs the tool with the arguments of the process.
pub fn main() -> ExitCode {
    let parsed = command().try_get_matches().and_then(|found| Cli::from_arg_matches(&found));
    let cli = match parsed {
        Ok(cli) => cli,
        Err(mut error) => {
            suggest(&mut error);
            // clap returns the texts of --help and --version as errors with the exit code 0.
            let code = u8::try_from(error.exit_code()).unwrap_or(Exit::Usage.code());
            let _unprinted = error.print();
            return ExitCode::from(code);
        }
    };
    cli.run()
}

/// Adds the most similar subcommands, or the most similar option, to an error about an unknown
/// subcommand or option.
fn suggest(error: &mut clap::Error) {
    if !matches!(error.kind(), ErrorKind::InvalidSubcommand | ErrorKind::UnknownArgument) {
        return;
    }
    let unknown = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.clone()),
        _ => None,
    };
    let tool = Cli::command();
    if let Some(word) = unknown(ContextKind::InvalidSubcommand) {
        let names: Vec<&str> = tool.get_subcommands().map(clap::Command::get_name).collect();
        add(error, ContextKind::SuggestedSubcommand, nearest(&word, names));
    } else if let Some(word) =
        unknown(ContextKind::InvalidArg).filter(|word| word.starts_with("--"))
    {
        let name = std::env::args().nth(1).unwrap_or_default();
        let of = tool.find_subcommand(name).unwrap_or(&tool);
        let options = of.get_arguments().filter_map(clap::Arg::get_long);
        let options: Vec<String> = options.map(|option| format!("--{option}")).collect();
        add(error, ContextKind::SuggestedArg, nearest(&word, options.iter().map(String::as_str)));
    }
}

fn add(error: &mut clap::Error, kind: ContextKind, names: Vec<&str>) {
    let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
    let value = match (kind, names.as_slice()) {
        (_, []) => return,
        (ContextKind::SuggestedArg, [name, ..]) => ContextValue::String(name.clone()),
        _ => ContextValue::Strings(names),
    };
    error.insert(kind, value);
}

impl Cli {
    fn run(self) -> ExitCode {
        let is_serve = matches!(self.command, Some(Subcommands::Serve(_)));
        let default = is_serve.then(|| Targets::new().with_default(Level::INFO));
        if let Some(filter) = self.log.or(default) {
            log::to_stderr(filter);
        }
        match self.command {
            Some(Subcommands::Run(run)) => run.execute().into(),
            Some(Subcommands::Report(report)) => report.execute().into(),
            Some(Subcommands::Check(check)) => check.execute().into(),
            Some(Subcommands::Explain(explain)) => explain.execute().into(),
            Some(Subcommands::Tables(tables)) => tables.execute().into(),
            Some(Subcommands::Wireshark(wireshark)) => wireshark.execute().into(),
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
            Some(Subcommands::Serve(args)) => serve::serve(&args).into(),
            // `run` with its default options, which judge the codec and the simulated CNC.
            None => Self::parse_from(["ads-cnc", "run"]).run(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn the_help_has_every_subcommand_once() {
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
        grouped.sort_unstable();
        let command = Cli::command();
        let all: BTreeSet<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
        assert_eq!(grouped, all.into_iter().collect::<Vec<_>>());
    }
}
