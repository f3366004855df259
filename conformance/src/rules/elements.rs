//! Instances and elements of SDA and GEO, compared across exchanges.

use std::fmt::Display;

use ads_cnc::address::{
    Addressing, Attribute, AxisStride, Class, ClassGroup, Group, IndexGroup, IndexOffset,
};
use ads_cnc::operation::{Call, FindInstance, Reply, Request};
use ads_cnc::sda::ObjectAddress;
use ads_cnc::value::DataType;
use ads_cnc_vectors::ids::*;

use super::knowledge::ExchangeJudge;
use super::observation::Observation;
use super::topic::Topic;
use crate::judge::{Checks, Rule, assumed, online};
use crate::number::to_u32;
use crate::text::plural;

/// The type of an element with this type name: a type of variables, or REAL32.
pub(crate) fn element_type(name: &str) -> Option<DataType> {
    let is_of_objects_only = |one: &DataType| matches!(one, DataType::Lint | DataType::Lword);
    DataType::ALL.into_iter().find(|one| one.name() == name && !is_of_objects_only(one))
}

/// The rule for a type name that is not in the manual's list: a name of the same pattern with another
/// width may continue the list; another name for a listed type violates it.
fn name_rule(name: &str) -> Rule {
    let digits = ["UNS", "SGN", "REAL"].into_iter().find_map(|one| name.strip_prefix(one));
    let is_alike = digits.is_some_and(|digits| {
        digits.len() == 2 && digits.bytes().all(|byte| byte.is_ascii_digit())
    });
    if is_alike { assumed(SDA_7) } else { SDA_7.into() }
}

/// The rules for the length of an element of a type. The tables of dynamic parameters print the sizes
/// of UNS32 and REAL64, an example prints that of BOOLEAN, and the others are documented online.
/// A failure does not show whether the type or the length is wrong, so the rules of both are returned.
fn length_rules(data_type: DataType) -> [Rule; 3] {
    let of_size = if data_type == DataType::Boolean { GEN_5.into() } else { online(GEN_5) };
    match data_type {
        DataType::Boolean | DataType::Uns32 | DataType::Real64 => {
            [SDA_7.into(), SDA_8.into(), of_size]
        }
        _ => [online(SDA_7), online(SDA_8), of_size],
    }
}

/// Checks the name of an element's type. Returns the type, if the manual has it.
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

/// Checks the length of an element of a type.
pub(crate) fn check_length(
    record: &mut impl Checks,
    data_type: Option<DataType>,
    length: u32,
    at: &impl Display,
) {
    let found = || format!("{} of {at}", plural(length, "byte"));
    if let Some((data_type, size)) = data_type.and_then(|one| Some((one, one.size()?))) {
        let expected = || format!("the {} of {data_type}", plural(size, "byte"));
        record.check(length_rules(data_type), length == size, expected, found);
        record.check(SDA_8, length > 0, "a length of at least 1 byte", found);
    } else {
        record.check(assumed(SDA_8), length > 0, "a length of at least 1 byte", found);
    }
}

impl ExchangeJudge<'_> {
    pub(super) fn elements(
        &mut self,
        observation: &dyn Observation,
        request: &Request<'_>,
        reply: Option<&Reply<'_>>,
        call: &Call<'_>,
    ) {
        if let (Request::FindInstance(find), Some(Reply::ObjectAddress(address))) = (request, reply)
        {
            self.instance(observation, find, *address);
            return;
        }
        let Some(key) = key(call) else { return };
        let all = &mut self.cnc.elements.known;
        if !all.contains_key(&key) && !self.budget.take(0) {
            return;
        }
        let element = all.entry(key).or_default();
        let at = format!("the element at {}, {}", call.index_group, call.index_offset);
        let mut record = self.records.on(Topic::CncSda, observation);
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
                    let mut record = self.records.on(Topic::ClientSda, observation);
                    record.check(SDA_8, given == length, expected, || plural(given, "byte"));
                }
                return;
            }
            _ => return,
        }
        // That the number of elements, which is element 0, has 4 bytes is assumed.
        if call.index_offset.get() & 0xFFF == 0 {
            return;
        }
        // Length and type are compared as soon as both are known.
        let (Some(data_type), Some(length)) = (element.data_type, element.length) else { return };
        check_length(&mut record, Some(data_type), length, &at);
    }

    fn instance(
        &mut self,
        observation: &dyn Observation,
        find: &FindInstance,
        address: ObjectAddress,
    ) {
        let mut record = self.records.on(Topic::CncSda, observation);
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
        let record = &mut self.records.on(Topic::CncSda, observation);
        // If requested by rank, the returned rank may differ from the requested one.
        let is_by_number = find.class_group().addressing == Addressing::Logical;
        let instance = (is_by_number || class == Class::Spindle).then_some(query.channel);
        check_group(record, (class, instance), group);
        check_offset(record, (class, query.channel, query.axis), address.index_offset);
    }
}

/// Checks the group in the address of an instance: it must match the class and the number, if known.
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

/// Checks the offset in the address of an instance, which is printed for the decoder and for one axis
/// of the HLD.
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

/// Index group and index offset of an element's content.
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
