//! `ads-cnc check` and its implementation, with captures that the tests make from conversations with the
//! simulated CNC.

mod cli;
mod defects;
mod maker;
mod missing;
mod monitor;
mod talk;
mod wire;
