//! The conformance suite, the simulated CNC and the tools around the codec [`ads_cnc`]: all that
//! opens a socket or a file.
//!
//! | module | what it has |
//! |---|---|
//! | [`cnc`] | the simulated CNC: data model, answers, AMS/TCP server |
//! | [`defect`] | seeded defects: what a codec or a CNC can get wrong |
//! | [`suite`] | what is tried, and what comes of it |
//! | [`selftest`] | the suite tried on itself |
//! | [`testee`] | codecs of others, asked over stdin and stdout |
//! | [`clients`] | clients of others, which talk to a CNC that can do wrong |
//! | [`capture`] | captured traffic, judged, and written as Wireshark reads it |
//! | [`child`] | commands that a user names |
//! | [`client`], [`exchange`] | an AMS/TCP client that keeps every byte |
//! | [`services`] | what the three ADS services have on the wire |
//! | [`gate`] | what may be sent to a target |
//! | [`deadline`] | when a tool stops asking |
//! | [`session`] | a CNC to ask, typed: what tools work with |
//! | [`objects`], [`named`] | what a CNC has, all of it or one thing by its name |
//! | [`values`] | values as people read and write them |
//! | [`profile`] | what a target claims |
//! | [`codec`], [`show`] | the codec as the vectors see it, and their values as people do |
//! | [`explain`] | bytes of any stream, field by field |
//! | [`verdict`], [`report`] | what a judgement can be, and how it is shown |
//! | [`matrix`] | what covers each requirement |
//! | [`waivers`] | failures that are known |
//! | [`net`] | the one place where sockets are opened |
//! | [`cli`] | the command line of `ads-cnc` |
//!
//! Every byte the simulated CNC sends is encoded by [`ads_cnc`]; there is no second encoder.
//!
//! What is stable is the command `ads-cnc`: its arguments, exit codes and JSON. This library is public
//! for its tests and fuzz targets alone, and may change with any version.

#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![deny(clippy::disallowed_methods)]
// Bytes from outside reach most of these modules: nothing may panic on them.
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
pub mod child;
pub mod cli;
pub mod client;
pub mod clients;
pub mod cnc;
pub mod codec;
pub mod deadline;
pub mod defect;
pub mod edition;
pub mod exchange;
pub mod explain;
pub mod gate;
mod interrupt;
pub mod matrix;
pub mod named;
pub mod net;
pub mod objects;
pub mod profile;
pub mod report;
pub mod selftest;
pub mod services;
pub mod session;
pub mod show;
pub mod suite;
pub mod testee;
pub mod text;
pub mod values;
pub mod verdict;
pub mod waivers;
