//! Seeded defects of a codec or a CNC, and valid variants of a CNC.
//!
//! A [`SeededDefect`] is a defect or a valid variant: middleware around the codec or the simulated
//! CNC, or another data model or policy of the CNC. Seeded defects test the suite. With a valid
//! variant, no requirement may fail. With a defect, at least one of the requirements that it
//! violates must fail or, below the level *must*, have a warning or a difference. Exceptions are
//! defects that change no byte, or for which the self-test (`selftest`) states a reason.
//!
//! ```
//! use ads_cnc_conformance::faults::{self, DefectKind};
//!
//! let defect = faults::by_id("variable-description.size.flip").unwrap();
//! assert_eq!(defect.kind, DefectKind::Codec);
//! assert_eq!(defect.requirements, ["VAR-4", "VAR-8"]);
//! ```

mod cnc;
mod codec;
mod field;
mod operators;
mod seeded_defect;
mod variants;

#[cfg(test)]
mod tests;

use std::sync::OnceLock;

use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

pub use cnc::Faulty;
pub use field::{FieldChange, FieldDefect};
pub use seeded_defect::{DefectKind, SeededDefect};

pub fn all() -> &'static [SeededDefect] {
    static ALL: OnceLock<Vec<SeededDefect>> = OnceLock::new();
    ALL.get_or_init(|| {
        let fields = FieldDefect::all().into_iter().map(SeededDefect::from);
        let cnc = cnc::rows().map(|row| SeededDefect::of_row(row, DefectKind::Cnc));
        let variants = variants::rows().map(|row| SeededDefect::of_row(row, DefectKind::Different));
        fields
            .chain(codec::defects())
            .chain(operators::defects())
            .chain(cnc)
            .chain(variants)
            .collect()
    })
}

pub fn by_id(id: &str) -> Option<&'static SeededDefect> {
    all().iter().find(|defect| defect.id == id)
}

/// The requirements of level *must* that no defect violates, each with the reason. Those that the
/// catalogue excludes are left out.
///
/// Requirements that concern only clients are not in this list:
/// [defects of a client](crate::client_suite::defects) violate them.
pub const fn without() -> &'static [(ClauseId, &'static str)] {
    &[
        (
            VAR_29,
            "VAR-29 lists the offsets of the functions; a defect of a function violates the requirement \
             that specifies its reply.",
        ),
        (
            STM_21,
            "The simulated CNC does not interpret NC lines, so it has no other syntax errors to report; \
             a CNC shows them on its screen.",
        ),
    ]
}
