//! A seeded defect, or a valid variant.

use std::fmt;

use ads_cnc::layout::Stream;
use ads_cnc_vectors::ids::*;

use super::cnc::{CncDefect, CncFault};
use super::codec::CodecFault;
use super::field::{FieldChange, FieldDefect};
use crate::edition::Edition;
use crate::text::named;

/// A seeded defect, or a valid variant.
#[derive(Clone, Debug)]
pub struct SeededDefect {
    /// The ID, which is unique.
    pub id: String,
    /// The requirements, or parts of requirements, that the defect violates; empty for a valid
    /// variant.
    pub requirements: Vec<&'static str>,
    pub what: String,
    /// The kind: codec, CNC or valid variant.
    pub kind: DefectKind,
    /// The only edition in which the defect is detectable; `None` if the defect is not limited to
    /// an edition.
    pub edition: Option<Edition>,
    /// Whether the CNC with this seeded defect claims to reply literally as in the manuals' printed
    /// examples (`printed_examples` of its profile). False for some valid variants.
    pub printed: bool,
    pub(super) how: Mechanism,
}

/// The kind of a seeded defect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum DefectKind {
    /// A defect of a codec. Field defects are of this kind, but a simulated CNC can have them too.
    Codec,
    Cnc,
    /// A valid variant of a CNC.
    Different,
}

named! { DefectKind: Codec "codec", Cnc "cnc", Different "different", }

#[derive(Clone, Debug)]
pub(super) enum Mechanism {
    Field(FieldDefect),
    Codec(CodecFault),
    Cnc(CncFault),
}

impl From<FieldDefect> for SeededDefect {
    fn from(defect: FieldDefect) -> Self {
        // The requirement of the stream, which specifies the offset of the field, and that of the
        // field.
        let layout = defect.stream.layout();
        let mut requirements = vec![layout.clause];
        requirements.extend(defect.field.spec().map(|field| field.clause));
        // The contents of COM objects and the contents of elements (SDA-4) are the same stream.
        if defect.stream == Stream::Content {
            requirements.push(SDA_4.as_str());
        }
        requirements.dedup();
        // A zero turns an error into a success, which ADS-7 forbids. Which other number an error
        // has is not specified.
        if defect.field.name() == "result" && defect.change == FieldChange::Zero {
            requirements.push(ADS_7.as_str());
        }
        Self {
            id: defect.id.clone(),
            requirements,
            what: defect.to_string(),
            kind: DefectKind::Codec,
            edition: None,
            printed: true,
            how: Mechanism::Field(defect),
        }
    }
}

impl SeededDefect {
    pub(super) fn of_row(row: &CncDefect, kind: DefectKind) -> Self {
        Self {
            id: row.id.to_owned(),
            requirements: row.breaks.iter().map(|id| id.as_str()).collect(),
            what: row.what.to_owned(),
            kind,
            edition: row.edition,
            printed: row.printed,
            how: Mechanism::Cnc(row.fault),
        }
    }

    /// The field defect; otherwise `None`.
    pub fn field(&self) -> Option<&FieldDefect> {
        match &self.how {
            Mechanism::Field(defect) => Some(defect),
            _ => None,
        }
    }

    /// The defect that changes a codec's answers in the testee protocol; otherwise `None`.
    pub(crate) const fn of_codec(&self) -> Option<CodecFault> {
        match self.how {
            Mechanism::Codec(fault) => Some(fault),
            _ => None,
        }
    }

    /// Whether a simulated CNC can have the defect.
    pub const fn is_for_cnc(&self) -> bool {
        matches!(self.how, Mechanism::Field(_) | Mechanism::Cnc(_))
    }

    /// The data model of a variant that replaces the model of the CNC; otherwise `None`.
    pub(crate) const fn own_model(&self) -> Option<&'static str> {
        match self.how {
            Mechanism::Cnc(CncFault::Model(model)) => Some(model),
            _ => None,
        }
    }

    /// Whether a codec can have the defect.
    pub const fn is_for_codec(&self) -> bool {
        matches!(self.kind, DefectKind::Codec)
    }
}

impl fmt::Display for SeededDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}
