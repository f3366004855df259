//! For any bytes, the gate permits a frame only if the frame is a harmless query, or if a file for
//! `--allow-write` allows it.

use crate::common::harmless::{is_harmless, number};
use ads_cnc_conformance::gate::{self, Allowed, Gate, Moment};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

const NET_ID: [u8; 6] = [192, 0, 2, 7, 1, 1];

/// A file for `--allow-write` with entries for variables, an object, an element and the program
/// stream.
const FILE: &str = r#"
target = "192.0.2.7.1.1"
expires = 2026-05-04T17:30:00Z
[[variable]]
channel = 1
name = "V.E.a"
[[variable]]
channel = 1
axis = 2
name = "V.A.a"
[[object]]
group = 0x120101
offset = 1
[[element]]
group = 0x123301
offset = 1
[[stream]]
channel = 1
"#;

fn frame(net_id: [u8; 6], port: u16, command: u16, flags: u16, payload: &[u8]) -> Vec<u8> {
    let len = u32::try_from(payload.len()).unwrap();
    let mut frame = vec![0, 0];
    frame.extend_from_slice(&(len + 32).to_le_bytes());
    frame.extend_from_slice(&net_id);
    frame.extend_from_slice(&port.to_le_bytes());
    frame.extend_from_slice(&[192, 0, 2, 1, 1, 1, 0, 0x80]);
    frame.extend_from_slice(&command.to_le_bytes());
    frame.extend_from_slice(&flags.to_le_bytes());
    frame.extend_from_slice(&len.to_le_bytes());
    frame.extend_from_slice(&[0; 8]);
    frame.extend_from_slice(payload);
    frame
}

/// Frames that are similar to permitted frames: with addresses of functions, and addresses near them.
fn near() -> impl Strategy<Value = Vec<u8>> {
    let net_id = select(vec![NET_ID, [127, 0, 0, 1, 1, 1]]);
    let port = prop_oneof![9 => 551..554_u16, 1 => any::<u16>()];
    let command = prop_oneof![6 => select(vec![2_u16, 3, 9]), 2 => 0..12_u16, 1 => any::<u16>()];
    let flags = prop_oneof![9 => Just(4_u16), 1 => any::<u16>()];
    let group = prop_oneof![
        6 => select(vec![
            0x12_0100_u32, 0x12_0101, 0x2_0101, 0x12_0201, 0x13_0101, 0x12_2300, 0x12_2301, 0x2_2301,
            0x12_3301, 0x12_3401, 0x12_3801, 0x12_3900, 0x2_5300, 0x2_5900, 0xF080, 0xF081, 0xF082,
        ]),
        1 => (0..0x100_u32).prop_map(|table| 0x12_0000 | table << 8),
        1 => any::<u32>(),
    ];
    let offset = prop_oneof![
        8 => select(vec![0_u32, 1, 2, 4, 5, 6, 0x90, 0x2_0004, 0x2_0005, 0x2_0006]),
        8 => 0..0x50_u32,
        1 => any::<u32>(),
    ];
    let data = prop_oneof![
        6 => select(vec![
            &b""[..], b"V.E\0", b"V.E.a\0\x01", b"V.E.a[1]\0\x01", b"V.E.b\0\x01", b"V.A.a\0\x01",
            b"\x01", b"\x01\0\0\0", b"\x01\0\0\0V.E\0", b"M30\r\n", &[0; 8],
        ]).prop_map(<[u8]>::to_vec),
        1 => vec(any::<u8>(), 0..40),
    ];
    // The length fields are sometimes wrong.
    let lie = prop_oneof![9 => Just(0_u32), 1 => any::<u32>()];
    (net_id, port, command, flags, group, offset, data, lie).prop_map(
        |(net_id, port, command, flags, group, offset, data, lie)| {
            let len = u32::try_from(data.len()).unwrap() ^ lie;
            let mut payload = [group.to_le_bytes(), offset.to_le_bytes()].concat();
            match command {
                2 => payload.extend_from_slice(&84_u32.to_le_bytes()),
                3 => payload.extend_from_slice(&[&len.to_le_bytes()[..], &data].concat()),
                9 => {
                    let lengths = [84_u32.to_le_bytes(), len.to_le_bytes()].concat();
                    payload.extend_from_slice(&[&lengths[..], &data].concat());
                }
                1 | 4 => payload = data,
                _ => payload.extend_from_slice(&data),
            }
            frame(net_id, port, command, flags, &payload)
        },
    )
}

/// Frames that pass: writes that [`FILE`] allows, and queries.
fn good() -> Vec<Vec<u8>> {
    let service = |port, command, group: u32, offset: u32, data: &[u8]| {
        let len = u32::try_from(data.len()).unwrap().to_le_bytes();
        let read: &[u8] = if command == 9 { &[84, 0, 0, 0] } else { &[] };
        let place = [group.to_le_bytes(), offset.to_le_bytes()].concat();
        frame(NET_ID, port, command, 4, &[&place, read, &len, data].concat())
    };
    vec![
        service(552, 3, 0x12_2301, 0x4A, b"V.E.a\0\x01"),
        service(552, 3, 0x12_2301, 0x4A, b"V.E.a[12]\0\x01"),
        service(552, 3, 0x12_2301, 0x2_0006, b"V.A.a\0\x01"),
        service(553, 3, 0x12_0101, 1, b"\x01"),
        service(552, 3, 0x12_3301, 1, b"\x01"),
        service(553, 3, 0x12_0101, 0x90, b"M30\r\n"),
        service(553, 2, 0x13_0101, 1, b""),
        service(552, 9, 0x12_2301, 0x44, b"V.E\0"),
        service(552, 9, 0x12_2301, 0x2_0005, b"V.A.a\0"),
        frame(NET_ID, 553, 4, 4, b""),
    ]
}

/// A frame that passes, with up to two bytes changed.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let change = (any::<prop::sample::Index>(), 0..8_u32);
    (select(good()), vec(change, 0..3)).prop_map(|(mut frame, changes)| {
        for (place, bit) in changes {
            let place = place.index(frame.len());
            frame[place] ^= 1 << bit;
        }
        frame
    })
}

fn frames() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![near(), damaged()]
}

/// Whether the bytes are exactly one frame according to its length fields.
fn is_whole(frame: &[u8]) -> bool {
    let (after_tcp, after_ams) = (number(frame, 2) as usize, number(frame, 26) as usize);
    frame[..2] == [0, 0] && after_tcp + 6 == frame.len() && after_ams + 38 == frame.len()
}

/// Whether the frame is a write that [`FILE`] allows.
fn is_allowed(frame: &[u8]) -> bool {
    if !is_whole(frame) || frame[6..12] != NET_ID || frame[22..26] != [3, 0, 4, 0] {
        return false;
    }
    let (port, data) = (u16::from_le_bytes([frame[12], frame[13]]), &frame[50..]);
    if number(frame, 46) as usize != data.len() || frame[30..34] != [0; 4] {
        return false;
    }
    match (port, number(frame, 38), number(frame, 42)) {
        (552, 0x12_2301, 0x4A) => {
            let name = data.split(|&byte| byte == 0).next().filter(|name| name.len() < data.len());
            name.is_some_and(|name| name == b"V.E.a" || name.starts_with(b"V.E.a["))
        }
        (552, 0x12_2301, 0x2_0006) => data.starts_with(b"V.A.a\0"),
        (553, 0x12_0101, 1) | (552, 0x12_3301, 1) => true,
        (553, 0x12_0101, 0x90) => (1..=992).contains(&data.len()),
        _ => false,
    }
}

fn moment(text: &str) -> Moment {
    Moment::from_rfc3339(text).unwrap()
}

proptest! {
    #![proptest_config(crate::kept::cases(10_000, file!()))]

    #[test]
    fn only_harmless_frames_pass_by_default(frame in frames()) {
        prop_assert!(gate::check(&frame).is_err() || is_harmless(&frame), "{frame:02x?}");
    }

    #[test]
    fn a_file_adds_only_its_entries(frame in frames()) {
        let gate = Gate::queries().with_allowed(Some(Allowed::from_toml(FILE).unwrap()));
        let passes = gate.check(&frame, moment("2026-05-04T17:29:59Z")).is_ok();
        prop_assert!(!passes || is_harmless(&frame) || is_allowed(&frame), "{frame:02x?}");
        let late = gate.check(&frame, moment("2026-05-04T17:30:00Z")).is_ok();
        prop_assert!(!late || is_harmless(&frame), "{frame:02x?}");
        // A frame that passes without a file also passes with a file.
        prop_assert!(passes || gate::check(&frame).is_err());
    }

    #[test]
    fn noise_does_not_pass(bytes in vec(any::<u8>(), 0..200)) {
        prop_assert!(gate::check(&bytes).is_err());
    }

    #[test]
    fn only_exactly_one_frame_passes(frame in frames(), extra in any::<u8>()) {
        if gate::check(&frame).is_ok() {
            prop_assert!(gate::check(&frame[..frame.len() - 1]).is_err());
            prop_assert!(gate::check(&[&frame[..], &[extra]].concat()).is_err());
        }
    }

    /// A file that permits malformed requests still allows no commands that are never sent, no other
    /// target, and no documented writes.
    #[test]
    fn permitted_malformed_requests_have_limits(frame in frames()) {
        let (head, _) = FILE.split_once("[[").unwrap();
        let allowed = Allowed::from_toml(&format!("{head}malformed = true")).unwrap();
        let gate = Gate::queries().with_allowed(Some(allowed)).and_malformed();
        if gate.check(&frame, moment("2026-05-04T17:29:59Z")).is_ok() {
            let command = u16::from_le_bytes([frame[22], frame[23]]);
            prop_assert!(!(5..9).contains(&command), "{frame:02x?}");
            prop_assert!(is_harmless(&frame) || frame[6..12] == NET_ID, "{frame:02x?}");
            // A documented write that the file does not name is still rejected.
            prop_assert!(!is_allowed(&frame), "{frame:02x?}");
        }
    }
}

/// The strategy generates queries and writes that pass, and frames that are rejected.
#[test]
fn the_strategy_covers_both_results() {
    use proptest::strategy::ValueTree as _;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let gate = Gate::queries().with_allowed(Some(Allowed::from_toml(FILE).unwrap()));
    let (mut queries, mut writes, mut rejected) = (0, 0, 0);
    for _ in 0..20_000 {
        let frame = frames().new_tree(&mut runner).unwrap().current();
        match gate.check(&frame, moment("2026-05-04T17:00:00Z")) {
            Ok(permit) if permit.is_repeatable() => queries += 1,
            Ok(_) => writes += 1,
            Err(_) => rejected += 1,
        }
    }
    assert!(queries > 2000 && writes > 500 && rejected > 5000, "{queries} {writes} {rejected}");
}
