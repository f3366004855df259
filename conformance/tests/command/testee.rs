//! Codecs over the testee protocol: this project's codec, with and without a defect, and
//! miniatures: small testees, most of which have one kind of wrong behaviour.

use std::io::{BufRead as _, BufReader};
use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use ads_cnc_conformance::exit::Exit;
use ads_cnc_conformance::faults;
use ads_cnc_conformance::judge::{
    Case, CaseOutcome, CaseSubject, Needs, TESTEE, Verdict, VerdictTally,
};
use ads_cnc_conformance::process::{RunningCommand, shell};
use ads_cnc_conformance::suite;
use ads_cnc_conformance::testee::{
    Answer, CodecTestee, JudgedTestee, JudgementOptions, Miniature, Question, Testee, TesteeHello,
    TesteeProcess, TesteeReaction, judge,
};

const OF_A_TESTEE: JudgementOptions<'static> =
    JudgementOptions { seed: 7, subject: CaseSubject::Testee, edition: None, strict: false };

fn cases() -> Vec<Case> {
    suite::cases().into_iter().filter(|case| case.needs == Needs::Codec).collect()
}

/// Every 25th case, for a testee that must be restarted often.
fn some() -> Vec<Case> {
    let every = cases().into_iter().enumerate().filter(|(place, _)| place % 25 == 0);
    every.map(|(_, case)| case).collect()
}

fn own() -> String {
    format!("\"{}\" testee", env!("CARGO_BIN_EXE_ads-cnc"))
}

/// Time limit of an answer, which is long because a testee on a busy machine answers late.
const WAIT_MAX: Duration = Duration::from_secs(20);

fn process(arguments: &str) -> TesteeProcess {
    within(WAIT_MAX, arguments)
}

fn within(timeout: Duration, arguments: &str) -> TesteeProcess {
    TesteeProcess::new(format!("{} {arguments}", own()), timeout)
}

fn failed(outcomes: &[CaseOutcome]) -> Vec<&str> {
    let mut failed: Vec<&str> = outcomes
        .iter()
        .flat_map(|outcome| &outcome.verdicts)
        .filter(|one| matches!(one.verdict, Verdict::Fail | Verdict::Vacuous))
        .map(|one| one.requirement)
        .collect();
    failed.sort_unstable();
    failed.dedup();
    failed
}

fn exit(judged: &JudgedTestee) -> Exit {
    VerdictTally::of(judged.outcomes.iter().flat_map(|one| &one.verdicts).map(|one| one.verdict))
        .exit()
}

/// The report contains the time at which the run began, not the time at which it was written.
#[cfg(unix)]
#[test]
fn the_time_of_a_report_is_that_of_the_begin() {
    use crate::common::ads_cnc;
    use ads_cnc_conformance::text::Moment;

    let before = Moment::now();
    let command = format!("sleep 4; {}", own());
    let args = ["run", "--testee", &command, "--timeout", "20000", "--only", "VAR-11"];
    let output = ads_cnc(&[&args[..], &["--json", "-"]].concat());
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let time = Moment::from_rfc3339(report["time"].as_str().unwrap()).unwrap();
    assert!(before <= time && time < before.after(Duration::from_secs(4)), "{}", report["time"]);
    assert!(Moment::now() >= before.after(Duration::from_secs(4)));
}

#[test]
fn this_codec_passes_over_pipes_and_in_process() {
    let mut over_pipes = process("");
    let piped = judge(&mut over_pipes, cases(), OF_A_TESTEE);
    let mut own = CodecTestee::default();
    let direct = judge(&mut own, cases(), OF_A_TESTEE);
    assert_eq!(exit(&piped), Exit::Success, "{:?}", failed(&piped.outcomes));
    assert_eq!(piped.asked, direct.asked);
    assert!(piped.asked > 1800, "{}", piped.asked);
    assert_eq!((piped.restarts, over_pipes.starts), (0, 1));
    let verdicts = |judged: &JudgedTestee| -> Vec<(String, Verdict)> {
        judged.outcomes.iter().map(|one| (one.case.id.clone(), one.verdict())).collect()
    };
    assert_eq!(verdicts(&piped), verdicts(&direct));
    assert!(verdicts(&piped).iter().all(|(_, verdict)| *verdict == Verdict::Pass));
}

#[test]
fn the_seed_determines_only_the_order() {
    let with = |seed| {
        let mut own = CodecTestee::default();
        let judged = judge(&mut own, cases(), JudgementOptions { seed, ..OF_A_TESTEE });
        judged.outcomes.iter().map(|one| one.verdict()).collect::<Vec<_>>()
    };
    assert_eq!(with(1), with(2));
}

/// With each miniature that misbehaves, the requirement of the protocol or other requirements fail.
#[test]
fn miniatures_fail() {
    for miniature in Miniature::ALL {
        // With these two miniatures, the run waits for the time limit, so it is short.
        let timeout = match miniature {
            Miniature::Hangs => Duration::from_secs(1),
            Miniature::IgnoresBye => Duration::from_secs(5),
            _ => WAIT_MAX,
        };
        let mut process = within(timeout, &format!("--miniature {}", miniature.name()));
        let judged = judge(&mut process, some(), OF_A_TESTEE);
        let failed = failed(&judged.outcomes);
        let expected = if miniature.is_right() { Exit::Success } else { Exit::Failure };
        assert_eq!(exit(&judged), expected, "{}: {failed:?}", miniature.name());
        let by_manners = matches!(
            miniature,
            Miniature::AcceptsUnknown
                | Miniature::RejectsLater
                | Miniature::IgnoresBye
                | Miniature::NotJson
                | Miniature::WrongNumbers
        );
        if by_manners {
            assert!(failed.contains(&TESTEE), "{}: {failed:?}", miniature.name());
        }
        if miniature == Miniature::IgnoresBye {
            assert_eq!(failed, [TESTEE]);
        }
        match miniature {
            Miniature::Hangs => assert!(judged.restarts > 1),
            Miniature::Crashes => assert!(judged.restarts > 3),
            Miniature::WrongNumbers => assert!(process.starts > 3),
            _ => assert_eq!(process.starts, 1, "{}", miniature.name()),
        }
        if miniature == Miniature::Noisy {
            assert!(process.stderr().len() > 10_000);
        }
    }
}

/// The output of a run against a codec with a defect of the size in descriptions.
fn with_wrong_size(args: &[&str]) -> String {
    let testee = format!("{} --defect variable-description.size.flip", own());
    let mut run = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
    run.args(["run", "--testee", &testee]).args(args);
    String::from_utf8(run.output().unwrap().stdout).unwrap()
}

/// The output of a failure states the expected and the found value, and marks the bytes of the
/// wrong field.
#[test]
fn a_wrong_field_is_marked() {
    let stdout = with_wrong_size(&["--only", "VAR-8", "--seed", "1"]);
    assert!(
        stdout.contains("vec-description-one-dimension: size: 4 is expected, not 5\n"),
        "{stdout}"
    );
    assert!(stdout.contains("\n    !   12  04 00 00 00 "), "{stdout}");
}

/// A wrong field is a failure even if the vector assumes something about another field. Each vector that
/// fails as a consequence is listed once.
#[test]
fn an_assumption_about_another_field_excuses_nothing() {
    let shown = with_wrong_size(&["--only", "variable-description", "-v"]);
    assert!(!shown.contains("\nDIFFERS"), "{shown}");
    let (_, followers) = shown.split_once("  follows from it: ").unwrap();
    let (followers, _) = followers.split_once("again: ").unwrap();
    for id in ["vec-description-cp1252-name", "vec-description-unknown-codes"] {
        assert_eq!(followers.matches(&format!("{id} (")).count(), 1, "{id}: {shown}");
    }
}

/// An answer that differs only in a field about which the vector assumes something is a difference.
#[test]
fn an_assumption_about_a_field_excuses_the_field() {
    for (id, vector) in [
        ("variable-description.name.flip", "vec-description-cp1252-name"),
        ("variable-description.type.flip", "vec-description-limits-low"),
    ] {
        let mut own = CodecTestee { defect: faults::by_id(id).cloned() };
        let judged = judge(&mut own, cases(), OF_A_TESTEE);
        let outcome = judged.outcomes.iter().find(|one| one.case.id == vector).unwrap();
        assert_eq!(outcome.verdict(), Verdict::Differs, "{id}: {outcome:?}");
    }
}

#[test]
fn a_rejection_for_another_reason_is_vacuous() {
    let is_cut = |case: &Case| case.title.contains("truncated");
    let cut: Vec<Case> = cases().into_iter().filter(is_cut).take(20).collect();
    assert!(cut.len() > 10);
    let mut process = process("--miniature rejects-all");
    let judged = judge(&mut process, cut, OF_A_TESTEE);
    for outcome in judged.outcomes.iter().filter(|outcome| is_cut(&outcome.case)) {
        assert!(
            matches!(outcome.verdict(), Verdict::Vacuous | Verdict::Warning | Verdict::Differs),
            "{}: {}",
            outcome.case.id,
            outcome.verdict()
        );
    }
}

#[test]
fn unclaimed_operations_are_not_applicable() {
    let mut process = process("--miniature decodes-only");
    let judged = judge(&mut process, cases(), OF_A_TESTEE);
    let of = |id: &str| judged.outcomes.iter().find(|one| one.case.id == id).unwrap();
    assert_eq!(of("vec-handle-printed").verdict(), Verdict::Pass);
    assert_eq!(of("vec-handle-printed").checks, 1);
    let text = judged.outcomes.iter().find(|one| one.case.id.starts_with("seq-")).unwrap();
    assert_eq!(text.verdict(), Verdict::NotApplicable);
}

#[test]
fn a_wrong_field_fails_its_requirement() {
    for (id, requirement) in [
        ("variable-description.size.flip", "VAR-8"),
        ("variable-handle-read.indices.swap", "VAR-11"),
        ("object-descriptor.index_offset.swap", "COM-5"),
        ("ams-header.invoke_id.swap", "ADS-5"),
        ("dynamic-value.value.swap", "GEN-1"),
    ] {
        let mut own = CodecTestee { defect: faults::by_id(id).cloned() };
        let judged = judge(&mut own, cases(), OF_A_TESTEE);
        assert!(failed(&judged.outcomes).contains(&requirement), "{id}");
    }
}

#[test]
fn a_failed_start_fails_only_the_protocol() {
    for command in ["ads-cnc-no-such-command", "exit 3"] {
        let mut process = TesteeProcess::new(command, Duration::from_millis(500));
        assert!(process.hello().is_err());
        let judged = judge(&mut process, some(), OF_A_TESTEE);
        assert_eq!(failed(&judged.outcomes), [TESTEE]);
        assert!(judged.hello.is_none());
        let fault = &judged.outcomes.last().unwrap().verdicts[0].judgements[0];
        assert!(fault.found.contains("crash"), "{}", fault.found);
    }
}

#[allow(clippy::disallowed_methods, reason = "to a listener of the test")]
/// If a shell starts `ads-cnc serve` as a child process, ending the command also ends this process.
#[test]
fn a_command_ends_with_the_processes_it_started() {
    let mut command = shell(&format!(
        "\"{}\" serve --listen 127.0.0.1:0 && exit 0",
        env!("CARGO_BIN_EXE_ads-cnc")
    ));
    command.stdin(Stdio::null()).stdout(Stdio::piped());
    let running = RunningCommand::start(command).unwrap();
    let mut line = String::new();
    BufReader::new(running.take_stdout().unwrap()).read_line(&mut line).unwrap();
    let addr = line.strip_prefix("listening on ").unwrap().split(',').next().unwrap();
    drop(crate::common::connect(addr.parse().unwrap()));
    drop(running);
    let begun = Instant::now();
    while TcpStream::connect(addr).is_ok() {
        assert!(begun.elapsed() < Duration::from_secs(20), "the simulated CNC still listens");
    }
}

/// A command that has left its process group is ended, too.
#[cfg(unix)]
#[test]
fn a_command_that_left_its_group_is_ended() {
    let leave = "setpgrp(0, getpgrp(getppid())) or die; $| = 1; print \"$$\\n\"; sleep 60";
    let mut command = shell(&format!("exec perl -e '{leave}'"));
    command.stdin(Stdio::null()).stdout(Stdio::piped());
    let running = RunningCommand::start(command).unwrap();
    let mut id = String::new();
    BufReader::new(running.take_stdout().unwrap()).read_line(&mut id).unwrap();
    assert!(running.try_wait().unwrap().is_none());
    let begun = Instant::now();
    drop(running);
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
    let found = Command::new("kill").args(["-0", id.trim()]).stderr(Stdio::null()).status();
    assert!(!found.unwrap().success(), "the process {id} still runs");
}

/// This project's codec, whose rejections contain the number of the question, and which is still
/// running when the deadline ends the wait after `bye`.
#[derive(Default)]
struct Counting {
    codec: CodecTestee,
    asked: usize,
    is_over: bool,
}

impl Testee for Counting {
    fn hello(&mut self) -> Result<TesteeHello, TesteeReaction> {
        Testee::hello(&mut self.codec)
    }

    fn ask(&mut self, question: &Question) -> TesteeReaction {
        self.asked += 1;
        let mut reaction = self.codec.ask(question);
        if let TesteeReaction::Answer(Answer::Reject(reject)) = &mut reaction {
            reject.message = Some(self.asked.to_string());
        }
        reaction
    }

    fn bye(&mut self) -> Result<(), String> {
        self.is_over = true;
        Err("it did not end after bye".to_owned())
    }

    fn over(&self) -> Option<String> {
        self.is_over.then(|| "the deadline has passed".to_owned())
    }
}

/// The message of a rejection may change during the run, and a missing exit is not judged if the
/// deadline has ended the wait for it.
#[test]
fn messages_and_an_exit_after_the_deadline_are_not_judged() {
    let mut testee = Counting::default();
    let judged = judge(&mut testee, some(), OF_A_TESTEE);
    assert!(testee.is_over);
    assert_eq!(exit(&judged), Exit::Success, "{:?}", judged.outcomes.last());
}

/// Tests with testees that are one line of shell.
#[cfg(unix)]
mod shell {
    use std::time::Duration;

    use ads_cnc_conformance::testee::{
        Answer, Output, Question, Testee as _, TesteeProcess, TesteeReaction, check_protocol,
    };

    use super::WAIT_MAX;
    use crate::common::ads_cnc;

    /// A testee in shell that claims these ops and answers each case with this line.
    fn shell(ops: &str, line: &str) -> TesteeProcess {
        let testee = r#""testee":{"name":"sh"}"#;
        let hello =
            format!(r#"{{"protocol":1,{testee},"capabilities":{{"ops":[{ops}],"streams":[]}}}}"#);
        let command =
            format!("read l; printf '%s\\n' '{hello}'; while read l; do printf '{line}\\n'; done");
        TesteeProcess::new(command, WAIT_MAX)
    }

    /// The reaction to this line as the answer to the first case, whose number is 1.
    fn says(line: &str) -> TesteeReaction {
        shell("", line).ask(&Question::new("decode", "object-count", "en-1.05"))
    }

    /// The output of the protocol check contains the lines of an adapter, escaped for a terminal.
    #[test]
    fn the_protocol_check_escapes_lines() {
        let findings = check_protocol(&mut shell(r#""\u001b[2J\u0007""#, "\\033[31m"));
        let all = format!("{findings:#?}");
        // After a hello with an unknown op, the check ends.
        assert_eq!(findings.len(), 1, "{all}");
        let shown = |text: &Option<String>| text.clone().unwrap_or_default();
        for finding in &findings {
            let text = [&finding.fault, &finding.received].map(shown).concat();
            assert!(!text.contains(char::is_control), "{all}");
        }
        assert!(findings.iter().any(|one| shown(&one.fault).contains(r"\u{1b}[2J\u{7}")), "{all}");
    }

    /// An answer must have exactly one of the four forms, and must be text.
    #[test]
    fn an_answer_has_exactly_one_form() {
        assert!(matches!(says(r#"{"seq":1,"reject":{"class":"x"}}"#), TesteeReaction::Answer(_)));
        for (line, why) in [
            (
                r#"{"seq":1,"ok":{"hex":""},"reject":{"class":"x"}}"#,
                "the answer has both ok and reject",
            ),
            (
                r#"{"seq":1,"reject":{},"error":{"message":"x"}}"#,
                "the answer has both reject and error",
            ),
            (r#"{"seq":1,"error":{"message":"x"},"ok":{}}"#, "the answer has both ok and error"),
            (
                r#"{"seq":1,"unsupported":{"what":"op"},"ok":{}}"#,
                "the answer has both ok and unsupported",
            ),
            (r#"{"seq":1,"ok":{},"reject":null}"#, "null"),
            (r#"{"seq":1,"reject":{},"reject":{}}"#, "the key reject appears twice"),
            (r#"{"seq":1}"#, "the answer has none of ok, reject, unsupported and error"),
            (r#"{"seq":1,"reject":{"class":"\377\376"}}"#, "not UTF-8 at byte 28"),
        ] {
            let TesteeReaction::Garbled(found) = says(line) else { panic!("{line}") };
            assert!(found.contains(why), "{line}: {found}");
        }
    }

    /// The bytes of an answer to `encode` are judged even if the answer also has a value.
    #[test]
    fn members_of_other_ops_are_ignored() {
        let line = r#"{"seq":1,"ok":{"hex":"01","value":{},"packets":[]}}"#;
        for (op, expected) in [
            ("encode", Output { hex: Some(vec![1]), ..Output::default() }),
            ("decode", Output { value: Some(serde_json::json!({})), ..Output::default() }),
        ] {
            let answer = shell("", line).ask(&Question::new(op, "object-count", "en-1.05"));
            assert_eq!(answer, TesteeReaction::Answer(Answer::Ok(expected)));
        }
    }

    /// The message about a crash quotes only the stderr of the process that crashed.
    #[test]
    fn a_crash_quotes_its_own_stderr() {
        let file = crate::common::file::TestFile::new(".started", b"");
        let command = format!("test -e {0} && rm {0} && echo first >&2; exit 3", file.path());
        let mut testee = TesteeProcess::new(command, WAIT_MAX);
        let mut crash = || match testee.hello() {
            Err(TesteeReaction::Died(how)) => how,
            other => panic!("{other:?}"),
        };
        assert!(crash().contains("first"));
        assert!(!crash().contains("first"));
        assert!(testee.stderr().contains("first"));
    }

    /// The protocol check ends at the deadline, and tests `bye` even if the testee has crashed at the
    /// last question.
    #[test]
    fn the_protocol_check_has_a_deadline_and_tests_bye() {
        let check = ["run", "--testee", "sleep 60", "--check-protocol", "--deadline", "1"];
        let output = ads_cnc(&check);
        let shown = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(3), "{shown}");
        assert!(shown.contains("Not all steps were checked: the deadline of 1 s"), "{shown}");

        let hello = r#"{"protocol":1,"testee":{"name":"sh"},"capabilities":{"ops":["decode"],"streams":[]}}"#;
        let command = format!("read l; echo '{hello}'; read l; exit 7");
        let findings = check_protocol(&mut TesteeProcess::new(command, Duration::from_secs(20)));
        let bye = findings.last().unwrap().fault.clone().unwrap();
        assert!(bye.contains("exit status: 7 after bye"), "{bye}");
    }

    /// Lines in addition to the answers are reported, even after the last answer.
    #[test]
    fn additional_lines_are_reported() {
        for (line, is_right) in
            [(r#"{"seq":1,"ok":{}}"#, true), (r#"{"seq":1,"ok":{}}\n{"seq":1,"ok":{}}"#, false)]
        {
            let mut testee = shell("", &format!("{line}\\n' ; exit ; printf '"));
            let answer = testee.ask(&Question::new("decode", "object-count", "en-1.05"));
            assert!(matches!(answer, TesteeReaction::Answer(_)), "{answer:?}");
            let bye = testee.bye();
            assert_eq!(bye.is_ok(), is_right, "{bye:?}");
            assert!(is_right || bye.unwrap_err().contains("is not a reply to a request"));
        }
    }
}
