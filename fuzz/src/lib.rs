//! Fuzz targets of `ads-cnc`, and the replay of their corpora without a fuzzer.
//!
//! A target checks a law that holds for any bytes, or a few related laws. The bodies of the targets
//! are in this library, so that `cargo test` replays the corpora on stable Rust; the binaries,
//! which need libFuzzer, only call the library. The laws of the codec are in a module of the
//! codec's tests, which apply them to other inputs, such as samples, truncated samples and random
//! values.
//!
//! | module | contents |
//! |---|---|
//! | [`targets`] | every target: its name, its body, what it proves, its seeded defects |
//! | [`Outcome`] | the result of an input with a digest, to compare two builds of the codec |
//! | [`Defect`] | the seeded defects, which show that a target can fail |
//! | [`seeds`], [`dictionary`] | initial inputs and words for a fuzzer, from vectors and samples |
//! | [`replay`] | runs the body of a target on its corpus |

// The codec's minimum supported Rust version is older than that of this crate.
#[allow(clippy::manual_is_multiple_of, clippy::collapsible_if)]
#[path = "../../codec/tests/common/mod.rs"]
mod common;

// Models of the streaming interface and the Service Interface. The tests of the suite compare the
// simulated CNC with them.
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

// The code in the README of the repository is tested by this library, because the library exists only in
// the repository.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
