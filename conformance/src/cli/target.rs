//! Options of the commands that connect to a device or start a simulated CNC for themselves.

use std::fmt;
use std::io;
use std::net::{IpAddr, SocketAddr, ToSocketAddrs as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Once};
use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::ads::AmsNetId;
use clap::Args;

use super::message::print_error;
use super::not_sent;
use super::numbers::time;
use crate::capture::{AMS_TCP_PORT, Capture};
use crate::client::Target;
use crate::deadline::Deadline;
use crate::exit::Exit;
use crate::gate::{Allowed, Entry, Gate, Moment};
use crate::session::{Session, TIMEOUT, ToolError};
use crate::simulator::{Cnc, NET_ID};
use crate::text::shown_time;

/// The heading of these options in the help.
const TARGET: &str = "Target";

/// A part of the long help of the commands that connect to a device.
pub(super) const REACHING_A_DEVICE: &str = "\
Reaching a device:
  The device listens for AMS/TCP on TCP port 48898 and answers only clients with a route. In its ADS
  router, add a route with the AMS NetId of the client (--source-net-id), the IP address of this
  machine and TCP/IP. Without a route, the device closes the connection at once or does not reply.
  --net-id is the device's own AMS NetId, as its router shows it. Requests go to the AMS ports 551
  (GEO), 552 (SDA) and 553 (COM); nothing is written without --allow-write.";

/// A part of the long help of the commands that may write.
pub(super) const WHAT_MAY_BE_WRITTEN: &str = "\
Allowed writes, a file for --allow-write:
  target = \"192.0.2.7.1.1\"             # AMS NetId of the device; 127.0.0.1.1.1 on loopback only
  address = \"192.0.2.7\"                # IP address of the device [default: any]
  expires = 2026-05-04T17:30:00+02:00  # no writes from then on
  [[variable]]                         # or [[object]], [[element]], [[stream]], [[service]]
  channel = 1
  name = \"V.E.name\"
  The error for a rejected write shows the entry that it needs. A write by a handle or by the name
  of an object is also rejected if the device uses the same handle or address for a name that is
  not in the file.";

/// The target. Without --target, the command starts a simulated CNC.
#[derive(Args, Clone, Debug)]
pub(super) struct TargetArgs {
    /// Host name or IP address of the device; the port defaults to 48898 [default: a simulated CNC]
    #[arg(long, help_heading = TARGET, value_name = "HOST[:PORT]", requires = "net_id")]
    target: Option<String>,

    /// AMS NetId of the device
    #[arg(long, help_heading = TARGET, value_name = "ID", requires = "target", value_parser = net_id)]
    net_id: Option<AmsNetId>,

    /// AMS NetId of this client; the device needs a route to it [default: this machine's IPv4
    /// address and .1.1; on loopback 127.0.0.1.1.2]
    #[arg(long, hide_short_help = true, help_heading = TARGET, value_name = "ID", requires = "target", value_parser = net_id)]
    source_net_id: Option<AmsNetId>,

    /// Timeout for a connection to a device, for each of its replies and for each answer of a testee,
    /// in milliseconds [default: 2000]
    #[arg(long, hide_short_help = true, help_heading = TARGET, value_name = "MS",
        allow_negative_numbers = true, value_parser = time())]
    timeout: Option<u64>,

    /// Maximum number of requests per second [default: no limit; each waits for the previous reply]
    #[arg(long, hide_short_help = true, help_heading = TARGET, value_name = "PER_SECOND",
        allow_negative_numbers = true, value_parser = pace)]
    rate: Option<Duration>,

    /// File that names the allowed writes, the device and the time at which the permission ends
    /// [default: no writes to a device]
    #[arg(long, help_heading = TARGET, value_name = "FILE")]
    allow_write: Option<PathBuf>,

    /// Write all sent and received frames to a pcapng file for Wireshark and `check`
    #[arg(long, hide_short_help = true, help_heading = TARGET, value_name = "FILE", conflicts_with = "dry_run")]
    capture: Option<PathBuf>,

    /// Show the requests without sending them
    #[arg(long, help_heading = TARGET)]
    dry_run: bool,

    /// Whether malformed requests are allowed; set by the option `--malformed` of `run`.
    #[arg(skip)]
    malformed: bool,

    /// Whether the suite sends the requests; if so, a capture contains a comment that says so.
    #[arg(skip)]
    is_of_suite: bool,

    /// Whether the capture could not be written completely.
    #[arg(skip)]
    lost: Arc<AtomicBool>,
}

/// The deadline of commands that may send many requests.
#[derive(Args, Clone, Copy, Debug)]
pub(super) struct DeadlineArgs {
    /// Deadline for all requests, in seconds; what was not requested by then is reported as
    /// inconclusive (`run`) or missing
    #[arg(long, hide_short_help = true, help_heading = TARGET, value_name = "SECONDS", default_value_t = DEADLINE,
        allow_negative_numbers = true, value_parser = time())]
    deadline: u64,
}

/// The default deadline in seconds, in which 28,800 requests can be sent at two per second.
const DEADLINE: u64 = 4 * 3600;

impl DeadlineArgs {
    pub(super) const fn is_default(self) -> bool {
        self.deadline == DEADLINE
    }

    /// The deadline, counted from now.
    pub(super) fn begin(self) -> Deadline {
        Deadline::after(Duration::from_secs(self.deadline))
    }
}

impl fmt::Display for DeadlineArgs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "time limit: {} (--deadline)", shown_time(self.deadline))
    }
}

/// The option --channel.
#[derive(Args, Clone, Copy, Debug)]
pub(super) struct ChannelArgs {
    /// Number of the channel
    #[arg(long, help_heading = TARGET, value_name = "N", default_value = "1", value_parser = channel)]
    pub(super) channel: Channel,
}

impl TargetArgs {
    /// Whether --target is given.
    pub(super) const fn is_device(&self) -> bool {
        self.target.is_some()
    }

    /// The timeout for a connection and for a reply; in a run, also for an answer of a testee.
    pub(super) fn timeout(&self) -> Duration {
        self.timeout.map_or(TIMEOUT, Duration::from_millis)
    }

    /// Whether --allow-write is given.
    pub(super) const fn has_file(&self) -> bool {
        self.allow_write.is_some()
    }

    /// Whether --dry-run is given.
    pub(super) const fn is_dry(&self) -> bool {
        self.dry_run
    }

    /// Sets the timeout, unless --timeout is given.
    pub(super) fn with_timeout(mut self, timeout: Option<Duration>) -> Self {
        let milliseconds = timeout.and_then(|time| u64::try_from(time.as_millis()).ok());
        self.timeout = self.timeout.or(milliseconds);
        self
    }

    /// Marks the requests as those of the suite, for the comment in a capture.
    pub(super) fn of_suite(self) -> Self {
        Self { is_of_suite: true, ..self }
    }

    /// Sets whether malformed requests are allowed.
    pub(super) fn with_malformed(self, malformed: bool) -> Self {
        Self { malformed, ..self }
    }

    /// Like [`open_or`](Self::open_or), with the default model of the simulated CNC.
    pub(super) fn open(&self) -> Result<Session, ToolError> {
        self.open_or(default_cnc)
    }

    /// Like [`open_or`](Self::open_or), except that without --target and --allow-write, the gate
    /// allows the writes of this entry to the simulated CNC.
    pub(super) fn open_to_write(
        &self,
        entry: Entry,
        cnc: impl FnOnce() -> Result<Cnc, ToolError>,
    ) -> Result<Session, ToolError> {
        match (self.is_device() || self.has_file(), self.dry_run) {
            (true, _) => self.open_or(cnc),
            (false, true) => Session::dry_simulated(simulator_gate(entry), not_sent::print),
            (false, false) => {
                tell_simulated();
                self.recorded(Session::simulated(cnc()?, simulator_gate(entry))?)
            }
        }
    }

    /// Checks a write to a device with the gate before connecting. A dry run skips this check,
    /// because it shows the rejected write later.
    pub(super) fn ask_gate(
        &self,
        check: impl FnOnce(&Session) -> Result<(), ToolError>,
    ) -> Result<(), ToolError> {
        match self.device()? {
            Some(target) if !self.dry_run => {
                check(&Session::dry(target, self.gate()?, not_sent::print)?)
            }
            _ => Ok(()),
        }
    }

    /// The content of the file for --allow-write; `None` without the option. Does not need a
    /// target.
    ///
    /// # Errors
    /// Wrong usage, if the file cannot be read or is invalid.
    pub(super) fn allowed(&self) -> Result<Option<Allowed>, ToolError> {
        let allowed = self.allow_write.as_deref().map(Allowed::from_file).transpose();
        allowed.map_err(|error| ToolError::Usage(error.to_string()))
    }

    /// The gate that checks each request before it is sent to the target.
    ///
    /// # Errors
    /// If the file for --allow-write is invalid, the host of --target has no address, or
    /// --malformed is given and the file does not permit malformed requests to this target now.
    pub(super) fn gate(&self) -> Result<Gate, ToolError> {
        let gate = Gate::queries().with_allowed(self.allowed()?);
        match (self.device()?, self.malformed) {
            (Some(target), true) => {
                let gate = gate.and_malformed().to_address(target.addr.ip());
                let checked = gate.check_malformed(target.net_id, Moment::now());
                checked.map_err(|rejection| ToolError::NotPermitted(Box::new(rejection)))?;
                Ok(gate)
            }
            _ => Ok(gate),
        }
    }

    /// Connects to the device, or starts the simulated CNC that `cnc` creates and connects to it.
    /// In a dry run, does not connect; the session prints its requests.
    pub(super) fn open_or(
        &self,
        cnc: impl FnOnce() -> Result<Cnc, ToolError>,
    ) -> Result<Session, ToolError> {
        let gate = self.gate()?;
        match (self.device()?, self.dry_run) {
            (None, false) => {
                tell_simulated();
                self.recorded(Session::simulated(cnc()?, gate)?)
            }
            (None, true) => Session::dry_simulated(gate, not_sent::print),
            (Some(target), false) => self.recorded(Session::connect(target, gate)?),
            (Some(target), true) => Session::dry(target, gate, not_sent::print),
        }
    }

    /// The options --target, --net-id and --source-net-id as given, for a command line in a hint;
    /// empty without --target.
    pub(super) fn as_options(&self) -> String {
        let mut options = String::new();
        let ids = [("--net-id", self.net_id), ("--source-net-id", self.source_net_id)];
        options.extend(self.target.iter().map(|target| format!(" --target {target}")));
        for (name, id) in ids {
            options.extend(id.iter().map(|id| format!(" {name} {id}")));
        }
        options
    }

    /// The file of --capture.
    pub(super) fn capture(&self) -> Option<&Path> {
        self.capture.as_deref()
    }

    /// Adds a capture to the session, if --capture is given.
    pub(super) fn recorded(&self, session: Session) -> Result<Session, ToolError> {
        let capture = self.begin_capture()?;
        Ok(match capture {
            Some(capture) => session.with_capture(capture),
            None => session,
        })
    }

    /// Creates the file of --capture; `None` without the option.
    pub(super) fn begin_capture(&self) -> Result<Option<Capture>, ToolError> {
        let Some(file) = &self.capture else { return Ok(None) };
        let failed = |error: io::Error| {
            let why = format!("{}: {error}", file.display());
            match error.kind() {
                io::ErrorKind::NotFound
                | io::ErrorKind::NotADirectory
                | io::ErrorKind::IsADirectory
                | io::ErrorKind::PermissionDenied => ToolError::Usage(why),
                _ => ToolError::Internal(why),
            }
        };
        let (lost, name) = (Arc::clone(&self.lost), file.display().to_string());
        let create = if self.is_of_suite { Capture::of_suite } else { Capture::create };
        let capture = create(file).map_err(failed)?.or_tell(move |error| {
            print_error(format_args!("{name}: the capture is incomplete: {error}"));
            lost.store(true, Ordering::Relaxed);
        });
        Ok(Some(capture))
    }

    /// Prints the error of the command, if any, with advice, and returns the exit code of the
    /// process. If the command succeeded but the capture is incomplete, the exit code is that of an
    /// internal error.
    pub(super) fn end(
        &self,
        done: Result<Exit, ToolError>,
        advice: impl FnOnce(&ToolError) -> Option<String>,
    ) -> Exit {
        let exit = done.unwrap_or_else(|error| {
            print_error(&error);
            if let Some(advice) = advice(&error) {
                print_error(advice);
            }
            error.exit()
        });
        match exit {
            Exit::Success if self.lost.load(Ordering::Relaxed) => Exit::Internal,
            exit => exit,
        }
    }

    fn device(&self) -> Result<Option<Target>, ToolError> {
        let Some(host) = &self.target else { return Ok(None) };
        let usage = |why: String| ToolError::Usage(why);
        let net_id = self.net_id.ok_or_else(|| usage("--target needs --net-id".to_owned()))?;
        Ok(Some(Target {
            addr: resolve(host).map_err(|error| match error.kind() {
                io::ErrorKind::InvalidInput => usage(format!("{host}: {error}")),
                _ => ToolError::NoReply(format!("{host}: {error}")),
            })?,
            net_id,
            source: self.source_net_id,
            timeout: self.timeout.map_or(TIMEOUT, Duration::from_millis),
            pace: self.rate.unwrap_or_default(),
        }))
    }
}

/// Prints, at most once in this process, that the command uses a simulated CNC.
fn tell_simulated() {
    static TOLD: Once = Once::new();
    TOLD.call_once(|| print_error("using a simulated CNC, because --target is not given"));
}

/// A simulated CNC with the default model.
pub(super) fn default_cnc() -> Result<Cnc, ToolError> {
    let internal = |error| ToolError::Internal(format!("the default model: {error}"));
    Cnc::with_default_model().map_err(internal)
}

/// A gate that allows queries and the writes of this entry to a simulated CNC.
pub(super) fn simulator_gate(entry: Entry) -> Gate {
    let expires = Moment::from_rfc3339("9999-12-31T23:59:59Z").unwrap_or(Moment::EPOCH);
    Gate::queries().with_allowed(Some(Allowed {
        target: NET_ID,
        address: None,
        malformed: false,
        expires,
        entries: vec![entry],
    }))
}

pub(super) fn channel(text: &str) -> Result<Channel, String> {
    let invalid = || "expected the number of a channel, from 1 to 255".to_owned();
    Channel::new(text.parse().map_err(|_| invalid())?).map_err(|_| invalid())
}

pub(super) fn net_id(text: &str) -> Result<AmsNetId, String> {
    text.parse().map_err(|_| {
        let hint = match text.parse::<IpAddr>() {
            Ok(IpAddr::V4(_)) => format!("; did you mean {text}.1.1?"),
            _ => String::new(),
        };
        format!("expected six numbers from 0 to 255 with dots, such as 192.0.2.10.1.1{hint}")
    })
}

/// Parses a number of requests per second; returns the time between two requests.
fn pace(text: &str) -> Result<Duration, String> {
    let invalid = || "expected a number greater than 0".to_owned();
    let rate: f64 = text.parse().map_err(|_| invalid())?;
    // For the rate `inf`, the time is 0. For the rate 0, the time would be infinite, which is an
    // error.
    Duration::try_from_secs_f64(rate.recip()).map_err(|_| invalid())
}

/// The address of a host; the port is 48898 if none is given.
fn resolve(host: &str) -> io::Result<SocketAddr> {
    if let Ok(ip) = host.parse::<IpAddr>() {
        return Ok(SocketAddr::new(ip, AMS_TCP_PORT));
    }
    let found = match host.parse::<SocketAddr>() {
        Ok(addr) => return Ok(addr),
        Err(_) if host.contains(':') => host.to_socket_addrs()?.next(),
        Err(_) => (host, AMS_TCP_PORT).to_socket_addrs()?.next(),
    };
    found.ok_or_else(|| io::Error::new(io::ErrorKind::NotFound, "no such host"))
}
