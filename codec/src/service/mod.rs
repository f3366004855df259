//! The Service Interface: how a CNC program asks a service outside the CNC, and gets its answer.
//!
//! Five variables of each channel carry one request at a time (SVC-1):
//!
//! | variable | type | says |
//! |---|---|---|
//! | [`V.G.SERVICE.UUID`](ServiceVariable::Uuid) | STRING | which service is asked: [`ServiceId`] |
//! | [`V.G.SERVICE.REQUEST`](ServiceVariable::Request) | STRING, 128 bytes | what it is asked |
//! | [`V.G.SERVICE.REQUEST_STATE`](ServiceVariable::RequestState) | UNS32 | not 0: there is a request |
//! | [`V.G.SERVICE.RESPONSE_STATE`](ServiceVariable::ResponseState) | UNS32 | not 0: there is a response |
//! | [`V.G.SERVICE.RESPONSE`](ServiceVariable::Response) | STRING, 128 bytes | what it answered |
//!
//! Each of the three that take part is a state machine here, without I/O, clock or allocation:
//!
//! | who | here |
//! |---|---|
//! | the external service, or several of them on one channel | [`Host`] |
//! | the CNC program that asks | [`ServiceCall`]; only its wait, as the cycle has it: [`SysServiceWait`] |
//! | the interface between them, in the CNC | [`ServiceInterface`] |
//!
//! `Host` and `ServiceCall` say which variable is to be read or written next; the caller does it, over
//! ADS by [`ReadByName`](crate::operation::ReadByName) for one, and says how it went.
//!
//! Manual: `service-en` and `service-de` 1.03, sections 1 and 2; the cycle is in `service-en`,
//! section 3, only. A CNC has it from V2.11.2030.01 and V3.1.3057.03 on.
//!
//! SVC-11
//!
//! ```
//! use core::time::Duration;
//!
//! use ads_cnc::CncStr;
//! use ads_cnc::service::{ServiceCall, CallStep, Host, HostStep, ServiceInterface, ServiceId, SysServiceWait};
//!
//! let ids = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?];
//! let mut host = Host::new(&ids);
//! let mut interface = ServiceInterface::new();
//! let now = Duration::ZERO;
//! let mut program = ServiceCall::new(ids[0], CncStr::new("ping")?, SysServiceWait::default())?;
//!
//! let answer = loop {
//!     // The CNC's side …
//!     match program.step() {
//!         CallStep::Read(variable) => program.read(interface.read(variable), now)?,
//!         CallStep::Write(variable, bytes) => {
//!             interface.write(variable, bytes)?;
//!             program.written(now);
//!         }
//!         CallStep::Wait { .. } => program.poll(),
//!         CallStep::Done { response, .. } => break response.to_string(),
//!         CallStep::TimedOut => unreachable!("it has no longest wait"),
//!     }
//!     // … and the service's.
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
//! # Ok::<(), ads_cnc::Error>(())
//! ```

mod call;
mod host;
mod id;
mod interface;
mod value;
mod variable;
mod wait;

pub use call::{CallStep, ServiceCall};
pub use host::{Host, HostStep, Outcome};
pub use id::ServiceId;
pub use interface::{Clears, ServiceInterface};
pub use variable::ServiceVariable;
pub use wait::{LongestWait, SysServiceWait, WaitStep, Waiting};
