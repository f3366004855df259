//! `ads-cnc run --target` against devices with faults, and targets that are not CNCs.

use std::io::{Read as _, Write as _};
use std::net::SocketAddr;
use std::thread;

use crate::common::Serve;
use crate::common::file::TestFile;
use crate::common::{ads_cnc, text};
use ads_cnc_conformance::net;
use serde_json::Value;

/// An address on this machine with a port that the system chooses.
fn loopback() -> SocketAddr {
    SocketAddr::from(([127, 0, 0, 1], 0))
}

/// A run against a device with a defect that the suite detects, here of a number of variables,
/// fails.
#[test]
fn a_wrong_device_fails() {
    let serve = Serve::start(&["--defect", "variable-count.count.flip"]);
    let output = ads_cnc(&["run", "--target", &serve.addr, "--net-id", &serve.net_id]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
}

/// The output of a failure contains the reply that violates the clause, and lists the warnings that
/// follow from this failure.
#[test]
fn a_failure_of_a_device_is_shown_by_its_own_reply() {
    let serve = Serve::start(&["--defect", "variable-description.size.flip"]);
    let target = ["run", "--seed", "1", "--target", &serve.addr, "--net-id", &serve.net_id];
    let shown = |only| text(&ads_cnc(&[&target[..], &["--only", only]].concat()).stdout);
    let alone = shown("VAR-8");
    let example = "\n  var-descriptions: V.G.NP[0].V: expected 24 bytes for ";
    assert!(alone.contains(example) && alone.contains("!   12  19 00 00 00"), "{alone}");
    let both = shown("VAR-8,VAR-28");
    assert!(both.contains("1 warning") && !both.contains("\nWARNING"), "{both}");
    let (_, followers) = both.split_once("  follows from it: ").unwrap();
    assert_eq!(followers.matches("var-described-by-name (VAR-28)").count(), 1, "{both}");
}

/// A run against a target that accepts the connection but does not reply ends, and is not a success.
#[test]
fn a_silent_target_is_not_a_success() {
    let listener = net::listen(loopback()).unwrap();
    let addr = listener.local_addr().unwrap().to_string();
    // The thread accepts one connection, and keeps it open without a reply.
    let silent = thread::spawn(move || listener.incoming().take(1).map(Result::unwrap).collect());
    let args = ["run", "--target", &addr, "--net-id", "10.0.0.1.1.1", "--timeout", "20"];
    let output = ads_cnc(&args);
    let open: Vec<std::net::TcpStream> = silent.join().unwrap();
    assert_eq!(open.len(), 1);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains("route"), "{}", text(&output.stderr));
}

/// A target that replies, but is not a CNC or has another NetId, is reported as such and not judged.
#[test]
fn a_target_that_is_not_a_cnc_is_not_judged() {
    let serve = Serve::start(&[]);
    let output = ads_cnc(&["run", "--target", &serve.addr, "--net-id", "1.2.3.4.1.1"]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains("AMS error 0x7"), "{}", text(&output.stderr));

    let listener = net::listen(loopback()).unwrap();
    let addr = listener.local_addr().unwrap().to_string();
    let web = thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        stream.write_all(b"HTTP/1.1 400 Bad Request\r\n\r\n").unwrap();
        // Waits until the tool has read the bytes and closed the connection.
        let _closed = stream.read_to_end(&mut Vec::new());
    });
    let output = ads_cnc(&["run", "--target", &addr, "--net-id", "1.2.3.4.1.1"]);
    web.join().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains("does not use AMS/TCP"), "{}", text(&output.stderr));
}

/// A device that sends wrong frames is judged: only the requirements of frames and services fail,
/// and each failure contains the bytes of a frame.
#[test]
fn broken_frames_fail_the_rule_of_the_frame() {
    for (defect, clauses) in [
        ("ams-tcp-header.reserved.flip", &["ADS-5"][..]),
        ("ams-tcp-header.length.invert", &["ADS-5"]),
        ("ams-header.data_length.zero", &["ADS-5"]),
        ("ams-header.error.flip", &["ADS-5"]),
        ("ams-header.invoke_id.swap", &["ADS-5"]),
        ("cnc.ads.header-big-endian", &["ADS-5"]),
        ("cnc.ads.refused-invoke-id-0", &["ADS-5"]),
        ("read-reply.length.zero", &["ADS-1"]),
        ("cnc.ads.result-missing", &["ADS-1", "ADS-3", "ADS-4"]),
    ] {
        let serve = Serve::start(&["--defect", defect]);
        let file = TestFile::new(".json", b"");
        let target = ["--target", &serve.addr, "--net-id", &serve.net_id];
        // The test would last too long if the run waited for the timeout after each wrong frame.
        let args = ["run", "--timeout", "60000", "--json", file.path()];
        let output = ads_cnc(&[&args[..], &target].concat());
        assert_eq!(output.status.code(), Some(1), "{defect}: {}", text(&output.stderr));
        let report: Value = serde_json::from_slice(&std::fs::read(&file.0).unwrap()).unwrap();
        let cases = report["cases"].as_array().unwrap();
        let mut failed = Vec::new();
        for failure in
            cases.iter().flat_map(|case| case["failures"].as_array().into_iter().flatten())
        {
            if failure["verdict"] == "fail" {
                failed.push(failure["requirement"].as_str().unwrap());
                let received = failure["evidence"]["frame_received"].as_str();
                assert!(received.is_some_and(|bytes| !bytes.is_empty()), "{defect}");
            }
        }
        failed.dedup();
        assert_eq!(failed, clauses, "{defect}");
    }
}

/// A wrong frame is a failure even if no selected case is about frames.
#[test]
fn broken_frames_fail_in_every_selection() {
    let serve = Serve::start(&["--defect", "ams-header.invoke_id.zero"]);
    let target = ["--target", &serve.addr, "--net-id", &serve.net_id];
    let output = ads_cnc(&[&["run", "--only", "com-count"][..], &target].concat());
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    assert!(text(&output.stdout).contains("\n  ads-every-frame: "), "{}", text(&output.stdout));
}
