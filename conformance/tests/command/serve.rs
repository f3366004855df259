//! `ads-cnc serve` as users call it. Other tests check the replies.

use std::io::{Read as _, Write as _};

use crate::common::{Serve, ads_cnc, connect, text};

/// ReadState of the COM task, and its reply.
const STATE: &[u8] = b"\0\0\x20\0\0\0\x7f\0\0\x01\x01\x01\x29\x02\x7f\0\0\x01\x01\x02\0\x80\
                       \x04\0\x04\0\0\0\0\0\0\0\0\0\x01\0\0\0";
const RUN: &[u8] = b"\0\0\x28\0\0\0\x7f\0\0\x01\x01\x02\0\x80\x7f\0\0\x01\x01\x01\x29\x02\
                     \x04\0\x05\0\x08\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0\x05\0\0\0";

fn works(serve: &Serve) -> std::net::TcpStream {
    let mut stream = connect(serve.addr.parse().unwrap());
    stream.write_all(STATE).unwrap();
    let mut answer = vec![0; RUN.len()];
    stream.read_exact(&mut answer).unwrap();
    assert_eq!(answer, RUN);
    stream
}

/// A signal ends the process with exit code 0 and an entry in the log, with or without clients.
#[cfg(unix)]
#[test]
fn a_signal_ends_the_server() {
    use std::time::{Duration, Instant};

    for (name, with_clients) in [("INT", false), ("INT", true), ("TERM", true), ("HUP", true)] {
        let mut serve = Serve::logging(&["--log", "info"]);
        let mut client = with_clients.then(|| works(&serve));
        crate::common::signal(name, serve.process.id());
        let begun = Instant::now();
        let status = loop {
            match serve.process.try_wait().unwrap() {
                Some(status) => break status,
                None if begun.elapsed() > Duration::from_secs(20) => panic!("it goes on"),
                None => std::thread::sleep(Duration::from_millis(5)),
            }
        };
        assert_eq!(status.code(), Some(0));
        let mut log = String::new();
        serve.process.stderr.take().unwrap().read_to_string(&mut log).unwrap();
        assert!(log.contains("stopped by a signal"), "{log}");
        assert_eq!(log.contains("connected"), with_clients, "{log}");
        if let Some(client) = &mut client {
            // The connection has ended, possibly by a reset.
            assert!(matches!(client.read(&mut [0; 1]), Ok(0) | Err(_)));
        }
    }
}

/// With `--executed`, `serve` writes the executed lines of a channel to a file when a signal ends it.
#[cfg(unix)]
#[test]
fn executed_lines_are_written_at_the_end() {
    use crate::common::file::TestFile;

    let program = TestFile::new(".nc", b"N10 X1\nN20 X2\nN30 $FOR P1=0,10,1\nN40 X4\n");
    let allow = TestFile::allowing("[[stream]]\nchannel = 2\n");
    for name in ["INT", "TERM", "HUP", "QUIT"] {
        let ran = TestFile::new(".nc", b"");
        let executed = format!("2={}", ran.path());
        let options = ["--log", "info", "--pace", "fast", "--executed", &executed];
        let mut serve = Serve::logging(&options);
        let stream = std::process::Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
            .args(["stream", program.path(), "--force", "--channel", "2"])
            .args(["--target", &serve.addr, "--net-id", &serve.net_id])
            .args(["--allow-write", allow.path()])
            .output();
        assert_eq!(stream.unwrap().status.code(), Some(0));
        crate::common::signal(name, serve.process.id());
        assert_eq!(serve.process.wait().unwrap().code(), Some(0), "SIG{name}");
        assert_eq!(std::fs::read(&ran.0).unwrap(), b"N10 X1\r\nN20 X2\r\n", "SIG{name}");
        let mut log = String::new();
        serve.process.stderr.take().unwrap().read_to_string(&mut log).unwrap();
        assert!(log.contains("streaming was aborted: streaming.nc:3:5: $FOR in a stream"), "{log}");
        assert!(log.contains("channel=2 lines=2 bytes=16"), "{log}");
    }
}

/// The log contains the client and the reason when the CNC ends a connection; other clients still receive
/// replies.
#[test]
fn the_log_contains_the_end_of_a_connection() {
    let mut serve = Serve::logging(&["--idle", "1"]);
    let mut bad = works(&serve);
    let peer = bad.local_addr().unwrap().to_string();
    bad.write_all(b"GET / HTTP/1.1\r\n\r\n").unwrap();
    assert!(matches!(bad.read(&mut [0; 1]), Ok(0) | Err(_)));
    let mut idle = works(&serve);
    let silent = idle.local_addr().unwrap().to_string();
    assert!(matches!(idle.read(&mut [0; 1]), Ok(0) | Err(_)));
    drop(works(&serve));

    serve.process.kill().unwrap();
    let mut log = String::new();
    serve.process.stderr.take().unwrap().read_to_string(&mut log).unwrap();
    let line = |peer: &str| log.lines().find(|line| line.contains(peer) && line.contains("ended"));
    assert!(line(&peer).unwrap().contains("malformed frame: ams-tcp-header: reserved"), "{log}");
    assert!(line(&silent).unwrap().contains("no request for 1 s"), "{log}");
}

/// The filter of the log determines which messages are logged.
#[test]
fn logs_are_filtered() {
    for (filter, logged) in [
        ("off", false),
        ("error", false),
        ("info", true),
        ("warn,ads_cnc_conformance::simulator::server=debug", true),
        ("info,ads_cnc_conformance=error", false),
    ] {
        let mut serve = Serve::logging(&["--log", filter]);
        drop(works(&serve));
        drop(works(&serve));
        serve.process.kill().unwrap();
        let mut log = String::new();
        serve.process.stderr.take().unwrap().read_to_string(&mut log).unwrap();
        assert_eq!(log.contains("connected"), logged, "{filter}: {log}");
    }
    let output = ads_cnc(&["serve", "--listen", "127.0.0.1:0", "--log", "loud"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("info"));
}

/// Other machines can connect only with an option, which causes a warning.
#[test]
fn other_machines_need_an_option() {
    let mut serve = Serve::logging(&["--listen", "0.0.0.0:0", "--allow-remote"]);
    let port = serve.addr.rsplit_once(':').unwrap().1.to_owned();
    serve.addr = format!("127.0.0.1:{port}");
    drop(works(&serve));
    serve.process.kill().unwrap();
    let mut log = String::new();
    serve.process.stderr.take().unwrap().read_to_string(&mut log).unwrap();
    assert!(log.contains("warning: 0.0.0.0:0 is not a loopback address"), "{log}");
}

/// The error for an invalid option says which values are valid.
#[test]
fn invalid_options_are_rejected_with_advice() {
    let serve = |options: &[&str]| {
        let output = ads_cnc(&[&["serve"], options].concat());
        assert_eq!(text(&output.stdout), "");
        (output.status.code(), text(&output.stderr))
    };
    for (options, advice) in [
        (["--listen", "localhost"], "as 127.0.0.1:48898"),
        (["--listen", "0.0.0.0:0"], "not a loopback address"),
        (["--defect", "no.such.defect"], "serve --list-defects"),
    ] {
        let (code, why) = serve(&options);
        assert!(code == Some(2) && why.contains(advice), "{why}");
    }
    for executed in ["9=x.nc", "x.nc", "1=", "1=/none/x.nc"] {
        assert_eq!(serve(&["--listen", "127.0.0.1:0", "--executed", executed]).0, Some(2));
    }
    // `--print-model` prints the default model, so it is rejected together with a file.
    assert_eq!(serve(&["--print-model", "--model", "mine.toml"]).0, Some(2));
}

#[test]
fn the_net_id_is_an_option() {
    let serve = Serve::start(&["--net-id", "10.0.0.1.1.1"]);
    assert_eq!(serve.net_id, "10.0.0.1.1.1");
}
