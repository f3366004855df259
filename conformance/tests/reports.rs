//! The forms of a report: made from the JSON alone, well-formed, and with the same facts.

mod common;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs, process};

use ads_cnc_conformance::report::{self, Detail, Display, Report};
use common::Serve;
use quick_xml::events::Event;
use quick_xml::{Reader, XmlVersion};
use serde_json::{Value, json};

/// A folder that goes away.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = env::temp_dir().join(format!("ads-cnc-{name}-{}", process::id()));
        fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().unwrap().to_owned()
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _gone = fs::remove_dir_all(&self.0);
    }
}

fn ads_cnc(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ads-cnc")).args(args).output().unwrap()
}

fn run(args: &[&str]) -> Value {
    let output = ads_cnc(&[&["run", "--json", "-"], args].concat());
    serde_json::from_slice(&output.stdout).unwrap()
}

const FORMS: [&str; 4] = ["html", "junit", "markdown", "badge"];
const DEFECT: &str = "variable-description.size.flip";
const VERBOSE: Display = Display { detail: Detail::Verbose, color: false, found_shown: false };

/// A report with all that one can have: failures with bytes, waivers, a selection.
fn everything(folder: &Folder) -> Value {
    let waivers = folder.path("waivers.toml");
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
fn json_keeps_to_its_schema_and_is_read_back() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("schema/report.schema.json");
    let schema: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    jsonschema::draft202012::meta::validate(&schema).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    let folder = Folder::new("schema");
    let testee = format!("\"{}\" testee", env!("CARGO_BIN_EXE_ads-cnc"));
    let noisy = format!("{testee} --miniature noisy");
    let refusing = format!("{testee} --miniature refuses-all");
    let client = format!("\"{}\" client", env!("CARGO_BIN_EXE_ads-cnc"));
    let dying = format!("{client} --defect client.dies");
    let dying = run(&["--client", &dying, "--only", "client-name-data-length-huge"]);
    let serve = Serve::start(&[]);
    let capture = folder.path("run.pcapng");
    run(&["--only", "VAR-11", "--capture", &capture]);
    let checked = ads_cnc(&["check", &capture, "--any-port", "--json", "-"]);
    let checked: Value = serde_json::from_slice(&checked.stdout).unwrap();
    let reports = [
        run(&[]),
        run(&["--testee", &noisy, "--only", "VAR-11"]),
        run(&["--testee", &refusing, "--only", "VAR-11"]),
        run(&["--target", &serve.addr, "--net-id", &serve.net_id]),
        everything(&folder),
        run(&["--defect", "object-descriptor.size.flip"]),
        run(&["--defect", "variable-value.value.invert", "--edition", "de-1.051"]),
        run(&["--defect", "variable-handle-read.index_count.flip"]),
        run(&["--edition", "en-1.05", "--only", "VAR-20"]),
        run(&["--client", &client, "--only", "client-name-twice"]),
        dying,
        checked,
    ];
    for document in reports {
        let errors: Vec<String> =
            schema.iter_errors(&document).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{:?}", &errors[..errors.len().min(5)]);
        let read = Report::from_json(&document.to_string()).unwrap();
        assert_eq!(serde_json::to_value(&read).unwrap(), document);
    }
}

/// A failure by the protocol names the one it is about.
#[test]
fn each_protocol_is_where_its_own_is() {
    for (kind, id, text) in [("client", "CLIENT", "CLIENTS.md"), ("testee", "TESTEE", "README.md")]
    {
        let report = run(&[&format!("--{kind}"), "exit 3"]);
        let cases = report["cases"].as_array().unwrap().iter();
        let mut failed = cases.flat_map(|case| case["failures"].as_array().into_iter().flatten());
        let failed = failed.find(|one| one["requirement"] == id).unwrap();
        assert_eq!(failed["sources"], json!([format!("conformance/adapters/{text}")]));
        assert!(failed["clause"].as_str().unwrap().ends_with(&format!("a {kind}.")), "{failed:#}");
        // And is counted.
        let subject = &report["subjects"][0];
        assert_eq!(subject["totals"]["fail"], 1, "{subject:#}");
        assert_eq!(subject["areas"].as_array().unwrap().last().unwrap()["area"], id);
        let read = Report::from_json(&report.to_string()).unwrap();
        let mut text = Vec::new();
        report::print(&read, Display::default(), &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(text.contains(&format!("NOT PASSED  {kind}: 1 fail ({id}), ")), "{text}");
    }
}

#[test]
fn forms_are_made_from_the_json_alone() {
    let folder = Folder::new("forms");
    let json = folder.path("report.json");
    let mut args = vec!["run".to_owned(), "--defect".to_owned(), DEFECT.to_owned()];
    args.extend(["--json".to_owned(), json.clone()]);
    for form in FORMS {
        args.extend([format!("--{form}"), folder.path(&format!("with-run.{form}"))]);
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
    // And so is what is shown.
    assert_eq!(ads_cnc(&["report", &json]).stdout, output.stdout);
}

#[test]
fn what_is_no_report_is_refused() {
    let folder = Folder::new("odd");
    let odd = folder.path("odd.json");
    for (text, why) in [
        ("", "EOF while parsing a value at line 1"),
        ("{\"format\":2}", "a report of format 2; this version reads 1"),
        ("{\"format\":1,\n\"suit\":1}", "line 2"),
    ] {
        fs::write(&odd, text).unwrap();
        let output = ads_cnc(&["report", &odd]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(why) && said.contains("odd.json"), "{said}");
    }
    let both = ads_cnc(&["report", &odd, "--html", "-", "--junit", "-"]);
    assert_eq!(both.status.code(), Some(2));
    assert_eq!(ads_cnc(&["report", "/no/such/report.json"]).status.code(), Some(2));
}

/// Elements by their path, each with its attributes.
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
    let folder = Folder::new("junit");
    let document = everything(&folder);
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
    // And one for the waiver that does not hold.
    assert_eq!(at(test).len(), cases.len() + 1);
    let root = at("testsuites")[0];
    for (name, path) in [("tests", ""), ("failures", "/failure"), ("skipped", "/skipped")] {
        let counted = at(&format!("{test}{path}")).len();
        assert_eq!(value(root, name), counted.to_string(), "{name}");
    }
    // In seconds.
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
    let why = "waived until 9999-12-31: <known> | & \"so\"";
    assert!(skipped.iter().any(|one| value(one, "message") == why));
    let property = "testsuites/testsuite/properties/property";
    for (name, fact) in [("seed", "7"), ("vectors", &report.vectors), ("only", "VAR")] {
        let found = at(property).into_iter().find(|one| value(one, "name") == name);
        assert_eq!(value(found.unwrap(), "value"), fact);
    }
}

/// What a device says of itself is text in every form, whatever it is.
#[test]
fn text_stays_text() {
    let folder = Folder::new("text");
    let mut document = everything(&folder);
    let odd = "</script><script>alert(1)</script> | `x` ]]> & \u{1}\u{fffe}";
    let acting = "C\u{1b}[31m\u{9b}2J\0\u{202e}\n\n# A heading";
    document["target"]["name"] = json!(odd);
    document["target"]["language"] = json!(acting);
    // Markdown has room for some failures only.
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
    // A fence is longer than any in what it holds.
    assert!(markdown.contains("````text\n"));
    let badge: Value = serde_json::from_str(&made(report::to_badge)).unwrap();
    assert_eq!(badge["schemaVersion"], 1);
}

/// Whoever wrote the report: each text in it in turn is one that acts, in every form.
#[test]
fn no_text_of_a_foreign_report_acts() {
    let folder = Folder::new("foreign");
    let mut document = everything(&folder);
    // All that can be there is there once; of most cases nothing is new.
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
        // Of some keys the words are known: any other is no report.
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

    // And so is what is said of one that is no report.
    let file = folder.path("odd.json");
    let mut odd = document;
    odd["\u{1b}[2J\u{9b}"] = json!(1);
    fs::write(&file, odd.to_string()).unwrap();
    let output = ads_cnc(&["report", &file]);
    let why = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{why}");
    assert!(why.contains("[2J") && !why.contains(['\u{1b}', '\u{9b}']), "{why:?}");
}

/// Pointers to all texts.
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

/// Names and reasons that a profile and waivers have are texts of others as well.
#[test]
fn profiles_and_waivers_do_not_act() {
    let folder = Folder::new("acting");
    let serve = Serve::start(&[]);
    let (profile, waivers) = (folder.path("profile.toml"), folder.path("waivers.toml"));
    let acting = "\\u001b[2J\\u009b\\u007f\\n# H <img src=x>";
    fs::write(&profile, format!("name = \"{acting}\"\n")).unwrap();
    let waiver = format!(
        "[[waiver]]\ntest = \"com-count\"\nrequirement = \"VAR-8\"\nverdict = \"fail\"\n\
         reason = \"{acting}\"\nexpires = 9999-12-31\n"
    );
    fs::write(&waivers, waiver).unwrap();
    let forms = FORMS.map(|form| (format!("--{form}"), folder.path(form)));
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

/// A statement has each clause once for each subject; a comparison fails on what fails newly.
#[test]
fn statements_and_comparisons_are_made_of_reports() {
    let folder = Folder::new("statement");
    let (now, before) = (folder.path("now.json"), folder.path("before.json"));
    fs::write(&now, everything(&folder).to_string()).unwrap();
    fs::write(&before, run(&["--only", "VAR", "--seed", "7"]).to_string()).unwrap();
    for form in ["statement.md", "statement.html"] {
        let file = folder.path(form);
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
    assert!(code == Some(0) && shown.contains("\nmended            VAR-8    codec  "), "{shown}");
    let (code, shown) = against(&now, &now);
    assert!(
        code == Some(0) && shown.contains("\n0 newly failing, 0 newly deviating, 0 mended, "),
        "{shown}"
    );
}

/// An interrupted run is one line of a comparison and no success; whoever compares two kinds of runs is
/// warned.
#[test]
fn a_comparison_is_no_success_if_less_is_judged() {
    let folder = Folder::new("less");
    let (now, before) = (folder.path("now.json"), folder.path("before.json"));
    let mut document = run(&["--only", "VAR-11", "--seed", "7"]);
    fs::write(&before, document.to_string()).unwrap();
    for case in document["cases"].as_array_mut().unwrap() {
        for one in case["requirements"].as_array_mut().unwrap() {
            one["verdict"] = json!("interrupted");
        }
    }
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
        "\nwarning  not the same target: ",
        "\nwarning  not the same claims of the profile: platform_axes\n",
        "\nwarning  not the same selection: VAR-11 before, VAR now\n",
    ] {
        assert!(shown.contains(part), "{part:?}: {shown}");
    }
}

/// A row that takes much of a page may be parted, or the page before it stays empty.
#[test]
fn long_rows_are_parted_in_print() {
    let folder = Folder::new("print");
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

/// It can be sent around: nothing is fetched, and what is judged can be read without a script.
#[test]
fn html_needs_nothing_else() {
    let folder = Folder::new("html");
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
    // The byte that differs and the one that should be there, with the clause in both editions.
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
fn badges_say_how_it_ended() {
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
    // Nothing but what an endpoint may have.
    let keys: Vec<&String> = failed.as_object().unwrap().keys().collect();
    assert_eq!(keys, ["color", "isError", "label", "message", "schemaVersion"]);
}
