//! Seeded defects of a codec or a CNC, and valid variants of a CNC.
//!
//! They are middleware around the codec and the simulated CNC, or give the CNC another model or
//! policy. They test the suite: a defect must fail by a requirement that it breaks, and a valid
//! variant must not fail.
//!
//! ```
//! use ads_cnc_conformance::faults::{self, SeedKind};
//!
//! let seed = faults::by_id("variable-description.size.flip").unwrap();
//! assert_eq!((seed.kind, &seed.requirements[..]), (SeedKind::Codec, &["VAR-4", "VAR-8"][..]));
//! ```

mod cnc;
mod codec;
mod field;
mod variants;

#[cfg(test)]
mod tests;

use std::fmt;
use std::sync::OnceLock;

use crate::edition::Edition;
use crate::text::named;

use cnc::CncFault;
pub use cnc::Faulty;
pub use field::{FieldChange, FieldDefect};

/// A seeded defect, or a valid variant.
#[derive(Clone, Debug)]
pub struct Seed {
    /// Unique ID.
    pub id: String,
    /// The requirements that it breaks: at least one of them has to fail. Empty for a valid
    /// variant.
    pub requirements: Vec<&'static str>,
    pub what: String,
    /// Codec, CNC or valid variant.
    pub kind: SeedKind,
    /// The only edition in which it is detectable; `None` for both.
    pub edition: Option<Edition>,
    /// Whether the printed examples that it concerns are still answered literally. A valid variant
    /// may answer otherwise.
    pub printed: bool,
    how: How,
}

/// The kind of a seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SeedKind {
    /// A defect of a codec. A defect of a field exists in a CNC too.
    Codec,
    Cnc,
    /// A valid variant of a CNC.
    Different,
}

named! { SeedKind: Codec "codec", Cnc "cnc", Different "different", }

#[derive(Clone, Debug)]
enum How {
    Field(FieldDefect),
    Codec(codec::CodecFault),
    Cnc(CncFault),
}

pub fn all() -> &'static [Seed] {
    static ALL: OnceLock<Vec<Seed>> = OnceLock::new();
    ALL.get_or_init(|| {
        let fields = FieldDefect::all().into_iter().map(Seed::from);
        let cnc = cnc::rows().map(|row| Seed::of_row(row, SeedKind::Cnc));
        let variants = variants::rows().map(|row| Seed::of_row(row, SeedKind::Different));
        fields.chain(codec::seeds()).chain(cnc).chain(variants).collect()
    })
}

pub fn by_id(id: &str) -> Option<&'static Seed> {
    all().iter().find(|seed| seed.id == id)
}

/// Requirements of level must that no seed breaks, with the reason.
///
/// Requirements of clients alone are broken by [defects of a client](crate::clients::defects).
pub const fn without() -> &'static [(&'static str, &'static str)] {
    &[
        (
            "VAR-29",
            "The offsets of the functions: each of them has defects of its own, by the requirement that \
             says what it answers.",
        ),
        (
            "STM-21",
            "The simulated CNC does not interpret NC lines, so it has no other syntax errors to report; \
         how a CNC reports one shows on its screen.",
        ),
    ]
}

impl From<FieldDefect> for Seed {
    fn from(defect: FieldDefect) -> Self {
        // The field's requirement, and that of its offset in the stream.
        let layout = defect.stream.layout();
        let mut requirements = vec![layout.clause];
        requirements.extend(defect.field.spec().map(|field| field.clause));
        requirements.dedup();
        // Zero turns an error into a success, which ADS-7 forbids; other error numbers are not
        // specified.
        if defect.field.name() == "result" && defect.change == FieldChange::Zero {
            requirements.push("ADS-7");
        }
        Self {
            id: defect.id.clone(),
            requirements,
            what: defect.to_string(),
            kind: SeedKind::Codec,
            edition: None,
            printed: true,
            how: How::Field(defect),
        }
    }
}

impl Seed {
    fn of_row(row: &cnc::CncSeed, kind: SeedKind) -> Self {
        Self {
            id: row.id.to_owned(),
            requirements: row.breaks.to_vec(),
            what: row.what.to_owned(),
            kind,
            edition: row.edition,
            printed: row.printed,
            how: How::Cnc(row.fault),
        }
    }

    /// The defect of a field, if it is one.
    pub fn field(&self) -> Option<&FieldDefect> {
        match &self.how {
            How::Field(defect) => Some(defect),
            _ => None,
        }
    }

    /// The defect of a codec's answers, if it is one.
    pub(crate) const fn of_codec(&self) -> Option<codec::CodecFault> {
        match self.how {
            How::Codec(fault) => Some(fault),
            _ => None,
        }
    }

    /// Whether a simulated CNC can have it.
    pub const fn is_for_cnc(&self) -> bool {
        matches!(self.how, How::Field(_) | How::Cnc(_))
    }

    /// The model of a CNC with other channels, variables and objects.
    pub(crate) const fn own_model(&self) -> Option<&'static str> {
        match self.how {
            How::Cnc(CncFault::Model(model)) => Some(model),
            _ => None,
        }
    }

    /// Whether a codec can have it.
    pub const fn is_for_codec(&self) -> bool {
        matches!(self.kind, SeedKind::Codec)
    }
}

impl fmt::Display for Seed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}
