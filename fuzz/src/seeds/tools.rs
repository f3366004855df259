//! Initial inputs of the targets for the tools and for the simulated CNC.

use std::collections::BTreeSet;

use ads_cnc::layout::Stream;
use ads_cnc::operation::AdsService;
use ads_cnc_vectors::vectors;

use super::{LONGEST, Seed, connections};
use crate::bodies::tools::{calls, session};
use crate::common::{self, CALLS};

const PROFILE: &str = include_str!("../../../conformance/src/profile/device.toml");

const MORE_PROFILE: &str = r#"name = "mine \"\\ \u007f"
edition = "de-1.051"
cnc-version = "V4.29.0"
ports = [552, 553]
channels = [1, 2, 6]
absent-channel = 5
platform-axes = 5
spindles = 2
empty-places = [[2, 2], [6, 3]]
kinds = ["V.G", "V.E"]
by-name-only = ["V.CYC.count"]
unwritten = ["example_axis_number_w"]
sections = ["objects", "variables", "service"]
functions = ["read variable value by name", "number of variable elements"]
printed-examples = true
timeout = 2000
"#;

const WAIVERS: &str = r#"[[waiver]]
test = "var-descriptions"
requirement = "VAR-8"
verdict = "fail"
reason = "sizes are rounded up to 4 until firmware 2.1"
expires = 2027-01-31

[[waiver]]
test = "var-names"
requirement = "VAR-8"
verdict = "fail"
reason = "known"
expires = 2028-02-29
"#;

const ALLOW: &str = r#"target = "192.0.2.7.1.1"
expires = 2026-05-04T17:30:00+02:00

[[variable]]
channel = 1
name = "V.E.list"

[[variable]]
rank = 1
axis = 2
name = "V.A.\"\\\u00e4\u007f"

[[object]]
group = 0x120101
offset = 0x1

[[object]]
channel = 0
name = "mc_command_single_block_w"

[[object]]
axis = 3
name = "a"

[[element]]
group = 0x123301
offset = 1

[[stream]]
rank = 1

[[service]]
channel = 255
"#;

/// Lines of a testee: a greeting, answers and malformed lines.
const SAID: [&str; 10] = [
    r#"{"protocol": 1, "testee": {"name": "mine", "version": "1", "language": "C"}, "capabilities": {"ops": ["decode"], "streams": ["variable-count"], "editions": ["en-1.05"]}}"#,
    r#"{"seq": 258, "ok": {"value": {"count": 4, "value": -1.5e-7}}}"#,
    r#"{"seq": 258, "ok": {"hex": "04 00 00 00"}}"#,
    r#"{"seq": 258, "ok": {"packets": ["4d33300d0a", ""]}}"#,
    r#"{"seq": 258, "reject": {"class": "truncated", "at": 4, "line": 1, "message": "short"}}"#,
    r#"{"seq": 258, "unsupported": {"what": "op"}}"#,
    r#"{"seq": 258, "error": {"message": "no \ud83d\ude00"}}"#,
    r#"{"seq": 257, "ok": {}}"#,
    r#"{"error": {"message": "it cannot be read"}}"#,
    r#"{"seq": 258, "ok": {}, "unsupported": {"what": "op"}}"#,
];

fn text(name: &str, text: &str) -> Seed {
    (name.to_owned(), text.as_bytes().to_vec())
}

/// The initial inputs of a target.
pub(super) fn seeds(target: &str) -> Vec<Seed> {
    match target {
        "tools_waiver" => vec![text("two", WAIVERS), text("none", "# Nothing.\n")],
        "tools_profile" => vec![text("device", PROFILE), text("everything", MORE_PROFILE)],
        "tools_allow" => vec![text("one-of-each", ALLOW)],
        "tools_model" => models(),
        "tools_explain" => explained(),
        "tools_capture" => connections::captured(),
        "tools_testee" => said(),
        "tools_gate" => connections::sent(),
        "cnc_session" => connections::sessions(),
        _ => panic!("{target} has no seeds"),
    }
}

/// Inputs of the target `tools_model`: the small model, and beginnings of it.
fn models() -> Vec<Seed> {
    let all = session::MODEL;
    let parts = ["[[channel]]\nnumber = 6", "[channel.streaming]", "[class.hld"];
    let mut seeds = vec![text("small", all)];
    seeds.extend(parts.map(|part| {
        let end = all.find(part).expect("a part of it");
        let name: String = part.chars().filter(char::is_ascii_alphanumeric).collect();
        text(&format!("before-{name}"), &all[..end])
    }));
    seeds
}

/// Inputs of the target `tools_explain`: streams, data at an address, addresses, frames, and hex.
fn explained() -> Vec<Seed> {
    let streams: Vec<Stream> = Stream::all().collect();
    let place = |stream: Stream| streams.iter().position(|one| *one == stream);
    let byte = |number: usize| u8::try_from(number).expect("few streams");
    let mut seeds = Vec::new();
    let mut known = BTreeSet::new();
    for (stream, sample) in common::each_sample() {
        // Only the first sample of each stream, and the examples that the manuals print.
        if !known.insert(stream.to_string()) && !sample.slug.contains("printed") {
            continue;
        }
        let at = byte(place(stream).expect("a stream"));
        let name = format!("{stream}-{}", sample.slug);
        seeds.push((name, [vec![0, at, 0, 0, 0], sample.bytes()].concat()));
    }
    for sample in CALLS {
        let call = &sample.call;
        let service = match call.service {
            AdsService::Read => 1,
            AdsService::Write => 2,
            AdsService::ReadWrite => 3,
        };
        let port = [0, 551, 552, 553].iter().position(|port| *port == call.port.0);
        let mut bytes = vec![1, 0, 0, 0, 0, byte(port.unwrap_or(0)), service, 0];
        bytes.extend(call.index_group.get().to_le_bytes());
        bytes.extend(call.index_offset.get().to_le_bytes());
        seeds.push((format!("place-{}", sample.slug), [&bytes[..], call.data].concat()));
        if sample.slug.contains("axis") {
            bytes[0] = 2;
            seeds.push((format!("address-{}", sample.slug), bytes));
        }
        let frame = calls::frame(call, 7);
        seeds.push((format!("frame-{}", sample.slug), [vec![3, 0, 0, 0, 0], frame].concat()));
    }
    let frames: Vec<u8> = CALLS[..3].iter().flat_map(|one| calls::frame(&one.call, 1)).collect();
    seeds.push(("frames".to_owned(), [vec![3, 0, 0, 0, 0], frames].concat()));
    let element = place(Stream::ElementText).expect("a stream");
    let escape = [&[0, byte(element), 0, 0, 0][..], b"a\x1B[31m\0"].concat();
    seeds.push(("text-with-an-escape".to_owned(), escape));
    for (name, hex) in [
        ("plain", "0200000a"),
        ("prefixes", "0x02 0X00, 0x00 0x0A"),
        ("between", "02:00;00-0a\n0x0200\t\r\n000A"),
    ] {
        seeds.push((format!("hex-{name}"), [&[5], hex.as_bytes()].concat()));
    }
    seeds
}

/// Inputs of the target `tools_testee`: each line alone, all lines together, and short lines.
fn said() -> Vec<Seed> {
    let one = |place: usize| (format!("line-{place}"), [&[0, 7], SAID[place].as_bytes()].concat());
    let mut seeds: Vec<Seed> = (0..SAID.len()).map(one).collect();
    let all = SAID.join("\r\n");
    seeds.push(("all".to_owned(), [&[0, 64], all.as_bytes()].concat()));
    seeds.push(("short".to_owned(), b"\x08\x03{}\r\n12345678\nabc\n\n".to_vec()));
    seeds
}

/// The words of the dictionary: words of the files and lines above and of the small model, the
/// addresses of the sample calls, and one golden vector of each length up to 64 bytes that occurs.
pub(crate) fn words() -> BTreeSet<Vec<u8>> {
    let files = [PROFILE, MORE_PROFILE, WAIVERS, ALLOW, session::MODEL];
    let said = SAID.join(" ");
    let of_files = files.iter().flat_map(|file| file.split([' ', '\n', ',', '{', '}']));
    let of_lines = said.split([' ', ',']);
    let mut words: BTreeSet<Vec<u8>> =
        of_files.chain(of_lines).map(|word| word.as_bytes().to_vec()).collect();
    for sample in CALLS {
        for number in [sample.call.index_group.get(), sample.call.index_offset.get()] {
            words.insert(number.to_le_bytes().to_vec());
        }
    }
    let short =
        vectors().iter().map(|vector| vector.bytes()).filter(|bytes| bytes.len() <= LONGEST);
    let mut lengths = BTreeSet::new();
    words.extend(short.filter(|bytes| lengths.insert(bytes.len()) && bytes.len() <= 64));
    words
}
