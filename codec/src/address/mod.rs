//! Index groups and index offsets, put together and taken apart (ADR-1 … ADR-13).
//!
//! An index group is a sum: `0x100000` for logical addressing, `0x020000` for the content of
//! elements or `0x030000` for the description of objects, a class in bits 12 … 15, a table in
//! bits 8 … 11, and a channel, platform axis or spindle in bits 0 … 7.

mod class;
mod element;
mod group;
mod offset;
mod place;

pub use class::{Attribute, Class, ClassGroup};
pub use element::ElementAddress;
pub use group::{Access, Addressing, ComGroup, ComTable, Group, IndexGroup};
pub use offset::{AxisStride, IndexOffset};
pub use place::{Channel, ChannelAxis, PlatformAxis, Spindle};
