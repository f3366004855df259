//! The reasons why some defects may survive, and why a run against a device misses some defects.

use super::trial::{SelfTestGroup, Trial, TrialResult};
use super::undetectable::UNSEEN;

/// The group and the prefix of the IDs of defects, and the reason why these defects may survive.
#[rustfmt::skip]
const REASONS: &[(SelfTestGroup, &str, &str)] = &[
    (
        SelfTestGroup::Cnc,
        "object-descriptor.write_access.swap",
        "Any value except 0 is TRUE: 0x0100 has the same meaning as 0x0001.",
    ),
    (
        SelfTestGroup::Cnc,
        "cnc.gen.boolean-4-bytes",
        "The size in the description fails first, and the size of the type follows from it.",
    ),
    (SelfTestGroup::Cnc, "axis-write-by-name.unknown-axis-is-first", NOT_WRITTEN),
    (SelfTestGroup::Cnc, "read-element-name.first-axis", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-name.first-channel", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-name.first-index", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-name.next-axis", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-unit.first-index", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element-unit.next-index", ANY_TEXT),
    (SelfTestGroup::Cnc, "read-element.first-index", CONTENT),
    (SelfTestGroup::Cnc, "write-by-handle.unknown-channel-is-first", NOT_WRITTEN),
    (SelfTestGroup::Cnc, "write-by-name.unknown-channel-is-first", NOT_WRITTEN),
    (SelfTestGroup::Cnc, "write-element.unknown-axis-is-first", NOT_WRITTEN),
    (SelfTestGroup::Cnc, "write-object.size-ignored", UNCHANGED),
    (SelfTestGroup::Cnc, "write-object.unknown-axis-is-first", NOT_WRITTEN),
];

/// Reasons in `REASONS`; some are also in `MISSED`.
const NOT_WRITTEN: &str = "No case writes to a channel or an axis that is not configured.";
const ANY_TEXT: &str = "An element may have any name, unit and write flag.";
const CONTENT: &str =
    "Other clauses fail: the content is compared with attributes and written values.";
const UNCHANGED: &str = "A success without a change differs from an error only by the number.";

/// The reason for the defects in [`UNSEEN`].
const INSIDE: &str = "No case can detect it; a test of the simulated CNC does.";

/// The prefix of the IDs of defects, and the reason why a run against a device misses them. Of
/// several matching prefixes, the first applies.
#[rustfmt::skip]
const MISSED: &[(&str, &str)] = &[
    ("cnc.var.cycle-", "V.CYC is in no list: a profile names it."),
    ("cnc.sda.blank-", "Which place has no axis is not in a list: a profile names it."),
    ("cnc.adr.spindle-logical", SPINDLE),
    ("cnc.sda.spindle-", SPINDLE),
    ("cnc.sda.no-axes", "An axis that no query finds is known by a profile only."),
    ("cnc.com.axis-not-in-offset", "Lists of platform axes are assumed: a profile claims them."),
    ("cnc.adr.platform-axis-first", "Two platform axes may have equal descriptors."),
    ("cnc.var.string-cut", "The length of a reply with a STRING is not documented."),
    ("read-descriptors.first-channel", "A descriptor may point to an object of another channel."),
    ("read-object.unknown-axis-is-first", "An object is read only where a descriptor points."),
    ("read-element-name.unknown-axis-is-first", MALFORMED),
    ("read-element-name.", ANY_TEXT),
    ("read-element-type.frozen", "An element may have any type that fits its length."),
    ("read-element-unit.", ANY_TEXT),
    ("read-element-write-flag.", ANY_TEXT),
    ("read-element.", ANY_CONTENT),
    ("cnc.adr.spindle-first", ANY_CONTENT),
    ("write-reply.result.zero", REJECTED),
    ("write-by-handle.size-ignored", REJECTED),
    ("write-by-name.size-ignored", REJECTED),
    ("write-object.size-ignored", REJECTED),
    ("cnc.ads.result-stays", REJECTED),
    ("cnc.var.write-after-error", REJECTED),
    ("cnc.var.write-long-accepted", REJECTED),
    ("write-by-name.also-first-channel", OTHERS),
    ("axis-write-by-name.also-next-axis", OTHERS),
    ("cnc.var.axis-write-all", OTHERS),
    ("cnc.var.write-other-channels", OTHERS),
    ("axis-write-by-name.first-byte", PROFILE),
    ("write-element.first-byte", PROFILE),
    ("cnc.com.write-bit", UNCHANGED),
    ("cnc.svc.request-state-stays", "Only the service of an NC program shows it."),
];

/// Reasons in `MISSED`.
const SPINDLE: &str = "A spindle that no query finds is known by a profile only.";
const MALFORMED: &str = "Only malformed queries ask for an axis that is not configured.";
const ANY_CONTENT: &str = "An element may have any content.";
const REJECTED: &str =
    "Only a write that must be rejected shows it, and a device gets few of these.";
const OTHERS: &str =
    "Only cases that write every variable show it: these are for the simulated CNC.";
const PROFILE: &str = "Without a profile the run finds fewer values that it may write.";

/// The reason why a run against a device misses the defect with this ID; `None` if no reason is
/// listed.
pub(super) fn of_missed(id: &str) -> Option<&'static str> {
    MISSED.iter().find(|(start, _)| id.starts_with(start)).map(|(_, reason)| *reason)
}

/// The reason why the defect with this ID may survive; `None` if no reason is listed.
pub(super) fn of(group: SelfTestGroup, id: &str) -> Option<&'static str> {
    if group == SelfTestGroup::Cnc && UNSEEN.contains(&id) {
        return Some(INSIDE);
    }
    let mine = REASONS.iter().find(|(of, start, _)| *of == group && id.starts_with(start));
    mine.map(|(_, _, reason)| *reason)
}

/// The group and the ID prefix of each reason why a defect may survive.
#[cfg(test)]
pub(super) fn names() -> impl Iterator<Item = (SelfTestGroup, &'static str)> {
    let unseen = UNSEEN.iter().map(|id| (SelfTestGroup::Cnc, *id));
    REASONS.iter().map(|(group, start, _)| (*group, *start)).chain(unseen)
}

/// The ID prefixes of the reasons why a run against a device misses a defect.
#[cfg(test)]
pub(super) fn missed() -> impl Iterator<Item = &'static str> {
    MISSED.iter().map(|(start, _)| *start)
}

/// The stale reasons: those for which no surviving defect was found.
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
