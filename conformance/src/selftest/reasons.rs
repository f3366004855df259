//! Why some defects may survive.

use super::tried::{SelfTestGroup, Trial, TrialResult};
use super::unseen::UNSEEN;

/// Group, prefix of the ID, and why the defect is not detectable.
#[rustfmt::skip]
const REASONS: &[(SelfTestGroup, &str, &str)] = &[
    (
        SelfTestGroup::Cnc,
        "object-descriptor.write_access.swap",
        "Whatever is not 0 is TRUE: 0x0100 says no other thing than 0x0001.",
    ),
    (
        SelfTestGroup::Cnc,
        "cnc.gen.boolean-4-bytes",
        "The size in the description fails first, from which the size of the type follows.",
    ),
    (SelfTestGroup::Cnc, "axis-write-by-name.unknown-axis-is-first", NOT_WRITTEN),
    (SelfTestGroup::Cnc, "read-element-name.first-axis", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-name.first-channel", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-name.first-index", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-name.next-axis", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-unit.first-index", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-unit.next-index", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element.first-index", CONTENT),
    (SelfTestGroup::Cnc, "read-element.stale", CONTENT),
    (SelfTestGroup::Cnc, "write-by-handle.unknown-channel-is-first", NOT_WRITTEN),
    (SelfTestGroup::Cnc, "write-by-name.unknown-channel-is-first", NOT_WRITTEN),
    (SelfTestGroup::Cnc, "write-element.unknown-axis-is-first", NOT_WRITTEN),
    (SelfTestGroup::Cnc, "write-object.size-ignored", UNCHANGED),
    (SelfTestGroup::Cnc, "write-object.unknown-axis-is-first", NOT_WRITTEN),
];

/// Reasons of several generated defects.
const NOT_WRITTEN: &str = "No case writes to a channel or an axis that is not configured.";
const ANY_TEXT: &str = "An element may have any name, unit and write flag.";
const CONTENT: &str =
    "Other clauses fail: the content is compared with attributes and written values.";
const UNCHANGED: &str = "A success that changes nothing differs from an error by the number alone.";

/// The reason of [`UNSEEN`].
const INSIDE: &str = "No case shows it: a test of the simulated CNC finds it.";

/// Prefix of the ID of a defect, and why a run against a device misses it.
const MISSED: &[(&str, &str)] = &[
    ("cnc.var.cycle-", "V.CYC is in no list: a profile names it."),
    ("cnc.sda.blank-", "Which place has no axis is not in a list: a profile names it."),
    ("cnc.adr.spindle-logical", "A spindle that no query finds is known by a profile only."),
    ("cnc.sda.spindle-", "A spindle that no query finds is known by a profile only."),
    ("cnc.sda.no-axes", "An axis that no query finds is known by a profile only."),
    ("cnc.com.axis-not-in-offset", "Lists of platform axes are assumed: a profile claims them."),
    ("cnc.var.string-cut", "The length of a reply with a STRING is not documented."),
];

/// Why a run against a device misses a defect, if there is a reason.
pub(super) fn of_missed(id: &str) -> Option<&'static str> {
    MISSED.iter().find(|(start, _)| id.starts_with(start)).map(|(_, reason)| *reason)
}

/// The reason for a survivor, if there is one.
pub(super) fn of(group: SelfTestGroup, id: &str) -> Option<&'static str> {
    if group == SelfTestGroup::Cnc && UNSEEN.contains(&id) {
        return Some(INSIDE);
    }
    let mine = REASONS.iter().find(|(of, start, _)| *of == group && id.starts_with(start));
    mine.map(|(_, _, reason)| *reason)
}

/// Group and prefix of all reasons.
#[cfg(test)]
pub(super) fn names() -> impl Iterator<Item = (SelfTestGroup, &'static str)> {
    let unseen = UNSEEN.iter().map(|id| (SelfTestGroup::Cnc, *id));
    REASONS.iter().map(|(group, start, _)| (*group, *start)).chain(unseen)
}

/// Prefixes of the missed defects.
#[cfg(test)]
pub(super) fn missed() -> impl Iterator<Item = &'static str> {
    MISSED.iter().map(|(start, _)| *start)
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
    let stale = stale.map(|(group, start, _)| format!("{} {start}", group.name()));
    let survives =
        |id: &str| tried.iter().any(|one| one.id == id && one.reason.as_deref() == Some(INSIDE));
    let seen = UNSEEN.iter().filter(|id| !survives(id));
    stale.chain(seen.map(|id| format!("cnc {id}"))).collect()
}
