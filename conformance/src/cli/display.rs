//! Options for showing results: colour and verbosity.

use std::io::{self, IsTerminal as _};

use clap::{Args, ValueEnum};

use crate::report::{Detail, DisplayOptions};

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Color {
    Auto,
    Always,
    Never,
}

impl Color {
    pub(super) fn is_on(self) -> bool {
        let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
        let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        // Some consoles of Windows print escape sequences as text. Windows Terminal, ANSICON and
        // many terminal emulators set one of these variables.
        let takes = !cfg!(windows) || ["WT_SESSION", "ANSICON", "TERM"].into_iter().any(set);
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => takes && !dumb && !set("NO_COLOR") && io::stdout().is_terminal(),
        }
    }
}

/// Options for the result on the console.
#[derive(Args, Clone, Copy, Debug)]
pub(super) struct DisplayArgs {
    /// Show every case, and the requirements that did not pass
    #[arg(long, short)]
    verbose: bool,

    /// Show only the last line and, above it, reasons such as a rejected write
    #[arg(long, short, conflicts_with = "verbose")]
    quiet: bool,

    /// When to colour the output; auto: on a terminal, unless NO_COLOR is set
    #[arg(long, hide_short_help = true, value_name = "WHEN", default_value = "auto")]
    color: Color,
}

impl DisplayArgs {
    /// Whether --quiet is given.
    pub(super) const fn is_quiet(self) -> bool {
        self.quiet
    }

    pub(super) fn display(self) -> DisplayOptions {
        let detail = match (self.quiet, self.verbose) {
            (true, _) => Detail::Quiet,
            (_, true) => Detail::Verbose,
            _ => Detail::Normal,
        };
        DisplayOptions { detail, color: self.color.is_on(), found_shown: false }
    }
}
