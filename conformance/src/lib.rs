//! The conformance suite, the simulated CNC and the command-line tools around the codec
//! [`ads_cnc`], which itself opens no sockets or files.
//!
//! A module imports only modules below it in this table; `tests/readme/floors.rs` checks that.
//!
//! | module | content |
//! |---|---|
//! | [`cli`] | the command line of `ads-cnc` |
//! | [`selftest`] | tests of the suite with seeded defects |
//! | [`matrix`] | the cases, vectors and tests of each requirement |
//! | [`capture`] | reads and judges captured traffic; writes captures for Wireshark |
//! | [`clients`] | clients under test, and the simulated CNC that they connect to |
//! | [`suite`] | the cases for a CNC |
//! | [`testee`] | codecs under test, over stdin and stdout |
//! | [`named`], [`objects`] | finds a variable or an object by its name, or lists all |
//! | [`session`] | the typed connection of a command to a CNC |
//! | [`report`] | the report of a run, in all its formats |
//! | [`client`] | an AMS/TCP client that records every byte |
//! | [`faults`] | seeded defects of a codec or a CNC, and valid variants |
//! | [`simulator`] | the simulated CNC: data model, answers, AMS/TCP server |
//! | [`net`] | the only module that opens sockets |
//! | [`rules`] | the requirements as checks of requests, replies and the known state of a CNC |
//! | [`exchange`] | a request and its result |
//! | [`gate`] | decides which frames may be sent to a target |
//! | [`process`] | commands given by the user, and signals |
//! | [`tables`] | the codec's tables as data, and a dissector made from them |
//! | [`explain`] | shows the bytes of any stream field by field |
//! | [`codec`], [`show`] | the codec by the field names of the vectors, and their values as text |
//! | [`judge`] | case, check, evidence, outcome, verdict, plan, waiver |
//! | [`values`] | typed values: parsing and formatting |
//! | [`profile`], [`edition`] | the claims of a target; features by edition and version |
//! | [`wire_service`] | requirement, streams and reply of the three ADS services |
//! | [`deadline`] | the time at which a command stops sending requests |
//! | [`text`] | hex, escapes, times, JSON |
//!
//! [`ads_cnc`] encodes every byte that the simulated CNC sends; there is no second encoder.
//!
//! Only the command `ads-cnc` is stable: its arguments, exit codes and JSON. This library is public
//! only for its tests and fuzz targets, and may change with any version.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods)]
// Code must not panic on received bytes, nor between a write and the restoration of the value.
// Modules without such code allow these lints, below or in their parent: a panic there only makes
// one case a harness error, or ends a command before its first request. In `cli` and `suite`, the
// files that write to a target or restore a value deny these lints again.
#![cfg_attr(
    not(test),
    deny(
        clippy::arithmetic_side_effects,
        clippy::as_conversions,
        clippy::expect_used,
        clippy::indexing_slicing,
        clippy::panic,
        clippy::string_slice,
        clippy::unreachable,
        clippy::unwrap_used
    )
)]

pub mod capture;
#[allow(clippy::restriction)]
pub mod cli;
pub mod client;
pub mod clients;
pub mod codec;
pub mod deadline;
#[allow(clippy::restriction)]
pub mod edition;
pub mod exchange;
pub mod explain;
#[allow(clippy::restriction)]
pub mod faults;
pub mod gate;
#[allow(clippy::restriction)]
pub mod judge;
#[allow(clippy::restriction)]
pub mod matrix;
pub mod named;
pub mod net;
pub mod objects;
pub mod process;
#[allow(clippy::restriction)]
pub mod profile;
#[allow(clippy::restriction)]
pub mod report;
pub mod rules;
#[allow(clippy::restriction)]
pub mod selftest;
pub mod session;
pub mod show;
pub mod simulator;
#[allow(clippy::restriction)]
pub mod suite;
pub mod tables;
pub mod testee;
pub mod text;
pub mod values;
pub mod wire_service;
