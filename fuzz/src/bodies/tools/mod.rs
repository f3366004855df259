//! The bodies of the targets for the suite and the simulated CNC: they parse external bytes other
//! than the streams of the codec.

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
