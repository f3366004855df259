//! Codecs that differ from this project's codec. Where they differ only in behaviour that is
//! assumed, recommended or printed in another edition, no case fails.

use ads_cnc_conformance::exit::Exit;
use ads_cnc_conformance::judge::{Body, Case, CaseSubject, Needs, Verdict, VerdictTally};
use ads_cnc_conformance::suite;
use ads_cnc_conformance::testee::{
    Answer, CodecTestee, JudgementOptions, Output, Question, Rejection, Testee, TesteeHello,
    TesteeReaction, judge, questions,
};
use ads_cnc_vectors::{Level, sequence, vector};

/// This project's codec with other answers to some questions.
struct StepError<F>(F);

impl<F: Fn(&CodecTestee, &Question) -> Answer> Testee for StepError<F> {
    fn hello(&mut self) -> Result<TesteeHello, TesteeReaction> {
        Ok(CodecTestee::default().hello())
    }

    fn ask(&mut self, question: &Question) -> TesteeReaction {
        TesteeReaction::Answer((self.0)(&CodecTestee::default(), question))
    }

    fn bye(&mut self) -> Result<(), String> {
        Ok(())
    }
}

fn cases() -> Vec<Case> {
    suite::cases().into_iter().filter(|case| case.needs == Needs::Codec).collect()
}

/// The exit code for this codec, and the cases with a warning or a difference.
fn judged(codec: impl Fn(&CodecTestee, &Question) -> Answer) -> (Exit, Vec<String>) {
    let terms =
        JudgementOptions { seed: 3, subject: CaseSubject::Testee, edition: None, strict: false };
    let outcomes = judge(&mut StepError(codec), cases(), terms).outcomes;
    let verdicts = outcomes.iter().flat_map(|one| &one.verdicts).map(|one| one.verdict);
    let noticed = |verdict| matches!(verdict, Verdict::Warning | Verdict::Differs);
    let other = outcomes.iter().filter(|one| noticed(one.verdict()));
    (VerdictTally::of(verdicts).exit(), other.map(|one| one.case.id.clone()).collect())
}

fn rejected() -> Answer {
    Answer::Reject(Rejection::default())
}

fn accepted() -> Answer {
    Answer::Ok(Output { value: Some(serde_json::json!({})), ..Output::default() })
}

/// The answer to the same question with other bytes.
fn of_bytes(own: &CodecTestee, question: &Question, bytes: Vec<u8>) -> Answer {
    own.answer(&Question { hex: Some(bytes), ..question.clone() })
}

/// The answer of a codec that uses 2 instead of 4 bytes for each number of the stream `of`.
fn of_two_bytes(own: &CodecTestee, question: &Question, of: &str) -> Answer {
    if question.stream != of {
        return own.answer(question);
    }
    match &question.hex {
        Some(bytes) => {
            let wide = bytes.chunks(2).flat_map(|pair| [pair, &[0, 0]].concat()).collect();
            of_bytes(own, question, wide)
        }
        None => match own.answer(question) {
            Answer::Ok(Output { hex: Some(bytes), .. }) => {
                let hex = bytes.chunks(4).flat_map(|number| number[..2].to_vec()).collect();
                Answer::Ok(Output { hex: Some(hex), ..Output::default() })
            }
            answer => answer,
        },
    }
}

/// Checks that no case fails for a codec, and that at least these vectors and sequences have a
/// warning or a difference.
fn assert_differs(codec: impl Fn(&CodecTestee, &Question) -> Answer, expected: &[&str]) {
    let (exit, other) = judged(codec);
    assert_eq!(exit, Exit::Success, "{other:?}");
    for id in expected {
        assert!(other.iter().any(|one| one == id), "{id} is not among {other:?}");
    }
}

#[test]
fn index_0_may_be_decoded() {
    let codec = |own: &CodecTestee, question: &Question| match &question.hex {
        Some(bytes) if question.stream == "dynamic-index" && bytes[..] == [0; 4] => accepted(),
        _ => own.answer(question),
    };
    assert_differs(codec, &["vec-dynamic-index-0"]);
}

#[test]
fn bytes_after_the_nul_of_a_request_may_be_ignored() {
    let codec = |own: &CodecTestee, question: &Question| {
        let (from, most) = match question.stream.as_str() {
            "variable-name" | "variable-kind" => (0, 256),
            "dynamic-name-request" => (0, 96),
            "variable-index-kind" => (4, 260),
            _ => return own.answer(question),
        };
        let Some(bytes) = &question.hex else { return own.answer(question) };
        let nul = bytes.iter().skip(from).position(|byte| *byte == 0);
        let end = nul.map_or(bytes.len(), |at| from + at + 1);
        // A request that exceeds its maximum length is rejected even if the bytes after its NUL are
        // ignored.
        match bytes.len() > most {
            true => own.answer(question),
            false => of_bytes(own, question, bytes[..end].to_vec()),
        }
    };
    assert_differs(
        codec,
        &[
            "vec-name-bytes-behind-nul",
            "vec-axis-name-bytes-behind-nul",
            "vec-kind-bytes-behind-nul",
            "vec-index-kind-bytes-behind-nul",
            "vec-dynamic-name-request-bytes-behind-nul",
        ],
    );
}

#[test]
fn an_extended_description_may_be_longer() {
    let codec = |own: &CodecTestee, question: &Question| match &question.hex {
        Some(bytes) if question.stream == "variable-extended-description" && bytes.len() == 9 => {
            of_bytes(own, question, bytes[..8].to_vec())
        }
        _ => own.answer(question),
    };
    assert_differs(codec, &["vec-extended-trailing"]);
}

/// Both editions print two length fields for a Write; the vendors' help pages have only one.
#[test]
fn a_write_may_have_both_printed_lengths() {
    let codec = |own: &CodecTestee, question: &Question| {
        if question.stream != "write-request" {
            return own.answer(question);
        }
        match &question.hex {
            Some(bytes) if bytes.len() >= 12 => {
                of_bytes(own, question, [&bytes[..8], &bytes[12..]].concat())
            }
            Some(_) => rejected(),
            None => match own.answer(question) {
                Answer::Ok(Output { hex: Some(bytes), .. }) => {
                    let hex = [&bytes[..8], &[0; 4], &bytes[8..]].concat();
                    Answer::Ok(Output { hex: Some(hex), ..Output::default() })
                }
                answer => answer,
            },
        }
    };
    assert_differs(codec, &["vec-write-request-single-block", "vec-write-request-two-lengths"]);
}

#[test]
fn numbers_without_a_printed_width_may_have_another() {
    assert_differs(
        |own, question| of_two_bytes(own, question, "object-count"),
        &["vec-object-count", "vec-object-count-cut"],
    );
    assert_differs(
        |own, question| of_two_bytes(own, question, "element-count"),
        &["vec-element-count"],
    );
    assert_differs(
        |own, question| of_two_bytes(own, question, "object-address-query"),
        &["vec-address-query-printed-hld-channel-1"],
    );
}

#[test]
fn the_largest_index_of_a_name_may_be_accepted() {
    let text = b"4294967295";
    let codec = move |own: &CodecTestee, question: &Question| match &question.hex {
        Some(bytes)
            if question.stream == "variable-path"
                && bytes.windows(text.len()).any(|part| part == text) =>
        {
            accepted()
        }
        _ => own.answer(question),
    };
    assert_differs(codec, &["vec-path-index-too-large"]);
}

/// No case fails for a checker of NC text that gives the opposite answer where the manuals state
/// nothing: for lower-case letters, nested parentheses and quotes, a comment block without an end,
/// a jump to its own line, labels with leading zeros, a last line without a line end, and a CR
/// without LF.
#[test]
fn a_checker_may_know_only_the_manuals_nc_text() {
    const OTHERWISE: [&str; 10] = [
        "loop-lower-case",
        "comment-nested",
        "comment-nested-closed",
        "comment-quoted",
        "comment-block-open",
        "jump-own-line",
        "jump-zeros",
        "jump-zeros-forward",
        "text-open",
        "text-lone-cr",
    ];
    let asked: Vec<Question> = OTHERWISE
        .iter()
        .flat_map(|id| {
            let id = format!("seq-{id}");
            let case = cases().into_iter().find(|case| case.id == id);
            questions(&case.unwrap_or_else(|| panic!("no {id}")), "en-1.05")
        })
        .collect();
    let codec = move |own: &CodecTestee, question: &Question| match asked.contains(question) {
        true => opposite(own.answer(question)),
        false => own.answer(question),
    };
    let expected: Vec<String> = OTHERWISE.iter().map(|id| format!("seq-{id}")).collect();
    assert_differs(codec, &expected.iter().map(String::as_str).collect::<Vec<_>>());
}

fn opposite(answer: Answer) -> Answer {
    match answer {
        Answer::Ok(_) => rejected(),
        Answer::Reject(_) => accepted(),
        other => other,
    }
}

fn level(case: &Case) -> Level {
    match &case.body {
        Body::Vector(one) => one.level(),
        Body::Sequence(one) => one.level(),
        _ => Level::Must,
    }
}

/// If a codec gives the opposite answer wherever the expected answer is only assumed or recommended, no
/// case fails; if it gives the opposite answer to all questions, cases fail.
#[test]
fn the_opposite_of_assumptions_fails_nothing() {
    let of = |levels: &[Level]| -> Vec<Question> {
        let chosen = cases().into_iter().filter(|case| levels.contains(&level(case)));
        chosen.flat_map(|case| questions(&case, "en-1.05")).collect()
    };
    let weaker = of(&[Level::Info, Level::Should]);
    let must = of(&[Level::Must]);
    let asked: Vec<Question> = weaker.into_iter().filter(|one| !must.contains(one)).collect();
    let (exit, other) = judged(move |own, question| match asked.contains(question) {
        true => opposite(own.answer(question)),
        false => own.answer(question),
    });
    // Most of these cases differ. Others are inconclusive, for example because the codec also
    // rejects the valid sibling of a rejected vector.
    assert_eq!(exit, Exit::Success);
    assert!(other.len() > 350, "{}", other.len());
    let (exit, _) = judged(|own, question| opposite(own.answer(question)));
    assert_eq!(exit, Exit::Failure);
}

/// A name that only one edition prints does not bind codecs of the other edition.
#[test]
fn names_of_another_edition_fail_nothing() {
    let judged = |edition| {
        let mut codec = StepError(|own: &CodecTestee, question: &Question| match &question.hex {
            Some(bytes) if bytes == b"V.E.trajectory.vector.x" => rejected(),
            _ => own.answer(question),
        });
        let (seed, subject) = (3, CaseSubject::Testee);
        let terms = JudgementOptions { seed, subject, edition: Some(edition), strict: false };
        let outcomes = judge(&mut codec, cases(), terms).outcomes;
        let one = outcomes.iter().find(|one| one.case.id == "vec-path-trajectory-x").unwrap();
        one.verdict()
    };
    assert_eq!(judged("en-1.05"), Verdict::Fail);
    assert_eq!(judged("de-1.051"), Verdict::Differs);
}

/// The levels of some vectors and sequences of documented, recommended and assumed behaviour.
#[test]
fn levels_are_in_the_data() {
    for (id, expected) in [
        ("handle-printed", Level::Must),
        ("descriptor-printed", Level::Must),
        ("element-name-printed", Level::Must),
        ("address-query-no-bytes", Level::Info),
        ("element-text-256-and-nul", Level::Info),
        ("kind-padded-256", Level::Info),
        ("content-int-cut", Level::Should),
        ("write-request-two-lengths", Level::Should),
    ] {
        assert_eq!(vector(id).unwrap().level(), expected, "{id}");
    }
    for (id, expected) in [
        ("loop-for", Level::Must),
        ("answer-lost", Level::Info),
        ("uuid-short-asked", Level::Info),
        ("stream-4095-taken", Level::Info),
    ] {
        assert_eq!(sequence(id).unwrap().level(), expected, "{id}");
    }
}
