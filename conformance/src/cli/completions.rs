//! `ads-cnc completions`: completion scripts for shells.

use clap::{Args, Command};
use clap_complete::Shell;

use super::output::print_output;
use crate::exit::Exit;

/// Print a script that completes the command line in a shell
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
    /// Writes the script for this command line and returns the exit code.
    pub(super) fn execute(&self, mut command: Command) -> Exit {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut command, "ads-cnc", &mut script);
        print_output(|out| out.write_all(&script))
    }
}
