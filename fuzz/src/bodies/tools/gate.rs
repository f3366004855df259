//! The gate, compared with a rule that reads the bytes of frames and replies without the codec.

use ads_cnc::CncString;
use ads_cnc::address::{Channel, ChannelAxis, IndexGroup, IndexOffset, PlatformAxis};
use ads_cnc::ads::AmsNetId;
use ads_cnc::operation::Call;
use ads_cnc_conformance::gate::{self, Allowed, AllowedList, Entry, Gate, Moment};
use ads_cnc_conformance::number::to_u32;

use super::Input;
use super::calls::{call, written};
use crate::{Defect, Outcome};

#[path = "../../../../conformance/tests/common/harmless.rs"]
mod harmless;
mod rule;

use rule::Rule;

pub(crate) const DEFECTS: &[&str] = &[
    "a write of the decoder of channel 2 passes without an entry",
    "an entry is valid for any target",
    "an entry never expires",
    "names are compared case-insensitively",
    "a handle is also valid in the first channel",
    "a frame with an extra byte passes",
    "a forgotten reply still permits writes",
    "WriteControl passes where malformed frames do",
    "an entry is printed with a different channel",
    "a Read of channel 2 does not pass",
];

/// A time at which the file is valid, and the time at which it expires.
const NOW: &str = "2026-05-04T17:29:59Z";
const END: &str = "2026-05-04T17:30:00Z";

/// The NetId for which the file is valid.
const TARGET: [u8; 6] = [192, 0, 2, 7, 1, 1];

/// Input: the settings (bit 0: malformed frames pass, bit 1: a file allows writes, bit 2: the file has
/// expired), the number of entries of the file, the entries, then records: a reply that the gate learns
/// from (0), the gate forgets all replies (1), bytes to be sent (2), a frame to be sent (3 and more).
pub(crate) fn check(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let settings = input.byte();
    let (malformed, file, over) = (settings & 1 != 0, settings & 2 != 0, settings & 4 != 0);
    let entries = entries(&mut input, defect);
    let mut gate = Gate::queries();
    if file {
        let (target, expires) = (AmsNetId(TARGET), moment(END));
        let entries = entries.clone();
        let allowed = Allowed { target, address: None, malformed, expires, entries };
        gate = gate.with_allowed(Some(allowed));
    }
    if malformed {
        gate = gate.and_malformed();
    }
    let mut rule = Rule::new(if file && !over { &entries } else { &[] });
    let now = moment(if over && !defect.is(3) { END } else { NOW });
    let mut passed = Vec::new();
    while !input.is_empty() {
        let kind = input.byte();
        let frame = match kind {
            0 => {
                let (mut call, reply) = (call(&mut input, &PORTS), input.piece());
                rule.observe(&call, reply);
                gate.observe(&call, reply);
                if defect.is(5) {
                    call.index_group = IndexGroup::new(call.index_group.get() & !0xFF | 1);
                    gate.observe(&call, reply);
                }
                continue;
            }
            1 => {
                rule.forget();
                if !defect.is(7) {
                    gate.forget();
                }
                continue;
            }
            2 => input.piece().to_vec(),
            _ => frame(&mut input, kind),
        };
        let passes = passes(&gate, &frame, now, defect);
        let malformed = malformed && file && !over;
        assert!(!passes || rule.permits(&frame, TARGET, malformed), "{settings:#x} {frame:02x?}");
        // A frame that passes without a file also passes with additional permissions.
        assert!(passes || gate::check(&frame).is_err(), "{frame:02x?}");
        passed.push(passes);
    }
    match passed.contains(&true) {
        true => Outcome::accepted(passed),
        false => Outcome::rejected(passed),
    }
}

fn passes(gate: &Gate, frame: &[u8], now: Moment, defect: Defect) -> bool {
    let check = |frame: &[u8]| gate.check(frame, now).is_ok();
    let mut other = frame.to_vec();
    let is_long = frame.len() > 54;
    let is_held = defect.is(10) && frame.len() == 50 && frame[22] == 2 && frame[38] == 2;
    check(frame) && !is_held
        || match () {
            () if defect.is(1) && is_long => frame[22] == 3 && frame[38..41] == [2, 0x23, 0x12],
            () if defect.is(2) && is_long => {
                other[6..12].copy_from_slice(&TARGET);
                check(&other)
            }
            () if defect.is(4) && is_long => {
                other[50..].make_ascii_uppercase();
                check(&other)
            }
            () if defect.is(6) => other.pop().is_some() && check(&other),
            () if defect.is(8) && is_long => {
                other[22] = 4;
                frame[22] == 5 && check(&other)
            }
            () => false,
        }
}

fn moment(text: &str) -> Moment {
    Moment::from_rfc3339(text).expect("a moment")
}

const NAMES: [&str; 8] = [
    "V.E.A",
    "V.E.A[1]",
    "V.E.a",
    "V.G.SERVICE.RESPONSE",
    "V.A.\u{c4}\u{7f}\"\\",
    "V.E.A[1][2]",
    "V.E.A[1",
    "b_w",
];

/// The valid entries of a file, as they are parsed from the printed file.
fn entries(input: &mut Input<'_>, defect: Defect) -> Vec<Entry> {
    let count = input.byte() % 5;
    let mut entries = Vec::new();
    for _ in 0..count {
        let kind = input.byte();
        let Some(entry) = entry(input, kind) else { continue };
        let text = format!("target = \"192.0.2.7.1.1\"\nexpires = {END}\n\n{entry}");
        let text = if defect.is(9) { text.replace("= 3\n", "= 4\n") } else { text };
        match Allowed::from_toml(&text) {
            Ok(read) => {
                assert_eq!(read.entries, [entry], "{text}");
                entries.extend(read.entries);
            }
            // A file must not contain an entry for certain addresses.
            Err(error) => {
                assert!(matches!(entry, Entry::Content { .. }), "{text}\n{error}");
                assert!(error.to_string().contains("line "), "{error}");
            }
        }
    }
    entries
}

fn entry(input: &mut Input<'_>, kind: u8) -> Option<Entry> {
    let channel = |input: &mut Input<'_>| match input.byte() {
        rank @ 0x80.. => Channel::by_index(u32::from(rank) & 0x7F).ok(),
        number => Channel::new(number.into()).ok(),
    };
    let name = |input: &mut Input<'_>| input.choose(&NAMES).parse::<CncString>().ok();
    Some(match kind % 8 {
        0 => Entry::Variable { channel: channel(input)?, axis: None, name: name(input)? },
        1 => {
            let axis = ChannelAxis::new(input.byte().into()).ok()?;
            Entry::Variable { channel: channel(input)?, axis: Some(axis), name: name(input)? }
        }
        2 => Entry::Content {
            group: IndexGroup::new(input.long()),
            offset: IndexOffset::new(input.long()),
        },
        3 => Entry::Object { list: AllowedList::Platform, name: name(input)? },
        4 => Entry::Object { list: AllowedList::Channel(channel(input)?), name: name(input)? },
        5 => {
            let axis = PlatformAxis::new(input.byte().into()).ok()?;
            Entry::Object { list: AllowedList::Axis(axis), name: name(input)? }
        }
        6 => Entry::Stream(channel(input)?),
        _ => Entry::Service(channel(input)?),
    })
}

const PORTS: [u16; 5] = [552, 553, 551, 851, 10000];

/// A frame with the next call. Set bits of the kind select a different target (bit 2), different
/// flags (bit 3), an error (bit 4), a different command (bit 5) and a data length that is one too
/// high (bit 6).
fn frame(input: &mut Input<'_>, kind: u8) -> Vec<u8> {
    let odd = |bit: u8| kind >> bit & 1;
    let Call { port, service, index_group, index_offset, read_length, data } = call(input, &PORTS);
    let mut command = u32::from(service.command().0);
    if odd(5) == 1 {
        command = input.byte().into();
    }
    let length = (to_u32(data.len()) + u32::from(odd(6))).to_le_bytes();
    let (group, offset) = (index_group.get().to_le_bytes(), index_offset.get().to_le_bytes());
    let read_length = read_length.to_le_bytes();
    let payload = match command {
        1 | 4 => data.to_vec(),
        2 => [group, offset, read_length].concat(),
        3 => [&[group, offset, length].concat(), data].concat(),
        _ => [&[group, offset, read_length, length].concat(), data].concat(),
    };
    let behind = to_u32(payload.len());
    let mut target = TARGET;
    target[5] += odd(2);
    let mut frame = vec![0, 0];
    frame.extend((behind + 32).to_le_bytes());
    frame.extend(target);
    frame.extend(port.0.to_le_bytes());
    frame.extend([192, 0, 2, 1, 1, 1, 0, 0x80]);
    frame.extend(&command.to_le_bytes()[..2]);
    frame.extend([4 + odd(3), 0]);
    frame.extend(behind.to_le_bytes());
    frame.extend([odd(4), 0, 0, 0, 7, 0, 0, 0]);
    frame.extend(payload);
    frame
}

/// Writes a call in the form that [`check`] reads: with a reply to learn from, or to be sent.
pub(crate) fn write_call(kind: u8, call: &Call<'_>, reply: &[u8]) -> Vec<u8> {
    let port = PORTS.iter().position(|one| *one == call.port.0).unwrap_or(0);
    let mut bytes = vec![kind];
    bytes.extend(written(call, port));
    if kind == 0 {
        bytes.push(u8::try_from(reply.len()).expect("a short reply"));
        bytes.extend(reply);
    }
    bytes
}
