//! Applies a defect or a valid variant to the bytes of requests and replies.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{AdsService, Call};

use super::ClientFault;
use super::error::ActionError;
use crate::number::u32_at;

/// A request before it is encoded.
pub(super) struct OutgoingRequest {
    pub(super) port: AmsPort,
    pub(super) service: AdsService,
    pub(super) group: u32,
    pub(super) offset: u32,
    pub(super) length: u32,
    pub(super) data: Vec<u8>,
}

impl OutgoingRequest {
    pub(super) fn call(&self) -> Call<'_> {
        Call {
            port: self.port,
            service: self.service,
            index_group: IndexGroup::new(self.group),
            index_offset: IndexOffset::new(self.offset),
            read_length: self.length,
            data: &self.data,
        }
    }

    /// Whether the request addresses the contents of the decoder of a channel at this index offset.
    const fn is(&self, offset: u32) -> bool {
        self.group & 0xFF00 == 0x2300 && self.offset == offset
    }

    fn is_attribute(&self, attribute: u32) -> bool {
        self.port == AmsPort::SDA && self.group & 0xF00 == attribute
    }

    fn moved(&mut self, from: u32, to: u32) {
        if self.is(from) {
            self.offset = to;
        }
    }

    pub(super) fn apply_fault(&mut self, fault: ClientFault) {
        self.apply_variant(fault);
        let sda = self.port == AmsPort::SDA;
        let com_content = !sda && self.group & 0xF_0000 == 0x2_0000 && self.offset != 0x90;
        let descriptors = !sda && self.group & 0xF_0000 == 0x3_0000 && self.offset > 0;
        match fault {
            ClientFault::ReadShort if self.service == AdsService::Read && self.length == 4 => {
                self.length = 2
            }
            ClientFault::ReadForBoth if self.is(0x44) => {
                (self.service, self.data) = (AdsService::Read, Vec::new());
            }
            ClientFault::Port if sda => self.port = AmsPort::COM,
            ClientFault::NoChannel if sda => self.group &= !0xFF,
            ClientFault::OtherChannel if self.group & 0xFF > 1 => {
                self.group = (self.group & !0xFF) | 1
            }
            ClientFault::ElementAccess if self.group & 0xF_0000 == 0x3_0000 => {
                self.group ^= 0x1_0000
            }
            ClientFault::ComGroup if com_content => self.group = (self.group & !0xFFF) | 0x201,
            ClientFault::SpindleLogical if sda && self.group & 0xF000 == 0x5000 => {
                self.group |= 0x10_0000
            }
            ClientFault::AxisStride if self.is_attribute(0x300) && self.offset > 0xFFFF => {
                self.offset = (self.offset >> 4 & 0xF000) | self.offset & 0xFFF;
            }
            ClientFault::Attribute | ClientFault::ElementName if self.is_attribute(0x400) => {
                self.group = (self.group & !0xF00)
                    | if fault == ClientFault::Attribute { 0x700 } else { 0x500 };
            }
            ClientFault::ElementType if self.is_attribute(0x500) => {
                self.group = (self.group & !0xF00) | 0x600;
            }
            ClientFault::ElementLength if self.is_attribute(0x600) => {
                self.group = (self.group & !0xF00) | 0x700;
            }
            ClientFault::ElementFlag if self.is_attribute(0x800) => {
                self.group = (self.group & !0xF00) | 0x700;
            }
            ClientFault::CountAtOne
                if !sda && self.group & 0xF_0000 == 0x3_0000 && self.offset == 0 =>
            {
                self.offset = 1;
            }
            ClientFault::FromZero if descriptors => self.offset = self.offset.saturating_sub(1),
            ClientFault::DescriptorLength if descriptors => {
                self.length = (self.length / 84).saturating_mul(80);
            }
            ClientFault::ContentOffset if com_content => {
                self.offset = self.offset.saturating_add(1)
            }
            ClientFault::SwappedQuery if self.group & 0xF00 == 0x900 && sda => {
                self.data.rotate_left(4)
            }
            ClientFault::ElementZero if self.is_attribute(0x300) && self.length == 4 => {
                self.offset = self.offset.max(1);
            }
            ClientFault::ParameterCount => self.moved(2, 3),
            ClientFault::ParameterName => self.moved(0x1B, 0x1D),
            ClientFault::ParameterValue => self.moved(0x1C, 0x1B),
            ClientFault::ParameterIndex => self.moved(0x1D, 0x1C),
            ClientFault::ParameterZero
                if (0x1B..=0x26).contains(&self.offset) && self.data.len() == 4 =>
            {
                if let Some(index) = self.data.first_mut() {
                    *index = index.saturating_sub(1);
                }
            }
            ClientFault::ParameterCut if [0x1C, 0x1F, 0x22, 0x25].contains(&self.offset) => {
                let at = self.data.len().saturating_sub(2);
                self.data.drain(at..at.saturating_add(1).min(self.data.len()));
            }
            ClientFault::CountPlace => self.moved(0x44, 0x45),
            ClientFault::DescribePlace => self.moved(0x45, 0x46),
            ClientFault::HandlePlace => self.moved(0x46, 0x45),
            ClientFault::ValuePlace => self.moved(0x48, 0x47),
            ClientFault::ExtendedPlace => self.moved(0x4B, 0x4C),
            ClientFault::AxisFromZero if self.is_attribute(0x300) && self.offset > 0xFFFF => {
                self.offset = self.offset.saturating_sub(0x1_0000);
            }
            ClientFault::NoNul if self.is(0x46) || self.is(0x48) => drop(self.data.pop()),
            ClientFault::KindOpen if self.is(0x44) => drop(self.data.pop()),
            ClientFault::KindDot if self.is(0x44) => {
                let at = self.data.len().saturating_sub(1);
                self.data.insert(at, b'.');
            }
            ClientFault::IndexSwapped if self.is(0x45) => {
                if let Some(index) = self.data.get_mut(..4) {
                    index.reverse();
                }
            }
            ClientFault::Utf8 if self.is(0x46) || self.is(0x48) => {
                let text: String = self.data.iter().copied().map(char::from).collect();
                self.data = text.into_bytes();
            }
            ClientFault::NoCount if self.is(0x47) && self.data.len() == 8 => self.data.truncate(4),
            ClientFault::WriteNoCount if self.is(0x49) => {
                self.data.drain(4.min(self.data.len())..8.min(self.data.len()));
            }
            ClientFault::NoSeparator if self.is(0x4A) => {
                if let Some(at) = self.data.iter().position(|&byte| byte == 0) {
                    self.data.remove(at);
                }
            }
            ClientFault::ValueSwapped if com_content => self.data.reverse(),
            ClientFault::StreamLong if !sda && self.offset == 0x90 => {
                // Inserts blanks before the last CR LF, so that the packet has 1000 bytes.
                let at = self.data.len().saturating_sub(2);
                let filler = 1000_usize.saturating_sub(self.data.len());
                self.data.splice(at..at, std::iter::repeat_n(b' ', filler));
            }
            ClientFault::StreamPlace if !sda && self.offset == 0x90 => self.offset = 0x91,
            _ => {}
        }
    }
}

impl OutgoingRequest {
    /// Applies a valid variant.
    fn apply_variant(&mut self, variant: ClientFault) {
        let class = self.group & 0xF000;
        match variant {
            // Channels 1 and 2 have their number as rank; channel 6 has rank 3.
            ClientFault::ByIndex if self.group & 0xFF <= 2 => self.group &= !0x10_0000,
            ClientFault::ByIndex if self.group & 0xFF == 6 => {
                self.group = (self.group & !0x10_00FF) | 3
            }
            ClientFault::Geo if self.port == AmsPort::SDA && class != 0x2000 => {
                self.port = AmsPort::GEO
            }
            ClientFault::PaddedNames if self.is(0x46) || self.is(0x48) => self.data.resize(256, 0),
            _ => {}
        }
    }
}

/// Applies a defect to the encoded frame of a request.
pub(super) fn apply_to_frame(fault: ClientFault, bytes: &mut Vec<u8>) {
    let command = bytes.get(22).copied();
    let mut add = |at: usize, change: i8| {
        if let Some(byte) = bytes.get_mut(at) {
            *byte = byte.wrapping_add_signed(change);
        }
    };
    match (fault, command) {
        (ClientFault::TcpLength, _) => {
            add(2, 1);
            bytes.push(0);
        }
        (ClientFault::AmsLength, _) => add(26, -1),
        (ClientFault::ResponseFlag, _) => add(24, 1),
        (ClientFault::ErrorSet, _) => add(30, 1),
        (ClientFault::OtherNetId, _) => add(11, 1),
        (ClientFault::ReadTrailing, Some(2)) => {
            add(2, 4);
            add(26, 4);
            bytes.extend([0; 4]);
        }
        (ClientFault::WriteLength, Some(3)) => add(46, 1),
        (ClientFault::BothLength, Some(9)) => add(50, -1),
        _ => {}
    }
}

/// Makes the client skip a check of a reply, by correcting the field of the reply that the check
/// reads; or makes the client crash on a length that is too large.
pub(super) fn skip_check(fault: ClientFault, received: &mut [u8]) -> Result<(), ActionError> {
    let put = |received: &mut [u8], at: usize, number: u32| {
        if let Some(field) = received.get_mut(at..at.saturating_add(4)) {
            field.copy_from_slice(&number.to_le_bytes());
        }
    };
    let Some(length) = u32_at(received, 2) else { return Ok(()) };
    let command = received.get(22).copied().unwrap_or_default();
    let data = length.saturating_sub(40);
    match fault {
        ClientFault::AmsLengthLie => put(received, 26, length.saturating_sub(32)),
        ClientFault::DataLengthLie if command == 9 => put(received, 42, data),
        ClientFault::ReadLengthLie if command == 2 => put(received, 42, data),
        ClientFault::Dies if command == 9 && u32_at(received, 42) == Some(u32::MAX) => {
            return Err(ActionError::Dies);
        }
        _ => {}
    }
    Ok(())
}

/// Makes the client accept reply data that is wrong, by changing the data before it is decoded.
pub(super) fn misread(fault: ClientFault, outgoing: &OutgoingRequest, reply: &mut Vec<u8>) {
    match fault {
        ClientFault::FillsUp if outgoing.is(0x44) => reply.resize(4, 0),
        ClientFault::FillsUpHandle if outgoing.is(0x46) => reply.resize(4, 0),
        ClientFault::FillsUpValue if outgoing.is(0x48) => reply.resize(20, 0),
        ClientFault::FillsUpParameter if outgoing.is(0x1C) => reply.resize(8, 0),
        ClientFault::CutsOff if outgoing.offset == 0 => reply.truncate(4),
        ClientFault::TornList if outgoing.group & 0xF_0000 == 0x3_0000 && outgoing.offset > 0 => {
            reply.resize(reply.len().div_ceil(84).saturating_mul(84), 0);
        }
        ClientFault::Dimensions if outgoing.is(0x45) => {
            if let Some(count) = reply.get_mut(16..20).filter(|count| **count == [0xFF; 4]) {
                count.fill(0);
            }
        }
        _ => {}
    }
}
