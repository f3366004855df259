//! Fuzz targets of `ads-cnc`, and the replay of their corpora without a fuzzer.
//!
//! A target is a law that holds for any bytes, or a few laws that go together. Their bodies are
//! here, so that `cargo test` replays the corpora on stable Rust; the binaries that need libFuzzer
//! are one line each. The laws of the codec are those of its own tests, which feed them samples,
//! cuts and random values.
//!
//! | module | what it has |
//! |---|---|
//! | [`targets`] | every target: its name, its body, what it proves, its seeded defects |
//! | [`Outcome`] | what an input led to, as one number: two builds are compared by it |
//! | [`Defect`] | how a target shows that it can fail |
//! | [`seeds`], [`dictionary`] | what a fuzzer starts from, made of vectors and samples |
//! | [`replay`] | a corpus through a target's body |

// The codec's minimum supported Rust version is older than that of this crate.
#[allow(clippy::manual_is_multiple_of, clippy::collapsible_if)]
#[path = "../../codec/tests/common/mod.rs"]
mod common;

// The simulated CNC's side of streaming and services, as its own tests check it.
#[cfg(feature = "tools")]
#[path = "../../conformance/tests/program/machines.rs"]
mod machines;
#[cfg(feature = "tools")]
#[path = "../../conformance/tests/program/world.rs"]
mod world;

mod bodies;
mod defect;
pub mod dictionary;
mod outcome;
mod replay;
pub mod seeds;
pub mod targets;

pub use defect::Defect;
pub use outcome::{Digest, Outcome};
pub use replay::{Folder, corpus, dictionaries, regressions, replay};
pub use targets::{TARGETS, Target};

// Here, as this crate is never packed without the files beside it.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
