//! Tests the suite with codecs that have a defect, and with miniatures: small testees, most of
//! which have one kind of wrong behaviour, such as a crash at every tenth question.

use std::time::Duration;

use ads_cnc::layout::Stream;

use super::trial::{Candidate, SelfTestGroup};
use crate::faults::{self, SeededDefect};
use crate::judge::{Body, Case, CaseOutcome, CaseSubject, Needs, TESTEE};
use crate::session::ToolError;
use crate::suite;
use crate::testee::{CodecTestee, JudgementOptions, Miniature, TesteeProcess, judge};

/// Time limit for an answer of a miniature. A question at which a miniature hangs lasts this long.
const TIMEOUT: Duration = Duration::from_millis(1000);

/// With a miniature, only every `SHARE`-th case is run, because the wrong behaviour of a miniature
/// occurs in many cases.
const SHARE: usize = 25;

const TERMS: JudgementOptions<'static> =
    JudgementOptions { seed: 1, subject: CaseSubject::Testee, edition: None, strict: false };

pub(super) fn candidates() -> Vec<Candidate> {
    let defects = faults::all().iter().filter(|defect| defect.is_for_codec()).map(of_defect);
    defects.chain(Miniature::ALL.map(of_miniature)).collect()
}

fn of_defect(defect: &'static SeededDefect) -> Candidate {
    Candidate {
        id: defect.id.clone(),
        group: SelfTestGroup::Codec,
        what: defect.what.clone(),
        targets: defect.requirements.clone(),
        run: Box::new(move || {
            // A field defect affects only streams with this field, so only the vectors of these
            // streams run.
            let field = defect.field();
            let touched = |case: &Case| match (&case.body, field) {
                (Body::Vector(vector), Some(field)) => {
                    Stream::by_name(&vector.stream).is_some_and(|stream| field.touches(stream))
                }
                (_, field) => field.is_none(),
            };
            let mut own = CodecTestee { defect: Some(defect.clone()) };
            Ok(Some(judge(&mut own, cases().filter(touched).collect(), TERMS).outcomes))
        }),
    }
}

fn of_miniature(miniature: Miniature) -> Candidate {
    let is_right = miniature.is_right();
    let name = miniature.name();
    Candidate {
        id: format!("miniature.{name}"),
        group: if is_right { SelfTestGroup::Different } else { SelfTestGroup::Miniature },
        what: format!("ads-cnc testee --miniature {name}"),
        targets: if is_right { Vec::new() } else { targets(miniature) },
        run: Box::new(move || over_pipes(miniature).map(Some)),
    }
}

/// The requirements that a miniature breaks: only that of the testee protocol, or those of all
/// cases that are run.
fn targets(miniature: Miniature) -> Vec<&'static str> {
    match miniature {
        Miniature::AcceptsUnknown
        | Miniature::RejectsLater
        | Miniature::IgnoresBye
        | Miniature::NotJson
        | Miniature::WrongNumbers => vec![TESTEE],
        _ => {
            let mut all: Vec<&str> = some().flat_map(|case| case.requirements).collect();
            all.sort_unstable();
            all.dedup();
            all
        }
    }
}

fn over_pipes(miniature: Miniature) -> Result<Vec<CaseOutcome>, ToolError> {
    let program = std::env::current_exe()
        .map_err(|error| ToolError::Internal(format!("cannot find this program: {error}")))?;
    let command = format!("\"{}\" testee --miniature {}", program.display(), miniature.name());
    let mut process = TesteeProcess::new(command, TIMEOUT);
    Ok(judge(&mut process, some().collect(), TERMS).outcomes)
}

fn some() -> impl Iterator<Item = Case> {
    cases().enumerate().filter(|(place, _)| place % SHARE == 0).map(|(_, case)| case)
}

fn cases() -> impl Iterator<Item = Case> {
    suite::cases().into_iter().filter(|case| case.needs == Needs::Codec)
}
