//! The groups of checks that did not pass, with the cases that follow from them.

use serde::Serialize;

use crate::judge::Verdict;
use crate::report::display::worded;
use crate::report::document::Report;
use crate::report::failures::{alike, sentence};
use crate::report::groups::{Group, groups};

/// Maximum number of characters of an expected and of an actual result.
const RESULT_MAX: usize = 300;

#[derive(Serialize)]
pub(super) struct CauseView {
    verdict: Verdict,
    word: String,
    subject: &'static str,
    clauses: Vec<String>,
    title: String,
    sources: Vec<String>,
    sentence: String,
    case: String,
    alike: String,
    followers: Vec<FollowerView>,
}

/// A case with checks that follow from the cause.
#[derive(Serialize)]
struct FollowerView {
    clauses: Vec<String>,
    case: String,
}

/// The groups: failures first, and then by verdict, with the most severe verdict first.
pub(super) fn causes(report: &Report) -> Vec<CauseView> {
    let mut all = groups(report);
    // The sort keeps the order of groups with an equal key, which `groups` has sorted.
    all.sort_by_key(|group| {
        (!group.is_failure(), std::cmp::Reverse(group.verdict.severity()), group.waived)
    });
    all.iter().filter_map(cause).collect()
}

fn cause(group: &Group<'_>) -> Option<CauseView> {
    let (case, failure) = group.example()?;
    let known = ads_cnc_vectors::requirement(group.requirement());
    let owned = |id: &&str| (*id).to_owned();
    let followers = group.followers.iter().map(|(case, clauses)| FollowerView {
        clauses: clauses.iter().map(owned).collect(),
        case: (*case).to_owned(),
    });
    Some(CauseView {
        verdict: group.verdict,
        word: worded(group.verdict, group.waived),
        subject: group.subject()?.name(),
        clauses: group.requirements.iter().map(owned).collect(),
        title: known.map_or_else(String::new, |known| known.title.clone()),
        sources: failure.sources.clone(),
        sentence: sentence(failure, RESULT_MAX),
        case: case.id.clone(),
        alike: alike(group),
        followers: followers.collect(),
    })
}
