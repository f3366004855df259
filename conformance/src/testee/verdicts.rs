//! Judges the answers of a testee.

use std::collections::HashMap;

use ads_cnc_vectors::{Expect, Level, Sequence, SequenceExpect, Vector, sequence, vector};

use super::describe::{describe, evidence};
use super::plan::{forms, questions};
use super::{TesteeReaction, compare};
use crate::codec::message::{Answer, Output, Question, TesteeHello};
use crate::judge::{
    Body, Case, CaseOutcome, CaseSubject, Evidence, Judgement, Stop, TEXT_MAX, Verdict,
};
use crate::show::show;
use crate::text::{hex::compact, shorten};

/// The conditions of a judgement.
#[derive(Clone, Copy, Debug)]
pub struct Terms<'t> {
    pub seed: u32,
    /// The subject: this project's codec or a testee.
    pub subject: CaseSubject,
    /// The edition to judge by, if selected.
    pub edition: Option<&'t str>,
    /// Whether assumed requirements can fail too, as for this project's codec.
    pub strict: bool,
}

/// The answers to the questions of a case, by op.
pub(super) type Reactions = HashMap<(usize, String), TesteeReaction>;

/// All questions and answers.
pub(super) struct Verdicts<'v> {
    pub(super) cases: &'v [Case],
    pub(super) reactions: &'v Reactions,
    pub(super) hello: &'v TesteeHello,
    pub(super) edition: String,
    pub(super) terms: Terms<'v>,
    /// Why not all questions were asked.
    pub(super) gone: Option<Stop>,
}

struct Check {
    verdict: Verdict,
    /// The maximum level of a failure.
    level: Level,
    expected: String,
    found: String,
    evidence: Evidence,
}

impl Verdicts<'_> {
    pub(super) fn outcome(&self, place: usize) -> Option<CaseOutcome> {
        let case = self.cases.get(place)?;
        let questions = questions(case, &self.edition);
        if questions.is_empty() {
            return None;
        }
        let claimed: Vec<&Question> = questions
            .iter()
            .filter(|one| self.hello.capabilities.claim(&one.op, &one.stream))
            .collect();
        if claimed.is_empty() {
            let note = "the testee does not claim it";
            return Some(CaseOutcome::untried(case.clone(), Verdict::NotApplicable, note));
        }
        let mut stop = None;
        let mut judgements = Vec::new();
        for question in &claimed {
            let Some(reaction) = self.reactions.get(&(place, question.op.clone())) else {
                stop.clone_from(&self.gone);
                continue;
            };
            let check = self.check(case, question, reaction);
            if check.verdict == Verdict::Vacuous && self.gone.is_some() {
                // The sibling may not have been asked.
                stop.clone_from(&self.gone);
                continue;
            }
            judgements.extend(case.requirements.iter().map(|&id| self.judgement(id, &check)));
        }
        Some(CaseOutcome::tried(case.clone(), judgements, claimed.len(), stop))
    }

    fn judgement(&self, id: &'static str, check: &Check) -> Judgement {
        let verdict = match check.verdict {
            Verdict::Fail | Verdict::Vacuous if check.level != Level::Must => {
                Verdict::missed(check.level)
            }
            verdict => verdict,
        };
        // Some differences count at a lower level than the case.
        let level = if verdict == Verdict::Differs { Level::Info } else { check.level };
        Judgement {
            requirement: id,
            level: Some(level),
            verdict,
            expected: check.expected.clone(),
            found: check.found.clone(),
            evidence: Some(check.evidence.clone()),
            more: 0,
        }
    }

    fn check(&self, case: &Case, question: &Question, reaction: &TesteeReaction) -> Check {
        let (verdict, expected, found) = match &case.body {
            Body::Vector(vector) => self.vector(vector, question, reaction),
            Body::Sequence(sequence) => self.sequence(sequence, reaction),
            _ => (Verdict::HarnessError, String::new(), "a case without a question".to_owned()),
        };
        let canonical = match &case.body {
            Body::Vector(vector) if question.op == "encode" => Some(vector.bytes()),
            _ => None,
        };
        let evidence = evidence(question, reaction, &case.id, canonical);
        let (expected, found) = (shorten(&expected, TEXT_MAX), shorten(&found, TEXT_MAX));
        // Only an answer can differ: a crash is a fault in any case.
        let answered =
            matches!(reaction, TesteeReaction::Answer(Answer::Ok(_) | Answer::Reject(_)));
        let lenient = answered && !self.terms.strict;
        let level = if !lenient {
            Level::Must
        } else if self.is_of_edition(&case.body) {
            level(&case.body, verdict, &question.op)
        } else {
            Level::Info
        };
        Check { verdict, level, evidence, expected, found }
    }

    /// Whether the selected edition states what a case expects.
    fn is_of_edition(&self, body: &Body) -> bool {
        let documents = match body {
            Body::Vector(one) => &one.editions,
            Body::Sequence(one) => &one.editions,
            _ => return true,
        };
        let language = self.edition.get(..2).unwrap_or_default();
        documents.is_empty() || documents.iter().any(|document| document.ends_with(language))
    }

    fn vector(
        &self,
        vector: &Vector,
        question: &Question,
        reaction: &TesteeReaction,
    ) -> (Verdict, String, String) {
        match (&vector.expect, question.op.as_str()) {
            (Expect::Accept(accept), "encode") => {
                let forms = forms(vector, accept);
                let shown: Vec<String> = forms.iter().map(|form| compact::show(form)).collect();
                let expected = shown.join(" or ");
                match reaction {
                    TesteeReaction::Answer(Answer::Ok(Output { hex: Some(hex), .. })) => {
                        let found = compact::show(hex);
                        let verdict =
                            if forms.contains(hex) { Verdict::Pass } else { Verdict::Fail };
                        (verdict, expected, found)
                    }
                    other => (Verdict::Fail, expected, describe(other)),
                }
            }
            (Expect::Accept(accept), _) => {
                let expected = show(&accept.value);
                let TesteeReaction::Answer(Answer::Ok(Output { value: Some(value), .. })) =
                    reaction
                else {
                    return (Verdict::Fail, expected, describe(reaction));
                };
                match compare::compare(&accept.value, value) {
                    None => (Verdict::Pass, expected, String::new()),
                    Some(compare::Difference::Other(what)) => (Verdict::Fail, expected, what),
                    Some(compare::Difference::Untold(what)) if self.terms.strict => {
                        (Verdict::Fail, expected, what)
                    }
                    Some(compare::Difference::Untold(what)) => (Verdict::Differs, expected, what),
                }
            }
            (Expect::Reject(reject), _) => {
                let place =
                    format!("{} at offset {} in {}", reject.class, reject.offset, reject.field);
                let expected = format!("refused: {place}");
                match reaction {
                    TesteeReaction::Answer(Answer::Reject(_)) => {
                        match self.sibling(&vector.sibling, "decode") {
                            Ok(()) => (Verdict::Pass, expected, String::new()),
                            Err(why) => (Verdict::Vacuous, expected, why),
                        }
                    }
                    other => (Verdict::Fail, expected, describe(other)),
                }
            }
        }
    }

    /// Whether the accepted sibling was accepted: otherwise the rejection may have any reason.
    fn sibling(&self, sibling: &Option<String>, op: &str) -> Result<(), String> {
        let wanted = sibling.as_deref().unwrap_or_default();
        let is_wanted = |case: &Case| match &case.body {
            Body::Vector(vector) => vector.id == wanted,
            Body::Sequence(sequence) => sequence.id == wanted,
            _ => false,
        };
        let Some(place) = self.cases.iter().position(is_wanted) else {
            return Err(format!("{wanted}, which lacks this fault, was not tried"));
        };
        match self.reactions.get(&(place, op.to_owned())) {
            Some(TesteeReaction::Answer(Answer::Ok(_))) => Ok(()),
            Some(other) => {
                Err(format!("refused, but {wanted}, which lacks this fault: {}", describe(other)))
            }
            None => Err(format!("{wanted}, which lacks this fault, was not answered")),
        }
    }

    fn sequence(
        &self,
        sequence: &Sequence,
        reaction: &TesteeReaction,
    ) -> (Verdict, String, String) {
        match (&sequence.expect, reaction) {
            (SequenceExpect::Accept(accept), TesteeReaction::Answer(Answer::Ok(output))) => {
                let Some(packets) = &accept.packets else {
                    return (Verdict::Pass, String::new(), String::new());
                };
                let stated: Vec<Vec<u8>> = packets.iter().map(|one| one.bytes()).collect();
                let text = stated.concat();
                match packets_fault(&text, output.packets.as_deref().unwrap_or_default()) {
                    None => (Verdict::Pass, String::new(), String::new()),
                    Some(found) => {
                        let expected = format!(
                            "{} bytes of whole lines in packets of at most 992",
                            text.len()
                        );
                        (Verdict::Fail, expected, found)
                    }
                }
            }
            (SequenceExpect::Accept(_), other) => {
                (Verdict::Fail, "accepted".to_owned(), describe(other))
            }
            (SequenceExpect::Reject(reject), reaction) => {
                let line = reject.line.map(|line| format!(" in line {line}")).unwrap_or_default();
                let expected = format!("refused: {}{line}", reject.class);
                match reaction {
                    TesteeReaction::Answer(Answer::Reject(_)) => {
                        let op = if sequence.kind() == "nc-text" { "packets" } else { "check" };
                        match self.sibling(&sequence.sibling, op) {
                            Ok(()) => (Verdict::Pass, expected, String::new()),
                            Err(why) => (Verdict::Vacuous, expected, why),
                        }
                    }
                    other => (Verdict::Fail, expected, describe(other)),
                }
            }
        }
    }
}

/// The level of a case's expectation; if the sibling's was missed, its level counts too.
fn level(body: &Body, verdict: Verdict, op: &str) -> Level {
    let (own, sibling) = match body {
        Body::Vector(one) if op == "encode" => (one.encoding_level(), None),
        Body::Vector(one) => {
            (one.level(), one.sibling.as_deref().and_then(vector).map(Vector::level))
        }
        Body::Sequence(one) => {
            (one.level(), one.sibling.as_deref().and_then(sequence).map(Sequence::level))
        }
        _ => (Level::Must, None),
    };
    match sibling {
        Some(sibling) if verdict == Verdict::Vacuous => own.max(sibling),
        _ => own,
    }
}

/// A fault in the packets for this text.
fn packets_fault(text: &[u8], packets: &[Vec<u8>]) -> Option<String> {
    let max = ads_cnc::limits::STREAM_PACKET_MAX;
    for (place, packet) in packets.iter().enumerate() {
        let number = place.saturating_add(1);
        if packet.len() > max || packet.is_empty() {
            return Some(format!("packet {number} has {} bytes", packet.len()));
        }
        if !packet.ends_with(b"\r\n") {
            return Some(format!("packet {number} does not end with CR LF"));
        }
    }
    let all = packets.concat();
    if all == text {
        None
    } else {
        let same = all.iter().zip(text).take_while(|(one, other)| one == other).count();
        Some(format!("{} bytes in all, another one at offset {same}", all.len()))
    }
}
