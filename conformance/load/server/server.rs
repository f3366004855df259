//! The servers, each in a separate process.

use std::io::{BufRead as _, BufReader};
use std::net::SocketAddr;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use crate::work::{Result, Work};

/// Time limit for a server to listen; Python starts slowly on a busy machine.
const START: Duration = Duration::from_secs(30);

/// A server that is ended when dropped.
pub(crate) struct Server {
    pub(crate) name: &'static str,
    pub(crate) addr: SocketAddr,
    /// The versions of pyads and Python, or empty for the other servers.
    pub(crate) about: String,
    child: Child,
}

const ECHO: &str = "echo";

/// The subcommand that serves the simulated CNC, as in `ads-cnc`.
pub(crate) const SERVE: &str = "serve";

impl Server {
    /// Starts the echo server with this program.
    pub(crate) fn echo(work: &Work) -> Result<Self> {
        let hex: String = work.reply(0)?.iter().map(|byte| format!("{byte:02x}")).collect();
        let mut command = Command::new(std::env::current_exe()?);
        command.args(["echo", &work.request_len().to_string(), &hex]);
        Self::start(ECHO, command)
    }

    /// Starts the simulated CNC with this program, because a build of the command could be outdated.
    pub(crate) fn cnc() -> Result<Self> {
        let mut command = Command::new(std::env::current_exe()?);
        command.args([SERVE, "--listen", "127.0.0.1:0", "--log", "warn"]);
        let mut server = Self::start("ads-cnc serve", command)?;
        server.about.clear();
        Ok(server)
    }

    /// Starts the test server of pyads with the value to be read as its only variable.
    pub(crate) fn pyads(python: &str, work: &Work) -> Result<Self> {
        let value: String = work.expected.iter().map(|byte| format!("{byte:02x}")).collect();
        let mut command = Command::new(python);
        command.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/server/pyads_server.py")).args([
            work.group.to_string(),
            work.offset.to_string(),
            value,
        ]);
        Self::start("pyads.testserver", command)
    }

    fn start(name: &'static str, mut command: Command) -> Result<Self> {
        // The pipe to stdin closes when this process ends for any reason; then the echo server and
        // the server of pyads end too.
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(|error| format!("{name}: {error}"))?;
        let stdout = child.stdout.take();
        let addr = SocketAddr::from(([0, 0, 0, 0], 0));
        let mut server = Self { name, addr, about: String::new(), child };
        let (sender, receiver) = mpsc::channel();
        thread::spawn(move || {
            let mut line = String::new();
            let read = stdout.map(|stdout| BufReader::new(stdout).read_line(&mut line));
            let _gone = sender.send(read.map(|_| line));
        });
        let line = receiver.recv_timeout(START).ok().flatten().unwrap_or_default();
        let rest = line.trim_end().strip_prefix("listening on ");
        let rest = rest.ok_or_else(|| format!("{name}: no line with the address"))?;
        let (addr, about) = rest.split_once(", ").unwrap_or((rest, ""));
        (server.addr, server.about) = (addr.parse()?, about.to_owned());
        Ok(server)
    }

    /// Whether the server is the echo server, which repeats the same reply.
    pub(crate) fn is_echo(&self) -> bool {
        self.name == ECHO
    }

    /// CPU time of the server so far in seconds, if the system provides it.
    pub(crate) fn cpu(&self) -> Option<f64> {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.child.id())).ok()?;
        // The fields from 3 on follow the name in brackets; 14 and 15 are user and system time in
        // hundredths of a second.
        let mut fields = stat.rsplit_once(") ")?.1.split(' ').skip(11);
        let mut next = || fields.next()?.parse::<u32>().ok().map(f64::from);
        Some((next()? + next()?) / 100.0)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // This fails if the process has already ended.
        let _ended = self.child.kill().and_then(|()| self.child.wait());
    }
}
