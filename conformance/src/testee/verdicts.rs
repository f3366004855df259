//! Judges the answers of a testee.

use std::collections::{BTreeSet, HashMap};

use ads_cnc_vectors::{Expect, Level, Sequence, SequenceExpect, Vector};

use super::blame::WrongFields;
use super::describe::{describe, evidence};
use super::level::{level, wrong_fields};
use super::plan::{forms, questions};
use super::{TesteeReaction, compare};
use crate::codec::message::{Answer, Output, Question, TesteeHello};
use crate::evidence::Describe;
use crate::judge::{
    Body, Case, CaseOutcome, CaseSubject, NOT_CLAIMED, Record, Rule, Stop, TESTEE, Verdict,
};
use crate::text::hex::compact;
use crate::text::plural;
use crate::vector_format::show;

/// The terms by which a testee is judged.
#[derive(Clone, Copy, Debug)]
pub struct JudgementOptions<'t> {
    pub seed: u32,
    /// The subject: this project's codec or a testee.
    pub subject: CaseSubject,
    /// The edition that the user selected. `None` for the first edition that the testee claims, or
    /// en-1.05 if it claims none.
    pub edition: Option<&'t str>,
    /// Whether an answer that only contradicts an assumption fails too, as for this project's
    /// codec.
    pub strict: bool,
}

/// The reactions to the questions, by index of the case and op.
pub(super) type Reactions = HashMap<(usize, String), TesteeReaction>;

/// All cases and reactions, from which the verdicts follow.
pub(super) struct Verdicts<'v> {
    pub(super) cases: &'v [Case],
    pub(super) reactions: &'v Reactions,
    pub(super) hello: &'v TesteeHello,
    pub(super) edition: String,
    pub(super) terms: JudgementOptions<'v>,
    /// Why not all questions were asked; `None` if all were asked.
    pub(super) stop: Option<Stop>,
    /// The clauses of the wrong fields by which at least one vector fails.
    pub(super) broken: BTreeSet<&'static str>,
}

/// How an answer differs from the expected answer.
struct Deviation {
    verdict: Verdict,
    expected: String,
    found: String,
}

impl Deviation {
    fn new(verdict: Verdict, expected: impl Describe, found: impl Describe) -> Self {
        Self { verdict, expected: expected.describe(), found: found.describe() }
    }

    fn fail(expected: impl Describe, found: impl Describe) -> Self {
        Self::new(Verdict::Fail, expected, found)
    }
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
            let all: BTreeSet<&str> = questions.iter().map(|one| one.stream.as_str()).collect();
            let all = all.into_iter().collect::<Vec<_>>().join(", ");
            let note = format!("{NOT_CLAIMED}{all}");
            return Some(CaseOutcome::untried(case.clone(), Verdict::NotApplicable, note));
        }
        let mut stop = None;
        let mut record = Record::default();
        for question in &claimed {
            let Some(reaction) = self.reactions.get(&(place, question.op.clone())) else {
                stop.clone_from(&self.stop);
                continue;
            };
            let deviation = self.deviation(case, question, reaction);
            let is_vacuous = |one: &Deviation| one.verdict == Verdict::Vacuous;
            if deviation.as_ref().is_some_and(is_vacuous) && self.stop.is_some() {
                // The question of the sibling may not have been asked, because the run ended early.
                stop.clone_from(&self.stop);
                continue;
            }
            self.record(&mut record, case, question, reaction, deviation);
        }
        record.checks = claimed.len();
        Some(CaseOutcome::tried(case.clone(), record, stop))
    }

    /// The clauses of the wrong fields by which a case fails.
    pub(super) fn causes(&self, place: usize) -> Vec<&'static str> {
        let Some(case) = self.cases.get(place) else { return Vec::new() };
        let mut causes = Vec::new();
        for question in questions(case, &self.edition) {
            let reaction = self.reactions.get(&(place, question.op.clone()));
            let claims = self.hello.capabilities.claim(&question.op, &question.stream);
            let Some(reaction) = reaction.filter(|_| claims) else { continue };
            let deviation = self.deviation(case, &question, reaction);
            let (judged, _) = self.judged(case, &question, reaction, deviation.as_ref());
            let wrong = self.wrong_fields(case, reaction).filter(|_| judged == Verdict::Fail);
            let clauses = wrong.iter().flat_map(WrongFields::clauses);
            causes.extend(clauses.filter(|id| case.requirements.contains(id)));
        }
        causes
    }

    /// The verdict of an answer, and the level at which it was judged.
    fn judged(
        &self,
        case: &Case,
        question: &Question,
        reaction: &TesteeReaction,
        deviation: Option<&Deviation>,
    ) -> (Verdict, Level) {
        let verdict = deviation.map_or(Verdict::Pass, |one| one.verdict);
        let level = self.level(case, question, reaction, verdict);
        match verdict {
            Verdict::Fail | Verdict::Vacuous if level != Level::Must => {
                (Verdict::missed(level), level)
            }
            // `Differs` is always judged at level *info*, whatever the level of the case is.
            Verdict::Differs => (verdict, Level::Info),
            verdict => (verdict, level),
        }
    }

    /// The wrong fields of an answer to an accepted vector; `None` for other cases, and if they
    /// cannot be determined.
    fn wrong_fields(&self, case: &Case, reaction: &TesteeReaction) -> Option<WrongFields> {
        match (&case.body, reaction) {
            (Body::Vector(vector), TesteeReaction::Answer(Answer::Ok(output))) => {
                wrong_fields(vector, output, self.terms.strict)
            }
            _ => None,
        }
    }

    /// Records the result of a question for each requirement of its case.
    fn record(
        &self,
        record: &mut Record,
        case: &Case,
        question: &Question,
        reaction: &TesteeReaction,
        deviation: Option<Deviation>,
    ) {
        let (judged, level) = self.judged(case, question, reaction, deviation.as_ref());
        let (expected, found) = match &deviation {
            Some(one) => (one.expected.as_str(), one.found.as_str()),
            None => Default::default(),
        };
        let canonical = match &case.body {
            Body::Vector(vector) if question.op == "encode" => Some(*vector),
            _ => None,
        };
        let evidence = || {
            let canonical = canonical.map(|vector| vector.bytes());
            Some(evidence(question, reaction, &case.id, canonical))
        };
        if self.is_of_protocol(case, question, reaction, judged) {
            for &id in &case.requirements {
                record.add_following(Rule::of(id), Verdict::Fail, TESTEE, expected, found);
            }
            return;
        }
        let is_wrong = deviation.is_some();
        let wrong = self.wrong_fields(case, reaction).filter(|_| is_wrong);
        for &id in &case.requirements {
            let cause = wrong
                .as_ref()
                .and_then(|wrong| wrong.cause_of(id, &case.requirements, &self.broken))
                .filter(|cause| self.broken.contains(cause));
            let rule = Rule { id, level: Some(level) };
            match cause {
                Some(cause) => record.add_following(rule, judged, cause, expected, found),
                None => record.add(rule, judged, expected, found, evidence),
            }
        }
    }

    fn deviation(
        &self,
        case: &Case,
        question: &Question,
        reaction: &TesteeReaction,
    ) -> Option<Deviation> {
        match &case.body {
            Body::Vector(vector) => self.vector(vector, question, reaction),
            Body::Sequence(sequence) => self.sequence(sequence, reaction),
            _ => {
                let found = "a case without a question";
                Some(Deviation::new(Verdict::HarnessError, "", found))
            }
        }
    }

    /// The level at which an answer with this verdict is judged.
    fn level(
        &self,
        case: &Case,
        question: &Question,
        reaction: &TesteeReaction,
        verdict: Verdict,
    ) -> Level {
        // Only `ok` and `reject` can be judged below level *must*. Any other answer, a crash and a
        // missing answer are always faults.
        let answered =
            matches!(reaction, TesteeReaction::Answer(Answer::Ok(_) | Answer::Reject(_)));
        let lenient = answered && !self.terms.strict;
        if !lenient {
            Level::Must
        } else if self.is_of_edition(&case.body) {
            level(&case.body, verdict, &question.op, reaction)
        } else {
            Level::Info
        }
    }

    /// Whether the edition by which the testee is judged states the behaviour that a case expects.
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
    ) -> Option<Deviation> {
        match (&vector.expect, question.op.as_str()) {
            (Expect::Accept(accept), "encode") => {
                let forms = forms(vector, accept);
                let expected = || {
                    let shown: Vec<String> = forms.iter().map(|form| compact::show(form)).collect();
                    shown.join(" or ")
                };
                match reaction {
                    TesteeReaction::Answer(Answer::Ok(Output { hex: Some(hex), .. })) => {
                        let found = || compact::show(hex);
                        (!forms.contains(hex)).then(|| Deviation::fail(expected, found))
                    }
                    other => Some(Deviation::fail(expected, || describe(other))),
                }
            }
            (Expect::Accept(accept), _) => {
                let expected = || show(&accept.value);
                let TesteeReaction::Answer(Answer::Ok(Output { value: Some(value), .. })) =
                    reaction
                else {
                    return Some(Deviation::fail(expected, || describe(reaction)));
                };
                let (verdict, what) = match compare::compare(&accept.value, value)? {
                    compare::Difference::Other(what) | compare::Difference::End(what) => {
                        (Verdict::Fail, what)
                    }
                    compare::Difference::Omitted(what) if self.terms.strict => {
                        (Verdict::Fail, what)
                    }
                    compare::Difference::Omitted(what) => (Verdict::Differs, what),
                };
                Some(Deviation::new(verdict, expected, what))
            }
            (Expect::Reject(reject), _) => {
                let expected = || {
                    let (class, offset, field) = (&reject.class, reject.offset, &reject.field);
                    format!("rejected: {class} at offset {offset} in {field}")
                };
                self.rejected(reaction, expected, &vector.sibling, "decode")
            }
        }
    }

    /// Checks that the testee rejected a vector or sequence, and accepted its valid sibling.
    fn rejected(
        &self,
        reaction: &TesteeReaction,
        expected: impl Describe,
        sibling: &Option<String>,
        op: &str,
    ) -> Option<Deviation> {
        match reaction {
            TesteeReaction::Answer(Answer::Reject(_)) => {
                // If the testee does not accept the valid sibling, the rejection proves nothing.
                let why = match self.sibling(sibling, op) {
                    Some(TesteeReaction::Answer(Answer::Ok(_))) => return None,
                    Some(other) => describe(other),
                    None => "not asked".to_owned(),
                };
                let sibling = sibling.as_deref().unwrap_or_default();
                let found = format!("rejected; but {sibling}, which is valid: {why}");
                Some(Deviation::new(Verdict::Vacuous, expected, found))
            }
            other => Some(Deviation::fail(expected, || describe(other))),
        }
    }

    /// Whether a failure is only a violation of the testee protocol: the answer, or the answer to
    /// the valid sibling, is a line that the protocol does not define.
    fn is_of_protocol(
        &self,
        case: &Case,
        question: &Question,
        reaction: &TesteeReaction,
        judged: Verdict,
    ) -> bool {
        let sibling = match &case.body {
            Body::Vector(vector) => &vector.sibling,
            Body::Sequence(sequence) => &sequence.sibling,
            _ => &None,
        };
        let sibling = self.sibling(sibling, &question.op).filter(|_| judged != Verdict::Pass);
        [Some(reaction), sibling]
            .into_iter()
            .flatten()
            .any(|one| matches!(one, TesteeReaction::Garbled(_)))
    }

    /// The reaction to the valid sibling of a vector or sequence that must be rejected.
    fn sibling(&self, sibling: &Option<String>, op: &str) -> Option<&TesteeReaction> {
        let wanted = sibling.as_deref()?;
        let is_wanted = |case: &Case| match &case.body {
            Body::Vector(vector) => vector.id == wanted,
            Body::Sequence(sequence) => sequence.id == wanted,
            _ => false,
        };
        let place = self.cases.iter().position(is_wanted)?;
        self.reactions.get(&(place, op.to_owned()))
    }

    fn sequence(&self, sequence: &Sequence, reaction: &TesteeReaction) -> Option<Deviation> {
        match (&sequence.expect, reaction) {
            (SequenceExpect::Accept(accept), TesteeReaction::Answer(Answer::Ok(output))) => {
                let packets = accept.packets.as_ref()?;
                let stated: Vec<Vec<u8>> = packets.iter().map(|one| one.bytes()).collect();
                let text = stated.concat();
                let given = output.packets.as_deref().unwrap_or_default();
                let found = packets_fault(&text, given)?;
                let len = text.len();
                let expected = || {
                    format!(
                        "{} of whole lines in packets of at most 992 bytes",
                        plural(len, "byte")
                    )
                };
                Some(Deviation::fail(expected, found))
            }
            (SequenceExpect::Accept(_), other) => {
                Some(Deviation::fail("accepted", || describe(other)))
            }
            (SequenceExpect::Reject(reject), reaction) => {
                let expected = || {
                    let line = reject.line.map(|line| format!(" in line {line}"));
                    format!("rejected: {}{}", reject.class, line.unwrap_or_default())
                };
                let op = if sequence.kind() == "nc-text" { "packets" } else { "check" };
                self.rejected(reaction, expected, &sequence.sibling, op)
            }
        }
    }
}

/// Describes the first fault in the packets into which the testee split this text.
fn packets_fault(text: &[u8], packets: &[Vec<u8>]) -> Option<String> {
    let max = ads_cnc::limits::STREAM_PACKET_MAX;
    for (place, packet) in packets.iter().enumerate() {
        let number = place.saturating_add(1);
        if packet.len() > max || packet.is_empty() {
            return Some(format!("packet {number} has {}", plural(packet.len(), "byte")));
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
        Some(format!(
            "{} in total, different from the text at offset {same}",
            plural(all.len(), "byte")
        ))
    }
}
