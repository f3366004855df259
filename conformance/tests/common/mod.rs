//! Helpers of the tests, such as the command `ads-cnc`, `ads-cnc serve` in a separate process, and
//! a connection to it without a gate.

#![allow(dead_code, reason = "not every test uses every item")]

pub(crate) mod fake;
pub(crate) mod file;
pub(crate) mod harmless;
pub(crate) mod proxy;
pub(crate) mod task;

use std::fs;
use std::io::{BufRead as _, BufReader};
use std::net::TcpStream;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use serde_json::Value;

/// Runs the command with these arguments, and waits for its end.
pub(crate) fn ads_cnc(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ads-cnc")).args(args).output().unwrap()
}

/// The exit code, stdout and stderr of the command with these arguments.
pub(crate) fn run_tool(args: &[&str]) -> (Option<i32>, String, String) {
    let output = ads_cnc(args);
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// An output as text, which must be UTF-8.
pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Checks that a document matches the JSON Schema `schema/<name>.schema.json`, and that this is a
/// valid schema.
#[track_caller]
pub(crate) fn check_schema(document: &Value, name: &str) {
    let file = format!("{}/schema/{name}.schema.json", env!("CARGO_MANIFEST_DIR"));
    let schema: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    jsonschema::draft202012::meta::validate(&schema).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    let errors: Vec<String> = schema.iter_errors(document).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{:?}", &errors[..errors.len().min(5)]);
}

/// A simulated CNC in a separate process, which is ended when this value is dropped.
pub(crate) struct Serve {
    pub(crate) process: Child,
    pub(crate) addr: String,
    pub(crate) net_id: String,
}

impl Serve {
    pub(crate) fn start(options: &[&str]) -> Self {
        Self::with_stderr(options, Stdio::null())
    }

    /// Starts the CNC with a pipe for its log.
    pub(crate) fn logging(options: &[&str]) -> Self {
        Self::with_stderr(options, Stdio::piped())
    }

    fn with_stderr(options: &[&str], stderr: Stdio) -> Self {
        let listen: &[&str] = match options.contains(&"--listen") {
            true => &[],
            false => &["--listen", "127.0.0.1:0"],
        };
        let mut process = Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
            .arg("serve")
            .args(listen)
            .args(options)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(stderr)
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let rest = line.strip_prefix("listening on ").unwrap();
        let (addr, net_id) = rest.trim_end().split_once(", AMS NetId ").unwrap();
        Self { addr: addr.to_owned(), net_id: net_id.to_owned(), process }
    }
}

impl Drop for Serve {
    fn drop(&mut self) {
        // `kill` fails if the process has already ended.
        let _ended = self.process.kill().and_then(|()| self.process.wait());
    }
}

/// A TCP connection without a gate, which sends any bytes.
#[allow(clippy::disallowed_methods, reason = "to a listener of the test")]
pub(crate) fn connect(addr: std::net::SocketAddr) -> TcpStream {
    let stream = TcpStream::connect_timeout(&addr, Duration::from_secs(5)).unwrap();
    stream.set_nodelay(true).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    stream
}

/// Whether a process runs; a zombie does not.
#[cfg(unix)]
pub(crate) fn runs(id: &str) -> bool {
    let shown = Command::new("ps").args(["-o", "stat=", "-p", id]).output().unwrap();
    let state = text(&shown.stdout);
    !state.trim().is_empty() && !state.trim_start().starts_with('Z')
}

/// Sends a signal by its name, such as `TERM`.
#[cfg(unix)]
pub(crate) fn signal(name: &str, process: u32) {
    let option = format!("-{name}");
    let sent = Command::new("kill").args([&option, &process.to_string()]).status().unwrap();
    assert!(sent.success(), "SIG{name} to {process}");
}
