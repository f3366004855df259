//! The cases of captured traffic and their checks.

use std::collections::BTreeSet;
use std::fmt::{self, Display};
use std::net::SocketAddr;

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::requirements;

use super::frames::Span;
use super::time::Time;
use crate::exchange::Exchange;
use crate::judge::{
    Body, Case, CaseOutcome, CaseSubject, Checks, Describe, Evidence, Needs, Record, Rule, Rules,
    Stop, Verdict,
};

/// Declares [`TrafficCase`].
macro_rules! traffic_cases {
    ($( $case:ident: $subject:ident, $id:literal, $title:literal, [$($requirement:expr),*] $(of $area:literal)?; )+) => {
        /// A case of captured traffic.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum TrafficCase { $( $case, )+ }

        impl TrafficCase {
            const ALL: &'static [Self] = &[$( Self::$case, )+];

            fn case(self) -> Case {
                match self { $(
                    Self::$case => {
                        let requirements = vec![$(Rule::from($requirement).id),*];
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

traffic_cases! {
    ClientFrames: CapturedClient, "cap-client-frames",
        "Every request has the headers of a request", [ADS_5];
    ClientServices: CapturedClient, "cap-client-services",
        "Every request has what its service takes, and no more", [ADS_1, ADS_2, ADS_3];
    ClientPorts: CapturedClient, "cap-client-ports",
        "Every function is asked at the port of its task", [GEN_4];
    ClientCom: CapturedClient, "cap-client-com",
        "Requests for objects are as their function takes them", [COM_3] of "COM";
    ClientSda: CapturedClient, "cap-client-sda",
        "Requests for instances and elements are as their function takes them", [] of "SDA";
    ClientDyn: CapturedClient, "cap-client-dyn",
        "Requests for dynamic parameters are as their function takes them", [] of "DYN";
    ClientVar: CapturedClient, "cap-client-var",
        "Requests for variables are as their function takes them", [VAR_20, VAR_24] of "VAR";
    ClientStream: CapturedClient, "cap-client-stream",
        "What is streamed is whole lines, and refused data comes again",
        [STM_6, STM_7, STM_8, STM_10, STM_20] of "STM";
    ClientService: CapturedClient, "cap-client-service",
        "A service answers what it was asked, in the order of the interface",
        [SVC_1, SVC_2, SVC_4, SVC_5, SVC_12];
    CncFrames: CapturedCnc, "cap-cnc-frames",
        "Every reply has the headers of the answer to its request", [ADS_5, ADS_6];
    CncServices: CapturedCnc, "cap-cnc-services",
        "Every reply has what its service gives, and no more than was asked for",
        [ADS_1, ADS_2, ADS_3, ADS_4];
    CncCom: CapturedCnc, "cap-cnc-com",
        "Numbers, descriptors and contents of objects hold together",
        [GEN_5, COM_3] of "COM";
    CncSda: CapturedCnc, "cap-cnc-sda",
        "Instances, elements and their attributes hold together",
        [SDA_2, ADR_5, ADR_7, GEN_5] of "SDA";
    CncDyn: CapturedCnc, "cap-cnc-dyn",
        "Dynamic parameters hold together", [DYN_5] of "DYN";
    CncVar: CapturedCnc, "cap-cnc-var",
        "Numbers, descriptions, handles and values of variables hold together",
        [
            VAR_1, VAR_3, VAR_7, VAR_8, VAR_9, VAR_11, VAR_14, VAR_16, VAR_17,
            VAR_18, VAR_20, VAR_24, VAR_25, GEN_1, GEN_3
        ] of "VAR";
    CncStream: CapturedCnc, "cap-cnc-stream",
        "The stream takes what it has to, and no more", [STM_2, STM_5];
    CncService: CapturedCnc, "cap-cnc-service",
        "The variables of the Service Interface are of their types, and follow one another",
        [SVC_1, SVC_3];
}

impl TrafficCase {
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
pub(super) struct CaseRecords {
    records: Vec<(Case, Record, Vec<String>)>,
}

impl CaseRecords {
    pub(super) fn new() -> Self {
        let records =
            TrafficCase::ALL.iter().map(|case| (case.case(), Record::default(), Vec::new()));
        Self { records: records.collect() }
    }

    /// Where the checks of a topic are recorded.
    pub(super) fn on<'b>(
        &'b mut self,
        case: TrafficCase,
        observation: &'b Observation<'b>,
    ) -> CaseRecord<'b> {
        let place = TrafficCase::ALL.iter().position(|one| *one == case).unwrap_or(0);
        CaseRecord { case: self.records.get_mut(place), observation }
    }

    /// Adds a note for the reader to a case.
    pub(super) fn note(&mut self, case: TrafficCase, note: impl Into<String>) {
        let place = TrafficCase::ALL.iter().position(|one| *one == case).unwrap_or(0);
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
pub(super) struct CaseRecord<'b> {
    case: Option<&'b mut (Case, Record, Vec<String>)>,
    observation: &'b Observation<'b>,
}

impl CaseRecord<'_> {
    /// Records an inconclusive check: the bytes it needs were not captured.
    pub(super) fn open(&mut self, rule: impl Into<Rule>, found: impl Describe) {
        if let Some((_, record, _)) = &mut self.case {
            let (verdict, expected) = (Verdict::Inconclusive, "all of it in the capture");
            let evidence = || Some(self.observation.evidence());
            record.add(rule.into(), verdict, expected, found, evidence);
        }
    }

    /// Whether this requirement is one of the case.
    pub(super) fn knows(&self, requirement: &str) -> bool {
        self.case.as_ref().is_some_and(|(case, ..)| case.requirements.contains(&requirement))
    }

    /// Records a check that passed.
    pub(super) fn pass(&mut self, rule: impl Into<Rule>) {
        self.check(rule.into(), true, "", "");
    }
}

impl Checks for CaseRecord<'_> {
    fn check(
        &mut self,
        rules: impl Rules,
        passed: bool,
        expected: impl Describe,
        found: impl Describe,
    ) -> bool {
        if let Some((_, record, _)) = &mut self.case {
            record.add_all(rules, passed, expected, found, || Some(self.observation.evidence()));
        }
        passed
    }
}
