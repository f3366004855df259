//! What a testee is asked, and in which order.

use ads_cnc_vectors::{Expect, Given, Pieces, Vector};

use super::message::{Capabilities, Known, Question};
use crate::suite::{Body, Case, order};

/// What a question is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// To judge the case at this place.
    Case(usize),
    /// To see at the start and at the end whether it still does what it did.
    Sanity {
        /// The case.
        case: usize,
        /// At the start.
        first: bool,
    },
    /// An op that does not exist.
    MadeUp,
}

/// One question.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    pub(super) purpose: Purpose,
    pub(super) question: Question,
}

/// How many cases are asked at the start and again at the end.
const SANITY: usize = 6;

/// All questions of these cases that the testee claims to answer, shuffled; sanity first and last,
/// and ops in between that nobody has.
pub(super) fn plan(
    cases: &[Case],
    capabilities: &Capabilities,
    edition: &str,
    seed: u32,
) -> Vec<Asked> {
    let claimed = cases.iter().enumerate().flat_map(|(place, case)| {
        let questions = questions(case, edition).into_iter();
        let mine = questions.filter(|one| capabilities.claim(&one.op, &one.stream));
        mine.map(move |question| Asked { purpose: Purpose::Case(place), question })
    });
    let mut asked: Vec<Asked> = claimed.collect();
    let sanity = sanity(cases, &asked);
    asked.sort_by_cached_key(|one| match one.purpose {
        Purpose::Case(case) => {
            let id = cases.get(case).map_or("", |case| case.id.as_str());
            order(seed, &format!("{id} {}", one.question.op))
        }
        _ => 0,
    });
    // One at a third of the way, one at two.
    for part in [2, 1] {
        let place = asked.len().saturating_mul(part).checked_div(3).unwrap_or_default();
        asked.insert(place, made_up(order(seed, &part.to_string()), edition));
    }
    let again = |first: bool| {
        sanity.iter().map(move |(case, question)| Asked {
            purpose: Purpose::Sanity { case: *case, first },
            question: question.clone(),
        })
    };
    again(true).chain(asked).chain(again(false)).collect()
}

/// A few of different streams, both accepted and refused ones.
fn sanity(cases: &[Case], asked: &[Asked]) -> Vec<(usize, Question)> {
    let mut chosen: Vec<(usize, Question)> = Vec::new();
    for one in asked {
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

/// An op that nobody has, for a stream that everybody may have.
fn made_up(number: u64, edition: &str) -> Asked {
    let question = Question {
        op: format!("decode-{number:x}"),
        stream: "object-count".to_owned(),
        edition: edition.to_owned(),
        context: Known::default(),
        hex: Some(vec![1, 0, 0, 0]),
        value: None,
        packets: None,
    };
    Asked { purpose: Purpose::MadeUp, question }
}

/// What a case asks.
pub(super) fn questions(case: &Case, edition: &str) -> Vec<Question> {
    match &case.body {
        Body::Vector(vector) => of_vector(vector, edition),
        Body::Sequence(sequence) => {
            let bytes = |pieces: &Vec<Pieces>| pieces.iter().map(Pieces::bytes).collect();
            let blank = |op: &str, stream: &str| Question {
                op: op.to_owned(),
                stream: stream.to_owned(),
                edition: edition.to_owned(),
                context: Known::default(),
                hex: None,
                value: None,
                packets: None,
            };
            match &sequence.given {
                Given::NcText(text) => {
                    vec![Question { hex: Some(text.bytes()), ..blank("packets", "nc-text") }]
                }
                Given::NcCheck(packets) => {
                    vec![Question { packets: Some(bytes(packets)), ..blank("check", "nc-check") }]
                }
                Given::Streaming(_) | Given::Service(_) => Vec::new(),
            }
        }
        _ => Vec::new(),
    }
}

fn of_vector(vector: &Vector, edition: &str) -> Vec<Question> {
    let decode = Question {
        op: "decode".to_owned(),
        stream: vector.stream.clone(),
        edition: edition.to_owned(),
        context: Known::from(&vector.context),
        hex: Some(vector.bytes()),
        value: None,
        packets: None,
    };
    match &vector.expect {
        Expect::Reject(_) => vec![decode],
        Expect::Accept(accept) => {
            let encode = Question {
                op: "encode".to_owned(),
                hex: None,
                value: Some(accept.value.clone()),
                ..decode.clone()
            };
            vec![decode, encode]
        }
    }
}
