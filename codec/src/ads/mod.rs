//! ADS Read, Write, ReadWrite, ReadDeviceInfo and ReadState, the AMS headers, and frames on a TCP stream
//! (ADS-1 … ADS-9).
//!
//! ```
//! use ads_cnc::Encode;
//! use ads_cnc::address::{IndexGroup, IndexOffset};
//! use ads_cnc::ads::{AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef, ReadRequest};
//!
//! let cnc = AmsAddr { net_id: AmsNetId([192, 0, 2, 7, 1, 1]), port: AmsPort::COM };
//! let client = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8001) };
//! let (index_group, index_offset) = (IndexGroup::new(0x13_0101), IndexOffset::new(0));
//! let mut data = [0; 12];
//! let read = ReadRequest { index_group, index_offset, length: 4 }.encode(&mut data)?;
//!
//! let header = AmsHeader::request(cnc, client, Command::READ, 1);
//! let mut buf = [0; 64];
//! let frame = FrameRef::new(header, read)?.encode(&mut buf)?;
//! assert_eq!(frame.len(), FrameRef::HEADERS_LEN + 12);
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 1 (ports) and 5 (Read, Write, ReadWrite). The
//! source of everything else is the vendors' public help pages.

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
