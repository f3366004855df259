//! Messages of the command. A message about a wrong argument, for example, states which argument is
//! wrong, what is expected, and what was found.

use ads_cnc_conformance::net;

use crate::common::file::TestFile;
use crate::common::run_tool;

#[test]
fn a_number_out_of_range_is_named_with_its_range() {
    for (args, option, expected) in [
        (&["run", "--seed", "abc"][..], "'abc' for '--seed <N>'", "from 0 to 4294967295"),
        (&["run", "--max-fail", "0"], "'0' for '--max-fail <N>'", "from 1 to 4294967295"),
        (&["run", "--timeout", "-1"], "'-1' for '--timeout <MS>'", "from 1 to 4294967295"),
        (&["run", "--client-timeout", "0"], "'0' for '--client-timeout <MS>'", "from 1 to "),
        (&["browse", "--deadline", "1h"], "'1h' for '--deadline <SECONDS>'", "from 1 to "),
        (&["check", "--port", "65536", "x"], "'65536' for '--port <N>'", "from 1 to 65535"),
        (&["serve", "--idle", "-5"], "'-5' for '--idle <SECONDS>'", "from 0 to 4294967295"),
    ] {
        let (code, _, error) = run_tool(args);
        let expected = format!("invalid value {option}: expected a whole number {expected}");
        assert!(code == Some(2) && error.contains(&expected), "{args:?}: {error}");
    }
}

#[test]
fn an_address_in_use_is_named_with_its_option() {
    let taken = net::listen(([127, 0, 0, 1], 0).into()).unwrap();
    let addr = taken.local_addr().unwrap().to_string();
    for (args, option) in [
        (&["run", "--client-listen", &addr][..], "--client-listen"),
        (&["serve", "--listen", &addr], "--listen"),
    ] {
        let (code, _, error) = run_tool(args);
        let start = format!("ads-cnc: {option}: cannot listen on {addr}: ");
        assert!(code == Some(2) && error.starts_with(&start), "{error}");
        assert!(error.contains(&format!("With {option} 127.0.0.1:0 the system chooses a port")));
        let (code, _, error) = run_tool(&[&args[..args.len() - 1], &["nowhere"]].concat());
        assert!(code == Some(2) && error.contains("expected an IP address and a port"), "{error}");
    }
}

#[test]
fn a_rejected_write_is_explained_once() {
    let target = ["--target", "127.0.0.1:1", "--net-id", "1.2.3.4.1.1"];
    let dry = ["set", "V.E.vartest", "3", "--dry-run"];
    let (code, shown, error) = run_tool(&[&dry[..], &target].concat());
    assert_eq!(code, Some(4), "{error}");
    assert!(shown.starts_with("would be rejected\n"), "{shown}");
    assert_eq!((shown + &error).matches("no file allows writes").count(), 1, "{error}");
}

#[test]
fn a_compressed_file_is_explained() {
    for start in [&b"\x1f\x8b\x08\x00"[..], b"\x28\xb5\x2f\xfd", b"\xfd7zXZ\x00"] {
        let file = TestFile::new(".bin", start);
        for call in [&["explain", "--file"][..], &["explain"], &["check"]] {
            let (code, _, error) = run_tool(&[call, &[file.path()]].concat());
            let expected = format!("{}: the file is compressed; unpack it first: ", file.path());
            assert!(code == Some(2) && error.contains(&expected), "{call:?}: {error}");
        }
    }
}

#[test]
fn an_erratum_is_printed_with_its_ruling() {
    let (code, shown, _) = run_tool(&["requirements", "e-17"]);
    assert_eq!(code, Some(0));
    for part in
        ["E-17  ", "\n  reading   ads-de ", "\n  ruling    ", "\n  question  ", "\n  cited by  "]
    {
        assert!(shown.contains(part), "{part:?} is not in\n{shown}");
    }
    let both = run_tool(&["requirements", "E-17", "VAR-8"]).1;
    assert!(both.starts_with(&shown) && both.contains("\n\nVAR-8  "), "{both}");
    let (code, _, error) = run_tool(&["requirements", "E-17", "--format", "json"]);
    assert_eq!(
        (code, error.as_str()),
        (Some(2), "ads-cnc: an erratum is printed only with --format text\n")
    );
    assert_eq!(run_tool(&["requirements", "E-999"]).0, Some(3));
}

#[test]
fn an_empty_file_of_waivers_is_reported_with_an_example() {
    let file = TestFile::new(".toml", b"# none yet\n");
    let run = ["run", "--only", "vec-handle-printed", "--waivers"];
    let (code, _, error) = run_tool(&[&run[..], &[file.path()]].concat());
    assert_eq!(code, Some(0));
    let start = format!("ads-cnc: {} contains no waiver, so every failure counts.", file.path());
    assert!(error.starts_with(&start) && error.contains("\n  [[waiver]]\n  test = "), "{error}");
}

#[test]
fn a_statement_has_one_of_the_known_formats() {
    for name in ["statement.pdf", "statement"] {
        let (code, _, error) = run_tool(&["report", "report.json", "--statement", name]);
        assert_eq!(code, Some(2));
        assert!(error.contains("expected a name that ends in .html or .md, or - "), "{error}");
    }
}

/// Defects are listed by a part of their ID, but only by a whole requirement, as the message says.
#[test]
fn defects_are_listed_by_a_whole_requirement() {
    let (code, shown, _) = run_tool(&["serve", "--list-defects", "var-10"]);
    assert!(code == Some(0) && !shown.is_empty());
    let (code, _, error) = run_tool(&["serve", "--list-defects", "VAR-"]);
    assert_eq!(code, Some(2));
    assert!(error.contains("contains VAR- in its ID or violates the requirement VAR-"), "{error}");
}

/// A dynamic parameter is always a REAL64, so any other type is an error.
#[test]
fn another_type_of_a_parameter_is_rejected() {
    for name in ["P1", "V.P.count"] {
        let (code, _, error) = run_tool(&["get", name, "--type", "UNS32"]);
        assert_eq!(code, Some(2), "{error}");
        assert!(error.contains("always a REAL64, not a UNS32"), "{error}");
        assert_eq!(run_tool(&["get", name, "--type", "REAL64"]).0, Some(0));
    }
}

/// The short help of `run` has at most 50 lines.
#[test]
fn the_short_help_of_run_is_short() {
    let (_, shown, _) = run_tool(&["run", "-h"]);
    assert!(shown.lines().count() <= 50, "{} lines", shown.lines().count());
}
