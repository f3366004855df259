//! Foreign texts in a report are escaped in every format: the names of a device, and the texts of a
//! foreign report, of a profile and of waivers.

use std::fs;
use std::time::{Duration, Instant};

use ads_cnc_conformance::report::{self, Report};
use serde_json::{Value, json};

use super::{FORMS, TestFolder, VERBOSE, ads_cnc, elements, everything};
use crate::common::Serve;

/// Texts that a device sends are escaped on the console and in the Markdown, HTML and JUnit
/// reports.
#[test]
fn texts_of_a_device_are_escaped() {
    let folder = TestFolder::new();
    let mut document = everything(&folder);
    let odd = "</script><script>alert(1)</script> | `x` ]]> & \u{1}\u{fffe}";
    let acting = "C\u{1b}[31m\u{9b}2J\0\u{202e}\n\n# A heading";
    document["target"]["name"] = json!(odd);
    document["target"]["language"] = json!(acting);
    // The Markdown report contains only some failures.
    let cases = document["cases"].as_array_mut().unwrap();
    let has_evidence = |case: &Value| case["failures"][0]["evidence"].is_object();
    let at = cases.iter().position(has_evidence).unwrap();
    for (place, case) in cases.iter_mut().enumerate() {
        if place != at {
            case.as_object_mut().unwrap().remove("failures");
        }
    }
    let failed = &mut cases[at];
    failed["failures"][0]["found"] = json!(format!("{odd}\n```\n# no heading {acting}"));
    failed["failures"][0]["evidence"]["result"] = json!(acting);
    failed["note"] = json!(acting);
    failed["title"] = json!(odd);
    let report = Report::from_json(&document.to_string()).unwrap();
    let made = |make: fn(&Report, &mut dyn std::io::Write) -> std::io::Result<()>| {
        let mut text = Vec::new();
        make(&report, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    };
    let shown = made(|report, out| report::print(report, VERBOSE, out));
    for text in [shown, made(report::to_markdown), made(report::to_html), made(report::to_junit)] {
        assert!(!text.contains(|one: char| one.is_control() && one != '\n'), "{text}");
        assert!(!text.contains("\u{202e}") && !text.contains("\n# A heading"), "{text}");
    }
    let html = made(report::to_html);
    assert!(!html.contains("<script>alert"), "a script of the target's");
    assert!(html.contains("&lt;script&gt;alert(1)"));
    let xml = made(report::to_junit);
    assert!(!elements(&xml).is_empty() && !xml.contains(['\u{1}', '\u{fffe}']));
    let markdown = made(report::to_markdown);
    assert!(
        markdown.contains(
            "## ads-cnc: &lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt; \\| \\`x\\`"
        )
    );
    // A summary is HTML, in which a backslash escapes nothing.
    let is_plain = |line: &str| line.starts_with("<details>") && line.contains("| `x`");
    assert!(markdown.lines().any(is_plain), "{markdown}");
    // A fence of a code block is longer than any fence in the text of the block.
    assert!(markdown.contains("````text\n"));
    let badge: Value = serde_json::from_str(&made(report::to_badge)).unwrap();
    assert_eq!(badge["schemaVersion"], 1);
}

/// Replaces one text of each kind in a report in turn by active content, which must be escaped in
/// every format.
#[test]
fn all_texts_of_a_foreign_report_are_escaped() {
    let folder = TestFolder::new();
    let mut document = everything(&folder);
    // Keeps only one case, with every kind of text, because most cases are alike.
    let cases = document["cases"].as_array_mut().unwrap();
    let failed = cases.iter().position(|case| case.get("failures").is_some()).unwrap();
    let mut case = cases[failed].clone();
    case["note"] = json!("a note");
    case["stream"] = json!("a stream");
    case["failures"].as_array_mut().unwrap().truncate(1);
    *cases = vec![case];
    document["target"] = json!({
        "name": "n", "version": "n", "language": "n", "command": "n", "address": "n",
        "net_id": "n", "stderr": "n", "file": "n",
        "device": {"name": "n", "version": "n", "state": "n"},
    });
    document["profile"]["claims"] = json!({"text": "n", "list": ["n"], "table": {"one": "n"}});
    let acting = "\u{1b}[2J\u{9b}1m\u{7f}\u{90}\u{202e}\r\n\n# H <img src=x onerror=y> `|\u{ffff}";
    let mut seen = std::collections::BTreeSet::new();
    for path in texts(&document) {
        let kind: Vec<&str> = path.split('/').filter(|part| part.parse::<u32>().is_err()).collect();
        if !seen.insert(kind.join("/")) {
            continue;
        }
        let mut foreign = document.clone();
        *foreign.pointer_mut(&path).unwrap() = json!(acting);
        // Some keys only allow known words; with another word, the JSON is not a report.
        let Ok(report) = Report::from_json(&foreign.to_string()) else { continue };
        let made = |make: fn(&Report, &mut dyn std::io::Write) -> std::io::Result<()>| {
            let mut text = Vec::new();
            make(&report, &mut text).unwrap();
            String::from_utf8(text).unwrap()
        };
        let (markdown, junit) = (made(report::to_markdown), made(report::to_junit));
        let (html, json) = (made(report::to_html), made(report::to_json));
        let shown = made(|report, out| report::print(report, VERBOSE, out));
        for text in [&shown, &markdown, &junit, &html, &json, &made(report::to_badge)] {
            let acts = |one: char| one.is_control() && one != '\n' || one == '\u{202e}';
            assert!(!text.contains(acts), "{path}: {text:?}");
        }
        assert!(!html.contains("<img"), "{path}");
        let fenced = |text: &str| {
            let mut outside = String::new();
            let mut fence: Option<String> = None;
            for line in text.lines() {
                let ticks: String = line.chars().take_while(|one| *one == '`').collect();
                match &fence {
                    Some(open) if *open == line => fence = None,
                    Some(_) => {}
                    None if ticks.len() > 2 => fence = Some(ticks),
                    None => outside.extend([line, "\n"]),
                }
            }
            outside
        };
        let outside = fenced(&markdown);
        assert!(!outside.contains("<img") && !outside.contains("\n# H"), "{path}: {outside}");
        assert!(!elements(&junit).is_empty() && !junit.contains("<img"), "{path}");
    }
    assert!(seen.len() > 40, "{seen:?}");

    // The error for an invalid report is escaped, too.
    let file = folder.file("odd.json");
    let mut odd = document;
    odd["\u{1b}[2J\u{9b}"] = json!(1);
    fs::write(&file, odd.to_string()).unwrap();
    let output = ads_cnc(&["report", &file]);
    let why = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{why}");
    assert!(why.contains("[2J") && !why.contains(['\u{1b}', '\u{9b}']), "{why:?}");
}

/// Thousands of failures of one case are grouped in linear time; a comparison of each pair takes more
/// than 10 s.
#[test]
fn many_failures_are_grouped_in_linear_time() {
    let folder = TestFolder::new();
    let mut document = everything(&folder);
    let cases = document["cases"].as_array_mut().unwrap();
    let failed = cases.iter().position(|case| case.get("failures").is_some()).unwrap();
    cases.swap(0, failed);
    cases.truncate(1);
    let mut failure = cases[0]["failures"][0].clone();
    failure.as_object_mut().unwrap().remove("evidence");
    let failures = (0..20_000).map(|number| {
        failure["found"] = json!(format!("{number}"));
        failure.clone()
    });
    cases[0]["failures"] = failures.collect();
    let report = Report::from_json(&document.to_string()).unwrap();
    let begun = Instant::now();
    let mut text = Vec::new();
    report::to_junit(&report, &mut text).unwrap();
    report::to_markdown(&report, &mut text).unwrap();
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
}

/// A report with a subject twice, or with a requirement twice in a subject, is rejected.
#[test]
fn repeated_subjects_and_requirements_are_rejected() {
    let document = super::run(&["--only", "VAR-1"]);
    let rejected = |at: &str, why: &str| {
        let mut twice = document.clone();
        let list = twice.pointer_mut(at).unwrap().as_array_mut().unwrap();
        list.push(list[0].clone());
        assert_eq!(Report::from_json(&twice.to_string()).unwrap_err(), why);
    };
    let subject = document["subjects"][0]["subject"].as_str().unwrap();
    let requirement = &document["subjects"][0]["areas"][0]["requirements"][0]["requirement"];
    let requirement = requirement.as_str().unwrap();
    rejected("/subjects", &format!("subjects contains {subject} twice"));
    let why = format!("the subject {subject} contains {requirement} twice");
    rejected("/subjects/0/areas/0/requirements", &why);
}

/// JSON pointers to all texts in a value.
fn texts(value: &Value) -> Vec<String> {
    let below = |key: &str, value: &Value| -> Vec<String> {
        let key = key.replace('~', "~0").replace('/', "~1");
        texts(value).into_iter().map(|path| format!("/{key}{path}")).collect()
    };
    match value {
        Value::String(_) => vec![String::new()],
        Value::Array(items) => {
            let items = items.iter().enumerate();
            items.flat_map(|(at, item)| below(&at.to_string(), item)).collect()
        }
        Value::Object(fields) => fields.iter().flat_map(|(key, value)| below(key, value)).collect(),
        _ => Vec::new(),
    }
}

/// Names and reasons in a profile and in waivers are escaped, too.
#[test]
fn texts_of_profiles_and_waivers_are_escaped() {
    let folder = TestFolder::new();
    let serve = Serve::start(&[]);
    let (profile, waivers) = (folder.file("profile.toml"), folder.file("waivers.toml"));
    let acting = "\\u001b[2J\\u009b\\u007f\\n# H <img src=x>";
    fs::write(&profile, format!("name = \"{acting}\"\n")).unwrap();
    let waiver = format!(
        "[[waiver]]\ntest = \"com-count\"\nrequirement = \"VAR-8\"\nverdict = \"fail\"\n\
         reason = \"{acting}\"\nexpires = 9999-12-31\n"
    );
    fs::write(&waivers, waiver).unwrap();
    let forms = FORMS.map(|form| (format!("--{form}"), folder.file(form)));
    let forms: Vec<&str> =
        forms.iter().flat_map(|(form, file)| [form.as_str(), file.as_str()]).collect();
    let target = ["--target", &serve.addr, "--net-id", &serve.net_id, "--only", "VAR-1"];
    let files = ["--profile", &profile, "--waivers", &waivers];
    let output = ads_cnc(&[&["run"], &target[..], &files, &forms].concat());
    let shown = [output.stdout, output.stderr].concat();
    let shown = String::from_utf8(shown).unwrap();
    assert!(shown.contains("[2J"), "{shown}");
    for text in FORMS.map(|form| folder.read(form)).iter().chain([&shown]) {
        assert!(!text.contains(|one: char| one.is_control() && one != '\n'), "{text:?}");
        assert!(!text.contains("\n# H"), "{text}");
    }
    assert!(!folder.read("html").contains("<img") && !folder.read("markdown").contains("<img"));
}
