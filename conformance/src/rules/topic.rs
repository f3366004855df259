//! The topics of the checks, each of which is a case, and their records.

use std::collections::BTreeSet;
use std::fmt::Display;

use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::requirements;

use super::observation::Observation;
use crate::evidence::{Describe, Evidence};
use crate::judge::{
    Body, Case, CaseOutcome, CaseSubject, Checks, Needs, Record, Rule, Rules, Verdict, clauses_of,
};

/// Declares [`Topic`].
macro_rules! traffic_cases {
    ($( $case:ident: $subject:ident, $id:literal, $title:literal, [$($requirement:expr),*] $(of $area:literal)?; )+) => {
        /// The topic of a check, which is a case of captured traffic.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Topic { $( $case, )+ }

        impl Topic {
            const ALL: &'static [Self] = &[$( Self::$case, )+];

            const fn subject(self) -> CaseSubject {
                match self { $( Self::$case => CaseSubject::$subject, )+ }
            }

            fn case(self) -> Case {
                let (id, title, requirements) = match self { $(
                    Self::$case => {
                        let requirements = vec![$(Rule::from($requirement).id),*];
                        $( let requirements = of_area($area, CaseSubject::$subject, requirements); )?
                        ($id, $title, requirements)
                    }
                )+ };
                Case {
                    id: id.to_owned(),
                    title: title.to_owned(),
                    subject: self.subject(),
                    requirements,
                    needs: Needs::Frames,
                    body: Body::Traffic,
                }
            }
        }
    };
}

traffic_cases! {
    ClientFrames: CapturedClient, "cap-client-frames",
        "Every request has valid request headers", [ADS_5];
    ClientServices: CapturedClient, "cap-client-services",
        "Every request has exactly the data that its service requires", [ADS_1, ADS_2, ADS_3];
    ClientPorts: CapturedClient, "cap-client-ports",
        "Every function is called at the port of its task", [GEN_4];
    ClientCom: CapturedClient, "cap-client-com",
        "Requests for objects match the layout of their function", [COM_3] of "COM";
    ClientSda: CapturedClient, "cap-client-sda",
        "Requests for instances and elements match the layout of their function", [] of "SDA";
    ClientDyn: CapturedClient, "cap-client-dyn",
        "Requests for dynamic parameters match the layout of their function", [] of "DYN";
    ClientVar: CapturedClient, "cap-client-var",
        "Requests for variables match the layout of their function", [VAR_20, VAR_24] of "VAR";
    ClientStream: CapturedClient, "cap-client-stream",
        "The client streams whole lines and sends rejected data again",
        [STM_6, STM_7, STM_8, STM_10, STM_20] of "STM";
    ClientService: CapturedClient, "cap-client-service",
        "A service answers its requests in the order of the Service Interface",
        [SVC_1, SVC_2, SVC_4, SVC_5, SVC_12];
    CncFrames: CapturedCnc, "cap-cnc-frames",
        "Every reply has the headers that belong to its request", [ADS_5, ADS_6];
    CncServices: CapturedCnc, "cap-cnc-services",
        "Every reply has the data of its service, and at most the requested length",
        [ADS_1, ADS_2, ADS_3, ADS_4];
    CncCom: CapturedCnc, "cap-cnc-com",
        "Numbers, descriptors and contents of objects are consistent",
        [GEN_5, COM_3] of "COM";
    CncSda: CapturedCnc, "cap-cnc-sda",
        "Instances, elements and their attributes are consistent",
        [SDA_2, SDA_3, ADR_2, ADR_5, ADR_7, GEN_5] of "SDA";
    CncDyn: CapturedCnc, "cap-cnc-dyn",
        "Dynamic parameters are consistent", [DYN_5] of "DYN";
    CncVar: CapturedCnc, "cap-cnc-var",
        "Numbers, descriptions, handles and values of variables are consistent",
        [
            VAR_1, VAR_3, VAR_7, VAR_8, VAR_9, VAR_11, VAR_14, VAR_16, VAR_17,
            VAR_18, VAR_20, VAR_24, VAR_25, GEN_1, GEN_3
        ] of "VAR";
    CncStream: CapturedCnc, "cap-cnc-stream",
        "The stream accepts valid packets and rejects packets that are too long", [STM_2, STM_5];
    CncService: CapturedCnc, "cap-cnc-service",
        "The variables of the Service Interface have their types and change in order",
        [SVC_1, SVC_3];
}

impl Topic {
    /// The topics of requests and of replies whose function or field has this clause.
    pub(super) fn of_clause(clause: &str) -> (Self, Self) {
        match clause.get(..3) {
            Some("COM") => (Self::ClientCom, Self::CncCom),
            Some("SDA") => (Self::ClientSda, Self::CncSda),
            Some("DYN") => (Self::ClientDyn, Self::CncDyn),
            Some("STM") => (Self::ClientStream, Self::CncStream),
            _ => (Self::ClientVar, Self::CncVar),
        }
    }

    /// The topic of requests of a function.
    pub(crate) fn of_request(function: Function) -> Self {
        Self::of_clause(function.spec().clause).0
    }

    /// The topic of replies of a function.
    pub(crate) fn of_reply(function: Function) -> Self {
        Self::of_clause(function.spec().clause).1
    }
}

/// The cases of captured traffic.
pub(crate) fn captured_cases() -> impl Iterator<Item = Case> {
    Topic::ALL.iter().map(|topic| topic.case())
}

/// The cases that judge the replies in a run against a target. The case `ads-every-frame` judges
/// the headers of these replies.
pub(crate) fn reply_cases() -> impl Iterator<Item = Case> {
    let replies = Topic::ALL.iter().filter(|topic| topic.subject() == CaseSubject::CapturedCnc);
    let replies = replies.filter(|topic| **topic != Topic::CncFrames).map(|topic| topic.case());
    replies.map(|case| Case { id: reply_case_id(&case.id), subject: CaseSubject::Target, ..case })
}

/// The ID of the case of a run that corresponds to a case of captured replies.
fn reply_case_id(captured: &str) -> String {
    captured.replacen("cap-cnc", "replies", 1)
}

/// The requirements in `also`, and those that the function table and the field tables name for the
/// functions of an area: for their requests if `subject` is a client, otherwise for their replies.
fn of_area(area: &str, subject: CaseSubject, also: Vec<&'static str>) -> Vec<&'static str> {
    let mut all = also;
    for spec in Function::ALL.iter().map(|function| function.spec()) {
        if !spec.clause.starts_with(area) {
            continue;
        }
        let stream = if subject == CaseSubject::CapturedClient { spec.request } else { spec.reply };
        all.push(spec.clause);
        all.extend(stream.into_iter().flat_map(clauses_of));
    }
    // Only IDs of the catalogue, in its order.
    let all: BTreeSet<&str> = all.into_iter().collect();
    requirements().iter().filter_map(|known| all.get(known.id.as_str()).copied()).collect()
}

/// The records of all topics.
#[derive(Debug)]
pub(crate) struct TopicRecords {
    records: Vec<(Case, Record, Vec<String>)>,
}

impl TopicRecords {
    pub(crate) fn new() -> Self {
        let records = Topic::ALL.iter().map(|case| (case.case(), Record::default(), Vec::new()));
        Self { records: records.collect() }
    }

    /// The record for the checks of a topic.
    pub(crate) fn on<'b>(
        &'b mut self,
        case: Topic,
        observation: &'b dyn Observation,
    ) -> TopicRecord<'b> {
        let place = Topic::ALL.iter().position(|one| *one == case).unwrap_or(0);
        TopicRecord { case: self.records.get_mut(place), observation, subject: None }
    }

    /// Adds a note to a case.
    pub(crate) fn note(&mut self, case: Topic, note: impl Into<String>) {
        let place = Topic::ALL.iter().position(|one| *one == case).unwrap_or(0);
        if let Some((.., notes)) = self.records.get_mut(place) {
            notes.push(note.into());
        }
    }

    /// The number of cases with a check whose verdict is fail.
    pub(crate) fn failed(&self) -> usize {
        let has_failed = |record: &Record| {
            record.judgements.iter().any(|judgement| judgement.verdict == Verdict::Fail)
        };
        self.records.iter().filter(|(_, record, _)| has_failed(record)).count()
    }

    /// Takes the record of the case with this ID, which is one of the [`reply_cases`].
    pub(crate) fn take_of_replies(&mut self, id: &str) -> Record {
        let mut all = self.records.iter_mut();
        let mine = all.find(|(case, ..)| reply_case_id(&case.id) == id);
        mine.map(|(_, record, _)| std::mem::take(record)).unwrap_or_default()
    }

    /// The record of all checks of requests.
    pub(crate) fn into_client_record(self) -> Record {
        let mut all = Record::default();
        let of_client = |case: &Case| case.subject == CaseSubject::CapturedClient;
        let records = self.records.into_iter().filter(|(case, ..)| of_client(case));
        records.for_each(|(_, record, _)| all.append(record));
        all
    }

    pub(crate) fn finish(self) -> Vec<CaseOutcome> {
        let outcomes = self.records.into_iter().map(|(case, record, notes)| {
            let outcome = CaseOutcome::tried(case, record, None);
            let note = (!notes.is_empty()).then(|| notes.join("; "));
            CaseOutcome { note: note.or(outcome.note), ..outcome }
        });
        outcomes.collect()
    }
}

/// The record of a case, and the frames that its next checks are about.
pub(crate) struct TopicRecord<'b> {
    case: Option<&'b mut (Case, Record, Vec<String>)>,
    observation: &'b dyn Observation,
    subject: Option<String>,
}

impl TopicRecord<'_> {
    /// Sets the variable or object that the following checks are about.
    pub(crate) fn about(&mut self, name: impl Display) {
        self.subject = Some(name.to_string());
    }

    /// Records an inconclusive check, because bytes that the check needs were not captured.
    pub(crate) fn open(&mut self, rule: impl Into<Rule>, found: impl Describe) {
        if let Some((_, record, _)) = &mut self.case {
            let (verdict, expected) = (Verdict::Inconclusive, "all its bytes in the capture");
            let evidence = || Some(self.observation.evidence());
            record.add(rule.into(), verdict, expected, found, evidence);
        }
    }

    /// Whether the case has this requirement.
    pub(crate) fn knows(&self, requirement: &str) -> bool {
        self.case.as_ref().is_some_and(|(case, ..)| case.requirements.contains(&requirement))
    }

    /// Records a check that passed.
    pub(crate) fn pass(&mut self, rule: impl Into<Rule>) {
        self.check(rule.into(), true, "", "");
    }
}

impl Checks for TopicRecord<'_> {
    fn check(
        &mut self,
        rules: impl Rules,
        passed: bool,
        expected: impl Describe,
        found: impl Describe,
    ) -> bool {
        if let Some((_, record, _)) = &mut self.case {
            let evidence = || {
                let evidence = self.observation.evidence();
                Some(Evidence { subject: self.subject.clone().or(evidence.subject), ..evidence })
            };
            record.add_all(rules, passed, expected, found, evidence);
        }
        passed
    }
}
