//! The byte streams with which an ISG/TwinCAT CNC is read and written over ADS.
//!
//! A stream has two readings: `XRef` borrows from the bytes and never allocates; `X`, with the
//! feature `alloc`, owns what it read. Both accept the same bytes, refuse the others with the same
//! [`Error`], and encode to the bytes they were read from. Where all is numbers, one type is both.
//!
//! | manual (`ads-en` 1.05, `ads-de` 1.051) | here |
//! |---|---|
//! | 1, code page | [`CncStr`], [`text`] |
//! | 1, tasks and their ports | [`operation::Task`], [`ads::AmsPort`] |
//! | 1, axes and spindles, base addresses | [`address`] |
//! | 1, list of static objects | as 2.1.1 and 2.2.2 |
//! | 2, index groups and offsets | [`address`] |
//! | 2.1, instances of the COM task | [`address::ComGroup`], [`operation::ObjectList`] |
//! | 2.1.1, object descriptors | [`ObjectCount`], [`DescriptorRef`], [`DescriptorsRef`] |
//! | 2.1.2, content | [`ContentRef`] |
//! | 2.2.1, classes and attributes | [`address`], [`sda`] |
//! | 2.2.2, instances and elements | [`sda`] |
//! | 3, 3.1 … 3.4, dynamic parameters | [`dynamic`] |
//! | 4, 4.1, kinds of variables, by edition and version | [`Kind`] |
//! | 4.1, names of variables | [`VariablePath`] |
//! | 4.2.1, 4.2.2, the interfaces of channel and axis | [`operation::Function`], [`address::ChannelAxis`] |
//! | 4.2.1, 0x4C, reserved and documented online | [`VariableNameRef`], [`DescriptionByNameRef`] |
//! | 4.3, streams | [`layout`], [`Decode`], [`Encode`] |
//! | 4.3.1, number of variables | [`VariableKindRef`], [`VariableCount`] |
//! | 4.3.2, description | [`VariableIndexKindRef`], [`DescriptionRef`] |
//! | 4.3.3, handle by name | [`VariableNameRef`], [`Handle`] |
//! | 4.3.4, read by handle | [`HandleReadRef`], [`ValueRef`] |
//! | 4.3.5, read by name | [`VariableNameRef`], [`ValueRef`] |
//! | 4.3.6, write by handle | [`HandleWriteRef`] |
//! | 4.3.7, write by name | [`NameWriteRef`] |
//! | 4.3.4 … 4.3.7, values by their types | [`value`] |
//! | 4.3.8, extended description | [`VariableIndexKindRef`], [`ExtendedReply`] |
//! | 4.3.9, handle by name, of an axis | [`operation::AxisHandleByName`] |
//! | 4.3.10, read by name, of an axis | [`operation::AxisReadByName`] |
//! | 4.3.11, write by name, of an axis | [`operation::AxisWriteByName`] |
//! | 5, ADS services | [`ads`] |
//!
//! The sections have the same numbers in both. The other manuals:
//!
//! | manual | here |
//! |---|---|
//! | `stream-en` 2.1, 2.2, data streaming | [`streaming`] |
//! | 2.3.3, 2.3.4, 2.3.6, loops, comments, jumps | `streaming::Findings`, with `alloc` |
//! | 2.3.1, 2.3.2, 2.3.5, 2.3.7, flushing, subroutines, block search, contours | NC text like any other |
//! | 3, parameters and object | [`limits`], [`streaming::OBJECT_NAME`], [`streaming::ProgramStreamRef`] |
//! | 4.1, line ends | [`streaming::check_line_ends`] |
//! | 4.2, 5, transfer and example | [`streaming::Sender`], [`operation::WriteProgramStream`] |
//! | `service-en`, `service-de` 1.03: 1, required versions | [`service`] |
//! | 2, variables and process | [`service`] |
//! //!
//! [`operation`] puts them together: where a function is, what goes in, what comes out, for
//! clients and for servers. [`layout`] has the field table of every stream. Where the manuals are
//! at odds, [`errata`] says what is done here and how to do otherwise.
//!
//! # Features
//! - `alloc` (default): the owned readings, and the checks of an NC program.
//! - `binrw` (default): [`binrw`](https://docs.rs/binrw/0.15)'s `BinRead` and `BinWrite` for the owned
//!   readings, so that structs of your own can contain them. What `decode` rejects, `read` rejects; a
//!   stream that ends with its bytes is read to the end of the reader.
//! - `std`: `std` in the dependencies. The crate itself never needs it.
//! - `arbitrary`: `Arbitrary` for the owned readings.

//!
//! ```
//! # #[cfg(all(feature = "binrw", feature = "std"))] {
//! use ads_cnc::binrw::{self, BinRead, BinWrite, io::Cursor};
//! use ads_cnc::{Handle, HandleRead};
//!
//! /// A record of a log.
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

#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
// Bytes from outside reach every line here: nothing may panic on them.
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
pub mod service;
mod stream;
pub mod streaming;
pub mod text;
pub mod value;
mod variable;

#[cfg(feature = "binrw")]
pub use binrw;

#[cfg(feature = "arbitrary")]
mod any;
mod bytes;
mod declare;
#[cfg(feature = "binrw")]
mod io;
mod number;
mod rows;

#[cfg(feature = "alloc")]
pub use com::Descriptors;
pub use com::{Descriptor, DescriptorRef, DescriptorsRef, ObjectCount, WriteAccess};
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
    HandleReadRef, HandleWriteRef, Kind, NameWriteRef, Numbers, PathPart, PathParts,
    Synchronisation, Validity, ValueRef, VariableAccess, VariableCount, VariableIndexKindRef,
    VariableKindRef, VariableNameRef, VariablePath, VariableType,
};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
