//! Looks up the items in the file of `--allow-write` on the target after the cases have run. The
//! cases skip an item that the target lacks, so a misspelt name would go unnoticed.

use ads_cnc::address::{Addressing, Attribute, Channel, ClassGroup, ElementAddress, Group};
use ads_cnc::operation::ReadElementWriteFlag;
use ads_cnc::sda::ElementWriteFlag;
use ads_cnc::{CncString, VariableAccess};

use super::kit::{Probe, TargetState};
use crate::gate::{AllowedList, Entry};
use crate::judge::{IfPresent as _, Step};
use crate::objects::{ReportedAccess, ValueAddress, ValueList};

/// The entries of the file of `--allow-write` whose items were found not to be writable.
#[derive(Clone, Debug, Default)]
pub struct Unwritable {
    /// Messages about entries whose item or channel the target does not have, one message for each
    /// entry.
    pub absent: Vec<String>,
    /// The read-only items, each with its name or its address. Cases such as `write-read-only`
    /// check that a write to such an item is rejected.
    pub read_only: Vec<String>,
}

/// Whether the target has the item of an entry, and whether the item is writable. An item whose
/// access is unknown is taken to be writable.
enum Named {
    Writable,
    ReadOnly,
    /// The target does not have the item, or not its channel; the text says which.
    Absent(&'static str),
}

/// Looks up the entries of the file of `--allow-write`, in their order. The first look-up that ends
/// with an error ends the search, for example because the target no longer answers, the deadline
/// has passed or the run is interrupted.
pub fn unwritable(target: &mut TargetState) -> Unwritable {
    let allowed = target.client.gate().allowed();
    let entries = allowed.map(|allowed| allowed.entries.clone()).unwrap_or_default();
    let mut found = Unwritable::default();
    let deadline = target.deadline;
    let mut probe = Probe::new(target).with_deadline(deadline);
    for entry in entries {
        // After an error, the remaining items are not looked up: the target may have them, although
        // it does not return them.
        let named = match is_in_no_channel(&probe, &entry) {
            true => Ok(Named::Absent("channel")),
            false => look_up(&mut probe, &entry),
        };
        let Ok(named) = named else { break };
        if probe.target.disconnect_reason.is_some() {
            break;
        }
        match named {
            Named::Writable => {}
            Named::ReadOnly => found.read_only.push(place(&entry)),
            Named::Absent(what) => {
                let place = place(&entry);
                found.absent.push(format!("allow-write: {place}: the device has no such {what}"));
            }
        }
    }
    found
}

fn look_up(probe: &mut Probe<'_>, entry: &Entry) -> Step<Named> {
    Ok(match entry {
        Entry::Variable { channel, axis: None, name } => variable(probe, *channel, name)?,
        Entry::Variable { channel, axis: Some(axis), name } => {
            let (channel, axis, name) = (*channel, *axis, name.clone());
            match probe.value_at(&ValueAddress::Axis { channel, axis, name }).if_applicable()? {
                Some(None) => Named::Absent("axis variable"),
                _ => Named::Writable,
            }
        }
        Entry::Object { list, name } => {
            let list = match list {
                AllowedList::Platform => ValueList::Platform,
                AllowedList::Axis(axis) => {
                    ValueList::from(ads_cnc::operation::ObjectList::from(*axis))
                }
                AllowedList::Channel(channel) => {
                    ValueList::Channel(numbered(probe, *channel).number())
                }
            };
            let objects = probe.objects().if_applicable()?.unwrap_or_default();
            match objects.iter().find(|one| one.list == list && one.name == *name) {
                None => Named::Absent("object"),
                Some(object) if object.access == ReportedAccess::Read => Named::ReadOnly,
                Some(_) => Named::Writable,
            }
        }
        Entry::Content { group, offset } => match group.parts() {
            Some(Group::Class(class @ ClassGroup { attribute: Attribute::Content, .. })) => {
                let flag = ReadElementWriteFlag::new(ElementAddress::new(class, *offset));
                match probe.try_read::<ElementWriteFlag>(flag).if_applicable()? {
                    Some(None) => Named::Absent("element"),
                    Some(Some(flag)) if !flag.is_writable() => Named::ReadOnly,
                    _ => Named::Writable,
                }
            }
            // The entry contains the address of an object, which need not be in a list.
            _ => Named::Writable,
        },
        Entry::Stream(_) | Entry::Service(_) => Named::Writable,
    })
}

fn variable(probe: &mut Probe<'_>, channel: Channel, name: &CncString) -> Step<Named> {
    let text = name.to_string();
    let whole = text.split('[').next().unwrap_or_default();
    let listed = probe.variables(numbered(probe, channel)).if_applicable()?.unwrap_or_default();
    let listed = listed.iter().find(|one| one.name.text == *whole);
    if listed.is_some_and(|one| one.access == VariableAccess::READ_ONLY) {
        return Ok(Named::ReadOnly);
    }
    if listed.is_some() && whole == text {
        return Ok(Named::Writable);
    }
    // The name is that of an array element, of a variable that is accessible by name only, of a
    // variable whose description the cases do not read, or of no variable.
    let value = probe.value_at(&ValueAddress::Name { channel, name: name.clone() });
    Ok(match value.if_applicable()? {
        Some(None) if listed.is_some() => Named::Absent("element"),
        Some(None) => Named::Absent("variable"),
        _ => Named::Writable,
    })
}

/// Whether an entry belongs to a channel that the target does not have according to the profile;
/// false if the profile has no channel.
fn is_in_no_channel(probe: &Probe<'_>, entry: &Entry) -> bool {
    let channel = match entry {
        Entry::Variable { channel, .. } | Entry::Stream(channel) | Entry::Service(channel) => {
            channel
        }
        Entry::Object { list: AllowedList::Channel(channel), .. } => channel,
        Entry::Object { .. } | Entry::Content { .. } => return false,
    };
    let channels = &probe.target.profile.channels;
    let known = match channel.addressing() {
        Addressing::Logical => channels.contains(&channel.number().into()),
        Addressing::Index => usize::from(channel.number()) <= channels.len(),
    };
    !channels.is_empty() && !known
}

/// The channel of an entry. If the profile has a channel with the rank in the entry, it is
/// addressed by its number, like the channels of the lists; otherwise as in the entry.
fn numbered(probe: &Probe<'_>, channel: Channel) -> Channel {
    let by_rank = channel.addressing() == Addressing::Index;
    let rank = usize::from(channel.number()).checked_sub(1).filter(|_| by_rank);
    let number = rank.and_then(|rank| probe.target.profile.channels.get(rank).copied());
    number.and_then(|number| Channel::new(number).ok()).unwrap_or(channel)
}

/// The location of the item of an entry, as text for a message: its name or address, and its
/// channel or axis, as far as the entry contains them.
fn place(entry: &Entry) -> String {
    let of = |channel: &Channel| match channel.addressing() {
        Addressing::Logical => format!("channel {}", channel.number()),
        Addressing::Index => format!("rank {}", channel.number()),
    };
    match entry {
        Entry::Variable { channel, axis: None, name } => format!("{name} in {}", of(channel)),
        Entry::Variable { channel, axis: Some(axis), name } => {
            format!("{name} at axis {} of {}", axis.index(), of(channel))
        }
        Entry::Content { group, offset } => format!("group {group}, offset {offset}"),
        Entry::Object { list, name } => match list {
            AllowedList::Platform => format!("{name} in channel 0"),
            AllowedList::Channel(channel) => format!("{name} in {}", of(channel)),
            AllowedList::Axis(axis) => format!("{name} at axis {}", axis.index()),
        },
        Entry::Stream(channel) | Entry::Service(channel) => of(channel),
    }
}
