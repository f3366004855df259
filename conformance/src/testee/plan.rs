//! The questions for a testee, and their order.

use ads_cnc_vectors::{Accept, Expect, Pieces, SequenceInput, Vector};

use crate::codec::message::{Capabilities, Question, QuestionContext};
use crate::judge::{Body, Case, order};

/// The purpose of a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// To judge the case with this index.
    Case(usize),
    /// To detect that an answer changes during the run: the question is asked at the start and at
    /// the end.
    Sanity {
        case: usize,
        /// Whether the question is asked at the start; otherwise at the end.
        first: bool,
    },
    /// To check that the testee does not support an op that does not exist.
    MadeUp,
}

/// A question and its purpose.
#[derive(Clone, Debug)]
pub(super) struct PlannedQuestion {
    pub(super) purpose: Purpose,
    pub(super) question: Question,
}

/// Maximum number of questions that are asked at the start and again at the end.
const SANITY: usize = 6;

/// All questions of these cases that the testee claims to answer, in the order of the seed, with
/// the sanity questions at the start and at the end, and two questions with nonexistent ops in
/// between.
pub(super) fn plan(
    cases: &[Case],
    capabilities: &Capabilities,
    edition: &str,
    seed: u32,
) -> Vec<PlannedQuestion> {
    let claimed = cases.iter().enumerate().flat_map(|(place, case)| {
        let questions = questions(case, edition).into_iter();
        let claimed_questions = questions.filter(|one| capabilities.claim(&one.op, &one.stream));
        claimed_questions
            .map(move |question| PlannedQuestion { purpose: Purpose::Case(place), question })
    });
    let mut planned: Vec<PlannedQuestion> = claimed.collect();
    let sanity = sanity(cases, &planned);
    planned.sort_by_cached_key(|one| match one.purpose {
        Purpose::Case(case) => {
            let id = cases.get(case).map_or("", |case| case.id.as_str());
            order(seed, &format!("{id} {}", one.question.op))
        }
        _ => 0,
    });
    // Inserts a question with a nonexistent op after two thirds of the questions, and another after
    // one third.
    for part in [2, 1] {
        let place = planned.len().saturating_mul(part).checked_div(3).unwrap_or_default();
        planned.insert(place, made_up(order(seed, &part.to_string()), edition));
    }
    let again = |first: bool| {
        sanity.iter().map(move |(case, question)| PlannedQuestion {
            purpose: Purpose::Sanity { case: *case, first },
            question: question.clone(),
        })
    };
    again(true).chain(planned).chain(again(false)).collect()
}

/// The sanity questions, as case and question: for different streams or ops, and every third of
/// them for a rejected vector.
fn sanity(cases: &[Case], planned: &[PlannedQuestion]) -> Vec<(usize, Question)> {
    let mut chosen: Vec<(usize, Question)> = Vec::new();
    for one in planned {
        let Purpose::Case(case) = one.purpose else { continue };
        let Some(Body::Vector(vector)) = cases.get(case).map(|case| &case.body) else { continue };
        let known = chosen.iter().any(|(_, question)| {
            question.stream == one.question.stream && question.op == one.question.op
        });
        let wanted = match chosen.len() % 3 {
            2 => !vector.is_accepted(),
            _ => vector.is_accepted(),
        };
        if !known && wanted {
            chosen.push((case, one.question.clone()));
        }
        if chosen.len() == SANITY {
            break;
        }
    }
    chosen
}

/// A question with a nonexistent op, for a stream that the testee may claim.
fn made_up(number: u64, edition: &str) -> PlannedQuestion {
    let blank = Question::new(format!("decode-{number:x}"), "object-count", edition);
    let question = Question { hex: Some(vec![1, 0, 0, 0]), ..blank };
    PlannedQuestion { purpose: Purpose::MadeUp, question }
}

pub fn questions(case: &Case, edition: &str) -> Vec<Question> {
    match &case.body {
        Body::Vector(vector) => of_vector(vector, edition),
        Body::Sequence(sequence) => {
            let bytes = |pieces: &Vec<Pieces>| pieces.iter().map(Pieces::bytes).collect();
            let blank = |op: &str, stream: &str| Question::new(op, stream, edition);
            match &sequence.given {
                SequenceInput::NcText(text) => {
                    vec![Question { hex: Some(text.bytes()), ..blank("packets", "nc-text") }]
                }
                SequenceInput::NcCheck(packets) => {
                    vec![Question { packets: Some(bytes(packets)), ..blank("check", "nc-check") }]
                }
                SequenceInput::Streaming(_) | SequenceInput::Service(_) => Vec::new(),
            }
        }
        _ => Vec::new(),
    }
}

/// The questions for a vector: `decode` with its bytes and, if it is accepted, `encode` with its
/// value.
pub(super) fn of_vector(vector: &Vector, edition: &str) -> Vec<Question> {
    let of = |op: &str| Question {
        context: QuestionContext::from(&vector.context),
        ..Question::new(op, vector.stream.as_str(), edition)
    };
    let decode = Question { hex: Some(vector.bytes()), ..of("decode") };
    match &vector.expect {
        Expect::Reject(_) => vec![decode],
        Expect::Accept(accept) => {
            vec![decode, Question { value: Some(accept.value.clone()), ..of("encode") }]
        }
    }
}

/// The permitted encodings of a vector's value: the bytes of the vector and, if it has one, the
/// canonical form.
pub(super) fn forms(vector: &Vector, accept: &Accept) -> Vec<Vec<u8>> {
    let canonical = accept.canonical.as_ref().map(|hex| hex.to_vec());
    std::iter::once(vector.bytes()).chain(canonical).collect()
}
