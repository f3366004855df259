//! `ads-cnc explain` as users call it, for example with printed examples of the manual, complete
//! and truncated.

use crate::common::file::TestFile;
use crate::common::text;
use std::io::Write as _;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// Examples that the manual of ADS access prints, copied by hand, with their sections; and frames
/// with such examples.
mod printed {
    /// A description of a variable: section 4.3.2.
    pub(crate) const DESCRIPTION: &str = "02 00 00 02  01 00 00 00  01 00 00 00  02 00 00 00 \
        01 00 00 00  02 00 00 00  56 2e 45 2e 56 61 72 69 61 62 6c 65 5f 33 00";
    /// A descriptor of a COM object: section 2.1.1.
    pub(crate) const DESCRIPTOR: &str = "52 00 00 00  01 00 00 00  00 00  00 00  01 01 12 00 \
        03 00 00 00  6d 63 5f 61 63 74 69 76 65 5f 73 69 6e 67 6c 65 5f 62 6c 6f 63 6b 5f 72 \
        00 00 00 00 00 00 00 00  42 4f 4f 4c 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 \
        00 00 00 00 00 00 00 00 00 00 00 00";
    /// A read by handle: section 4.3.4, second example: handle 0x2001234, no indices.
    pub(crate) const HANDLE_READ: &str = "34 12 00 02  00 00 00 00";
    /// The values that the second example of section 4.3.4 reads: 123 234 345 456 567.
    pub(crate) const VALUES: &str =
        "7b 00 00 00  ea 00 00 00  59 01 00 00  c8 01 00 00  37 02 00 00";
    /// An object address: section 2.2.2, the HLD of channel 1.
    pub(crate) const OBJECT_ADDRESS: &str = "01 33 12 00  00 00 00 00";
    /// The request of section 4.3.3 for the handle of `V.E.vartest`, in a frame from 192.0.2.20.1.1, port
    /// 32768, to 192.0.2.10.1.1, port 552.
    pub(crate) const REQUEST_FRAME: &str = "00 00 3c 00 00 00 \
        c0 00 02 0a 01 01 28 02 c0 00 02 14 01 01 00 80 09 00 04 00 1c 00 00 00 00 00 00 00 07 00 00 00 \
        01 23 12 00 46 00 00 00 04 00 00 00 0c 00 00 00 56 2e 45 2e 76 61 72 74 65 73 74 00";
    /// The reply to `REQUEST_FRAME`, with the handle 0x2000004.
    pub(crate) const REPLY_FRAME: &str = "00 00 2c 00 00 00 \
        c0 00 02 14 01 01 00 80 c0 00 02 0a 01 01 28 02 09 00 05 00 0c 00 00 00 00 00 00 00 07 00 00 00 \
        00 00 00 00 04 00 00 00 04 00 00 02";
}

fn ads_cnc(args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
    command.arg("explain").args(args).env_remove("NO_COLOR").output().unwrap()
}

/// The stdout and stderr of a call, followed by its exit code.
fn shown(args: &[&str]) -> String {
    let output = ads_cnc(args);
    let code = output.status.code().unwrap();
    format!("{}{}exit code {code}\n", text(&output.stdout), text(&output.stderr))
}

#[test]
fn printed_examples() {
    let descriptor = format!("{0} {0}", printed::DESCRIPTOR);
    let frames = format!("{} {}", printed::REQUEST_FRAME, printed::REPLY_FRAME);
    let at = |offset| ["--group", "0x122301", "--offset", offset];
    let cases: [(&str, Vec<&str>); 10] = [
        ("description", [&at("0x45")[..], &["--reply", printed::DESCRIPTION]].concat()),
        (
            "descriptor",
            vec!["--group", "0x130101", "--offset", "0x10", "--reply", printed::DESCRIPTOR],
        ),
        ("descriptors", vec!["--stream", "object-descriptors", &descriptor]),
        ("handle-read", [&at("0x47")[..], &[printed::HANDLE_READ]].concat()),
        (
            "values",
            [
                &at("0x47")[..],
                &["--reply", "--type", "SGN32", "--dimensions", "5", printed::VALUES],
            ]
            .concat(),
        ),
        ("value-untyped", vec!["--stream", "variable-value", "4d 01 00 00"]),
        (
            "object-address",
            vec!["--group", "0x123900", "--offset", "0", "--reply", printed::OBJECT_ADDRESS],
        ),
        ("frames", vec![&frames]),
        (
            "reply-frame",
            vec!["--group", "0x122301", "--offset", "0x46", printed::REPLY_FRAME, "--frame"],
        ),
        (
            "program",
            vec![
                "--group",
                "0x120101",
                "--offset",
                "0x90",
                "4e 31 30 20 47 30 20 58 30 0d 0a 4d 33 30 0d 0a",
            ],
        ),
    ];
    for (name, args) in cases {
        insta::assert_snapshot!(name, shown(&args));
    }
}

#[test]
fn errors_are_marked() {
    let cut = |text: &str, digits: usize| -> String {
        text.chars().filter(|character| *character != ' ').take(digits).collect()
    };
    let description = cut(printed::DESCRIPTION, 20);
    let descriptor = cut(printed::DESCRIPTOR, 60);
    let frame = cut(printed::REQUEST_FRAME, 122);
    let header = cut(printed::REQUEST_FRAME, 34);
    let trailing = format!("{} 00", printed::OBJECT_ADDRESS);
    let lying = printed::REQUEST_FRAME.replacen("1c 00 00 00", "1d 00 00 00", 1);
    let program = "4e 31 30 3a 0d 0a 4e 32 30 20 24 47 4f 54 4f 20 4e 31 30 0d 0a 4e 33 30 20 24 57 48 49 4c 45 20 31 0a";
    let cases: [(&str, &[&str]); 9] = [
        ("cut-description", &["--stream", "variable-description", &description]),
        ("cut-descriptor", &["--stream", "object-descriptor", &descriptor]),
        ("cut-frame", &[&frame]),
        ("cut-header", &["--frame", &header]),
        ("lying-frame", &["--frame", &lying]),
        ("too-many", &["--stream", "variable-handle-read", "01 00 00 02 09 00 00 00 04"]),
        ("trailing", &["--stream", "object-address", &trailing]),
        ("wrong-size", &["--stream", "variable-value", "--type", "REAL64", "00 00 00"]),
        ("bad-program", &["--stream", "program-stream", program]),
    ];
    for (name, args) in cases {
        insta::assert_snapshot!(name, shown(args));
    }
}

/// Addresses of different kinds, such as functions, objects, elements and axes, and an unknown one.
#[test]
fn addresses() {
    let places = [
        ("0x122301", "0x2"),
        ("0x122301", "0x20005"),
        ("0x122301", "0x4c"),
        ("0x120101", "0x10001"),
        ("0x120101", "0x90"),
        ("0x130101", "0"),
        ("0x120201", "1"),
        ("0x21302", "7"),
        ("0x25302", "0"),
        ("0x123300", "0x1000"),
        ("0x123801", "1"),
        ("0xf081", "3"),
    ];
    let all: Vec<String> = places
        .iter()
        .map(|(group, offset)| shown(&["--group", group, "--offset", offset]))
        .collect();
    insta::assert_snapshot!("addresses", all.join("\n"));
}

#[test]
fn wrong_usage_is_rejected() {
    for (args, says) in [
        (&["01 0g"][..], "line 1, column 5: 'g' is not a hex digit"),
        (&["--stream", "variable-handle", "1"], "a byte must have two hex digits"),
        (&["--stream", "variable-handel", "00"], "no stream has the name variable-handel"),
        (&["04 00 00 02"], "--group NUMBER --offset NUMBER"),
        (&["04 00 00 02"], "variable-handle"),
        (&[], "no bytes are given"),
        (&["--group", "0x122301", "00"], "--offset"),
        (&["--group", "12g", "--offset", "1", "00"], "a number of 32 bits"),
        (&["--stream", "content", "--type", "TIME", "00"], "no type is called TIME"),
        (&["--file", "no/such/file", "--frame"], "no/such/file"),
    ] {
        let output = ads_cnc(args);
        let stderr_text = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {stderr_text}");
        assert!(stderr_text.contains(says), "{args:?}: {stderr_text}");
        assert!(output.stdout.is_empty(), "{args:?}");
    }
    // An unknown address is not explained, but is not an error either: exit code 3.
    let unknown = ads_cnc(&["--group", "0xf005", "--offset", "0", "00"]);
    assert_eq!(unknown.status.code(), Some(3));
}

/// The same bytes have the same explanation from an argument, from stdin in hex and in binary, and from
/// a file.
#[test]
fn all_inputs_give_the_same_result() {
    let bytes = [0x34, 0x12, 0, 2, 0, 0, 0, 0];
    let stdin = |args: &[&str], given: &[u8]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
        command.args(["explain", "--stream", "variable-handle-read"]).args(args);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(given).unwrap();
        text(&child.wait_with_output().unwrap().stdout)
    };
    let file = TestFile::new("", &bytes);
    let from_file =
        text(&ads_cnc(&["--stream", "variable-handle-read", "--file", file.path()]).stdout);
    let from_hex =
        text(&ads_cnc(&["--stream", "variable-handle-read", printed::HANDLE_READ]).stdout);
    assert!(from_hex.contains("33559092 (0x2001234)"), "{from_hex}");
    assert_eq!(from_file, from_hex);
    assert_eq!(stdin(&["-"], b"0x34, 0x12\n00:02\n00000000\n"), from_hex);
    assert_eq!(stdin(&["--file", "-"], &bytes), from_hex);
    assert_eq!(stdin(&["--file", "-", "--hex"], b"3412000200000000"), from_hex);
}

/// An empty file is an error, although some streams may be empty.
#[test]
fn an_empty_file_is_an_error() {
    let output = ads_cnc(&["--file", if cfg!(windows) { "NUL" } else { "/dev/null" }]);
    let why = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{why}");
    assert!(why.starts_with("ads-cnc: no bytes are given\n"), "{why}");
}

/// Output to a pipe contains no escape sequences. With colour, the explained bytes still cannot add
/// escape sequences.
#[test]
fn colour_is_only_for_terminals() {
    let args = ["--stream", "element-text", "1b 5b 32 4a 00"];
    assert!(!ads_cnc(&args).stdout.contains(&0x1B));
    let coloured = ads_cnc(&[&args[..], &["--color", "always"]].concat()).stdout;
    let coloured = text(&coloured);
    assert!(coloured.contains("\u{1b}[1m") && coloured.contains("\\u{1b}[2J"), "{coloured}");
    assert!(!coloured.contains("\u{1b}[2J"));
}

#[test]
fn json_contains_the_same_data() {
    let frames = format!("{} {}", printed::REQUEST_FRAME, printed::REPLY_FRAME);
    let output = ads_cnc(&[&frames, "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let parts = document["parts"].as_array().unwrap();
    let handle = parts.last().unwrap();
    assert_eq!(handle["stream"], "variable-handle");
    assert_eq!(handle["at"], 112);
    assert_eq!(handle["address"]["function"]["effect"], "query");
    assert_eq!(handle["rows"][0]["value"], "33554436 (0x2000004)");
}

#[test]
fn all_streams_are_listed() {
    let listed = text(&ads_cnc(&["--list"]).stdout);
    let names: Vec<&str> = listed.lines().filter_map(|line| line.split(' ').next()).collect();
    let all: Vec<&str> = ads_cnc::layout::Stream::all().map(|one| one.layout().name).collect();
    assert_eq!(names, all);
}

#[test]
fn a_long_input_is_rejected() {
    let file = TestFile::new(".bin", &vec![0; 0x10_0001]);
    let output = ads_cnc(&["--frame", "--file", file.path()]);
    assert_eq!(output.status.code(), Some(2));
    let why = text(&output.stderr);
    assert!(why.contains("expected at most 1048576 bytes, found more"), "{why}");
}
