//! Limits of memory and time with hostile peers: the tests run the built command against servers,
//! testees and clients that send wrong, long or endless data, and with large captures. Memory is
//! measured only on Linux.

mod captures;
mod deadline;
mod files;

use std::fs;
use std::io::{Read as _, Write as _};
use std::net::SocketAddr;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::common::connect;
use crate::common::fake::serving;
use crate::common::file::TestFile;
use ads_cnc::Encode as _;
use ads_cnc::ads::{AdsError, AmsHeader, Command as AdsCommand, FrameRef, StateFlags};
use ads_cnc::operation::{Call, Request};
use ads_cnc_conformance::simulator::{Cnc, NET_ID};

/// Maximum peak memory in bytes that a tool may use.
const MEMORY_MAX: u64 = 100 << 20;

/// The result of a tool that has ended.
struct Ended {
    code: Option<i32>,
    stdout: String,
    stderr: String,
    time: Duration,
}

/// Runs the command to its end, and checks that its peak memory is less than `MEMORY_MAX`.
#[track_caller]
fn run(args: &[&str]) -> Ended {
    run_beside(args, |_| ()).0
}

/// Like [`run`], but also calls `beside` while the command runs, with the path of the file that contains
/// the command's stderr.
#[track_caller]
fn run_beside<T>(args: &[&str], beside: impl FnOnce(&Path) -> T) -> (Ended, T) {
    let (out, err) = (TestFile::new(".out", b""), TestFile::new(".err", b""));
    let begun = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_ads-cnc"))
        .args(args)
        .stdin(Stdio::null())
        .stdout(fs::File::create(&out.0).unwrap())
        .stderr(fs::File::create(&err.0).unwrap())
        .spawn()
        .unwrap();
    let id = child.id();
    let watch = thread::spawn(move || {
        let mut most = 0;
        // `peak` returns `None` when the process has ended, even if it is still a zombie.
        while let Some(now) = peak(id) {
            most = now.max(most);
            thread::sleep(Duration::from_millis(2));
        }
        most
    });
    let done = beside(&err.0);
    let until = begun + Duration::from_secs(240);
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if Instant::now() > until {
            child.kill().unwrap();
            panic!("{args:?} did not end; stderr: {}", fs::read_to_string(&err.0).unwrap());
        }
        thread::sleep(Duration::from_millis(5));
    };
    let (time, most) = (begun.elapsed(), watch.join().unwrap());
    eprintln!("{} MiB, {} ms: {args:?}", most >> 20, time.as_millis());
    assert!(most < MEMORY_MAX, "{} MiB: {args:?}", most >> 20);
    let read = |file: &TestFile| String::from_utf8_lossy(&fs::read(&file.0).unwrap()).into_owned();
    (Ended { code: status.code(), stdout: read(&out), stderr: read(&err), time }, done)
}

/// The peak memory of a process in bytes; `None` if the process has ended.
#[cfg(target_os = "linux")]
fn peak(id: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix(" kB")?.trim().parse::<u64>().unwrap() << 10)
}

/// On other systems, only the end and the output of the tools are checked.
#[cfg(not(target_os = "linux"))]
fn peak(_: u32) -> Option<u64> {
    None
}

/// The frame with which the simulated CNC replies to a request.
fn right(cnc: &Cnc, frame: &FrameRef<'_>) -> Vec<u8> {
    let mut answer = Vec::new();
    cnc.respond(NET_ID, frame, &mut answer);
    answer
}

/// A response frame to the sender of this frame, with an invoke ID that it did not use.
fn stray(frame: &FrameRef<'_>) -> Vec<u8> {
    let header = frame.header();
    let header = AmsHeader { invoke_id: header.invoke_id ^ 0x8000_0000, ..header.response() };
    FrameRef::new(header, &[0; 8]).unwrap().encode_to_vec().unwrap()
}

/// A successful reply with this data, in the form of the service of the request.
fn success(frame: &FrameRef<'_>, data: &[u8]) -> Vec<u8> {
    let mut payload = vec![0; 4];
    if frame.header().command != AdsCommand::WRITE {
        payload.extend(u32::try_from(data.len()).unwrap().to_le_bytes());
        payload.extend(data);
    }
    FrameRef::new(frame.header().response(), &payload).unwrap().encode_to_vec().unwrap()
}

fn rejection(frame: &FrameRef<'_>) -> Vec<u8> {
    let data = ads_cnc::ads::WriteReply { result: AdsError(1793) }.encode_to_vec().unwrap();
    FrameRef::new(frame.header().response(), &data).unwrap().encode_to_vec().unwrap()
}

fn against<'a>(addr: &'a str, args: &[&'a str]) -> Vec<&'a str> {
    [args, &["--target", addr, "--net-id", "127.0.0.1.1.1"]].concat()
}

#[test]
fn unsolicited_frames_without_end() {
    let addr = serving(|frame, out| {
        let strays = stray(frame).repeat(1000);
        loop {
            out.write_all(&strays)?;
        }
    });
    let addr = addr.to_string();
    let begun = Instant::now();
    let ended = run(&against(&addr, &["get", "V.E.Testvar", "--timeout", "60000"]));
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    assert!(ended.stderr.contains("a reply to invoke ID"), "{}", ended.stderr);
    assert!(begun.elapsed().as_secs() < 30, "{}", ended.stderr);
    for tool in [&["browse"][..], &["browse", "--variables"], &["run"]] {
        let ended = run(&against(&addr, tool));
        assert_eq!(ended.code, Some(1), "{tool:?}: {}", ended.stderr);
    }
}

#[test]
fn unsolicited_frames_before_every_reply_of_a_run() {
    let cnc = Cnc::with_default_model().unwrap();
    let addr = serving(move |frame, out| {
        out.write_all(&stray(frame).repeat(300))?;
        out.write_all(&right(&cnc, frame))
    });
    let addr = addr.to_string();
    let ended = run(&against(&addr, &["run", "--seed", "1"]));
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    assert!(ended.stdout.contains("a reply to invoke ID"), "{}", ended.stdout);
}

/// A run against a device that sends wrong or incomplete AMS/TCP frames from the first on fails
/// with exit code 1, not 3 as for a device that sends nothing.
#[test]
fn broken_frames_from_the_first_one_on() {
    let whole = |frame: &FrameRef<'_>| frame.encode_to_vec().unwrap();
    let of_reply = |frame: &FrameRef<'_>, len| success(frame, &[0; 8])[..len].to_vec();
    type Reply = Box<dyn Fn(&FrameRef<'_>) -> Vec<u8> + Send + Sync>;
    let replies: [(&str, Reply); 3] = [
        ("state flags 0x0004", Box::new(whole)),
        ("6 bytes of a frame of 54 bytes", Box::new(move |frame| of_reply(frame, 6))),
        ("20 bytes of a frame of 54 bytes", Box::new(move |frame| of_reply(frame, 20))),
    ];
    for (what, reply) in replies {
        let addr = serving(move |frame, out| out.write_all(&reply(frame))).to_string();
        let ended = run(&against(&addr, &["run", "--seed", "1", "--timeout", "100"]));
        assert_eq!(ended.code, Some(1), "{what}: {}", ended.stderr);
        assert!(ended.stdout.contains(what), "{what}: {}", ended.stdout);
        assert!(ended.stdout.contains("ADS-5)"), "{what}: {}", ended.stdout);
    }
}

/// A reply with an invoke ID that the tool never sent is judged at once, without waiting for another
/// reply.
#[test]
fn errors_with_another_invoke_id_and_port() {
    let cnc = Cnc::with_default_model().unwrap();
    let addr = serving(move |frame, out| {
        let mut reply = right(&cnc, frame);
        if reply[FrameRef::HEADERS_LEN..][..4] != [0; 4] {
            reply[20] ^= 1;
            reply[34..38].fill(0);
        }
        out.write_all(&reply)
    });
    let addr = addr.to_string();
    let ended = run(&against(&addr, &["run", "--seed", "1"]));
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    assert!(ended.stdout.contains(" 1 fail (ADS-5)"), "{}", ended.stdout);
    assert!(ended.time.as_secs() < 30, "{:?}", ended.time);
}

#[test]
fn replies_of_a_megabyte_with_wrong_flags_and_addresses() {
    let data = vec![0x41; 1 << 20];
    let addr = serving(move |frame, out| {
        let right = frame.header().response();
        let header = AmsHeader {
            state_flags: StateFlags(0x0405),
            target: right.source,
            source: right.target,
            ..right
        };
        let answer = success(frame, &data);
        let payload = &answer[FrameRef::HEADERS_LEN..];
        out.write_all(&FrameRef::new(header, payload).unwrap().encode_to_vec().unwrap())
    });
    let addr = addr.to_string();
    let (json, html) = (TestFile::new(".json", b""), TestFile::new(".html", b""));
    let args = ["run", "--seed", "1", "--json", json.path(), "--html", html.path()];
    let ended = run(&against(&addr, &args));
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    let report = fs::read_to_string(&json.0).unwrap();
    assert!(report.len() < 64 << 20, "{}", report.len());
    assert!(report.contains("the first 4096 of "), "nothing says that evidence is cut");
}

/// Starts a device that has every item that is requested, without end.
fn everything() -> SocketAddr {
    const DESCRIPTION: &[u8] = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0";
    serving(|frame, out| {
        let Ok(Some(call)) = Call::from_frame(frame) else {
            return out.write_all(&rejection(frame));
        };
        let number = frame.header().invoke_id;
        let data = match call.dispatch() {
            Ok(
                Request::CountObjects(_) | Request::CountVariables(_) | Request::CountDynamic(_),
            ) => u32::MAX.to_le_bytes().to_vec(),
            Ok(Request::DescribeByIndex(_)) => {
                [DESCRIPTION, format!("V.E.{number:0>240}\0").as_bytes()].concat()
            }
            Ok(Request::DynamicNameByIndex(_)) => format!("P{number:0>80}\0").into_bytes(),
            Ok(Request::ReadDescriptors(_)) => {
                let one = |place: u32| {
                    let mut one = [b'x'; 84];
                    one[12..16].copy_from_slice(&number.to_le_bytes());
                    one[16..20].copy_from_slice(&place.to_le_bytes());
                    one
                };
                (0..call.read_length / 84).flat_map(one).collect()
            }
            _ => return out.write_all(&rejection(frame)),
        };
        out.write_all(&success(frame, &data))
    })
}

#[test]
fn a_device_on_which_everything_exists() {
    let addr = everything().to_string();
    for tool in [&["browse"][..], &["browse", "--variables"], &["browse", "--format", "json"]] {
        let ended = run(&against(&addr, tool));
        assert_eq!(ended.code, Some(3), "{tool:?}: {}", ended.stderr);
        let (why, least) = match tool.contains(&"--variables") {
            true => ("the limit is 8 MiB of names", 30_000),
            false => ("the limit is 100000 objects", 100_000),
        };
        let why = format!("the list is incomplete: {why}");
        assert!(ended.stderr.contains(&why), "{tool:?}: {}", ended.stderr);
        assert!(ended.stdout.lines().count() > least, "{tool:?}");
    }
    // No name matches the filter, so the tool requests items until the deadline.
    let ended =
        run(&against(&addr, &["browse", "--variables", "--filter", "no", "--deadline", "3"]));
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stderr.contains("the deadline of 3 s has passed"), "{}", ended.stderr);
    let ended = run(&against(&addr, &["get", "no_such_object", "--deadline", "3"]));
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stderr.contains("the deadline of 3 s has passed"), "{}", ended.stderr);
    let ended = run(&against(&addr, &["run", "--seed", "1", "--deadline", "6"]));
    assert!(matches!(ended.code, Some(1 | 3)), "{}", ended.stderr);
}

/// A device with 1500 arrays of 2000 BOOLEAN, three of which have 480 dimensions. As JSON, an element
/// needs much more memory than its byte.
#[test]
fn values_that_are_much_longer_as_json() {
    let addr = serving(|frame, out| {
        let Ok(Some(call)) = Call::from_frame(frame) else {
            return out.write_all(&rejection(frame));
        };
        let words = |words: &[u32]| -> Vec<u8> {
            words.iter().flat_map(|word| word.to_le_bytes()).collect()
        };
        let data = match call.dispatch() {
            Ok(Request::CountObjects(_)) => words(&[1]),
            Ok(Request::CountVariables(_)) => words(&[500]),
            Ok(Request::DescribeByIndex(op)) => {
                let mut dimensions = vec![1; if op.index == 0 { 480 } else { 1 }];
                dimensions[0] = 2000;
                let count = u32::try_from(dimensions.len()).unwrap();
                let name = format!("V.E.array_{}\0", op.index);
                let head = words(&[op.index, 1, 1, 2000, count]);
                [head, words(&dimensions), name.into_bytes()].concat()
            }
            Ok(Request::ReadByName(_)) => vec![1; 2000],
            _ => return out.write_all(&rejection(frame)),
        };
        out.write_all(&success(frame, &data))
    });
    let addr = addr.to_string();
    let args = ["browse", "--variables", "--channel", "1", "--content", "--json"];
    let ended = run(&against(&addr, &args));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let error = "the value has 480 dimensions; a value in JSON has at most 16";
    assert_eq!(ended.stdout.matches(error).count(), 3);
    assert!(ended.stdout.len() < 80 << 20, "{}", ended.stdout.len());
}

#[test]
fn a_value_of_2_mib_is_not_formatted() {
    const NAME: &str = "mc_active_single_block_r";
    const SIZE: u32 = 2 << 20;
    let cnc = Cnc::with_default_model().unwrap();
    let addr = serving(move |frame, out| {
        let call = Call::from_frame(frame).ok().flatten();
        if call.is_some_and(|call| call.read_length == SIZE) {
            return out.write_all(&success(frame, &vec![1; SIZE as usize]));
        }
        // In a descriptor, the size is 16 bytes before the name.
        let mut reply = right(&cnc, frame);
        if let Some(at) = reply.windows(NAME.len()).position(|part| part == NAME.as_bytes()) {
            reply[at - 16..at - 12].copy_from_slice(&SIZE.to_le_bytes());
        }
        out.write_all(&reply)
    });
    let addr = addr.to_string();
    let get = ["get", NAME, "--of", "COM channel 1"];
    for format in ["--plain", "--json"] {
        let ended = run(&against(&addr, &[&get[..], &[format]].concat()));
        assert_eq!(ended.code, Some(1), "{}", ended.stderr);
        let why = "has 2097152 bytes, and values are formatted only up to 1048576 bytes";
        assert!(ended.stderr.contains(why), "{}", ended.stderr);
    }
    let ended = run(&against(&addr, &[&get[..], &["--hex"]].concat()));
    assert_eq!((ended.code, ended.stdout.len()), (Some(0), 3 << 21), "{}", ended.stderr);
}

/// Testees that send very long answers.
#[cfg(unix)]
#[test]
fn a_testee_with_long_answers() {
    const HELLO: &str = r#"{"protocol":1,"testee":{"name":"much"},"capabilities":{"ops":["decode","encode"],"streams":["variable-description","variable-value","variable-name-write"],"editions":["en-1.05"]}}"#;
    for (bytes, of, answer) in [
        (250_000, "a", r#"{"seq":%s,"error":{"message":"%s"}}"#),
        (120_000, "a", r#"{"seq":%s,"reject":{"class":"%s","message":"%s"}}"#),
        (250_000, "a", r#"{"seq":%s,"ok":{"value":"%s"}}"#),
        (300_000, "a", r#"{"seq":%s,"error":{"message":"%s"}}"#),
        // JSON that occupies much memory per byte when it is parsed.
        (4000, r#"{"a":1},"#, r#"{"seq":%s,"ok":{"value":[%s0]}}"#),
        (500, r#"{"a":1},"#, r#"{"seq":%s,"ok":{"value":[%s0]}}"#),
    ] {
        let script = format!(
            "#!/bin/sh\nlong=$(head -c {bytes} /dev/zero | sed 's/\\x00/{of}/g')\nread -r hello\n\
             echo '{HELLO}'\nwhile read -r line; do\n\
             seq=${{line#*\\\"seq\\\":}}; seq=${{seq%%,*}}\n\
             case $line in *bye*) exit 0;; esac\n\
             printf '{answer}\\n' \"$seq\" \"$long\" \"$long\"\ndone\n"
        );
        let script = match answer.matches("%s").count() {
            2 => script.replace("\"$long\" \"$long\"", "\"$long\""),
            _ => script,
        };
        let (script, json) = (TestFile::new(".sh", script.as_bytes()), TestFile::new(".json", b""));
        let testee = format!("sh {}", script.path());
        let ended = run(&[
            "run",
            "--testee",
            &testee,
            "--only",
            "VAR",
            "--seed",
            "1",
            "--json",
            json.path(),
        ]);
        assert_eq!(ended.code, Some(1), "{}{}", ended.stdout, ended.stderr);
        assert!(ended.stdout.lines().all(|line| line.len() < 5000));
        assert!(fs::metadata(&json.0).unwrap().len() < 64 << 20);
    }
}

/// The address on which the tool listens; `None` until the tool has printed it.
fn listens_on(stderr: &str) -> Option<SocketAddr> {
    let (addr, _) = stderr.split_once("waiting for a client on ")?.1.split_once(',')?;
    addr.parse().ok()
}

/// A client that sends 5,000 requests of 60 kB, and opens more connections than the limit.
#[test]
fn a_client_without_end() {
    let long = {
        let mut header = AmsHeader::request(
            ads_cnc::ads::AmsAddr { net_id: NET_ID, port: ads_cnc::ads::AmsPort::SDA },
            ads_cnc::ads::AmsAddr { net_id: NET_ID, port: ads_cnc::ads::AmsPort(0x8000) },
            AdsCommand::WRITE,
            1,
        );
        header.invoke_id = 1;
        let mut payload = vec![0; 12];
        payload[8..].copy_from_slice(&60_000_u32.to_le_bytes());
        payload.extend(vec![7; 60_000]);
        FrameRef::new(header, &payload).unwrap().encode_to_vec().unwrap()
    };
    let args = ["run", "--client-listen", "127.0.0.1:0", "--seed", "1"];
    let (ended, ()) = run_beside(&args, |stderr| {
        let addr = (0..400).find_map(|_| {
            thread::sleep(Duration::from_millis(50));
            listens_on(&fs::read_to_string(stderr).unwrap())
        });
        let addr = addr.expect("the tool listens");
        let mut first = connect(addr);
        first.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        let mut answer = [0; 42];
        for number in 0..5000_u32 {
            let mut request = long.clone();
            request[34..38].copy_from_slice(&number.to_le_bytes());
            first.write_all(&request).unwrap();
            first.read_exact(&mut answer).unwrap();
        }
        let more: Vec<_> = (0..80).map(|_| connect(addr)).collect();
        thread::sleep(Duration::from_millis(300));
        drop(more);
    });
    let said = format!("{}{}", ended.stdout, ended.stderr);
    assert!(said.contains("closed at once: 17 connections while 64 were open"), "{said}");
    assert!(said.contains("5000"), "{said}");
    assert!(matches!(ended.code, Some(1 | 3)), "{said}");
}

#[test]
fn clients_are_awaited_on_loopback_only() {
    let ended = run(&["run", "--client-listen", "0.0.0.0:0"]);
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.contains("--allow-remote"), "{}", ended.stderr);
}
