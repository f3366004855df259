//! The functions of a CNC: where each is, what goes in, what comes out.
//!
//! A client builds an [`Operation`] and sends what it encodes over any transport:
//!
//! ```
//! use ads_cnc::address::Channel;
//! use ads_cnc::operation::{Operation, ReadByName};
//!
//! let op = ReadByName::new(Channel::new(1)?, "V.E.Testvar")?;
//! let mut buf = [0; 256];
//! assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_2301, 0x48));
//! assert_eq!(op.encode(&mut buf)?, b"V.E.Testvar\0");
//! // … ReadWrite, and then
//! assert_eq!(op.decode_reply(&[123, 0, 0, 0])?.bytes, [123, 0, 0, 0]);
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! A server hands what it received to [`Call::dispatch`] and answers the [`Request`] with a
//! [`Reply`]. What dispatch makes of an encoded operation encodes to the same bytes.

mod axis;
mod call;
mod com;
mod content;
mod dynamic;
mod element;
mod frame;
mod places;
mod program_stream;
mod reply;
mod request;
mod rules;
mod service;
mod sorts;
mod table;
mod variable;
mod write;

pub use axis::{AxisHandleByName, AxisReadByName, AxisWriteByName};
pub use call::{Call, Refusal};
pub use com::{CountObjects, ObjectList, ReadDescriptors};
pub use content::{ReadElement, ReadObject, WriteElement, WriteObject};
pub use dynamic::{CountDynamic, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName};
pub use element::{
    CountElements, FindInstance, ReadElementLength, ReadElementName, ReadElementType,
    ReadElementUnit, ReadElementWriteFlag,
};
pub use program_stream::WriteProgramStream;
pub use reply::Reply;
pub use request::{Operation, Request};
pub use rules::{GroupRule, OffsetRule};
pub use service::{Service, Task};
pub use table::{Effect, Function, FunctionSpec};
pub use variable::{
    CountVariables, DescribeByIndex, DescribeByName, DescribeExtended, HandleByName, ReadByHandle,
    ReadByName,
};
pub use write::{WriteByHandle, WriteByName};
