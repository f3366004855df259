//! A scenario: an action, the requests that the client must send, and the answer that it must
//! return.

use ads_cnc::ads::AdsError;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;
use serde_json::Value;

use super::Action;
use super::literal::Literal;
use super::script::ScenarioScript;
use super::tamper::Tamper;
use crate::judge::{Body, Case, CaseSubject, Needs, Rule};

/// A request that a client must send, in raw bytes, independent of the codec.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ExpectedRequest {
    /// The number of the command: 2 Read, 3 Write, 9 ReadWrite.
    pub(super) command: u16,
    pub(super) port: u16,
    pub(super) group: u32,
    pub(super) offset: u32,
    pub(super) data: Vec<u8>,
    /// The read lengths that the client may choose.
    pub(super) length: ReadLength,
    /// Other data that is as correct as `data`.
    pub(super) also: Vec<Vec<u8>>,
    /// Data that violates only an assumption about `data`, not a clause of the manuals.
    pub(super) tolerated: Vec<Vec<u8>>,
    /// The requirement of the function, which the index group and offset must satisfy.
    pub(super) place: Rule,
    pub(super) stream: Rule,
}

/// The permitted read lengths of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ReadLength {
    AtLeast(u32),
    /// A positive multiple of this number.
    Times(u32),
}

impl ExpectedRequest {
    pub(super) fn of(mut self, place: impl Into<Rule>, stream: impl Into<Rule>) -> Self {
        (self.place, self.stream) = (place.into(), stream.into());
        self
    }

    pub(super) fn also(mut self, data: &[u8]) -> Self {
        self.also.push(data.to_vec());
        self
    }

    pub(super) fn tolerating(mut self, data: &[u8]) -> Self {
        self.tolerated.push(data.to_vec());
        self
    }

    /// The requirement that specifies the index group.
    pub(super) const fn group_rule(&self) -> ClauseId {
        let table = self.group & 0xF00;
        match self.group & 0xFF_FF00 {
            0x13_0100 | 0x13_0200 => ADR_4,
            0x12_0100 | 0x12_0200 => ADR_3,
            _ if table == 0x900 => SDA_1,
            _ if self.group & 0xF000 == 0x5000 => ADR_2,
            _ if table != 0x300 => ADR_6,
            _ => ADR_5,
        }
    }

    pub(super) const fn service_rule(&self) -> ClauseId {
        match self.command {
            2 => ADS_1,
            3 => ADS_2,
            _ => ADS_3,
        }
    }
}

const fn ask(
    command: u16,
    port: u16,
    group: u32,
    offset: u32,
    data: Vec<u8>,
    least: u32,
) -> ExpectedRequest {
    ExpectedRequest {
        command,
        port,
        group,
        offset,
        data,
        length: ReadLength::AtLeast(least),
        also: Vec::new(),
        tolerated: Vec::new(),
        place: Rule::CLIENT,
        stream: Rule::CLIENT,
    }
}

/// A Read of at least `least` bytes.
pub(super) const fn read(port: u16, group: u32, offset: u32, least: u32) -> ExpectedRequest {
    ask(2, port, group, offset, Vec::new(), least)
}

/// A ReadWrite of at least `least` bytes at the port of SDA.
pub(super) fn both(group: u32, offset: u32, data: &[u8], least: u32) -> ExpectedRequest {
    ask(9, 552, group, offset, data.to_vec(), least)
}

pub(super) fn write(port: u16, group: u32, offset: u32, data: &[u8]) -> ExpectedRequest {
    ask(3, port, group, offset, data.to_vec(), 0)
}

/// The answer that a client must return.
#[derive(Clone, Debug)]
pub(super) enum ExpectedAnswer {
    /// This result.
    Result(Value),
    /// The result according to the unchanged replies of the simulated CNC.
    Asked(fn(&ScenarioScript) -> Option<Value>),
    /// Any result.
    Done,
    /// An error.
    Error,
}

/// The rules for the order of the requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RequestOrder {
    /// The client sends the whole program in packets.
    Stream,
    /// The client sends no part of a program that cannot be streamed because of this clause.
    NoStream(ClauseId),
    /// The client acts as a service, and answers the request of the NC program.
    Host,
    /// The client acts as a service that no NC program requests, and must not write.
    IdleHost,
    /// The client acts as the NC program, and reads and writes the variables in the specified
    /// order.
    Caller,
}

/// An action, and how the client's requests and answer are judged.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// The ID, which is never used again for another behaviour.
    pub id: String,
    /// The verified behaviour, as a sentence; for a changed reply, the action and the change; for a
    /// printed example, the title of its vector.
    pub title: String,
    /// The action with its arguments; for `stream`, the suite appends the file name.
    pub(super) action: String,
    pub(super) asks: Vec<ExpectedRequest>,
    pub(super) expect: ExpectedAnswer,
    /// Whether the client may return an error instead of the expected answer.
    pub(super) or_error: bool,
    /// The rules that the client's answer must satisfy; if empty, the method `rules` has a default.
    pub(super) rules: Vec<Rule>,
    /// Further requirements that the scenario tests.
    pub(super) more: Vec<ClauseId>,
    pub(super) tamper: Option<(Function, Tamper)>,
    pub(super) rejections: Vec<(usize, AdsError)>,
    pub(super) literal: Option<Literal>,
    pub(super) response: Option<&'static str>,
    pub(super) prepare: Option<fn(&ScenarioScript)>,
    pub(super) watch: Option<RequestOrder>,
    pub(super) program: Option<Vec<u8>>,
}

impl Scenario {
    pub(super) fn new(
        id: impl Into<String>,
        title: impl Into<String>,
        action: impl Into<String>,
    ) -> Self {
        Self {
            id: id.into(),
            title: title.into(),
            action: action.into(),
            asks: Vec::new(),
            expect: ExpectedAnswer::Done,
            or_error: false,
            rules: Vec::new(),
            more: Vec::new(),
            tamper: None,
            rejections: Vec::new(),
            literal: None,
            response: None,
            prepare: None,
            watch: None,
            program: None,
        }
    }

    pub(super) fn asks(mut self, ask: ExpectedRequest) -> Self {
        self.asks.push(ask);
        self
    }

    pub(super) fn expect(mut self, expect: ExpectedAnswer) -> Self {
        self.expect = expect;
        self
    }

    pub(super) fn gives(self, result: impl Into<Value>) -> Self {
        self.expect(ExpectedAnswer::Result(result.into()))
    }

    pub(super) fn by(mut self, rule: impl Into<Rule>) -> Self {
        self.rules.push(rule.into());
        self
    }

    pub(super) fn with(mut self, at: Function, tamper: Tamper) -> Self {
        self.tamper = Some((at, tamper));
        self
    }

    pub(super) fn ordered(mut self, watch: RequestOrder, more: &[ClauseId]) -> Self {
        self.watch = Some(watch);
        self.more.extend(more);
        self
    }

    /// The rules for the client's answer; by default, the requirement of the first request or,
    /// without a request, `CLIENT`.
    pub(super) fn rules(&self) -> Vec<Rule> {
        match (self.rules.as_slice(), self.asks.first()) {
            ([], Some(ask)) => vec![ask.place],
            ([], None) => vec![Rule::CLIENT],
            (rules, _) => rules.to_vec(),
        }
    }

    /// The scenario as a case of the suite.
    pub fn case(&self) -> Case {
        // A client that must not stream a program perhaps sends no request: then the requirements
        // of frames and ports are not tested.
        let silent = matches!(self.watch, Some(RequestOrder::NoStream(_)));
        let mut requirements =
            if silent { Vec::new() } else { vec![ADS_5.as_str(), GEN_4.as_str()] };
        requirements.extend(self.rules().iter().map(|rule| rule.id));
        for ask in &self.asks {
            requirements.extend([ask.service_rule().as_str(), ask.group_rule().as_str()]);
            requirements.push(ask.place.id);
            requirements.extend((!ask.data.is_empty()).then_some(ask.stream.id));
            requirements
                .extend(matches!(ask.length, ReadLength::Times(_)).then_some(COM_3.as_str()));
        }
        requirements.extend(self.more.iter().map(|id| id.as_str()));
        let mut seen = Vec::new();
        requirements.retain(|id| {
            let new = !seen.contains(id);
            seen.push(*id);
            new
        });
        Case {
            id: self.id.clone(),
            title: self.title.clone(),
            subject: CaseSubject::Client,
            requirements,
            needs: Needs::Queries,
            body: Body::Client,
        }
    }

    /// The action, with the file name of the program appended, if any; `None` if the action is not
    /// in the vocabulary.
    pub(super) fn action_with(&self, file: Option<&str>) -> Option<Action> {
        match file {
            Some(file) => Action::parse(&format!("{} {file}", self.action)),
            None => Action::parse(&self.action),
        }
    }
}
