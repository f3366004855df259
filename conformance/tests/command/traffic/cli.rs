//! `ads-cnc check` and `--capture` as users call them.

use crate::common::file::TestFolder;
use crate::common::{ads_cnc, check_schema, text};
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::maker::{Link, pcap, segments};
use super::talk::{conversation, everything};

/// `check` passes the captured traffic of the commands `browse`, `get`, `set` and `stream`.
#[test]
fn the_traffic_of_commands_passes() {
    let folder = TestFolder::new();
    let program = folder.file("program.nc");
    fs::write(&program, "N10 G01 X100 F1000\n".repeat(200) + "N20 M30\n").unwrap();
    let calls: [&[&str]; 5] = [
        &["browse", "--content"],
        &["browse", "--variables"],
        &["get", "V.E.Testvar"],
        &["set", "V.E.Testvar[1]", "7"],
        &["stream", &program],
    ];
    for (place, call) in calls.into_iter().enumerate() {
        let file = folder.file(&format!("{place}.pcapng"));
        let said = ads_cnc(&[call, &["--capture", &file]].concat());
        assert_eq!(said.status.code(), Some(0), "{call:?}: {}", text(&said.stderr));
        let checked = ads_cnc(&["check", "--any-port", &file]);
        let shown = text(&checked.stdout);
        assert_eq!(checked.status.code(), Some(0), "{call:?}: {shown}");
        assert!(!shown.contains("DIFFERS") && !shown.contains("WARNING"), "{call:?}: {shown}");
    }
    // The simulated CNC listens on a port that the system chooses, and the check finds it.
    let found = ads_cnc(&["check", &folder.file("2.pcapng")]);
    let note = "judging the connections at other ports, as with --any-port";
    assert!(text(&found.stderr).contains(note), "{}", text(&found.stderr));
    assert_eq!(found.status.code(), Some(0));
    let streamed = text(&ads_cnc(&["check", "--any-port", "-v", &folder.file("4.pcapng")]).stdout);
    let line = "pass            cap-client-stream: The client streams whole lines and sends rejected data again";
    assert!(streamed.contains(line), "{streamed}");
}

/// A capture that cannot be written completely is an error.
#[cfg(target_os = "linux")]
#[test]
fn an_incomplete_capture_is_an_error() {
    let calls: [&[&str]; 3] = [&["get", "V.E.Testvar"], &["browse"], &["run", "--only", "COM-1"]];
    for call in calls {
        let said = ads_cnc(&[call, &["--capture", "/dev/full"]].concat());
        assert_eq!(said.status.code(), Some(70), "{call:?}: {}", text(&said.stderr));
        assert!(text(&said.stderr).contains("/dev/full: "), "{call:?}: {}", text(&said.stderr));
    }
}

/// The console and the HTML and Markdown reports state that a part of the conversation is missing.
#[test]
fn every_report_states_missing_traffic() {
    let folder = TestFolder::new();
    let (file, page, note) =
        (folder.file("cut.pcapng"), folder.file("cut.html"), folder.file("cut.md"));
    let said = ads_cnc(&["get", "V.E.matrix", "--capture", &file]);
    assert_eq!(said.status.code(), Some(0));
    let whole = fs::read(&file).unwrap();
    fs::write(&file, &whole[..whole.len() - 70]).unwrap();
    let checked =
        ads_cnc(&["check", "--any-port", "-q", &file, "--html", &page, "--markdown", &note]);
    let shown = text(&checked.stdout);
    let why = "the file was judged only in part";
    assert!(shown.starts_with(&format!("note: {why}")), "{shown}");
    assert_eq!(shown.lines().count(), 2, "{shown}");
    for file in [page, note] {
        let report = fs::read_to_string(file).unwrap();
        assert!(report.contains("Traffic") && report.contains(why));
    }
}

/// The list of exchanges contains the requested names and the values of replies.
#[test]
fn exchanges_have_names_and_values() {
    let folder = TestFolder::new();
    let file = folder.file("list.pcapng");
    let shown = |name: &str| {
        ads_cnc(&["get", name, "--capture", &file]);
        text(&ads_cnc(&["check", "--any-port", &file]).stdout)
    };
    let value = "read variable value by name V.E.matrix: 0b 00 0c 00 0d 00 15 00 16 00 17 00\n";
    assert!(shown("V.E.matrix").contains(value));
    let rejected = "read variable value by name V.E.none: ADS error 0x710 (no such name)\n";
    assert!(shown("V.E.none").contains(rejected));
}

/// A name in a capture is escaped on the console and in every report that is shown as text or markup.
#[test]
fn texts_of_a_capture_are_escaped() {
    let folder = TestFolder::new();
    let files = ["x.pcapng", "x.html", "x.md", "x.xml"].map(|name| folder.file(name));
    let [file, page, note, junit] = &files;
    ads_cnc(&["get", "V.E.a\u{1b}c<img src=x>", "--capture", file]);
    let forms = ["--html", page, "--markdown", note, "--junit", junit];
    let checked = ads_cnc(&[&["check", "--any-port", file], &forms[..]].concat());
    let console = text(&checked.stdout);
    assert!(console.contains("by name V.E.a\\u{1b}c<img src=x>: "), "{console}");
    let reports = [page, note, junit].map(|file| fs::read_to_string(file).unwrap());
    assert!(reports[0].contains("V.E.a\\u{1b}c&lt;img src=x&gt;: "), "{}", reports[0]);
    assert!(reports.iter().all(|report| !report.contains("<img")), "{reports:?}");
    let acts = |one: char| one.is_control() && one != '\n';
    assert!(!console.contains(acts) && reports.iter().all(|report| !report.contains(acts)));
}

/// The HTML and JSON reports contain the exchanges, and the notes about the traffic that `check` prints
/// to stderr.
#[test]
fn reports_contain_the_exchanges_and_notes() {
    let folder = TestFolder::new();
    let files = ["x.pcapng", "x.html", "x.json"].map(|name| folder.file(name));
    let [file, page, report] = &files;
    ads_cnc(&["get", "V.E.matrix", "--capture", file]);
    let checked = ads_cnc(&["check", file, "--html", page, "--json", report]);
    assert_eq!(checked.status.code(), Some(0), "{}", text(&checked.stderr));
    for file in [page, report] {
        let content = fs::read_to_string(file).unwrap();
        for part in
            ["read variable value by name V.E.matrix: 0b 00 ", "no AMS frame at TCP port 48898"]
        {
            assert!(content.contains(part), "{file}: {part}");
        }
    }
    let report: Value = serde_json::from_str(&fs::read_to_string(report).unwrap()).unwrap();
    check_schema(&report, "report");
}

/// A file that cannot be created is wrong usage, not an internal error.
#[test]
fn a_capture_needs_an_existing_folder() {
    let folder = TestFolder::new();
    let file = folder.file("none/x.pcapng");
    for command in [&["get", "V.E.Testvar"][..], &["run", "--only", "COM-1"]] {
        let said = ads_cnc(&[command, &["--capture", &file]].concat());
        let why = text(&said.stderr);
        assert!(said.status.code() == Some(2) && why.contains(&file), "{why}");
    }
}

/// The suite sends requests that no client should send. Therefore, `check` judges only the CNC in its
/// traffic, unless the user also selects the client.
#[test]
fn the_suite_fails_as_a_client() {
    let folder = TestFolder::new();
    let (file, report) = (folder.file("run.pcapng"), folder.file("report.json"));
    let run = ads_cnc(&["run", "--only", "VAR", "--only", "COM", "--capture", &file]);
    assert_eq!(run.status.code(), Some(0));
    let checked = ads_cnc(&["check", "--any-port", &file]);
    assert_eq!(checked.status.code(), Some(0), "{checked:?}");
    assert!(text(&checked.stderr).contains("the requests are the suite's own"), "{checked:?}");
    let checked = ads_cnc(&["check", "--any-port", &file, "--own-requests", "--json", &report]);
    assert_eq!(checked.status.code(), Some(1));
    let report: Value = serde_json::from_str(&fs::read_to_string(&report).unwrap()).unwrap();
    let totals = |subject: &str| {
        let all = report["subjects"].as_array().unwrap();
        all.iter().find(|one| one["subject"] == subject).unwrap()["totals"].clone()
    };
    assert!(totals("captured-cnc")["fail"].is_null(), "{}", totals("captured-cnc"));
    assert!(totals("captured-client")["fail"].as_u64() > Some(3));
    assert_eq!(report["target"]["file"], *file);
    check_schema(&report, "report");
}

/// `check` extracts vectors without addresses from a capture, and overwrites no file; `extracted.rs`
/// checks the schema.
#[test]
fn vectors_are_extracted() {
    let folder = TestFolder::new();
    let (file, vectors) = (folder.file("a.pcap"), folder.file("vectors.json"));
    let talk = conversation(None, everything);
    fs::write(&file, pcap(&segments(&talk, 1460, (1, 1)), Link::Ethernet)).unwrap();
    let extract = |place: &str, more: &[&str]| {
        ads_cnc(&[&["check", &file, "--extract-vectors", place], more].concat())
    };
    let first = extract(&vectors, &[]);
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    let content = fs::read_to_string(&vectors).unwrap();
    let document: Value = serde_json::from_str(&content).unwrap();
    let all = document["vectors"].as_array().unwrap();
    let streams = |name: &str| all.iter().filter(|one| one["stream"] == name).count();
    assert!(streams("variable-description") > 5 && streams("ams-frame") > 50, "{}", all.len());
    assert!(
        streams("variable-value") > 3
            && streams("object-descriptor") + streams("object-descriptors") > 3
    );
    // The vectors contain neither the NetIds of the conversation nor a requested name.
    assert!(content.contains("192.0.2.10.1.1") && !content.contains("127.0.0.1"));
    assert!(!content.contains("Testvar") && content.contains("V.E.Xxxxxxx"));
    // The tool does not overwrite the file.
    let again = extract(&vectors, &[]);
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("vectors could not be written"));
    assert!(again.stdout.is_empty(), "the file is found before the capture is read");
    assert_eq!(fs::read_to_string(&vectors).unwrap(), content);
    // Vectors can be written to a folder, with the original texts.
    let into = folder.file("folder");
    fs::create_dir(&into).unwrap();
    assert_eq!(extract(&into, &["--keep-texts"]).status.code(), Some(0));
    let names = fs::read_to_string(Path::new(&into).join("captured-variable-name.json")).unwrap();
    assert!(names.contains("V.E.Testvar"));
    // If a file in the folder exists, the result of the check is shown nevertheless.
    let again = extract(&into, &[]);
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("captured-"), "{}", text(&again.stderr));
    assert!(text(&again.stdout).contains("\nPASSED"), "{}", text(&again.stdout));
}

#[test]
fn a_file_that_is_not_a_capture_is_wrong_usage() {
    let folder = TestFolder::new();
    let file = folder.file("none.pcap");
    let rejected = |file: &str, why: &str| {
        let checked = ads_cnc(&["check", file]);
        assert_eq!(checked.status.code(), Some(2));
        assert!(text(&checked.stderr).contains(why), "{}", text(&checked.stderr));
    };
    rejected(&file, "No such file");
    fs::write(&file, "").unwrap();
    rejected(&file, "empty");
    fs::write(&file, "N10 G01 X100\n".repeat(10)).unwrap();
    rejected(&file, "neither pcap nor pcapng");
    // An empty capture is not a success, because nothing is judged.
    fs::write(&file, pcap(&[], Link::Ethernet)).unwrap();
    let checked = ads_cnc(&["check", &file]);
    assert_eq!(checked.status.code(), Some(3), "{}", text(&checked.stdout));
}
