//! By default, the tools change nothing on a target. A proxy in front of a CNC records every frame, and
//! the test judges each frame only by its bytes, independent of the codec and the gate.

use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::process::{Command, Output};
use std::sync::{Arc, Mutex};
use std::thread;

use crate::common::connect;
use crate::common::file::TestFile;
use crate::common::harmless::{is_harmless, number};
use ads_cnc_conformance::net;
use ads_cnc_conformance::simulator::{Cnc, Server};

/// Calls without `--allow-write` of all commands that connect to a target, each with the exit code and
/// whether the command sends queries. A new command must be added here.
const TOOLS: &[(&[&str], i32, bool)] = &[
    (&["run"], 0, true),
    // The license file serves as an NC program, because any ASCII text is one.
    (&["stream", concat!(env!("CARGO_MANIFEST_DIR"), "/LICENSE-MIT")], 4, false),
    (&["service", "--uuid", "560AACBF-6335-44a9-895A-8B27F3ED5E47", "--", "echo"], 4, false),
    (&["browse", "--content", "--exact"], 0, true),
    (&["browse", "--variables", "--content"], 0, true),
    (&["get", "V.E.matrix[1][2]"], 0, true),
    (&["get", "V.A.WCS", "--axis", "2"], 0, true),
    (&["get", "P1"], 0, true),
    (&["get", "feedhold.enable"], 0, true),
    (&["set", "V.E.vartest", "1"], 4, true),
    (&["set", "V.A.WCS", "1", "--axis", "2"], 4, true),
    (&["set", "V.E.varest", "1"], 1, true),
    (&["set", "V.E.vartest", "many"], 2, true),
    (&["set", "mc_command_single_block_w", "TRUE"], 4, true),
    (&["set", "example.feed", "1"], 4, true),
];

/// A simulated CNC behind a proxy that records the frames that are sent to the CNC.
struct Tripwire {
    addr: SocketAddr,
    kept: Arc<Mutex<Vec<Vec<u8>>>>,
    _server: Server,
}

impl Tripwire {
    fn start() -> Self {
        let loopback = SocketAddr::from(([127, 0, 0, 1], 0));
        let cnc = Arc::new(Cnc::with_default_model().unwrap());
        let server = Server::start(net::listen(loopback).unwrap(), cnc).unwrap();
        let listener = net::listen(loopback).unwrap();
        let (addr, cnc) = (listener.local_addr().unwrap(), server.addr());
        let kept = Arc::new(Mutex::new(Vec::new()));
        let keep = Arc::clone(&kept);
        thread::spawn(move || {
            for client in listener.incoming() {
                let (client, keep) = (client.unwrap(), Arc::clone(&keep));
                let place = {
                    let mut all = keep.lock().unwrap();
                    all.push(Vec::new());
                    all.len() - 1
                };
                thread::spawn(move || pass(client, connect(cnc), &keep, place));
            }
        });
        Self { addr, kept, _server: server }
    }

    /// The bytes that were sent on each connection.
    fn connections(&self) -> Vec<Vec<u8>> {
        self.kept.lock().unwrap().clone()
    }

    /// The handle of a variable, from the output of `get`.
    fn handle(&self, name: &str) -> u32 {
        let shown = String::from_utf8(self.call(&["get", name]).stdout).unwrap();
        let (_, handle) = shown.lines().next().unwrap().rsplit_once("handle 0x").unwrap();
        u32::from_str_radix(handle.trim(), 16).unwrap()
    }

    fn call(&self, args: &[&str]) -> Output {
        let (tool, rest) = args.split_first().unwrap();
        Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
            .args([*tool, "--target", &self.addr.to_string(), "--net-id", "127.0.0.1.1.1"])
            .args(rest)
            .output()
            .unwrap()
    }
}

/// Forwards a connection, and stores the bytes of the client before the CNC receives them.
fn pass(mut client: TcpStream, cnc: TcpStream, keep: &Mutex<Vec<Vec<u8>>>, place: usize) {
    client.set_nodelay(true).unwrap();
    let (mut replies, mut back) = (cnc.try_clone().unwrap(), client.try_clone().unwrap());
    thread::spawn(move || io::copy(&mut replies, &mut back));
    let (mut cnc, mut chunk) = (cnc, [0; 4096]);
    while let Ok(len @ 1..) = client.read(&mut chunk) {
        keep.lock().unwrap()[place].extend_from_slice(&chunk[..len]);
        if cnc.write_all(&chunk[..len]).is_err() {
            break;
        }
    }
    let _gone = cnc.shutdown(std::net::Shutdown::Both);
}

/// Splits the bytes of a connection into frames; fails if the last frame is incomplete.
fn frames(mut bytes: &[u8]) -> Vec<&[u8]> {
    let mut frames = Vec::new();
    while !bytes.is_empty() {
        assert_eq!(bytes[..2], [0, 0], "no frame");
        let (frame, rest) = bytes.split_at(6 + number(bytes, 2) as usize);
        frames.push(frame);
        bytes = rest;
    }
    frames
}

#[test]
fn default_runs_of_every_tool_change_nothing() {
    for (args, code, asks) in TOOLS {
        let tripwire = Tripwire::start();
        let output = tripwire.call(args);
        assert_eq!(output.status.code(), Some(*code), "{args:?}: {output:?}");
        let connections = tripwire.connections();
        let mut seen = 0;
        for frame in connections.iter().flat_map(|bytes| frames(bytes)) {
            assert!(is_harmless(frame), "{args:?}: {frame:02x?}");
            seen += 1;
        }
        assert_eq!(seen > 0, *asks, "{args:?}: {seen} frames");
    }
}

/// If the name of a write suffices to reject it, the tool rejects it before it connects.
#[test]
fn a_rejection_needs_no_connection() {
    let addr = nobody().to_string();
    let program = TestFile::new(".nc", b"M30\n");
    for (code, args) in [
        (4, &["set", "V.E.Testvar[0]", "1"][..]),
        (4, &["stream", program.path()]),
        (4, &["service", "--uuid", "560AACBF-6335-44a9-895A-8B27F3ED5E47", "--", "echo"]),
        (3, &["get", "V.E.Testvar[0]"]),
    ] {
        let target = ["--target", &addr, "--net-id", "127.0.0.1.1.1"];
        let args = [&args[..1], &target, &args[1..]].concat();
        let output = Command::new(env!("CARGO_BIN_EXE_ads-cnc")).args(&args).output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{args:?}: {output:?}");
    }
}

/// An address on this machine at which no program listens.
fn nobody() -> SocketAddr {
    let listener = net::listen(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap();
    listener.local_addr().unwrap()
}

/// Commands that only read write nothing, even with a file that allows writes.
#[test]
fn a_file_alone_changes_nothing() {
    let file = TestFile::allowing(
        "[[stream]]\nchannel = 1\n[[variable]]\nchannel = 1\nname = \"V.E.Testvar\"\n",
    );
    for tool in [&["browse"][..], &["get", "V.E.Testvar"]] {
        let tripwire = Tripwire::start();
        let output = tripwire.call(&[tool, &["--allow-write", file.path()]].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let connections = tripwire.connections();
        assert!(connections.iter().flat_map(|bytes| frames(bytes)).all(is_harmless), "{tool:?}");
    }
}

/// The suite writes only the value that the file names, by name or by handle, and restores it.
#[test]
fn a_run_writes_only_named_values_and_restores_them() {
    let file = TestFile::allowing("[[variable]]\nchannel = 1\nname = \"V.E.test\"\n");
    let tripwire = Tripwire::start();
    let before = tripwire.call(&["browse", "--variables", "--content"]).stdout;
    let output = tripwire.call(&["run", "--allow-write", file.path()]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let after = tripwire.call(&["browse", "--variables", "--content"]).stdout;
    assert!(before == after);
    let connections = tripwire.connections();
    let all = connections.iter().flat_map(|bytes| frames(bytes));
    let writes: Vec<&[u8]> = all.filter(|frame| !is_harmless(frame)).collect();
    for frame in &writes {
        // The data of a Write follows the headers, the group, the offset and the length.
        assert_eq!((frame[22], number(frame, 38)), (3, 0x12_2301), "{frame:02x?}");
        let data = &frame[50..];
        match number(frame, 42) {
            0x49 => assert_eq!(number(data, 0), 0x0200_1234, "{frame:02x?}"),
            0x4A => assert!(data.starts_with(b"V.E.test\0") || data.starts_with(b"V.E.test[")),
            offset => panic!("{offset:#x}: {frame:02x?}"),
        }
    }
    // Seven values are written: by handle and by name, the whole value and two elements, and once
    // to test the service Write. Each is written three times: with the original value, another value,
    // and the original value again.
    assert_eq!(writes.len(), 21);
}

/// The suite streams only comments and empty lines to a device, and responds to no request of an NC
/// program, so that nothing moves.
#[test]
fn a_run_streams_only_comments_and_answers_no_request() {
    let entries = "[[stream]]\nchannel = 1\n[[stream]]\nrank = 1\n[[service]]\nchannel = 1\n";
    let file = TestFile::allowing(entries);
    let tripwire = Tripwire::start();
    let texts = ["REQUEST", "RESPONSE"].map(|name| tripwire.handle(&format!("V.G.SERVICE.{name}")));
    let output = tripwire.call(&["run", "--allow-write", file.path()]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let connections = tripwire.connections();
    let all = connections.iter().flat_map(|bytes| frames(bytes));
    let (mut streamed, mut answered) = (0, 0);
    for frame in all.filter(|frame| !is_harmless(frame)) {
        assert_eq!(frame[22], 3, "{frame:02x?}");
        let data = &frame[50..];
        if number(frame, 42) == 0x90 {
            assert!([0x12_0101, 0x2_0101].contains(&number(frame, 38)), "{frame:02x?}");
            assert!(data.len() <= 992 && data.ends_with(b"\r\n"));
            let lines = data.split(|&byte| byte == b'\n');
            let mut lines = lines.map(|line| line.strip_suffix(b"\r").unwrap_or(line));
            let is_comment = |line: &[u8]| {
                line.is_empty() || line[0] == b';' || line[0] == b'(' && line.ends_with(b")")
            };
            assert!(lines.all(is_comment), "{data:?}");
            streamed += 1;
        } else {
            assert_eq!(number(frame, 38), 0x12_2301, "{frame:02x?}");
            match number(frame, 42) {
                0x49 => assert!(texts.contains(&number(data, 0)), "{data:?}"),
                0x4A => assert!(data.starts_with(b"V.G.SERVICE.RE"), "{data:?}"),
                other => panic!("{other:#x}: {frame:02x?}"),
            }
            answered += 1;
        }
    }
    assert!(streamed > 2 && answered > 3, "{streamed} packets, {answered} answers");
}

/// A dry run prints its requests and does not connect.
#[test]
fn a_dry_run_sends_nothing() {
    for (args, code, asks) in TOOLS {
        let tripwire = Tripwire::start();
        let output = tripwire.call(&[&args[..1], &["--dry-run"], &args[1..]].concat());
        // A command that sends queries first ends after printing them, before its write is rejected.
        let code = match args {
            // The write of a variable needs no query, because its name is known.
            ["set", name, ..] if name.starts_with("V.") => 4,
            _ if *asks => 0,
            _ => *code,
        };
        assert_eq!(output.status.code(), Some(code), "{args:?}: {output:?}");
        let shown = String::from_utf8(output.stdout).unwrap();
        let verdict = if code == 0 { "would be sent" } else { "would be rejected" };
        assert!(shown.contains(verdict), "{args:?}: {shown}");
        assert_eq!(tripwire.connections().len(), 0, "{args:?}");
    }
}

/// Malformed requests need a file even for a target at a loopback address; without the file, the tool does
/// not connect.
#[test]
fn malformed_requests_without_a_file_need_no_connection() {
    let tripwire = Tripwire::start();
    let output = tripwire.call(&["run", "--malformed"]);
    let why = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(4), "{why}");
    assert!(why.contains("malformed = true"), "{why}");
    assert_eq!(tripwire.connections().len(), 0);
}

/// An invalid file is rejected, with the number of the line, before anything is sent.
#[test]
fn nothing_is_sent_with_an_invalid_file() {
    let text = "target = \"127.0.0.1.1.1\"\nexpires = 2026-05-04T17:30:00Z\nwrite = true\n";
    let file = TestFile::new(".toml", text.as_bytes());
    let tripwire = Tripwire::start();
    let output = tripwire.call(&["run", "--allow-write", file.path()]);
    let why = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{why}");
    assert!(why.contains(file.path()) && why.contains("line 3") && why.contains("write"), "{why}");
    assert_eq!(tripwire.connections().len(), 0);
}

/// `is_harmless`, on which these tests rely, returns false for frames that write or move something.
#[test]
fn harmful_frames_are_detected() {
    let frame = |command: u8, port: u16, group: u32, offset: u32, data: &[u8]| {
        let mut frame = vec![0; 38];
        frame[12..14].copy_from_slice(&port.to_le_bytes());
        (frame[22], frame[24]) = (command, 4);
        for word in [group, offset, 4] {
            frame.extend_from_slice(&word.to_le_bytes());
        }
        frame.extend_from_slice(data);
        frame
    };
    for (harmless, frame) in [
        (true, frame(2, 553, 0x13_0101, 1, b"")),
        (true, frame(9, 552, 0x12_2301, 0x44, b"\x04\0\0\0V.E\0")),
        (true, frame(9, 552, 0x12_2301, 0x2_0005, b"\x04\0\0\0V.A\0")),
        (true, frame(9, 552, 0x12_3900, 0, &[8, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0])),
        (false, frame(2, 553, 0x2_0101, 0x90, b"")),
        (false, frame(2, 553, 0x12_0101, 0x90, b"")),
        (false, frame(2, 851, 0x13_0101, 1, b"")),
        (false, frame(3, 552, 0x12_2301, 0x4A, b"V.E.a\0\x01")),
        (false, frame(9, 552, 0x12_2301, 0x4A, b"\x07\0\0\0V.E.a\0\x01")),
        (false, frame(9, 552, 0xF081, 1, b"")),
        (false, frame(5, 552, 0, 0, b"")),
        (false, frame(6, 552, 0, 0, b"")),
    ] {
        assert_eq!(is_harmless(&frame), harmless, "{frame:02x?}");
    }
}
