//! `ads-cnc testee`: this project's codec over the testee protocol.

use std::io::{self, BufRead as _, Write as _};

use clap::Args;

use super::{complain, find_defect};
use crate::testee::{Answer, Command, Own, Reply};
use crate::verdict::Exit;

/// Answers the protocol of `run --testee` with this project's codec, on stdin and stdout.
///
/// A testee to try an adapter's counterpart with, and an example of all answers: one JSON object a
/// line. See conformance/adapters/README.md.
#[derive(Args, Debug)]
pub(super) struct Testee {
    /// Switch on a defect of the codec (see serve --list-defects)
    #[arg(long, value_name = "ID")]
    defect: Option<String>,
}

impl Testee {
    /// Answers until `bye` or the end of stdin.
    pub(super) fn execute(&self) -> Exit {
        let defect = match find_defect(self.defect.as_deref()) {
            Ok(defect) => defect,
            Err(why) => {
                complain(why);
                return Exit::Usage;
            }
        };
        match answer(&Own { defect }) {
            Ok(()) => Exit::Success,
            Err(error) => {
                complain(format_args!("stdin or stdout: {error}"));
                Exit::Internal
            }
        }
    }
}

fn answer(own: &Own) -> io::Result<()> {
    let mut out = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        match serde_json::from_str::<Command>(&line?) {
            Ok(Command::Hello { .. }) => serde_json::to_writer(&mut out, &own.hello())?,
            Ok(Command::Bye) => return Ok(()),
            Ok(Command::Case { seq, question }) => {
                let reply = Reply { seq: Some(seq), answer: own.answer(&question) };
                serde_json::to_writer(&mut out, &reply)?;
            }
            Err(error) => {
                let answer = Answer::Error { message: error.to_string() };
                serde_json::to_writer(&mut out, &Reply { seq: None, answer })?;
            }
        }
        out.write_all(b"\n")?;
        out.flush()?;
    }
    Ok(())
}
