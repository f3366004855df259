//! Asking a testee everything, and what comes of it.

use std::collections::HashMap;

use super::describe::describe;
use super::plan::{PlannedQuestion, Purpose, plan};
use super::protocol_rules::ProtocolRules;
use super::verdicts::{Reactions, Terms, Verdicts};
use super::{Reaction, Testee};
use crate::codec::message::{Answer, Hello};
use crate::judge::{Case, Outcome, Stop, Subject, Verdict, caught};
use crate::process::interrupt;

/// Questions in a row that end with a crash or in silence, after which no more are asked.
const LOST_MAX: usize = 12;

/// The most memory that answers may take together, in bytes; those to all vectors take a part of it.
const ANSWERS_MAX: usize = 32 << 20;

#[derive(Debug)]
pub struct Judged {
    pub hello: Option<Hello>,
    /// Of each case, and of the protocol.
    pub outcomes: Vec<Outcome>,
    pub asked: usize,
    /// How often it had to be started anew.
    pub restarts: usize,
}

/// Asks a testee all that these cases have.
pub fn judge(testee: &mut dyn Testee, mut cases: Vec<Case>, terms: Terms<'_>) -> Judged {
    cases.iter_mut().for_each(|case| case.subject = terms.subject);
    let hello = match testee.hello() {
        Ok(hello) => hello,
        Err(_) if interrupt::came() => return untried(cases, Outcome::interrupted),
        // Whether it would have answered is not known.
        Err(reaction) => {
            return match testee.over() {
                Some(why) => untried(cases, |case| {
                    Outcome::untried(case, Verdict::Inconclusive, why.clone())
                }),
                None => without_hello(cases, &reaction, terms.subject),
            };
        }
    };
    let capabilities = &hello.capabilities;
    let claimed = capabilities.editions.first().map(String::as_str);
    let edition = terms.edition.or(claimed).unwrap_or("en-1.05").to_owned();
    let mut protocol = ProtocolRules::default();
    if let Some(asked) = terms.edition
        && !capabilities.editions.is_empty()
        && !capabilities.editions.iter().any(|one| one == asked)
    {
        let untried = |case| {
            let note = format!("the testee does not claim the edition {asked}");
            Outcome::untried(case, Verdict::NotApplicable, note)
        };
        let outcomes = cases.into_iter().map(untried).collect();
        return Judged { hello: Some(hello), outcomes, asked: 0, restarts: 0 };
    }
    // Siblings decide, so they are asked even if nobody wants to know of them.
    let wanted = cases.len();
    let missing = crate::judge::siblings_of(&cases);
    cases.extend(missing);
    let mut reactions = Reactions::new();
    let (mut lost, mut restarts, mut asked, mut gone) = (0_usize, 0_usize, 0_usize, None);
    let mut kept = 0_usize;
    let mut panicked = HashMap::new();
    for PlannedQuestion { purpose, question } in plan(&cases, capabilities, &edition, terms.seed) {
        if let Some(why) = testee.over() {
            gone = Some(Stop::Inconclusive(format!("not asked: {why}")));
            break;
        }
        let reaction = match (caught(|| testee.ask(&question)), purpose) {
            (Ok(reaction), _) => reaction,
            (Err(why), Purpose::Case(case) | Purpose::Sanity { case, .. }) => {
                panicked.insert(case, why);
                continue;
            }
            (Err(_), Purpose::MadeUp) => continue,
        };
        if interrupt::came() {
            // Whether it would have answered is not known.
            gone = Some(Stop::Interrupted);
            break;
        }
        if let (Reaction::Silent(_), Some(why)) = (&reaction, testee.over()) {
            gone = Some(Stop::Inconclusive(format!("not answered: {why}")));
            break;
        }
        asked = asked.saturating_add(1);
        if matches!(reaction, Reaction::Died(_) | Reaction::Silent(_) | Reaction::Broken(_)) {
            (lost, restarts) = (lost.saturating_add(1), restarts.saturating_add(1));
        } else {
            lost = 0;
        }
        if let Reaction::Answer(Answer::Ok(output)) = &reaction {
            kept = kept.saturating_add(output.weight());
        }
        if kept > ANSWERS_MAX {
            let why = format!("its answers take more than {} MiB", ANSWERS_MAX >> 20);
            gone = Some(Stop::Inconclusive(format!("not asked: {why}")));
            break;
        }
        match purpose {
            Purpose::Case(case) => {
                reactions.insert((case, question.op), reaction);
            }
            Purpose::Sanity { case, first } => protocol.sanity(case, first, question, reaction),
            Purpose::MadeUp => protocol.made_up(&question, &reaction),
        }
        if lost >= LOST_MAX {
            let why = format!("{LOST_MAX} questions in a row without an answer");
            gone = Some(Stop::Inconclusive(format!("not asked: {why}")));
            break;
        }
    }
    if gone.is_none()
        && testee.over().is_none()
        && let Err(why) = testee.bye()
    {
        protocol.fault("it ends with exit code 0 after bye", why, None);
    }
    let view =
        Verdicts { cases: &cases, reactions: &reactions, hello: &hello, edition, terms, gone };
    let outcome = |place| {
        let judged = match panicked.remove(&place) {
            Some(why) => Err(why),
            None => caught(|| view.outcome(place)),
        };
        judged.unwrap_or_else(|why| {
            let case = cases.get(place)?.clone();
            Some(Outcome::tried(case, Vec::new(), 0, Some(Stop::Harness(why))))
        })
    };
    let mut outcomes: Vec<Outcome> = (0..wanted).filter_map(outcome).collect();
    // Our own codec is asked without a protocol in between.
    if terms.subject != Subject::Codec {
        let protocol = protocol.outcome(terms.subject);
        outcomes.push(match interrupt::came() {
            true => Outcome::interrupted(protocol.case),
            false => protocol,
        });
    }
    Judged { hello: Some(hello), outcomes, asked, restarts }
}

fn untried(cases: Vec<Case>, outcome: impl Fn(Case) -> Outcome) -> Judged {
    let outcomes = cases.into_iter().map(outcome).collect();
    Judged { hello: None, outcomes, asked: 0, restarts: 0 }
}

fn without_hello(cases: Vec<Case>, reaction: &Reaction, subject: Subject) -> Judged {
    let mut protocol = ProtocolRules::default();
    protocol.fault("an answer to hello", describe(reaction), None);
    let untried = |case| Outcome::untried(case, Verdict::NotRun, "there was no answer to hello");
    let mut outcomes: Vec<Outcome> = cases.into_iter().map(untried).collect();
    outcomes.push(protocol.outcome(subject));
    Judged { hello: None, outcomes, asked: 0, restarts: 0 }
}

#[cfg(test)]
mod tests {
    use super::super::{Own, Question};
    use super::*;

    /// The codec, which panics when it is asked one op.
    struct Panics(Own);

    impl Testee for Panics {
        fn hello(&mut self) -> Result<Hello, Reaction> {
            Testee::hello(&mut self.0)
        }

        fn ask(&mut self, question: &Question) -> Reaction {
            assert_ne!(question.op, "check", "asked");
            self.0.ask(question)
        }

        fn bye(&mut self) -> Result<(), String> {
            Ok(())
        }
    }

    #[test]
    fn only_a_case_that_panics_is_a_harness_error() {
        let cases = crate::judge::codec_cases();
        let terms = Terms { seed: 1, subject: Subject::Codec, edition: None, strict: true };
        let judged = judge(&mut Panics(Own::default()), cases, terms);
        let (panicked, others): (Vec<_>, Vec<_>) = judged.outcomes.iter().partition(|outcome| {
            matches!(outcome.case.body, crate::judge::Body::Sequence(one) if one.kind() == "nc-check")
        });
        for outcome in &panicked {
            assert_eq!(outcome.verdict(), Verdict::HarnessError);
            assert!(outcome.note.as_ref().unwrap().contains("the case panicked: "), "{outcome:?}");
        }
        assert!(!panicked.is_empty() && others.iter().all(|one| one.verdict() == Verdict::Pass));
    }
}
