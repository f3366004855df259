//! Checks of instances and elements of SDA and GEO; those of elements also compare exchanges.

use std::fmt::Display;

use ads_cnc::address::{
    Addressing, Attribute, AxisStride, Class, ClassGroup, Group, IndexGroup, IndexOffset,
};
use ads_cnc::operation::{Call, FindInstance, Reply, Request};
use ads_cnc::sda::ObjectAddress;
use ads_cnc::value::DataType;
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::knowledge::ExchangeJudge;
use super::topic::Topic;
use crate::judge::{Checks, Rule, assumed};
use crate::number::to_u32;
use crate::text::plural;

/// The type of an element with this type name: a type of variables, or REAL32; `None` for another
/// name.
pub(crate) fn element_type(name: &str) -> Option<DataType> {
    let is_of_objects_only = |one: &DataType| matches!(one, DataType::Lint | DataType::Lword);
    DataType::ALL.into_iter().find(|one| one.name() == name && !is_of_objects_only(one))
}

/// The rule by which the name of a type is checked. A name with the pattern of the manual's list,
/// such as UNS64, may belong to the part of the list that the manual abbreviates, so its rule is
/// assumed.
fn name_rule(name: &str) -> Rule {
    let digits = ["UNS", "SGN", "REAL"].into_iter().find_map(|one| name.strip_prefix(one));
    let is_alike = digits.is_some_and(|digits| {
        digits.len() == 2 && digits.bytes().all(|byte| byte.is_ascii_digit())
    });
    if is_alike { assumed(SDA_7) } else { SDA_7.into() }
}

/// The rules for the length of an element of a known type with a fixed size: the rule of the type,
/// of the length attribute and of the size of the type. A failure does not show which of them is
/// violated.
const LENGTH_RULES: [ClauseId; 3] = [SDA_7, SDA_8, GEN_5];

/// Checks the name of an element's type. Returns the type if `element_type` knows the name.
pub(crate) fn check_type(
    record: &mut impl Checks,
    name: &str,
    at: &impl Display,
) -> Option<DataType> {
    let data_type = element_type(name);
    let found = || format!("{name:?} of {at}");
    record.check(name_rule(name), data_type.is_some(), "one of the types of the manual", found);
    data_type
}

/// Checks the length of an element in bytes. If the type is unknown or has no fixed size, only a
/// length of 0 is wrong.
pub(crate) fn check_length(
    record: &mut impl Checks,
    data_type: Option<DataType>,
    length: u32,
    at: &impl Display,
) {
    let found = || format!("{} of {at}", plural(length, "byte"));
    if let Some((data_type, size)) = data_type.and_then(|one| Some((one, one.size()?))) {
        let expected = || format!("the {} of {data_type}", plural(size, "byte"));
        record.check(LENGTH_RULES, length == size, expected, found);
        record.check(SDA_8, length > 0, "a length of at least 1 byte", found);
    } else {
        record.check(assumed(SDA_8), length > 0, "a length of at least 1 byte", found);
    }
}

impl ExchangeJudge<'_> {
    pub(super) fn elements(&mut self, request: &Request<'_>, reply: Option<&Reply<'_>>) {
        let call = self.call;
        if let (Request::FindInstance(find), Some(Reply::ObjectAddress(address))) = (request, reply)
        {
            self.instance(find, *address);
            return;
        }
        let Some(key) = key(call) else { return };
        let all = &mut self.cnc.elements;
        if !all.contains_key(&key) && !self.budget.take(0) {
            return;
        }
        let element = all.entry(key).or_default();
        let at = format!("the element at {}, {}", call.index_group, call.index_offset);
        let mut record = self.records.on(Topic::CncSda, self.observation);
        match (request, reply) {
            (Request::ReadElementType(_), Some(Reply::ElementText(text))) => {
                element.data_type = check_type(&mut record, &text.text.text().to_string(), &at);
            }
            (Request::ReadElementLength(_), Some(Reply::ElementLength(length))) => {
                element.length = Some(length.get());
            }
            (Request::ReadElementWriteFlag(_), Some(Reply::ElementWriteFlag(flag))) => {
                element.writable = Some(flag.is_writable());
                record.check(assumed(SDA_9), flag.0 <= 1, "a write flag of 0 or 1", || flag.0);
                return;
            }
            (Request::ReadElement(_), Some(Reply::Content(content))) => {
                let given = to_u32(content.bytes.len());
                if let Some(length) = element.length.filter(|length| call.read_length >= *length) {
                    let expected =
                        || format!("the {} of its length attribute", plural(length, "byte"));
                    record.check(SDA_8, given == length, expected, || plural(given, "byte"));
                }
                return;
            }
            (Request::WriteElement(write), reply) => {
                let passed = element.writable != Some(false) || reply.is_none();
                let expected = "an error number, because its write flag is FALSE";
                record.check(assumed(SDA_9), passed, expected, "a success");
                let given = to_u32(write.content().bytes.len());
                if let Some(length) = element.length {
                    let expected = || format!("the {} of the element", plural(length, "byte"));
                    let mut record = self.records.on(Topic::ClientSda, self.observation);
                    record.check(SDA_8, given == length, expected, || plural(given, "byte"));
                }
                return;
            }
            _ => return,
        }
        // Element 0 is the number of element types. Its size of 4 bytes is assumed, so it is not
        // checked.
        if call.index_offset.get() & 0xFFF == 0 {
            return;
        }
        // Length and type are compared as soon as both are known.
        let (Some(data_type), Some(length)) = (element.data_type, element.length) else { return };
        check_length(&mut record, Some(data_type), length, &at);
    }

    fn instance(&mut self, find: &FindInstance, address: ObjectAddress) {
        let mut record = self.records.on(Topic::CncSda, self.observation);
        let class = find.class_group().class;
        let query = find.query();
        if address == ObjectAddress::NONE {
            record.pass(SDA_2);
            return;
        }
        let found = || format!("({}, {})", address.index_group, address.index_offset);
        let Some(Group::Class(group)) = address.index_group.parts() else {
            record.check(ADR_5, false, "the group of a class", found);
            return;
        };
        let record = &mut self.records.on(Topic::CncSda, self.observation);
        // If the request contains the rank of a channel, the instance in the reply is not checked.
        let is_by_number = find.class_group().addressing == Addressing::Logical;
        let instance = (is_by_number || class == Class::Spindle).then_some(query.channel);
        check_group(record, (class, instance), group);
        check_offset(record, (class, query.channel, query.axis), address.index_offset);
    }
}

/// Checks the group in the address of an instance: the group must match the class. If the number of
/// the instance is known, the group must also match the number and have the logical bit, or for a
/// spindle lack this bit.
pub(crate) fn check_group(
    record: &mut impl Checks,
    (class, instance): (Class, Option<u32>),
    group: ClassGroup,
) {
    let found = || format!("{} for the {class}", group.index_group());
    let of_class = group.class == class && group.attribute == Attribute::Content;
    record.check(ADR_5, of_class, || format!("the content group of the {class}"), found);
    let Some(instance) = instance else { return };
    let rule = if class == Class::Spindle { ADR_2 } else { ADR_5 };
    let same = u32::from(group.instance) == instance;
    record.check(rule, same, || format!("the group of instance {instance}"), found);
    let logical = group.addressing == Addressing::Logical;
    if class == Class::Spindle {
        record.check(ADR_2, !logical, "a group without the logical bit", found);
    } else {
        record.check(ADR_5, logical, "a group with the logical bit, as in the request", found);
        if matches!(class, Class::Decoder | Class::Hld) {
            record.check(SDA_3, logical, "the group printed in the manual", found);
        }
    }
}

/// Checks the offset in the address of an instance. The manual prints the offset of a channel, the
/// stride of the axes of the decoder, and the offset of one axis of the HLD. For other axes, both
/// strides are accepted, and the rule is assumed.
pub(crate) fn check_offset(
    record: &mut impl Checks,
    (class, channel, axis): (Class, u32, u32),
    offset: IndexOffset,
) {
    let of = |stride| IndexOffset::for_axis(stride, axis, 0).ok();
    let (rule, expected) = match (class, axis) {
        (_, 0) => (Rule::from(SDA_1), vec![Some(IndexOffset::new(0))]),
        (Class::Hld, 1) if channel == 0 => (Rule::from(SDA_3), vec![of(AxisStride::X1000)]),
        (Class::Decoder, _) => (Rule::from(ADR_7), vec![of(AxisStride::X10000)]),
        _ => (assumed(ADR_7), vec![of(AxisStride::X10000), of(AxisStride::X1000)]),
    };
    let shown: Vec<String> = expected.iter().flatten().map(ToString::to_string).collect();
    let found = || format!("offset {offset} of the {class}, axis {axis}");
    let swapped = Some(IndexOffset::new(offset.get().swap_bytes()));
    let is_swapped = axis > 0 && expected.contains(&swapped);
    record.check(SDA_1, !is_swapped, "the lowest byte of the offset first", found);
    record.check(rule, expected.contains(&Some(offset)), shown.join(" or "), found);
}

/// The index group and the index offset of the content of the element that a call addresses.
fn key(call: &Call<'_>) -> Option<(u32, u32)> {
    let Some(Group::Class(group)) = call.index_group.parts() else { return None };
    let mut content = group;
    content.attribute = Attribute::Content;
    let group: IndexGroup = content.index_group();
    Some((group.get(), call.index_offset.get()))
}

#[cfg(test)]
mod tests {
    use ads_cnc_vectors::Level;

    use super::*;
    use crate::evidence::Evidence;
    use crate::rules::Observation;
    use crate::rules::topic::TopicRecords;

    struct Unobserved;

    impl Observation for Unobserved {
        fn evidence(&self) -> Evidence {
            Evidence::default()
        }
    }

    /// GEN-5 and its parts state the size of each of these types at the level *must*.
    #[test]
    fn a_length_that_is_not_the_size_of_the_type_fails() {
        for data_type in DataType::ALL.into_iter().filter(|one| element_type(one.name()).is_some())
        {
            let Some(size) = data_type.size() else { continue };
            let mut records = TopicRecords::new();
            let of_type = Some(data_type);
            let at = "an element";
            check_length(&mut records.on(Topic::CncSda, &Unobserved), of_type, size + 1, &at);
            assert_eq!(records.failed(), 1, "{data_type}");
        }
    }

    #[test]
    fn a_type_name_of_another_width_is_not_an_error() {
        for other in ["UNS64", "SGN64", "REAL80"] {
            assert_eq!(name_rule(other).level, Some(Level::Info), "{other}");
        }
        for wrong in ["UNS8", "uns08", "DWORD", "BOOL", "LWORD", "", "UNS008", "REAL"] {
            assert_eq!(
                (name_rule(wrong).level, element_type(wrong)),
                (Some(Level::Must), None),
                "{wrong:?}"
            );
        }
        let known = DataType::ALL.into_iter().filter(|one| element_type(one.name()) == Some(*one));
        assert_eq!(known.count(), 10);
    }
}
