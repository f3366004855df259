//! ADS Read, Write and ReadWrite, what a device says of itself, the AMS headers around them, and frames on a TCP stream.

mod address;
mod device;
mod frame;
mod header;
mod service;

pub use address::{AmsAddr, AmsNetId, AmsPort};
pub use device::{AdsState, DeviceInfoReply, DeviceStateReply};
pub use frame::FrameRef;
pub use header::{AdsError, AmsHeader, AmsTcpHeader, Command, StateFlags};
#[cfg(feature = "alloc")]
pub use service::{ReadReply, ReadWriteReply, ReadWriteRequest, WriteRequest};
pub use service::{
    ReadReplyRef, ReadRequest, ReadWriteReplyRef, ReadWriteRequestRef, WriteReply, WriteRequestRef,
};
