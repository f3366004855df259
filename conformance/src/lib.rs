//! The conformance suite, the simulated CNC and the tools around the codec [`ads_cnc`]: all that
//! opens a socket or a file.
//!
//! A module imports only modules below it in this table; `tests/readme/floors.rs` checks that.
//!
//! | module | what it has |
//! |---|---|
//! | [`cli`] | the command line of `ads-cnc` |
//! | [`selftest`] | the suite tried on itself |
//! | [`matrix`] | what covers each requirement |
//! | [`capture`] | captured traffic, judged, and written as Wireshark reads it |
//! | [`clients`] | clients of others, which talk to a CNC that can do wrong |
//! | [`suite`] | the cases that a CNC is tried with |
//! | [`testee`] | codecs of others, asked over stdin and stdout |
//! | [`named`], [`objects`] | what a CNC has, one thing by its name or all of it |
//! | [`session`] | a CNC to ask, typed: what tools work with |
//! | [`report`] | how judgements are shown |
//! | [`client`] | an AMS/TCP client that keeps every byte |
//! | [`faults`] | seeded defects: what a codec or a CNC can get wrong |
//! | [`simulator`] | the simulated CNC: data model, answers, AMS/TCP server |
//! | [`net`] | the one place where sockets are opened |
//! | [`exchange`] | a request and what came of it |
//! | [`gate`] | what may be sent to a target |
//! | [`process`] | commands that a user names, and signals |
//! | [`explain`] | bytes of any stream, field by field |
//! | [`codec`], [`show`] | the codec as the vectors see it, and their values as people do |
//! | [`judge`] | case, check, evidence, outcome, verdict, plan, waiver |
//! | [`values`] | values as people read and write them |
//! | [`profile`], [`edition`] | what a target claims, and what an edition or a version has |
//! | [`wire_service`] | what the three ADS services have on the wire |
//! | [`deadline`] | when a tool stops asking |
//! | [`text`] | hex, escapes, times, JSON |
//!
//! Every byte the simulated CNC sends is encoded by [`ads_cnc`]; there is no second encoder.
//!
//! What is stable is the command `ads-cnc`: its arguments, exit codes and JSON. This library is public
//! for its tests and fuzz targets alone, and may change with any version.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods)]
// Nothing may panic on bytes from outside, nor between a write and its restoring. Modules that have
// neither allow it below: there a panic ends one case, which is then a harness error.
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
pub mod edition;
pub mod exchange;
pub mod explain;
#[allow(clippy::restriction)]
pub mod faults;
pub mod gate;
pub mod judge;
#[allow(clippy::restriction)]
pub mod matrix;
pub mod named;
pub mod net;
pub mod objects;
pub mod process;
pub mod profile;
#[allow(clippy::restriction)]
pub mod report;
#[allow(clippy::restriction)]
pub mod selftest;
pub mod session;
pub mod show;
pub mod simulator;
#[allow(clippy::restriction)]
pub mod suite;
pub mod testee;
pub mod text;
pub mod values;
pub mod wire_service;
