//! `ads-cnc check` and what stands behind it: captures are made here, of real conversations.

mod cli;
mod defects;
mod maker;
mod missing;
mod monitor;
mod talk;
mod wire;
