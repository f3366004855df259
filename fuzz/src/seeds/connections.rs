//! Initial inputs of the targets for captures, the gate and sessions.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::operation::{AdsService, Call};

use super::Seed;
use crate::bodies::tools::{calls, gate};
use crate::common::CALLS;

/// Inputs of the target `tools_capture`: a pcap file, a pcapng file, and conversations.
pub(super) fn captured() -> Vec<Seed> {
    let section = b"\x0a\x0d\x0d\x0a\x1c\0\0\0\x4d\x3c\x2b\x1a\x01\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff\x1c\0\0\0";
    let interface = b"\x01\0\0\0\x14\0\0\0\x65\0\0\0\0\0\0\0\x14\0\0\0";
    let mut pcap = vec![0];
    pcap.extend(crate::bodies::tools::capture::sample());
    // The packets of the pcap file, each in a block of the pcapng file.
    let mut pcapng = [&[1][..], section, interface].concat();
    let mut rest = &pcap[25..];
    while let Some((header, behind)) = rest.split_at_checked(16) {
        let length = usize::from(header[8]) | usize::from(header[9]) << 8;
        let (packet, behind) = behind.split_at(length);
        let whole = u32::try_from(length.next_multiple_of(4) + 32).expect("short").to_le_bytes();
        let mut block =
            [&6_u32.to_le_bytes()[..], &whole, &[0; 12], &header[8..16], packet].concat();
        block.resize(block.len().next_multiple_of(4), 0);
        block.extend(whole);
        pcapng.extend(block);
        rest = behind;
    }
    let calls = [1, 3, 9, 4, 4, 5, 20];
    let talk = |ops: &[u8]| [&[2, 3], &calls[..6], &[1, 0, 20, 60], ops].concat();
    vec![
        ("pcap".to_owned(), pcap),
        ("pcapng".to_owned(), pcapng),
        ("in-order".to_owned(), talk(&[])),
        ("swapped".to_owned(), talk(&[0, 0, 1, 0, 3, 5])),
        ("twice".to_owned(), talk(&[1, 0, 4, 1, 3, 1])),
        ("joined".to_owned(), talk(&[3, 0, 1, 3, 4, 5])),
        ("with-a-hole".to_owned(), talk(&[2, 1, 0])),
    ]
}

/// Inputs of the target `tools_gate`: every sample call with less than 200 bytes of data, with
/// entries of a file, and writes after replies.
pub(super) fn sent() -> Vec<Seed> {
    let mut seeds = Vec::new();
    // Entries of a file: a variable of channel 1, a variable of axis 1 of channel 1, the program
    // stream of channel 1, and the element at 0x123301, 1.
    let entries = b"\x04\x00\x01\x00\x01\x01\x01\x04\x06\x01\x02\x01\x33\x12\0\x01\0\0\0";
    for sample in CALLS.iter().filter(|sample| sample.call.data.len() < 200) {
        let mut bytes = [&[2][..], entries].concat();
        bytes.extend(gate::write_call(3, &sample.call, &[]));
        seeds.push((sample.slug.to_owned(), bytes));
    }
    let find = |slug: &str| CALLS.iter().find(|sample| sample.slug == slug).map(|one| one.call);
    let handle = find("handle-printed").expect("a call");
    let group = handle.index_group;
    let named = Call { data: b"V.E.A\0", ..handle };
    let write = Call {
        service: AdsService::Write,
        index_group: group,
        index_offset: IndexOffset::new(0x49),
        data: b"\x07\0\0\0\0\0\0\0\x01",
        ..handle
    };
    let by_name = Call { index_offset: IndexOffset::new(0x4A), data: b"V.E.A\0\x01", ..write };
    let begin = [&[2][..], entries].concat();
    // Handle 7, SGN32, READ_WRITE, 4 bytes, no dimension.
    let description = [7, 6, 2, 4, 0].map(u32::to_le_bytes).concat();
    let describe = Call { index_offset: IndexOffset::new(0x4C), read_length: 2048, ..named };
    let confirmed = |group: IndexGroup| {
        let (named, describe) =
            (Call { index_group: group, ..named }, Call { index_group: group, ..describe });
        let asked = gate::write_call(0, &named, &[7, 0, 0, 0]);
        [asked, gate::write_call(0, &describe, &description)].concat()
    };
    let learnt = confirmed(group);
    let writes = gate::write_call(3, &write, &[]);
    seeds.push(("by-handle".to_owned(), [&begin[..], &learnt, &writes].concat()));
    let other = gate::write_call(0, &Call { data: b"V.E.B\0", ..named }, &[7, 0, 0, 0]);
    seeds.push((
        "by-handle-of-two".to_owned(),
        [&begin[..], &learnt, &writes, &other, &writes].concat(),
    ));
    seeds.push(("forgotten".to_owned(), [&begin[..], &learnt, &[1], &writes].concat()));
    let writes = gate::write_call(3, &by_name, &[]);
    seeds.push(("by-name".to_owned(), [&begin[..], &writes].concat()));
    seeds.push((
        "by-name-elsewhere".to_owned(),
        [&begin[..], &[&[7], &writes[1..]].concat()].concat(),
    ));
    seeds.push(("by-name-later".to_owned(), [&[6][..], entries, &writes].concat()));
    let on_axis =
        Call { index_offset: IndexOffset::new(0x1_0006), data: b"V.A.\xC4\x7F\"\\\0\x01", ..write };
    let on_axis = gate::write_call(3, &on_axis, &[]);
    seeds.push(("by-name-on-an-axis".to_owned(), [&begin[..], &on_axis].concat()));
    let response = Call { data: b"V.G.SERVICE.RESPONSE\0x\0", ..by_name };
    let response = gate::write_call(3, &response, &[]);
    // An entry for the service of channel 1.
    seeds.push(("service".to_owned(), [&[2, 1, 7, 1][..], &response].concat()));
    // Calls that differ from a permitted call only in the case of a letter or in the channel.
    let small = Call { data: b"V.E.a\0\x01", ..by_name };
    let channel_2 = IndexGroup::new(0x12_2302);
    let second = Call { index_group: channel_2, ..by_name };
    for (name, call) in [("small-letters", &small), ("second-channel", &second)] {
        let writes = gate::write_call(3, call, &[]);
        seeds.push((format!("by-name-{name}"), [&begin[..], &writes].concat()));
    }
    let learnt = confirmed(channel_2);
    let writes = gate::write_call(3, &write, &[]);
    seeds.push(("by-handle-of-another".to_owned(), [&begin[..], &learnt, &writes].concat()));
    let writes = gate::write_call(3, &by_name, &[]);
    let object = find("objects-of-channel-1").expect("a call");
    let all = Call { index_offset: IndexOffset::new(1), read_length: 84, ..object };
    let mut descriptor = vec![1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0x12, 0, 1, 0, 0, 0];
    descriptor.extend(b"b_w");
    descriptor.resize(52, 0);
    descriptor.extend(b"BOOL");
    descriptor.resize(84, 0);
    let written = Call {
        service: AdsService::Write,
        index_group: IndexGroup::new(0x12_0101),
        data: b"\x01",
        ..all
    };
    let mut bytes = vec![2, 1, 4, 1, 7];
    bytes.extend(gate::write_call(0, &object, &[1, 0, 0, 0]));
    bytes.extend(gate::write_call(0, &all, &descriptor));
    bytes.extend(gate::write_call(3, &written, &[]));
    seeds.push(("object-by-name".to_owned(), bytes));
    let whole = calls::frame(&object, 1);
    let raw = [&[0, 0, 2, u8::try_from(whole.len()).expect("short")], &whole[..]].concat();
    seeds.push(("raw".to_owned(), raw.clone()));
    let long = [&[0, 0, 2, raw[3] + 1], &whole[..], &[0]].concat();
    seeds.push(("raw-and-a-byte".to_owned(), long));
    let mut control = [&[1, 0, 0x23], &writes[1..]].concat();
    control.push(5);
    seeds.push(("malformed".to_owned(), [&[1], &raw[1..]].concat()));
    seeds.push(("malformed-permitted".to_owned(), [&[3], &control[1..]].concat()));
    seeds.push(("another-command".to_owned(), control));
    seeds
}

/// Inputs of the target `cnc_session`: every sample call with less than 200 bytes of data alone,
/// all sample calls together, writes with a check of their effect, and a frame in two pieces.
pub(super) fn sessions() -> Vec<Seed> {
    let mut seeds = Vec::new();
    let mut all = Vec::new();
    for (place, sample) in (0_u8..).zip(CALLS) {
        all.extend([0, place, place, 0, 0, 1]);
        if place % 5 == 4 {
            all.extend([4, 5, 100, 0]);
        }
        if sample.call.data.len() < 200 {
            let kind = if sample.call.service == AdsService::Write { 6 } else { 1 };
            let alone = calls::write_call(kind, &sample.call);
            seeds.push((sample.slug.to_owned(), alone));
        }
    }
    let write = |name: &str, value: &[u8]| {
        let data = [name.as_bytes(), &[0], value].concat();
        let call = Call {
            port: ads_cnc::ads::AmsPort::SDA,
            service: AdsService::Write,
            index_group: IndexGroup::new(0x12_2301),
            index_offset: IndexOffset::new(0x4A),
            read_length: 0,
            data: &data,
        };
        calls::write_call(6, &call)
    };
    seeds.push(("all".to_owned(), all));
    seeds.push(("write".to_owned(), write("V.E.vartest", &[1, 2, 3, 4])));
    seeds.push(("write-too-long".to_owned(), write("V.E.vartest", &[1, 2, 3, 4, 5])));
    seeds.push(("write-list".to_owned(), write("V.E.list[1][2]", &[1, 2])));
    seeds.push(("write-read-only".to_owned(), write("V.E.text", &[7; 12])));
    let cut = calls::frame(&CALLS[0].call, 1);
    let (one, two) = cut.split_at(20);
    let pieces = [&[2, 20], one, &[4, 2, u8::try_from(two.len()).expect("short")], two].concat();
    seeds.push(("in-pieces".to_owned(), pieces));
    seeds
}
