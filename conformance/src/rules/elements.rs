//! Instances and elements of SDA and GEO, compared across exchanges.

use ads_cnc::CncStr;
use ads_cnc::address::{Addressing, Attribute, AxisStride, Class, Group, IndexGroup, IndexOffset};
use ads_cnc::operation::{Call, FindInstance, Reply, Request};
use ads_cnc::sda::ObjectAddress;
use ads_cnc::value::DataType;
use ads_cnc_vectors::ids::*;

use super::Observation;
use super::knowledge::ExchangeJudge;
use super::topic::Topic;
use crate::judge::{Checks as _, Rule, assumed, online};

/// Whether a type is one that the manual prints for elements.
fn is_known(name: CncStr<'_>) -> bool {
    let known = ["UNS08", "SGN08", "UNS16", "SGN16", "UNS32", "SGN32", "REAL32", "REAL64"];
    known.iter().chain(&["BOOLEAN", "STRING"]).any(|known| name == *known)
}

/// The size of BOOLEAN is stated in the manual, other sizes are assumed.
fn size_rule(data_type: DataType) -> Rule {
    if data_type == DataType::Boolean { GEN_5.into() } else { online(GEN_5) }
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
        let mut record = self.records.on(Topic::CncSda, observation);
        match (request, reply) {
            (Request::ReadElementType(_), Some(Reply::ElementText(text))) => {
                let name = text.text.text();
                let found = || format!("{name:?}");
                record.check(assumed(SDA_7), is_known(name), "a type of the manual", found);
                record.check(SDA_7, !name.is_empty(), "the name of a type", found);
                element.data_type = DataType::by_name(name);
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
                let given = u32::try_from(content.bytes.len()).unwrap_or(u32::MAX);
                if let Some(length) = element.length.filter(|length| call.read_length >= *length) {
                    let expected = || format!("the {length} bytes it says to have");
                    record.check(SDA_8, given == length, expected, || format!("{given} bytes"));
                }
                return;
            }
            (Request::WriteElement(write), reply) => {
                let passed = element.writable != Some(false) || reply.is_none();
                let expected = "an error number: its write flag is FALSE";
                record.check(assumed(SDA_9), passed, expected, "a success");
                let given = u32::try_from(write.content().bytes.len()).unwrap_or(u32::MAX);
                if let Some(length) = element.length {
                    let expected = || format!("the {length} bytes of the element");
                    let mut record = self.records.on(Topic::ClientSda, observation);
                    record.check(SDA_8, given == length, expected, || format!("{given} bytes"));
                }
                return;
            }
            _ => return,
        }
        // Compares length and type as soon as both are known.
        let (Some(data_type), Some(length)) = (element.data_type, element.length) else { return };
        let Some(size) = data_type.size() else { return };
        let found = || format!("a length of {length}");
        let expected = || format!("the {size} bytes of {}", data_type.name());
        record.check(size_rule(data_type), length == size, expected, found);
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
        let of_class = group.class == class && group.attribute == Attribute::Content;
        record.check(ADR_5, of_class, || format!("the content of {class:?}"), found);
        // Queried by index, the returned rank may differ from the requested one.
        if group.addressing == Addressing::Logical || class == Class::Spindle {
            let same = u32::from(group.instance) == query.channel;
            record.check(ADR_5, same, || format!("the group of instance {}", query.channel), found);
        }
        let of = |stride| IndexOffset::for_axis(stride, query.axis, 0).ok();
        let (rule, expected) = match (class, query.axis) {
            (_, 0) => (Rule::from(SDA_1), vec![Some(IndexOffset::new(0))]),
            (Class::Decoder, _) => (Rule::from(ADR_7), vec![of(AxisStride::X10000)]),
            _ => (assumed(ADR_7), vec![of(AxisStride::X10000), of(AxisStride::X1000)]),
        };
        let passed = expected.contains(&Some(address.index_offset));
        record.check(rule, passed, || format!("the first element of axis {}", query.axis), found);
    }
}

/// Index group and index offset of an element's content.
fn key(call: &Call<'_>) -> Option<(u32, u32)> {
    let Some(Group::Class(group)) = call.index_group.parts() else { return None };
    let mut content = group;
    content.attribute = Attribute::Content;
    let group: IndexGroup = content.index_group();
    Some((group.get(), call.index_offset.get()))
}
