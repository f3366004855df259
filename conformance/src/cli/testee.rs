//! `ads-cnc testee`: answers the testee protocol with this project's codec.

use std::io::{self, BufRead as _, Write as _};

use clap::Args;

use super::message::exit_with_error;
use super::serve::find_defect;
use crate::exit::Exit;
use crate::testee::{Answer, AnswerLine, CodecTestee, Miniature, MiniatureAction, TesteeCommand};
use crate::text::json_error;

/// Answer the protocol of `run --testee` with this project's codec
///
/// This testee tests the suite's side of the protocol and is an example of all answers, one JSON
/// object per line. See conformance/adapters/README.md.
#[derive(Args, Debug)]
pub(super) struct TesteeArgs {
    /// Enable a defect of the codec (see serve --list-defects)
    #[arg(long, value_name = "ID")]
    defect: Option<String>,

    /// Misbehave in a way that the suite must detect, to test the suite: accepts-all, rejects-all,
    /// hangs, crashes, …; noisy, decodes-only and terse are correct
    #[arg(long, value_name = "NAME", conflicts_with = "defect", value_parser = Miniature::by_name)]
    miniature: Option<Miniature>,
}

impl TesteeArgs {
    /// Answers the requests of the suite until `bye` or the end of stdin.
    pub(super) fn execute(&self) -> Exit {
        let defect = match find_defect(self.defect.as_deref()) {
            Ok(defect) => defect,
            Err(why) => return exit_with_error(Exit::Usage, why),
        };
        if let Some(defect) = defect.as_ref().filter(|defect| !defect.is_for_codec()) {
            let why = format!("{} is a defect of a CNC, not of a codec", defect.id);
            return exit_with_error(Exit::Usage, why);
        }
        let own = CodecTestee { defect };
        let done = match self.miniature {
            None => answer(&own),
            Some(miniature) => misbehave(miniature, &own),
        };
        match done {
            Ok(()) => Exit::Success,
            Err(error) => exit_with_error(Exit::Internal, format_args!("stdin or stdout: {error}")),
        }
    }
}

fn answer(own: &CodecTestee) -> io::Result<()> {
    let mut out = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        let line = line?;
        match serde_json::from_str::<TesteeCommand>(&line) {
            Ok(TesteeCommand::Hello { .. }) => serde_json::to_writer(&mut out, &own.hello())?,
            Ok(TesteeCommand::Bye) => return Ok(()),
            Ok(TesteeCommand::Case { seq, question }) => {
                let reply = AnswerLine { seq: Some(seq), answer: own.answer(&question) };
                serde_json::to_writer(&mut out, &reply)?;
            }
            Err(error) => {
                let answer = Answer::Error { message: json_error(&line, &error) };
                serde_json::to_writer(&mut out, &AnswerLine { seq: None, answer })?;
            }
        }
        out.write_all(b"\n")?;
        out.flush()?;
    }
    Ok(())
}

fn misbehave(miniature: Miniature, own: &CodecTestee) -> io::Result<()> {
    let mut out = io::stdout().lock();
    let mut seq = 0;
    for line in io::stdin().lock().lines() {
        let line = line?;
        if miniature == Miniature::Noisy {
            writeln!(io::stderr(), "{line:>1000}")?;
        }
        match serde_json::from_str::<TesteeCommand>(&line) {
            Ok(TesteeCommand::Hello { .. }) => {
                serde_json::to_writer(&mut out, &miniature.hello(own))?;
                out.write_all(b"\n")?;
            }
            Ok(TesteeCommand::Bye) if miniature == Miniature::IgnoresBye => stay(),
            Ok(TesteeCommand::Bye) => return Ok(()),
            other => {
                if let Ok(TesteeCommand::Case { seq: given, .. }) = other {
                    seq = given;
                }
                match miniature.act(own, &line, seq) {
                    MiniatureAction::Say(line) => writeln!(out, "{line}")?,
                    MiniatureAction::Hang => stay(),
                    MiniatureAction::Crash => std::process::exit(i32::from(Exit::Internal.code())),
                }
            }
        }
        out.flush()?;
    }
    Ok(())
}

/// Hangs until the process is killed, but at most for a minute.
fn stay() -> ! {
    std::thread::sleep(std::time::Duration::from_secs(60));
    std::process::exit(i32::from(Exit::Internal.code()))
}
