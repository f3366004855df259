//! Compares the committed table with new measurements.

use serde::{Serialize, Serializer};

use super::{
    Detection, DetectionResult, DetectionRow, DetectionTable, Figures, Mode, configured, hash,
    inputs, measure,
};
use crate::faults::SeededDefect;
use crate::judge::order;
use crate::selftest::parallel::{ProgressCallback, parallel};
use crate::text::plural;

/// The defects that are measured again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Every defect that changed since the table was written, and [`SAMPLE`] others, which this
    /// random seed selects.
    Sample(u32),
    /// Every defect that changed since the table was written; every defect if [`inputs`] changed.
    Changed,
    /// Every defect.
    All,
}

/// Number of unchanged defects in a sample.
pub const SAMPLE: usize = 60;

/// The detection table, and the result of the new measurements.
#[derive(Clone, Debug, Serialize)]
pub struct CheckedTable {
    /// The committed or renewed table; in JSON, only the figures and the missed defects of each
    /// mode.
    #[serde(serialize_with = "figures")]
    pub table: DetectionTable,
    /// Number of defects that were measured again without an error.
    pub measured: usize,
    /// Findings such as differences from the committed table, changed inputs, errors of
    /// measurements, and unnecessary witnesses.
    pub differences: Vec<String>,
}

impl CheckedTable {
    /// Measures those of `defects` that `scope` selects. `whole`: whether `defects` contains all
    /// defects of a CNC, so that the table can be renewed.
    pub(crate) fn new(
        defects: Vec<&'static SeededDefect>,
        scope: Scope,
        whole: bool,
        report_progress: ProgressCallback<'_>,
    ) -> Self {
        let mut differences = Vec::new();
        let published = DetectionTable::published().unwrap_or_else(|| {
            differences.push("cannot parse the table".to_owned());
            DetectionTable { inputs: String::new(), rows: Vec::new() }
        });
        if published.inputs != inputs() {
            differences.push(
                "cases, levels of requirements or the default model changed since the table was \
                 written"
                    .to_owned(),
            );
        }
        if whole {
            let gone =
                published.rows.iter().filter(|row| !defects.iter().any(|one| one.id == row.id));
            differences.extend(gone.map(|row| format!("{}: no such defect", row.id)));
        }
        let is_current = published.inputs == inputs();
        let chosen = match scope {
            Scope::Sample(seed) => {
                sample(defects.clone(), (seed, SAMPLE), &published, report_progress)
            }
            Scope::Changed if is_current => {
                sample(defects.clone(), (0, 0), &published, report_progress)
            }
            Scope::Changed | Scope::All => defects.clone(),
        };
        let differs = |(defect, row): &(&SeededDefect, Result<DetectionRow, _>)| match row {
            Ok(row) if scope == Scope::Changed => {
                row.modes.values().any(|found| found.result == DetectionResult::Alarm)
            }
            Ok(row) => !differing(published.row(defect), row).is_empty(),
            Err(_) => true,
        };
        let part = ("defects measured in each mode", chosen.as_slice());
        let measured =
            parallel(part, 1, |defect| (*defect, measure(defect)), differs, report_progress);
        let mut rows = Vec::new();
        for (defect, row) in measured {
            match row {
                Ok(row) => {
                    differences.extend(differing(published.row(defect), &row));
                    rows.push(row);
                }
                Err(error) => differences.push(format!("{}: {error}", defect.id)),
            }
        }
        let measured = rows.len();
        let is_renewed = whole && matches!(scope, Scope::Changed | Scope::All);
        if !is_renewed {
            return Self { table: published, measured, differences };
        }
        let row = |defect: &&SeededDefect| {
            let now = rows.iter().find(|row| row.id == defect.id);
            now.or_else(|| published.row(defect).filter(|_| is_current)).cloned()
        };
        let rows: Vec<DetectionRow> = defects.iter().filter_map(row).collect();
        differences.extend(configured::stale(&rows));
        Self { table: DetectionTable { inputs: inputs(), rows }, measured, differences }
    }
}

/// The defects that changed since the table was written, and `count` others, which `seed` selects.
fn sample(
    mut defects: Vec<&'static SeededDefect>,
    (seed, count): (u32, usize),
    published: &DetectionTable,
    report_progress: ProgressCallback<'_>,
) -> Vec<&'static SeededDefect> {
    let part = ("defects compared with the table", defects.as_slice());
    let hashes = parallel(part, 1, |defect| hash(defect).ok(), Option::is_none, report_progress);
    let changed = defects
        .iter()
        .zip(hashes)
        .filter(|(defect, hash)| published.row(defect).map(|row| &row.hash) != hash.as_ref());
    let mut wanted: Vec<&SeededDefect> = changed.map(|(defect, _)| *defect).collect();
    defects.retain(|one| !wanted.iter().any(|changed| changed.id == one.id));
    defects.sort_by_key(|one| order(seed, &one.id));
    wanted.extend(defects.into_iter().take(count));
    wanted
}

/// Describes the differences between the row of a defect in the table and its new measurement.
fn differing(before: Option<&DetectionRow>, now: &DetectionRow) -> Vec<String> {
    let id = &now.id;
    let Some(before) = before else { return vec![format!("{id}: not in the table")] };
    let mut differences = Vec::new();
    if before.hash != now.hash {
        differences.push(format!("{id}: the defect has changed since it was measured"));
    }
    for (mode, detection) in &now.modes {
        let shown = |detection: Option<&Detection>| {
            detection.map_or("nothing".to_owned(), |one| {
                let requirements: Vec<&str> = one.requirements.iter().map(String::as_str).collect();
                format!(
                    "{} {} in {}",
                    one.result,
                    requirements.join(" "),
                    plural(one.cases.len(), "case")
                )
            })
        };
        let was = before.modes.get(mode);
        if was != Some(detection) {
            let (mode, was, is) = (mode.name(), shown(was), shown(Some(detection)));
            differences.push(format!("{id}, {mode}: {was} in the table, {is} now"));
        }
    }
    differences
}

/// Serializes the figures and the IDs of the missed defects of each mode.
fn figures<S: Serializer>(table: &DetectionTable, serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct OfMode<'t> {
        mode: &'static str,
        #[serde(flatten)]
        figures: Figures,
        missed_defects: Vec<&'t str>,
    }
    let modes = Mode::ALL.into_iter().map(|mode| OfMode {
        mode: mode.name(),
        figures: table.figures(mode),
        missed_defects: table.missed(mode).map(|(row, _)| row.id.as_str()).collect(),
    });
    serializer.collect_seq(modes)
}

impl DetectionTable {
    /// The missed defects of a mode, each with the first request whose reply shows the defect.
    pub fn missed(&self, mode: Mode) -> impl Iterator<Item = (&DetectionRow, &str)> {
        self.rows.iter().filter_map(move |row| match row.modes.get(&mode).map(|one| &one.result) {
            Some(DetectionResult::Missed(request)) => Some((row, request.as_str())),
            _ => None,
        })
    }
}
