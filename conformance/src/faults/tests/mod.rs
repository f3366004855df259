//! Tests that the defects are detectable, and that the requirements of level *must* have a defect
//! or a reason to have none.

mod fields;
mod transcript;

use std::collections::{BTreeMap, BTreeSet};

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::{AdsService, Call};
use ads_cnc_vectors::{Level, clause, requirements};

use self::transcript::Transcript;
use super::cnc::CncFault;
use super::seeded_defect::Mechanism;
use super::*;
use crate::edition::Edition;
use crate::selftest::UNSEEN;
use crate::simulator::{Cnc, ReplyData, Responder as _};
use crate::testee::{self, Answer, CodecTestee, Question};
use crate::{client_suite, suite};

#[test]
fn ids_are_unique_and_descriptions_not_empty() {
    let ids: BTreeSet<&str> = all().iter().map(|defect| defect.id.as_str()).collect();
    assert_eq!(ids.len(), all().len());
    for defect in all() {
        assert_eq!(by_id(&defect.id).map(|one| &one.what), Some(&defect.what));
        assert!(defect.what.len() > 10 && !defect.what.ends_with('.'), "{}", defect.id);
        assert!(defect.id.bytes().all(|byte| byte.is_ascii_graphic()), "{}", defect.id);
        assert_eq!(
            defect.requirements.is_empty(),
            defect.kind == DefectKind::Different,
            "{}",
            defect.id
        );
        for id in &defect.requirements {
            let clause = clause(id).unwrap_or_else(|| panic!("{}: {id}", defect.id));
            assert!(clause.requirement.excluded.is_none(), "{}: {id} is excluded", defect.id);
        }
    }
}

/// Each defect or variant of a CNC must change at least one reply of the transcript, unless it
/// changes only the timing or the splitting of frames, or is in `UNSEEN`, whose defects
/// `tests/simulator/defects.rs` detects.
#[test]
fn every_defect_of_a_cnc_is_detectable() {
    let is_of_cnc = |defect: &&SeededDefect| {
        matches!(defect.kind, DefectKind::Cnc | DefectKind::Different) && defect.field().is_none()
    };
    let defects: Vec<&SeededDefect> = all().iter().filter(is_of_cnc).collect();
    let hidden = std::thread::scope(|scope| {
        let parts = defects.chunks(defects.len().div_ceil(4));
        let parts: Vec<_> = parts.map(|part| scope.spawn(|| hidden(part))).collect();
        parts.into_iter().flat_map(|part| part.join().unwrap()).collect::<Vec<_>>()
    });
    // If this fails for a new defect, the transcript may lack a request that the defect affects.
    assert_eq!(hidden, [""; 0], "no answer to what tests/transcript.rs asks is another");
}

/// The IDs of the defects that change no reply of the transcript.
fn hidden(defects: &[&'static SeededDefect]) -> Vec<&'static str> {
    let mut right: BTreeMap<Option<Edition>, Transcript<'_>> = BTreeMap::new();
    let mut hidden = Vec::new();
    for &defect in defects {
        // The transcript does not record the timing and the splitting of frames.
        if matches!(defect.how, Mechanism::Cnc(CncFault::Pieces(_)))
            || defect.id == "different.slow"
            || UNSEEN.contains(&defect.id.as_str())
        {
            continue;
        }
        let right = right.entry(defect.edition).or_insert_with(|| match defect.edition {
            None => Transcript::new(None, None),
            Some(_) => Transcript::new(
                Some(&SeededDefect { how: Mechanism::Cnc(CncFault::Pieces(0)), ..defect.clone() }),
                None,
            ),
        });
        if !Transcript::new(Some(defect), Some(&right.replies)).differs {
            hidden.push(defect.id.as_str());
        }
    }
    hidden
}

#[test]
fn every_defect_of_a_codec_is_detectable() {
    let cases = suite::cases();
    let questions: Vec<Question> =
        cases.iter().flat_map(|case| testee::questions(case, "en-1.05")).collect();
    let right: Vec<Answer> =
        questions.iter().map(|one| CodecTestee::default().answer(one)).collect();
    let cnc = Transcript::new(None, None).replies;
    let hidden = all().iter().filter(|defect| defect.is_for_codec()).filter(|defect| {
        let own = CodecTestee { defect: Some((*defect).clone()) };
        let same = |(question, right): (&Question, &Answer)| own.answer(question) == *right;
        questions.iter().zip(&right).all(same)
            && !(defect.is_for_cnc() && Transcript::new(Some(defect), Some(&cnc)).differs)
    });
    assert_eq!(hidden.map(|defect| defect.id.as_str()).collect::<Vec<_>>(), [""; 0]);
}

/// A requirement of level *must* that is not excluded has either a defect or a reason in `without`
/// why no defect violates it.
#[test]
fn every_must_has_a_defect_or_a_reason() {
    let clients = client_suite::defects().iter().map(|defect| defect.requirement);
    let targets: BTreeSet<&str> = all()
        .iter()
        .flat_map(|defect| defect.requirements.iter().copied())
        .chain(clients)
        .collect();
    let reasons: BTreeMap<&str, &str> =
        without().iter().map(|&(id, reason)| (id.as_str(), reason)).collect();
    for one in requirements() {
        let must = one.level == Level::Must && one.excluded.is_none();
        let id = one.id.as_str();
        let (broken, reason) = (targets.contains(id), reasons.contains_key(id));
        assert!(!must || broken != reason, "{id}: defect {broken}, reason {reason}");
    }
    assert!(reasons.values().all(|reason| reason.len() > 40));
}

/// The reply of a CNC with a defect, or of a valid variant, to a call in the channel group of COM.
fn reply(id: &str, service: AdsService, offset: u32, data: &[u8]) -> ReplyData {
    let cnc = Cnc::with_default_model().unwrap().with_stopped_clock();
    Faulty::new(cnc, Some(by_id(id).unwrap())).answer(&Call {
        port: AmsPort::COM,
        service,
        index_group: IndexGroup::new(0x12_0101),
        index_offset: IndexOffset::new(offset),
        read_length: 0,
        data,
    })
}

/// The variant pads a write to an object of 2 bytes, but does not accept more than 2 bytes.
#[test]
fn a_short_write_is_padded_and_a_long_one_rejected() {
    let write = |data: &[u8]| reply("different.short-writes", AdsService::Write, 0x14, data);
    assert_eq!(write(&[1]), Ok(Vec::new()));
    assert_eq!(write(&[1, 0, 0]), Err(AdsError::INVALID_SIZE));
}

#[test]
fn a_stream_by_read_write_accepts_no_write() {
    let send = |service| reply("cnc.stm.by-read-write", service, 0x90, b"N10\r\n");
    assert_eq!(send(AdsService::ReadWrite), Ok(Vec::new()));
    assert_eq!(send(AdsService::Write), Err(AdsError::SERVICE_NOT_SUPPORTED));
}
