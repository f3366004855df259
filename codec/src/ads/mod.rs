//! ADS Read, Write, ReadWrite, ReadDeviceInfo and ReadState, the AMS headers, and frames on a TCP stream
//! (ADS-1 … ADS-9).
//!
//! To send an operation without an ADS library, put it into a frame:
//!
//! ```
//! use ads_cnc::address::Channel;
//! use ads_cnc::ads::{AmsAddr, AmsHeader, AmsNetId, AmsPort, FrameRef, ReadWriteReplyRef};
//! use ads_cnc::operation::{CountVariables, Operation};
//! use ads_cnc::{Decode, Encode, Kind};
//!
//! let op = CountVariables::new(Channel::new(1)?, Kind::V_E);
//!
//! // Encode the operation, then the request of its ADS service, then the frame.
//! let (mut data, mut service, mut frame) = ([0; 256], [0; 512], [0; 512]);
//! let call = op.call(&mut data)?;
//! let target = AmsAddr { net_id: AmsNetId([192, 0, 2, 7, 1, 1]), port: call.port };
//! let source = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8001) };
//! let header = AmsHeader::request(target, source, call.service.command(), 1);
//! let frame = FrameRef::new(header, call.encode(&mut service)?)?.encode(&mut frame)?;
//!
//! // Send `frame` to TCP port 48898 of the target, and receive until `split` returns a frame.
//! # let reply = ReadWriteReplyRef { result: 0.into(), data: Some(&[123, 0, 0, 0]) };
//! # let (mut data, mut received) = ([0; 12], [0; 64]);
//! # let header = AmsHeader { state_flags: ads_cnc::ads::StateFlags::RESPONSE, ..header };
//! # let received = FrameRef::new(header, reply.encode(&mut data)?)?.encode(&mut received)?;
//! let (reply, _) = FrameRef::split(received, 4096)?.ok_or("more bytes follow")?;
//! assert_eq!(reply.header().invoke_id, 1);
//! reply.header().error.into_result()?;
//!
//! // Decode the reply of the service, which may be an ADS error, then the reply of the operation.
//! let reply = ReadWriteReplyRef::decode(reply.data())?;
//! reply.result.into_result()?;
//! assert_eq!(op.decode_reply(reply.data.unwrap_or_default())?.0, 123);
//! # assert_eq!(frame.len(), FrameRef::HEADERS_LEN + 20);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The reply to a Read is a [`ReadReplyRef`], the reply to a Write is a [`WriteReply`]. In
//! `source`, use a NetId to which the target has a route, and any free port, for example above
//! 0x8000. The target sends its replies to that NetId and port. With several requests in flight,
//! match replies to requests by `invoke_id`.
//!
//! Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 1 (a port for each task) and 5 (Read,
//! Write, ReadWrite). The source of the headers, codes, ReadDeviceInfo and ReadState is the
//! vendors' public help pages.

mod address;
mod codes;
mod device;
mod frame;
mod header;
mod reply;
mod request;

pub use address::{AmsAddr, AmsNetId, AmsPort};
pub use codes::{AdsError, Command, StateFlags};
pub(crate) use device::InfoLayout;
pub use device::{AdsState, DeviceInfoReply, DeviceStateReply};
pub use frame::FrameRef;
pub(crate) use header::HeaderLayout;
pub use header::{AmsHeader, AmsTcpHeader};
#[cfg(feature = "alloc")]
pub use reply::{ReadReply, ReadWriteReply};
pub use reply::{ReadReplyRef, ReadWriteReplyRef, WriteReply};
pub use request::{ReadRequest, ReadWriteRequestRef, WriteRequestRef};
#[cfg(feature = "alloc")]
pub use request::{ReadWriteRequest, WriteRequest};
