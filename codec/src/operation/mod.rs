//! The supported functions of a CNC: the address, the request and the reply of each function.
//!
//! A client builds an [`Operation`], encodes it and sends the bytes over any transport:
//!
//! ```
//! use ads_cnc::address::Channel;
//! use ads_cnc::operation::{Operation, ReadByName};
//!
//! let op = ReadByName::new(Channel::new(1)?, "V.E.Testvar")?;
//! let mut buf = [0; 256];
//! assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_2301, 0x48));
//! assert_eq!(op.encode(&mut buf)?, b"V.E.Testvar\0");
//! // Send the encoded bytes by ReadWrite, then decode the reply.
//! assert_eq!(op.decode_reply(&[123, 0, 0, 0])?.bytes, [123, 0, 0, 0]);
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! A server passes a received request to [`Call::dispatch`] and answers the [`Request`] with a
//! [`Reply`] or an ADS error. A dispatched request encodes to the received data.

mod address;
mod argument;
mod by_hand;
mod call;
mod docs;
mod frame;
mod functions;
mod reply;
mod rules;
mod service;
mod table;
mod typed;

pub use address::ObjectList;
pub use argument::{IntoName, WriteValue};
pub use call::{Call, DispatchError};
pub use functions::*;
pub use reply::Reply;
pub use rules::{GroupRule, OffsetRule};
pub use service::{AdsService, Task};
pub use table::{Effect, FunctionSpec};
pub use typed::Operation;
