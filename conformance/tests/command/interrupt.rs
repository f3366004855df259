//! Runs that write and are interrupted by a signal, or whose writes that restore a value are lost or
//! rejected: every changed value is restored, or reported as left changed.

#![cfg(unix)]

use std::net::SocketAddr;
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use crate::common::file::TestFile;
use crate::common::proxy::{FrameHandling, is_write, proxy};
use crate::common::signal;
use crate::common::text;
use ads_cnc::address::Channel;
use ads_cnc::operation::ReadByName;
use ads_cnc_conformance::client::Target;
use ads_cnc_conformance::gate::Gate;
use ads_cnc_conformance::net;
use ads_cnc_conformance::session::Session;
use ads_cnc_conformance::simulator::{Cnc, NET_ID, Server};
use serde_json::Value;

/// Writable variables of the default model.
const NAMES: [&str; 4] = ["V.E.test", "V.E.vartest", "V.E.Testvar", "V.E.Variable_1"];

/// Cases that write these variables.
const CASES: [&str; 4] =
    ["write-by-name", "write-by-handle", "write-elements-by-name", "write-elements-by-handle"];

fn channel() -> Channel {
    Channel::new(1).unwrap()
}

struct Bench {
    server: Server,
    allow: TestFile,
    json: TestFile,
    /// The timeout of the run for a reply, in milliseconds.
    timeout: u32,
}

impl Bench {
    fn start(table: &str) -> Self {
        let cnc = Arc::new(Cnc::with_default_model().unwrap());
        let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
        let server = Server::start(listener, cnc).unwrap();
        let (allow, json) = (TestFile::allowing(table), TestFile::new(".json", b""));
        Self { server, allow, json, timeout: 1000 }
    }

    fn of_variables(names: &[&str]) -> Self {
        let table = |name| format!("[[variable]]\nchannel = 1\nname = \"{name}\"\n");
        Self::start(&names.iter().map(table).collect::<String>())
    }

    fn tool(&self, addr: SocketAddr, cases: &[&str]) -> Command {
        let mut tool = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
        tool.args(["run", "--target", &addr.to_string(), "--net-id", &NET_ID.to_string()])
            .args(["--allow-write", self.allow.path(), "--json", self.json.path()])
            .args(["--seed", "7", "--timeout", &self.timeout.to_string()])
            .args(cases.iter().flat_map(|case| ["--only", case]))
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        tool
    }

    /// A connection without a proxy.
    fn session(&self) -> Session {
        Session::connect(Target::local(self.server.addr(), NET_ID), Gate::queries()).unwrap()
    }

    fn values(&self, names: &[&str]) -> Vec<Vec<u8>> {
        let mut session = self.session();
        let mut read = |name: &&str| {
            session.call(&ReadByName::new(channel(), name).unwrap()).unwrap().bytes.to_vec()
        };
        names.iter().map(&mut read).collect()
    }

    fn report(&self) -> Value {
        serde_json::from_slice(&std::fs::read(&self.json.0).unwrap()).unwrap()
    }
}

fn verdicts(report: &Value) -> Vec<&str> {
    let cases = report["cases"].as_array().unwrap();
    cases.iter().map(|case| case["verdict"].as_str().unwrap()).collect()
}

/// Runs the tool and sends it a signal at the nth write: before the CNC receives the write, or after the
/// CNC has replied to it.
fn interrupted(bench: &Bench, name: &'static str, nth: usize, cases: &[&str]) -> Output {
    let process = Arc::new(AtomicU32::new(0));
    let (to, mut writes) = (Arc::clone(&process), 0);
    let addr = proxy(bench.server.addr(), move |frame| {
        let was = writes;
        writes += usize::from(is_write(frame));
        // For an even number, the signal is sent before the CNC receives the write; for an odd
        // number, at the next request.
        let is_due = match nth.is_multiple_of(2) {
            true => was < nth && writes == nth,
            false => was == nth,
        };
        if is_due && let id @ 1.. = to.swap(0, Ordering::SeqCst) {
            signal(name, id);
            // Gives the tool time to handle the signal before the next reply arrives.
            thread::sleep(Duration::from_millis(50));
        }
        FrameHandling::Pass
    });
    let tool = bench.tool(addr, cases).spawn().unwrap();
    process.store(tool.id(), Ordering::SeqCst);
    tool.wait_with_output().unwrap()
}

/// After a signal at one of the first 25 writes, all values of the CNC are restored, and the report
/// is written.
#[test]
fn a_signal_at_any_write_leaves_nothing_changed() {
    let each = |name: &'static str, writes: &mut dyn Iterator<Item = usize>| {
        for nth in writes {
            let bench = Bench::of_variables(&NAMES);
            let before = bench.values(&NAMES);
            let output = interrupted(&bench, name, nth, &CASES);
            let stderr_text = text(&output.stderr);
            assert_eq!(output.status.code(), Some(3), "SIG{name} at write {nth}: {stderr_text}");
            assert_eq!(bench.values(&NAMES), before, "SIG{name} at write {nth}: {stderr_text}");
            assert!(
                stderr_text.contains("interrupted") && !stderr_text.contains("LEFT"),
                "{stderr_text}"
            );
            let report = bench.report();
            assert_eq!(report["exit_code"], 3);
            assert!(verdicts(&report).contains(&"interrupted"), "{report}");
            assert!(!verdicts(&report).contains(&"fail"), "{report}");
            let shown = text(&output.stdout);
            assert!(shown.contains("interrupted before its end"), "{shown}");
        }
    };
    thread::scope(|scope| {
        scope.spawn(|| each("INT", &mut (1..=25)));
        scope.spawn(|| each("TERM", &mut (1..=25)));
        scope.spawn(|| each("HUP", &mut [2, 5, 8].into_iter()));
        scope.spawn(|| each("QUIT", &mut [2, 6].into_iter()));
        scope.spawn(|| each("PROF", &mut [2].into_iter()));
    });
}

/// Four ways to write a value: the value, the entry that allows its writes, and a case that then
/// writes only this value. The third write of the case restores the value.
fn ways() -> [(&'static str, String, &'static str); 4] {
    let name = "[[variable]]\nchannel = 1\nname = \"V.E.vartest\"\n".to_owned();
    let object = "[[object]]\nchannel = 1\nname = \"mc_command_single_block_w\"\n".to_owned();
    let element = "[[element]]\ngroup = 0x123301\noffset = 2\n".to_owned();
    [
        ("V.E.vartest", name.clone(), "write-by-name"),
        ("V.E.vartest", name, "write-by-handle"),
        ("mc_command_single_block_w", object, "write-objects"),
        ("example.feed", element, "write-elements"),
    ]
}

/// The data of the writes, and what the proxy did with each. The first write contains the original value.
type Writes = Arc<Mutex<Vec<(Vec<u8>, FrameHandling)>>>;

/// Starts a proxy that forwards the first two writes. `handling` decides about the following
/// writes, which are numbered from 0.
fn hostile(
    bench: &Bench,
    handling: impl Fn(usize) -> FrameHandling + Send + 'static,
) -> (SocketAddr, Writes) {
    let writes = Writes::default();
    let keep = Arc::clone(&writes);
    let addr = proxy(bench.server.addr(), move |frame| {
        if !is_write(frame) {
            return FrameHandling::Pass;
        }
        let mut writes = keep.lock().unwrap();
        let handling = writes.len().checked_sub(2).map_or(FrameHandling::Pass, &handling);
        writes.push((frame.data().to_vec(), handling));
        handling
    });
    (addr, writes)
}

/// If the write that restores a value is lost or rejected once, it is repeated, unless the CNC has
/// executed it.
#[test]
fn a_lost_or_rejected_restore_is_repeated() {
    for (what, table, case) in ways() {
        for handling in [
            FrameHandling::Lose,
            FrameHandling::LoseAnswer,
            FrameHandling::Close,
            FrameHandling::Reject,
        ] {
            let bench = Bench::start(&table);
            let (addr, writes) =
                hostile(
                    &bench,
                    move |number| if number == 0 { handling } else { FrameHandling::Pass },
                );
            let output = bench.tool(addr, &[case]).output().unwrap();
            let stderr_text = text(&output.stderr);
            // A requirement fails, but no value is left changed.
            assert_eq!(output.status.code(), Some(1), "{what} {case} {handling:?}: {stderr_text}");
            assert!(
                !stderr_text.contains("LEFT CHANGED"),
                "{what} {case} {handling:?}: {stderr_text}"
            );
            let writes = writes.lock().unwrap();
            let restored =
                writes.iter().rev().find(|(_, handling)| *handling != FrameHandling::Lose).unwrap();
            assert_ne!(writes[1].0, writes[0].0, "nothing was changed");
            assert_eq!(restored.0, writes[0].0, "{what} {case} {handling:?}: {stderr_text}");
            // If only the reply to the write was lost, the run reads the value and does not repeat the
            // write.
            let expected = if handling == FrameHandling::LoseAnswer { 3 } else { 4 };
            assert_eq!(writes.len(), expected, "{what} {case} {handling:?}");
        }
    }
}

/// A device confirms a write that restores a value without executing it, and one of the following
/// reads is lost: the value is still reported as left changed.
#[test]
fn a_lost_read_is_not_taken_for_a_changing_value() {
    thread::scope(|scope| {
        for (what, table, case) in ways() {
            for lost in 0..8 {
                let bench = Bench { timeout: 200, ..Bench::start(&table) };
                scope.spawn(move || lost_read(&bench, lost, (what, case)));
            }
        }
    });
}

fn lost_read(bench: &Bench, lost: usize, (what, case): (&str, &str)) {
    let (mut writes, mut reads) = (0, 0);
    let addr = proxy(bench.server.addr(), move |frame| {
        writes += usize::from(is_write(frame));
        reads += usize::from(!is_write(frame) && writes > 2);
        match (is_write(frame), writes) {
            (true, 3..) => FrameHandling::Pretend,
            (false, 3..) if reads == lost + 1 => FrameHandling::Lose,
            _ => FrameHandling::Pass,
        }
    });
    let output = bench.tool(addr, &[case]).output().unwrap();
    let (shown, stderr_text) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(6), "{what} {case} {lost}: {shown}{stderr_text}");
    let last = stderr_text.lines().last().unwrap();
    assert!(last.starts_with(&format!("LEFT CHANGED: {what}")), "{case} {lost}: {stderr_text}");
}

/// A write that restores a value and always fails is tried a limited number of times. Then every format
/// of the report names the value.
#[test]
fn every_report_names_a_value_left_changed() {
    for (what, table, case) in ways() {
        let bench = Bench::start(&table);
        let (addr, writes) = hostile(&bench, |_| FrameHandling::Reject);
        let forms = ["html", "markdown", "junit", "badge"];
        let files = forms.map(|form| TestFile::new(form, b""));
        let mut tool = bench.tool(addr, &[case, "write-elements-by-name", "write-read-only"]);
        for (form, file) in forms.iter().zip(&files) {
            tool.args([&format!("--{form}"), file.path()]);
        }
        let json = bench.json.path().to_owned();
        let output = tool.output().unwrap();
        let (shown, stderr_text) = (text(&output.stdout), text(&output.stderr));
        assert_eq!(output.status.code(), Some(6), "{what} {case}: {stderr_text}");
        let writes = writes.lock().unwrap();
        // The case writes twice (the original value, and another value), and tries once to restore
        // the value. Then the run tries five times, and again five times at its end.
        assert_eq!(writes.len(), 2 + 1 + 5 + 5, "{what} {case}");

        let line = stderr_text.lines().last().unwrap();
        assert!(line.starts_with(&format!("LEFT CHANGED: {what}")), "{stderr_text}");
        let (was, is) = line.split_once(", was ").unwrap().1.split_once(", is ").unwrap();
        assert!(was != is && is != "not known", "{line}");
        assert!(shown.lines().any(|shown| shown == line), "{shown}");
        let report = bench.report();
        assert_eq!(report["exit_code"], 6);
        let left = &report["left_changed"][0];
        assert!(writes[2..].iter().all(|(data, _)| data.ends_with(&old_value(&report))));
        assert_eq!((left["was"].as_str(), left["is"].as_str()), (Some(was), Some(is)), "{left}");
        let of = |form: usize| std::fs::read_to_string(&files[form].0).unwrap();
        let plain = |text: &str| text.replace('\\', "");
        let header = of(0).split_once("<header>").unwrap().1.to_owned();
        assert!(header.trim_start().contains(line), "{header}");
        assert!(plain(&of(1)).starts_with(&format!("**{line}**\n")), "{}", of(1));
        let first = of(2).split_once("<testsuite ").unwrap().1.to_owned();
        assert!(first.starts_with("name=\"left-changed\"") && first.contains(line), "{first}");
        let badge: Value = serde_json::from_str(&of(3)).unwrap();
        let badge = badge["message"].as_str().unwrap();
        // A badge contains at most 40 characters of each value.
        let front =
            |text: &str| text.get(..40).map_or(text.to_owned(), |front| format!("{front}…"));
        let named = format!("left changed: {what}");
        assert!(badge.starts_with(&named) && badge.contains(&front(was)), "{badge}");
        // `report` prints the same line for the JSON report.
        let again = Command::new(env!("CARGO_BIN_EXE_ads-cnc")).args(["report", &json]).output();
        assert!(text(&again.unwrap().stdout).lines().any(|shown| shown == line));
    }
}

/// The original bytes of the value that the report names as left changed.
fn old_value(report: &Value) -> Vec<u8> {
    let was = report["left_changed"][0]["was"].as_str().unwrap();
    was.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
}

/// After a value could not be restored, the run writes no other value.
#[test]
fn no_other_value_is_changed_after_a_failed_restore() {
    let bench = Bench::of_variables(&NAMES);
    let (addr, writes) = hostile(&bench, |_| FrameHandling::Reject);
    let output = bench.tool(addr, &CASES).output().unwrap();
    assert_eq!(output.status.code(), Some(6));
    let writes = writes.lock().unwrap();
    let report = bench.report();
    // From the third write on, the run only writes the original value.
    assert!(writes[2..].iter().all(|(data, _)| data.ends_with(&old_value(&report))));
    let notes = report["cases"].as_array().unwrap().iter().filter_map(|case| case["note"].as_str());
    let note = "no more writes are sent after a value could not be restored";
    assert_eq!(notes.filter(|one| one.contains(note)).count(), CASES.len() - 1, "{report}");
}

/// If a device disappears during a run, the run waits only for a limited time, and reports the value that
/// is left changed.
#[test]
fn a_lost_device_is_reported() {
    for handling in [FrameHandling::Close, FrameHandling::Lose] {
        let bench = Bench::of_variables(&["V.E.vartest"]);
        let mut writes = 0;
        let addr = proxy(bench.server.addr(), move |frame| {
            writes += usize::from(is_write(frame));
            if writes > 2 { handling } else { FrameHandling::Pass }
        });
        let begun = Instant::now();
        let output = bench.tool(addr, &["write-by-name"]).output().unwrap();
        let stderr_text = text(&output.stderr);
        assert_eq!(output.status.code(), Some(6), "{stderr_text}");
        let line = stderr_text.lines().last().unwrap();
        assert!(line.starts_with("LEFT CHANGED: V.E.vartest, was "), "{stderr_text}");
        assert!(line.ends_with(", is not known"), "{stderr_text}");
        assert!(begun.elapsed() < Duration::from_secs(60), "{:?}", begun.elapsed());
    }
}

/// If a signal arrives while a write that restores a value is lost, the run continues to restore it. The
/// lost write is a failure; if the following writes are rejected, the value is reported as left changed.
#[test]
fn a_signal_does_not_end_the_restoration() {
    for (handling, code) in [(FrameHandling::Pass, 1), (FrameHandling::Reject, 6)] {
        let bench = Bench::of_variables(&["V.E.vartest"]);
        let before = bench.values(&["V.E.vartest"]);
        let process = Arc::new(AtomicU32::new(0));
        let id = Arc::clone(&process);
        let (addr, _writes) = hostile(&bench, move |number| {
            if let id @ 1.. = id.swap(0, Ordering::SeqCst) {
                signal("TERM", id);
            }
            if number == 0 { FrameHandling::Lose } else { handling }
        });
        let mut tool = bench.tool(addr, &["write-by-name"]);
        let tool = tool.spawn().unwrap();
        process.store(tool.id(), Ordering::SeqCst);
        let output = tool.wait_with_output().unwrap();
        let stderr_text = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{handling:?}: {stderr_text}");
        assert_eq!(
            bench.values(&["V.E.vartest"]) == before,
            code == 1,
            "{handling:?}: {stderr_text}"
        );
        assert_eq!(
            stderr_text.contains("LEFT CHANGED: V.E.vartest, was "),
            code == 6,
            "{stderr_text}"
        );
        assert_eq!(bench.report()["exit_code"], code);
    }
}

/// A second signal ends the run at once; the last line of stderr names the value left changed.
#[test]
fn a_second_signal_ends_at_once() {
    let bench = Bench { timeout: 20_000, ..Bench::of_variables(&["V.E.vartest"]) };
    let (tell, told) = std::sync::mpsc::channel();
    let (addr, _writes) = hostile(&bench, move |_| {
        let _gone = tell.send(());
        FrameHandling::Lose
    });
    let tool = bench.tool(addr, &["write-by-name"]).spawn().unwrap();
    told.recv().unwrap();
    signal("INT", tool.id());
    thread::sleep(Duration::from_millis(300));
    signal("INT", tool.id());
    let begun = Instant::now();
    let output = tool.wait_with_output().unwrap();
    let stderr_text = text(&output.stderr);
    assert_eq!(output.status.code(), Some(6), "{stderr_text}");
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
    let line = stderr_text.lines().last().unwrap();
    assert!(line.starts_with("LEFT CHANGED: V.E.vartest, was "), "{stderr_text}");
}

/// After a signal at any write, the contents of elements and objects are restored, too.
#[test]
fn objects_and_elements_are_restored_after_a_signal() {
    for (name, table, case) in ways().into_iter().skip(2) {
        // Each case writes three times: the original value, another value, and the original value.
        for nth in 1..=3 {
            let bench = Bench::start(&table);
            let value = || {
                let addr = bench.server.addr().to_string();
                let target = ["--target", &addr, "--net-id", "127.0.0.1.1.1"];
                let mut get = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
                let output = get.args(["get", name]).args(target).output().unwrap();
                assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
                text(&output.stdout)
            };
            let before = value();
            let output = interrupted(&bench, "INT", nth, &[case]);
            let stderr_text = text(&output.stderr);
            // After the third write, the run may end normally before it handles the signal.
            let code = output.status.code();
            assert!(code == Some(3) || nth == 3 && code == Some(0), "write {nth}: {stderr_text}");
            assert_eq!(value(), before, "{name} at write {nth}: {stderr_text}");
        }
    }
}
