//! The formats of a report: each is converted only from the JSON report. The tests check that the
//! formats are well-formed and contain certain facts.

mod foreign;

use std::fs;

use crate::common::file::TestFolder;
use crate::common::{Serve, ads_cnc, check_schema};
use ads_cnc_conformance::report::{self, Detail, DisplayOptions, Report};
use quick_xml::events::Event;
use quick_xml::{Reader, XmlVersion};
use serde_json::{Value, json};

fn run(args: &[&str]) -> Value {
    let output = ads_cnc(&[&["run", "--json", "-"], args].concat());
    serde_json::from_slice(&output.stdout).unwrap()
}

const FORMS: [&str; 4] = ["html", "junit", "markdown", "badge"];
const DEFECT: &str = "variable-description.size.flip";
const VERBOSE: DisplayOptions =
    DisplayOptions { detail: Detail::Verbose, color: false, found_shown: false };

/// A report with many parts, such as failures with bytes, waivers and a selection.
fn everything(folder: &TestFolder) -> Value {
    let waivers = folder.file("waivers.toml");
    let entry = |test: &str, requirement: &str| {
        format!(
            "[[waiver]]\ntest = \"{test}\"\nrequirement = \"{requirement}\"\nverdict = \"fail\"\n\
             reason = \"<known> | & \\\"so\\\"\"\nexpires = 9999-12-31\n"
        )
    };
    let text = [entry("var-descriptions", "VAR-8"), entry("com-count", "VAR-8")].concat();
    fs::write(&waivers, text).unwrap();
    run(&["--defect", DEFECT, "--only", "VAR", "--waivers", &waivers, "--seed", "7"])
}

#[test]
fn json_matches_its_schema_and_is_read_back() {
    let folder = TestFolder::new();
    let testee = format!("\"{}\" testee", env!("CARGO_BIN_EXE_ads-cnc"));
    let noisy = format!("{testee} --miniature noisy");
    let rejecting = format!("{testee} --miniature rejects-all");
    let unreadable = format!("{testee} --miniature not-json");
    let client = format!("\"{}\" client", env!("CARGO_BIN_EXE_ads-cnc"));
    let dying = format!("{client} --defect client.dies");
    let garbling = format!("{client} --defect client.garbles");
    let dying = run(&["--client", &dying, "--only", "client-name-data-length-huge"]);
    let serve = Serve::start(&[]);
    let capture = folder.file("run.pcapng");
    run(&["--only", "VAR-11", "--capture", &capture]);
    let checked = ads_cnc(&["check", &capture, "--any-port", "--json", "-"]);
    let checked: Value = serde_json::from_slice(&checked.stdout).unwrap();
    let reports = [
        run(&[]),
        run(&["--testee", &noisy, "--only", "VAR-11"]),
        run(&["--testee", &rejecting, "--only", "VAR-11"]),
        run(&["--testee", &unreadable, "--only", "VAR-11"]),
        run(&["--target", &serve.addr, "--net-id", &serve.net_id]),
        everything(&folder),
        run(&["--defect", "object-descriptor.size.flip"]),
        run(&["--defect", "variable-value.value.invert", "--edition", "de-1.051"]),
        run(&["--defect", "variable-handle-read.index_count.flip"]),
        run(&["--edition", "en-1.05", "--only", "VAR-20"]),
        run(&["--client", &client, "--only", "client-name-twice"]),
        run(&["--client", &garbling, "--only", "client-name-data-length-huge"]),
        dying,
        checked,
    ];
    for document in reports {
        check_schema(&document, "report");
        let read = Report::from_json(&document.to_string()).unwrap();
        assert_eq!(serde_json::to_value(&read).unwrap(), document);
    }
}

/// A failure of the protocol of testees or clients names the document that specifies the protocol.
#[test]
fn protocol_failures_name_their_document() {
    for (kind, id, text) in [("client", "CLIENT", "CLIENTS.md"), ("testee", "TESTEE", "README.md")]
    {
        let report = run(&[&format!("--{kind}"), "exit 3"]);
        let cases = report["cases"].as_array().unwrap().iter();
        let mut failed = cases.flat_map(|case| case["failures"].as_array().into_iter().flatten());
        let failed = failed.find(|one| one["requirement"] == id).unwrap();
        assert_eq!(failed["sources"], json!([format!("conformance/adapters/{text}")]));
        assert!(failed["clause"].as_str().unwrap().ends_with(&format!("a {kind}.")), "{failed:#}");
        // The totals of the subject count the failure.
        let subject = &report["subjects"][0];
        assert_eq!(subject["totals"]["fail"], 1, "{subject:#}");
        assert_eq!(subject["areas"].as_array().unwrap().last().unwrap()["area"], id);
        let read = Report::from_json(&report.to_string()).unwrap();
        let mut text = Vec::new();
        report::print(&read, DisplayOptions::default(), &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(text.contains(&format!("NOT PASSED  {kind}: 1 fail ({id}), ")), "{text}");
    }
}

#[test]
fn formats_are_converted_from_the_json_only() {
    let folder = TestFolder::new();
    let json = folder.file("report.json");
    let mut args = vec!["run".to_owned(), "--defect".to_owned(), DEFECT.to_owned()];
    args.extend(["--json".to_owned(), json.clone()]);
    for form in FORMS {
        args.extend([format!("--{form}"), folder.file(&format!("with-run.{form}"))]);
    }
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let output = ads_cnc(&args);
    assert_eq!(output.status.code(), Some(1));
    for form in FORMS {
        let option = format!("--{form}");
        let later = ads_cnc(&["report", &json, &option, "-"]);
        assert_eq!(later.status.code(), Some(0), "{form}");
        assert_eq!(later.stdout, folder.read(&format!("with-run.{form}")).into_bytes(), "{form}");
    }
    // `report` prints the same output as the run.
    assert_eq!(ads_cnc(&["report", &json]).stdout, output.stdout);
}

#[test]
fn invalid_reports_are_rejected() {
    let folder = TestFolder::new();
    let odd = folder.file("odd.json");
    for (text, why) in [
        ("", "the JSON ends too early, at line 1"),
        ("{\"format\":2}", "report format 2 instead of 1"),
        ("{\"format\":1,\n\"suit\":1}", "line 2"),
    ] {
        fs::write(&odd, text).unwrap();
        let output = ads_cnc(&["report", &odd]);
        let stderr_text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{stderr_text}");
        assert!(stderr_text.contains(why) && stderr_text.contains("odd.json"), "{stderr_text}");
    }
    for more in [["--junit", "-"], ["--against", &odd]] {
        let both = ads_cnc(&[&["report", &odd, "--html", "-"][..], &more].concat());
        let stderr_text = String::from_utf8(both.stderr).unwrap();
        assert_eq!(both.status.code(), Some(2));
        assert!(stderr_text.contains("can be written to stdout"), "{stderr_text}");
    }
    assert_eq!(ads_cnc(&["report", "/no/such/report.json"]).status.code(), Some(2));
}

/// The elements of an XML document: the path and the attributes of each.
fn elements(xml: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut reader = Reader::from_str(xml);
    let (mut path, mut all) = (Vec::new(), Vec::new());
    loop {
        let event = reader.read_event().unwrap();
        if let Event::Start(element) | Event::Empty(element) = &event {
            path.push(String::from_utf8(element.name().as_ref().to_vec()).unwrap());
            let attributes = element.attributes().map(|attribute| {
                let attribute = attribute.unwrap();
                let key = String::from_utf8(attribute.key.as_ref().to_vec()).unwrap();
                let value = attribute.normalized_value(XmlVersion::Implicit1_0).unwrap();
                (key, value.into_owned())
            });
            all.push((path.join("/"), attributes.collect()));
        }
        match event {
            Event::End(_) | Event::Empty(_) => drop(path.pop()),
            Event::Eof => return all,
            _ => {}
        }
    }
}

#[test]
fn junit_has_a_test_for_each_case() {
    let folder = TestFolder::new();
    let mut document = everything(&folder);
    document["ended"] = json!("interrupted");
    let report = Report::from_json(&document.to_string()).unwrap();
    let mut xml = Vec::new();
    report::to_junit(&report, &mut xml).unwrap();
    let elements = elements(std::str::from_utf8(&xml).unwrap());
    let at = |path: &str| -> Vec<&Vec<(String, String)>> {
        elements.iter().filter(|(at, _)| at == path).map(|(_, attributes)| attributes).collect()
    };
    let value = |attributes: &[(String, String)], name: &str| {
        attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.clone()).unwrap()
    };
    let test = "testsuites/testsuite/testcase";
    let cases = document["cases"].as_array().unwrap();
    // The stale waiver is an additional test case.
    assert_eq!(at(test).len(), cases.len() + 1);
    let root = at("testsuites")[0];
    for (name, path) in [("tests", ""), ("failures", "/failure"), ("skipped", "/skipped")] {
        let counted = at(&format!("{test}{path}")).len();
        assert_eq!(value(root, name), counted.to_string(), "{name}");
    }
    // JUnit states times in seconds.
    let suites = at("testsuites/testsuite");
    let subjects = suites.iter().filter(|suite| value(suite, "name") != "waivers");
    let seconds =
        |attributes: &[(String, String)]| value(attributes, "time").parse::<f64>().unwrap();
    let sum: f64 = subjects.map(|suite| seconds(suite)).sum();
    assert!(sum > 0.0 && (seconds(root) - sum).abs() < 0.01, "{root:?}");
    assert!(at(test).iter().any(|case| case.iter().any(|(name, _)| name == "time")));
    let errors = document["cases"].as_array().unwrap().iter();
    let errors = errors.filter(|case| case["verdict"] == "inconclusive" && case["waived"] != true);
    assert_eq!(value(root, "errors"), errors.count().to_string());
    let skipped = at(&format!("{test}/skipped"));
    let why = "VAR-8 waived until 9999-12-31: <known> | & \"so\"";
    assert!(skipped.iter().any(|one| value(one, "message") == why));
    let property = "testsuites/testsuite/properties/property";
    let vectors = ("vectors", report.vectors.as_str());
    for (name, fact) in [("seed", "7"), vectors, ("only", "VAR"), ("ended", "interrupted")] {
        let found = at(property).into_iter().find(|one| value(one, "name") == name);
        assert_eq!(value(found.unwrap(), "value"), fact);
    }
}

/// Reports are converted to conformance statements. A comparison of two reports fails if there are
/// new failures.
#[test]
fn reports_are_converted_to_statements_and_compared() {
    let folder = TestFolder::new();
    let (now, before) = (folder.file("now.json"), folder.file("before.json"));
    fs::write(&now, everything(&folder).to_string()).unwrap();
    fs::write(&before, run(&["--only", "VAR", "--seed", "7"]).to_string()).unwrap();
    for form in ["statement.md", "statement.html"] {
        let file = folder.file(form);
        assert_eq!(ads_cnc(&["report", &now, "--statement", &file]).status.code(), Some(0));
        let text = folder.read(form);
        for part in
            ["Conformance statement", "VAR-8", "not passed; not met: ", "verified", "seed 7"]
        {
            assert!(text.contains(part), "{form}: {part}");
        }
    }
    let against = |one: &str, other: &str| {
        let output = ads_cnc(&["report", one, "--against", other]);
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    let (code, shown) = against(&now, &before);
    assert!(code == Some(1) && shown.contains("\nnewly failing     VAR-8    codec  "), "{shown}");
    let (code, shown) = against(&before, &now);
    assert!(code == Some(0) && shown.contains("\nfixed             VAR-8    codec  "), "{shown}");
    let (code, shown) = against(&now, &now);
    assert!(
        code == Some(0) && shown.contains("\n0 newly failing, 0 newly deviating, 0 fixed, "),
        "{shown}"
    );
    let quiet = ads_cnc(&["report", "-q", &now, "--against", &before]).stdout;
    let quiet = String::from_utf8(quiet).unwrap();
    assert!(quiet.lines().count() == 1 && quiet.contains(" newly failing, "), "{quiet}");
}

/// A comparison with an interrupted run states the interruption in one line, and is not a success. A
/// comparison of runs with different settings has warnings.
#[test]
fn a_comparison_with_fewer_verdicts_is_not_a_success() {
    let folder = TestFolder::new();
    let (now, before) = (folder.file("now.json"), folder.file("before.json"));
    let mut document = run(&["--only", "VAR-11", "--seed", "7"]);
    fs::write(&before, document.to_string()).unwrap();
    for case in document["cases"].as_array_mut().unwrap() {
        for one in case["requirements"].as_array_mut().unwrap() {
            one["verdict"] = json!("interrupted");
        }
    }
    document["suite"] = json!("9.9.9");
    document["vectors"] = json!("8.8.8");
    document["editions"] = json!(["de-1.051"]);
    document["only"] = json!(["VAR"]);
    document["target"]["net_id"] = json!("192.0.2.10.1.1");
    document["profile"]["claims"]["platform_axes"] = json!(9);
    fs::write(&now, document.to_string()).unwrap();
    let output = ads_cnc(&["report", &now, "--against", &before]);
    let shown = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(3), "{shown}");
    assert_eq!(shown.matches("no longer judged  ").count(), 1, "{shown}");
    for part in [
        " verdicts: the run was interrupted\n",
        " before, 9.9.9 now\nwarning  different vectors: ",
        " before, 8.8.8 now\n",
        "\nwarning  different editions: en-1.05, de-1.051 before, de-1.051 now\n",
        "\nwarning  different target: ",
        "\nwarning  different claims of the profile: platform_axes\n",
        "\nwarning  different selection: VAR-11 before, VAR now\n",
    ] {
        assert!(shown.contains(part), "{part:?}: {shown}");
    }
}

/// Runs cases with a defect of the descriptors, and waives some of the verdicts.
fn run_waived(only: &str, waived: &[[&str; 3]]) -> (Value, TestFolder) {
    let folder = TestFolder::new();
    let waivers = folder.file("waivers.toml");
    let entry = |[test, requirement, verdict]: &[&str; 3]| {
        format!(
            "[[waiver]]\ntest = \"{test}\"\nrequirement = \"{requirement}\"\nverdict = \"{verdict}\"\n\
             reason = \"known\"\nexpires = 9999-12-31\n"
        )
    };
    fs::write(&waivers, waived.iter().map(entry).collect::<String>()).unwrap();
    let defect = "object-descriptor.size.flip";
    let document = run(&["--seed", "1", "--only", only, "--defect", defect, "--waivers", &waivers]);
    fs::write(folder.file("run.json"), document.to_string()).unwrap();
    (document, folder)
}

/// A waiver accepts one verdict: a check that follows from the waived failure still fails the run,
/// and the report names it.
#[test]
fn a_waiver_does_not_accept_what_follows() {
    let (mut document, folder) = run_waived(
        "com-descriptors,printed-descriptor-printed",
        &[["printed-descriptor-printed", "COM-2", "fail"]],
    );
    assert_eq!(document["exit_code"], 3);
    // With another failure, some of the warnings are not shown.
    let cases = document["cases"].as_array_mut().unwrap();
    let mut other = cases[0].clone();
    let failure = other["failures"][0].clone();
    let all = ["COM-1", "COM-3", "COM-4", "COM-5", "COM-6"].map(|requirement| {
        let mut failure = failure.clone();
        failure["requirement"] = json!(requirement);
        failure["verdict"] = json!(if requirement == "COM-1" { "fail" } else { "warning" });
        failure["follows"] = Value::Null;
        failure["waived"] = json!(false);
        failure["expected"] = json!(requirement);
        failure
    });
    (other["id"], other["failures"]) = (json!("other"), json!(all));
    cases.push(other);
    fs::write(folder.file("run.json"), document.to_string()).unwrap();
    let shown = ads_cnc(&["report", &folder.file("run.json")]).stdout;
    let shown = String::from_utf8(shown).unwrap();
    assert!(shown.contains("1 other deviation"), "{shown}");
    let cause = "FAIL, WAIVED  COM-2  printed-descriptor-printed: size: 0 where 1 is expected\n  \
                 follows from it: com-descriptors (GEN-5)\n";
    assert!(shown.contains(cause), "{shown}");
}

/// Forms that summarise the result say that a requirement is not met, or not verified, even if the
/// verdict is waived.
#[test]
fn waived_verdicts_are_in_the_result() {
    let case = "vec-descriptor-writable";
    let (document, folder) =
        run_waived(case, &[[case, "COM-2", "fail"], [case, "COM-5", "inconclusive"]]);
    assert_eq!(document["exit_code"], 0);
    for (form, part) in [
        ("--statement", "| passed; not met, waived: COM-2; not verified, waived: COM-5 |"),
        ("--html", "No requirement fails, except those that are waived or only deviate."),
    ] {
        let (report, file) = (folder.file("run.json"), folder.file("converted.md"));
        assert_eq!(ads_cnc(&["report", &report, form, &file]).status.code(), Some(0));
        assert!(folder.read("converted.md").contains(part), "{form}");
    }
}

/// In print, long rows of the HTML report may break across pages, because otherwise the rest of the
/// previous page would stay empty.
#[test]
fn long_rows_may_break_in_print() {
    let folder = TestFolder::new();
    let mut document = everything(&folder);
    let case = document["cases"].as_array().unwrap();
    let mut failed = case.iter().find(|case| case.get("failures").is_some()).unwrap().clone();
    let row = |offset, count| json!({"offset": offset, "hex": vec!["6e"; count].join(" "), "field": "name"});
    let mut failure = failed["failures"][0].clone();
    failure["evidence"] = json!({"call": "", "result": "", "sent": {
        "length": 385,
        "fields": [row(0, 256), row(256, 65), row(321, 64)],
    }});
    failed["failures"] = json!([failure]);
    document["cases"] = json!([failed]);
    let report = Report::from_json(&document.to_string()).unwrap();
    let mut html = Vec::new();
    report::to_html(&report, &mut html).unwrap();
    let html = String::from_utf8(html).unwrap();
    assert_eq!(html.matches("<tr class=\" long\">").count(), 2);
    assert!(html.contains("tr:not(.long), blockquote, .area { break-inside: avoid; }"));
}

/// The HTML report loads no resources, and contains the cases and the failures even without a
/// script.
#[test]
fn html_is_self_contained() {
    let folder = TestFolder::new();
    let report = Report::from_json(&everything(&folder).to_string()).unwrap();
    let mut html = Vec::new();
    report::to_html(&report, &mut html).unwrap();
    let html = String::from_utf8(html).unwrap();
    for outside in ["http://", "https://", "src=", "url(", "@import", "{{", "{%"] {
        assert!(!html.contains(outside), "{outside}");
    }
    assert_eq!(html.matches("href=").count(), html.matches("href=\"#").count());
    let (before, script) = html.split_once("<script>").unwrap();
    assert!(script.contains("</script>\n</body>"));
    for fact in [
        "seed 7",
        "variable-description.size.flip",
        "1 stale",
        "prefers-color-scheme",
        "@media print",
    ] {
        assert!(before.contains(fact), "{fact}");
    }
    // The report contains the wrong byte and the expected byte, and the section in both editions.
    for part in [
        "<mark>03</mark> 00 00 00",
        "<mark>02</mark> 00 00 00",
        "ads-en 1.05 §4.3.2",
        "ads-de 1.051 §4.3.2",
    ] {
        assert!(before.contains(part), "{part}");
    }
    for case in &report.cases {
        assert!(before.contains(&case.id), "{}", case.id);
    }
}

#[test]
fn badges_contain_the_result() {
    let badge = |args: &[&str]| -> Value {
        let output = ads_cnc(&[&["run", "--badge", "-"], args].concat());
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let passed = badge(&["--edition", "en-1.05"]);
    assert_eq!(
        (&passed["message"], &passed["color"]),
        (&json!("passed (en-1.05)"), &json!("brightgreen"))
    );
    let failed = badge(&["--defect", DEFECT]);
    assert_eq!(failed["color"], "red");
    // shields.io rejects a badge with other keys.
    let keys: Vec<&String> = failed.as_object().unwrap().keys().collect();
    assert_eq!(keys, ["color", "isError", "label", "message", "schemaVersion"]);
}

/// A report is written through a symbolic link to a file that does not exist yet, and a FIFO is opened
/// only once.
#[cfg(unix)]
#[test]
fn reports_are_written_to_links_and_fifos() {
    let folder = TestFolder::new();
    let (link, target, fifo) =
        (folder.file("link.json"), folder.file("target.json"), folder.file("fifo"));
    std::os::unix::fs::symlink(&target, &link).unwrap();
    let made = std::process::Command::new("mkfifo").arg(&fifo).status().unwrap();
    assert!(made.success());
    let reader = std::thread::spawn({
        let fifo = fifo.clone();
        move || {
            let first = fs::read(&fifo).unwrap();
            if first.is_empty() {
                // A run that opens the FIFO twice would wait for a reader.
                fs::read(&fifo).unwrap();
            }
            first
        }
    });
    ads_cnc(&["run", "--only", "COM-1", "--json", &link, "--badge", &fifo]);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(serde_json::from_str::<Value>(&folder.read("target.json")).unwrap()["format"], 1);
    assert!(!reader.join().unwrap().is_empty());
}
