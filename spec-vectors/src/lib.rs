//! Golden vectors, errata and a requirement catalogue for the ADS interface of ISG and TwinCAT CNCs.
//!
//! The data is JSON under `data/`, with a JSON Schema for each file under `schema/`; it is meant for any
//! language, and `README.md` describes it field by field. This crate embeds the files and reads them:
//!
//! - a [`Requirement`] says what an implementation has to do, in which edition of which manual that
//!   stands, and how firmly;
//! - an [`Erratum`] holds what contradicts itself in the manuals, each reading with its place, and what
//!   was decided;
//! - a [`Vector`] is one stream, cut into annotated [`Segment`]s, with the value it stands for or the
//!   fault it has to be refused for;
//! - a [`Sequence`] is what takes a whole text or several steps to show: data streaming and the Service
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
//! Nothing here encodes or decodes: the vectors judge codecs, so they are derived from no codec.
//! `check.py` derives them a second time, with nothing but Python's `struct`.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod catalogue;
mod hex;
pub mod ids;
mod load;
mod sequence;
mod vector;

pub use catalogue::{
    About, Assumption, Basis, Clause, ClauseId, Document, Erratum, Level, Observable, Part,
    Reading, Requirement, Source, Status,
};
pub use hex::Hex;
pub use load::{
    Catalogue, LoadError, VERSION, catalogue, clause, documents, errata, erratum, requirement,
    requirements, sequence, sequences, vector, vectors,
};
pub use sequence::{
    ExternalService, FillPiece, Given, HexPiece, Piece, Pieces, Sequence, SequenceAccept,
    SequenceExpect, SequenceReject, ServiceAction, ServiceSequence, ServiceStep, StreamAck,
    StreamAction, StreamError, StreamStep, Streaming, WaitParameters,
};
pub use vector::{
    Accept, Context, Direction, Expect, Fields, Provenance, ProvenanceKind, Reject, Segment,
    Service, Tagged, Type, Value, Vector,
};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
