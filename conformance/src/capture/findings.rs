//! The cases of captured traffic and their checks.

use std::collections::BTreeSet;
use std::fmt::{self, Display};
use std::net::SocketAddr;

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;
use ads_cnc_vectors::requirements;

use super::frames::Span;
use super::time::Time;
use crate::exchange::Exchange;
use crate::judge::{
    Body, Case, CaseOutcome, CaseSubject, Checks, Describe, Evidence, Needs, Record, Rule, Rules,
    Stop, Verdict,
};

/// Declares [`Topic`].
macro_rules! topics {
    ($( $topic:ident: $subject:ident, $id:literal, $title:literal, [$($requirement:literal),*] $(of $area:literal)?; )+) => {
        /// A case of captured traffic.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Topic { $( $topic, )+ }

        impl Topic {
            const ALL: &'static [Self] = &[$( Self::$topic, )+];

            fn case(self) -> Case {
                match self { $(
                    Self::$topic => {
                        let requirements = vec![$($requirement),*];
                        $( let requirements = of_area($area, CaseSubject::$subject, requirements); )?
                        Case {
                            id: $id.to_owned(),
                            title: $title.to_owned(),
                            subject: CaseSubject::$subject,
                            requirements,
                            needs: Needs::Frames,
                            body: Body::Traffic,
                        }
                    }
                )+ }
            }
        }
    };
}

topics! {
    ClientFrames: CapturedClient, "cap-client-frames",
        "Every request has the headers of a request", ["ADS-5"];
    ClientServices: CapturedClient, "cap-client-services",
        "Every request has what its service takes, and no more", ["ADS-1", "ADS-2", "ADS-3"];
    ClientPorts: CapturedClient, "cap-client-ports",
        "Every function is asked at the port of its task", ["GEN-4"];
    ClientCom: CapturedClient, "cap-client-com",
        "Requests for objects are as their function takes them", ["COM-3"] of "COM";
    ClientSda: CapturedClient, "cap-client-sda",
        "Requests for instances and elements are as their function takes them", [] of "SDA";
    ClientDyn: CapturedClient, "cap-client-dyn",
        "Requests for dynamic parameters are as their function takes them", [] of "DYN";
    ClientVar: CapturedClient, "cap-client-var",
        "Requests for variables are as their function takes them", ["VAR-20", "VAR-24"] of "VAR";
    ClientStream: CapturedClient, "cap-client-stream",
        "What is streamed is whole lines, and refused data comes again",
        ["STM-6", "STM-7", "STM-8", "STM-10", "STM-20"] of "STM";
    ClientService: CapturedClient, "cap-client-service",
        "A service answers what it was asked, in the order of the interface",
        ["SVC-1", "SVC-2", "SVC-4", "SVC-5", "SVC-12"];
    CncFrames: CapturedCnc, "cap-cnc-frames",
        "Every reply has the headers of the answer to its request", ["ADS-5", "ADS-6"];
    CncServices: CapturedCnc, "cap-cnc-services",
        "Every reply has what its service gives, and no more than was asked for",
        ["ADS-1", "ADS-2", "ADS-3", "ADS-4"];
    CncCom: CapturedCnc, "cap-cnc-com",
        "Numbers, descriptors and contents of objects hold together",
        ["GEN-5", "COM-3"] of "COM";
    CncSda: CapturedCnc, "cap-cnc-sda",
        "Instances, elements and their attributes hold together",
        ["SDA-2", "ADR-5", "ADR-7", "GEN-5"] of "SDA";
    CncDyn: CapturedCnc, "cap-cnc-dyn",
        "Dynamic parameters hold together", ["DYN-5"] of "DYN";
    CncVar: CapturedCnc, "cap-cnc-var",
        "Numbers, descriptions, handles and values of variables hold together",
        [
            "VAR-1", "VAR-3", "VAR-7", "VAR-8", "VAR-9", "VAR-11", "VAR-14", "VAR-16", "VAR-17",
            "VAR-18", "VAR-20", "VAR-24", "VAR-25", "GEN-1", "GEN-3"
        ] of "VAR";
    CncStream: CapturedCnc, "cap-cnc-stream",
        "The stream takes what it has to, and no more", ["STM-2", "STM-5"];
    CncService: CapturedCnc, "cap-cnc-service",
        "The variables of the Service Interface are of their types, and follow one another",
        ["SVC-1", "SVC-3"];
}

impl Topic {
    pub(super) fn of_request(function: Function) -> Self {
        match function.spec().clause.get(..3) {
            Some("COM") => Self::ClientCom,
            Some("SDA") => Self::ClientSda,
            Some("DYN") => Self::ClientDyn,
            Some("STM") => Self::ClientStream,
            _ => Self::ClientVar,
        }
    }

    /// The topic of replies of a function.
    pub(super) fn of_reply(function: Function) -> Self {
        match function.spec().clause.get(..3) {
            Some("COM") => Self::CncCom,
            Some("SDA") => Self::CncSda,
            Some("DYN") => Self::CncDyn,
            Some("STM") => Self::CncStream,
            _ => Self::CncVar,
        }
    }
}

/// The requirements that the function table and the field tables name for an area.
fn of_area(area: &str, subject: CaseSubject, also: Vec<&'static str>) -> Vec<&'static str> {
    let mut all = also;
    for spec in Function::ALL.iter().map(|function| function.spec()) {
        if !spec.clause.starts_with(area) {
            continue;
        }
        let stream = if subject == CaseSubject::CapturedClient { spec.request } else { spec.reply };
        all.push(spec.clause);
        all.extend(stream.into_iter().flat_map(clauses));
    }
    // Only IDs of the catalogue, in its order.
    let all: BTreeSet<&str> = all.into_iter().collect();
    requirements().iter().filter_map(|known| all.get(known.id.as_str()).copied()).collect()
}

/// The requirements of a stream and its fields.
fn clauses(stream: Stream) -> impl Iterator<Item = &'static str> {
    let layout = stream.layout();
    layout.fields.iter().map(|field| field.clause).chain([layout.clause])
}

/// Where in the capture a frame was seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Location {
    pub(super) from: SocketAddr,
    pub(super) to: SocketAddr,
    pub(super) asked: Option<Span>,
    pub(super) answered: Option<Span>,
}

impl Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let packets = |f: &mut fmt::Formatter<'_>, span: Span| {
            match (span.first.packet, span.last.packet) {
                (first, last) if first == last => write!(f, "packet {first}")?,
                (first, last) => write!(f, "packets {first} to {last}")?,
            }
            span.last.time.map_or(Ok(()), |time| write!(f, " at {time}"))
        };
        if let Some(asked) = self.asked {
            packets(f, asked)?;
        }
        if let Some(answered) = self.answered {
            f.write_str(if self.asked.is_some() { ", answered in " } else { "" })?;
            packets(f, answered)?;
        }
        let is_known = self.asked.or(self.answered).is_some();
        write!(f, "{}{} to {}", if is_known { ", " } else { "" }, self.from, self.to)
    }
}

/// The frames that a check is about.
#[derive(Debug)]
pub(super) enum Observation<'e> {
    /// A request, and its reply if one was captured.
    Exchange(&'e Exchange, Location),
    /// Bytes that are not a frame, or not a complete one.
    Bytes(&'e [u8], Location),
}

impl Observation<'_> {
    /// When the request was sent.
    pub(super) fn time(&self) -> Option<Time> {
        let (Self::Exchange(_, location) | Self::Bytes(_, location)) = self;
        location.asked?.last.time
    }

    fn evidence(&self) -> Evidence {
        match self {
            Self::Exchange(exchange, location) => {
                let evidence = Evidence::from(*exchange);
                Evidence { call: format!("{}\n            {location}", evidence.call), ..evidence }
            }
            Self::Bytes(bytes, location) => {
                Evidence { call: location.to_string(), sent: bytes.to_vec(), ..Evidence::default() }
            }
        }
    }
}

/// The records of all cases.
#[derive(Debug)]
pub(super) struct TopicRecords {
    records: Vec<(Case, Record, Vec<String>)>,
}

impl TopicRecords {
    pub(super) fn new() -> Self {
        let records = Topic::ALL.iter().map(|topic| (topic.case(), Record::default(), Vec::new()));
        Self { records: records.collect() }
    }

    /// Where the checks of a topic are recorded.
    pub(super) fn on<'b>(
        &'b mut self,
        topic: Topic,
        observation: &'b Observation<'b>,
    ) -> TopicRecord<'b> {
        let place = Topic::ALL.iter().position(|one| *one == topic).unwrap_or(0);
        TopicRecord { topic: self.records.get_mut(place), observation }
    }

    /// Adds a note for the reader to a case.
    pub(super) fn note(&mut self, topic: Topic, note: impl Into<String>) {
        let place = Topic::ALL.iter().position(|one| *one == topic).unwrap_or(0);
        if let Some((.., notes)) = self.records.get_mut(place) {
            notes.push(note.into());
        }
    }

    pub(super) fn finish(self) -> Vec<CaseOutcome> {
        let outcomes = self.records.into_iter().map(|(case, record, notes)| {
            let Record { judgements, checks } = record;
            let outcome = CaseOutcome::tried(case, judgements, checks, None::<Stop>);
            let note = (!notes.is_empty()).then(|| notes.join("; "));
            CaseOutcome { note: note.or(outcome.note), ..outcome }
        });
        outcomes.collect()
    }
}

/// The record of a case, and the frames that its next checks are about.
#[derive(Debug)]
pub(super) struct TopicRecord<'b> {
    topic: Option<&'b mut (Case, Record, Vec<String>)>,
    observation: &'b Observation<'b>,
}

impl TopicRecord<'_> {
    /// Records an inconclusive check: the bytes it needs were not captured.
    pub(super) fn open(&mut self, rule: impl Into<Rule>, found: impl Describe) {
        if let Some((_, record, _)) = &mut self.topic {
            let (verdict, expected) = (Verdict::Inconclusive, "all of it in the capture");
            let evidence = || Some(self.observation.evidence());
            record.add(rule.into(), verdict, expected, found, evidence);
        }
    }

    /// Whether this requirement is one of the case.
    pub(super) fn knows(&self, requirement: &str) -> bool {
        self.topic.as_ref().is_some_and(|(case, ..)| case.requirements.contains(&requirement))
    }

    /// Records a check that passed.
    pub(super) fn pass(&mut self, rule: impl Into<Rule>) {
        self.check(rule.into(), true, "", "");
    }
}

impl Checks for TopicRecord<'_> {
    fn check(
        &mut self,
        rules: impl Rules,
        kept: bool,
        expected: impl Describe,
        found: impl Describe,
    ) -> bool {
        if let Some((_, record, _)) = &mut self.topic {
            record.add_all(rules, kept, expected, found, || Some(self.observation.evidence()));
        }
        kept
    }
}
