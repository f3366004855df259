//! The Service Interface, with which an NC program calls a service outside the CNC and receives its
//! answer.
//!
//! Five variables of each channel carry one request at a time (SVC-1):
//!
//! | variable | type | meaning |
//! |---|---|---|
//! | [`V.G.SERVICE.UUID`](ServiceVariable::Uuid) | STRING | the called service: [`ServiceId`] |
//! | [`V.G.SERVICE.REQUEST`](ServiceVariable::Request) | STRING, ≤ 128 bytes | the request |
//! | [`V.G.SERVICE.REQUEST_STATE`](ServiceVariable::RequestState) | UNS32 | not 0 if a request is present |
//! | [`V.G.SERVICE.RESPONSE_STATE`](ServiceVariable::ResponseState) | UNS32 | not 0 if a response is present |
//! | [`V.G.SERVICE.RESPONSE`](ServiceVariable::Response) | STRING, ≤ 128 bytes | the response |
//!
//! [`Host`] executes the protocol of the Service Interface for one or more services on one channel:
//! it is a state machine without I/O, clock or allocation. It returns the next step, such as a
//! variable to read or write. The caller executes the step, for example over ADS with
//! [`ReadByName`](crate::operation::ReadByName), and reports the result.
//!
//! Manual: `service-en` and `service-de` 1.03, sections 1 and 2. CNC versions from V2.11.2030.01 and
//! V3.1.3057.03 on have the Service Interface.
//!
//! Requirement: SVC-11.
//!
//! ```
//! use ads_cnc::CncStr;
//! use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable};
//!
//! let ids = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?];
//! let mut host = Host::new(&ids);
//!
//! // The values that the NC program wrote.
//! let value = |variable| match variable {
//!     ServiceVariable::Uuid => &b"560AACBF-6335-44a9-895A-8B27F3ED5E47\0"[..],
//!     ServiceVariable::Request => b"ping\0",
//!     ServiceVariable::RequestState => &[1, 0, 0, 0],
//!     _ => &[0, 0, 0, 0],
//! };
//! let mut written = Vec::new();
//! while written.len() < 3 {
//!     match host.step() {
//!         HostStep::Read(variable) => host.read(value(variable))?,
//!         HostStep::Write(variable, bytes) => {
//!             written.push((variable, bytes.to_vec()));
//!             host.written();
//!         }
//!         HostStep::Serve { request, .. } => {
//!             assert_eq!(request, "ping");
//!             host.answer(CncStr::new("pong")?, 1)?;
//!         }
//!         HostStep::Wait => host.poll(),
//!     }
//! }
//! assert_eq!(written[0], (ServiceVariable::Response, b"pong\0".to_vec()));
//! assert_eq!(written[2], (ServiceVariable::ResponseState, vec![1, 0, 0, 0]));
//! # Ok::<(), ads_cnc::Error>(())
//! ```

mod host;
mod id;
mod value;
mod variable;

pub use host::{Host, HostStep, Outcome};
pub use id::ServiceId;
pub use variable::ServiceVariable;
