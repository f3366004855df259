//! Finds the AMS frame in an EtherCAT frame.
//!
//! Beckhoff's ADS Monitor records in this form what the AMS router of a PC passes on. Each packet
//! has one AMS frame, and packets are recorded in the order in which the router saw them.

use ads_cnc::Decode as _;
use ads_cnc::ads::AmsHeader;
use ads_cnc::limits::AMS_HEADER_LEN;

/// The EtherType of EtherCAT.
pub(super) const ETHER_TYPE: u16 = 0x88A4;

/// The type of EtherCAT frames with AMS frames, in the upper four bits of their header.
const AMS_TYPE: u16 = 2;

/// An AMS frame as it was captured.
#[derive(Clone, Copy, Debug)]
pub(super) struct AmsFrame<'p> {
    pub(super) header: AmsHeader,
    /// The header and the data, as far as they were captured.
    pub(super) bytes: &'p [u8],
    /// Whether the frame ends before the end that its header gives.
    pub(super) is_cut: bool,
}

/// The content of an EtherCAT frame.
#[derive(Clone, Copy, Debug)]
pub(super) enum EtherCatContent<'p> {
    Ams(AmsFrame<'p>),
    /// Process data, or another type.
    Other,
    /// A header is cut or wrong.
    Unreadable,
}

impl<'p> EtherCatContent<'p> {
    /// Of what follows the EtherType.
    ///
    /// The length in the AMS header decides: that of the EtherCAT header has only 11 bits, and
    /// short Ethernet frames are padded.
    pub(super) fn of(payload: &'p [u8]) -> Self {
        let Some((header, bytes)) = payload.split_first_chunk() else { return Self::Unreadable };
        if u16::from_le_bytes(*header) >> 12 != AMS_TYPE {
            return Self::Other;
        }
        let header = bytes.get(..AMS_HEADER_LEN).map(AmsHeader::decode);
        let Some(Ok(header)) = header else { return Self::Unreadable };
        let length = usize::try_from(header.data_length).unwrap_or(usize::MAX);
        let length = length.saturating_add(AMS_HEADER_LEN);
        let whole = bytes.get(..length);
        Self::Ams(AmsFrame { header, bytes: whole.unwrap_or(bytes), is_cut: whole.is_none() })
    }
}
