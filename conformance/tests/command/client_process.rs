//! Clients as processes: clients that run for the whole run or are started for each action, that crash or
//! hang, and clients that connect by themselves.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::process::{Command, Stdio};

use crate::common::ads_cnc;
use crate::common::connect;
use crate::common::file::TestFile;
use ads_cnc_conformance::client_suite::{
    Action, ClientHello, ClientReaction, ClientUnderTest, CncAddress, ReferenceClient, TestServer,
    judge,
};
use ads_cnc_conformance::judge::Verdict;
use serde_json::Value;

/// Runs the suite with this project's client; returns the exit code and the report.
fn run(options: &str, args: &[&str]) -> (Option<i32>, Value) {
    let client = format!("\"{}\" client {options}", env!("CARGO_BIN_EXE_ads-cnc"));
    let output = ads_cnc(&[&["run", "--client", &client, "--json", "-"], args].concat());
    let report = serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
        panic!("{error}: {}", String::from_utf8_lossy(&output.stderr));
    });
    (output.status.code(), report)
}

/// The failures of a case: the requirement, what was found, and the evidence.
fn failures(report: &Value, id: &str) -> Vec<(String, String, Value)> {
    let cases = report["cases"].as_array().unwrap();
    let case = cases.iter().find(|case| case["id"] == id).unwrap();
    let failed = case["failures"].as_array().into_iter().flatten();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    failed
        .filter(|one| one["verdict"] == "fail")
        .map(|one| (text(&one["requirement"]), text(&one["found"]), one["evidence"].clone()))
        .collect()
}

#[test]
fn a_running_client_passes_everything() {
    let (code, report) = run("", &[]);
    assert_eq!(code, Some(0), "{report:#}");
    assert_eq!(report["target"]["name"], "ads-cnc");
    assert_eq!(report["target"]["language"], "Rust");
    assert_eq!(report["subjects"][0]["subject"], "client");
    assert!(report["frames"].as_u64().unwrap() > 200);
}

/// After the maximum number of failed cases (`--max-fail`), the other scenarios are not run, and
/// the report states this reason.
#[test]
fn a_run_of_a_client_ends_after_enough_failures() {
    let (code, report) = run("--defect client.error-set", &["--seed", "1", "--max-fail", "2"]);
    assert_eq!(code, Some(1), "{report:#}");
    let ended = report["ended"].as_str().unwrap();
    assert!(ended.ends_with(" not run after 2 failed cases (--max-fail)"), "{ended}");
    let cases = report["cases"].as_array().unwrap().iter();
    let failed = cases.filter(|case| case["verdict"] == "fail" && case["id"] != "client-manners");
    assert_eq!(failed.count(), 2);
}

/// If a client or testee does not answer hello, or a client misspells an action in its answer, the
/// output is only a few lines.
#[test]
fn a_failed_start_is_reported_briefly() {
    let hello = r#"{"protocol":1,"client":{"name":"x"},"actions":["read-by-nam"]}"#;
    for (option, command, parts) in [
        ("--client", format!("echo '{hello}'"), ["\"read-by-nam\"", "did you mean read-by-name"]),
        (
            "--client",
            "echo gone >&2; exit 7".to_owned(),
            ["exit status: 7", "its stderr ends with: \"gone\""],
        ),
        ("--testee", "echo gone >&2; exit 7".to_owned(), ["exit status: 7", "--check-protocol"]),
        // The exit status decides the advice, whatever the command writes.
        (
            "--testee",
            "echo no answer within 127.0.0.1 >&2; exit 7".to_owned(),
            ["exit status: 7", "Check that the command runs by itself"],
        ),
        ("--client", "exit 127".to_owned(), ["exit status: 127", "Check that the shell finds"]),
    ] {
        let output = ads_cnc(&["run", option, &command]);
        let shown = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(1), "{shown}");
        assert!(parts.iter().all(|part| shown.contains(part)), "{shown}");
        assert!(shown.lines().count() <= 8, "{shown}");
    }
    // `--check-protocol` is only for testees.
    let output = ads_cnc(&["run", "--client", "exit 7", "--check-protocol"]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
}

#[test]
fn a_client_started_for_each_action_passes() {
    let (code, report) = run("--once", &["--only", "VAR-14", "--only", "STM"]);
    assert_eq!(code, Some(0), "{report:#}");
    assert!(report["cases"].as_array().unwrap().len() > 30);
}

/// The failure of a client that crashed contains the bytes that the client received last, and the run
/// continues.
#[test]
fn a_crash_is_reported_with_its_bytes() {
    for options in ["--defect client.dies", "--once --defect client.dies"] {
        let (code, report) = run(options, &["--only", "ADS-3"]);
        assert_eq!(code, Some(1));
        let failed = failures(&report, "client-name-data-length-huge");
        let (_, found, evidence) = failed.iter().find(|(id, ..)| id == "ADS-3").unwrap();
        assert!(found.starts_with("it died: "), "{found}");
        let bytes = evidence["frame_received"].as_str().unwrap();
        assert!(bytes.contains("ff ff ff ff"), "{evidence:#}");
        let others = report["cases"].as_array().unwrap().iter();
        assert!(others.filter(|case| case["verdict"] == "pass").count() > 50);
    }
}

/// The traffic of a client can be captured, and `check` detects the same error in the capture.
#[test]
fn the_traffic_of_a_client_is_captured() {
    let file = TestFile::new(".pcapng", b"");
    let only = ["--only", "client-handle", "--capture", file.path()];
    let (code, report) = run("--defect client.port", &only);
    assert_eq!(code, Some(1), "{report:#}");
    let checked = ads_cnc(&["check", file.path(), "--any-port", "--json", "-"]);
    let report: Value = serde_json::from_slice(&checked.stdout).unwrap();
    let cases = report["cases"].as_array().unwrap().iter();
    let found = cases.flat_map(|case| case["failures"].as_array().into_iter().flatten());
    let mut found = found.map(|failure| failure["requirement"].as_str().unwrap());
    assert!(found.any(|id| id == "GEN-4"), "{report:#}");
}

/// If a client prints a line that is not an answer, only the requirement of the protocol fails.
#[test]
fn an_invalid_answer_fails_only_the_protocol() {
    let (code, report) = run("--defect client.garbles", &["--only", "VAR-14"]);
    assert_eq!(code, Some(1), "{report:#}");
    let cases = report["cases"].as_array().unwrap().iter();
    let all = cases.flat_map(|case| case["failures"].as_array().into_iter().flatten());
    let failed: Vec<&Value> = all.filter(|one| one["verdict"] == "fail").collect();
    assert!(!failed.is_empty());
    assert!(failed.iter().all(|one| one["requirement"] == "CLIENT"), "{failed:#?}");
}

/// If a request goes to the wrong port, the requirement of the port (GEN-4) is the first that fails,
/// and the requirement of the result is inconclusive.
#[test]
fn a_result_follows_from_the_request() {
    let (_, report) = run("--defect client.port", &["--only", "client-read-real"]);
    let failed = failures(&report, "client-read-real");
    let ids: Vec<&str> = failed.iter().map(|(id, ..)| id.as_str()).collect();
    assert_eq!(ids[..1], ["GEN-4"], "{report:#}");
    let case = &report["cases"].as_array().unwrap()[0];
    let real = case["requirements"].as_array().unwrap().iter();
    let mut real = real.filter(|one| one["requirement"] == "GEN-1");
    assert_eq!(real.next().unwrap()["verdict"], "inconclusive", "{case:#}");
}

#[test]
fn a_hanging_client_is_reported_and_ended() {
    let (code, report) = run(
        "--defect client.hangs",
        &[
            "--only",
            "client-name-silence",
            "--only",
            "client-name-more",
            "--client-timeout",
            "1500",
        ],
    );
    assert_eq!(code, Some(1));
    let failed = failures(&report, "client-name-silence");
    assert!(failed.iter().any(|(id, found, _)| id == "CLIENT" && found.starts_with("it hung")));
    assert!(failures(&report, "client-name-more").is_empty());
}

/// A client may need longer to start than the time limit of an action.
#[cfg(unix)]
#[test]
fn hello_has_time_to_start() {
    let client = format!("sleep 2; exec \"{}\" client", env!("CARGO_BIN_EXE_ads-cnc"));
    let only = ["--only", "client-name-more", "--client-timeout", "1500"];
    let output = ads_cnc(&[&["run", "--client", &client, "--json", "-"][..], &only].concat());
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{report:#}");
}

/// A client that prints two lines for an action fails the protocol, whether it is started once or for
/// each action.
#[cfg(unix)]
#[test]
fn a_second_line_is_reported() {
    let told = |stays: bool, said: &str| {
        let hello = format!(
            r#"{{"protocol":1,"client":{{"name":"sh"}},"actions":["read-by-name"],"stays":{stays}}}"#
        );
        let hello = format!("printf '%s\\n' '{hello}'");
        let client = match stays {
            true => format!("{hello}; while read l; do test \"$l\" = '{BYE}' || {said}; done"),
            false => format!("test $ADS_CNC_DO = hello && {hello} || {said}"),
        };
        let only = ["--only", "client-name-more", "--only", "client-name-closed"];
        let output = ads_cnc(&[&["run", "--client", &client, "--json", "-"][..], &only].concat());
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        let failed = failures(&report, "client-manners").into_iter();
        failed.map(|(_, found, _)| found).collect::<Vec<_>>()
    };
    let [one, two] = ["echo '{\"error\":\"x\"}'", "printf '{\"error\":\"x\"}\\nmore\\n'"];
    for stays in [false, true] {
        assert_eq!(told(stays, one), [""; 0], "stays: {stays}");
        assert_eq!(told(stays, two), ["the additional line \"more\""; 2], "stays: {stays}");
    }
}

/// Runs one action of a client in shell that is started for each action.
#[cfg(unix)]
fn run_action(action: &str, timeout: &str) -> Value {
    let hello = r#"{"protocol":1,"client":{"name":"sh"},"actions":["read-by-name"]}"#;
    let client = format!("if test $ADS_CNC_DO = hello; then echo '{hello}'; else {action}; fi");
    let only = ["--only", "client-name-more", "--client-timeout", timeout];
    let output = ads_cnc(&[&["run", "--client", &client, "--json", "-"][..], &only].concat());
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The time limit of an action includes the exit of a client that is started for each action.
#[cfg(unix)]
#[test]
fn a_client_may_exit_until_the_time_limit() {
    let report = run_action("echo '{\"error\":\"x\"}'; sleep 3", "10000");
    let failed = failures(&report, "client-name-more");
    assert!(failed.iter().all(|(id, ..)| id != "CLIENT"), "{failed:?}");
    let report = run_action("echo '{\"error\":\"x\"}'; sleep 60", "1000");
    let failed = failures(&report, "client-name-more");
    let found = "invalid answer: the client did not exit within 2000 ms after it";
    assert!(failed.iter().any(|(id, why, _)| id == "CLIENT" && why == found), "{failed:?}");
}

/// If a client does not support an action that its hello claims, only the protocol fails.
#[cfg(unix)]
#[test]
fn a_claimed_action_without_support_fails_only_the_protocol() {
    let report = run_action("echo '{\"unsupported\":\"read-by-name\"}'", "10000");
    let failed = failures(&report, "client-name-more");
    let ids: Vec<&str> = failed.iter().map(|(id, ..)| id.as_str()).collect();
    assert_eq!(ids, ["CLIENT"], "{failed:?}");
}

/// A client that is still running when the deadline ends the wait after `bye`.
#[derive(Default)]
struct LateClient(ReferenceClient, bool);

impl ClientUnderTest for LateClient {
    fn hello(&mut self, cnc_address: &CncAddress) -> Result<ClientHello, ClientReaction> {
        self.0.hello(cnc_address)
    }

    fn act(&mut self, cnc: &CncAddress, scenario: &str, action: &Action) -> ClientReaction {
        self.0.act(cnc, scenario, action)
    }

    fn bye(&mut self) -> Result<(), String> {
        self.1 = true;
        Err("it did not end after bye".to_owned())
    }

    fn over(&self) -> Option<String> {
        self.1.then(|| "the deadline has passed".to_owned())
    }
}

/// A missing exit is not judged if the deadline has ended the wait for it.
#[test]
fn an_exit_after_the_deadline_is_not_judged() {
    let server = TestServer::new(([127, 0, 0, 1], 0).into()).unwrap();
    let mut client = LateClient::default();
    let judged = judge(&mut client, &server, &[], None);
    assert!(client.1);
    assert_eq!(judged.outcomes[0].verdict(), Verdict::Pass);
}

/// The message that tells a running client to exit.
#[cfg(unix)]
const BYE: &str = r#"{"cmd":"bye"}"#;

#[test]
fn a_missing_answer_fails_only_the_protocol() {
    let output = ads_cnc(&["run", "--client", "no-such-client-anywhere", "--json", "-"]);
    assert_eq!(output.status.code(), Some(1));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let failed = failures(&report, "client-manners");
    assert_eq!(failed.len(), 1, "{report:#}");
    assert_eq!(ads_cnc(&["run", "--client", "x", "--target", "y"]).status.code(), Some(2));
    assert_eq!(ads_cnc(&["run", "--client", "x", "--only", "VRA"]).status.code(), Some(2));
}

/// A client that connects by itself is judged by its requests, even if it opens a new connection for
/// every two requests.
#[test]
fn a_connecting_client_is_judged() {
    let listen = |request: &[u8], connections: usize| {
        let mut process = Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
            .args(["run", "--client-listen", "127.0.0.1:0", "--json", "-"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(process.stderr.take().unwrap()).read_line(&mut line).unwrap();
        let addr = line.split([' ', ',']).find(|word| word.starts_with("127.0.0.1:")).unwrap();
        // Open each connection before closing the previous one: the run ends when no connection is open.
        let mut before = None;
        for _ in 0..connections {
            let mut stream = connect(addr.parse().unwrap());
            for _ in 0..2 {
                stream.write_all(request).unwrap();
                let mut head = [0; 6];
                stream.read_exact(&mut head).unwrap();
                let len = u32::from_le_bytes(head[2..].try_into().unwrap());
                stream.read_exact(&mut vec![0; usize::try_from(len).unwrap()]).unwrap();
            }
            before = Some(stream);
        }
        drop(before);
        let output = process.wait_with_output().unwrap();
        (output.status.code(), serde_json::from_slice::<Value>(&output.stdout).unwrap())
    };
    let mut request =
        vec![0, 0, 44, 0, 0, 0, 127, 0, 0, 1, 1, 1, 0x29, 2, 10, 0, 0, 9, 1, 1, 0, 0x80];
    request.extend([2, 0, 4, 0, 12, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]);
    request.extend([1, 1, 0x13, 0, 0, 0, 0, 0, 4, 0, 0, 0]);
    // More connections than may be open at the same time.
    let (code, report) = listen(&request, 80);
    assert_eq!(code, Some(0), "{report:#}");
    assert_eq!(report["frames"], 160, "{report:#}");
    // All requests have the same invoke ID, but each is answered before the client sends the next one.
    assert!(!report.to_string().contains("a request without a reply"), "{report:#}");
    // The client sends the same request to the port of another task.
    request[12] = 0x28;
    let (code, report) = listen(&request, 1);
    assert_eq!(code, Some(1));
    assert_eq!(failures(&report, "client-requests")[0].0, "GEN-4");
}
