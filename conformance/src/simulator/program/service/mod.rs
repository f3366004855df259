//! The CNC's side of the Service Interface: the interface, and a request of an NC program.
//!
//! | item | type |
//! |---|---|
//! | the five variables of a channel | [`ServiceInterface`] |
//! | a request of an NC program to a service | [`ServiceCall`] |
//! | the wait for a response by the cycle SysServiceWait | [`SysServiceWait`] |
//!
//! The service's side is [`Host`](ads_cnc::service::Host). None of these types performs I/O or has
//! a clock.
//!
//! ```
//! use std::time::Duration;
//!
//! use ads_cnc::CncStr;
//! use ads_cnc::service::{Host, HostStep, ServiceId};
//! use ads_cnc_conformance::simulator::program::service::{
//!     CallStep, ServiceCall, ServiceInterface, SysServiceWait,
//! };
//!
//! let ids = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?];
//! let mut host = Host::new(&ids);
//! let mut interface = ServiceInterface::new();
//! let now = Duration::ZERO;
//! let mut program = ServiceCall::new(ids[0], CncStr::new("ping")?, SysServiceWait::default())?;
//!
//! let answer = loop {
//!     // A step of the NC program in the CNC.
//!     match program.step() {
//!         CallStep::Read(variable) => program.read(interface.read(variable), now)?,
//!         CallStep::Write(variable, bytes) => {
//!             interface.write(variable, bytes)?;
//!             program.written(now);
//!         }
//!         CallStep::Wait { .. } => program.poll(),
//!         CallStep::Done { response, .. } => break response.to_string(),
//!         CallStep::TimedOut => unreachable!("there is no maximum wait"),
//!     }
//!     // A step of the service.
//!     match host.step() {
//!         HostStep::Read(variable) => host.read(interface.read(variable))?,
//!         HostStep::Write(variable, bytes) => {
//!             interface.write(variable, bytes)?;
//!             host.written();
//!         }
//!         HostStep::Serve { request, .. } => {
//!             assert_eq!(request, "ping");
//!             host.answer(CncStr::new("pong")?, 1)?;
//!         }
//!         HostStep::Wait => host.poll(),
//!     }
//! };
//! assert_eq!(answer, "pong");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod call;
mod interface;
mod wait;

use ads_cnc::service::ServiceVariable;
use ads_cnc::{CncStr, Error};

pub use call::{CallError, CallStep, ServiceCall};
pub use interface::{Clears, ServiceInterface};
pub use wait::{NoTimer, SysServiceWait, WaitStep, Waiting};

/// The bytes of a STRING variable with this text: the text and one NUL.
fn value_of(text: CncStr<'_>) -> Vec<u8> {
    text.bytes().chain([0]).collect()
}

/// Checks the bytes of a STRING variable, and returns their text with one NUL.
fn text_value(value: &[u8], variable: ServiceVariable) -> Result<Vec<u8>, Error> {
    variable.text(value).map(value_of)
}
