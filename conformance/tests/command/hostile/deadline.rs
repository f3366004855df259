//! The option `--deadline` ends runs and other commands in time.

use std::fs;
use std::thread;
use std::time::Duration;

use ads_cnc_conformance::simulator::Cnc;

use super::{against, everything, right, run};
use crate::common::fake::serving;
use crate::common::file::TestFile;

/// With a slow device, a run ends at the deadline, and the notes of the remaining cases state the
/// deadline as the reason.
#[test]
fn a_deadline_ends_a_run() {
    let cnc = Cnc::with_default_model().unwrap();
    let addr = serving(move |frame, out| {
        thread::sleep(Duration::from_millis(100));
        out.write_all(&right(&cnc, frame))
    });
    let (addr, json) = (addr.to_string(), TestFile::new(".json", b""));
    let args = ["run", "--seed", "1", "--deadline", "2", "--json", json.path()];
    let ended = run(&against(&addr, &args));
    assert_eq!(ended.code, Some(3), "{}", ended.stdout);
    assert!(ended.time < Duration::from_secs(20), "{:?}", ended.time);
    assert!(ended.stdout.contains("the deadline of 2 s has passed"), "{}", ended.stdout);
    let report = fs::read_to_string(&json.0).unwrap();
    assert!(report.matches("the deadline of 2 s has passed").count() > 50);
}

/// A run restores a changed value even after the deadline, but changes no other value.
#[test]
fn a_deadline_ends_writes() {
    let cnc = Cnc::with_default_model().unwrap();
    let addr = serving(move |frame, out| {
        thread::sleep(Duration::from_millis(100));
        out.write_all(&right(&cnc, frame))
    });
    let (addr, json) = (addr.to_string(), TestFile::new(".json", b""));
    let table = |name| format!("[[variable]]\nchannel = 1\nname = \"{name}\"\n");
    let names = ["V.E.test", "V.E.vartest", "V.E.Testvar", "V.E.Variable_1"];
    let allow = TestFile::allowing(&names.map(table).concat());
    let rest = ["--allow-write", allow.path(), "--json", json.path(), "--deadline", "2"];
    let run_it = ["run", "--seed", "1", "--only", "write-by-name", "--only", "write-by-handle"];
    let ended = run(&against(&addr, &[&run_it[..], &rest].concat()));
    assert_eq!(ended.code, Some(3), "{}{}", ended.stdout, ended.stderr);
    assert!(ended.time < Duration::from_secs(20), "{:?}", ended.time);
    assert!(ended.stdout.contains("the deadline of 2 s has passed"), "{}", ended.stdout);
    for name in ["V.E.test", "V.E.vartest"] {
        let value = |addr: Option<&str>| match addr {
            Some(addr) => run(&against(addr, &["get", name, "--format", "csv"])).stdout,
            None => run(&["get", name, "--format", "csv"]).stdout,
        };
        assert_eq!(value(Some(&addr)), value(None));
    }

    // On this device, the search for an object by its name reads lists without end.
    let allow = TestFile::allowing("[[object]]\nchannel = 1\nname = \"no_such_object\"\n");
    let addr = everything().to_string();
    let set = ["set", "no_such_object", "1", "--allow-write", allow.path(), "--deadline", "2"];
    let ended = run(&against(&addr, &set));
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stderr.contains("the deadline of 2 s has passed"), "{}", ended.stderr);
}

/// A deadline also ends a run with a testee that needs half a second for each answer, and a run with a
/// client that never ends.
#[cfg(unix)]
#[test]
fn a_deadline_ends_a_testee_and_a_client() {
    const HELLO: &str = r#"{"protocol":1,"testee":{"name":"slow"},"capabilities":{"ops":["decode","encode"],"streams":["variable-description"],"editions":["en-1.05"]}}"#;
    let script = format!(
        "#!/bin/sh\nread -r hello\necho '{HELLO}'\nwhile read -r line; do\nsleep 0.5\n\
         seq=${{line#*\\\"seq\\\":}}; seq=${{seq%%,*}}\n\
         echo '{{\"seq\":'$seq',\"unsupported\":{{\"what\":\"op\"}}}}'\ndone\n"
    );
    let script = TestFile::new(".sh", script.as_bytes());
    let testee = format!("sh {}", script.path());
    for options in [["--testee", &testee], ["--client", "cat; sleep 1000"]] {
        let json = TestFile::new(".json", b"");
        let args = ["run", "--seed", "1", "--deadline", "2", "--json", json.path()];
        let ended = run(&[&args[..], &options].concat());
        assert!(matches!(ended.code, Some(1 | 3)), "{options:?}: {}", ended.stderr);
        assert!(ended.time < Duration::from_secs(15), "{options:?}: {:?}", ended.time);
        let report = fs::read_to_string(&json.0).unwrap();
        assert!(report.contains("the deadline of 2 s has passed"), "{options:?}: {report}");
    }
}
