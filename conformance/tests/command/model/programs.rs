//! Tests of the keys of a model that control the NC programs of a channel: streaming, and the requests that
//! a program sends to services.

use ads_cnc::streaming::ProgramEnd;
use ads_cnc_conformance::simulator::program::{ProgramState, ScriptState, ServiceOutcome};
use ads_cnc_conformance::simulator::{DEFAULT_MODEL, Model};

use super::timed::Timed;
use super::{CHANNEL_1, Cnc};
use crate::common::file::TestFile;

/// The index offset of data streaming.
const STREAM: u32 = 0x90;

/// Ten lines of ten bytes each.
const LINES: &[u8] = b"N010 G00\r\nN020 G00\r\nN030 G00\r\nN040 G00\r\nN050 G00\r\n\
                       N060 G00\r\nN070 G00\r\nN080 G00\r\nN090 G00\r\nN100 G00\r\n";

fn with_streaming(keys: &str) -> Timed {
    let objects = r#"[{ name = "mc_program_stream_w", type = "STRING", offset = 0x90, size = 4094, writable = true }]"#;
    let channel = format!("[[channel]]\nnumber = 1\nobjects = {objects}\n");
    Timed::new(&format!("{channel}[channel.streaming]\n{keys}\n"))
}

/// The number of executed lines 100 ms after a write of `LINES`, and a second later.
fn lines_run(keys: &str) -> [u64; 2] {
    let cnc = with_streaming(keys);
    assert_eq!(cnc.write_object(STREAM, LINES), Ok(()));
    [100, 1000].map(|time| {
        cnc.pass(time);
        cnc.0.with_program(1, |program| program.executed().line_count()).unwrap()
    })
}

#[test]
fn streaming_has_a_pace() {
    assert_eq!(lines_run(""), [10, 10]);
    assert_eq!(lines_run("pace = 50"), [5, 10]);
    assert_eq!(lines_run("pace = \"5 lines/s\""), [0, 5]);
    assert_eq!(lines_run("pace = \"200 bytes/s\""), [2, 10]);
    assert_eq!(lines_run("pace = \"fast\""), [10, 10]);
    assert_eq!(lines_run("pace = \"hold\""), [0, 0]);
    assert_eq!(lines_run("file = \"\""), [0, 0]);
}

/// Lines that are written after a program end was executed are executed too, or remain in the
/// interface, depending on `start`.
#[test]
fn streaming_starts_as_configured() {
    for (keys, lines, state) in [
        ("pace = \"fast\"", 12, ProgramState::Dry),
        ("pace = \"fast\"\nstart = \"again\"", 12, ProgramState::Dry),
        ("pace = \"fast\"\nstart = \"once\"", 11, ProgramState::Ended(ProgramEnd::M30)),
        ("pace = \"fast\"\nstart = \"by-hand\"", 0, ProgramState::Stopped),
    ] {
        let cnc = with_streaming(keys);
        for packet in [LINES, b"M30\r\n", b"N10 X1\r\n"] {
            assert_eq!(cnc.write_object(STREAM, packet), Ok(()), "{keys}");
            cnc.pass(1);
        }
        let stands =
            cnc.0.with_program(1, |program| (program.executed().line_count(), program.state()));
        assert_eq!(stands, Ok((lines, state)), "{keys}");
    }
    // The message of an error contains the configured name of the program file.
    let cnc = with_streaming("file = \"part.nc\"");
    assert_eq!(cnc.write_object(STREAM, b"N10 X1"), Ok(()));
    let state = cnc.0.with_program(1, |program| program.state()).unwrap();
    let ProgramState::Aborted(message) = state else { panic!("{state:?}") };
    assert!(message.to_string().starts_with("part.nc:1:"), "{message}");
}

const SERVICE: &str = r#"
[[channel]]
number = 1
[channel.service]
times = 2
pause = "2s"
cycle = "10ms"
requests = [
  { uuid = "560AACBF-6335-44a9-895A-8B27F3ED5E47", request = "3" },
  { uuid = "19719079-BA06-4740-BC02-DE5215211751", request = "some-command", state = 7, wait = { P2 = 300, P3 = 1 } },
  { uuid = "19719079-ba06-4740-bc02-de5215211751", request = "no-wait", wait = { P1 = 5 } },
]
"#;

fn text(cnc: &Timed, name: &str) -> String {
    let value = cnc.ask(0x48, format!("V.G.SERVICE.{name}\0").as_bytes()).unwrap();
    String::from_utf8(value).unwrap().trim_end_matches('\0').to_owned()
}

fn number(cnc: &Timed, name: &str) -> u32 {
    let value = cnc.ask(0x48, format!("V.G.SERVICE.{name}\0").as_bytes()).unwrap();
    u32::from_le_bytes(value.try_into().unwrap())
}

fn answer(cnc: &Timed, response: &[u8], state: u32) {
    assert_eq!(cnc.write("V.G.SERVICE.RESPONSE", response), Ok(()));
    assert_eq!(cnc.write("V.G.SERVICE.RESPONSE_STATE", &state.to_le_bytes()), Ok(()));
}

/// The program sends all requests twice, and waits for each response as the request states.
#[test]
fn the_program_sends_the_requests_of_the_model() {
    let cnc = Timed::new(SERVICE);
    // The program begins at the first read: it writes UUID, REQUEST and REQUEST_STATE, one in each
    // cycle.
    assert_eq!(number(&cnc, "REQUEST_STATE"), 0);
    for round in [1, 2] {
        cnc.pass(30);
        assert_eq!(text(&cnc, "UUID"), "560AACBF-6335-44a9-895A-8B27F3ED5E47");
        assert_eq!((text(&cnc, "REQUEST"), number(&cnc, "REQUEST_STATE")), ("3".to_owned(), 1));
        // A request without `wait` has no maximum wait.
        cnc.pass(1_000_000);
        assert_eq!(number(&cnc, "REQUEST_STATE"), 1);
        answer(&cnc, b"1.732051\0", 1);
        cnc.pass(1990);
        assert_eq!(text(&cnc, "REQUEST"), "3");
        cnc.pass(60);
        assert_eq!(text(&cnc, "UUID"), "19719079-BA06-4740-BC02-DE5215211751");
        assert_eq!(text(&cnc, "REQUEST"), "some-command");
        assert_eq!(number(&cnc, "REQUEST_STATE"), 7);
        if round == 2 {
            cnc.pass(200);
            answer(&cnc, b"done\0", 9);
        }
        cnc.pass(2400);
        assert_eq!(text(&cnc, "REQUEST"), "no-wait");
        cnc.pass(1980);
    }
    let answers = cnc.0.with_script(1, |script| {
        let script = script.unwrap();
        let answers = script.answers().map(|answer| match &answer.outcome {
            ServiceOutcome::Response { state, text } => {
                format!("{} {state} {text}", answer.request)
            }
            ServiceOutcome::TimedOut => format!("{} -", answer.request),
        });
        (answers.collect::<Vec<_>>(), script.state())
    });
    let (answers, state) = answers.unwrap();
    // The last request has @P1 = 5, but resets RESPONSE_STATE to 0. Therefore its wait ends at once,
    // and the program reads the text of the previous response.
    let wanted = ["0 1 1.732051", "1 -", "2 0 1.732051", "0 1 1.732051", "1 9 done", "2 0 done"];
    assert_eq!((answers, state), (wanted.map(str::to_owned).to_vec(), ScriptState::Finished));
}

/// Each change makes the model above invalid; the error contains the reason and the line.
#[test]
fn each_fault_is_rejected_with_its_line() {
    let long = format!("request = \"{}\"", "3".repeat(128));
    for (from, to, reason) in [
        ("number = 1", "number = 1 #\n[[channel]]\nnumber = 1", "configured twice"),
        ("times = 2", "times = 0", "expected at least 1"),
        ("times = 2", "time = 2", "the key time is unknown"),
        ("pause = \"2s\"", "pause = \"2\"", "a number with the unit ms, s or min"),
        ("cycle = \"10ms\"", "cycle = \"0s\"", "the minimum is 1ms"),
        ("uuid = \"560AACBF-6335", "uuid = \"560AACBF6335", "service"),
        ("request = \"3\"", "request = \"\u{3A9}\"", "not in CP1252"),
        ("request = \"3\"", &long, "128"),
        ("request = \"3\"", "request = \"3\", state = 0", "0"),
        ("request = \"3\"", "request = \"3\", wait = true", "expected a table"),
        ("request = \"3\" }", "question = \"3\" }", "the key question is unknown"),
        ("wait = { P2 = 300, P3 = 1 }", "wait = { P2 = 300 }", "@P3"),
        ("wait = { P2 = 300, P3 = 1 }", "wait = { p2 = 300 }", "the key p2 is unknown"),
        ("wait = { P1 = 5 }", "wait = { P1 = -1 }", "found the number -1"),
    ] {
        assert_eq!(SERVICE.matches(from).count(), 1, "{from}");
        let at = SERVICE.find(from).unwrap();
        let mut line = SERVICE[..at].matches('\n').count() + 1;
        line += to.find('\n').map_or(0, |_| 2);
        let error = Model::from_toml(&SERVICE.replace(from, to), "m").unwrap_err();
        assert_eq!(error.line(), Some(line), "{to}: {error}");
        assert!(error.reason().contains(reason), "{to}: {error}");
    }
    let empty = "[[channel]]\nnumber = 1\n[channel.service]\nrequests = []\n";
    let error = Model::from_toml(empty, "m").unwrap_err().to_string();
    assert_eq!(error, "m:4: expected at least one request");
    let old = format!("cnc-version = \"V2.11.2029.0\"\n{SERVICE}");
    let error = Model::from_toml(&old, "m").unwrap_err().to_string();
    assert_eq!(error, "m:5: a CNC of this version has no Service Interface");
}

/// The example of an NC program in a comment of the default model is valid TOML, and has its effect.
#[test]
fn the_commented_program_is_one() {
    let lines = DEFAULT_MODEL.lines().skip_while(|line| *line != "#   [channel.service]");
    let lines = lines.map_while(|line| line.strip_prefix("#   "));
    let table = lines.collect::<Vec<_>>().join("\n");
    let cnc = Timed::new(&format!("[[channel]]\nnumber = 1\n{table}"));
    assert_eq!(number(&cnc, "REQUEST_STATE"), 0);
    cnc.pass(10);
    assert_eq!((text(&cnc, "REQUEST"), number(&cnc, "REQUEST_STATE")), ("3".to_owned(), 1));
    answer(&cnc, b"1.732051\0", 1);
    cnc.pass(3000);
    assert_eq!(text(&cnc, "REQUEST"), "some-command");
    // The program waits for this response for at most five seconds, and two more seconds pass until
    // it sends the first request again.
    cnc.pass(3000);
    assert_eq!(text(&cnc, "REQUEST"), "some-command");
    cnc.pass(4000);
    assert_eq!(text(&cnc, "REQUEST"), "3");
}

/// The options `--pace` and `--ask-square-roots` of `serve` override settings of the model.
#[test]
fn options_override_the_model() {
    let objects = r#"objects = [{ name = "s", type = "STRING", offset = 0x90, size = 4094, writable = true }]"#;
    let streaming = "[channel.streaming]\npace = \"hold\"\nstart = \"once\"";
    let model = SERVICE.replace("560AACBF", "00000000");
    let model = model.replace("number = 1\n", &format!("number = 1\n{objects}\n{streaming}\n"));
    let file = TestFile::new(".toml", model.as_bytes());
    for (options, taken, uuid) in [
        (&[][..], 4, b"00000000"),
        (&["--pace", "fast"], 6, b"00000000"),
        (&["--ask-square-roots"], 4, b"560AACBF"),
    ] {
        let cnc = Cnc::start(&[&["--model", file.path()], options].concat());
        let packet = b"N10 X1\r\n".repeat(124);
        let sent = (0..6).take_while(|_| cnc.com().write(0x12_0101, STREAM, &packet).is_ok());
        assert_eq!(sent.count(), taken, "{options:?}");
        // `--pace` does not change `start = "once"`: lines after the program end remain in the
        // interface until it is full.
        if options.contains(&"fast") {
            for packet in [&b"M30\r\n"[..], &packet, &packet, &packet, &packet] {
                assert_eq!(cnc.com().write(0x12_0101, STREAM, packet), Ok(()));
            }
            assert_eq!(cnc.com().write(0x12_0101, STREAM, &packet), Err(0x706));
        }
        let read = || cnc.sda().ask(CHANNEL_1, 0x48, b"V.G.SERVICE.UUID\0").unwrap();
        let mut asked = std::iter::repeat_with(read).take(100_000);
        assert_eq!(asked.find(|asked| asked[0] != 0).unwrap()[..8], *uuid, "{options:?}");
    }
}
