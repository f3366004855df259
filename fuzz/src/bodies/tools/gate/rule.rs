//! Determines which frames may pass, from their bytes, the bytes of replies and the entries of a
//! file. Reads the bytes without the codec.

use ads_cnc::address::{Addressing, Channel};
use ads_cnc::operation::Call;
use ads_cnc_conformance::gate::{AllowedList, Entry};
use ads_cnc_conformance::number::to_usize;

use super::harmless::{is_harmless, number};

/// A channel as in an index group: the bit for logical addressing, and the number.
type ChannelBits = (bool, u32);

/// The rule that decides which frames a session may send.
pub(super) struct Rule<'e> {
    entries: &'e [Entry],
    /// The handles that replies contain: channel, handle, and the requested name.
    handles: Vec<(ChannelBits, u32, Vec<u8>)>,
    /// The descriptions in replies: channel, handle, and the name of the variable.
    described: Vec<(ChannelBits, u32, Vec<u8>)>,
    /// Descriptors that were read, with the index group of their list.
    objects: Vec<(u32, Vec<u8>)>,
}

/// The names that a host of the Service Interface writes.
const SERVICE: [&[u8]; 3] =
    [b"V.G.SERVICE.REQUEST_STATE", b"V.G.SERVICE.RESPONSE_STATE", b"V.G.SERVICE.RESPONSE"];

fn at(channel: Channel) -> ChannelBits {
    (channel.addressing() == Addressing::Logical, channel.number().into())
}

/// The channel of a group, if the group addresses the content of a decoder (such as 0x122301).
fn decoder(group: u32) -> Option<ChannelBits> {
    (group & !0x10_00FF == 0x2_2300).then_some((group >> 20 == 1, group & 0xFF))
}

fn is_in(requested_name: &[u8], name: &[u8]) -> bool {
    let Some(rest) = requested_name.strip_prefix(name) else { return false };
    let rest = std::str::from_utf8(rest).unwrap_or("?");
    rest.is_empty()
        || rest.starts_with('[') && rest.ends_with(']') && {
            let inside = rest[1..rest.len() - 1].split("][");
            inside.into_iter().all(|one| !one.is_empty() && one.bytes().all(|b| b.is_ascii_digit()))
        }
}

fn until_nul(data: &[u8]) -> Option<&[u8]> {
    data.iter().position(|&byte| byte == 0).map(|end| &data[..end])
}

impl<'e> Rule<'e> {
    pub(super) const fn new(entries: &'e [Entry]) -> Self {
        Self { entries, handles: Vec::new(), described: Vec::new(), objects: Vec::new() }
    }

    pub(super) fn forget(&mut self) {
        *self = Self::new(self.entries);
    }

    /// Learns from a reply.
    pub(super) fn observe(&mut self, call: &Call<'_>, reply: &[u8]) {
        let (group, offset) = (call.index_group.get(), call.index_offset.get());
        if let (Some(at), Some(handle)) = (decoder(group), reply.first_chunk()) {
            let handle = u32::from_le_bytes(*handle);
            let named = |name: Option<&[u8]>| name.map(|name| (at, handle, name.to_vec()));
            match offset {
                0x46 if reply.len() == 4 => self.handles.extend(named(until_nul(call.data))),
                // The name follows the handle, type, access, size and dimensions.
                0x45 if reply.len() > 20 => {
                    let skip = 20 + 4 * to_usize(number(reply, 16));
                    let name = reply.get(skip..);
                    self.described.extend(named(name.map(|name| until_nul(name).unwrap_or(name))));
                }
                0x4C if reply.len() >= 20 => self.described.extend(named(until_nul(call.data))),
                _ => {}
            }
        }
        if group & !0x10_FFFF == 0x3_0000 && !reply.is_empty() && reply.len().is_multiple_of(84) {
            self.objects.extend(reply.chunks(84).map(|one| (group, one.to_vec())));
        }
    }

    /// Whether the file names a variable on the axis `on` (0: on no axis). With `whole`, an entry
    /// for an element of an array does not count.
    fn names(&self, channel: ChannelBits, on: u32, requested_name: &[u8], whole: bool) -> bool {
        self.entries.iter().any(|entry| match entry {
            Entry::Variable { channel: of, axis, name } => {
                at(*of) == channel
                    && axis.map_or(0, |axis| axis.index().into()) == on
                    && is_in(requested_name, name.as_bytes())
                    && !(whole && name.as_bytes().ends_with(b"]"))
            }
            Entry::Service(of) => {
                at(*of) == channel && on == 0 && SERVICE.contains(&requested_name)
            }
            _ => false,
        })
    }

    /// Whether the object at this address, and at no other, was described with a name in the file.
    fn is_object(&self, group: u32, offset: u32) -> bool {
        self.entries.iter().any(|entry| {
            let Entry::Object { list, name } = entry else { return false };
            let of = match list {
                AllowedList::Platform => 0x13_0100,
                AllowedList::Channel(channel) => match at(*channel) {
                    (true, number) => 0x13_0100 | number,
                    (false, number) => 0x3_0100 | number,
                },
                AllowedList::Axis(axis) => 0x13_0200 | u32::from(axis.index()),
            };
            let seen = self.objects.iter().filter(|(group, object)| {
                let text = &object[20..52];
                let text = text.split(|&byte| byte == 0).next().unwrap_or(text);
                *group == of && text == name.as_bytes()
            });
            let addresses: Vec<_> =
                seen.map(|(_, object)| (number(object, 12), number(object, 16))).collect();
            !addresses.is_empty() && addresses.iter().all(|one| *one == (group, offset))
        })
    }

    /// Whether the frame is a write of something that the file names.
    fn is_named(&self, frame: &[u8]) -> bool {
        if frame.len() < 50 || frame[22..26] != [3, 0, 4, 0] || frame[30..34] != [0; 4] {
            return false;
        }
        let (group, offset, data) = (number(frame, 38), number(frame, 42), &frame[50..]);
        if number(frame, 46) as usize != data.len() {
            return false;
        }
        let is_com = group & 0xFFFF < 0x300;
        if u16::from_le_bytes([frame[12], frame[13]]) != if is_com { 553 } else { 552 } {
            return false;
        }
        if let Some(channel) = decoder(group).filter(|(_, number)| *number > 0) {
            let axis = offset >> 16;
            match (axis, offset & 0xFFFF) {
                (0, 0x49) => {
                    let Some(handle) = data.first_chunk().map(|four| u32::from_le_bytes(*four))
                    else {
                        return false;
                    };
                    let mut requested_name = self.handles.iter();
                    return requested_name.any(|one| {
                        (one.0, one.1) == (channel, handle)
                            && self.described.contains(one)
                            && self.names(channel, 0, &one.2, true)
                    });
                }
                (0, 0x4A) | (1.., 6) => {
                    let name = until_nul(data);
                    return name.is_some_and(|name| self.names(channel, axis, name, false));
                }
                _ => {}
            }
        }
        if is_com && group & !0x10_00FF == 0x2_0100 && offset == 0x90 {
            let channel = (group >> 20 == 1, group & 0xFF);
            let of = |entry: &Entry| matches!(entry, Entry::Stream(of) if at(*of) == channel);
            return self.entries.iter().any(of);
        }
        let content = |entry: &Entry| match entry {
            Entry::Content { group: of, offset: here } => (of.get(), here.get()) == (group, offset),
            _ => false,
        };
        self.entries.iter().any(content) || self.is_object(group, offset)
    }

    /// Whether a frame may be sent.
    pub(super) fn permits(&self, frame: &[u8], target: [u8; 6], malformed: bool) -> bool {
        if !is_whole(frame) {
            return false;
        }
        let named = frame[6..12] == target && self.is_named(frame);
        if !malformed || frame[6..12] != target {
            return is_harmless(frame) || named;
        }
        let command = u16::from_le_bytes([frame[22], frame[23]]);
        let call = frame.len() >= 50 && [2, 3, 9].contains(&command);
        let address = call.then(|| (number(frame, 38), number(frame, 42)));
        let sums = address.is_some_and(|(group, _)| (0xF080..=0xF08F).contains(&group));
        // A write to the program stream without data or with more than 992 bytes is malformed: it
        // needs no entry.
        let stream = address.is_some_and(|(group, offset)| {
            let is_stream = group & !0x10_00FF == 0x2_0100 && offset == 0x90;
            let is_undocumented = command != 3 || group & 0xFF == 0;
            is_stream && (is_undocumented || (1..=992).contains(&(frame.len() - 50)))
        });
        let needs_entry = [5, 6, 7, 8].contains(&command)
            || call
                && is_whole_call(frame, command)
                && (sums || stream || is_write(frame, command));
        named || !needs_entry
    }
}

/// Whether the lengths in a call match the length of the frame.
fn is_whole_call(frame: &[u8], command: u16) -> bool {
    match command {
        2 => frame.len() == 50,
        3 => number(frame, 46) as usize + 50 == frame.len(),
        _ => frame.len() >= 54 && number(frame, 50) as usize + 54 == frame.len(),
    }
}

/// Whether this is a write of a variable by a short ASCII name, or of the element at 0x123301, 1,
/// at the port of its task.
fn is_write(frame: &[u8], command: u16) -> bool {
    let (group, offset, data) = (number(frame, 38), number(frame, 42), &frame[50..]);
    let port = u16::from_le_bytes([frame[12], frame[13]]);
    let by_name = decoder(group).is_some_and(|(_, number)| number > 0)
        && offset == 0x4A
        && until_nul(data).is_some_and(|name| {
            (1..=200).contains(&name.len()) && data.len() > name.len() + 1 && name.is_ascii()
        });
    let content = group == 0x12_3301 && offset == 1 && !data.is_empty();
    command == 3 && port == 552 && (by_name || content)
}

/// Whether the lengths match exactly one frame.
fn is_whole(frame: &[u8]) -> bool {
    frame.len() >= 38
        && frame[..2] == [0, 0]
        && number(frame, 2) as usize + 6 == frame.len()
        && number(frame, 26) as usize + 38 == frame.len()
}
