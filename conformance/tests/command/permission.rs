//! The writes that a file for `--allow-write` permits, and the expiry of the file. The tests run the
//! commands as a user does.

use std::collections::BTreeSet;
use std::process::Output;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use crate::common::fake::{Answer, fake};
use crate::common::file::TestFile;
use crate::common::proxy::{FrameHandling, is_write, proxy};
use crate::common::{Serve, ads_cnc, text};
use ads_cnc::ads::{AdsError, Command as AdsCommand};
use ads_cnc_conformance::gate::Moment;

fn against(addr: &str, args: &[&str]) -> Output {
    ads_cnc(&[args, &["--target", addr, "--net-id", "127.0.0.1.1.1"]].concat())
}

/// A file for `--allow-write` that expires after `seconds`.
fn expiring(table: &str, seconds: u64) -> TestFile {
    let at = Moment::now().after(Duration::from_secs(seconds));
    let head = format!("target = \"127.0.0.1.1.1\"\nexpires = {at}\n");
    TestFile::new(".toml", format!("{head}{table}").as_bytes())
}

const VARIABLE: &str = "[[variable]]\nchannel = 1\nname = \"V.E.vartest\"\n";

/// Entries with another name, another channel, a rank or an axis, and entries of another kind, do
/// not permit a write of the variable by its channel number and name.
#[test]
fn other_entries_permit_nothing() {
    let cnc = Serve::start(&[]);
    let names = [
        "v.e.vartest",
        "V.E.VARTEST",
        "V.E.vartes",
        "V.E.vartest2",
        "V.E.vartest ",
        " V.E.vartest",
        "V.E.vartest.",
        "V.E.vartest.x",
        "V.E.vartest[0]",
        "V.E.vartest[",
        "V.E.vartest\\u0000",
        "V.E.vartest\\u0000x",
        "\\uFEFFV.E.vartest",
        "V.E.var?est",
        "V.E.*",
        "V.E.",
        "V.E",
        "V.",
        "*",
        "",
        ".*",
        "V.G.vartest",
        "vartest",
    ];
    let of = |name: &str| format!("[[variable]]\nchannel = 1\nname = \"{name}\"\n");
    let mut tables: Vec<String> = names.iter().map(|name| of(name)).collect();
    for at in ["channel = 2", "rank = 1", "channel = 1\naxis = 1"] {
        tables.push(format!("[[variable]]\n{at}\nname = \"V.E.vartest\"\n"));
    }
    for kind in ["object", "stream", "service"] {
        let name = if kind == "object" { "name = \"V.E.vartest\"\n" } else { "" };
        tables.push(format!("[[{kind}]]\nchannel = 1\n{name}"));
    }
    for table in &tables {
        let file = TestFile::allowing(table);
        let set = ["set", "V.E.vartest", "1", "--allow-write", file.path()];
        let rejected = against(&cnc.addr, &set);
        // Some entries contain an invalid name, so that the whole file is rejected.
        assert!(matches!(rejected.status.code(), Some(2 | 4)), "{table}: {rejected:?}");
        assert!(!rejected.stderr.is_empty(), "{table}");
        let value = against(&cnc.addr, &["get", "V.E.vartest"]);
        assert!(text(&value.stdout).contains("4711"), "{table}: {}", text(&value.stdout));
    }
    let file = TestFile::allowing(VARIABLE);
    let set = against(&cnc.addr, &["set", "V.E.vartest", "1", "--allow-write", file.path()]);
    assert_eq!(set.status.code(), Some(0), "{}", text(&set.stderr));
}

/// A file for `--allow-write` that does not exist is wrong usage, even for a command without a target.
#[test]
fn a_missing_file_is_an_error() {
    let program = TestFile::new(".nc", b"N10 G01 X1\r\n");
    let commands: [&[&str]; 4] = [
        &["run", "--list"],
        &["set", "V.E.vartest", "1"],
        &["stream", program.path()],
        &["service", "--uuid", "8d7bb24e-4ca5-4d36-8a60-6b9b4d39fb0e", "--", "true"],
    ];
    for command in commands {
        let (name, rest) = command.split_first().unwrap();
        let ended = ads_cnc(&[&[*name, "--allow-write", "/no/such/file.toml"], rest].concat());
        assert_eq!(ended.status.code(), Some(2), "{command:?}: {}", text(&ended.stderr));
        assert!(text(&ended.stderr).contains("/no/such/file.toml"), "{}", text(&ended.stderr));
    }
}

/// `stream` ends when its file expires, and reports the lines that the CNC accepted.
#[test]
fn a_stream_ends_when_its_file_expires() {
    let packets = Arc::new(Mutex::new(0));
    let count = Arc::clone(&packets);
    let addr = fake(move |_, _| {
        *count.lock().unwrap() += 1;
        thread::sleep(Duration::from_millis(400));
        Answer::Result(AdsError::NO_ERROR)
    });
    // A program of 16 packets.
    let program: String = (0..1000).map(|line| format!("N{line}0 G01 X{line}\n")).collect();
    let (program, file) = (TestFile::new(".nc", program.as_bytes()), expiring(STREAM, 3));
    let args = ["stream", program.path(), "--allow-write", file.path()];
    let ended = against(&addr.to_string(), &args);
    let stderr_text = text(&ended.stderr);
    assert_eq!(ended.status.code(), Some(4), "{stderr_text}");
    assert!(stderr_text.contains("the file of --allow-write expired at "), "{stderr_text}");
    let packets = *packets.lock().unwrap();
    assert!((2..10).contains(&packets), "{packets}");
    let shown = text(&ended.stdout);
    assert!(shown.contains("accepted lines 1 to "), "{shown}");
    assert!(shown.ends_with(" to 1000\n") && shown.contains("not sent or not accepted"), "{shown}");
}

/// Before each further value, the time until the expiry must suffice to restore all changed values:
/// here, it suffices for one value.
#[test]
fn the_time_to_restore_is_that_of_all_changed_values() {
    let (cnc, file) = (Serve::start(&[]), expiring("[[service]]\nchannel = 1\n", 200));
    let run = ["run", "--only", "service-response", "--timeout", "1000"];
    let ended = against(&cnc.addr, &[&run[..], &["--allow-write", file.path()]].concat());
    let shown = text(&ended.stdout);
    assert!(shown.contains("service-response: restoring 2 values may take 256 s"), "{shown}");
    assert_eq!(ended.status.code(), Some(4), "{shown}");
}

/// A write that waits for its turn until the file has expired is not sent.
#[test]
fn a_write_that_waited_for_too_long_is_not_sent() {
    let (cnc, file) = (Serve::start(&[]), expiring(VARIABLE, 3));
    let get = || text(&against(&cnc.addr, &["get", "V.E.vartest"]).stdout);
    let before = get();
    let set = ["set", "V.E.vartest", "77", "--type", "SGN16", "--rate", "0.2"];
    let ended = against(&cnc.addr, &[&set[..], &["--allow-write", file.path()]].concat());
    let stderr_text = text(&ended.stderr);
    assert_eq!(ended.status.code(), Some(4), "{stderr_text}");
    assert!(stderr_text.contains("the file of --allow-write expired at "), "{stderr_text}");
    assert!(!before.is_empty() && get() == before, "{before}");
}

/// If the value cannot be read back after the write, `set` prints that the value was written.
#[test]
fn a_written_value_that_cannot_be_read_back_is_reported() {
    let (cnc, file) = (Serve::start(&[]), TestFile::allowing(VARIABLE));
    let mut is_written = false;
    let addr = proxy(cnc.addr.parse().unwrap(), move |frame| {
        let handling = if is_written { FrameHandling::LoseAnswer } else { FrameHandling::Pass };
        is_written |= is_write(frame);
        handling
    });
    let set = ["set", "V.E.vartest", "77", "--timeout", "300", "--allow-write", file.path()];
    let ended = against(&addr.to_string(), &set);
    let stderr_text = text(&ended.stderr);
    let told = "the value was written, but could not be read back";
    assert!(stderr_text.contains(told), "{stderr_text}");
    assert_eq!(ended.status.code(), Some(3), "{stderr_text}");
}

const STREAM: &str = "[[stream]]\nchannel = 1\n";

/// No value is changed if the time until the expiry may not suffice to restore it.
#[test]
fn nothing_is_changed_shortly_before_the_file_expires() {
    let (cnc, json) = (Serve::start(&[]), TestFile::new(".json", b""));
    let file = expiring(VARIABLE, 60);
    let addr = proxy(cnc.addr.parse().unwrap(), |frame| {
        // A write of 4711 changes nothing, because the value is 4711.
        let changes = is_write(frame) && !frame.data().ends_with(&4711_u16.to_le_bytes());
        if changes { FrameHandling::Reject } else { FrameHandling::Pass }
    });
    let run = ["run", "--seed", "1", "--only", "write-by-name", "--timeout", "1000"];
    let rest = ["--allow-write", file.path(), "--json", json.path()];
    let ended = against(&addr.to_string(), &[&run[..], &rest].concat());
    assert_eq!(ended.status.code(), Some(4), "{}", text(&ended.stdout));
    // The line before the last line contains the reason for the exit code.
    let shown = text(&ended.stdout);
    let above = shown.lines().rev().nth(1).unwrap();
    assert!(
        above.starts_with("REJECTED  write-by-name: restoring 1 value may take 128 s"),
        "{shown}"
    );
    let report = std::fs::read_to_string(&json.0).unwrap();
    assert!(report.contains("restoring 1 value may take 128 s, and the file"), "{report}");
    assert!(!report.contains("\"fail\""), "{report}");
}

const PROFILE: &str = r#"
name = "<script>\u001b[2J"
edition = "de-1.051"
ports = [551, 552, 553]
channels = [1, 255, 254, 2, 3]
absent-channel = 7
platform-axes = 255
spindles = 255
empty-places = [[1, 255], [255, 1]]
kinds = ["V.G", "V.E", "V.A"]
by-name-only = ["V.E.vartest", "V.E.test", "V.E.no_such"]
printed-examples = true
unwritten = []
"#;

/// Whatever a profile claims, the run only sends queries, and only to the ports of a CNC's tasks.
#[test]
fn a_hostile_profile_causes_no_write() {
    let cnc = Serve::start(&[]);
    let seen = Arc::new(Mutex::new(BTreeSet::new()));
    let keep = Arc::clone(&seen);
    let addr = proxy(cnc.addr.parse().unwrap(), move |frame| {
        let header = frame.header();
        keep.lock().unwrap().insert((header.command.0, header.target.port.0));
        FrameHandling::Pass
    });
    let profile = TestFile::new(".toml", PROFILE.as_bytes());
    let run = ["run", "--seed", "1", "--profile", profile.path(), "--deadline", "60"];
    let ended = against(&addr.to_string(), &run);
    assert!(matches!(ended.status.code(), Some(1 | 3)), "{}", text(&ended.stderr));
    let seen = seen.lock().unwrap();
    assert!(seen.len() > 5, "{seen:?}");
    for (command, port) in seen.iter() {
        // Queries by name use ReadWrite. Whether a ReadWrite is a query is tested by the tests of the
        // gate.
        let reads = [AdsCommand::READ_DEVICE_INFO, AdsCommand::READ, AdsCommand::READ_STATE];
        let asks = reads.iter().any(|read| read.0 == *command);
        assert!(asks || *command == AdsCommand::READ_WRITE.0, "{seen:?}");
        assert!((551..=553).contains(port), "{seen:?}");
    }
}
