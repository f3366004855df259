//! Reads packets from a pcap or pcapng file, one at a time.

use std::io::Read;

use pcap_parser::pcapng::{Block, OptionCode};
use pcap_parser::traits::PcapNGPacketBlock as _;
use pcap_parser::{Linktype, PcapBlockOwned, PcapError, create_reader};

use super::time::Time;
use super::writer::SUITE;
use crate::number::{to_usize, u32_at};
use crate::text::plural;

/// Initial size of the read buffer in bytes.
const BUFFER: usize = 0x1_0000;

/// A record or block of a pcap or pcapng file must be shorter than this number of bytes. The
/// captured part of a NetMon packet must not be longer. Otherwise, reading ends there.
pub const RECORD_MAX: usize = 0x80_0000;

/// Maximum number of interfaces of a pcapng section; further ones are ignored.
const INTERFACES_MAX: usize = 4096;

/// A captured packet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packet<'p> {
    /// The number of the packet, counted from 1 as in Wireshark.
    pub(super) number: u64,
    pub(super) time: Option<Time>,
    pub(super) link: Linktype,
    pub(super) bytes: &'p [u8],
    /// Number of bytes that were not captured.
    pub(super) missing: usize,
    /// Whether the suite sent the requests, according to the comment that `ads-cnc run` writes to
    /// its captures.
    pub(super) is_of_suite: bool,
}

/// The way in which a file ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileEnd {
    /// The file ended after a complete record.
    Whole,
    /// Reading ended early, for example inside a record or before bytes that are not a record. The
    /// text states the reason.
    Cut(String),
}

/// The reason why a file cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// An error of the system.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// The file has an unsupported format.
    #[error("neither pcap nor pcapng nor NetMon 2.x")]
    Format,
    /// The file has an unsupported version of the NetMon format: major and minor.
    #[error("NetMon {0}.{1} instead of 2.x; convert it with editcap -F pcapng")]
    NetMonVersion(u8, u8),
    #[error("the file is empty")]
    Empty,
}

/// The link type of an interface, and the resolution and offset (in seconds) of its times.
struct CaptureInterface {
    link: Linktype,
    /// Units of time per second.
    resolution: u64,
    offset: i64,
}

#[derive(Default)]
struct Interfaces {
    /// The interfaces of the current pcapng section, or the only interface of a pcap file.
    all: Vec<CaptureInterface>,
    packets: u64,
    is_of_suite: bool,
    /// Whether the numbers of the current pcapng section begin with their upper byte.
    big_endian: bool,
}

/// Length of the pcapng block at the beginning of the data; `None` for the header of a section,
/// which may have another byte order than the section before it.
fn block_length(data: &[u8], big_endian: bool) -> Option<u32> {
    let number =
        |at| u32_at(data, at).map(|number| if big_endian { number.swap_bytes() } else { number });
    number(4).filter(|_| !data.starts_with(SECTION_HEADER))
}

const SECTION_HEADER: &[u8] = b"\n\r\r\n";

/// Units of time per second, from the option `if_tsresol`: the negative exponent of 10 or, with the
/// upper bit, of 2. Microseconds if it is too large.
fn resolution(code: u8) -> u64 {
    let power = match code {
        0..0x80 => 10_u64.checked_pow(code.into()),
        _ => 1_u64.checked_shl(u32::from(code & 0x7F)),
    };
    power.unwrap_or(1_000_000)
}

/// Calls a function for each packet of a pcap or pcapng file.
pub(super) fn packets(
    input: impl Read + Send,
    mut each: impl FnMut(Packet<'_>),
) -> Result<FileEnd, FileError> {
    let mut reader = create_reader(BUFFER, FullReader(input)).map_err(|error| match error {
        PcapError::Eof => FileError::Empty,
        PcapError::ReadError => FileError::Io(std::io::Error::other("read error")),
        _ => FileError::Format,
    })?;
    let is_pcapng = reader.data().starts_with(SECTION_HEADER);
    let mut interfaces = Interfaces::default();
    let mut capacity = BUFFER;
    loop {
        let length = block_length(reader.data(), interfaces.big_endian).filter(|_| is_pcapng);
        // For a block of process information, pcap-parser 0.17 subtracts 12 without a check.
        if length.is_some_and(|length| length < 12) {
            return Ok(interfaces.cut("bytes that are not a record"));
        }
        let is_whole = length.is_some_and(|length| to_usize(length) <= reader.data().len());
        let more = match reader.next() {
            Ok((length, block)) => {
                interfaces.read(block, &mut each);
                reader.consume(length);
                continue;
            }
            Err(PcapError::Eof) => return Ok(FileEnd::Whole),
            // The fields of the block need more bytes than the block has.
            Err(
                PcapError::Incomplete(_) | PcapError::BufferTooSmall | PcapError::UnexpectedEof,
            ) if is_whole => {
                return Ok(interfaces.cut("bytes that are not a record"));
            }
            Err(PcapError::Incomplete(_)) => false,
            Err(PcapError::BufferTooSmall) => true,
            Err(PcapError::UnexpectedEof) => {
                let left = plural(reader.data().len(), "byte");
                return Ok(FileEnd::Cut(format!("it ends inside a record, {left} into it")));
            }
            Err(error) => {
                let what = match error {
                    PcapError::ReadError => "read error",
                    _ => "bytes that are not a record",
                };
                return Ok(interfaces.cut(what));
            }
        };
        if more {
            if capacity >= RECORD_MAX {
                let number = interfaces.packets.saturating_add(1);
                let what = format!("record {number} is longer than {RECORD_MAX} bytes");
                return Ok(FileEnd::Cut(what));
            }
            capacity = capacity.saturating_mul(2);
            reader.grow(capacity);
        }
        let before = reader.data().len();
        let failed = reader.refill().is_err();
        if failed || (reader.data().len() == before && !reader.reader_exhausted()) {
            return Ok(FileEnd::Cut("read error".to_owned()));
        }
    }
}

/// A reader that fills the whole buffer unless the file ends: `create_reader` looks for the header
/// of the file in its first read only, and `netmon` takes a short read as the end of the file.
pub(super) struct FullReader<R>(pub(super) R);

impl<R: Read> Read for FullReader<R> {
    fn read(&mut self, buf: &mut [u8]) -> std::io::Result<usize> {
        let mut filled = 0_usize;
        while let Some(room) = buf.get_mut(filled..).filter(|room| !room.is_empty()) {
            match self.0.read(room) {
                Ok(0) => break,
                Ok(read) => filled = filled.saturating_add(read),
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(filled)
    }
}

impl Interfaces {
    /// The end of a file that cannot be read after the last packet.
    fn cut(&self, what: &str) -> FileEnd {
        FileEnd::Cut(format!("{what}, after packet {}", self.packets))
    }

    fn read(&mut self, block: PcapBlockOwned<'_>, each: &mut impl FnMut(Packet<'_>)) {
        match block {
            PcapBlockOwned::LegacyHeader(header) => {
                let nanoseconds = header.is_nanosecond_precision();
                let resolution = if nanoseconds { 1_000_000_000 } else { 1_000_000 };
                // The upper 16 bits contain information about frame check sequences.
                let link = Linktype(header.network.0 & 0xFFFF);
                self.all = vec![CaptureInterface { link, resolution, offset: 0 }];
            }
            PcapBlockOwned::Legacy(block) => {
                let Some(interface) = self.all.first() else { return };
                let time = Time::new(block.ts_sec.into(), block.ts_usec, interface.resolution);
                let captured = to_usize(block.caplen);
                let bytes = block.data.get(..captured).unwrap_or(block.data);
                self.packet(0, Some(time), bytes, block.origlen, each);
            }
            PcapBlockOwned::NG(block) => self.block(&block, each),
        }
    }

    fn block(&mut self, block: &Block<'_>, each: &mut impl FnMut(Packet<'_>)) {
        match block {
            Block::SectionHeader(header) => {
                self.all.clear();
                self.big_endian = header.big_endian();
                let mut options = header.options.iter();
                self.is_of_suite = options.any(|option| {
                    option.code == OptionCode::Comment && option.as_bytes() == Ok(SUITE.as_bytes())
                });
            }
            Block::InterfaceDescription(interface) if self.all.len() < INTERFACES_MAX => {
                // pcap-parser 0.17 knows no powers of 2, and always reads the offset from its lower
                // byte on.
                let offset = interface.ts_offset();
                self.all.push(CaptureInterface {
                    link: interface.linktype,
                    resolution: resolution(interface.if_tsresol),
                    offset: if self.big_endian { offset.swap_bytes() } else { offset },
                });
            }
            Block::EnhancedPacket(packet) => {
                let place = to_usize(packet.if_id);
                let units = (u64::from(packet.ts_high) << 32) | u64::from(packet.ts_low);
                let time = self
                    .all
                    .get(place)
                    .map(|interface| Time::of_units(units, interface.resolution, interface.offset));
                let captured = to_usize(packet.caplen);
                let bytes = packet.data.get(..captured).unwrap_or(packet.data);
                self.packet(place, time, bytes, packet.origlen, each);
            }
            Block::SimplePacket(packet) => {
                self.packet(0, None, packet.packet_data(), packet.origlen, each);
            }
            _ => {}
        }
    }

    fn packet(
        &mut self,
        interface: usize,
        time: Option<Time>,
        bytes: &[u8],
        original: u32,
        each: &mut impl FnMut(Packet<'_>),
    ) {
        self.packets = self.packets.saturating_add(1);
        // A packet whose interface has no description is only counted: -1 is not a link type.
        let link = self.all.get(interface).map_or(Linktype(-1), |interface| interface.link);
        let original = to_usize(original);
        let missing = original.saturating_sub(bytes.len());
        each(Packet {
            number: self.packets,
            time,
            link,
            bytes,
            missing,
            is_of_suite: self.is_of_suite,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The time of a packet, 3 × 2^20 units after 1970, in a pcapng file with these options of the
    /// interface: the resolution, and an offset of 100 seconds.
    fn time_of_packet(resolution: u8, little: bool) -> std::time::Duration {
        let four = |one: u32| if little { one.to_le_bytes() } else { one.to_be_bytes() };
        let two = |one: u16| if little { one.to_le_bytes() } else { one.to_be_bytes() };
        let eight = |one: u64| if little { one.to_le_bytes() } else { one.to_be_bytes() };
        let mut file = Vec::new();
        let mut block = |kind: u32, content: &[u8]| {
            let length = four(u32::try_from(content.len() + 12).unwrap());
            file.extend([&four(kind), &length, content, &length].concat());
        };
        block(0x0A0D_0D0A, &[&four(0x1A2B_3C4D)[..], &two(1), &two(0), &[0xFF; 8]].concat());
        let resolution = [&two(9)[..], &two(1), &[resolution, 0, 0, 0]].concat();
        let offset = [&two(14)[..], &two(8), &eight(100)].concat();
        block(1, &[&two(101)[..], &[0; 6], &resolution, &offset, &[0; 4]].concat());
        block(6, &[[0; 4], [0; 4], four(3 << 20), [0; 4], [0; 4]].concat());
        let mut time = None;
        let end = packets(&file[..], |packet| time = packet.time);
        assert_eq!(end.unwrap(), FileEnd::Whole);
        time.unwrap().since_1970()
    }

    #[test]
    fn times_have_the_resolution_and_offset_of_the_interface() {
        for little in [true, false] {
            for (resolution, nanoseconds) in [
                (0x94, 3_000_000_000),
                (0x80, (3 << 20) * 1_000_000_000),
                (0, (3 << 20) * 1_000_000_000),
                (9, 3 << 20),
                (20, (3 << 20) * 1000),
                (0xC0, (3 << 20) * 1000),
            ] {
                let expected = std::time::Duration::from_nanos(nanoseconds + 100_000_000_000);
                assert_eq!(time_of_packet(resolution, little), expected, "{resolution:#x}");
            }
        }
    }
}
