//! `ads-cnc run`: the suite against a target.

use std::fs::File;
use std::io::{self, BufWriter, Write as _};
use std::path::{Path, PathBuf};

use ads_cnc::operation::{CountObjects, ObjectList};
use clap::Args;

use super::target::{REACHING_A_DEVICE, TargetArgs};
use super::{complain, find_defect};
use crate::cnc::Cnc;
use crate::defect::Defect;
use crate::gate::{Gate, Moment};
use crate::profile::Profile;
use crate::report::{self, About, Report, TargetReport};
use crate::session::{self, Trouble};
use crate::suite::{self, Needs, Session};
use crate::verdict::Exit;
use crate::waivers::Waivers;

/// Runs the conformance suite against the embedded CNC, or against a device.
///
/// Without --target a simulated CNC is started on this machine and judged together with the codec.
/// A device is only read: nothing is sent to it but documented queries, to the ports they are
/// documented for. Some ask for what is not there, by one beyond the last, to see it refused.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{REACHING_A_DEVICE}"))]
pub(super) struct Run {
    #[command(flatten)]
    target: TargetArgs,

    /// Write the report as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,

    /// Show the cases of the codec one by one
    #[arg(long, short)]
    verbose: bool,

    /// Switch on a defect of the embedded CNC and of the codec's cases (see serve --list-defects)
    #[arg(long, value_name = "ID", conflicts_with = "target")]
    defect: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  ads-cnc run
  ads-cnc run --target 192.0.2.10 --net-id 192.0.2.10.1.1 --source-net-id 192.0.2.20.1.1 \
      --json report.json
  ads-cnc run --defect variable-description.size.flip

Exit codes: 0 passed, with warnings and differences or without; 1 a requirement is not met;
2 wrong usage; 3 nothing could be judged, or something stayed inconclusive; 4 refused for safety;
70 internal error.";

impl Run {
    /// Runs the suite and writes its reports.
    pub(super) fn execute(&self) -> Exit {
        let defect = match find_defect(self.defect.as_deref()) {
            Ok(defect) => defect,
            Err(why) => {
                complain(why);
                return Exit::Usage;
            }
        };
        let report = match self.target.is_device() || self.target.is_dry() {
            false => embedded(defect),
            true => self.device(),
        };
        match report {
            Ok(report) => self.write(&report),
            Err(trouble) => {
                complain(&trouble);
                trouble.exit()
            }
        }
    }

    fn device(&self) -> Result<Report, Trouble> {
        let mut session = self.target.open()?;
        // Silence is judged case by case only of one that speaks at all: an error of ADS does.
        match session.call(&CountObjects::new(ObjectList::PLATFORM)) {
            Ok(_) | Err(Trouble::Ads { .. } | Trouble::Reply(_)) => {}
            Err(trouble) => return Err(trouble),
        }
        let target = *session.target();
        let (client, _) = session.into_parts();
        let mut session = Session::new(client, Profile::DEVICE);
        let cases = suite::cases().into_iter().filter(|case| case.needs != Needs::Codec).collect();
        let outcomes = suite::run(cases, Some(&mut session), None, 0);
        let name = "device".to_owned();
        let (address, net_id) = (target.addr.to_string(), target.net_id.to_string());
        let target = TargetReport {
            name,
            address: Some(address),
            net_id: Some(net_id),
            ..TargetReport::default()
        };
        Ok(Report::new(about(target, &session), &outcomes, &[]))
    }

    fn write(&self, report: &Report) -> Exit {
        // The file first: whoever reads the console may stop reading.
        let written = self.json.as_ref().map_or(Ok(()), |file| write_json(report, file));
        let mut out = BufWriter::new(io::stdout().lock());
        let shown = report::print(report, self.verbose, &mut out).and_then(|()| out.flush());
        // A reader that has seen enough is no failure of ours, nor a success of the target's.
        let shown = shown.or_else(|error| match error.kind() {
            io::ErrorKind::BrokenPipe => Ok(()),
            _ => Err(error),
        });
        match written.and(shown) {
            Ok(()) => report.exit(),
            Err(error) => {
                complain(format_args!("the report could not be written: {error}"));
                Exit::Internal
            }
        }
    }
}

fn write_json(report: &Report, file: &Path) -> io::Result<()> {
    let mut out = BufWriter::new(File::create(file)?);
    serde_json::to_writer_pretty(&mut out, report)?;
    writeln!(out)?;
    out.flush()
}

/// Starts the embedded CNC, runs everything against it and stops it.
fn embedded(defect: Option<Defect>) -> Result<Report, Trouble> {
    let internal = |error| Trouble::Internal(format!("the default model: {error}"));
    let cnc = Cnc::with_default_model().map_err(internal)?.with_defect(defect.clone());
    let session = session::Session::embedded(cnc, Gate::with_malformed())?;
    let target = *session.target();
    // The CNC runs as long as it is held.
    let (client, _running) = session.into_parts();
    let mut session = Session::new(client, Profile::EMBEDDED);
    let outcomes = suite::run(suite::cases(), Some(&mut session), defect.as_ref(), 0);
    let name = match &defect {
        None => "embedded CNC".to_owned(),
        Some(defect) => format!("embedded CNC with the defect {}", defect.id),
    };
    let target = TargetReport {
        name,
        address: Some(target.addr.to_string()),
        net_id: Some(target.net_id.to_string()),
        ..TargetReport::default()
    };
    Ok(Report::new(about(target, &session), &outcomes, &[]))
}

fn about(target: TargetReport, session: &Session) -> About {
    About {
        time: Moment::now(),
        edition: "en-1.05".to_owned(),
        seed: 0,
        only: Vec::new(),
        target,
        profile: Some(session.profile.clone()),
        waivers: Waivers::default(),
        frames: session.frames,
    }
}
