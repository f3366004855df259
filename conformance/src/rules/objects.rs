//! Objects of COM: numbers, descriptors and contents, compared across exchanges.

use ads_cnc::address::{Access, ComGroup, Group};
use ads_cnc::limits::DESCRIPTOR_LEN;
use ads_cnc::operation::{ReadDescriptors, Reply, Request};
use ads_cnc::value::DataType;
use ads_cnc::{DescriptorRef, DescriptorsRef};
use ads_cnc_vectors::ids::*;

use super::knowledge::{ExchangeJudge, ObservedContent, ObservedList};
use super::topic::Topic;
use crate::judge::{Checks, Rule, assumed, online};
use crate::text::plural;

impl ExchangeJudge<'_> {
    pub(super) fn objects(&mut self, request: &Request<'_>, reply: Option<&Reply<'_>>) {
        match (request, reply) {
            (Request::CountObjects(_), Some(Reply::ObjectCount(count))) => {
                self.count(count.0);
            }
            (Request::ReadDescriptors(read), reply) => {
                let given = match reply {
                    Some(Reply::Descriptors(given)) => Some(*given),
                    _ => None,
                };
                self.descriptors(request, read, given);
            }
            (Request::ReadObject(_), Some(Reply::Content(content))) => {
                let Some(known) = self.content() else { return };
                let full = self.call.read_length >= known.size && known.type_size.is_some();
                if full {
                    let given = content.bytes.len();
                    let sized = u32::try_from(given) == Ok(known.size);
                    let expected =
                        || format!("the {} of its descriptor", plural(known.size, "byte"));
                    let found = || format!("{} of {}", plural(given, "byte"), known.name);
                    let mut record = self.records.on(Topic::CncCom, self.observation);
                    record.check([COM_5, COM_2], sized, expected, found);
                }
            }
            (Request::WriteObject(write), reply) => {
                let Some(known) = self.content() else { return };
                let given = write.content().bytes.len();
                if known.type_size.is_some() {
                    let sized = u32::try_from(given) == Ok(known.size);
                    let expected =
                        || format!("the {} of {}", plural(known.size, "byte"), known.name);
                    let found = || plural(given, "byte");
                    self.records
                        .on(Topic::ClientCom, self.observation)
                        .check(COM_5, sized, expected, found);
                }
                let passed = known.writable || reply.is_none();
                let expected =
                    || format!("an error number, because {} may not be written", known.name);
                let mut record = self.records.on(Topic::CncCom, self.observation);
                record.check(assumed(COM_2), passed, expected, "a success");
            }
            _ => {}
        }
    }

    fn content(&self) -> Option<ObservedContent> {
        let place = (self.call.index_group.get(), self.call.index_offset.get());
        self.cnc.objects.contents.get(&place).cloned()
    }

    fn count(&mut self, count: u32) {
        let group = self.call.index_group.get();
        let list = self.cnc.objects.lists.entry(group).or_default();
        if list.count.is_some_and(|known| known != count) {
            *list = ObservedList::default();
        }
        list.count = Some(count);
        let last = list.known.last_key_value().map_or(0, |(&last, _)| last);
        let found = || format!("{}, but object {last} has a descriptor", plural(count, "object"));
        let mut record = self.records.on(Topic::CncCom, self.observation);
        record.check(COM_1, last <= count, || format!("at least {last} objects"), found);
    }

    fn descriptors(
        &mut self,
        request: &Request<'_>,
        read: &ReadDescriptors,
        given: Option<DescriptorsRef<'_>>,
    ) {
        let group = self.call.index_group.get();
        let first = read.first();
        let count = self.cnc.objects.lists.get(&group).and_then(|list| list.count);
        if let Some(count) = count.filter(|count| first > *count) {
            let expected = || format!("an index within {}", plural(count, "object"));
            let asked = || format!("index {first}");
            self.judge_nonexistent(request, COM_2, expected, asked);
            let expected =
                || format!("an error number, because the list has {}", plural(count, "object"));
            let found = || format!("a descriptor of object {first}");
            let mut record = self.records.on(Topic::CncCom, self.observation);
            record.check(COM_2, given.is_none_or(|given| given.is_empty()), expected, found);
            return;
        }
        let Some(given) = given else { return };
        if let Some(count) = count {
            let left = count.saturating_sub(first).saturating_add(1);
            let length = u32::try_from(DESCRIPTOR_LEN).unwrap_or(1);
            let exact = self.call.read_length.checked_rem(length) == Some(0);
            let asked = if exact { read.count() } else { 1 };
            let expected = asked.min(left);
            // For more descriptors than are left, or a read length that is not a multiple of a
            // descriptor's length, the manual states no reply, so the rule is assumed.
            let rule: Rule = if exact && asked <= left { COM_3.into() } else { assumed(COM_3) };
            let passed = u32::try_from(given.len()) == Ok(expected);
            let expected =
                || format!("{} starting with object {first}", plural(expected, "descriptor"));
            let mut record = self.records.on(Topic::CncCom, self.observation);
            record.check(rule, passed, expected, given.len());
        }
        let alone = given.len() == 1;
        for (index, object) in (first..=u32::MAX).zip(given.iter()) {
            let owned = object.to_owned();
            let mut record = self.records.on(Topic::CncCom, self.observation);
            record.about(object.name());
            check_descriptor(&mut record, object);
            let list = self.cnc.objects.lists.entry(group).or_default();
            let other = list.ids.get(&object.id()).copied().filter(|other| *other != index);
            let found =
                || format!("ID {} of object {index}, and of {}", object.id(), other.unwrap_or(0));
            let known = list.known.get(&index).copied();
            if list.ids.contains_key(&object.id()) || self.budget.take(0) {
                list.ids.insert(object.id(), index);
            }
            // An object after the last object is an error of this reply. Its descriptor is not
            // stored in `known`, because otherwise the next number of objects would be reported as
            // wrong.
            let is_listed = count.is_none_or(|count| index <= count);
            if is_listed && (known.is_some() || self.budget.take(0)) {
                list.known.insert(index, (owned, alone));
            }
            let mut record = self.records.on(Topic::CncCom, self.observation);
            record.check(COM_2, other.is_none(), "an ID that no other object has", found);
            if let Some((known, was_alone)) = known {
                // Descriptors must be equal whether they are read one by one or in a range.
                let rule: Rule = if alone == was_alone { assumed(COM_2) } else { COM_3.into() };
                let found =
                    || format!("a descriptor of object {index} that differs from the earlier one");
                record.check(rule, known == owned, "the same descriptor", found);
            }
            let place = (object.index_group().get(), object.index_offset().get());
            let contents = &mut self.cnc.objects.contents;
            if contents.contains_key(&place) || self.budget.take(0) {
                contents.insert(
                    place,
                    ObservedContent {
                        name: object.name().to_string(),
                        size: object.size(),
                        type_size: object.type_size(),
                        writable: object.write_access().is_writable(),
                    },
                );
            }
        }
    }
}

/// Checks a descriptor by itself.
pub(crate) fn check_descriptor(record: &mut impl Checks, object: DescriptorRef<'_>) {
    let name = object.name().to_string();
    record.check(assumed(COM_2), !name.is_empty(), "an object with a name", "an empty name");
    let type_name = object.type_name().to_string();
    let listed = DataType::ALL.into_iter().any(|one| one.object_name() == type_name);
    let found = || format!("{type_name:?} of {name}");
    record.check(COM_2, listed, "one of the types of the manual", found);
    if let Some(size) = object.type_size() {
        let whole = object.size() > 0 && object.size().checked_rem(size) == Some(0);
        let expected = || format!("a multiple of the {} of {type_name}", plural(size, "byte"));
        let found = || format!("size {} of {name}", object.size());
        let is_printed = ["BOOL", "WORD", "DWORD"].contains(&type_name.as_str());
        let rule = if is_printed { GEN_5.into() } else { online(GEN_5) };
        record.check(rule, whole, expected, found);
    }
    let group = object.index_group();
    let content =
        matches!(group.parts(), Some(Group::Com(ComGroup { access: Access::Element, .. })));
    let expected = "a group for contents of COM, such as 0x120100 or 0x120200";
    record.check(assumed(COM_5), content, expected, || format!("group {group} of {name}"));
    let access = object.write_access().0;
    let expected = "write access 0 or 1";
    record.check(assumed(COM_2), access <= 1, expected, || format!("{access} of {name}"));
}
