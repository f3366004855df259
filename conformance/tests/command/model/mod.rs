//! The data model of the simulated CNC, in most tests as read and written by the published crate
//! `ads`, a client that is independent of this project. Most expected bytes are literals.

mod axes;
mod dynamic;
mod editions;
mod elements;
mod files;
mod objects;
mod programs;
mod service;
mod timed;
mod variables;

use crate::common::task::Cnc;

/// The index group of the variables of channel 1.
const CHANNEL_1: u32 = 0x12_2301;
