//! The selection of cases, their order, and waivers.

use crate::common::file::TestFile;
use crate::common::{Serve, ads_cnc};
use std::collections::BTreeSet;

use serde_json::Value;

fn run(args: &[&str]) -> Value {
    let output = ads_cnc(&[&["run", "--json", "-"], args].concat());
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)))
}

fn ids(report: &Value) -> Vec<&str> {
    let cases = report["cases"].as_array().unwrap();
    cases.iter().map(|case| case["id"].as_str().unwrap()).collect()
}

/// The requirements with this verdict for at least one subject.
fn with<'r>(report: &'r Value, verdict: &str) -> BTreeSet<&'r str> {
    let subjects = report["subjects"].as_array().unwrap().iter();
    let areas = subjects.flat_map(|subject| subject["areas"].as_array().unwrap());
    let all = areas.flat_map(|area| area["requirements"].as_array().unwrap());
    all.filter(|one| one["verdict"] == verdict)
        .map(|one| one["requirement"].as_str().unwrap())
        .collect()
}

/// The same seed gives the same order.
#[test]
fn a_seed_determines_the_order() {
    let seed = |seed| run(&["--seed", seed, "--only", "VAR"]);
    let first = seed("1");
    assert_eq!(ids(&first), ids(&seed("1")));
    assert_ne!(ids(&first), ids(&seed("2")));
    assert_ne!(run(&["--only", "GEN"])["seed"], run(&["--only", "GEN"])["seed"]);
}

#[test]
fn only_selected_cases_are_run() {
    let one = run(&["--only", "var-11"]);
    assert_eq!(with(&one, "pass"), BTreeSet::from(["VAR-11"]));
    assert!(with(&one, "not-observed").is_empty());
    assert!(one["left_out"].as_u64().unwrap() > 1000);

    let area = run(&["--only", "VAR"]);
    assert!(with(&area, "pass").iter().all(|id| id.starts_with("VAR-")));
    assert!(with(&area, "not-observed").contains("VAR-27"));
    assert!(with(&area, "not-run").contains("COM-1"));

    let case = run(&["--only", "com-count", "--only", "VAR-25"]);
    assert!(ids(&case).contains(&"com-count") && ids(&case).contains(&"val-string-size"));
    assert!(with(&case, "pass").contains("COM-1"));

    // If it is selected alone, the case that judges the frames of other cases runs some of these
    // cases.
    let frames = run(&["--only", "ads-every-frame"]);
    assert_eq!((ids(&frames), &frames["exit_code"]), (vec!["ads-every-frame"], &Value::from(0)));
}

#[test]
fn an_unknown_selection_is_not_a_success() {
    for args in [
        &["run", "--only", "VRA"][..],
        &["run", "--only", "VAR", "--only", "DYN-99"],
        &["run", "--only", "VAR-4.999"],
    ] {
        let output = ads_cnc(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(
            String::from_utf8(output.stderr)
                .unwrap()
                .contains("no area, requirement, section, stream or case is called")
        );
    }
    let output = ads_cnc(&["run", "--edition", "fr-1.0"]);
    assert_eq!(output.status.code(), Some(2));
    // Only the other edition prints the name in the selected vector.
    let output = ads_cnc(&["run", "--edition", "en-1.05", "--only", "vec-path-trajektorie-x"]);
    assert_eq!(output.status.code(), Some(3));
}

#[test]
fn an_edition_is_judged_by_itself() {
    for (edition, has, lacks) in [
        ("en-1.05", "vec-path-trajectory-x", "vec-path-trajektorie-x"),
        ("de-1.051", "vec-path-trajektorie-x", "vec-path-trajectory-x"),
    ] {
        let report = run(&["--edition", edition]);
        assert_eq!(report["exit_code"], 0, "{edition}");
        assert_eq!(report["editions"], serde_json::json!([edition]));
        let verdict = |id: &str| {
            let cases = report["cases"].as_array().unwrap();
            cases.iter().find(|case| case["id"] == id).map(|case| case["verdict"].clone())
        };
        assert_eq!(verdict(has), Some("pass".into()));
        assert_eq!(verdict(lacks), Some("not-run".into()));
        // The simulated CNC follows the selected edition, with the features that only this edition has.
        assert_eq!(report["profile"]["claims"]["edition"], edition);
        assert_eq!(with(&report, "pass").contains("VAR-19"), edition == "de-1.051");
    }
}

#[test]
fn cases_are_listed_without_running() {
    let args = ["--only", "VAR-11", "--seed", "5"];
    let output = ads_cnc(&[&["run", "--list", "--json", "-"], &args[..]].concat());
    assert_eq!(output.status.code(), Some(0));
    let listed: Value = serde_json::from_slice(&output.stdout).unwrap();
    // The list has the cases of the target in the order in which they are run.
    let of_target = |listed: &Value| -> Vec<String> {
        let listed = listed.as_array().unwrap().iter();
        listed.filter(|one| one["subject"] == "target").map(|one| one["id"].to_string()).collect()
    };
    let report = run(&args);
    assert_eq!(of_target(&listed), of_target(&report["cases"]));
    let listed: BTreeSet<&str> =
        listed.as_array().unwrap().iter().map(|one| one["id"].as_str().unwrap()).collect();
    // The case about the testee protocol is run with any selection, and not listed.
    let run = ids(&report).into_iter().filter(|id| *id != "testee-manners");
    assert_eq!(listed, run.collect());
    let text = ads_cnc(&[&["run", "--list"], &args[..]].concat());
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("target   val-whole-by-handle  [VAR-8 VAR-11 VAR-14]\n"), "{text}");
    assert!(text.ends_with(&format!("{} cases\n", listed.len())), "{text}");
    // Without a seed, the list always has the same order.
    let unordered = || ads_cnc(&["run", "--list", "--only", "VAR-11"]).stdout;
    assert_eq!(unordered(), unordered());
    // `--list` sends nothing to a device.
    let device = ["run", "--list", "--target", "192.0.2.1", "--net-id", "1.2.3.4.1.1"];
    let text = String::from_utf8(ads_cnc(&device).stdout).unwrap();
    assert!(
        text.contains("not run: malformed requests are sent only with") && !text.contains("codec ")
    );

    let rows = ads_cnc(&["requirements", "--only", "val-whole-by-handle", "--format", "json"]);
    let rows: Value = serde_json::from_slice(&rows.stdout).unwrap();
    let rows: Vec<&str> =
        rows.as_array().unwrap().iter().map(|row| row["id"].as_str().unwrap()).collect();
    assert_eq!(rows, ["VAR-8", "VAR-11", "VAR-14"]);
    for (name, title) in [
        ("variable-handle", "VAR-10  Handle"),
        ("readbyname", "VAR-14  Value"),
        ("ads:4.3.2", "VAR-8  "),
        ("val-whole-by-*", "VAR-11  "),
        ("seq-stream-4094", "STM-6  "),
    ] {
        let rows = ads_cnc(&["requirements", name]).stdout;
        assert!(String::from_utf8(rows).unwrap().contains(title), "{name}");
    }
}

/// The list for a device contains exactly the cases that a run against this device does not omit.
#[test]
fn the_list_of_a_device_contains_the_cases_of_a_run() {
    let device = Serve::start(&[]);
    let target = ["--target", &device.addr, "--net-id", &device.net_id, "--seed", "5"];
    let json = |args: &[&str]| -> Value {
        let output = ads_cnc(&[args, &target, &["--json", "-"]].concat());
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let listed = json(&["run", "--list"]);
    let listed = listed.as_array().unwrap().iter();
    let listed: BTreeSet<&str> = listed
        .filter(|one| one.get("not_run").is_none())
        .map(|one| one["id"].as_str().unwrap())
        .collect();
    let report = json(&["run"]);
    let left_out = ["only with --malformed", "--allow-write", "the simulated", "printed examples"];
    let run = report["cases"].as_array().unwrap().iter().filter(|case| {
        let note = case["note"].as_str().unwrap_or_default();
        !left_out.iter().any(|why| note.contains(why))
    });
    let run: BTreeSet<&str> = run.map(|case| case["id"].as_str().unwrap()).collect();
    assert_eq!(listed, run);
    assert!(listed.len() > 80, "{}", listed.len());
}

fn waiver(test: &str, requirement: &str, verdict: &str, expires: &str) -> String {
    format!(
        "[[waiver]]\ntest = \"{test}\"\nrequirement = \"{requirement}\"\nverdict = \"{verdict}\"\n\
         reason = \"known\"\nexpires = {expires}\n"
    )
}

#[test]
fn known_failures_are_waived_until_they_expire() {
    let good = waiver("var-descriptions", "VAR-8", "fail", "9999-01-01");
    let cases: [(&str, String, &[&str], i32, &str); 7] = [
        ("used", good.clone(), &[], 0, "used: var-descriptions [VAR-8]"),
        ("expired", good.replace("9999", "2020"), &[], 1, "stale: expired"),
        ("over", waiver("var-descriptions", "VAR-3", "fail", "2020-01-01"), &[], 1, "stale: exp"),
        ("other", good.replace("fail", "warning"), &[], 1, "stale: another verdict was found"),
        (
            "unmatched",
            format!("{good}{}", waiver("com-count", "VAR-8", "fail", "9999-01-01")),
            &[],
            5,
            "stale: no such case or requirement was run: com-count",
        ),
        (
            "passes",
            format!("{good}{}", waiver("var-descriptions", "VAR-3", "fail", "9999-01-01")),
            &[],
            5,
            "fail expected, found pass",
        ),
        // Whether a waiver of a case that was not selected is stale is unknown.
        (
            "unknown",
            format!("{good}{}", waiver("com-count", "COM-1", "fail", "9999-01-01")),
            &[],
            0,
            "not run: com-count",
        ),
    ];
    for (name, text, more, code, shown) in cases {
        let file = TestFile::new(".toml", text.as_bytes());
        let args =
            ["run", "--only", "var-descriptions", "--defect", "variable-description.size.flip"];
        let args = [&args[..], &["--waivers", file.path()], more].concat();
        let output = ads_cnc(&args);
        let out = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(code), "{name}: {out}");
        assert!(out.contains(shown), "{name}: {out}");
        // The output suggests an entry for the failure exactly if it is not waived.
        let entry = "[[waiver]]\ntest = \"var-descriptions\"\nrequirement = \"VAR-8\"\nverdict = \"fail\"\n";
        assert_eq!(out.contains(entry), !out.contains("FAIL, WAIVED"), "{name}: {out}");
        assert_eq!(
            out.contains("FAIL, WAIVED"),
            name != "expired" && name != "over" && name != "other"
        );
    }
}

#[test]
fn an_invalid_file_of_waivers_is_rejected_with_its_line() {
    let good = waiver("a", "VAR-8", "fail", "2030-01-01");
    let cases = [
        ("gone", good.replace("\"a\"", "\"var-description\""), "did you mean var-descriptions"),
        ("broken", "[[waiver]\n".to_owned(), "line 1"),
        ("unknown-key", format!("{good}owner = \"me\"\n"), "line 7"),
        ("no-requirement", good.replace("VAR-8", "VAR-99"), "no such requirement: VAR-99"),
        ("pass", good.replace("\"fail\"", "\"pass\""), "line 4"),
        ("no-reason", good.replace("known", " "), "a waiver needs a reason"),
        ("no-day", good.replace("2030-01-01", "2030-01-01T00:00:00Z"), "expected a day"),
        ("unquoted", good.replace("2030-01-01", "tomorrow"), "or a day as YYYY-MM-DD"),
        ("no-date", good.replace("2030-01-01", "\"tomorrow\""), "YYYY-MM-DD without quotes"),
        ("never", good.replace("2030-01-01", "2030-02-30"), "line 6"),
        ("missing", good.replace("expires", "# expires"), "the key expires is missing"),
        ("twice", format!("{good}{good}"), "line 7: duplicate waiver of VAR-8 in a"),
    ];
    for (name, text, why) in cases {
        let file = TestFile::new(".toml", text.as_bytes());
        let output = ads_cnc(&["run", "--waivers", file.path()]);
        let stderr_text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{name}: {stderr_text}");
        assert!(
            stderr_text.contains(why) && stderr_text.contains(".toml"),
            "{name}: {stderr_text}"
        );
        assert!(output.stdout.is_empty());
    }
    assert_eq!(ads_cnc(&["run", "--waivers", "/no/such/file"]).status.code(), Some(2));
}

/// After the maximum number of failed cases, the remaining cases are not run, and the last line
/// counts them.
#[test]
fn a_run_stops_after_so_many_failures() {
    let defect = ["--defect", "variable-description.size.flip", "--only", "VAR", "--seed", "1"];
    let output = ads_cnc(&[&["run", "--max-fail", "1"], &defect[..]].concat());
    let shown = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{shown}");
    let last = shown.lines().last().unwrap();
    assert!(last.contains("; ended early: ") && last.contains(" (--max-fail)"), "{last}");
    let passed = ads_cnc(&["run", "-q", "--max-fail", "1", "--only", "com-count"]);
    assert!(!String::from_utf8(passed.stdout).unwrap().contains("ended early"));
}
