//! The bodies of the targets for the tools and the simulated CNC.

pub(crate) mod calls;
pub(crate) mod capture;
pub(crate) mod conversation;
pub(crate) mod explain;
pub(crate) mod gate;
pub(crate) mod model;
pub(crate) mod session;
pub(crate) mod testee;
pub(crate) mod toml;

use super::input::Input;
