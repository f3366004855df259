//! The selection and order of cases.

use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher as _, RandomState};

use ads_cnc_vectors::{Source, requirement, requirements};

use super::case::matches;
use super::{Body, CLIENT, Case, CaseOutcome, CaseSubject, Needs, Verdict};
use crate::edition::Edition;
use crate::number::{digest, digest_more, to_u32};
use crate::text::did_you_mean;

/// The selection of cases.
///
/// ```
/// use ads_cnc_conformance::judge::{Selection, Unmatched};
/// use ads_cnc_conformance::suite;
///
/// let only = vec!["VAR-11".to_owned(), "com-count".to_owned()];
/// let plan = Selection { edition: None, only }.plan(suite::cases(), 1)?;
/// assert!(plan.cases.iter().all(|case| {
///     case.id == "com-count" || case.requirements.contains(&"VAR-11")
/// }));
///
/// let only = vec!["VRA".to_owned()];
/// let nothing = Selection { edition: None, only }.plan(suite::cases(), 1).unwrap_err();
/// let why = "no area, requirement, section, stream or case is called VRA - did you mean VAR?";
/// assert_eq!(nothing.to_string(), why);
/// # Ok::<(), Unmatched>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// The edition of the manual to judge by; `None` for both.
    pub edition: Option<Edition>,
    /// The words that select cases: areas such as VAR, requirements such as VAR-11 or parts of
    /// them, sections such as ads:4.3.2, streams such as variable-description, kinds of sequences,
    /// and IDs of cases, vectors and sequences, or patterns of these with `*` and `?`.
    /// Case-insensitive. Without words, all cases are selected.
    pub only: Vec<String>,
}

/// A word that selects no case.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no area, requirement, section, stream or case is called {word}{near}")]
pub struct Unmatched {
    word: String,
    /// The most similar names.
    near: String,
}

/// The selected cases in order, and the other cases.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The cases to run; pass their outcomes to [`finish`](Self::finish).
    pub cases: Vec<Case>,
    /// Selected cases that do not belong to the edition, each with the reason.
    pub foreign: Vec<(Case, String)>,
    /// The cases that were not selected.
    left_out: Vec<Case>,
    /// The selected requirements, by the IDs of the cases of which not all requirements are
    /// selected. Empty for a case that only provides frames for the selected cases.
    judged: HashMap<String, Vec<&'static str>>,
}

/// A case of which all or some requirements were not selected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SkippedCase {
    pub id: String,
    /// The subject of the case.
    pub subject: CaseSubject,
    /// The requirements of the case that were not selected.
    pub requirements: Vec<&'static str>,
}

/// A word of a selection, and the requirements that it names.
type Word<'a> = (&'a str, HashSet<&'static str>);

/// Returns a random seed.
pub fn any_seed() -> u32 {
    let random = RandomState::new().hash_one(());
    to_u32(random >> 32)
}

impl Selection {
    /// Selects cases and orders them by the seed. With the same seed, two selected cases have the
    /// same order in every selection. Cases that judge the frames of the other cases come last.
    ///
    /// # Errors
    /// If a word of the selection matches no case and no requirement of the cases.
    pub fn plan(&self, mut cases: Vec<Case>, seed: u32) -> Result<Plan, Unmatched> {
        let ids: HashSet<&str> =
            cases.iter().flat_map(|case| case.requirements.iter().copied()).collect();
        let named = |word| ids.iter().copied().filter(|id| names(word, id)).collect();
        let words: Vec<Word<'_>> = self.only.iter().map(|word| (&**word, named(word))).collect();
        let unmatched = words
            .iter()
            .find(|(word, ids)| ids.is_empty() && !cases.iter().any(|case| case.is_called(word)));
        if let Some((word, _)) = unmatched {
            let requirements = || cases.iter().flat_map(|case| case.requirements.iter().copied());
            let areas = requirements().filter_map(|id| Some(id.split_once('-')?.0));
            let names = cases.iter().flat_map(|case| [Some(case.id.as_str()), case.stream()]);
            let sections = sections();
            let names = names.flatten().chain(sections.iter().map(String::as_str));
            let near = did_you_mean(word, areas.chain(requirements()).chain(names));
            return Err(Unmatched { word: (*word).to_owned(), near });
        }
        cases.sort_by_cached_key(|case| (case.needs == Needs::Frames, order(seed, &case.id)));
        let mut plan = Plan {
            cases: Vec::new(),
            foreign: Vec::new(),
            left_out: Vec::new(),
            judged: HashMap::new(),
        };
        for case in cases {
            let wanted = self.selected_requirements(&words, &case);
            if wanted.is_empty() {
                plan.left_out.push(case);
                continue;
            }
            if let Some(why) = self.edition.and_then(|edition| foreign(&case, edition)) {
                plan.foreign.push((case, why));
                continue;
            }
            if wanted.len() < case.requirements.len() {
                plan.judged.insert(case.id.clone(), wanted);
            }
            plan.cases.push(case);
        }
        plan.carry_frames();
        Ok(plan)
    }

    /// The requirements of a case that are selected.
    fn selected_requirements(&self, words: &[Word<'_>], case: &Case) -> Vec<&'static str> {
        let whole = words.is_empty() || words.iter().any(|(word, _)| case.is_called(word));
        let selected = |id: &&str| whole || words.iter().any(|(_, named)| named.contains(id));
        let all: Vec<_> = case.requirements.iter().copied().filter(selected).collect();
        let Some(edition) = self.edition else { return all };
        let has = |id: &&str| {
            requirement(id).is_none_or(|requirement| has(edition, &requirement.sources))
        };
        match all.iter().copied().filter(has).collect::<Vec<_>>() {
            // The edition has no selected requirement of the case. All selected requirements are
            // returned, so that `plan` does not add the case to `left_out`. `plan` adds it to
            // `foreign` if the edition has none of the requirements of the case.
            none if none.is_empty() => all,
            some => some,
        }
    }
}

impl Plan {
    /// If the only selected cases of the target judge frames, adds the query cases of the target
    /// that are not selected, because their frames are needed. The outcomes of the added cases are
    /// not reported.
    fn carry_frames(&mut self) {
        let of_target = |case: &&Case| case.subject == CaseSubject::Target;
        let frames = |case: &Case| case.needs == Needs::Frames;
        if !self.cases.iter().any(frames)
            || self.cases.iter().filter(of_target).any(|one| !frames(one))
        {
            return;
        }
        let queries = |case: &&Case| case.needs == Needs::Queries;
        let carriers = self.left_out.iter().filter(of_target).filter(queries).cloned();
        let carriers: Vec<Case> = carriers.collect();
        self.judged.extend(carriers.iter().map(|case| (case.id.clone(), Vec::new())));
        self.cases.splice(0..0, carriers);
    }

    /// The selected cases, without the cases that only provide frames for the selected cases.
    pub fn selected(&self) -> impl Iterator<Item = &Case> {
        self.cases
            .iter()
            .filter(|case| self.judged.get(&case.id).is_none_or(|judged| !judged.is_empty()))
    }

    /// Limits the outcomes to the selected requirements, and adds the cases in `foreign` as not
    /// run. Also returns the cases of which all or some requirements were not selected.
    pub fn finish(self, outcomes: Vec<CaseOutcome>) -> (Vec<CaseOutcome>, Vec<SkippedCase>) {
        let Self { foreign, left_out, judged, .. } = self;
        let mut left_out: Vec<SkippedCase> = left_out.iter().map(|case| left(case, &[])).collect();
        let mut kept = Vec::new();
        for mut outcome in outcomes {
            match judged.get(&outcome.case.id) {
                Some(judged) if judged.is_empty() => continue,
                Some(judged) => {
                    left_out.push(left(&outcome.case, judged));
                    // Harness errors are kept. A violation of the client protocol is kept too,
                    // because it can make the other verdicts meaningless.
                    outcome.verdicts.retain(|one| {
                        judged.contains(&one.requirement)
                            || one.verdict == Verdict::HarnessError
                            || one.requirement == CLIENT && one.verdict == Verdict::Fail
                    });
                }
                None => {}
            }
            kept.push(outcome);
        }
        let untried = |(case, why)| CaseOutcome::untried(case, Verdict::NotRun, why);
        kept.extend(foreign.into_iter().map(untried));
        (kept, left_out)
    }
}

fn left(case: &Case, judged: &[&str]) -> SkippedCase {
    let requirements = case.requirements.iter().copied().filter(|id| !judged.contains(id));
    SkippedCase { id: case.id.clone(), subject: case.subject, requirements: requirements.collect() }
}

/// Whether a word or pattern names a requirement: by its ID, its area, the ID of one of its parts
/// (VAR-4.1), a section that is a source of the requirement (ads:4.3.2), or a section above such a
/// section (ads:4.3).
pub(crate) fn names(word: &str, id: &str) -> bool {
    let area = id.split('-').next().unwrap_or(id);
    let is_in =
        |section: String| matches(word, &section) || matches(&format!("{word}.*"), &section);
    matches(word, id)
        || matches(word, area)
        || requirement(id).is_some_and(|one| {
            one.parts.iter().any(|part| matches(word, &part.id))
                || word.contains(':') && one.sources.iter().map(section).any(is_in)
        })
}

/// The word that selects the section of a source in all editions of the manual: ads:4.3.2 for
/// ads-en and ads-de.
fn section(source: &Source) -> String {
    let manual = source.document.split('-').next().unwrap_or_default();
    format!("{manual}:{}", source.section)
}

/// The words that select the sections of all requirements; a word may occur several times.
pub(crate) fn sections() -> Vec<String> {
    requirements().iter().flat_map(|one| &one.sources).map(section).collect()
}

/// Whether any of the sources belongs to the edition, or none belongs to an edition.
fn has(edition: Edition, sources: &[Source]) -> bool {
    let has_source =
        |edition: Edition| sources.iter().any(|source| source.document == edition.document());
    has_source(edition) || !Edition::ALL.into_iter().any(has_source)
}

/// Why a case does not belong to an edition: only the other edition prints its example, or has its
/// requirements.
fn foreign(case: &Case, edition: Edition) -> Option<String> {
    let provenance = match case.body {
        Body::Vector(vector) | Body::Printed(vector) => Some(&vector.provenance),
        Body::Sequence(sequence) => Some(&sequence.provenance),
        Body::Probe | Body::Protocol | Body::Client | Body::Traffic => None,
    };
    let printed = provenance.is_none_or(|provenance| has(edition, &provenance.sources));
    let required = case
        .requirements
        .iter()
        .any(|id| requirement(id).is_none_or(|requirement| has(edition, &requirement.sources)));
    let why = match (printed, required) {
        (true, true) => return None,
        (false, _) => "does not print it",
        (_, false) => "does not require it",
    };
    Some(format!("{edition} {why}"))
}

/// The sort key of a case: FNV-1a over seed and ID, mixed as in splitmix64. The standard library
/// has no such hash, and a seed in a report must mean the same order in every version.
pub(crate) fn order(seed: u32, id: &str) -> u64 {
    let hash = digest_more(digest(&seed.to_le_bytes()), id.as_bytes());
    let hash = (hash ^ (hash >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let hash = (hash ^ (hash >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    hash ^ (hash >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::cases;

    fn plan(edition: Option<Edition>, only: &[&str], seed: u32) -> Plan {
        let only = only.iter().map(|&word| word.to_owned()).collect();
        Selection { edition, only }.plan(cases(), seed).unwrap()
    }

    fn ids(plan: &Plan) -> Vec<&str> {
        plan.cases.iter().map(|case| case.id.as_str()).collect()
    }

    #[test]
    fn a_seed_determines_the_order() {
        let (one, again, two) = (plan(None, &[], 1), plan(None, &[], 1), plan(None, &[], 2));
        assert_eq!(ids(&one), ids(&again));
        assert_ne!(ids(&one), ids(&two));
        assert_eq!(one.cases.len(), cases().len());
        assert_eq!(ids(&one).last(), Some(&"ads-every-frame"));
        // The cases of a selection have the same order as in a run of all cases.
        let part = plan(None, &["var"], 1);
        let mut whole = ids(&one);
        whole.retain(|id| ids(&part).contains(id));
        assert_eq!(whole, ids(&part));
        // The value is fixed, because the seed of an old report must give the same order.
        assert_eq!(order(0, ""), 0xACA6_D6B5_4BE3_ED05);
    }

    #[test]
    fn an_edition_omits_the_examples_of_the_other() {
        let english = plan(Some(Edition::English), &["VAR-20"], 1);
        let foreign: Vec<&str> = english.foreign.iter().map(|(case, _)| case.id.as_str()).collect();
        assert!(foreign.contains(&"vec-path-trajektorie-x"), "{foreign:?}");
        assert!(ids(&english).contains(&"vec-path-trajectory-x"));
        let german = plan(Some(Edition::German), &["VAR-20"], 1);
        assert!(ids(&german).contains(&"vec-path-trajektorie-x"));
        assert!(!ids(&german).contains(&"vec-path-trajectory-x"));
    }

    #[test]
    fn streams_vectors_and_parts_are_selected() {
        let streams = plan(None, &["Variable-Handle"], 1);
        assert!(streams.cases.len() > 3);
        assert!(streams.cases.iter().all(|case| case.stream() == Some("variable-handle")));
        let vector = plan(None, &["description-one-dimension"], 1);
        assert_eq!(ids(&vector), ["vec-description-one-dimension"]);
        assert_eq!(ids(&plan(None, &["VAR-4.1"], 1)), ids(&plan(None, &["VAR-4"], 1)));
    }

    #[test]
    fn patterns_select_all_matching_names() {
        let writes = plan(None, &["WRITE-*"], 1);
        assert!(writes.cases.len() > 5);
        // The pattern also matches the ID of a vector, to which the ID of the case adds a prefix.
        assert!(writes.cases.iter().all(|case| case.id.contains("write-")));
        let pattern = plan(None, &["var-1?"], 1);
        let all: Vec<String> = (10..20).map(|number| format!("VAR-{number}")).collect();
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        assert_eq!(ids(&pattern), ids(&plan(None, &all, 1)));
        assert_eq!(ids(&plan(None, &["*"], 1)), ids(&plan(None, &[], 1)));
    }

    #[test]
    fn a_section_selects_its_requirements_and_those_of_sections_below() {
        assert!(
            names("ads:4.3.2", "VAR-8") && names("ADS:4.3", "VAR-8") && names("ads:4", "VAR-8")
        );
        assert!(
            !names("ads:4.3.1", "VAR-8") && !names("ads:4.", "VAR-8") && !names("ads:", "VAR-8")
        );
        // The word for section 4.3.1 does not select section 4.3.10 or a section of another manual.
        let section = |word| requirements().iter().filter(|one| names(word, &one.id)).count();
        assert_eq!([section("ads:4.3.1"), section("ads:4.3.10"), section("stream:3.1")], [3, 1, 6]);
        assert!(plan(None, &["stream:3"], 1).cases.len() > 5);
    }

    #[test]
    fn unknown_parts_and_sections_are_rejected() {
        for (word, near) in [
            ("VAR.nonsense", ""),
            ("VAR-4.999", ""),
            ("ads-4.3.2", " - did you mean ads:4.3.2"),
            ("ads:9.9", ""),
            ("write-zz*", ""),
            ("", ""),
        ] {
            let only = vec![word.to_owned()];
            let error = Selection { edition: None, only }.plan(cases(), 1).unwrap_err();
            let why =
                format!("no area, requirement, section, stream or case is called {word}{near}");
            assert!(error.to_string().starts_with(&why), "{error}");
        }
    }

    #[test]
    fn query_cases_are_added_to_cases_about_frames() {
        let frames = plan(None, &["ads-1"], 1);
        assert!(ids(&frames).contains(&"ads-every-frame"));
        let only = plan(None, &["ads-every-frame"], 1);
        assert!(only.cases.len() > 10);
        let outcomes = only.cases.iter().cloned();
        let outcomes = outcomes.map(|case| CaseOutcome::untried(case, Verdict::Pass, ""));
        let (kept, left) = only.clone().finish(outcomes.collect());
        assert_eq!(kept.len(), 1);
        assert_eq!(left.len(), cases().len() - 1);
    }
}
