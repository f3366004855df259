//! Tests, most of which run the built command. They are one program, because linking a program
//! takes longer than most of the tests.

#[path = "../common/mod.rs"]
mod common;
#[path = "../kept/mod.rs"]
mod kept;

mod ads_client;
mod capture;
mod client_process;
mod commands;
mod completions;
mod explain;
mod faulty_devices;
mod gate;
mod geo;
mod hostile;
mod interrupt;
mod left_behind;
mod messages;
mod model;
mod named_only;
mod permission;
mod profile;
mod reports;
mod run;
mod select;
mod selftest;
mod serve;
mod service;
mod session;
mod stream;
mod testee;
mod tools;
mod traffic;
mod tripwire;
