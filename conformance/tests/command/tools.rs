//! `ads-cnc browse`, `get` and `set` as users call them.

use std::process::Output;

use crate::common::file::TestFile;
use crate::common::{Serve, ads_cnc, check_schema, text};
use serde_json::Value;

/// The text of a snapshot: each call with its stdout, its stderr and its exit code.
fn shown(calls: &[&[&str]]) -> String {
    let mut all = String::new();
    for args in calls {
        let output = ads_cnc(args);
        let (out, err) = (text(&output.stdout), text(&output.stderr));
        let code = output.status.code().unwrap();
        all.push_str(&format!("$ ads-cnc {}\n{out}{err}exit code {code}\n\n", args.join(" ")));
    }
    all
}

/// A simulated CNC in a separate process, which calls use as their target.
struct Device(Serve);

impl Device {
    fn start(options: &[&str]) -> Self {
        Self(Serve::start(options))
    }

    fn call(&self, args: &[&str]) -> Output {
        let target = ["--target", &self.0.addr, "--net-id", &self.0.net_id];
        ads_cnc(&[args, &target].concat())
    }

    fn value(&self, args: &[&str]) -> String {
        let output = self.call(&[&["get", "--plain"], args].concat());
        assert_eq!(output.status.code(), Some(0), "{args:?}: {}", text(&output.stderr));
        text(&output.stdout).trim_end().to_owned()
    }
}

#[test]
fn everything_is_listed() {
    insta::assert_snapshot!("browse", shown(&[&["browse", "--content"]]));
}

#[test]
fn variables_are_listed() {
    insta::assert_snapshot!(
        "browse-variables",
        shown(&[
            &["browse", "--variables", "--channel", "2,6"],
            &["browse", "--variables", "--filter", "V.?.*", "--of", "V.A*", "--content"],
            &["browse", "--variables", "--of", "P *", "--content"],
        ])
    );
}

#[test]
fn parts_are_listed_in_every_format() {
    insta::assert_snapshot!(
        "browse-parts",
        shown(&[
            &["browse", "--filter", "SINGLE_BLOCK", "--format", "csv"],
            &[
                "browse",
                "--of",
                "COM channel 1",
                "--filter",
                "*string*",
                "--content",
                "--format",
                "csv"
            ],
            &["browse", "--of", "spindle *", "--exact"],
            &["browse", "--filter", "nothing_has_this_name"],
        ])
    );
}

#[test]
fn values_are_shown() {
    insta::assert_snapshot!(
        "get",
        shown(&[
            &["get", "V.E.Testvar"],
            &["get", "V.E.vartest"],
            &["get", "V.E.cube"],
            &["get", "V.E.matrix[1][2]", "--plain"],
            &["get", "V.E.array_sgn32", "--hex"],
            &["get", "V.E.text"],
            &["get", "V.E.texts"],
            &["get", "V.G.NP[0].V[1]"],
            &["get", "V.A.ACT_POS.X"],
            &["get", "V.A.WCS", "--axis", "2"],
            &["get", "V.CYC.matrix"],
            &["get", "V.CYC.matrix", "--type", "REAL64"],
            &["get", "P1"],
            &["get", "V.S.radius"],
            &["get", "mc_active_single_block_r"],
            &["get", "mc_active_single_block_r", "--channel", "6"],
            &["get", "example_platform_cycle_time_r"],
            &["get", "example_position_r", "--of", "COM channel 1", "--offset", "0x20001"],
            &["get", "feedhold.enable"],
            &["get", "example.temperature", "--of", "HLD axis 2"],
        ])
    );
}

#[test]
fn failed_reads_have_advice() {
    insta::assert_snapshot!(
        "get-troubles",
        shown(&[
            &["get", "V.E.nothing"],
            &["get", "V.CYC.nothing"],
            &["get", "V.E"],
            &["get", "P9"],
            &["get", "V.E.matrix[1]"],
            &["get", "V.E.matrix[2][0]"],
            &["get", "V.E.vartest[0]"],
            &["get", "V.E.vartest", "--axis", "1"],
            &["get", "V.E.vartest", "--type", "REAL64"],
            &["get", "V.CYC.count", "--cnc-version", "V3.1.3131.0"],
            &["get", "nothing_has_this_name"],
            &["get", "example_position_r"],
            &["get", "mc_program_stream_w"],
            &["get", "example.p_count"],
            &["get", "V.E.vartest", "--channel", "9"],
            &["get", "V.A.ACT_POS"],
            &["get", ""],
            &["get", "V.E.matrix[1,2]"],
            &["get", "V.A.ACT_POS", "--axis", "9"],
            &["get", "MC_active_single_block_r"],
            &["get", "p1"],
            &["browse", "--filter", "V.E.vartest"],
            &["browse", "--variables", "--channel", "9"],
        ])
    );
}

#[test]
fn values_are_set_in_the_simulated_cnc() {
    insta::assert_snapshot!(
        "set",
        shown(&[
            &["set", "V.E.test[4]", "123"],
            &["set", "V.E.test", "1,2,3,4,0xFF"],
            &["set", "V.E.text", "a \"text\", x"],
            &["set", "V.A.WCS", "-123.456", "--axis", "2"],
            &["set", "V.CYC.count", "7", "--type", "UNS32"],
            &["set", "mc_command_single_block_w", "TRUE"],
            &["set", "example.program", "x.nc"],
            &["set", "V.P.count", "4", "--edition", "de-1.051"],
            &["set", "V.E.vartest", "7", "--type", "UNS16", "--dry-run"],
            &["set", "V.E.vartest", "7", "--dry-run"],
            &["set", "V.E.matrix", "[[1,2,3],[4,5,6]]"],
        ])
    );
}

#[test]
fn failed_writes_have_a_reason() {
    insta::assert_snapshot!(
        "set-troubles",
        shown(&[
            &["set", "V.E.vartest", "65536"],
            &["set", "V.E.test", "1,2,3"],
            &["set", "V.E.boolean", "maybe"],
            &["set", "V.E.text", "a text with more characters"],
            &["set", "V.E.Variable_3", "1,0"],
            &["set", "V.E.nothing", "1"],
            &["set", "mc_active_single_block_r", "1"],
            &["set", "mc_program_stream_w", "N10"],
            &["set", "P1", "3"],
            &["set", "V.P.count", "4"],
            &["set", "V.A.WCS", "1,5", "--axis", "2"],
            &["set", "V.E.matrix", "[[1,2],[3,4],[5,6]]"],
        ])
    );
}

/// A channel that does not exist does not affect the output of other channels, and a channel may be named
/// twice.
#[test]
fn missing_channels_are_reported() {
    let browse = |args: &[&str]| {
        let output = ads_cnc(&[&["browse", "--filter", "feedhold", "--channel"], args].concat());
        (text(&output.stdout).lines().count(), text(&output.stderr))
    };
    let listed = browse(&["1,1,6"]);
    let simulated = "ads-cnc: using a simulated CNC, because --target is not given\n";
    assert_eq!(listed, (3, simulated.to_owned()));
    let listed = browse(&["9,1"]);
    let absent = "ads-cnc: the CNC has no active channel 9; channels: 1, 2, 6\n";
    assert_eq!(listed, (2, format!("{simulated}{absent}")));
}

/// On a CNC without descriptions by name, the tools search a variable by index.
#[test]
fn older_cncs_are_queried_by_index() {
    let device = Device::start(&["--cnc-version", "V3.1.3131.0"]);
    assert_eq!(device.value(&["V.E.matrix[1][2]"]), "23");
    assert_eq!(device.value(&["V.G.NP[1].V"]), "4.0,5.0,6.0");
    assert_eq!(device.value(&["V.A.ACT_POS.Y"]), "-200.5");
    assert_eq!(device.value(&["V.CYC.count", "--type", "UNS32"]), "42");
}

/// Only values that a file names are written to a device. The error for another write contains the entry
/// that would allow it.
#[test]
fn writes_to_a_device_need_an_entry() {
    let device = Device::start(&[]);
    let cases: [(&str, &[&str], &str, &str); 6] = [
        ("V.E.test[4]", &[], "567", "-1"),
        ("V.E.matrix", &[], "11,12,13,21,22,23", "1,2,3,4,5,6"),
        ("V.A.WCS", &["--axis", "2"], "1234.2", "123.456"),
        ("mc_command_single_block_w", &[], "FALSE", "TRUE"),
        ("example.feed", &[], "-1500", "12"),
        ("example_long_string_w", &[], "", "Länge, 5€"),
    ];
    for (name, options, old, new) in cases {
        let get = [&[name], options].concat();
        let set = [&["set", name, new], options].concat();
        let rejected = device.call(&set);
        let why = text(&rejected.stderr);
        assert_eq!(rejected.status.code(), Some(4), "{name}: {why}");
        assert_eq!(device.value(&get), old, "{name}");

        let (_, file) = why.split_once("--allow-write:\n\n").unwrap();
        let file: Vec<&str> =
            file.lines()
                .take_while(|line| !line.starts_with("ads-cnc: "))
                .map(|line| {
                    if line.starts_with("expires") {
                        "expires = 9999-12-31T23:59:59Z"
                    } else {
                        line
                    }
                })
                .collect();
        let file = TestFile::new(".toml", file.join("\n").as_bytes());
        let with_file = [&set[..], &["--allow-write", file.path()]].concat();
        let output = device.call(&with_file);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", text(&output.stderr));
        assert_eq!(text(&output.stdout), format!("{name}: {old} → {new}\n"));
        assert_eq!(text(&output.stderr), "");
        assert_eq!(device.value(&get), new, "{name}");

        // The entry allows only the value that it names.
        let other = ["set", "V.E.uns32", "1", "--allow-write", file.path()];
        assert_eq!(device.call(&other).status.code(), Some(4));
        assert_eq!(device.value(&["V.E.uns32"]), "4294967295");
    }
}

/// An entry may contain the name of an object, whose address the tool finds.
#[test]
fn an_object_is_allowed_by_its_name() {
    let device = Device::start(&[]);
    let file =
        TestFile::allowing("[[object]]\nchannel = 1\nname = \"mc_command_single_block_w\"\n");
    let set = ["set", "mc_command_single_block_w", "TRUE", "--allow-write", file.path()];
    let output = device.call(&set);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let other = ["set", "example_enable_w", "TRUE", "--of", "COM axis 1"];
    let other = [&other[..], &["--allow-write", file.path()]].concat();
    assert_eq!(device.call(&other).status.code(), Some(4));
}

/// A file for another device, or an expired file, allows nothing.
#[test]
fn a_file_applies_to_one_device_until_it_expires() {
    let device = Device::start(&[]);
    for (target, expires) in
        [("192.0.2.7.1.1", "9999-12-31T23:59:59Z"), ("127.0.0.1.1.1", "2020-01-01T00:00:00Z")]
    {
        let file = format!(
            "target = \"{target}\"\nexpires = {expires}\n\
             [[variable]]\nchannel = 1\nname = \"V.E.vartest\"\n"
        );
        let file = TestFile::new(".toml", file.as_bytes());
        let set = ["set", "V.E.vartest", "1", "--allow-write", file.path()];
        assert_eq!(device.call(&set).status.code(), Some(4));
        // A file also applies to the simulated CNC.
        assert_eq!(ads_cnc(&set).status.code(), Some(4));
    }
    assert_eq!(device.value(&["V.E.vartest"]), "4711");
}

/// `browse` prints the same for a device as for the simulated CNC with the same model.
#[test]
fn a_device_is_browsed() {
    let device = Device::start(&[]);
    let output = device.call(&["browse", "--exact"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(text(&output.stdout), text(&ads_cnc(&["browse"]).stdout));
    // An option for the simulated CNC is rejected together with a target.
    let output = device.call(&["browse", "--cnc-version", "V4.29.0"]);
    assert_eq!(output.status.code(), Some(2));
}

/// The output of `tables --json` matches its schema, and the text output contains the same streams.
#[test]
fn tables_match_their_schema() {
    let tables: Value = serde_json::from_slice(&ads_cnc(&["tables", "--json"]).stdout).unwrap();
    check_schema(&tables, "tables");
    let shown = text(&ads_cnc(&["tables"]).stdout);
    for stream in tables["streams"].as_array().unwrap() {
        let name = stream["name"].as_str().unwrap();
        assert!(shown.contains(&format!("{name}: ")), "{name}");
    }
}

#[test]
fn json_matches_its_schema() {
    let calls: [&[&str]; 4] = [
        &["browse", "--format", "json", "--content"],
        &["browse", "--format", "json", "--variables", "--content"],
        &["browse", "--format", "json", "--filter", "feedhold"],
        &["get", "V.E.cube", "--json"],
    ];
    for args in calls {
        let document: Value = serde_json::from_slice(&ads_cnc(args).stdout).unwrap();
        check_schema(&document, "objects");
        let objects = document["objects"].as_array().unwrap();
        assert!(!objects.is_empty() && document["notes"] == serde_json::json!([]), "{args:?}");
        if args[0] == "get" {
            assert_eq!(objects[0]["value"][1][2][3], 23);
        }
    }
}

/// Texts of a device are escaped for terminals and spreadsheets in every format.
#[test]
fn texts_of_a_device_are_escaped() {
    let model = text(&ads_cnc(&["serve", "--print-model"]).stdout);
    let unit = "name = \"example.block\", type = \"SGN32\", unit = \"";
    assert!(model.contains(&format!("{unit}-\"")));
    let hostile = "=cmd|'/C calc'!A0\\u001b[2J\\u007f\\u0090\\u009d";
    let model = model.replace(&format!("{unit}-\""), &format!("{unit}{hostile}\""));
    let value = "value = \"main.nc\"";
    assert!(model.contains(value));
    let model = model.replace(value, "value = \"@SUM(A1)\\u0090\\u007f\"");
    let model = TestFile::new(".toml", model.as_bytes());
    let device = Device::start(&["--model", model.path()]);
    let shown = |format: &str| {
        let output =
            device.call(&["browse", "--filter", "example.", "--content", "--format", format]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let shown = text(&output.stdout);
        assert!(!shown.contains(|one: char| one.is_control() && !matches!(one, '\n' | '\r')));
        shown
    };
    assert!(shown("table").contains("calc'!A0\\u{1b}[2J\\u{7f}\\u{90}\\u{9d}"));
    let csv = shown("csv");
    assert!(csv.contains(",'=cmd|'/C calc'!A0\\u{1b}") && csv.contains(",'@SUM(A1)"), "{csv}");
    assert!(csv.lines().flat_map(|line| line.split(',')).all(|cell| !cell.starts_with(['=', '@'])));
    let json = shown("json");
    assert!(
        json.contains("A0\\u001b[2J\\u007f\\u0090\\u009d") && json.contains("(A1)\\u0090\\u007f")
    );
    let read: Value = serde_json::from_str(&json).unwrap();
    let is_read = |one: &Value| one["unit"] == "=cmd|'/C calc'!A0\u{1b}[2J\u{7f}\u{90}\u{9d}";
    assert!(read["objects"].as_array().unwrap().iter().any(is_read), "{json}");
    for form in [&["get", "example.program", "--json"][..], &["get", "example.program"]] {
        let output = device.call(&[form, &["--of", "path preparation channel 1"]].concat());
        let shown = [output.stdout, output.stderr].concat();
        assert!(!text(&shown).contains(|one: char| one.is_control() && one != '\n'), "{form:?}");
    }
}
