//! `ads-cnc stream`: sends an NC program in packets to the streaming object of a channel.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

mod check;
mod progress;
mod send;

use std::fs::File;
use std::io::{self, Read, Write as _};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

use ads_cnc::operation::{Task, WriteProgramStream};
use ads_cnc::streaming::{NcText, Sender};
use clap::Args;

use super::message::print_error;
use super::numbers::whole;
use super::target::{ChannelArgs, REACHING_A_DEVICE, TargetArgs, WHAT_MAY_BE_WRITTEN, default_cnc};
use crate::exit::Exit;
use crate::gate::Entry;
use crate::process::interrupt::Interrupt;
use crate::session::{Session, ToolError};
use crate::text::duration;
use check::CheckedText;
use progress::StreamProgress;
use send::{Retry, SendEnd, Sending};

const PROGRAM_MAX: u64 = 256 * 1024 * 1024;

/// Stream an NC program to a channel: this moves the machine
///
/// The command first checks the whole text, then sends it in packets of whole lines while the CNC
/// runs the lines that it has received. A packet that the CNC rejects as busy is sent again.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{REACHING_A_DEVICE}\n\n{WHAT_MAY_BE_WRITTEN}"))]
pub(super) struct StreamArgs {
    /// The NC program; - reads it from stdin
    #[arg(value_name = "FILE.nc")]
    file: PathBuf,

    /// Wait this long before sending a packet again that the CNC rejected as busy
    #[arg(long, value_name = "TIME", default_value = "500ms", value_parser = duration)]
    retry_after: Duration,

    /// Send a packet again at most this many times; 1200 times 500ms are ten minutes
    #[arg(long, value_name = "N", default_value_t = 1200,
        allow_negative_numbers = true, value_parser = whole(0..=u32::MAX))]
    retries: u32,

    /// Send the program even if the check reports that a line would end streaming
    #[arg(long)]
    force: bool,

    /// Show no progress
    #[arg(long, short)]
    quiet: bool,

    #[command(flatten)]
    channel: ChannelArgs,

    #[command(flatten)]
    target: TargetArgs,
}

const EXAMPLES: &str = "\
Examples:
  ads-cnc stream part.nc
  ads-cnc stream part.nc --dry-run
  ads-cnc stream part.nc --channel 2 --allow-write allow.toml \\
      --target 192.0.2.7 --net-id 192.0.2.7.1.1
  generate-path | ads-cnc stream - --target 127.0.0.1 --net-id 127.0.0.1.1.1 \
      --allow-write allow.toml

The file of --allow-write needs a table [[stream]] with the channel. Without --target, the command
starts a simulated CNC for a trial, which needs no file and ends with the command.

The CNC accepts the text if the program named by P-CHAN-00158 has been started there. Its buffer
holds 4094 bytes. While the buffer is full, the CNC rejects packets as busy, and the command sends
them again. The CNC may not have run all accepted lines yet: wait until it has before the next
program. A line that cannot be sent is an error. A line that ends streaming, such as a loop or a
jump back, is an error too; the check may be wrong about it, so --force sends it. The command warns
of lines that would be lost or left over.

SIGINT (Ctrl-C), SIGTERM and SIGHUP end the command between two packets. This does not stop the
machine, which runs the accepted lines. A packet without a reply is not sent again.

Exit codes: 0 all lines accepted; 1 the text is invalid, or the CNC rejects it; 2 wrong usage;
3 unfinished: a signal, no connection or no reply; 4 rejected for safety; 70 internal error.
Once the command has sent a packet, stdout shows which lines were accepted and, if it ends early,
which were not.";

impl StreamArgs {
    /// Sends the program and returns the exit code.
    pub(super) fn execute(&self) -> Exit {
        self.target.end(self.run(), |_| None)
    }

    fn run(&self) -> Result<Exit, ToolError> {
        let name = self.name();
        let bytes = self.read(&name)?;
        let CheckedText { text, ends } = match check::check(&bytes, &name, &mut io::stderr().lock())
        {
            Some(checked) => checked,
            None => {
                print_error("nothing was sent, because of the errors above");
                return Ok(Exit::Failure);
            }
        };
        if ends > 0 && !self.force {
            print_error(
                "nothing was sent: the lines above would end streaming; --force sends them anyway",
            );
            return Ok(Exit::Failure);
        }
        let Some(lines) = NonZeroUsize::new(text.line_count()) else {
            return Err(ToolError::Usage(format!("{name} is empty")));
        };
        if self.target.is_dry() { self.show(text) } else { self.send(&name, text, lines) }
    }

    fn open(&self) -> Result<Session, ToolError> {
        self.target.open_to_write(Entry::Stream(self.channel.channel), default_cnc)
    }

    /// Shows every packet and whether the gate would allow it.
    fn show(&self, text: NcText<'_>) -> Result<Exit, ToolError> {
        let mut session = self.open()?;
        let mut sender = Sender::new(text);
        let mut rejected = None;
        while let Some(packet) = sender.packet() {
            let shown = session.call(&WriteProgramStream::new(self.channel.channel, packet));
            match shown.map(drop) {
                Err(error @ ToolError::NotPermitted(_)) => rejected = Some(error),
                other => other?,
            }
            send::acknowledge(&mut sender, ads_cnc::streaming::Ack::Accepted)?;
        }
        rejected.map_or(Ok(Exit::Success), Err)
    }

    fn send(&self, name: &str, text: NcText<'_>, lines: NonZeroUsize) -> Result<Exit, ToolError> {
        let mut first = Sender::new(text);
        let write =
            WriteProgramStream::new(self.channel.channel, first.packet().unwrap_or_default());
        self.target.ask_gate(|session| session.check(Task::Com, write))?;
        let interrupt = Interrupt::catch().map_err(|error| ToolError::uncaught(&error))?;
        let mut session = self.open()?;
        let mut sending = Sending {
            sender: Sender::new(text),
            channel: self.channel.channel,
            retry: Retry { after: self.retry_after, times: self.retries },
            busy_rejections: 0,
            out: 0,
        };
        let mut progress = StreamProgress::new(text, self.quiet);
        let end = sending.run(&mut session, &interrupt, &mut progress);
        let took = progress.elapsed();
        drop(progress);
        let channel = self.channel.channel.number();
        let summary = sending.summary(name, lines.get(), &end, took);
        // Unlike other output, a lost summary is an error even if the pipe is closed: it states what
        // the machine runs.
        if let Err(error) = writeln!(io::stdout().lock(), "{summary}") {
            print_error(format_args!("{summary}"));
            return Err(ToolError::Internal(format!("cannot write the summary: {error}")));
        }
        Ok(match end {
            SendEnd::Done => Exit::Success,
            SendEnd::Interrupted => {
                print_error("interrupted. The machine still runs the accepted lines");
                Exit::Nothing
            }
            SendEnd::GivenUp(error) => {
                print_error(format_args!(
                    "gave up: the CNC still rejects the packet with {error:#x}. Check that the \
                     streaming program (see P-CHAN-00158) is running in channel {channel} and that \
                     the machine is not stopped; increase --retries to wait longer"
                ));
                Exit::Failure
            }
            SendEnd::Stopped(error) => {
                print_error(&error);
                if error.ads_error().is_some() {
                    print_error(format_args!(
                        "this error does not mean busy, so the packet is not sent again. Check that \
                         P-CHAN-00158 names a streaming program for channel {channel}"
                    ));
                }
                error.exit()
            }
            SendEnd::Unknown(error) => {
                print_error(&error);
                print_error("the packet is not sent again: running its lines twice may do harm");
                error.exit()
            }
        })
    }

    /// The name of the program in messages.
    fn name(&self) -> String {
        if self.file == Path::new("-") {
            "stdin".to_owned()
        } else {
            crate::text::escape_lines(&self.file.display().to_string())
        }
    }

    fn read(&self, name: &str) -> Result<Vec<u8>, ToolError> {
        let failed = |error: io::Error| ToolError::Usage(format!("{name}: {error}"));
        let from: &mut dyn Read = if self.file == Path::new("-") {
            &mut io::stdin().lock()
        } else {
            &mut File::open(&self.file).map_err(failed)?
        };
        let mut bytes = Vec::new();
        from.take(PROGRAM_MAX.saturating_add(1)).read_to_end(&mut bytes).map_err(failed)?;
        match u64::try_from(bytes.len()) {
            Ok(length) if length <= PROGRAM_MAX => Ok(bytes),
            _ => Err(ToolError::Usage(format!(
                "{name} has more than {PROGRAM_MAX} bytes; send it in parts"
            ))),
        }
    }
}
