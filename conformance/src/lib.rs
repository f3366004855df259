//! The conformance suite, the simulated CNC and the tools around the codec [`ads_cnc`]. The codec
//! itself opens no socket and no file.
//!
//! Except in its tests, a module imports only modules below it in this table, which
//! `tests/readme/floors.rs` checks.
//!
//! | module | contents |
//! |---|---|
//! | [`cli`] | the command line of `ads-cnc` |
//! | [`selftest`] | tests of the suite with seeded defects |
//! | [`matrix`] | the vectors, cases and fuzz targets that verify each requirement |
//! | [`capture`] | judges captured traffic, and writes traffic to files for Wireshark |
//! | [`client_suite`] | tests of clients, and the CNC to which they connect |
//! | [`suite`] | the cases for a CNC |
//! | [`testee`] | tests of codecs: of this project's, and of others over stdin and stdout |
//! | [`named`], [`objects`] | finds a variable or object of a CNC by its name, or lists all of them |
//! | [`session`] | the typed connection of a tool to a CNC |
//! | [`report`] | the report of a run, in all its formats |
//! | [`client`] | an AMS/TCP client of a target, which returns the bytes of each exchange |
//! | [`faults`] | seeded defects of a codec or a CNC, and valid variants |
//! | [`simulator`] | the simulated CNC: data model, replies, AMS/TCP server |
//! | [`net`] | the only module that opens sockets, except for tests |
//! | [`rules`] | checks of requests and replies by the manuals' clauses, with the state of each CNC |
//! | [`exchange`] | a request and its result |
//! | [`gate`] | decides which frames may be sent to a target |
//! | [`process`] | runs commands given by the user, and handles signals |
//! | [`tables`] | the codec's tables as data, and in the forms of Wireshark and Kaitai Struct |
//! | [`explain`] | explains the bytes of any stream, field by field |
//! | [`codec`], [`vector_format`] | calls the codec by the stream names of the vectors, and formats values as text |
//! | [`judge`] | case, check, outcome, verdict, plan, waiver |
//! | [`evidence`] | the bytes that a check is based on |
//! | [`values`] | typed values: parsing and formatting |
//! | [`profile`], [`edition`] | the claims of a target; features by edition and version |
//! | [`ads_service`] | requirement, streams and reply of the three ADS services |
//! | [`deadline`] | when a tool stops sending requests |
//! | [`value_format`] | the type by which values are shown |
//! | [`exit`] | the exit codes |
//! | [`text`] | hex, escapes, durations, patterns of names, JSON, errors of files |
//! | [`number`], [`mutex`] | converts numbers, lengths and bytes, and forms a digest of bytes; locks a mutex |
//!
//! The simulated CNC encodes the headers and streams that it sends with [`ads_cnc`]. To detect
//! errors of [`ads_cnc`], [`client_suite`] also compares requests with bytes that [`ads_cnc`] did
//! not make, and sends such replies.
//!
//! The stable interface is the command `ads-cnc`; the section *Stability* of `TOOLS.md` says in
//! which points. This library is public only for the command, for its tests, for `conformance/load`
//! and for the fuzz targets, and may change with any version.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods)]
// Code must not panic on bytes from outside, nor between a write and the restoring of its value.
// Some modules allow these lints, here or in their parent module: a panic in such a module only
// makes one case a harness error, or ends a tool that has no changed value to restore. In the
// modules `cli` and `suite`, the files that write to a target or restore a value deny the lints
// again.
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

pub mod ads_service;
pub mod capture;
#[allow(clippy::restriction)]
pub mod cli;
pub mod client;
pub mod client_suite;
pub mod codec;
pub mod deadline;
#[allow(clippy::restriction)]
pub mod edition;
pub mod evidence;
pub mod exchange;
pub mod exit;
pub mod explain;
#[allow(clippy::restriction)]
pub mod faults;
pub mod gate;
#[allow(clippy::restriction)]
pub mod judge;
#[allow(clippy::restriction)]
pub mod matrix;
pub mod mutex;
pub mod named;
pub mod net;
pub mod number;
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
pub mod simulator;
#[allow(clippy::restriction)]
pub mod suite;
pub mod tables;
pub mod testee;
pub mod text;
pub mod value_format;
pub mod values;
pub mod vector_format;
