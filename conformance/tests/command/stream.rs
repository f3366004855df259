//! `ads-cnc stream` as users call it.

use std::io::Write as _;
use std::net::SocketAddr;
use std::process::{Command, Output, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use crate::common::Serve;
use crate::common::fake::{Answer, fake};
use crate::common::file::TestFile;
use crate::common::text;
use ads_cnc::ads::AdsError;
use ads_cnc::streaming::Ack;
use ads_cnc_conformance::net;
use ads_cnc_conformance::simulator::program::{Pace, ProgramConfig, StreamingInterface};
use ads_cnc_conformance::simulator::{Cnc, Server};

const STREAM_1: &str = "[[stream]]\nchannel = 1\n";

/// The reply of a CNC that is busy.
const BUSY: Answer = Answer::Result(AdsError::INVALID_DATA);

fn tool(file: &str, options: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
    command.args(["stream", file]).args(options).stdin(Stdio::null());
    command
}

fn to<'a>(addr: &'a str, allow: &'a TestFile) -> [&'a str; 6] {
    ["--target", addr, "--net-id", "127.0.0.1.1.1", "--allow-write", allow.path()]
}

fn stream(program: &[u8], addr: SocketAddr, allow: &TestFile, options: &[&str]) -> Output {
    let file = TestFile::new(".nc", program);
    tool(file.path(), &to(&addr.to_string(), allow)).args(options).output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

/// A program of 1000 lines that end in LF. With CR LF, 10 lines have 12 bytes, 90 have 14 and 900 have
/// 16, which results in packets of 72, 65, 13 times 62, and 57 lines. The packets do not all fit into
/// the streaming interface.
fn program() -> String {
    (0..1000).map(|line| format!("N{line}0 G01 X{line}\n")).collect()
}

/// A fake CNC that stores the packets that it receives.
fn kept(mut answer: impl FnMut(usize) -> Answer + Send + 'static) -> (SocketAddr, Packets) {
    let packets = Packets::default();
    let keep = Arc::clone(&packets);
    let addr = fake(move |channel, packet| {
        let mut packets = keep.lock().unwrap();
        packets.push((channel, packet.to_vec()));
        answer(packets.len())
    });
    (addr, packets)
}

type Packets = Arc<Mutex<Vec<(u8, Vec<u8>)>>>;

const OK: Answer = Answer::Result(AdsError::NO_ERROR);

/// Each line arrives once and in order, although the streaming interface is sometimes full.
#[test]
fn a_program_arrives_completely() {
    let ran = Arc::new(Mutex::new(Vec::new()));
    let (runs, mut cnc, mut writes) = (Arc::clone(&ran), StreamingInterface::new(), 0);
    let addr = fake(move |_, packet| {
        writes += 1;
        if writes % 7 == 0 {
            runs.lock().unwrap().extend_from_slice(cnc.read().unwrap());
        }
        match cnc.write(packet) {
            Ack::Accepted => {
                if packet.ends_with(b"N9990 G01 X999\r\n") {
                    runs.lock().unwrap().extend_from_slice(cnc.read().unwrap());
                }
                OK
            }
            Ack::Busy => BUSY,
            Ack::Rejected => Answer::Result(AdsError::INVALID_SIZE),
        }
    });
    let program = program();
    let allow = TestFile::allowing(STREAM_1);
    let output = stream(program.as_bytes(), addr, &allow, &["--retry-after", "1ms"]);
    let shown = text(&output.stdout);
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    assert_eq!(text(&ran.lock().unwrap()), program.replace('\n', "\r\n"));
    assert!(shown.contains(": channel 1 accepted lines 1 to 1000 in 16 packets, "), "{shown}");
    assert!(shown.contains(" temporary rejections"), "{shown}");
    assert!(!shown.contains("not "), "{shown}");
}

/// If the CNC rejects a packet as busy too often, the tool gives up and reports the remaining lines.
#[test]
fn retries_are_limited() {
    let (addr, packets) = kept(|count| if count == 1 { OK } else { BUSY });
    let allow = TestFile::allowing(STREAM_1);
    let options = ["--retry-after", "1ms", "--retries", "3"];
    let output = stream(program().as_bytes(), addr, &allow, &options);
    let (shown, stderr_text) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(code(&output), 1, "{stderr_text}");
    let packets = packets.lock().unwrap();
    // The first packet is accepted; the second is sent once and then repeated three times.
    assert_eq!(packets.len(), 5);
    assert!(packets[1..].iter().all(|packet| *packet == packets[1]));
    assert!(shown.contains("accepted lines 1 to 72 in 1 packet, "), "{shown}");
    assert!(shown.ends_with("\n  not sent or not accepted: lines 73 to 1000\n"), "{shown}");
    assert!(stderr_text.contains("gave up") && stderr_text.contains("--retries"), "{stderr_text}");
}

/// A packet that is rejected with an error other than "busy" is not sent again.
#[test]
fn another_error_ends_the_stream() {
    let rejected = Answer::Result(AdsError::INVALID_OFFSET);
    let (addr, packets) = kept(move |_| rejected);
    let allow = TestFile::allowing(STREAM_1);
    let output = stream(b"N10 G0 X0\nN20 M30\n", addr, &allow, &[]);
    let (shown, stderr_text) = (text(&output.stdout), text(&output.stderr));
    assert_eq!((code(&output), packets.lock().unwrap().len()), (1, 1), "{stderr_text}");
    assert!(
        shown.contains("accepted nothing\n  not sent or not accepted: lines 1 to 2"),
        "{shown}"
    );
    assert!(stderr_text.contains("\"data streaming\" with 0x703"), "{stderr_text}");
}

/// A packet without a reply may have been accepted, so it is not sent again.
#[test]
fn a_packet_without_a_reply_is_not_repeated() {
    for lost in [Answer::Silence, Answer::Close] {
        let (addr, packets) = kept(move |count| if count == 2 { lost } else { OK });
        let allow = TestFile::allowing(STREAM_1);
        let output = stream(program().as_bytes(), addr, &allow, &["--timeout", "300"]);
        let (shown, stderr_text) = (text(&output.stdout), text(&output.stderr));
        assert_eq!((code(&output), packets.lock().unwrap().len()), (3, 2), "{stderr_text}");
        let left = "\n  unknown whether accepted: lines 73 to 137\
                    \n  not sent or not accepted: lines 138 to 1000\n";
        assert!(shown.ends_with(left), "{shown}");
        assert!(stderr_text.contains("not sent again"), "{stderr_text}");
    }
}

/// After a reply with a wrong invoke ID, the tool reports that the packet may have been accepted.
#[test]
fn a_packet_with_a_wrong_reply_may_have_been_accepted() {
    let serve = Serve::start(&["--defect", "ams-header.invoke_id.zero"]);
    let allow = TestFile::allowing(STREAM_1);
    let output = stream(b"X1\nX2\n", serve.addr.parse().unwrap(), &allow, &[]);
    let shown = text(&output.stdout);
    assert_eq!(code(&output), 1, "{}", text(&output.stderr));
    assert!(shown.contains("unknown whether accepted: lines 1 to 2"), "{shown}");
}

/// No part of an invalid program is sent. With the option `--force`, lines that end streaming are sent.
#[test]
fn an_invalid_program_is_not_sent() {
    let (addr, packets) = kept(|_| OK);
    let allow = TestFile::allowing(STREAM_1);
    for (program, stderr_text) in [
        (
            &b"N10 (\xE4)\nN20 \x00\n"[..],
            ".nc:2:5: error: ASCII character expected, NUL found (STM-7)",
        ),
        (b"N10 $FOR P1=0,10,1\n", ".nc:1:5: error: $FOR in a stream (STM-8)"),
    ] {
        let output = stream(program, addr, &allow, &[]);
        let shown = text(&output.stderr);
        assert_eq!(code(&output), 1, "{shown}");
        assert!(shown.contains(stderr_text) && shown.contains("nothing was sent"), "{shown}");
    }
    let output = stream(b"", addr, &allow, &[]);
    assert_eq!(code(&output), 2);
    assert!(packets.lock().unwrap().is_empty());

    let output = stream(b"N10 $FOR P1=0,10,1\nN20 M30\nN30 X1", addr, &allow, &["--force"]);
    let stderr_text = text(&output.stderr);
    assert_eq!(code(&output), 0, "{stderr_text}");
    assert!(
        stderr_text.contains(".nc:3:1: warning: text after the M30 of line 2 (STM-10)"),
        "{stderr_text}"
    );
    let packets = packets.lock().unwrap();
    assert_eq!(packets[..], [(1, b"N10 $FOR P1=0,10,1\r\nN20 M30\r\nN30 X1\r\n".to_vec())]);
}

/// Without an entry for the program stream of the channel, the tool sends nothing to a device.
#[test]
fn the_stream_needs_an_entry() {
    let (addr, packets) = kept(|_| OK);
    for table in ["", "[[stream]]\nchannel = 2\n", "[[service]]\nchannel = 1\n"] {
        let allow = TestFile::allowing(table);
        let output = stream(b"M30\n", addr, &allow, &[]);
        let stderr_text = text(&output.stderr);
        assert_eq!(code(&output), 4, "{stderr_text}");
        assert!(stderr_text.ends_with("\n\n[[stream]]\nchannel = 1\n"), "{stderr_text}");
    }
    let file = TestFile::new(".nc", b"M30\n");
    let addr = addr.to_string();
    let options = ["--target", &addr, "--net-id", "127.0.0.1.1.1"];
    assert_eq!(code(&tool(file.path(), &options).output().unwrap()), 4);
    // For the simulated CNC no file is needed, but a file that is given applies.
    let allow = TestFile::allowing("");
    assert_eq!(code(&tool(file.path(), &["--allow-write", allow.path()]).output().unwrap()), 4);
    assert_eq!(code(&tool(file.path(), &[]).output().unwrap()), 0);
    assert_eq!(code(&tool(file.path(), &["--dry-run"]).output().unwrap()), 0);
    assert!(packets.lock().unwrap().is_empty());

    let allow = TestFile::allowing("[[stream]]\nchannel = 2\n");
    let output = stream(b"M30\n", addr.parse().unwrap(), &allow, &["--channel", "2"]);
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    assert_eq!(packets.lock().unwrap()[..], [(2, b"M30\r\n".to_vec())]);
}

/// A dry run prints every packet and sends none.
#[test]
fn a_dry_run_shows_the_packets() {
    let (addr, packets) = kept(|_| OK);
    for (table, exit, verdict) in [(STREAM_1, 0, "would be sent\n"), ("", 4, "would be rejected\n")]
    {
        let allow = TestFile::allowing(table);
        let output = stream(program().as_bytes(), addr, &allow, &["--dry-run"]);
        let shown = text(&output.stdout);
        assert_eq!(code(&output), exit, "{}", text(&output.stderr));
        assert_eq!(shown.matches(verdict).count(), 16, "{shown}");
        assert!(shown.contains("data streaming (STM-1): Write 0x120101, 0x90 at port 553"));
    }
    assert!(packets.lock().unwrap().is_empty());
}

#[test]
fn a_program_may_come_from_stdin() {
    let (addr, packets) = kept(|_| OK);
    let allow = TestFile::allowing(STREAM_1);
    let mut command = tool("-", &to(&addr.to_string(), &allow));
    let mut process = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    process.stdin.take().unwrap().write_all(b"N10 M30").unwrap();
    let output = process.wait_with_output().unwrap();
    assert_eq!(code(&output), 0);
    assert!(text(&output.stdout).starts_with("stdin: channel 1 accepted line 1 in 1 packet, "));
    assert_eq!(packets.lock().unwrap()[..], [(1, b"N10 M30\r\n".to_vec())]);
}

/// After a signal while the tool waits, the summary states which lines were accepted and which were
/// not.
#[cfg(unix)]
#[test]
fn a_signal_ends_the_stream_with_a_summary() {
    for name in ["INT", "TERM", "HUP", "QUIT"] {
        let (tell, told) = std::sync::mpsc::channel();
        let (addr, packets) = kept(move |count| {
            if count == 1 {
                return OK;
            }
            tell.send(()).unwrap();
            BUSY
        });
        let allow = TestFile::allowing(STREAM_1);
        let file = TestFile::new(".nc", program().as_bytes());
        let addr = addr.to_string();
        let options = to(&addr, &allow);
        let mut command = tool(file.path(), &options);
        command.args(["--retry-after", "10min"]).stdout(Stdio::piped()).stderr(Stdio::piped());
        let process = command.spawn().unwrap();
        told.recv().unwrap();
        crate::common::signal(name, process.id());
        let output = process.wait_with_output().unwrap();
        let (shown, stderr_text) = (text(&output.stdout), text(&output.stderr));
        assert_eq!(
            (code(&output), packets.lock().unwrap().len()),
            (3, 2),
            "SIG{name}: {stderr_text}"
        );
        assert!(shown.contains("accepted lines 1 to 72 in 1 packet"), "SIG{name}: {shown}");
        let left = "\n  not sent or not accepted: lines 73 to 1000\n";
        assert!(shown.ends_with(left), "SIG{name}: {shown}");
        assert!(stderr_text.contains("interrupted"), "SIG{name}: {stderr_text}");
    }
}

/// A slow CNC executes every line once and in order.
#[test]
fn a_slow_cnc_executes_every_line_once() {
    let cnc = Arc::new(Cnc::with_default_model().unwrap());
    let pace = Pace::lines_per_second(2000).unwrap();
    cnc.set_program(1, ProgramConfig { pace, ..ProgramConfig::default() }).unwrap();
    let listener = net::listen(([127, 0, 0, 1], 0).into()).unwrap();
    let server = Server::start(listener, cnc.clone()).unwrap();
    let allow = TestFile::allowing(STREAM_1);
    let output = stream(program().as_bytes(), server.addr(), &allow, &["--retry-after", "10ms"]);
    let shown = text(&output.stdout);
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    assert!(shown.contains("accepted lines 1 to 1000 in 16 packets"), "{shown}");
    assert!(shown.contains(" temporary rejection"), "{shown}");
    let begun = Instant::now();
    let executed = loop {
        let executed = cnc.with_program(1, |program| program.executed().clone()).unwrap();
        if executed.line_count() >= 1000 || begun.elapsed() > Duration::from_secs(20) {
            break executed;
        }
        thread::sleep(Duration::from_millis(10));
    };
    assert_eq!(text(executed.recent()), program().replace('\n', "\r\n"));
}
