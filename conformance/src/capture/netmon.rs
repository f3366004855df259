//! Reads packets from a NetMon 2.x file, the format of Beckhoff's ADS Monitor.
//!
//! All numbers are little-endian. The offsets in the file count from its beginning.
//!
//! | offset | file header |
//! |--:|---|
//! | 0 | `GMBU` |
//! | 4 | version: minor, major |
//! | 6 | link type of all packets, in versions before 2.1 |
//! | 8 | start time: year, month, day of the week, day, hour, minute, second, millisecond |
//! | 24 | frame table: offset, length |
//! | 32 | offset and length of each other table |
//! | 128 | the first packet |
//!
//! | offset | packet |
//! |--:|---|
//! | 0 | microseconds since the start time, 8 bytes |
//! | 8 | length of the packet |
//! | 12 | captured length |
//! | 16 | captured bytes |
//! | | since version 2.1: link type; since 2.2: process, 4 bytes; since 2.3: time in UTC and zone, 9 bytes |
//!
//! The frame table contains the offset of each packet. Because the input need not be seekable, the
//! packets are read in the order of the file and compared with the frame table at the end.

use std::io::Read;

use pcap_parser::Linktype;

use super::file::{FileEnd, FileError, FullReader, Packet, RECORD_MAX};
use super::time::Time;
use crate::number::{to_u32, to_usize, u32_at};
use crate::text::{Moment, plural};

pub(super) const MAGIC: [u8; 4] = *b"GMBU";

/// The magic number of NetMon 1.x; the version numbers follow as in 2.x.
pub(super) const MAGIC_1: [u8; 4] = *b"RTSS";

const HEADER_LEN: usize = 128;
const PACKET_HEADER_LEN: usize = 16;

/// Position in the file header of the offset and length of the frame table, which are followed by
/// those of five other tables.
const TABLES: usize = 24;
const TABLES_END: usize = 72;

/// Added to the number of an unsupported NetMon link type, so that the sum is not a link type of
/// pcap.
const NETMON_LINKS: i32 = 0x1_0000;

/// Number of microseconds per second.
const MICROSECONDS: u64 = 1_000_000;

/// Maximum number of bytes that are read at once up to the end of the frame table.
const TABLE_CHUNK: usize = 4096;

/// Calls a function for each packet of a file whose [`MAGIC`] was already read.
pub(super) fn packets(
    input: impl Read,
    mut each: impl FnMut(Packet<'_>),
) -> Result<FileEnd, FileError> {
    let mut input = Input { input: FullReader(input), offset: 4 };
    let Some(header) = input.header()? else {
        return Ok(FileEnd::Cut("it ends in the file header".to_owned()));
    };
    let mut offsets = Offsets::default();
    let mut bytes = Vec::new();
    while input.offset < header.packets_end {
        offsets.add(to_u32(input.offset));
        let number = offsets.count;
        match input.packet(&header, &mut bytes) {
            Err(why) => return Ok(FileEnd::Cut(format!("packet {number}: {why}"))),
            Ok((time, link, original)) => {
                let missing = original.saturating_sub(bytes.len());
                each(Packet { number, time, link, bytes: &bytes, missing, is_of_suite: false });
            }
        }
    }
    Ok(match input.frame_table(header.table) {
        None => FileEnd::Cut("it ends in the frame table".to_owned()),
        Some(listed) if listed == offsets => FileEnd::Whole,
        Some(listed) => FileEnd::Cut(format!(
            "the frame table lists {}, but {} consecutive ones were found; convert the \
             file with editcap -F pcapng",
            plural(listed.count, "packet"),
            offsets.count
        )),
    })
}

/// The number and the sum of the offsets of packets, to compare lists of offsets in any order.
#[derive(Debug, Default, PartialEq, Eq)]
struct Offsets {
    count: u64,
    sum: u64,
}

impl Offsets {
    fn add(&mut self, offset: u32) {
        self.count = self.count.saturating_add(1);
        self.sum = self.sum.wrapping_add(offset.into());
    }
}

struct Header {
    /// Number of bytes after each packet.
    trailer: usize,
    /// The link type of all packets if the packets have no trailer.
    link: u16,
    begin: Option<Moment>,
    /// Microseconds from `begin` to the start time.
    fraction: u64,
    /// Offset of the first table, which is the end of the packets.
    packets_end: u64,
    /// Offset and length of the frame table.
    table: (u64, u64),
}

struct Input<R> {
    input: FullReader<R>,
    /// Number of bytes read.
    offset: u64,
}

impl<R: Read> Input<R> {
    /// Reads until the buffer is full or the file ends; returns whether it is full.
    fn fill(&mut self, buf: &mut [u8]) -> std::io::Result<bool> {
        let read = self.input.read(buf)?;
        self.offset = self.offset.saturating_add(u64::try_from(read).unwrap_or(u64::MAX));
        Ok(read == buf.len())
    }

    /// The header of the file; `None` if the file ends inside the header.
    fn header(&mut self) -> Result<Option<Header>, FileError> {
        let mut bytes = [0; HEADER_LEN];
        let rest = bytes.get_mut(MAGIC.len()..).unwrap_or_default();
        if !self.fill(rest)? {
            return Ok(None);
        }
        let (minor, major) = (byte(&bytes, 4), byte(&bytes, 5));
        if major != 2 {
            return Err(FileError::NetMonVersion(major, minor));
        }
        let trailer = match minor {
            0 => 0,
            1 => 2,
            2 => 6,
            _ => 15,
        };
        let [year, month, _, day, hour, minute, second] =
            [8, 10, 12, 14, 16, 18, 20].map(|at| word(&bytes, at));
        let begin = format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z");
        let tables = (TABLES..TABLES_END).step_by(8).map(|at| u64::from(long(&bytes, at)));
        let packets_end = tables.filter(|offset| *offset > 0).min().unwrap_or(0);
        Ok(Some(Header {
            trailer,
            link: word(&bytes, 6),
            begin: Moment::from_rfc3339(&begin),
            fraction: u64::from(word(&bytes, 22)).saturating_mul(1000),
            packets_end,
            table: (long(&bytes, TABLES).into(), long(&bytes, TABLES.saturating_add(4)).into()),
        }))
    }

    /// Reads a packet into `bytes`; returns its time, link type and original length.
    fn packet(
        &mut self,
        header: &Header,
        bytes: &mut Vec<u8>,
    ) -> Result<(Option<Time>, Linktype, usize), String> {
        let cut = |whole: std::io::Result<bool>| match whole {
            Ok(true) => Ok(()),
            Ok(false) => Err("the file ends in this packet".to_owned()),
            Err(error) => Err(error.to_string()),
        };
        let mut about = [0; PACKET_HEADER_LEN];
        cut(self.fill(&mut about))?;
        let captured = to_usize(long(&about, 12));
        if captured > RECORD_MAX {
            return Err(format!(
                "{}, more than the maximum of {RECORD_MAX}",
                plural(captured, "byte")
            ));
        }
        bytes.resize(captured, 0);
        cut(self.fill(bytes))?;
        let mut trailer = [0; 15];
        let trailer = trailer.get_mut(..header.trailer).unwrap_or_default();
        cut(self.fill(trailer))?;
        let link = if trailer.is_empty() { header.link } else { word(trailer, 0) };
        let micros = u64::from(long(&about, 0)) | u64::from(long(&about, 4)) << 32;
        let micros = micros.saturating_add(header.fraction);
        let begin = header.begin.map(Moment::seconds);
        let time = begin.map(|begin| Time::of_units(micros, MICROSECONDS, begin));
        let original = to_usize(long(&about, 8));
        Ok((time, link_type(link), original))
    }

    /// The offsets in the frame table; none if the packets end after the beginning of the table.
    /// `None` if the file cannot be read up to the end of the frame table.
    fn frame_table(&mut self, (offset, length): (u64, u64)) -> Option<Offsets> {
        let mut chunk = [0; TABLE_CHUNK];
        while self.offset < offset {
            let rest = to_usize(offset.saturating_sub(self.offset));
            let rest = chunk.get_mut(..rest.min(TABLE_CHUNK))?;
            self.fill(rest).ok().filter(|whole| *whole)?;
        }
        let mut listed = Offsets::default();
        let mut rest = if self.offset == offset { length } else { 0 };
        while rest > 0 {
            let part = to_usize(rest).min(TABLE_CHUNK);
            let part = chunk.get_mut(..part)?;
            self.fill(part).ok().filter(|whole| *whole)?;
            part.chunks_exact(4).for_each(|four| listed.add(long(four, 0)));
            rest = rest.saturating_sub(u64::try_from(part.len()).unwrap_or(u64::MAX));
        }
        Some(listed)
    }
}

/// Converts a link type of NetMon to that of pcap.
fn link_type(network: u16) -> Linktype {
    match network {
        1 => Linktype::ETHERNET,
        8 => Linktype::RAW,
        // Use numbers that pcap does not have, so that the packets are only counted.
        other => Linktype(NETMON_LINKS | i32::from(other)),
    }
}

fn byte(bytes: &[u8], at: usize) -> u8 {
    bytes.get(at).copied().unwrap_or_default()
}

fn word(bytes: &[u8], at: usize) -> u16 {
    let two = bytes.get(at..).and_then(<[u8]>::first_chunk).copied();
    u16::from_le_bytes(two.unwrap_or_default())
}

fn long(bytes: &[u8], at: usize) -> u32 {
    u32_at(bytes, at).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_start_time_has_milliseconds() {
        let mut file = b"GMBU\0\x02\x01\0".to_vec();
        file.extend([2026_u16, 11, 4, 26, 9, 30, 0, 250].map(u16::to_le_bytes).concat());
        file.extend([144_u32, 4].map(u32::to_le_bytes).concat());
        file.resize(HEADER_LEN, 0);
        // A packet without bytes, five microseconds after the start, and the frame table.
        file.extend([5_u32, 0, 0, 0, 128].map(u32::to_le_bytes).concat());
        let mut times = Vec::new();
        let end = packets(&file[MAGIC.len()..], |packet| times.extend(packet.time)).unwrap();
        let times: Vec<String> = times.iter().map(Time::to_string).collect();
        assert_eq!((end, times), (FileEnd::Whole, vec!["09:30:00.250005 UTC".to_owned()]));
    }
}
