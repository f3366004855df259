//! The command `ads-cnc`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ads_cnc_conformance::cli::main()
}
