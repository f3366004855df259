//! The rules of the testee protocol.

use ads_cnc_vectors::Level;

use super::TesteeReaction;
use super::describe::{describe, evidence};
use super::verdicts::Reactions;
use crate::codec::message::{Answer, Question};
use crate::judge::{
    Body, Case, CaseOutcome, CaseSubject, Evidence, Judgement, Needs, TESTEE, Verdict,
};

/// Checks the rules of the testee protocol.
#[derive(Default)]
pub(super) struct ProtocolRules {
    faults: Vec<Judgement>,
    checks: usize,
    first: Reactions,
}

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
        self.checks = self.checks.saturating_add(1);
        let before = self.first.get(&(case, question.op.clone()));
        if before != Some(&reaction) {
            let before = before.map_or_else(|| "nothing".to_owned(), describe);
            let evidence = evidence(&question, &reaction, "", None);
            self.fault(
                format!("the same answer at the end as at the start: {before}"),
                describe(&reaction),
                Some(evidence),
            );
        }
    }

    pub(super) fn made_up(&mut self, question: &Question, reaction: &TesteeReaction) {
        self.checks = self.checks.saturating_add(1);
        if !matches!(reaction, TesteeReaction::Answer(Answer::Unsupported { .. })) {
            let expected = format!("unsupported, for the op {}", question.op);
            self.fault(expected, describe(reaction), Some(evidence(question, reaction, "", None)));
        }
    }

    pub(super) fn fault(
        &mut self,
        expected: impl Into<String>,
        found: impl Into<String>,
        evidence: Option<Evidence>,
    ) {
        self.faults.push(Judgement {
            requirement: TESTEE,
            level: Some(Level::Must),
            verdict: Verdict::Fail,
            expected: expected.into(),
            found: found.into(),
            evidence,
            more: 0,
            follows: None,
        });
    }

    pub(super) fn outcome(self, subject: CaseSubject) -> CaseOutcome {
        let case = Case {
            id: "testee-manners".to_owned(),
            title: "It keeps to the protocol, and does at the end what it did at the start"
                .to_owned(),
            subject,
            requirements: vec![TESTEE],
            needs: Needs::Codec,
            body: Body::Protocol,
        };
        let pass = Judgement {
            requirement: TESTEE,
            level: Some(Level::Must),
            verdict: Verdict::Pass,
            expected: String::new(),
            found: String::new(),
            evidence: None,
            more: 0,
            follows: None,
        };
        let judgements = if self.faults.is_empty() { vec![pass] } else { self.faults };
        CaseOutcome::tried(case, judgements, self.checks.max(1), None)
    }
}
