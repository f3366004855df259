//! Asks a testee all questions and judges the answers.

use std::collections::{BTreeSet, HashMap};
use std::time::{Duration, Instant};

use super::describe::describe;
use super::plan::{PlannedQuestion, Purpose, plan};
use super::protocol_rules::ProtocolRules;
use super::verdicts::{JudgementOptions, Reactions, Verdicts};
use super::{Testee, TesteeReaction};
use crate::codec::message::{Answer, TesteeHello};
use crate::judge::{Case, CaseOutcome, CaseSubject, HELLO, Record, Stop, Verdict, caught};
use crate::process::{interrupt, progress};

/// After this many consecutive invalid or missing answers, no more questions are asked.
const UNANSWERED_MAX: usize = 12;

/// Maximum estimated memory in bytes for all `ok` answers; if it is exceeded, no more questions are
/// asked.
const ANSWERS_MAX: usize = 32 << 20;

#[derive(Debug)]
pub struct JudgedTestee {
    pub hello: Option<TesteeHello>,
    /// The outcomes of the cases; for a testee other than this project's codec, also of the case
    /// about the testee protocol. That case is missing if the testee does not claim the selected
    /// edition, or if a signal or the deadline ended the wait for its hello.
    pub outcomes: Vec<CaseOutcome>,
    pub asked: usize,
    /// Number of questions without an answer, because the process crashed, hung or could not be
    /// started. The next question restarts the process.
    pub restarts: usize,
}

/// Asks a testee all questions of these cases that it claims to answer, unless the run ends early,
/// and judges the answers.
pub fn judge(
    testee: &mut dyn Testee,
    mut cases: Vec<Case>,
    terms: JudgementOptions<'_>,
) -> JudgedTestee {
    cases.iter_mut().for_each(|case| case.subject = terms.subject);
    let hello = match testee.hello() {
        Ok(hello) => hello,
        Err(_) if interrupt::is_requested() => return untried(cases, CaseOutcome::interrupted),
        // After the deadline the suite no longer waits, so a missing answer is not a failure.
        Err(reaction) => {
            return match testee.over() {
                Some(why) => untried(cases, |case| {
                    CaseOutcome::untried(case, Verdict::Inconclusive, why.clone())
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
            CaseOutcome::untried(case, Verdict::NotApplicable, note)
        };
        let outcomes = cases.into_iter().map(untried).collect();
        return JudgedTestee { hello: Some(hello), outcomes, asked: 0, restarts: 0 };
    }
    // A rejection is judged together with the accepted sibling of its vector or sequence, so the
    // questions of the siblings are asked even if the user did not select these cases.
    let wanted = cases.len();
    let missing = crate::judge::siblings_of(&cases);
    cases.extend(missing);
    let mut reactions = Reactions::new();
    let (mut lost, mut restarts, mut asked, mut stop) = (0_usize, 0_usize, 0_usize, None);
    let mut kept = 0_usize;
    let mut panicked = HashMap::new();
    let mut times: HashMap<usize, Duration> = HashMap::new();
    let planned = plan(&cases, capabilities, &edition, terms.seed);
    progress::begin(planned.len());
    for PlannedQuestion { purpose, question } in planned {
        if let Some(why) = testee.over() {
            stop = Some(Stop::Inconclusive(format!("not asked: {why}")));
            break;
        }
        let begin = Instant::now();
        let reaction = match (caught(|| testee.ask(&question)), purpose) {
            (Ok(reaction), _) => reaction,
            (Err(why), Purpose::Case(case) | Purpose::Sanity { case, .. }) => {
                panicked.insert(case, why);
                continue;
            }
            (Err(_), Purpose::MadeUp) => continue,
        };
        if interrupt::is_requested() {
            // After an interrupt the suite no longer waits, so a missing answer is not a failure.
            stop = Some(Stop::Interrupted);
            break;
        }
        if let (TesteeReaction::Silent(_), Some(why)) = (&reaction, testee.over()) {
            stop = Some(Stop::Inconclusive(format!("not answered: {why}")));
            break;
        }
        asked = asked.saturating_add(1);
        if let Purpose::Case(case) = &purpose {
            let time = times.entry(*case).or_default();
            *time = time.saturating_add(begin.elapsed());
        }
        // The answers about the cases are judged only after the last question, because rejections
        // depend on siblings.
        let is_lost = matches!(
            reaction,
            TesteeReaction::Died(_) | TesteeReaction::Silent(_) | TesteeReaction::Broken(_)
        );
        let is_garbled = matches!(reaction, TesteeReaction::Garbled(_));
        progress::step(is_lost || is_garbled);
        lost = if is_lost || is_garbled { lost.saturating_add(1) } else { 0 };
        restarts = restarts.saturating_add(usize::from(is_lost));
        if let TesteeReaction::Answer(Answer::Ok(output)) = &reaction {
            kept = kept.saturating_add(output.weight());
        }
        if kept > ANSWERS_MAX {
            let why = format!("the answers take more than {} MiB", ANSWERS_MAX >> 20);
            stop = Some(Stop::Inconclusive(format!("not asked: {why}")));
            break;
        }
        if is_garbled {
            protocol.garbled(&question, &reaction);
        }
        match purpose {
            Purpose::Case(case) => {
                reactions.insert((case, question.op), reaction);
            }
            Purpose::Sanity { case, first } => protocol.sanity(case, first, question, reaction),
            Purpose::MadeUp => protocol.made_up(&question, &reaction),
        }
        if lost >= UNANSWERED_MAX {
            let why = format!("{UNANSWERED_MAX} consecutive questions without a valid answer");
            stop = Some(Stop::Inconclusive(format!("not asked: {why}")));
            break;
        }
    }
    if stop.is_none()
        && testee.over().is_none()
        && let Err(why) = testee.bye()
        // A signal or the deadline ends the wait for the exit.
        && testee.over().is_none()
        && !interrupt::is_requested()
    {
        protocol.fault("it ends with exit code 0 after bye", why);
    }
    let broken = BTreeSet::new();
    let mut view = Verdicts {
        cases: &cases,
        reactions: &reactions,
        hello: &hello,
        edition,
        terms,
        stop,
        broken,
    };
    view.broken =
        (0..wanted).flat_map(|place| caught(|| view.causes(place)).unwrap_or_default()).collect();
    let outcome = |place| {
        let judged = match panicked.remove(&place) {
            Some(why) => Err(why),
            None => caught(|| view.outcome(place)),
        };
        let judged = judged.unwrap_or_else(|why| {
            let case = cases.get(place)?.clone();
            Some(CaseOutcome::tried(case, Record::default(), Some(Stop::Harness(why))))
        });
        judged.map(|judged| CaseOutcome { time: times.get(&place).copied(), ..judged })
    };
    let mut outcomes: Vec<CaseOutcome> = (0..wanted).filter_map(outcome).collect();
    // This project's codec is called as a function, so it has no outcome for the protocol.
    if terms.subject != CaseSubject::Codec {
        let is_open = interrupt::is_requested() && !protocol.has_failed();
        let protocol = protocol.outcome(terms.subject);
        outcomes.push(if is_open { CaseOutcome::interrupted(protocol.case) } else { protocol });
    }
    JudgedTestee { hello: Some(hello), outcomes, asked, restarts }
}

fn untried(cases: Vec<Case>, outcome: impl Fn(Case) -> CaseOutcome) -> JudgedTestee {
    let outcomes = cases.into_iter().map(outcome).collect();
    JudgedTestee { hello: None, outcomes, asked: 0, restarts: 0 }
}

fn without_hello(
    cases: Vec<Case>,
    reaction: &TesteeReaction,
    subject: CaseSubject,
) -> JudgedTestee {
    let mut protocol = ProtocolRules::default();
    protocol.fault(HELLO, describe(reaction));
    let untried = |case| CaseOutcome::untried(case, Verdict::NotRun, "hello was not answered");
    let mut outcomes: Vec<CaseOutcome> = cases.into_iter().map(untried).collect();
    outcomes.push(protocol.outcome(subject));
    JudgedTestee { hello: None, outcomes, asked: 0, restarts: 0 }
}

#[cfg(test)]
mod tests {
    use super::super::{CodecTestee, Question};
    use super::*;

    /// This project's codec, which panics at each question with the op `check`.
    struct PanickingTestee(CodecTestee);

    impl Testee for PanickingTestee {
        fn hello(&mut self) -> Result<TesteeHello, TesteeReaction> {
            Testee::hello(&mut self.0)
        }

        fn ask(&mut self, question: &Question) -> TesteeReaction {
            assert_ne!(question.op, "check", "asked");
            self.0.ask(question)
        }

        fn bye(&mut self) -> Result<(), String> {
            Ok(())
        }
    }

    #[test]
    fn a_panic_is_a_harness_error_of_its_case_only() {
        let cases = crate::judge::codec_cases();
        let terms =
            JudgementOptions { seed: 1, subject: CaseSubject::Codec, edition: None, strict: true };
        let judged = judge(&mut PanickingTestee(CodecTestee::default()), cases, terms);
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
