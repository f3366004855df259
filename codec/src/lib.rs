//! A codec for the byte streams that read and write an ISG/TwinCAT CNC over ADS, independent of the
//! transport.
//!
//! ```
//! # #[cfg(feature = "alloc")] mod example {
//! use ads_cnc::address::Channel;
//! use ads_cnc::ads::AmsPort;
//! use ads_cnc::operation::{AdsService, DescribeByName, Operation, ReadByName};
//! use ads_cnc::VariablePath;
//! use std::error::Error;
//!
//! /// Your transport: sends an ADS request to a port of the CNC and returns the data of the reply.
//! trait Transport {
//!     fn send(
//!         &mut self, port: AmsPort, service: AdsService, index_group: u32, index_offset: u32,
//!         read_length: u32, data: &[u8],
//!     ) -> Result<Vec<u8>, Box<dyn Error>>;
//!
//!     fn call<O: Operation>(&mut self, op: &O) -> Result<Vec<u8>, Box<dyn Error>> {
//!         let mut request = vec![0; op.encoded_len()];
//!         op.encode(&mut request)?;
//!         let (group, offset) = (op.index_group().get(), op.index_offset().get());
//!         self.send(op.port(), op.service(), group, offset, op.read_length(), &request)
//!     }
//! }
//!
//! /// Reads a number of any type from channel 1: a variable, or an element of an array.
//! fn read(cnc: &mut impl Transport, name: &str) -> Result<f64, Box<dyn Error>> {
//!     let channel = Channel::new(1)?;
//!     // An element `V.E.matrix[1][2]` has the description of its array, `V.E.matrix`.
//!     let describe = DescribeByName::new(channel, VariablePath::new(name)?.variable())?;
//!     let read = ReadByName::new(channel, name)?;
//!     let (description, value) = (cnc.call(&describe)?, cnc.call(&read)?);
//!     let description = describe.decode_reply(&description)?;
//!     let number = description.element(&read.decode_reply(&value)?)?.try_into()?;
//!     Ok(number)
//! }
//! # struct Cnc;
//! # impl Transport for Cnc {
//! #     fn send(&mut self, port: AmsPort, _: AdsService, group: u32, offset: u32, _: u32, data: &[u8])
//! #         -> Result<Vec<u8>, Box<dyn Error>> {
//! #         assert_eq!((port, group), (AmsPort::SDA, 0x12_2301));
//! #         match (offset, data) {
//! #             (0x48, b"V.E.speed\0" | b"V.E.matrix[1][2]\0") => Ok(1234.5_f64.to_le_bytes().into()),
//! #             (0x4C, b"V.E.speed\0") =>
//! #                 Ok(b"\x02\0\0\x02\x08\0\0\0\x01\0\0\0\x08\0\0\0\0\0\0\0".into()),
//! #             (0x4C, b"V.E.matrix\0") => Ok(b"\x02\0\0\x02\x08\0\0\0\x01\0\0\0\x30\0\0\0\
//! #                 \x02\0\0\0\x02\0\0\0\x03\0\0\0".into()),
//! #             _ => Err("no such name".into()),
//! #         }
//! #     }
//! # }
//! # pub fn main() {
//! #     for name in ["V.E.speed", "V.E.matrix[1][2]"] {
//! #         assert_eq!(read(&mut Cnc, name).unwrap(), 1234.5);
//! #     }
//! # }
//! # }
//! # #[cfg(feature = "alloc")]
//! # example::main();
//! ```
//!
//! # Client
//! [`operation`] has a type for each supported function of the CNC, for example
//! [`ReadByName`](operation::ReadByName). A value of such a type returns the address of the
//! request, encodes the request and decodes the reply. [`address`] contains the channels, axes and
//! spindles that operations refer to. [`AdsError::into_result`](ads::AdsError::into_result) turns
//! an ADS error number other than 0 into a Rust error.
//!
//! # Server
//! [`Call::dispatch`](operation::Call::dispatch) converts a received call to a
//! [`Request`](operation::Request). To answer the request, encode a [`Reply`](operation::Reply).
//!
//! # Values
//! [`value`] decodes and encodes the values of variables and the content of objects and elements,
//! by their types. To decode the value of a variable, use [`ValueRef::iter`] if your program knows
//! the type, [`DescriptionRef::elements`] if only the CNC knows it. [`VariablePath`] parses names
//! of variables, [`text`] converts code page 1252.
//!
//! # Frames
//! [`ads`] contains the AMS headers and the ADS services Read, Write, ReadWrite, ReadDeviceInfo and
//! ReadState, for programs without an ADS library.
//!
//! # Streaming
//! [`streaming`] checks an NC program, splits it into packets, and returns them one by one, to be
//! written to the CNC.
//!
//! # Services
//! [`service`] implements the application's side of the Service Interface, with which NC programs call
//! services outside the CNC.
//!
//! # Streams
//! Many streams have two types: `XRef`, such as [`DescriptionRef`], borrows from the bytes and
//! never allocates; `X`, such as `Description` with the feature `alloc`, owns its data. Both types
//! accept the same bytes, reject all others with the same [`Error`], and encode to the bytes that
//! they were decoded from. Some streams have a single type, such as [`Handle`]. [`sections`]
//! maps the sections of the manuals to this crate; [`layout`] contains the field table of every
//! stream. [`errata`] lists contradictions in the manuals, and the readings that this crate
//! implements.
//!
//! # Examples
//! The folder `examples` of the package has four programs. They use the published client
//! [`ads`](https://docs.rs/ads/0.4) as the transport:
//!
//! - `read_variable` reads a variable of any type by its name.
//! - `list_objects` lists objects of the COM task and elements of the classes.
//! - `stream_program` sends an NC program to a channel.
//! - `square_root_service` is a host of the Service Interface.
//!
//! # Common mistakes
//! - Decode the bytes that were received, not the whole buffer: a reply may be shorter than the read
//!   length, and some ADS libraries do not return the number of received bytes.
//! - Send each request to [`Operation::port`](operation::Operation::port): a CNC has one AMS port for
//!   each task.
//! - Check the [`Effect`](operation::Effect) of a function before you offer it: some functions
//!   change a value, and some may move an axis.
//!
//! # Debugging
//! The command `ads-cnc` of the package `ads-cnc-conformance` shows bytes field by field (`explain`),
//! serves a simulated CNC (`serve`), judges captured traffic (`check`) and prints a dissector for
//! Wireshark (`wireshark`). With [`layout`], a program of your own can show bytes field by field.
//!
//! # Limits
//! Of the functions of a CNC, the crate covers those in [`operation`]; of ADS, the services in
//! [`ads`]: no notifications, sum commands, PLC symbols, routing or encryption.
//! [`value::Shape::encode`] checks a value against a type and a size; the crate checks no value
//! against a machine. The bytes follow the manuals, the vendors' public help pages and assumptions,
//! which are marked as assumed; nothing was tried on a real machine.
//!
//! # IDs
//! IDs such as ADR-1, GEN-6 or VAR-9 identify requirements. The crate `ads-cnc-vectors` contains
//! their texts, with their sources. IDs such as E-17 identify errata: see [`errata`].
//! IDs such as `ads-en` identify manuals: see [`sections`].
//!
//! # Features
//! - `alloc` (default): the types that need memory of their own, such as `Description`, functions
//!   that return a vector or string, and the diagnostics of an NC program.
//! - `binrw` (default): [`binrw`](https://docs.rs/binrw/0.15)'s `BinRead` and `BinWrite` for the
//!   types of the streams that own their data, so your own structs can contain them. `read` accepts
//!   the same streams as `decode`, and leaves the bytes after a stream in the reader. A stream that
//!   ends in text of variable length, in data without a length or in records without a count
//!   extends to the end of the reader.
//! - `std`: enables `alloc`, and the feature `std` of the dependencies that have one. Only the
//!   feature `arbitrary` requires it.
//! - `arbitrary`: `Arbitrary` for the types of the streams that own their data.
//! - `serde`: [`serde`](https://docs.rs/serde/1)'s `Serialize` and `Deserialize` for the types of
//!   the streams that own their data.
//!
//! [`NoData`] implements none of the traits of these features.
//!
//! An example of the feature `binrw`:
//!
//! ```
//! # #[cfg(all(feature = "binrw", feature = "std"))] {
//! use ads_cnc::binrw::{self, BinRead, BinWrite, io::Cursor};
//! use ads_cnc::{Handle, HandleRead};
//!
//! /// A record of your log.
//! #[derive(BinRead, BinWrite)]
//! #[brw(little)]
//! struct Record {
//!     time: u64,
//!     read: HandleRead,
//!     result: u32,
//! }
//!
//! let read = HandleRead { handle: Handle(0x20012341), indices: vec![4] };
//! let mut log = Cursor::new(Vec::new());
//! Record { time: 7, read: read.clone(), result: 0 }.write(&mut log)?;
//! let record = Record::read(&mut Cursor::new(log.into_inner()))?;
//! assert_eq!(record.read, read);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Serialised form
//! With `serde`, a value is a map of the fields in [`layout`], without counts; `Descriptors` are a
//! list of such maps. A type with a single unnamed number, such as [`Handle`], is that number. An
//! [`ElementLength`](sda::ElementLength) is a map from the name of its type to the number. A
//! [`DynamicValue`](dynamic::DynamicValue) is a number, or a map of its `bits` if it is not finite.
//! An empty [`ExtendedReply`] is null. Codes are numbers, a NetId is a string.
//!
//! A text that ends in one NUL is a string, and so is a text in a field of fixed length if only
//! NULs follow it. Any other text is a map of `text` and `tail`: the bytes after the NUL, or null
//! without a NUL. To deserialise most texts and dynamic values, the format must be self-describing,
//! such as JSON (for exact REAL64, enable `float_roundtrip` of `serde_json`). The maximum lengths
//! and counts of a stream are checked when the value is encoded; only the length of a text in a
//! field of fixed length is checked when it is deserialised.

#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]
#![deny(missing_docs, missing_debug_implementations)]
// This crate processes input from outside, which must not cause a panic.
#![cfg_attr(
    not(test),
    deny(
        clippy::arithmetic_side_effects,
        clippy::as_conversions,
        clippy::expect_used,
        clippy::indexing_slicing,
        clippy::panic,
        clippy::string_slice,
        clippy::unreachable,
        clippy::unwrap_used
    )
)]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

pub mod address;
pub mod ads;
mod com;
mod content;
pub mod dynamic;
#[doc = include_str!("errata.md")]
pub mod errata {}
mod error;
pub mod layout;
pub mod limits;
pub mod operation;
pub mod sda;
pub mod sections;
pub mod service;
mod stream;
pub mod streaming;
mod streams;
pub mod text;
pub mod value;
mod variable;

#[cfg(feature = "binrw")]
pub use binrw;

#[cfg(feature = "arbitrary")]
mod arbitrary;
mod bytes;
mod declare;
#[cfg(feature = "binrw")]
mod io;
mod number;
mod rows;
#[cfg(feature = "serde")]
mod serial;

#[cfg(feature = "alloc")]
pub use com::Descriptors;
pub use com::{
    Descriptor, DescriptorIter, DescriptorRef, DescriptorsRef, ObjectCount, WriteAccess,
};
#[cfg(feature = "alloc")]
pub use content::Content;
pub use content::ContentRef;
pub use error::{Error, ErrorKind};
pub use stream::{Decode, Encode, NoData};
pub use text::{CncStr, TextRef};
#[cfg(feature = "alloc")]
pub use text::{CncString, Text};
pub use value::{Element, Elements};
#[cfg(feature = "alloc")]
pub use variable::{
    Description, DescriptionByName, HandleRead, HandleWrite, NameWrite, Value, VariableIndexKind,
    VariableKind, VariableName,
};
pub use variable::{
    DescriptionByNameRef, DescriptionRef, ExtendedDescription, ExtendedReply, Handle,
    HandleReadRef, HandleWriteRef, Kind, NameWriteRef, PathPart, PathParts, Synchronisation,
    U32Iter, U32List, Validity, ValueRef, VariableAccess, VariableCount, VariableIndexKindRef,
    VariableKindRef, VariableNameRef, VariablePath, VariableType,
};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
