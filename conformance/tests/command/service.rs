//! `ads-cnc service` as users call it. In most tests, the test itself sends requests as an NC
//! program does.

use std::io::{BufRead, BufReader, Read as _};
use std::process::{Child, Command, Output, Stdio};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use crate::common::file::TestFile;
#[cfg(unix)]
use crate::common::runs;
use crate::common::text;
use ads_cnc::CncStr;
use ads_cnc::service::ServiceId;
use ads_cnc::service::ServiceVariable::{RequestState, Uuid};
use ads_cnc_conformance::net;
use ads_cnc_conformance::simulator::program::service::{
    CallStep, ServiceCall, ServiceInterface, SysServiceWait,
};
#[cfg(unix)]
use ads_cnc_conformance::simulator::program::{Script, ScriptConfig};
use ads_cnc_conformance::simulator::{Cnc, Server};

const ID: &str = "560AACBF-6335-44a9-895A-8B27F3ED5E47";
const OTHER: &str = "19719079-BA06-4740-BC02-DE5215211751";

/// Maximum time for which these tests wait for a process or a response.
const WAIT_MAX: Duration = Duration::from_secs(30);

/// A simulated CNC in this process, to which the tool in another process connects.
struct Bench {
    cnc: Arc<Cnc>,
    server: Server,
    allow: TestFile,
}

impl Bench {
    fn start() -> Self {
        let cnc = Arc::new(Cnc::with_default_model().unwrap());
        let listener = net::listen(([127, 0, 0, 1], 0).into()).unwrap();
        let server = Server::start(listener, cnc.clone()).unwrap();
        Self { cnc, server, allow: TestFile::allowing("[[service]]\nchannel = 2\n") }
    }

    fn tool(&self, options: &[&str], command: &[&str]) -> Command {
        let mut tool = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
        tool.args(["service", "--target", &self.server.addr().to_string()])
            .args(["--net-id", "127.0.0.1.1.1", "--channel", "2"])
            .args(["--allow-write", self.allow.path()])
            .args(options)
            .arg("--")
            .args(command)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        tool
    }

    fn with<T>(&self, then: impl FnOnce(&mut ServiceInterface) -> T) -> T {
        self.cnc.with_service(2, then).unwrap()
    }

    /// Sends a request as an NC program does, and waits for the response and its state.
    fn ask(&self, id: &str, request: &str) -> (String, u32) {
        let (id, request) = (ServiceId::new(id).unwrap(), CncStr::new(request).unwrap());
        let mut call = ServiceCall::with_state(id, request, 7, SysServiceWait::default()).unwrap();
        let begun = Instant::now();
        loop {
            let now = begun.elapsed();
            assert!(now < WAIT_MAX, "no response");
            match call.step() {
                CallStep::Read(variable) => {
                    self.with(|interface| call.read(interface.read(variable), now)).unwrap();
                }
                CallStep::Write(variable, value) => {
                    self.with(|interface| interface.write(variable, value)).unwrap();
                    call.written(now);
                }
                CallStep::Wait { .. } => {
                    thread::sleep(Duration::from_millis(2));
                    call.poll();
                }
                CallStep::Done { state, response } => return (response.to_string(), state),
                CallStep::TimedOut => panic!("there is no maximum wait"),
            }
        }
    }

    /// Sends one request to a tool that is started with `--once`. Returns the response, its state, and the
    /// output of the tool.
    fn once(&self, options: &[&str], command: &[&str], request: &str) -> ((String, u32), Output) {
        let options = [&["--uuid", ID, "--once", "--poll", "5ms"], options].concat();
        let tool = self.tool(&options, command).spawn().unwrap();
        let answer = self.ask(ID, request);
        (answer, ended(tool))
    }
}

fn ended(tool: Child) -> Output {
    let output = tool.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    output
}

/// A command that exists on every system: `ads-cnc` itself.
const EXPLAIN: [&str; 5] =
    [env!("CARGO_BIN_EXE_ads-cnc"), "explain", "--stream", "variable-handle", "-"];

/// A command for the shell of the system.
fn shell<'a>(unix: &'a str, windows: &'a str) -> [&'a str; 3] {
    if cfg!(windows) { ["cmd", "/C", windows] } else { ["sh", "-c", unix] }
}

/// The command receives the request on stdin. Its stdout, truncated, is the response; for exit code 0,
/// the response state is 1.
#[test]
fn a_command_answers() {
    let ((response, state), output) = Bench::start().once(&[], &EXPLAIN, "04 00 00 02");
    assert_eq!(state, 1);
    assert!(response.starts_with("Variable handle by name"), "{response}");
    assert_eq!(response.chars().count(), 127);
    let (told, stderr_text) = (text(&output.stdout), text(&output.stderr));
    let line = format!("{ID} \"04 00 00 02\", state 7: \"Variable handle by name");
    assert!(told.starts_with(&line) && told.ends_with(", state 1\n"), "{told}");
    assert!(
        stderr_text.contains("warning: the response is truncated to 127 bytes"),
        "{stderr_text}"
    );
}

/// The manual's example: an NC program of the simulated CNC requests square roots.
#[cfg(unix)]
#[test]
fn a_script_is_answered() {
    let bench = Bench::start();
    let script = Script::new(ScriptConfig::square_root().unwrap()).unwrap();
    bench.cnc.set_script(2, Some(script)).unwrap();
    let answers = "read x; case $x in -*) echo ERROR; exit 99;; esac; echo 1.732051";
    let options = ["--uuid", ID, "--answers", "2", "--poll", "5ms"];
    let tool = bench.tool(&options, &["sh", "-c", answers]).spawn().unwrap();
    let told = text(&ended(tool).stdout);
    let lines: Vec<&str> = told.lines().map(|line| line.split_once(' ').unwrap().1).collect();
    assert_eq!(
        lines,
        [r#""3", state 1: "1.732051", state 1"#, r#""-3", state 1: "ERROR", state 99"#]
    );
}

/// Without a target, the tool starts a simulated CNC that sends requests, and needs no file.
#[test]
fn a_simulated_cnc_sends_requests() {
    let mut tool = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
    tool.args(["service", "--uuid", ID, "--answers", "2", "--"]).args(EXPLAIN);
    let output = tool.output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    // The command `explain` fails, because the requests are not valid handles.
    assert_eq!(text(&output.stdout).matches(", state 2\n").count(), 2);
    let mut tool = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
    tool.args(["service", "--uuid", ID, "--channel", "7", "--once", "--", "echo"]);
    assert_eq!(tool.output().unwrap().status.code(), Some(2));
}

/// The exit code of the command is the response state, except that 0 becomes 1, which means
/// success, and 1 becomes 1001.
#[test]
fn an_exit_code_is_the_state() {
    let bench = Bench::start();
    assert_eq!(bench.once(&[], &EXPLAIN, "04 00").0.1, 1001);
    assert_eq!(bench.once(&[], &EXPLAIN, "no hex").0, (String::new(), 2));
    let ((response, state), _) = bench.once(&[], &shell("exit 99", "exit 99"), "");
    assert_eq!((response, state), (String::new(), 99));
}

#[test]
fn the_environment_describes_the_request() {
    let echo = shell(
        "echo $ADS_CNC_UUID $ADS_CNC_REQUEST_STATE $ADS_CNC_CHANNEL",
        "echo %ADS_CNC_UUID% %ADS_CNC_REQUEST_STATE% %ADS_CNC_CHANNEL%",
    );
    let (answer, _) = Bench::start().once(&[], &echo, "");
    assert_eq!(answer, (format!("{ID} 7 2"), 1));
}

/// The tool ends a command that exceeds its time limit, and the NC program receives an error.
#[test]
fn a_time_limit_ends_a_command() {
    let serve = [env!("CARGO_BIN_EXE_ads-cnc"), "serve", "--listen", "127.0.0.1:0"];
    let ((response, state), output) = Bench::start().once(&["--time-limit", "1s"], &serve, "");
    assert_eq!(state, 1002);
    assert!(response.starts_with("listening on 127.0.0.1:"), "{response}");
    assert!(text(&output.stderr).contains("ran longer than 1s"));
}

#[test]
fn a_missing_command_is_answered_with_an_error() {
    let (answer, output) = Bench::start().once(&[], &["ads-cnc-no-such-command"], "");
    assert_eq!(answer, ("ERROR: command not started".to_owned(), 1004));
    assert!(text(&output.stderr).contains("ads-cnc-no-such-command"));
}

/// With several UUIDs, the tool runs the same command for all services; it ignores requests to other
/// UUIDs.
#[test]
fn several_services_share_a_command() {
    let bench = Bench::start();
    let both = format!("{ID},{OTHER}");
    let options = ["--uuid", &both, "--answers", "3", "--poll", "5ms"];
    let echo = shell("echo $ADS_CNC_UUID", "echo %ADS_CNC_UUID%");
    let tool = bench.tool(&options, &echo).spawn().unwrap();
    bench.with(|interface| {
        let other = b"00000000-0000-0000-0000-000000000000\0";
        interface.write(Uuid, other).unwrap();
        interface.write(RequestState, &[1, 0, 0, 0]).unwrap();
    });
    thread::sleep(Duration::from_millis(100));
    assert_eq!(bench.with(|interface| interface.read(RequestState).to_vec()), [1, 0, 0, 0]);
    for id in [ID, OTHER, ID] {
        assert_eq!(bench.ask(id, "x"), (id.to_owned(), 1));
    }
    assert_eq!(text(&ended(tool).stdout).lines().count(), 3);
}

/// Without an entry for the Service Interface of the channel, the tool does not start: otherwise, an NC
/// program would wait for a response that the tool must not write.
#[test]
fn the_service_needs_an_entry() {
    let mut bench = Bench::start();
    for table in ["", "[[service]]\nchannel = 1\n", "[[stream]]\nchannel = 2\n"] {
        bench.allow = TestFile::allowing(table);
        let output = bench.tool(&["--uuid", ID], &["echo"]).output().unwrap();
        let stderr_text = text(&output.stderr);
        assert_eq!(output.status.code(), Some(4), "{stderr_text}");
        assert!(stderr_text.ends_with("\n\n[[service]]\nchannel = 2\n"), "{stderr_text}");
    }
}

/// A dry run prints the ADS requests of a poll and of a response, and runs no command.
#[test]
fn a_dry_run_shows_the_requests() {
    let mut bench = Bench::start();
    for (table, code, verdict) in
        [("[[service]]\nchannel = 2\n", 0, "would be sent"), ("", 4, "would be rejected")]
    {
        bench.allow = TestFile::allowing(table);
        let output = bench.tool(&["--uuid", ID, "--dry-run"], &["echo"]).output().unwrap();
        let shown = text(&output.stdout);
        assert_eq!(output.status.code(), Some(code), "{}", text(&output.stderr));
        assert!(shown.matches(verdict).count() >= 3, "{shown}");
        assert_eq!(shown.matches("would be").count(), 6, "{shown}");
    }
}

/// Wrong usage is an error before the first ADS request.
#[test]
fn wrong_usage_is_rejected() {
    let bench = Bench::start();
    let short = &ID[..35];
    for options in [
        &["--uuid", short][..],
        &[],
        &["--uuid", ID, "--time-limit", "0s"],
        &["--uuid", ID, "--poll", "50"],
        &["--uuid", ID, "--answers", "0"],
    ] {
        let output = bench.tool(options, &["echo"]).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{options:?}");
    }
    let output = bench.tool(&["--uuid", ID], &[]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
}

/// If the CNC ends, the tool ends with an error.
#[test]
fn a_lost_connection_ends_the_service() {
    let bench = Bench::start();
    let mut tool = bench.tool(&["--uuid", ID], &["echo"]).spawn().unwrap();
    let mut stderr = BufReader::new(tool.stderr.take().unwrap());
    wait_for("waiting for requests", &mut stderr);
    drop(bench.server);
    let mut stderr_text = String::new();
    stderr.read_to_string(&mut stderr_text).unwrap();
    assert_eq!(tool.wait().unwrap().code(), Some(3), "{stderr_text}");
}

/// Reads lines until one contains `what`.
fn wait_for(what: &str, from: &mut impl BufRead) {
    let found = from.lines().map(Result::unwrap).any(|line| line.contains(what));
    assert!(found, "nothing says {what:?}");
}

/// A signal ends the tool and its command, and the tool still responds to the current request.
#[cfg(unix)]
#[test]
fn a_signal_ends_the_service() {
    for name in ["INT", "TERM", "HUP", "QUIT"] {
        let bench = Bench::start();
        let mut tool = bench.tool(&["--uuid", ID], &["sleep", "1000"]).spawn().unwrap();
        wait_for("waiting", &mut BufReader::new(tool.stderr.as_mut().unwrap()));
        crate::common::signal(name, tool.id());
        ended(tool);

        let script = "echo begun $$ | tee /dev/stderr; sleep 1000 | sleep 1000";
        let mut tool = bench.tool(&["--uuid", ID], &["sh", "-c", script]).spawn().unwrap();
        let mut stderr = BufReader::new(tool.stderr.take().unwrap());
        let (answer, process) = thread::scope(|scope| {
            let asked = scope.spawn(|| bench.ask(ID, "do"));
            let mut lines = stderr.by_ref().lines().map(Result::unwrap);
            let line = lines.find(|line| line.starts_with("begun ")).unwrap();
            crate::common::signal(name, tool.id());
            (asked.join().unwrap(), line)
        });
        assert_eq!(answer, (process.clone(), 1003), "SIG{name}");
        ended(tool);
        let group = process.strip_prefix("begun ").unwrap();
        let all =
            text(&Command::new("ps").args(["-A", "-o", "pgid=,stat="]).output().unwrap().stdout);
        let mut all = all.lines().filter_map(|line| line.trim().split_once(' '));
        let left = all.any(|(of, state)| of == group && !state.trim_start().starts_with('Z'));
        assert!(!left, "SIG{name} leaves some of the group {group}");
    }
}

/// Processes that the command has started in its process group are ended with it, and do not delay
/// the response.
#[cfg(unix)]
#[test]
fn a_time_limit_ends_all_processes_of_a_command() {
    let begun = Instant::now();
    let command = ["sh", "-c", "(sleep 1000; echo never) & sleep 1000"];
    let (answer, _) = Bench::start().once(&["--time-limit", "200ms"], &command, "");
    assert_eq!(answer, ("ERROR: time limit of 200ms exceeded".to_owned(), 1002));
    assert!(begun.elapsed() < WAIT_MAX);
}

/// If a command leaves a process behind that keeps stdout open, the tool still responds to the request,
/// and ends the process.
#[cfg(unix)]
#[test]
fn remaining_processes_do_not_delay_the_answer() {
    let ((response, state), output) =
        Bench::start().once(&[], &["sh", "-c", "sleep 1000 & echo $!"], "");
    assert_eq!(state, 1);
    assert!(text(&output.stderr).contains("kept its stdout open"));
    assert!(!runs(&response), "{response} runs");
}

/// A process that has created a session (`setsid`) is not ended. Each such process that keeps
/// stdout open occupies a thread of the tool, and the number of these threads is limited.
#[cfg(target_os = "linux")]
#[test]
fn processes_in_own_sessions_are_limited() {
    let bench = Bench::start();
    let kept = TestFile::new(".txt", b"");
    let script = format!("setsid sleep 1000 & echo $! | tee -a {}", kept.path());
    let options = ["--uuid", ID, "--answers", "11", "--poll", "5ms"];
    let mut tool = bench.tool(&options, &["sh", "-c", &script]).spawn().unwrap();
    let stderr = tool.stderr.take().unwrap();
    let reader = thread::spawn(move || std::io::read_to_string(stderr).unwrap());
    let states: Vec<u32> = (0..10).map(|_| bench.ask(ID, "").1).collect();
    let threads = std::fs::read_dir(format!("/proc/{}/task", tool.id())).unwrap().count();
    let (_, last) = bench.ask(ID, "");
    let status = tool.wait().unwrap();
    let left = std::fs::read_to_string(&kept.0).unwrap();
    for id in left.lines() {
        let _gone = Command::new("kill").args(["-KILL", id]).output().unwrap();
    }
    let stderr_text = reader.join().unwrap();
    assert_eq!(
        (&states[..8], &states[8..], last),
        (&[1; 8][..], &[1004; 2][..], 1004),
        "{stderr_text}"
    );
    assert!(threads <= 12, "{threads} threads");
    assert_eq!((status.code(), left.lines().count()), (Some(0), 8), "{stderr_text}");
    assert!(stderr_text.contains("8 processes started by earlier commands"), "{stderr_text}");
}

/// A command may write any amount of output without blocking; only the beginning is stored.
#[cfg(unix)]
#[test]
fn long_output_is_truncated() {
    let command = ["sh", "-c", "yes | head -c 10000000; kill -TERM $$"];
    let ((response, state), _) = Bench::start().once(&[], &command, "");
    assert_eq!((response.len(), state), (127, 1003));
}

/// Texts are converted between CP1252 and UTF-8 in both directions.
#[cfg(unix)]
#[test]
fn text_is_utf8_to_the_command() {
    let (answer, _) = Bench::start().once(&[], &["cat"], "12,5 € für 2 m²");
    assert_eq!(answer, ("12,5 € für 2 m²".to_owned(), 1));
}

/// If the command ends after its request no longer exists, the tool drops the response, and serves the
/// next request.
#[cfg(unix)]
#[test]
fn a_late_answer_is_dropped() {
    let bench = Bench::start();
    let options = ["--uuid", ID, "--once", "--poll", "5ms"];
    let script = "read x; echo begun >&2; sleep $x; echo $x";
    let mut tool = bench.tool(&options, &["sh", "-c", script]).spawn().unwrap();
    let mut stderr = BufReader::new(tool.stderr.take().unwrap());
    bench.with(|interface| {
        interface.write(Uuid, ID.as_bytes()).unwrap();
        interface.write(ads_cnc::service::ServiceVariable::Request, b"1\0").unwrap();
        interface.write(RequestState, &[1, 0, 0, 0]).unwrap();
    });
    wait_for("begun", &mut stderr);
    bench.with(ServiceInterface::reset);
    wait_for("dropped, because the request no longer exists", &mut stderr);
    assert_eq!(bench.ask(ID, "0"), ("0".to_owned(), 1));
    assert_eq!(text(&ended(tool).stdout).lines().count(), 1);
}
