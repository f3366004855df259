//! Applies a defect or valid variant to the bytes of requests and replies.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{Call, Service};

use super::Flaw;
use super::error::Fail;

/// A request before it is encoded.
pub(super) struct OutgoingRequest {
    pub(super) port: AmsPort,
    pub(super) service: Service,
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

    /// Whether it is the function of the decoder with this offset.
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

    pub(super) fn spoil(&mut self, flaw: Flaw) {
        self.accustom(flaw);
        let sda = self.port == AmsPort::SDA;
        let com_content = !sda && self.group & 0xF_0000 == 0x2_0000 && self.offset != 0x90;
        let descriptors = !sda && self.group & 0xF_0000 == 0x3_0000 && self.offset > 0;
        match flaw {
            Flaw::ReadShort if self.service == Service::Read && self.length == 4 => self.length = 2,
            Flaw::ReadForBoth if self.is(0x44) => {
                (self.service, self.data) = (Service::Read, Vec::new());
            }
            Flaw::Port if sda => self.port = AmsPort::COM,
            Flaw::NoChannel if sda => self.group &= !0xFF,
            Flaw::OtherChannel if self.group & 0xFF > 1 => self.group = (self.group & !0xFF) | 1,
            Flaw::ElementAccess if self.group & 0xF_0000 == 0x3_0000 => self.group ^= 0x1_0000,
            Flaw::ComGroup if com_content => self.group = (self.group & !0xFFF) | 0x201,
            Flaw::SpindleLogical if sda && self.group & 0xF000 == 0x5000 => self.group |= 0x10_0000,
            Flaw::AxisStride if self.is_attribute(0x300) && self.offset > 0xFFFF => {
                self.offset = (self.offset >> 4 & 0xF000) | self.offset & 0xFFF;
            }
            Flaw::Attribute | Flaw::ElementName if self.is_attribute(0x400) => {
                self.group =
                    (self.group & !0xF00) | if flaw == Flaw::Attribute { 0x700 } else { 0x500 };
            }
            Flaw::ElementType if self.is_attribute(0x500) => {
                self.group = (self.group & !0xF00) | 0x600;
            }
            Flaw::ElementLength if self.is_attribute(0x600) => {
                self.group = (self.group & !0xF00) | 0x700;
            }
            Flaw::ElementFlag if self.is_attribute(0x800) => {
                self.group = (self.group & !0xF00) | 0x700;
            }
            Flaw::CountAtOne if !sda && self.group & 0xF_0000 == 0x3_0000 && self.offset == 0 => {
                self.offset = 1;
            }
            Flaw::FromZero if descriptors => self.offset = self.offset.saturating_sub(1),
            Flaw::DescriptorLength if descriptors => {
                self.length = (self.length / 84).saturating_mul(80);
            }
            Flaw::ContentOffset if com_content => self.offset = self.offset.saturating_add(1),
            Flaw::SwappedQuery if self.group & 0xF00 == 0x900 && sda => self.data.rotate_left(4),
            Flaw::ElementZero if self.is_attribute(0x300) && self.length == 4 => {
                self.offset = self.offset.max(1);
            }
            Flaw::ParameterCount => self.moved(2, 3),
            Flaw::ParameterName => self.moved(0x1B, 0x1D),
            Flaw::ParameterValue => self.moved(0x1C, 0x1B),
            Flaw::ParameterIndex => self.moved(0x1D, 0x1C),
            Flaw::ParameterZero if (0x1B..=0x26).contains(&self.offset) && self.data.len() == 4 => {
                if let Some(index) = self.data.first_mut() {
                    *index = index.saturating_sub(1);
                }
            }
            Flaw::ParameterCut if [0x1C, 0x1F, 0x22, 0x25].contains(&self.offset) => {
                let at = self.data.len().saturating_sub(2);
                self.data.drain(at..at.saturating_add(1).min(self.data.len()));
            }
            Flaw::CountPlace => self.moved(0x44, 0x45),
            Flaw::DescribePlace => self.moved(0x45, 0x46),
            Flaw::HandlePlace => self.moved(0x46, 0x45),
            Flaw::ValuePlace => self.moved(0x48, 0x47),
            Flaw::ExtendedPlace => self.moved(0x4B, 0x4C),
            Flaw::AxisFromZero if self.is_attribute(0x300) && self.offset > 0xFFFF => {
                self.offset = self.offset.saturating_sub(0x1_0000);
            }
            Flaw::NoNul if self.is(0x46) || self.is(0x48) => drop(self.data.pop()),
            Flaw::KindOpen if self.is(0x44) => drop(self.data.pop()),
            Flaw::KindDot if self.is(0x44) => {
                let at = self.data.len().saturating_sub(1);
                self.data.insert(at, b'.');
            }
            Flaw::IndexSwapped if self.is(0x45) => {
                if let Some(index) = self.data.get_mut(..4) {
                    index.reverse();
                }
            }
            Flaw::Utf8 if self.is(0x46) || self.is(0x48) => {
                let text: String = self.data.iter().copied().map(char::from).collect();
                self.data = text.into_bytes();
            }
            Flaw::NoCount if self.is(0x47) && self.data.len() == 8 => self.data.truncate(4),
            Flaw::WriteNoCount if self.is(0x49) => {
                self.data.drain(4.min(self.data.len())..8.min(self.data.len()));
            }
            Flaw::NoSeparator if self.is(0x4A) => {
                if let Some(at) = self.data.iter().position(|&byte| byte == 0) {
                    self.data.remove(at);
                }
            }
            Flaw::ValueSwapped if com_content => self.data.reverse(),
            Flaw::StreamLong if !sda && self.offset == 0x90 => {
                // Turns the end of the last line into a comment.
                let at = self.data.len().saturating_sub(2);
                let filler = 1000_usize.saturating_sub(self.data.len());
                self.data.splice(at..at, std::iter::repeat_n(b' ', filler));
            }
            Flaw::StreamPlace if !sda && self.offset == 0x90 => self.offset = 0x91,
            _ => {}
        }
    }
}

impl OutgoingRequest {
    /// Applies a valid variant.
    fn accustom(&mut self, habit: Flaw) {
        let class = self.group & 0xF000;
        match habit {
            // Channel 6 has another rank.
            Flaw::ByIndex if self.group & 0xFF <= 2 => self.group &= !0x10_0000,
            Flaw::ByIndex if self.group & 0xFF == 6 => self.group = (self.group & !0x10_00FF) | 3,
            Flaw::Geo if self.port == AmsPort::SDA && class != 0x2000 => self.port = AmsPort::GEO,
            Flaw::PaddedNames if self.is(0x46) || self.is(0x48) => self.data.resize(256, 0),
            _ => {}
        }
    }
}

/// Applies a defect to an encoded frame.
pub(super) fn spoil_frame(flaw: Flaw, bytes: &mut Vec<u8>) {
    let command = bytes.get(22).copied();
    let mut add = |at: usize, change: i8| {
        if let Some(byte) = bytes.get_mut(at) {
            *byte = byte.wrapping_add_signed(change);
        }
    };
    match (flaw, command) {
        (Flaw::TcpLength, _) => {
            add(2, 1);
            bytes.push(0);
        }
        (Flaw::AmsLength, _) => add(26, -1),
        (Flaw::ResponseFlag, _) => add(24, 1),
        (Flaw::ErrorSet, _) => add(30, 1),
        (Flaw::OtherNetId, _) => add(11, 1),
        (Flaw::ReadTrailing, Some(2)) => {
            add(2, 4);
            add(26, 4);
            bytes.extend([0; 4]);
        }
        (Flaw::WriteLength, Some(3)) => add(46, 1),
        (Flaw::BothLength, Some(9)) => add(50, -1),
        _ => {}
    }
}

/// Skips a check of a reply by correcting the field that it would check.
pub(super) fn believe(flaw: Flaw, received: &mut [u8]) -> Result<(), Fail> {
    let word = |received: &[u8], at: usize| {
        let bytes = received.get(at..at.checked_add(4)?)?;
        Some(u32::from_le_bytes(bytes.try_into().ok()?))
    };
    let put = |received: &mut [u8], at: usize, number: u32| {
        if let Some(field) = received.get_mut(at..at.saturating_add(4)) {
            field.copy_from_slice(&number.to_le_bytes());
        }
    };
    let Some(length) = word(received, 2) else { return Ok(()) };
    let command = received.get(22).copied().unwrap_or_default();
    let data = length.saturating_sub(40);
    match flaw {
        Flaw::AmsLengthLie => put(received, 26, length.saturating_sub(32)),
        Flaw::DataLengthLie if command == 9 => put(received, 42, data),
        Flaw::ReadLengthLie if command == 2 => put(received, 42, data),
        Flaw::Dies if command == 9 && word(received, 42) == Some(u32::MAX) => {
            return Err(Fail::Dies);
        }
        _ => {}
    }
    Ok(())
}

/// Interprets reply data of a wrong length or type.
pub(super) fn misread(flaw: Flaw, asked: &OutgoingRequest, reply: &mut Vec<u8>) {
    match flaw {
        Flaw::FillsUp if asked.is(0x44) => reply.resize(4, 0),
        Flaw::FillsUpHandle if asked.is(0x46) => reply.resize(4, 0),
        Flaw::FillsUpValue if asked.is(0x48) => reply.resize(20, 0),
        Flaw::FillsUpParameter if asked.is(0x1C) => reply.resize(8, 0),
        Flaw::CutsOff if asked.offset == 0 => reply.truncate(4),
        Flaw::TornList if asked.group & 0xF_0000 == 0x3_0000 && asked.offset > 0 => {
            reply.resize(reply.len().div_ceil(84).saturating_mul(84), 0);
        }
        Flaw::Dimensions if asked.is(0x45) => {
            if let Some(count) = reply.get_mut(16..20).filter(|count| **count == [0xFF; 4]) {
                count.fill(0);
            }
        }
        _ => {}
    }
}
