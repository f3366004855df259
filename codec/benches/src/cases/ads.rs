//! The cases of the headers and services of ADS.

use ads_cnc::ads::*;
use ads_cnc::layout::Stream;
use ads_cnc::{Decode, Encode};

use super::stream::{Entry, stream};
use crate::hand::{self, HandWritten};

pub(super) const STREAMS: &[Entry] = &[
    stream!("AMS/TCP header", AmsTcpHeader, AmsTcpHeader, by hand hand::TcpHeader),
    stream!("AMS header", AmsHeader, AmsHeader, by hand hand::Header),
    stream!("read request", ReadRequest, ReadRequest, by hand hand::ReadRequest),
    stream!(
        "read reply", ReadReply, ReadReplyRef<'_>, by hand hand::Reply<&[u8]>,
        owned ReadReply, by hand hand::Reply<Vec<u8>>
    ),
    stream!(
        "write request", WriteRequest, WriteRequestRef<'_>, by hand hand::WriteRequest<&[u8]>,
        owned WriteRequest, by hand hand::WriteRequest<Vec<u8>>
    ),
    stream!("write reply", WriteReply, WriteReply, by hand hand::Number),
    stream!(
        "read-write request", ReadWriteRequest,
        ReadWriteRequestRef<'_>, by hand hand::ReadWriteRequest<&[u8]>,
        owned ReadWriteRequest, by hand hand::ReadWriteRequest<Vec<u8>>
    ),
    stream!(
        "read-write reply", ReadWriteReply, ReadWriteReplyRef<'_>, by hand hand::Reply<&[u8]>,
        owned ReadWriteReply, by hand hand::Reply<Vec<u8>>
    ),
    stream!("device info", DeviceInfoReply, DeviceInfoReply, by hand hand::DeviceInfo),
    stream!("device state", DeviceStateReply, DeviceStateReply, by hand hand::DeviceState),
];
