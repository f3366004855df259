//! The servers, each in a process of its own.

use std::io::{BufRead as _, BufReader};
use std::net::SocketAddr;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use crate::work::{Result, Work};

/// How long a server may take until it listens: Python has much to load on a busy machine.
const START: Duration = Duration::from_secs(30);

/// A server, ended when it is dropped.
pub(crate) struct Server {
    pub(crate) name: &'static str,
    pub(crate) addr: SocketAddr,
    /// Of which version.
    pub(crate) about: String,
    child: Child,
}

const ECHO: &str = "echo";

/// As of the command `ads-cnc`.
pub(crate) const SERVE: &str = "serve";

impl Server {
    /// This program once more.
    pub(crate) fn echo(work: &Work) -> Result<Self> {
        let hex: String = work.reply(0)?.iter().map(|byte| format!("{byte:02x}")).collect();
        let mut command = Command::new(std::env::current_exe()?);
        command.args(["echo", &work.request_len().to_string(), &hex]);
        Self::start(ECHO, command)
    }

    /// The simulated CNC, by the same program again: no older build of the command can be taken.
    pub(crate) fn cnc() -> Result<Self> {
        let mut command = Command::new(std::env::current_exe()?);
        command.args([SERVE, "--listen", "127.0.0.1:0", "--log", "warn"]);
        let mut server = Self::start("ads-cnc serve", command)?;
        server.about.clear();
        Ok(server)
    }

    /// The test server of pyads, with what is to be read as its only variable.
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
        // What closes when this process ends, whatever ends it.
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(|error| format!("{name}: {error}"))?;
        let stdout = child.stdout.take();
        let addr = SocketAddr::from(([0, 0, 0, 0], 0));
        let mut server = Self { name, addr, about: String::new(), child };
        let (tell, told) = mpsc::channel();
        thread::spawn(move || {
            let mut line = String::new();
            let read = stdout.map(|stdout| BufReader::new(stdout).read_line(&mut line));
            let _gone = tell.send(read.map(|_| line));
        });
        let line = told.recv_timeout(START).ok().flatten().unwrap_or_default();
        let rest = line.trim_end().strip_prefix("listening on ");
        let rest = rest.ok_or_else(|| format!("{name}: it does not say where it listens"))?;
        let (addr, about) = rest.split_once(", ").unwrap_or((rest, ""));
        (server.addr, server.about) = (addr.parse()?, about.to_owned());
        Ok(server)
    }

    /// Whether it repeats the same reply.
    pub(crate) fn is_echo(&self) -> bool {
        self.name == ECHO
    }

    /// Time of a processor that it has had so far, in seconds, where the system says.
    pub(crate) fn cpu(&self) -> Option<f64> {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.child.id())).ok()?;
        // Behind the name in brackets, from field 3 on; 14 and 15 are user and system time in
        // hundredths of a second.
        let mut fields = stat.rsplit_once(") ")?.1.split(' ').skip(11);
        let mut next = || fields.next()?.parse::<u32>().ok().map(f64::from);
        Some((next()? + next()?) / 100.0)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // Ended already is ended too.
        let _ended = self.child.kill().and_then(|()| self.child.wait());
    }
}
