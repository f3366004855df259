//! `ads-cnc check`: judges captured traffic.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use clap::Args;

use super::display::DisplayArgs;
use super::message::{exit_with_error, print_error};
use super::numbers::whole;
use super::progress::Watch;
use super::report_output::Reports;
use crate::capture::{
    self, AMS_TCP_PORT, CaptureOptions, Checked, Collector, Ports, VECTOR_BYTES_MAX, VECTORS_MAX,
};
use crate::edition::Edition;
use crate::exit::Exit;
use crate::judge::{Case, CaseSubject, Selection};
use crate::number::to_usize;
use crate::process::progress;
use crate::report::{self, Detail, Report, RunInfo, SubjectReport, TargetReport};
use crate::text::{Moment, plural};

/// The heading of these options in the help.
const TRAFFIC: &str = "Traffic";

/// Judge captured traffic by the same requirements
///
/// The file is pcap or pcapng, as Wireshark, tcpdump and `ads-cnc run --capture` write them, or
/// NetMon 2.x, as the ADS Monitor of Beckhoff writes it. The check reassembles both directions of
/// TCP connections, also reads AMS frames in EtherCAT frames, pairs requests with their replies,
/// and compares exchanges with each other. It only counts frames to AMS ports other than 551 (GEO),
/// 552 (SDA) and 553 (COM), and calls of undocumented addresses.
#[derive(Args, Debug)]
#[command(after_help = EXIT_CODES, after_long_help = AFTER)]
pub(super) struct CheckArgs {
    /// The time at which the command began.
    #[arg(skip = Moment::now())]
    begun: Moment,

    /// The capture to read
    file: PathBuf,

    /// Read the connections of this TCP port, on either side; repeatable [default: 48898]
    #[arg(long, help_heading = TRAFFIC, value_name = "N", conflicts_with = "any_port",
        allow_negative_numbers = true, value_parser = whole(1..=u16::MAX))]
    port: Vec<u16>,

    /// Read every TCP connection, and judge those that contain an AMS frame
    #[arg(long, help_heading = TRAFFIC)]
    any_port: bool,

    /// Also judge the requests in a capture of `ads-cnc run`, many of which are malformed on purpose
    /// [default: judge only the CNC in such a capture]
    #[arg(long, help_heading = TRAFFIC)]
    own_requests: bool,

    /// Write the captured streams as golden vectors, to a new file or into a folder
    #[arg(long, help_heading = TRAFFIC, value_name = "DIR|FILE", value_parser = vectors_file)]
    extract_vectors: Option<PathBuf>,

    /// Keep captured texts and NC programs in the vectors [default: texts masked, programs omitted]
    #[arg(long, help_heading = TRAFFIC, requires = "extract_vectors")]
    keep_texts: bool,

    /// Judge only this: an area (VAR), a requirement (VAR-11), a section of a manual with all
    /// sections below it (ads:4.3) or the ID of a case; * matches any characters, ? one;
    /// repeatable [default: all]
    #[arg(long, value_name = "AREA|SECTION|ID")]
    only: Vec<String>,

    /// Judge by this edition only, en-1.05 or de-1.051 [default: both]
    #[arg(long, value_name = "EDITION", value_parser = Edition::by_name)]
    edition: Option<Edition>,

    #[command(flatten)]
    reports: Reports,

    #[command(flatten)]
    display: DisplayArgs,
}

const EXIT_CODES: &str = "\
Exit codes: 0 passed, 1 failed, 2 wrong usage or no capture, 3 nothing judged or inconclusive, 5 a \
waiver is no longer valid, 70 internal error";

const AFTER: &str = "\
Examples:
  ads-cnc check traffic.pcapng
  ads-cnc check traffic.pcap --port 48898 --port 8016 --html report.html
  ads-cnc check traffic.pcapng --extract-vectors vectors.json

Supported captures:
  Ethernet with and without VLAN tags, raw IP, Linux cooked (SLL, SLL2) and loopback (NULL, LOOP);
  IPv4 and IPv6. AMS frames in EtherCAT frames (EtherType 0x88A4, type 2) are one conversation per
  AMS NetId of clients, whatever --port selects. Fragments of IP packets are counted, not
  reassembled. Bytes that were not captured, or were cut off by a snap length, are a gap: checks
  that need them are inconclusive. A connection that began before the capture is judged from its
  first frame in the capture. A truncated file is judged up to its end, with a note in the report.

Limits:
  A record of 8 MiB; 1024 connections at the same time; 1 MiB of one direction that waits for
  missing bytes before it, and 32 MiB in all connections; frames of 4 MiB; 4096 unanswered requests
  of a connection, of which 512 with the same invoke ID are searched for the request of a reply;
  24 MiB of names, objects and elements; NC programs of 32 channels; 10000 vectors with 4 MiB.

Removed from vectors:
  AMS NetIds, TCP and IP addresses, the client's AMS port, invoke IDs. Unless --keep-texts is given,
  letters of names, units and texts of the type STRING also become x, and NC programs are omitted.
  Numbers are kept, and so are values whose type is not in the capture. Review the vectors before
  you pass them on. Existing files are not overwritten.

Exit codes, the first that applies:
  70 internal error, 2 wrong usage or no capture, 1 a fail, 5 a stale waiver, 3 nothing judged or
  a case is inconclusive, 0 passed. Warnings and differences do not change the exit code.";

/// Maximum number of exchanges that are shown without -v.
const LISTED_MAX: usize = 10;

const KIB: u64 = 1024;

const NO_VECTORS: &str = "the vectors could not be written";

/// A file that counts the KiB read from it as steps of the progress.
#[derive(Debug)]
struct CountedRead {
    file: File,
    /// Number of bytes read since the last counted KiB.
    odd: u64,
}

impl Read for CountedRead {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        let len = self.file.read(buf)?;
        self.odd = self.odd.saturating_add(u64::try_from(len).unwrap_or(u64::MAX));
        progress::steps(to_usize(self.odd / KIB));
        self.odd %= KIB;
        Ok(len)
    }
}

impl CheckArgs {
    /// Reads and judges the file and writes the reports.
    pub(super) fn execute(&self) -> Exit {
        let waivers = match self.reports.waivers() {
            Ok(waivers) => waivers,
            Err(why) => return exit_with_error(Exit::Usage, why),
        };
        // A new file in a folder is named after its stream, which is known only at the end.
        if let Some(file) = &self.extract_vectors
            && file.symlink_metadata().is_ok()
            && !file.is_dir()
        {
            let why = io::Error::from(io::ErrorKind::AlreadyExists);
            let why = format!("{NO_VECTORS}: {}: {why}", file.display());
            return exit_with_error(Exit::Usage, why);
        }
        let mut notes = Vec::new();
        let mut checked = match self.read(&mut notes) {
            Ok(checked) => checked,
            Err(why) => {
                let why = format!("{}: {why}", self.file.display());
                return exit_with_error(Exit::Usage, why);
            }
        };
        if checked.tally.is_of_suite() && !self.own_requests {
            notes.push(
                "the requests are the suite's own; judged: the CNC only (see --own-requests)"
                    .to_owned(),
            );
            checked.outcomes.retain(|outcome| outcome.case.subject != CaseSubject::CapturedClient);
        }
        notes.iter().for_each(print_error);
        // The traffic was judged by all cases; the report omits the cases that --only and --edition
        // do not select.
        let selection = Selection { edition: self.edition, only: self.only.clone() };
        let cases: Vec<Case> =
            checked.outcomes.iter().map(|outcome| outcome.case.clone()).collect();
        let plan = match selection.plan(cases, 0) {
            Ok(plan) => plan,
            Err(why) => return exit_with_error(Exit::Usage, why),
        };
        let selected: Vec<String> = plan.selected().map(|case| case.id.clone()).collect();
        let mut outcomes = checked.outcomes.clone();
        outcomes.retain(|outcome| selected.contains(&outcome.case.id));
        let (outcomes, left_out) = plan.finish(outcomes);
        let about = RunInfo {
            time: self.begun,
            edition: self.edition,
            seed: 0,
            only: self.only.clone(),
            target: TargetReport {
                name: "captured traffic".to_owned(),
                file: Some(self.file.display().to_string()),
                ..TargetReport::default()
            },
            traffic: checked.tally.lines().into_iter().chain(notes).collect(),
            exchanges: checked.tally.listed.clone(),
            profile: None,
            found: None,
            waivers,
            frames: to_usize(checked.tally.frames),
            again: None,
            times: Vec::new(),
            left_changed: Vec::new(),
            ended: None,
        };
        let report = Report::new(about, &outcomes, &left_out);
        let extracted = self.extract(&checked);
        let exit = self.write(&report, &checked, extracted.as_deref().unwrap_or_default());
        match extracted {
            Err(error) if exit != Exit::Internal => {
                exit_with_error(Exit::Usage, format!("{NO_VECTORS}: {error}"))
            }
            _ => exit,
        }
    }

    /// Reads the connections at the selected ports. If no port is selected, reads the connections
    /// at the default port, or all connections if those contain no AMS frame.
    fn read(&self, notes: &mut Vec<String>) -> Result<Checked, String> {
        let explained =
            |error: capture::FileError| compressed(&self.file).unwrap_or_else(|| error.to_string());
        let checked = self.read_ports(self.any_port).map_err(explained)?;
        if checked.tally.frames > 0 || self.any_port || !self.port.is_empty() {
            return Ok(checked);
        }
        let all = self.read_ports(true).map_err(explained)?;
        if all.tally.frames == 0 {
            return Ok(checked);
        }
        notes.push(format!(
            "no AMS frame at TCP port {AMS_TCP_PORT}: judging the connections at other ports, as \
             with --any-port"
        ));
        Ok(all)
    }

    fn read_ports(&self, any: bool) -> Result<Checked, capture::FileError> {
        let ports = match (any, self.port.is_empty()) {
            (true, _) => Ports::Any,
            (false, true) => Ports::Of(vec![AMS_TCP_PORT]),
            (false, false) => Ports::Of(self.port.clone()),
        };
        let vectors = self.extract_vectors.as_ref().map(|_| Collector::new(self.keep_texts));
        let file = File::open(&self.file)?;
        let all = file.metadata().map_or(0, |about| about.len() / KIB);
        progress::begin(to_usize(all));
        let _watch = Watch::start("KiB");
        capture::check(CountedRead { file, odd: 0 }, CaptureOptions { ports, vectors })
    }

    /// Writes the vectors, and returns lines with their number and files, and with the number of
    /// omitted ones. Without --extract-vectors, writes nothing and returns no line.
    fn extract(&self, checked: &Checked) -> io::Result<Vec<String>> {
        let (Some(place), Some(vectors)) = (&self.extract_vectors, &checked.vectors) else {
            return Ok(Vec::new());
        };
        let files = vectors.write(Path::new(place))?;
        let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
        let mut lines = vec![format!("{}: {}", plural(vectors.len(), "vector"), files.join(", "))];
        if vectors.omitted() > 0 {
            lines.push(format!(
                "{} not written, repetitions included: the maximum is {VECTORS_MAX} vectors with \
                 {} MiB in total",
                plural(vectors.omitted(), "stream or frame"),
                VECTOR_BYTES_MAX >> 20
            ));
        }
        Ok(lines)
    }

    fn write(&self, report: &Report, checked: &Checked, extracted: &[String]) -> Exit {
        let display = self.display.display();
        self.reports.write(report, |out| {
            if display.detail == Detail::Quiet {
                // Without this note, a pass could be taken to include the parts that were not
                // captured or not judged.
                let missing = checked.tally.missing().into_iter().chain(unjudged(report));
                missing.into_iter().try_for_each(|line| writeln!(out, "note: {line}"))?;
                return report::print(report, display, out);
            }
            writeln!(out, "Traffic")?;
            let lines = checked.tally.lines();
            lines.iter().chain(extracted).try_for_each(|line| writeln!(out, "  {line}"))?;
            writeln!(out)?;
            let listed = &checked.tally.listed;
            let most = if display.detail == Detail::Verbose { usize::MAX } else { LISTED_MAX };
            listed.iter().take(most).try_for_each(|line| writeln!(out, "  {line}"))?;
            let more = checked
                .tally
                .exchanges
                .saturating_sub(u64::try_from(listed.len().min(most)).unwrap_or(u64::MAX));
            if more > 0 {
                writeln!(
                    out,
                    "  and {} (-v shows the first 10000)",
                    plural(more, "more exchange")
                )?;
            }
            writeln!(out)?;
            unjudged(report).try_for_each(|line| writeln!(out, "note: {line}\n"))?;
            report::print(report, display, out)
        })
    }
}

/// The message for a file that gzip, zstd or xz has compressed, with the command that unpacks it;
/// `None` for any other file.
pub(super) fn compressed(file: &Path) -> Option<String> {
    let mut start = [0; 4];
    File::open(file).and_then(|mut file| file.read_exact(&mut start)).ok()?;
    let name = file.display();
    let unpack = match start {
        [0x1F, 0x8B, 8, _] => format!("gzip -dk {name}, or editcap {name} out.pcapng"),
        [0x28, 0xB5, 0x2F, 0xFD] => format!("zstd -dk {name}"),
        [0xFD, b'7', b'z', b'X'] => format!("xz -dk {name}"),
        _ => return None,
    };
    Some(format!("the file is compressed; unpack it first: {unpack}"))
}

/// Parses the destination of the vectors, which cannot be stdout because the report is written
/// there.
fn vectors_file(text: &str) -> Result<PathBuf, String> {
    match text {
        "-" => Err("expected a file or a folder: stdout is used for the report".to_owned()),
        path => Ok(path.into()),
    }
}

/// A note for each side (client, CNC) of which nothing was judged.
fn unjudged(report: &Report) -> impl Iterator<Item = String> + '_ {
    let is_judged = |one: &&SubjectReport| one.totals.keys().any(|verdict| verdict.is_judged());
    let unjudged = report.subjects.iter().filter(move |one| !is_judged(one));
    unjudged.map(|one| format!("nothing of the {} was judged", one.subject))
}
