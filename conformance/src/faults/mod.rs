//! Seeded defects: what a codec or a CNC can get wrong, and what it may do otherwise.
//!
//! They change bytes around the codec and the simulated CNC, which know nothing of them, or set up
//! the CNC with another model or policy. The suite is tried with them: who has a defect has to fail
//! by a requirement that it breaks, who only does things in another way may not.
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

/// One thing done wrong, or otherwise.
#[derive(Clone, Debug)]
pub struct Seed {
    /// Unlike that of any other.
    pub id: String,
    /// What it breaks: one of them has to fail. None if nothing is wrong with it.
    pub requirements: Vec<&'static str>,
    pub what: String,
    /// By whom.
    pub kind: SeedKind,
    /// The edition it shows in, if it does not in any.
    pub edition: Option<Edition>,
    /// Whether the examples that the manuals print are still answered literally, as far as it is
    /// about. Who does things otherwise need not.
    pub printed: bool,
    how: How,
}

/// Who does something wrong, or otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SeedKind {
    /// A codec. A wrong field is wrong in a CNC too.
    Codec,
    Cnc,
    /// A CNC that does things otherwise, and none of them wrong.
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

/// Musts that none of these breaks, and why.
///
/// What a client alone can break has its defects among those of
/// [clients](crate::clients::defects).
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
        // The field's own clause, and the one of its offset in the stream.
        let layout = defect.stream.layout();
        let mut requirements = vec![layout.clause];
        requirements.extend(defect.field.spec().map(|field| field.clause));
        requirements.dedup();
        // An error number of 0 is none, and nothing else is specified of them.
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

    /// The wrong field, if that is all.
    pub fn field(&self) -> Option<&FieldDefect> {
        match &self.how {
            How::Field(defect) => Some(defect),
            _ => None,
        }
    }

    /// What a codec does around its answers.
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

    /// The model, if the CNC is another one: with channels, variables and objects of its own.
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
