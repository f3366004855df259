//! Why some defects may survive.

use super::tried::{SelfTestGroup, Trial, TrialResult};

/// Group, prefix of the ID, and why the defect is not detectable.
const REASONS: &[(SelfTestGroup, &str, &str)] = &[(
    SelfTestGroup::Cnc,
    "object-descriptor.write_access.swap",
    "Whatever is not 0 is TRUE: 0x0100 says no other thing than 0x0001.",
)];

/// The reason for a survivor, if there is one.
pub(super) fn of(group: SelfTestGroup, id: &str) -> Option<&'static str> {
    let mine = REASONS.iter().find(|(of, start, _)| *of == group && id.starts_with(start));
    mine.map(|(_, _, reason)| *reason)
}

/// Group and prefix of all reasons.
#[cfg(test)]
pub(super) fn names() -> impl Iterator<Item = (SelfTestGroup, &'static str)> {
    REASONS.iter().map(|(group, start, _)| (*group, *start))
}

/// Reasons that no survivor needs.
pub(super) fn stale(tried: &[Trial]) -> Vec<String> {
    let needed = |(group, start, _): &&(SelfTestGroup, &str, &str)| {
        tried.iter().any(|one| {
            one.group == *group
                && one.id.starts_with(start)
                && matches!(one.result, TrialResult::Survived | TrialResult::Elsewhere)
        })
    };
    let stale = REASONS.iter().filter(|reason| !needed(reason));
    stale.map(|(group, start, _)| format!("{} {start}", group.name())).collect()
}
