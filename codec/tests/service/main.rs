//! The Service Interface: the examples of the manuals, the order of what is written, the limits,
//! and what happens when something goes wrong.

#[path = "../common/mod.rs"]
mod common;

mod channel;
mod examples;
mod failures;
mod values;
