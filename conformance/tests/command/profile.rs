//! The claims of a profile determine the requests to a device, and the functions that it must have.

use std::process::Output;

use crate::common::file::TestFile;
use crate::common::{Serve, ads_cnc};

/// A temporary file with this profile.
fn claiming(text: &str) -> TestFile {
    TestFile::new(".toml", text.as_bytes())
}

/// Runs the suite against a simulated CNC as a device, with this profile; returns the output and the
/// report.
fn run(serve: &[&str], profile: &TestFile) -> (Output, serde_json::Value) {
    let serve = Serve::start(serve);
    let target = ["--target", &serve.addr, "--net-id", &serve.net_id];
    let output =
        ads_cnc(&[&["run", "--json", "-", "--profile", profile.path()], &target[..]].concat());
    let report = serde_json::from_slice(&output.stdout).unwrap_or_default();
    (output, report)
}

fn verdict<'r>(report: &'r serde_json::Value, case: &str) -> &'r str {
    let cases = report["cases"].as_array().unwrap();
    let one = cases.iter().find(|one| one["id"] == case);
    one.unwrap_or_else(|| panic!("no case {case}"))["verdict"].as_str().unwrap()
}

#[test]
fn unclaimed_functions_are_not_applicable() {
    let profile = claiming("name = \"panel\"\nsections = [\"variables\"]\nports = [552]\n");
    let (output, report) = run(&[], &profile);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    for case in ["com-count", "com-content", "sda-elements", "dyn-names", "service-variables"] {
        assert_eq!(verdict(&report, case), "not-applicable", "{case}");
    }
    for case in ["var-descriptions", "val-whole-by-name"] {
        assert_eq!(verdict(&report, case), "pass", "{case}");
    }
    assert_eq!(report["profile"]["name"], "panel");
}

/// The profile that the tool prints passes unchanged with the simulated CNC. Printed for a device, the
/// profile contains the channels and axes of the device, and passes with this device.
#[test]
fn a_printed_profile_passes() {
    let printed = |args: &[&str]| {
        let output = ads_cnc(&[&["run", "--print-profile"], args].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let example = printed(&[]);
    assert_eq!(example, ads_cnc_conformance::profile::EXAMPLE);
    let example = claiming(&example);
    for seed in ["1", "2", "3"] {
        let file = example.path();
        let output = ads_cnc(&["run", "--profile", file, "--only", "VAR", "--seed", seed]);
        assert_eq!(output.status.code(), Some(0), "{seed}: {output:?}");
    }
    let serve = Serve::start(&[]);
    let filled = printed(&["--target", &serve.addr, "--net-id", &serve.net_id]);
    for line in ["channels = [1, 2, 6]", "absent-channel = 3", "platform-axes = 5", "spindles = 2"]
    {
        assert!(filled.lines().any(|one| one == line), "{filled}");
    }
    let (output, _) = run(&[], &claiming(&filled));
    assert_eq!(output.status.code(), Some(0), "{output:?}");
}

#[test]
fn claimed_instances_must_work() {
    // The profile claims one channel, one spindle and one axis more than the device has.
    let profile = claiming("channels = [1, 2, 6, 7]\nspindles = 3\nplatform-axes = 6\n");
    let (output, report) = run(&[], &profile);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    for case in ["adr-com-object-access", "adr-decoder-group", "sda-configured-instances"] {
        assert_eq!(verdict(&report, case), "fail", "{case}");
    }
}

#[test]
fn a_function_claimed_by_name_must_work() {
    let text = "functions = [\"variable description by name\", \"number of variable elements\", \
                \"variable description by index\"]\n";
    let profile = claiming(text);
    let (output, report) = run(&["--cnc-version", "V4.20.0"], &profile);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    assert_eq!(verdict(&report, "var-described-by-name"), "fail");
    let (output, report) = run(&[], &profile);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert_eq!(verdict(&report, "var-described-by-name"), "pass");
    // Without a claim, the cases of a function that only some versions have are not applicable to a
    // device of another version.
    let profile = claiming("");
    let (_, report) = run(&["--cnc-version", "V4.20.0"], &profile);
    assert_eq!(verdict(&report, "var-described-by-name"), "not-applicable");
}

/// If a profile does not claim that objects can be read, no requirement of their descriptors fails.
#[test]
fn unclaimed_functions_fail_nothing() {
    let profile = claiming("functions = [\"number of objects\", \"object descriptors\"]\n");
    let (output, report) = run(&[], &profile);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert_eq!(verdict(&report, "com-content"), "not-applicable");
    assert_eq!(verdict(&report, "com-descriptors"), "pass");
}

#[test]
fn an_invalid_profile_is_wrong_usage() {
    let profile = claiming("name = \"x\"\nports = [851]\n");
    let (output, _) = run(&[], &profile);
    assert_eq!(output.status.code(), Some(2));
    let why = String::from_utf8(output.stderr).unwrap();
    assert!(why.contains("line 2") && why.contains("551, 552 and 553"), "{why}");
}
