//! A seeded defect, or a variant.

use std::fmt;

use super::cnc::{CncFault, CncSeed};
use super::codec::CodecFault;
use super::field::{FieldChange, FieldDefect};
use crate::edition::Edition;
use crate::text::named;

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
    pub(super) how: How,
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
pub(super) enum How {
    Field(FieldDefect),
    Codec(CodecFault),
    Cnc(CncFault),
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
    pub(super) fn of_row(row: &CncSeed, kind: SeedKind) -> Self {
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
    pub(crate) const fn of_codec(&self) -> Option<CodecFault> {
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
