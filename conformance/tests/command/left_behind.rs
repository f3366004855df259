//! An interrupted run terminates its testee or client, and a process that this has started in the
//! same process group.

#![cfg(unix)]

use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::common::file::TestFile;
use crate::common::{runs, signal};

/// Maximum time for which a test waits for processes to start or to end.
const WAIT_MAX: Duration = Duration::from_secs(30);

fn wait_until(mut done: impl FnMut() -> bool, what: &str) {
    let begun = Instant::now();
    while !done() {
        assert!(begun.elapsed() < WAIT_MAX, "{what}");
        thread::sleep(Duration::from_millis(10));
    }
}

/// Runs the suite with a testee or client that ignores stdin and some signals and starts another
/// process, and sends the signals `names` to the suite. Returns the exit code, the JSON report and
/// stderr.
fn interrupted(option: &str, greeting: &str, names: &[&str]) -> (Option<i32>, TestFile, String) {
    let (ids, json) = (TestFile::new(".txt", b""), TestFile::new(".json", b""));
    let command = format!(
        "trap '' INT TERM HUP; sleep 1000 & echo $! >> {0}; {greeting} echo $$ >> {0}; \
         while :; do sleep 1000; done",
        ids.path()
    );
    let tool = Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
        .args(["run", option, &command, "--json", json.path(), "--timeout", "60000"])
        .args(["--client-timeout", "60000"])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let read = || std::fs::read_to_string(&ids.0).unwrap();
    wait_until(|| read().lines().count() == 2, "it is not started");
    for name in names {
        signal(name, tool.id());
        thread::sleep(Duration::from_millis(if names.len() > 1 { 1 } else { 0 }));
    }
    let begun = Instant::now();
    let output = tool.wait_with_output().unwrap();
    assert!(begun.elapsed() < Duration::from_secs(10), "{:?}", begun.elapsed());
    let stderr_text = String::from_utf8(output.stderr).unwrap();
    wait_until(|| !read().lines().any(runs), "a process is left behind");
    (output.status.code(), json, stderr_text)
}

const HELLO: &str = r#"printf '{"protocol":1,"testee":{"name":"deaf"},"capabilities":{"ops":["decode"],"streams":["object-count"],"editions":["en-1.05"]}}\n';"#;

#[test]
fn a_signal_ends_a_testee_and_its_processes() {
    for (name, greeting) in
        [("INT", HELLO), ("TERM", HELLO), ("HUP", HELLO), ("QUIT", HELLO), ("TERM", "")]
    {
        let (code, json, stderr_text) = interrupted("--testee", greeting, &[name]);
        assert_eq!(code, Some(3), "SIG{name}: {stderr_text}");
        assert!(stderr_text.contains("interrupted"), "{stderr_text}");
        let report = std::fs::read_to_string(&json.0).unwrap();
        assert!(report.contains("\"verdict\": \"interrupted\""), "{report}");
        assert!(!report.contains("\"verdict\": \"fail\""), "{report}");
    }
}

#[test]
fn a_signal_ends_a_client_and_its_processes() {
    for name in ["INT", "TERM", "HUP", "QUIT", "USR1"] {
        let (code, json, stderr_text) = interrupted("--client", "", &[name]);
        assert_eq!(code, Some(3), "SIG{name}: {stderr_text}");
        let report = std::fs::read_to_string(&json.0).unwrap();
        assert!(report.contains("\"verdict\": \"interrupted\""), "{report}");
    }
}

/// The processes also end if a second signal ends the run at once.
#[test]
fn two_signals_also_end_the_processes() {
    for option in ["--testee", "--client"] {
        let (code, ..) = interrupted(option, "", &["INT", "TERM"]);
        assert!(matches!(code, Some(3 | 130)), "{code:?}");
    }
}
