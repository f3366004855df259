//! `ads-cnc completions` as users call it.

use std::process::Command;

#[test]
fn every_script_contains_every_command() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
        let output = command.args(["completions", shell]).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{shell}");
        let script = String::from_utf8(output.stdout).unwrap();
        for word in ["run", "serve", "explain", "stream", "service", "allow-write", "retry-after"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
    assert_eq!(command.args(["completions", "tcsh"]).output().unwrap().status.code(), Some(2));
}
