//! Dynamic parameters, which can be created and deleted while the CNC runs: P, V.L, V.P and V.S
//! (DYN-1 … DYN-7).
//!
//! The number and the indices of the parameters can change, so the manual recommends reading a
//! value by the name of its parameter.
//!
//! ```
//! use ads_cnc::address::Channel;
//! use ads_cnc::dynamic::DynamicKind;
//! use ads_cnc::operation::{
//!     CountDynamic, DynamicNameByIndex, DynamicValueByName, Operation,
//! };
//!
//! let channel = Channel::new(1)?;
//! let count = CountDynamic::new(channel, DynamicKind::P);
//! assert_eq!((count.index_group().get(), count.index_offset().get()), (0x12_2301, 0x02));
//! assert_eq!(count.decode_reply(&[1, 0, 0, 0])?.0, 1);
//!
//! let name = DynamicNameByIndex::new(channel, DynamicKind::P, 1)?;
//! assert_eq!((name.index_offset().get(), name.encode(&mut [0; 4])?), (0x1B, &[1, 0, 0, 0][..]));
//! assert_eq!(name.decode_reply(b"P1\0")?.name.text(), "P1");
//!
//! let value = DynamicValueByName::new(channel, DynamicKind::P, "P1")?;
//! assert_eq!((value.index_offset().get(), value.encode(&mut [0; 8])?), (0x1C, &b"P1\0"[..]));
//! assert_eq!(value.decode_reply(&4711_f64.to_le_bytes())?.get(), 4711.0);
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! The AEP parameters of the GEO task are not supported: their layout is not documented (DYN-8).
//!
//! Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.

mod kind;
mod name;
mod number;

pub use kind::DynamicKind;
#[cfg(feature = "alloc")]
pub use name::{DynamicName, DynamicNameRequest};
pub use name::{DynamicNameRef, DynamicNameRequestRef};
pub use number::{DynamicCount, DynamicIndex, DynamicValue};
