//! The simulated CNC: data model, replies, and AMS/TCP server.
//!
//! [`Cnc::answer`] answers an ADS request with data or an error number. [`Cnc::respond`] answers a
//! frame. [`Server`] answers the frames of TCP connections, for a [`Cnc`] or any other
//! [`Responder`]. A request for an unknown function, or with invalid data, is answered with an
//! error number; no request causes a panic. A malformed frame ends its connection, and a frame that
//! is a response is ignored.
//!
//! ```
//! use ads_cnc::address::{IndexGroup, IndexOffset};
//! use ads_cnc::ads::AmsPort;
//! use ads_cnc::operation::{AdsService, Call};
//! use ads_cnc_conformance::simulator::Cnc;
//!
//! let cnc = Cnc::with_default_model()?;
//! let count = Call {
//!     port: AmsPort::SDA,
//!     service: AdsService::ReadWrite,
//!     index_group: IndexGroup::new(0x12_2301),
//!     index_offset: IndexOffset::new(0x44),
//!     read_length: 4,
//!     data: b"V.E\0",
//! };
//! assert_eq!(cnc.answer(&count), Ok(vec![123, 0, 0, 0]));
//! # Ok::<(), ads_cnc_conformance::simulator::ModelError>(())
//! ```

mod answer;
mod clock;
mod content;
mod control;
mod frames;
mod in_process;
mod inspect;
mod model;
mod owner;
mod parameters;
pub mod program;
mod respond;
mod responder;
mod server;
mod state;

pub use crate::gate::NET_ID;
pub use answer::Cnc;
pub use control::ControlError;
pub use frames::Frames;
pub use in_process::LocalCnc;
pub use inspect::{ContentOwner, CurrentParameter, CurrentVariable, StoredContent};
pub use model::{ConfiguredVariable, DEFAULT_MODEL, Model, ModelError, Settings};
pub use respond::{DATA_MAX, ReplyData};
pub(crate) use respond::{FRAME_MAX, respond};
pub use responder::Responder;
pub use server::{CONNECTION_BYTES_MAX, CONNECTIONS_MAX, ReceiveBuffer, Server, ServerOptions};
