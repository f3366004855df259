//! The committed table: the detection of each seeded defect, in each mode.
//!
//! The first line of the table contains a hash of the inputs that all rows share. Then the table
//! has one line for each different measurement of a defect (result, requirements and cases), with
//! fields separated by tabs: defect, hash of the defect, modes with this measurement, result, the
//! request or witness, requirements that fail, cases that fail. A valid variant of the CNC is
//! `quiet` if no requirement fails.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write as _};

use serde::Serialize;

use super::detection_result::{Detection, DetectionResult, Mode};
use crate::faults::{self, DefectKind, SeededDefect};
use crate::number::digest;
use crate::selftest::reasons;
use crate::simulator::DEFAULT_MODEL;
use crate::suite;

/// The table of this version, which `selftest --renew` writes.
const PUBLISHED: &str = include_str!("../../../doc/detection.tsv");

/// The measurement of a defect or variant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DetectionRow {
    pub id: String,
    /// The hash of the defect and of the CNC's replies with the defect, as `super::hash` returns
    /// it.
    pub hash: String,
    /// The result in each mode.
    pub modes: BTreeMap<Mode, Detection>,
}

/// All rows, and a hash of their common inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DetectionTable {
    /// A hash of the inputs that all rows share, as [`inputs`] returns it.
    pub inputs: String,
    /// The rows in the order of the defects.
    pub rows: Vec<DetectionRow>,
}

/// The number of defects with each result in a mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Figures {
    /// Defects that are [`DetectionResult::Caught`].
    pub caught: usize,
    /// Defects with which only other requirements fail.
    pub elsewhere: usize,
    /// Defects with which no requirement fails, although the reply to a request shows the defect.
    pub missed: usize,
    /// Defects that are [`DetectionResult::Undetectable`].
    pub undetectable: usize,
    /// Valid variants without a failed requirement.
    pub quiet: usize,
    /// Results [`DetectionResult::Alarm`].
    pub alarms: usize,
}

/// The hash of the inputs that all rows share: the default model without comments, the IDs,
/// requirements and needs of the cases, and the levels of the requirements.
pub fn inputs() -> String {
    let is_comment = |line: &&str| line.trim_start().starts_with('#');
    let mut text: String = DEFAULT_MODEL
        .lines()
        .filter(|line| !is_comment(line))
        .flat_map(|line| [line, "\n"])
        .collect();
    let mut cases = suite::cases();
    cases.sort_by(|one, other| one.id.cmp(&other.id));
    for case in cases {
        // Writing to a string does not fail.
        let _ = write!(text, "\n{} {:?} {:?}", case.id, case.requirements, case.needs);
    }
    for one in ads_cnc_vectors::requirements() {
        let _ = write!(text, "\n{} {:?}", one.id, one.level);
    }
    hash(&text)
}

/// The hash of a text as 16 hex digits.
pub(super) fn hash(text: &str) -> String {
    format!("{:016x}", digest(text.as_bytes()))
}

impl DetectionTable {
    /// The table of this version; `None` if it cannot be parsed.
    pub fn published() -> Option<Self> {
        Self::parse(PUBLISHED)
    }

    pub fn row(&self, defect: &SeededDefect) -> Option<&DetectionRow> {
        self.rows.iter().find(|row| row.id == defect.id)
    }

    /// The number of defects with each result in a mode.
    pub fn figures(&self, mode: Mode) -> Figures {
        let mut figures = Figures::default();
        for row in &self.rows {
            let Some(detection) = row.modes.get(&mode) else { continue };
            let count = match &detection.result {
                DetectionResult::Caught => &mut figures.caught,
                DetectionResult::Elsewhere => &mut figures.elsewhere,
                DetectionResult::Missed(_) => &mut figures.missed,
                DetectionResult::Undetectable(_) => &mut figures.undetectable,
                DetectionResult::Quiet => &mut figures.quiet,
                DetectionResult::Alarm => &mut figures.alarms,
            };
            *count += 1;
        }
        figures
    }

    /// The number of [`Detection::requirements`] for one defect in the mode `ReadOnly`: median and
    /// 90th percentile over the defects with at least one such requirement. With `of_fields`, the
    /// defects of a single field are counted, otherwise all other defects of a CNC.
    pub fn blame(&self, of_fields: bool) -> (usize, usize) {
        let of_field = |row: &&DetectionRow| {
            let defect = faults::by_id(&row.id);
            defect.is_some_and(|defect| {
                defect.field().is_some() == of_fields && defect.kind != DefectKind::Different
            })
        };
        let rows = self.rows.iter().filter(of_field);
        let found = rows.filter_map(|row| row.modes.get(&Mode::ReadOnly));
        let counts = found.map(|found| found.requirements.len()).filter(|&count| count > 0);
        let mut counts: Vec<usize> = counts.collect();
        counts.sort_unstable();
        let at = |tenths: usize| {
            let place = counts.len() * tenths / 10;
            counts.get(place).copied().unwrap_or_default()
        };
        (at(5), at(9))
    }

    /// The text of the committed file `detection.tsv`.
    pub fn to_text(&self) -> String {
        let mut text = format!("inputs\t{}\n", self.inputs);
        for DetectionRow { id, hash, modes } in &self.rows {
            let mut alike: Vec<(Vec<&str>, &Detection)> = Vec::new();
            for (mode, detection) in modes {
                match alike.iter_mut().find(|(_, one)| *one == detection) {
                    Some((names, _)) => names.push(mode.name()),
                    None => alike.push((vec![mode.name()], detection)),
                }
            }
            for (names, Detection { result, requirements, cases }) in alike {
                let (result, shown) = result.words();
                let words = |words: &BTreeSet<String>| {
                    words.iter().map(String::as_str).collect::<Vec<_>>().join(" ")
                };
                let _ = writeln!(
                    text,
                    "{id}\t{hash}\t{}\t{result}\t{shown}\t{}\t{}",
                    names.join(" "),
                    words(requirements),
                    words(cases),
                );
            }
        }
        text
    }

    fn parse(text: &str) -> Option<Self> {
        let (first, rest) = text.split_once('\n')?;
        let mut table =
            Self { inputs: first.strip_prefix("inputs\t")?.to_owned(), rows: Vec::new() };
        for line in rest.lines() {
            let fields: Vec<&str> = line.split('\t').collect();
            let [id, hash, names, result, shown, requirements, cases] = fields[..] else {
                return None;
            };
            let words = |words: &str| words.split_whitespace().map(str::to_owned).collect();
            let detection = Detection {
                result: DetectionResult::of_words(result, shown)?,
                requirements: words(requirements),
                cases: words(cases),
            };
            if table.rows.last().is_none_or(|row| row.id != id) {
                let (id, hash) = (id.to_owned(), hash.to_owned());
                table.rows.push(DetectionRow { id, hash, modes: BTreeMap::new() });
            }
            let row = table.rows.last_mut()?;
            for name in names.split(' ') {
                let mode = Mode::ALL.into_iter().find(|mode| mode.name() == name)?;
                row.modes.insert(mode, detection.clone());
            }
        }
        Some(table)
    }

    /// The text of the committed document `detection.md`: the figures and the missed defects.
    pub fn to_markdown(&self) -> String {
        let mut text = "# What the suite detects from outside\n\n\
            Written by `ads-cnc selftest --renew`, like the [table](detection.tsv) of every defect \
            with the requirements\nand cases that detect it. [TOOLS](../TOOLS.md#selftest) explains \
            the modes and the columns.\n\n"
            .to_owned();
        text += "| mode | defects | caught | by another clause | missed | undetectable | false alarms |\n\
            |---|---|---|---|---|---|---|\n";
        for mode in Mode::ALL {
            let Figures { caught, elsewhere, missed, undetectable, quiet, alarms } =
                self.figures(mode);
            let variants = quiet + alarms;
            let defects = [caught, elsewhere, missed, undetectable].iter().sum::<usize>();
            let _ = writeln!(
                text,
                "| {} | {defects} | {caught} | {elsewhere} | {missed} | {undetectable} | {alarms} of {variants} |",
                mode.name()
            );
        }
        text += "\n## Missed\n\nEach entry contains the defect, the first request whose reply shows it, \
                 and the reason why the suite does not\ndetect it, if known.\n";
        for mode in Mode::ALL {
            let _ = write!(text, "\n### {}\n\n", mode.name());
            for (row, request) in self.missed(mode) {
                let what = faults::by_id(&row.id).map_or("", |defect| defect.what.as_str());
                let reason = reasons::of_missed(&row.id).map(|reason| format!(". {reason}"));
                let reason = reason.unwrap_or_default();
                let _ = writeln!(text, "- `{}`: {what}. {request}{reason}", row.id);
            }
        }
        text
    }
}

impl fmt::Display for DetectionResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.words() {
            (result, "") => f.write_str(result),
            (result, shown) => write!(f, "{result} ({shown})"),
        }
    }
}

impl DetectionResult {
    fn words(&self) -> (&'static str, &str) {
        match self {
            Self::Caught => ("caught", ""),
            Self::Elsewhere => ("elsewhere", ""),
            Self::Missed(request) => ("missed", request),
            Self::Undetectable(witness) => ("undetectable", witness),
            Self::Quiet => ("quiet", ""),
            Self::Alarm => ("false-alarm", ""),
        }
    }

    fn of_words(result: &str, shown: &str) -> Option<Self> {
        Some(match result {
            "caught" => Self::Caught,
            "elsewhere" => Self::Elsewhere,
            "missed" => Self::Missed(shown.to_owned()),
            "undetectable" => Self::Undetectable(shown.to_owned()),
            "quiet" => Self::Quiet,
            "false-alarm" => Self::Alarm,
            _ => return None,
        })
    }
}
