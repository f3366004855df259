//! The environment in which the calls of documents are executed: a folder and two simulated CNCs.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};
use std::{env, thread};

use super::common::Serve;
use super::shown::{Shown, fits, words};

/// Time limit of a call that ends by itself, which is long because a build by cargo may take
/// minutes.
const WAIT_MAX: Duration = Duration::from_secs(900);

/// Time limit for a call that does not end by itself to print the shown output.
const PATIENCE_ENDLESS: Duration = Duration::from_secs(60);

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

pub(crate) struct Bench {
    directory: PathBuf,
    /// The simulated CNC that calls use as the device 192.0.2.10.
    device: Serve,
    /// The simulated CNC that calls use as 127.0.0.1; its NC program requests square roots.
    cnc: Serve,
}

impl Bench {
    /// Creates the environment, with files that the calls use or show.
    pub(crate) fn new(name: &str, shown: &[Shown]) -> Self {
        let directory = format!("ads-cnc-shown-{name}-{}", std::process::id());
        let directory = env::temp_dir().join(directory);
        fs::create_dir_all(&directory).unwrap();
        let device = Serve::start(&["--net-id", "192.0.2.10.1.1"]);
        let bench = Self { directory, device, cnc: Serve::start(&["--ask-square-roots"]) };
        let part: String =
            (1..=100).map(|line| format!("N{line}0 G01 X{line} Y-{line}\n")).collect();
        bench.write("part.nc", &part);
        for Shown { call, output } in shown {
            if let Some(name) = call.strip_prefix("cat ") {
                bench.write(name, &output.replace("expires = 2030-", "expires = 9999-"));
            }
            // Writes the entry that a rejection in the document suggests to the file that the next
            // call uses.
            if let Some((_, entry)) = output.split_once("--allow-write:\n\n") {
                let expires = "expires = 9999-12-31T23:59:59Z";
                bench.write("test.toml", &entry.replace("expires = …", expires));
            }
        }
        bench
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.directory.join(name), text).unwrap();
    }

    /// Executes a call and compares its output with the document; a call without shown output must succeed.
    pub(crate) fn make(&self, shown: &Shown) {
        let Shown { call, output } = shown;
        let (found, status) = self.output(call, output);
        if output.is_empty() {
            assert!(status.is_some_and(|status| status.success()), "{call}\n{found}");
        } else {
            assert!(fits(output, &found), "{call}\nshown:\n{output}\nfound:\n{found}");
        }
    }

    /// Executes a call; returns its output, if the call does not write it to a file, and the exit
    /// status. The output of `ads-cnc` includes stderr. A call that does not end by itself is ended
    /// after it has printed the shown output, and any call at its time limit.
    fn output(&self, call: &str, shown: &str) -> (String, Option<ExitStatus>) {
        let mut words = words(call);
        let is_endless = call.starts_with("ads-cnc serve ");
        let (call, into) = match words.iter().position(|word| word == ">") {
            Some(place) => (words[..place].to_vec(), Some(words.remove(place + 1))),
            None => (words, None),
        };
        let path = self.directory.join(into.as_deref().unwrap_or("output.txt"));
        let out = File::create(&path).unwrap();
        let mut process =
            self.command(&call, &out).stdout(out).stdin(Stdio::null()).spawn().unwrap();
        let end = Instant::now() + if is_endless { PATIENCE_ENDLESS } else { WAIT_MAX };
        let read = || fs::read_to_string(&path).unwrap();
        loop {
            if let Some(status) = process.try_wait().unwrap() {
                return (if into.is_some() { String::new() } else { read() }, Some(status));
            }
            if is_endless && fits(shown, &read()) || Instant::now() > end {
                process.kill().unwrap();
                process.wait().unwrap();
                return (read(), None);
            }
            thread::sleep(Duration::from_millis(10));
        }
    }

    fn command(&self, words: &[String], out: &File) -> Command {
        // A call of `serve` must not use the port of the CNC, so the system chooses a port.
        let to_cnc = if words[1] == "serve" { "127.0.0.1:0" } else { &self.cnc.addr };
        let here = |word| match word {
            "192.0.2.10" => &self.device.addr,
            "127.0.0.1" | "127.0.0.1:48898" => to_cnc,
            word => word,
        };
        let words: Vec<&str> = words.iter().map(|word| here(word.as_str())).collect();
        let (program, arguments) = words.split_first().unwrap();
        let mut command = match *program {
            // On stderr, cargo prints its own messages, which the documents do not show.
            "cargo" => {
                let mut cargo = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()));
                cargo.current_dir(root()).stderr(Stdio::null());
                cargo
            }
            "ads-cnc" => {
                let built = || env!("CARGO_BIN_EXE_ads-cnc").into();
                let mut tool = Command::new(env::var_os("ADS_CNC_TOOL").unwrap_or_else(built));
                let is_ours = arguments.iter().any(|word| word.contains("conformance/adapters/"));
                tool.current_dir(if is_ours { root() } else { self.directory.clone() });
                tool.stderr(out.try_clone().unwrap());
                tool
            }
            other => panic!("unknown command {other}"),
        };
        command.args(arguments);
        if let ["check", ..] = arguments {
            // The call has no port, but the device of this test does not listen at the default port.
            command.args(["--port", self.device.addr.rsplit(':').next().unwrap()]);
        }
        command
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        let _gone = fs::remove_dir_all(&self.directory);
    }
}
