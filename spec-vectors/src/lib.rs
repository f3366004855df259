//! Golden vectors, errata and a requirement catalogue for the ADS interface of ISG and TwinCAT CNCs.
//!
//! The data is JSON in `data/`, for any language, with a JSON Schema in `schema/` for each kind of
//! file. `README.md` describes the data field by field. This crate embeds the files and parses
//! them:
//!
//! - a [`Requirement`] states an obligation of an implementation, its sources in the manuals, and its
//!   level;
//! - an [`Erratum`] records a place where the manuals contradict each other or leave a question
//!   open: each reading with its section, and the ruling;
//! - a [`Vector`] is one stream, divided into annotated [`Segment`]s, with its value or with the fault
//!   for which it has to be rejected;
//! - a [`Sequence`] is a case that needs a whole text or several steps: data streaming and the Service
//!   Interface.
//!
//! ```
//! use ads_cnc_vectors::{Expect, vector};
//!
//! let printed = vector("handle-printed").expect("a vector of this crate");
//! assert_eq!(printed.stream, "variable-handle");
//! assert_eq!(printed.bytes(), [0x04, 0x00, 0x00, 0x02]);
//! let Expect::Accept(accept) = &printed.expect else { panic!("a printed example is accepted") };
//! let handle = accept.value["handle"].tagged().expect("a single value");
//! assert_eq!(handle.integer(), Some(0x0200_0004));
//! ```
//!
//! This crate neither encodes nor decodes: the vectors judge codecs, so none of them is derived from a
//! codec. `check.py` verifies them independently, using only the standard library of Python.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod catalogue;
mod hex;
pub mod ids;
mod load;
mod sequence;
mod vector;

pub use catalogue::{
    About, Assumption, Basis, Clause, ClauseId, Document, Erratum, Interpretation, Level,
    Observable, Requirement, RequirementPart, Source, Status,
};
pub use hex::Hex;
pub use load::{
    Catalogue, LoadError, VERSION, catalogue, clause, documents, errata, erratum, requirement,
    requirements, sequence, sequences, vector, vectors,
};
pub use sequence::{
    ExternalService, FillPiece, HexPiece, Piece, Pieces, Sequence, SequenceAccept, SequenceExpect,
    SequenceInput, SequenceReject, ServiceAction, ServiceSequence, ServiceStep, Streaming,
    StreamingAck, StreamingAction, StreamingFault, StreamingStep, WaitParameters,
};
pub use vector::{
    Accept, AdsService, Context, Direction, Expect, Fields, Provenance, ProvenanceKind, Reject,
    Segment, Tagged, Type, Value, Vector,
};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
