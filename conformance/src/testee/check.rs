//! Tries the steps of the testee protocol and explains what fails, for the author of an adapter.

use ads_cnc_vectors::{Expect, Vector, vector};

use super::describe::describe;
use super::plan::{forms, of_vector};
use super::{Testee, TesteeProcess, TesteeReaction, compare};
use crate::codec::message::{Answer, Capabilities, Output, Question};
use crate::text::{escape, hex::compact};

/// The result of one step of the protocol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProtocolStepResult {
    pub what: String,
    pub sent: Option<String>,
    pub received: Option<String>,
    /// What is wrong and, for most steps, what is expected; `None` if the step passed.
    pub fault: Option<String>,
}

/// The IDs of the vectors to try, of which those whose stream the testee claims are used.
const SAMPLES: [&str; 8] = [
    "handle-printed",
    "object-count",
    "description-printed-boolean-array",
    "name-printed-vartest",
    "value-printed-handle-element",
    "dynamic-value-printed",
    "content-boolean-2",
    "descriptor-printed",
];

/// The edition in the questions. The samples are the same in both editions.
const EDITION: &str = "en-1.05";

/// Tries the steps of the protocol with a testee, except for the ops `packets` and `check`. After
/// the deadline of the testee, the results of further steps are not returned.
pub fn check_protocol(process: &mut TesteeProcess) -> Vec<ProtocolStepResult> {
    let mut steps = Steps { process, findings: Vec::new() };
    let hello = steps.process.hello();
    let capabilities = match hello {
        Ok(hello) => {
            steps.note("hello is answered", None);
            hello.capabilities
        }
        Err(reaction) => {
            let hint = r#"an answer such as {"protocol":1,"testee":{"name":"…"},"capabilities":{"ops":["decode"],"streams":["object-count"],"editions":["en-1.05"]}} is expected"#;
            steps.note("hello is answered", Some(format!("{}; {hint}", describe(&reaction))));
            return steps.findings;
        }
    };
    steps.capabilities(&capabilities);
    let claimed = SAMPLES.into_iter().filter_map(vector);
    let claimed: Vec<&Vector> =
        claimed.filter(|vector| capabilities.streams.contains(&vector.stream)).collect();
    if claimed.is_empty() {
        let streams: Vec<&str> =
            SAMPLES.into_iter().filter_map(vector).map(|vector| vector.stream.as_str()).collect();
        let fault = format!(
            "none of the streams {} is claimed, so no request can be tried",
            streams.join(", ")
        );
        steps.note("a stream to try", Some(fault));
    }
    for vector in &claimed {
        steps.decode(vector, &capabilities);
        steps.encode(vector, &capabilities);
    }
    if let Some(vector) = claimed.first() {
        steps.cut(vector, &capabilities);
    }
    steps.unknown("an unknown op", "melt", "object-count");
    steps.unknown("an unknown stream", "decode", "no-such-stream");
    let running = steps.process.ensure_running().map_err(|reaction| describe(&reaction));
    let end = running.and_then(|()| steps.process.bye());
    steps.note("bye ends it with exit code 0", end.err());
    steps.findings
}

struct Steps<'p> {
    process: &'p mut TesteeProcess,
    findings: Vec<ProtocolStepResult>,
}

impl Steps<'_> {
    fn note(&mut self, what: impl Into<String>, fault: Option<String>) {
        if self.process.over().is_some() {
            return;
        }
        let (sent, received) = self.process.last();
        let [sent, received, fault] =
            [sent, received, fault].map(|text| text.map(|text| escape(&text)));
        self.findings.push(ProtocolStepResult { what: what.into(), sent, received, fault });
    }

    fn capabilities(&mut self, capabilities: &Capabilities) {
        let fault = match capabilities.misspelt() {
            _ if capabilities.ops.is_empty() => Some("no op is claimed".to_owned()),
            misspelt => misspelt,
        };
        self.note("ops and streams are those of the protocol", fault);
    }

    fn ask(&mut self, question: &Question) -> Result<Output, TesteeReaction> {
        match self.process.ask(question) {
            TesteeReaction::Answer(Answer::Ok(output)) => Ok(output),
            other => Err(other),
        }
    }

    fn decode(&mut self, vector: &Vector, capabilities: &Capabilities) {
        let Expect::Accept(accept) = &vector.expect else { return };
        if !capabilities.claim("decode", &vector.stream) {
            return;
        }
        let Some(question) = question_of("decode", vector) else { return };
        let fault = match self.ask(&question) {
            Ok(Output { value: Some(value), .. }) => {
                match compare::compare(&accept.value, &value) {
                    Some(compare::Difference::Other(what)) => Some(what),
                    _ => None,
                }
            }
            Ok(_) => Some("ok without value".to_owned()),
            Err(reaction) => Some(describe(&reaction)),
        };
        self.note(format!("{} is decoded", vector.stream), fault);
    }

    fn encode(&mut self, vector: &Vector, capabilities: &Capabilities) {
        let Expect::Accept(accept) = &vector.expect else { return };
        if !capabilities.claim("encode", &vector.stream) {
            return;
        }
        let Some(question) = question_of("encode", vector) else { return };
        let fault = match self.ask(&question) {
            Ok(Output { hex: Some(hex), .. }) => {
                let right = forms(vector, accept).contains(&hex);
                (!right).then(|| format!("{} is expected", compact::show(&vector.bytes())))
            }
            Ok(_) => Some("ok without hex".to_owned()),
            Err(reaction) => Some(describe(&reaction)),
        };
        self.note(format!("{} is encoded", vector.stream), fault);
    }

    /// Checks that the testee rejects a stream that is one byte too short.
    fn cut(&mut self, vector: &Vector, capabilities: &Capabilities) {
        if !capabilities.claim("decode", &vector.stream) {
            return;
        }
        let mut bytes = vector.bytes();
        bytes.pop();
        let Some(question) = question_of("decode", vector) else { return };
        let question = Question { hex: Some(bytes), ..question };
        let fault = match self.process.ask(&question) {
            TesteeReaction::Answer(Answer::Reject(_)) => None,
            other => {
                let hint = r#"{"seq":…,"reject":{"class":"truncated"}} is expected"#;
                Some(format!("{}; {hint}", describe(&other)))
            }
        };
        self.note(format!("{} without its last byte is rejected", vector.stream), fault);
    }

    fn unknown(&mut self, what: &str, op: &str, stream: &str) {
        let blank = Question::new(op, stream, EDITION);
        let blank = Question { hex: Some(vec![1, 0, 0, 0]), ..blank };
        let fault = match self.process.ask(&blank) {
            TesteeReaction::Answer(Answer::Unsupported { .. }) => None,
            other => {
                let hint = r#"{"seq":…,"unsupported":{"what":"…"}} is expected"#;
                Some(format!("{}; {hint}", describe(&other)))
            }
        };
        self.note(format!("{what} is unsupported"), fault);
    }
}

/// The question for a vector with this op (`decode` or `encode`); `None` if the vector has none.
fn question_of(op: &str, vector: &Vector) -> Option<Question> {
    of_vector(vector, EDITION).into_iter().find(|question| question.op == op)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_sample_is_a_vector() {
        assert!(SAMPLES.into_iter().all(|id| vector(id).is_some()));
    }
}
