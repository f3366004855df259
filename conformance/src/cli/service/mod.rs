//! `ads-cnc service`: answers requests at the Service Interface by running a command for each
//! request.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

mod command;
mod response;

use std::io::{self, Write as _};
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, Task, WriteByName};
use ads_cnc::service::{Host, HostStep, Outcome, ServiceId, ServiceVariable};
use clap::Args;

use super::message::print_error;
use super::numbers::whole;
use super::target::{ChannelArgs, REACHING_A_DEVICE, TargetArgs, WHAT_MAY_BE_WRITTEN, default_cnc};
use crate::exit::Exit;
use crate::gate::Entry;
use crate::process::interrupt::Interrupt;
use crate::session::{Session, ToolError};
use crate::simulator::program::{Repeat, Script, ScriptConfig};
use crate::text::some_time;
use command::ServiceCommand;
use response::ServiceResponse;

/// After this many consecutive writes that the CNC rejects, the service ends with an error.
const FAILED_WRITES_MAX: u32 = 5;

/// Answer requests of NC programs by running a command (Service Interface)
///
/// The command receives the request on stdin. Its stdout becomes the response, and its exit code
/// determines the response state.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{REACHING_A_DEVICE}\n\n{WHAT_MAY_BE_WRITTEN}"))]
pub(super) struct ServiceArgs {
    /// UUID of the service; comma-separated UUIDs share the command
    #[arg(long, value_name = "UUID", required = true, value_delimiter = ',', value_parser = uuid)]
    uuid: Vec<ServiceId>,

    /// End the command after this time
    #[arg(long, value_name = "TIME", default_value = "30s", value_parser = some_time)]
    time_limit: Duration,

    /// Poll for requests at this interval
    #[arg(long, value_name = "TIME", default_value = "50ms", value_parser = some_time)]
    poll: Duration,

    /// Exit after this many answers [default: no limit]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
        value_parser = whole(1..=u64::from(u32::MAX)))]
    answers: Option<u64>,

    /// Exit after one answer
    #[arg(long, conflicts_with = "answers")]
    once: bool,

    #[command(flatten)]
    channel: ChannelArgs,

    #[command(flatten)]
    target: TargetArgs,

    /// The command and its arguments; run without a shell
    #[arg(last = true, required = true, value_name = "CMD")]
    command: Vec<String>,
}

const EXAMPLES: &str = "\
Examples:
  ads-cnc service --uuid 19719079-BA06-4740-BC02-DE5215211751 --channel 1 \\
      --target 192.0.2.7 --net-id 192.0.2.7.1.1 --allow-write allow.toml -- ./some-service
  ads-cnc service --uuid 560AACBF-6335-44a9-895A-8B27F3ED5E47 --once \\
      --allow-write allow.toml -- python3 square_root.py
  ads-cnc service --uuid 560AACBF-6335-44a9-895A-8B27F3ED5E47 --dry-run -- true

The file of --allow-write needs a table [[service]] with the channel.

The command
  stdin     the request in UTF-8 and a line feed. The request is never an argument, because its text
            comes from an NC program
  stdout    the response in UTF-8 (otherwise read as CP1252), without its last line end. A response
            longer than 127 bytes of CP1252 is truncated, with a warning
  stderr    passed through unchanged
  ADS_CNC_UUID, ADS_CNC_REQUEST_STATE, ADS_CNC_CHANNEL
            in the environment: UUID as given to --uuid, request state, channel

The response state
  1         exit code 0
  2, 3, …   the same exit code
  1001      exit code 1, which would look like success
  1002      the time limit was exceeded; the command was ended
  1003      the command was ended by a signal, or because the service was ended
  1004      the command could not be started, or 8 processes started by earlier commands still hold
            their stdout
  With the states 1002 to 1004, an empty response is replaced by the reason.

Processes that a command has started end with it, unless they have their own process group,
as after setsid.

An answer whose request no longer exists is dropped. SIGINT (Ctrl-C), SIGTERM and SIGHUP end the
service; it ends a running command and answers its request. A second signal ends the service at
once. A lost connection is an error: the service connects once more to read, but a write without a
reply may have arrived.

Exit codes: 0 ended by a signal, --once or --answers; 1 the CNC rejects a request; 2 wrong usage;
3 no connection, or connection lost; 4 rejected for safety; 70 internal error.";

fn uuid(text: &str) -> Result<ServiceId, String> {
    ServiceId::new(text).map_err(|_| {
        "expected 8, 4, 4, 4 and 12 hex digits, such as 560AACBF-6335-44A9-895A-8B27F3ED5E47"
            .to_owned()
    })
}

impl ServiceArgs {
    /// Answers requests, or in a dry run shows the ADS requests, and returns the exit code.
    pub(super) fn execute(&self) -> Exit {
        let done = if self.target.is_dry() { self.show() } else { self.serve() };
        self.target.end(done.map(|()| Exit::Success), |_| None)
    }

    /// Connects to the device, or to a simulated CNC with the manual's NC program, which requests
    /// square roots.
    fn open(&self) -> Result<Session, ToolError> {
        let channel = self.channel.channel;
        self.target.open_to_write(Entry::Service(channel), || {
            let cnc = default_cnc()?;
            let internal = |error: &dyn std::error::Error| ToolError::Internal(error.to_string());
            let square_root = ScriptConfig::square_root().map_err(|error| internal(&error))?;
            let config = ScriptConfig { repeat: Repeat::Endless, ..square_root };
            let script = Script::new(config).map_err(|error| internal(&error))?;
            cnc.set_script(channel.number(), Some(script))
                .map_err(|error| ToolError::Usage(format!("the simulated CNC: {error}")))?;
            Ok(cnc)
        })
    }

    /// Shows the ADS requests of one poll and one answer, without sending them.
    fn show(&self) -> Result<(), ToolError> {
        use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};

        let mut session = self.open()?;
        let channel = self.channel.channel;
        for variable in [RequestState, Uuid, Request] {
            match session.call(&read(channel, variable)?).map(drop) {
                Err(ToolError::NotSent) => {}
                other => other?,
            }
        }
        let mut rejected = None;
        for (variable, value) in
            [(Response, &b"\0"[..]), (RequestState, &[0; 4]), (ResponseState, &[1, 0, 0, 0])]
        {
            match session.call(&write(channel, variable, value)?).map(drop) {
                Err(error @ ToolError::NotPermitted(_)) => rejected = Some(error),
                other => other?,
            }
        }
        rejected.map_or(Ok(()), Err)
    }

    fn serve(&self) -> Result<(), ToolError> {
        let channel = self.channel.channel;
        // Check the writes before the first poll: an NC program would wait in vain for an answer
        // that the gate does not allow.
        let check = |session: &Session| {
            use ServiceVariable::{RequestState, Response, ResponseState};
            let mut writes = [Response, RequestState, ResponseState].into_iter();
            writes.try_for_each(|variable| {
                session.check(Task::Sda, write(channel, variable, &[0; 4])?)
            })
        };
        self.target.ask_gate(check)?;
        let interrupt = Interrupt::catch().map_err(|error| ToolError::uncaught(&error))?;
        let mut session = self.open()?;
        check(&session)?;
        let mut serving = Serving {
            host: Host::new(&self.uuid),
            command: ServiceCommand {
                words: &self.command,
                channel: channel.number(),
                limit: self.time_limit,
                interrupt: &interrupt,
                readers: Arc::default(),
            },
            channel,
            served: None,
            answered: 0,
            failed_writes: 0,
            last_warning: String::new(),
        };
        let answers = if self.once { Some(1) } else { self.answers };
        print_error(format_args!(
            "waiting for requests to {} in channel {}; Ctrl-C ends",
            self.uuid.iter().map(ServiceId::to_string).collect::<Vec<_>>().join(", "),
            channel.number()
        ));
        while answers.is_none_or(|answers| serving.answered < answers) {
            let is_idle = serving.step(&mut session)?;
            // A signal ends the loop only before a wait, so that the writes of an answer are
            // completed unless one of them fails.
            if is_idle && (serving.is_enough(answers) || interrupt.sleep(self.poll)) {
                break;
            }
        }
        serving.unanswered();
        Ok(())
    }
}

/// The state of the running service.
struct Serving<'s> {
    host: Host<'s>,
    command: ServiceCommand<'s>,
    channel: Channel,
    /// The request being answered and the response, as text; `None` once the outcome is printed.
    served: Option<String>,
    answered: u64,
    failed_writes: u32,
    /// The last warning that `warn_once` printed.
    last_warning: String,
}

impl Serving<'_> {
    fn is_enough(&self, answers: Option<u64>) -> bool {
        answers.is_some_and(|answers| self.answered >= answers)
    }

    /// Executes the next step; returns whether to wait before the following step.
    fn step(&mut self, session: &mut Session) -> Result<bool, ToolError> {
        match self.host.step() {
            HostStep::Read(variable) => {
                let value = session.call(&read(self.channel, variable)?)?;
                if let Err(error) = self.host.read(value.bytes) {
                    self.warn_once(&error.to_string());
                    return Ok(true);
                }
                Ok(false)
            }
            HostStep::Write(variable, value) => {
                match session.call(&write(self.channel, variable, value)?).map(drop) {
                    Ok(()) => {
                        self.failed_writes = 0;
                        self.host.written();
                        Ok(false)
                    }
                    Err(error @ ToolError::Ads { .. }) => {
                        self.failed_writes = self.failed_writes.saturating_add(1);
                        if self.failed_writes >= FAILED_WRITES_MAX {
                            self.unanswered();
                            return Err(error);
                        }
                        self.host.failed();
                        Ok(true)
                    }
                    Err(error) => {
                        self.unanswered();
                        Err(error)
                    }
                }
            }
            HostStep::Serve { uuid, request, request_state } => {
                let ServiceResponse { response, state, warnings } =
                    self.command.run(*uuid, request, request_state);
                let shown = format!(
                    "{uuid} {:?}, state {request_state}: {:?}, state {state}",
                    request.to_string(),
                    response.to_string()
                );
                for warning in warnings {
                    print_error(format_args!("warning: {warning}"));
                }
                let answered = self.host.answer(response.as_cnc_str(), state);
                answered.map_err(|error| ToolError::Internal(error.to_string()))?;
                self.served = Some(shown);
                Ok(false)
            }
            HostStep::Wait => {
                self.print_outcome()?;
                self.host.poll();
                Ok(true)
            }
        }
    }

    /// Prints the outcome of the last answer, unless it was printed before, and counts the answer
    /// unless it was dropped.
    fn print_outcome(&mut self) -> Result<(), ToolError> {
        let Some(served) = self.served.take() else { return Ok(()) };
        match self.host.outcome() {
            Some(Outcome::Answered) => {
                self.answered = self.answered.saturating_add(1);
                let mut out = io::stdout().lock();
                let told = writeln!(out, "{served}").and_then(|()| out.flush());
                told.map_err(|error| {
                    ToolError::Internal(format!("cannot write to stdout: {error}"))
                })
            }
            _ => {
                print_error(format_args!(
                    "dropped, because the request no longer exists: {served}"
                ));
                Ok(())
            }
        }
    }

    fn unanswered(&self) {
        if let Some(served) = &self.served {
            print_error(format_args!(
                "this answer may not have arrived; the NC program may still wait for it: {served}"
            ));
        }
    }

    /// Prints a warning, unless it is the same as the last one.
    fn warn_once(&mut self, what: &str) {
        if self.last_warning != what {
            print_error(format_args!("warning: no request: {what}"));
            what.clone_into(&mut self.last_warning);
        }
    }
}

fn read(channel: Channel, variable: ServiceVariable) -> Result<ReadByName<'static>, ToolError> {
    ReadByName::new(channel, variable.name()).map_err(ToolError::Unsendable)
}

fn write(
    channel: Channel,
    variable: ServiceVariable,
    value: &[u8],
) -> Result<WriteByName<'_>, ToolError> {
    WriteByName::new(channel, variable.name(), value).map_err(ToolError::Unsendable)
}
