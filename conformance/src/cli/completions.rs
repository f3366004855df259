//! `ads-cnc completions`: what a shell completes the command line with.

use std::io::{self, Write as _};

use clap::{Args, CommandFactory as _};
use clap_complete::Shell;

use super::{Cli, complain};
use crate::judge::Exit;

/// Writes a script that lets a shell complete what is typed.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Completions {
    /// The shell
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

const EXAMPLES: &str = "\
Examples:
  ads-cnc completions bash > ~/.local/share/bash-completion/completions/ads-cnc
  ads-cnc completions zsh > ~/.zfunc/_ads-cnc       (with ~/.zfunc in fpath)
  ads-cnc completions fish > ~/.config/fish/completions/ads-cnc.fish
  ads-cnc completions powershell >> $PROFILE

Exit codes: 0 written; 2 wrong usage; 70 internal error.";

impl Completions {
    /// Writes the script and returns the exit code.
    pub(super) fn execute(&self) -> Exit {
        let mut script = Vec::new();
        let mut command = Cli::command();
        clap_complete::generate(self.shell, &mut command, "ads-cnc", &mut script);
        let mut out = io::stdout().lock();
        match out.write_all(&script).and_then(|()| out.flush()) {
            Ok(()) => Exit::Success,
            Err(error) => {
                complain(format_args!("the script is not written: {error}"));
                Exit::Internal
            }
        }
    }
}
