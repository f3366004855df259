//! `ads-cnc run` as users call it.

use std::net::SocketAddr;

use crate::common::Serve;
use crate::common::file::TestFile;
use crate::common::{ads_cnc, text};
use ads_cnc_conformance::net;
use serde_json::Value;

/// An address on this machine with a port that the system chooses.
fn loopback() -> SocketAddr {
    SocketAddr::from(([127, 0, 0, 1], 0))
}

/// `ads-cnc` without a command runs the suite against this project's codec and the simulated CNC,
/// and passes.
#[test]
fn without_a_command_the_suite_runs() {
    let output = ads_cnc(&[]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{shown}");
    assert!(shown.contains("\nPASSED  codec: "), "{shown}");
    let version = env!("CARGO_PKG_VERSION");
    let device = format!("\ndevice   \"ads-cnc serve\" {version}, state RUN\n");
    assert!(shown.contains(&device), "{shown}");
    assert!(!shown.contains("FAIL") && !shown.contains("\n  differs "), "{shown}");
    // On a busy machine, the run lasts long enough to print progress lines.
    let stderr = text(&output.stderr);
    assert!(stderr.lines().all(|line| line.ends_with(" left")), "{stderr}");
}

/// The output of a failure names the clause, and contains the sent, received and expected bytes.
#[test]
fn a_failure_is_shown_with_its_clause_and_bytes() {
    let output = ads_cnc(&["run", "--defect", "variable-description.size.flip"]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{shown}");
    let block = shown.split("\n\n").find(|block| block.starts_with("FAIL  VAR-8  "));
    let block = block.unwrap_or_else(|| panic!("{shown}"));
    for part in [
        "ads-en 1.05 §4.3.2; ads-de 1.051 §4.3.2",
        "\n  The size of a description is the whole variable's in bytes",
        "\n  var-descriptions: V.G.NP[0].V: expected ",
        "; found ",
        " similar, also in ",
        "\n  again: ads-cnc run --defect variable-description.size.flip --only var-descriptions --seed ",
        "\n  sent      ReadWrite 0x122301, 0x45 at port 552",
        "V.G·              kind",
        "\n  received  ",
        "  size\n",
    ] {
        assert!(block.contains(part), "{part:?} is not in\n{block}");
    }
}

/// The run writes its report as JSON, with the device and the judged clauses.
#[test]
fn the_report_is_written_as_json() {
    let file = TestFile::new(".json", b"");
    let output = ads_cnc(&["run", "--json", file.path()]);
    assert_eq!(output.status.code(), Some(0));
    let report: Value = serde_json::from_slice(&std::fs::read(&file.0).unwrap()).unwrap();
    assert_eq!(report["format"], 1);
    assert_eq!(report["exit_code"], 0);
    let device = &report["target"]["device"];
    assert_eq!((&device["name"], &device["state"]), (&"ads-cnc serve".into(), &"RUN".into()));
    let cases = report["cases"].as_array().unwrap();
    let of_target = cases.iter().filter(|case| case["subject"] == "target");
    assert!(of_target.count() > 40);
    // The run judges at least these clauses.
    let target = &report["subjects"][1];
    assert_eq!(target["subject"], "target");
    let judged: Vec<_> = target["areas"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|area| area["requirements"].as_array().unwrap())
        .filter(|one| one["verdict"] == "pass")
        .map(|one| one["requirement"].as_str().unwrap())
        .collect();
    for id in [
        "ADR-1", "ADR-3", "ADR-4", "ADR-5", "ADR-10", "ADR-11", "ADR-12", "COM-1", "COM-2",
        "COM-3", "COM-4", "COM-5", "COM-6", "COM-7", "VAR-1", "VAR-2", "VAR-3", "VAR-4", "VAR-5",
        "VAR-6", "VAR-7", "VAR-8", "VAR-9", "VAR-10", "VAR-11", "VAR-14", "VAR-20", "VAR-21",
        "VAR-24", "ADS-8", "ADS-9",
    ] {
        assert!(judged.contains(&id), "{id} is not judged");
    }
}

/// By default, a run against a device only reads, and judges the device.
#[test]
fn a_device_is_only_read() {
    let serve = Serve::start(&[]);
    let output = ads_cnc(&["run", "--target", &serve.addr, "--net-id", "127.0.0.1.1.1"]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{shown}");
    assert!(shown.contains("are sent only with --malformed"), "{shown}");
}

/// The log contains each exchange with its frames.
#[test]
fn exchanges_are_logged() {
    let serve = Serve::start(&[]);
    let get = ["get", "V.E.vartest", "--target", &serve.addr, "--net-id", &serve.net_id];
    let log = ["--log", "ads_cnc_conformance::client=debug"];
    let logged = text(&ads_cnc(&[&get[..], &log].concat()).stderr);
    let read =
        logged.lines().find(|line| line.contains(": ReadWrite 0x122301, 0x48 at port 552: "));
    let read = read.unwrap_or_else(|| panic!("{logged}"));
    assert!(read.contains(": 2 bytes sent=00 00 ") && read.ends_with(" 67 12"), "{read}");
}

/// Without a profile, a run judges all channels that it finds. It first prints about how many
/// requests it will send, and the report contains the found channels. With a profile, it judges
/// only the channels of the profile.
#[test]
fn a_run_without_a_profile_judges_found_channels() {
    let serve = Serve::start(&[]);
    let run = |args: &[&str]| {
        let target = ["run", "--target", &serve.addr, "--net-id", "127.0.0.1.1.1", "--seed", "1"];
        let output =
            ads_cnc(&[&target[..], &["--only", "var-count", "--json", "-"], args].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        (report, text(&output.stderr))
    };
    let (report, stderr_text) = run(&[]);
    let channels = serde_json::json!([1, 2, 6]);
    assert_eq!(report["profile"]["claims"]["channels"], channels);
    assert_eq!(report["found"]["ports"], serde_json::json!([551, 552, 553]));
    let found = "channel 1 with 3 axis indices, 2 with 3 axis indices, 6 with 3 axis indices";
    assert!(
        stderr_text.contains(found)
            && stderr_text.contains("about ")
            && stderr_text.contains(" requests"),
        "{stderr_text}"
    );

    let profile = TestFile::new(".toml", b"channels = [6]");
    let (report, stderr_text) = run(&["--profile", profile.path()]);
    assert_eq!(report["profile"]["claims"]["channels"], serde_json::json!([6]));
    assert_eq!(report["found"]["ports"], serde_json::json!([]));
    assert!(stderr_text.contains("channel 6 with 3 axis indices;"), "{stderr_text}");
}

/// A run reads only a sample of a long list, and the whole list with `--all`.
#[test]
fn a_long_list_is_read_completely_with_all() {
    let model = text(&ads_cnc(&["serve", "--print-model"]).stdout);
    let (head, tail) = model.split_once("[[channel]]").unwrap();
    let more: String = (0..300)
        .map(|one| format!("  {{ name = \"V.E.more_{one}\", type = \"SGN32\" }},\n"))
        .collect();
    let tail = tail.replacen("variables = [\n", &format!("variables = [\n{more}"), 1);
    let file = TestFile::new(".toml", format!("{head}[[channel]]{tail}").as_bytes());
    let serve = Serve::start(&["--model", file.path()]);
    let run = |args: &[&str]| {
        let target = ["run", "--target", &serve.addr, "--net-id", "127.0.0.1.1.1"];
        let only = ["--only", "var-extended-descriptions", "--seed", "1"];
        let output = ads_cnc(&[&target[..], &only, args].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        (text(&output.stdout), text(&output.stderr))
    };
    let sampled = "V.E channel 1: 256 of 423; by the seed\n";
    let (shown, stderr_text) = run(&[]);
    assert!(shown.contains(&format!("sampled  {sampled}")), "{shown}");
    assert!(stderr_text.contains(sampled), "{stderr_text}");
    let (shown, stderr_text) = run(&["--all"]);
    assert!(!shown.contains("sampled") && !stderr_text.contains("sampled"), "{shown}{stderr_text}");
    let without = ads_cnc(&["run", "--all"]);
    assert_eq!(without.status.code(), Some(2), "{without:?}");
}

/// A run sends malformed requests to a target only if the target is on this machine and a file
/// permits them. Otherwise, the run does not even connect: a program at a loopback address may
/// forward requests to a machine that moves.
#[test]
fn malformed_requests_need_a_file_that_permits_them() {
    let serve = Serve::start(&[]);
    let net_id = ["--net-id", "127.0.0.1.1.1"];
    let run = |addr: &str, tables: &str| {
        let file = TestFile::allowing(tables);
        let allow = ["--allow-write", file.path()];
        ads_cnc(&[&["run", "--malformed", "--target", addr], &net_id[..], &allow].concat())
    };
    let shown = run(&serve.addr, "malformed = true");
    assert_eq!(shown.status.code(), Some(0), "{}", text(&shown.stdout));
    assert!(!text(&shown.stdout).contains("are sent only with --malformed"));

    let away = run("192.0.2.1:48898", "address = \"192.0.2.1\"\nmalformed = true");
    assert_eq!(away.status.code(), Some(4), "{}", text(&away.stderr));
    let named = run(&serve.addr, "[[variable]]\nchannel = 1\nname = \"V.E.test\"");
    let other = run(&serve.addr, "malformed = true\naddress = \"192.0.2.1\"");
    let without =
        ads_cnc(&[&["run", "--malformed", "--target", &serve.addr], &net_id[..]].concat());
    for (rejected, why) in [
        (named, "malformed = true"),
        (without, "malformed = true"),
        (other, "for the address 192.0.2.1, not for 127.0.0.1"),
    ] {
        assert_eq!(rejected.status.code(), Some(4), "{}", text(&rejected.stderr));
        assert!(text(&rejected.stderr).contains(why), "{}", text(&rejected.stderr));
    }
}

/// Without a target, a file for `--allow-write` is an error, and so is a file that does not exist.
#[test]
fn a_file_is_read_without_a_target() {
    let file = TestFile::allowing("");
    let unused = ads_cnc(&["run", "--allow-write", file.path()]);
    assert_eq!(unused.status.code(), Some(2), "{}", text(&unused.stderr));
    assert!(text(&unused.stderr).contains("--allow-write needs --target"), "{unused:?}");
    for rest in [&["--only", "vec-handle"][..], &["--list"]] {
        let lost = ads_cnc(&[&["run", "--allow-write", "/no/such/file.toml"], rest].concat());
        assert_eq!(lost.status.code(), Some(2), "{}", text(&lost.stderr));
        assert!(text(&lost.stderr).contains("/no/such/file.toml"), "{}", text(&lost.stderr));
    }
}

/// A device that rejects ReadDeviceInfo or ReadState is judged nevertheless, and passes.
#[test]
fn device_information_is_optional() {
    for defect in ["device-info-reply.result.flip", "device-state-reply.result.flip"] {
        let serve = Serve::start(&["--defect", defect]);
        let output = ads_cnc(&["run", "--target", &serve.addr, "--net-id", &serve.net_id]);
        let shown = text(&output.stdout);
        assert_eq!(output.status.code(), Some(0), "{shown}");
        let info = defect.contains("info");
        assert_eq!(shown.contains("\ndevice   "), !info, "{shown}");
        assert!(!shown.contains(", state "), "{shown}");
        let (case, clause) = if info { ("info", "ADS-8") } else { ("state", "ADS-9") };
        assert!(shown.contains(&format!("ads-device-{case}")) && shown.contains(clause), "{shown}");
    }
}

/// A command whose output cannot be written ends with exit code 70.
#[cfg(target_os = "linux")]
#[test]
fn lost_output_is_an_error() {
    let commands: [&[&str]; 6] = [
        &[],
        &["client", "--list-defects"],
        &["completions", "bash"],
        &["requirements"],
        &["serve", "--list-defects"],
        &["serve", "--print-model"],
    ];
    for args in commands {
        let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
        let output = command.args(args).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(70), "{args:?}");
        assert!(text(&output.stderr).contains("cannot write the output: "), "{args:?}");
    }
}

/// An unreachable device has exit code 3, wrong usage exit code 2.
#[test]
fn exit_codes() {
    let nobody = net::listen(loopback()).unwrap().local_addr().unwrap().to_string();
    let cases: [(&[&str], i32); 6] = [
        (&["run", "--target", &nobody, "--net-id", "10.0.0.1.1.1", "--timeout", "500"], 3),
        (&["run", "--target", "127.0.0.1"], 2),
        (&["run", "--net-id", "10.0.0.1.1"], 2),
        (&["run", "--no-such-option"], 2),
        (&["run", "--defect", "no-such-defect"], 2),
        (&["run", "--json", "/no/such/folder/report.json"], 2),
    ];
    for (args, code) in cases {
        let output = ads_cnc(args);
        assert_eq!(output.status.code(), Some(code), "{args:?}: {}", text(&output.stderr));
        assert!(!output.stderr.is_empty(), "{args:?} says nothing");
    }
}

/// A run that ends before it can write its report removes the report of an earlier run; a dry run does
/// not.
#[test]
fn the_report_of_an_earlier_run_is_removed() {
    let nobody = net::listen(loopback()).unwrap().local_addr().unwrap().to_string();
    let file = TestFile::new(".json", b"yesterday");
    let target = ["--target", &nobody, "--net-id", "10.0.0.1.1.1", "--json", file.path()];
    let dry = ads_cnc(&[&["run", "--dry-run"], &target[..]].concat());
    assert_eq!((dry.status.code(), file.0.exists()), (Some(0), true), "{dry:?}");
    let lost = ads_cnc(&[&["run"], &target[..]].concat());
    assert_eq!((lost.status.code(), file.0.exists()), (Some(3), false), "{lost:?}");
}

/// With `-q`, a run that passes prints only its last line.
#[test]
fn quiet_prints_only_the_last_line() {
    let serve = Serve::start(&[]);
    let target = ["--target", &serve.addr, "--net-id", &serve.net_id];
    let output = ads_cnc(&[&["run", "-q", "--only", "com-count"], &target[..]].concat());
    let shown = text(&output.stdout);
    assert!(shown.starts_with("PASSED  ") && shown.lines().count() == 1, "{shown}");
    assert_eq!(text(&output.stderr), "");
}

/// A report file that cannot be created is an error before the first request.
#[test]
fn reports_are_checked_before_the_run() {
    for form in ["--json", "--html", "--junit", "--markdown", "--badge"] {
        let output = ads_cnc(&["run", form, "/no/such/folder/report"]);
        assert_eq!(output.status.code(), Some(2), "{form}");
        assert_eq!(text(&output.stdout), "", "{form}");
        assert!(text(&output.stderr).contains("/no/such/folder/report: "), "{form}");
    }
    assert_eq!(ads_cnc(&["run", "--timeout", "0"]).status.code(), Some(2));
}

/// A rejection that proves nothing is listed with its sibling, which the codec should have
/// accepted.
#[test]
fn a_vacuous_rejection_follows_from_its_sibling() {
    let defect = ["run", "--defect", "read-write-reply.length.zero", "--only", "read-write-reply"];
    let output = ads_cnc(&defect);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{shown}");
    assert!(shown.contains(" 3 vacuous "), "{shown}");
    assert!(!shown.contains("\nVACUOUS"), "{shown}");
    let list = shown.split("follows from it: ").skip(1).collect::<String>();
    assert!(list.contains("vec-read-write-reply-length-largest (ADS-3)"), "{shown}");
}

/// A dry run lists the functions that the run would request, and the writes that a file allows.
#[test]
fn a_dry_run_lists_functions_and_writes() {
    let target = ["--target", "192.0.2.10", "--net-id", "192.0.2.10.1.1"];
    let dry = |more: &[&str]| ads_cnc(&[&["run", "--dry-run"], &target[..], more].concat());
    let listed = text(&dry(&[]).stdout);
    for part in [
        "(without --profile, it first searches with the same functions for the ports",
        "  Read       port 553  number of objects (COM-1)\n",
        "  ReadWrite  port 551  object address (SDA-",
        "  and sometimes ReadDeviceInfo and ReadState at the ports 551, 552, 553\n",
        "  ReadWrite  port 552  read variable value by name (VAR-14)\n",
        "It writes nothing without a file for --allow-write.\n",
    ] {
        assert!(listed.contains(part), "{part:?} is not in\n{listed}");
    }
    assert!(!listed.contains("write variable value by name"), "{listed}");
    let entry = "[[variable]]\nchannel = 1\nname = \"V.E.test[4]\"\n";
    let head = "target = \"192.0.2.10.1.1\"\nexpires = 9999-12-31T23:59:59Z\n";
    let file = TestFile::new(".toml", format!("{head}{entry}").as_bytes());
    let listed = text(&dry(&["--allow-write", file.path()]).stdout);
    assert!(listed.contains("  name = \"V.E.test[4]\"\n"), "{listed}");
}

/// A run with a file whose entries allow no write of the suite reports this, and is not a success.
#[test]
fn a_file_without_effect_is_reported() {
    let serve = Serve::start(&[]);
    let said_of = |channel: u8, target: &str, expires: &str, name: &str| {
        let entry = format!("[[variable]]\nchannel = {channel}\nname = \"{name}\"\n");
        let head = format!("target = \"{target}\"\nexpires = {expires}\n");
        let file = TestFile::new(".toml", format!("{head}{entry}").as_bytes());
        let args = ["run", "--only", "write-by-name", "--target", &serve.addr, "--net-id"];
        let allow = ["--allow-write", file.path()];
        let output = ads_cnc(&[&args[..], &[&serve.net_id], &allow].concat());
        (text(&output.stderr), text(&output.stdout), output.status.code())
    };
    let said = |target: &str, expires: &str, name: &str| said_of(1, target, expires, name);
    let rejected = |shown: &str, why: &str| {
        let above = shown.lines().rev().nth(1).unwrap();
        assert!(above.starts_with("REJECTED  allow-write: ") && above.contains(why), "{shown}");
    };
    let (own, later) = (serve.net_id.as_str(), "9999-12-31T23:59:59Z");
    let (found, shown, code) = said(own, "2020-01-01T00:00:00Z", "V.E.vartest");
    assert!(
        found.contains("nothing will be written: the file of --allow-write expired at"),
        "{found}"
    );
    rejected(&shown, "nothing was written: the file of --allow-write expired at 2020-01-01");
    assert_eq!(code, Some(4), "{shown}");
    let (found, shown, code) = said("192.0.2.77.1.1", later, "V.E.vartest");
    assert!(found.contains("is for 192.0.2.77.1.1, not for 127.0.0.1.1.1"), "{found}");
    rejected(&shown, "is for 192.0.2.77.1.1, not for 127.0.0.1.1.1");
    assert_eq!(code, Some(4), "{shown}");
    for (name, what) in
        [("V.E.nothere", "variable"), ("V.E.*", "variable"), ("V.E.test[99]", "element")]
    {
        let (found, shown, code) = said(own, later, name);
        assert!(found.contains("nothing was written: "), "{found}");
        rejected(&shown, &format!("{name} in channel 1: the device has no such {what}"));
        assert_eq!(code, Some(4), "{shown}");
    }
    let (_, shown, code) = said_of(3, own, later, "V.E.vartest");
    rejected(&shown, "V.E.vartest in channel 3: the device has no such channel");
    assert_eq!(code, Some(4), "{shown}");
    let (found, shown, code) = said(own, later, "V.E.vartest");
    assert!(found.contains("ads-cnc: found ") && !found.contains("nothing "), "{found}");
    assert!(shown.contains("\nwrote     V.E.vartest (restored)\n"), "{shown}");
    assert_eq!(code, Some(0), "{shown}");
}
