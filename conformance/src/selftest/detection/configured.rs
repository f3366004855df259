//! Witnesses: correct CNCs with a configuration that differs from that of the tested device. In at
//! least one mode, the replies of a witness equal those of the device with a defect.

use std::sync::Arc;

use super::detection_result::{DetectionResult, Mode};
use super::device::Device;
use super::table::DetectionRow;
use crate::edition::Edition;
use crate::faults::{self, Faulty};
use crate::session::ToolError;

/// A text, and the function that changes each line of the model that contains this text.
type Change = (&'static str, fn(&str) -> String);

/// A correct CNC with another configuration, optionally a valid variant.
pub(super) struct Witness {
    /// The IDs of the defects for which the witness is tried: in at least one mode, the replies of
    /// a CNC with the defect equal those of the witness.
    defects: &'static [&'static str],
    pub(super) what: &'static str,
    /// The changes to the lines of the device's model.
    changes: &'static [Change],
    edition: Option<Edition>,
    variant: Option<&'static str>,
}

const OBJECTS: &str = "offset = ";
const ELEMENTS: &str = "unit = ";
const VARIABLES: &str = "name = \"V.";
const WRITABLE: &str = ", writable = true";
const AXIS_NUMBER: &str = "is = \"axis-number\"";
const NUMBERS: &str = "values = [1, 2, 3, 4, 5]";

const SAME: Witness =
    Witness { defects: &[], what: "", changes: &[], edition: None, variant: None };

const WITNESSES: &[Witness] = &[
    Witness {
        defects: &["object-descriptor.write_access.invert", "cnc.com.access-always"],
        what: "any object may be writable",
        changes: &[(OBJECTS, writable)],
        ..SAME
    },
    Witness {
        defects: &["element-write-flag.flag.flip"],
        what: "any element may be writable",
        changes: &[(ELEMENTS, toggled)],
        variant: Some("different.first-writable"),
        ..SAME
    },
    Witness {
        defects: &["element-write-flag.flag.invert", "cnc.sda.flag-always", "cnc.sda.flag-text"],
        what: "any element may be writable",
        changes: &[(ELEMENTS, writable)],
        variant: Some("different.first-writable"),
        ..SAME
    },
    Witness {
        defects: &["element-write-flag.flag.zero"],
        what: "no element may be writable",
        changes: &[(ELEMENTS, read_only)],
        ..SAME
    },
    Witness {
        defects: &["cnc.var.access-read-write"],
        what: "any variable may be writable",
        changes: &[(VARIABLES, writable)],
        ..SAME
    },
    Witness {
        defects: &["cnc.var.extended-swapped"],
        what: "any V.E may be synchronised, and valid in all channels",
        changes: &[("V.E.uns32", |line| line.replace(NO_SYNC, CHANNEL))],
        ..SAME
    },
    Witness {
        defects: &["cnc.var.index-reversed"],
        what: "any V.E may be synchronised, and valid in all channels",
        changes: &[
            ("V.E.uns32", |line| line.replace(NO_SYNC, "")),
            ("V.E.real64", |line| line.replace(NO_SYNC, "").replace(CHANNEL, "")),
            ("V.E.Variable_96\"", |line| line.replace("64\"", &format!("64\"{NO_SYNC}"))),
            ("V.E.Variable_95\"", |line| line.replace("32\"", &format!("32\"{NO_SYNC}{CHANNEL}"))),
        ],
        ..SAME
    },
    Witness {
        defects: &["describe-by-name.reject"],
        what: "a CNC of an earlier version has no description by name",
        changes: &[("cnc-version = ", |_| "cnc-version = \"V4.28.0\"".to_owned())],
        ..SAME
    },
    Witness {
        defects: &["cnc.gen.utf-8"],
        what: "a name may have any characters",
        changes: &[("V.E.Länge", utf8), ("°C", utf8)],
        ..SAME
    },
    Witness {
        defects: &["cnc.gen.units-ascii"],
        what: "a unit may be any text",
        changes: &[(ELEMENTS, |line| line.replace('°', ""))],
        ..SAME
    },
    Witness {
        defects: &["cnc.dyn.p1-value"],
        what: "a parameter may have any value",
        changes: &[("\"P1\"", |line| line.replace("4711", "4712"))],
        ..SAME
    },
    Witness {
        defects: &["cnc.dyn.value-six-digits"],
        what: "a parameter may have any value",
        changes: &[("\"P10\"", |line| line.replace("1e-300", "0.0"))],
        ..SAME
    },
    Witness {
        defects: &["cnc.com.command-elsewhere"],
        what: "an object may have any offset",
        changes: &[("mc_command_single_block_w", |line| line.replace("0x1", "0x2"))],
        ..SAME
    },
    Witness {
        defects: &["cnc.var.cycle-refused"],
        what: "a CNC may have no V.CYC",
        changes: &[("name = \"V.CYC", |_| String::new())],
        ..SAME
    },
    Witness {
        defects: &["cnc.var.by-name-unavailable"],
        what: "a CNC may have an older version",
        changes: &[("cnc-version = ", |_| "cnc-version = \"V4.18.0\"".to_owned())],
        ..SAME
    },
    Witness {
        defects: &["cnc.var.dynamic-refused"],
        what: "a CNC may follow the other edition",
        edition: Some(Edition::English),
        ..SAME
    },
];

const NO_SYNC: &str = ", synchronisation = \"NO_SYNC\"";
const CHANNEL: &str = ", validity = \"CHANNEL\"";

fn read_only(line: &str) -> String {
    line.replace(WRITABLE, "")
}

/// Makes the value of a line writable. A read-only axis number also becomes an ordinary number,
/// because the simulated CNC does not let a client write the number of a platform axis.
fn writable(line: &str) -> String {
    let own = if line.contains(WRITABLE) { line } else { &line.replace(AXIS_NUMBER, NUMBERS) };
    read_only(own).replace(", type = ", &format!("{WRITABLE}, type = "))
}

fn toggled(line: &str) -> String {
    if line.contains(WRITABLE) { read_only(line) } else { writable(line) }
}

/// The line with `ä` and `°` replaced by the characters that CP1252 assigns to the bytes of their
/// UTF-8 encoding.
fn utf8(line: &str) -> String {
    line.replace('ä', "Ã¤").replace('°', "Â°")
}

/// The witnesses of a defect.
pub(super) fn of(defect: &str) -> impl Iterator<Item = &'static Witness> {
    WITNESSES.iter().filter(move |witness| witness.defects.contains(&defect))
}

impl Witness {
    fn model(&self, model: &str) -> String {
        let changed = |line: &str| {
            self.changes.iter().fold(line.to_owned(), |line, (text, change)| {
                if line.contains(text) { change(&line) } else { line }
            })
        };
        model.lines().map(|line| changed(line) + "\n").collect()
    }

    /// The simulated CNC of the witness; `None` if the mode uses the profile of the device and the
    /// profile does not apply to the witness.
    pub(super) fn cnc(
        &self,
        device: &Device,
        mode: Mode,
    ) -> Result<Option<Arc<Faulty>>, ToolError> {
        let variant = self.variant.and_then(faults::by_id);
        device.cnc_with_model(&self.model(device.model), self.edition, variant, mode)
    }
}

/// The unnecessary witnesses: those that no result of their defect names in any mode.
pub(super) fn stale(rows: &[DetectionRow]) -> Vec<String> {
    let is_needed = |defect: &str, what: &str| {
        let results = rows.iter().filter(|row| row.id == defect).flat_map(|row| row.modes.values());
        let shown = DetectionResult::Undetectable(what.to_owned());
        results.into_iter().any(|one| one.result == shown)
    };
    let all = WITNESSES.iter().flat_map(|one| one.defects.iter().map(|defect| (*defect, one.what)));
    let stale = all.filter(|(defect, what)| !is_needed(defect, what));
    stale.map(|(defect, what)| format!("{defect}: unnecessary witness: {what}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulator::DEFAULT_MODEL;

    /// The defects of each witness exist, and each change has an effect.
    #[test]
    fn every_change_of_a_witness_applies() {
        for witness in WITNESSES {
            let known = |id: &&str| faults::by_id(id).is_some();
            assert!(witness.defects.iter().all(known), "{:?}", witness.defects);
            assert!(witness.variant.iter().all(known), "{:?}", witness.variant);
            let changes = witness.changes.iter();
            for (text, change) in changes {
                let mut lines = DEFAULT_MODEL.lines().filter(|line| line.contains(text));
                assert!(lines.any(|line| change(line) != line), "{text}: {}", witness.what);
            }
            assert!(witness.edition.is_some() || !witness.changes.is_empty(), "{}", witness.what);
        }
    }

    #[test]
    fn an_unnecessary_witness_is_stale() {
        let all: usize = WITNESSES.iter().map(|witness| witness.defects.len()).sum();
        assert_eq!(stale(&[]).len(), all);
    }
}
