//! Checks that a testee follows the rules of the testee protocol.

use std::mem::discriminant;

use ads_cnc_vectors::Level;

use super::TesteeReaction;
use super::describe::{NO_ANSWER, describe, evidence};
use super::verdicts::Reactions;
use crate::codec::message::{Answer, Question};
use crate::evidence::Describe;
use crate::judge::{Body, Case, CaseOutcome, CaseSubject, Needs, Record, Rule, TESTEE, Verdict};

/// The checks of the rules of the testee protocol so far.
#[derive(Default)]
pub(super) struct ProtocolRules {
    record: Record,
    first: Reactions,
}

const RULE: Rule = Rule { id: TESTEE, level: Some(Level::Must) };

impl ProtocolRules {
    pub(super) fn sanity(
        &mut self,
        case: usize,
        first: bool,
        question: Question,
        reaction: TesteeReaction,
    ) {
        if first {
            self.first.insert((case, question.op), reaction);
            return;
        }
        let before = self.first.get(&(case, question.op.clone()));
        // The details of an answer other than `ok`, such as its message, are not judged.
        let is_same = match (before, &reaction) {
            (Some(TesteeReaction::Answer(before)), TesteeReaction::Answer(answer))
                if !matches!(answer, Answer::Ok(_)) =>
            {
                discriminant(before) == discriminant(answer)
            }
            _ => before == Some(&reaction),
        };
        let expected = before.map_or_else(|| "no answer".to_owned(), describe);
        let expected = || format!("the same answer at the end as at the start: {expected}");
        self.check(is_same, &question, &reaction, expected);
    }

    pub(super) fn made_up(&mut self, question: &Question, reaction: &TesteeReaction) {
        let passed = matches!(reaction, TesteeReaction::Answer(Answer::Unsupported { .. }));
        let expected = || format!("unsupported for the unknown op {}", question.op);
        self.check(passed, question, reaction, expected);
    }

    /// Records a line that is not a valid answer.
    pub(super) fn garbled(&mut self, question: &Question, reaction: &TesteeReaction) {
        let found = describe(reaction);
        let found = found.strip_prefix(NO_ANSWER).unwrap_or(&found);
        let evidence = || Some(evidence(question, reaction, "", None));
        self.record.add_all(RULE, false, "an answer that the protocol defines", found, evidence);
    }

    fn check(
        &mut self,
        passed: bool,
        question: &Question,
        reaction: &TesteeReaction,
        expected: impl Describe,
    ) {
        let evidence = || Some(evidence(question, reaction, "", None));
        self.record.add_all(RULE, passed, expected, || describe(reaction), evidence);
    }

    pub(super) fn fault(&mut self, expected: &str, found: String) {
        self.record.add_all(RULE, false, expected, found, || None);
    }

    pub(super) fn has_failed(&self) -> bool {
        self.record.judgements.iter().any(|one| one.verdict == Verdict::Fail)
    }

    pub(super) fn outcome(mut self, subject: CaseSubject) -> CaseOutcome {
        let case = Case {
            id: "testee-manners".to_owned(),
            title: "It follows the protocol, and gives the same answers at the end as at the start"
                .to_owned(),
            subject,
            requirements: vec![TESTEE],
            needs: Needs::Codec,
            body: Body::Protocol,
        };
        if self.record.checks == 0 {
            self.record.add_all(RULE, true, "", "", || None);
        }
        CaseOutcome::tried(case, self.record, None)
    }
}
