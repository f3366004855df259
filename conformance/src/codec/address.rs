//! Decodes and encodes index groups and index offsets, which are not streams of the codec.

use std::fmt::Display;

use ads_cnc::address::{
    Access, Addressing, Attribute, AxisStride, Channel, Class, ClassGroup, ComGroup, ComTable,
    Group, IndexGroup, IndexOffset, PlatformAxis, Spindle,
};
use ads_cnc::{Decode, Encode as _, Error, ObjectCount};
use ads_cnc_vectors::{Context, Type};

use super::field_reader::FieldReader;
use super::{CodecError, Decoded, collect, name, one, uns32};

/// Decodes the bytes of an index group or index offset.
fn number(bytes: &[u8]) -> Result<u32, CodecError> {
    Ok(ObjectCount::decode(bytes)?.0)
}

pub(super) fn index_group(context: &Context, bytes: &[u8]) -> Result<Decoded, CodecError> {
    let group = IndexGroup::new(number(bytes)?);
    if let Some(base) = context.base {
        let again = of_base(IndexGroup::new(base), group)?;
        if again != group {
            return Err(CodecError::Unsupported(format!(
                "the group {group} is not of the base {base:#x}, but {again}"
            )));
        }
    }
    let mut fields = vec![("index_group", uns32(group.get()))];
    let parts = group.parts();
    match parts {
        None => {}
        Some(Group::Com(com)) => fields.extend([
            ("task", name("COM")),
            ("addressing", name(addressing(com.addressing))),
            ("access", name(if com.access == Access::Object { "object" } else { "element" })),
            ("table", name(if com.table == ComTable::Axis { "axis" } else { "channel" })),
            ("instance", one(Type::Uns08, com.instance)),
        ]),
        Some(Group::Class(class)) => fields.extend([
            ("task", name("SDA/GEO")),
            ("addressing", name(addressing(class.addressing))),
            ("access", name("element")),
            ("class", name(&hyphenated(class.class))),
            ("attribute", name(&hyphenated(class.attribute))),
            ("instance", one(Type::Uns08, class.instance)),
        ]),
    }
    let again = parts.map_or(group, Group::index_group);
    Ok(Decoded { fields: collect(fields), bytes: again.get().to_le_bytes().to_vec() })
}

/// Encodes the group of the channel, axis or spindle whose number is the difference between `group`
/// and `base`, the group of the number 0.
fn of_base(base: IndexGroup, group: IndexGroup) -> Result<IndexGroup, CodecError> {
    let lacks = || CodecError::Unsupported(format!("{base} is not the base of {group}"));
    // The number of a group below the base is out of every range.
    let number = group.get().wrapping_sub(base.get());
    Ok(match base.parts().ok_or_else(lacks)? {
        // The base itself: the group of the platform, or a group without an axis or a channel.
        _ if number == 0 => base,
        Group::Com(com) if com.table == ComTable::Axis => {
            PlatformAxis::new(number)?.com(com.access)
        }
        Group::Com(com) => channel(com.addressing, number)?.com(com.access),
        Group::Class(class) if class.class == Class::Spindle => {
            Spindle::new(number)?.class(class.attribute)
        }
        Group::Class(class) => {
            channel(class.addressing, number)?.class(class.class, class.attribute)
        }
    })
}

fn channel(addressing: Addressing, number: u32) -> Result<Channel, Error> {
    match addressing {
        Addressing::Logical => Channel::new(number),
        Addressing::Index => Channel::by_index(number),
    }
}

fn addressing(addressing: Addressing) -> &'static str {
    match addressing {
        Addressing::Logical => "logical",
        Addressing::Index => "index",
    }
}

/// The word of the vectors for a class or an attribute, such as `write-flag`.
pub(crate) fn hyphenated(shown: impl Display) -> String {
    shown.to_string().to_lowercase().replace(' ', "-")
}

pub(super) fn index_offset(context: &Context, bytes: &[u8]) -> Result<Decoded, CodecError> {
    let stride = stride(context)?;
    let (axis, element) = IndexOffset::new(number(bytes)?).axis_and_element(stride)?;
    let again = IndexOffset::for_axis(stride, axis, element)?;
    // `axis_and_element` rejects an axis of more than 16 bits.
    let fields = vec![("axis", one(Type::Uns16, axis)), ("element", one(Type::Uns16, element))];
    Ok(Decoded { fields: collect(fields), bytes: again.get().to_le_bytes().to_vec() })
}

/// Encodes a group from its number. If the fields also contain its parts, checks that the parts
/// encode to the same number.
pub(super) fn encode_group(of: FieldReader<'_>) -> Result<Vec<u8>, CodecError> {
    let number = of.number("index_group")?;
    let group = if of.has("task") { parts(of)?.index_group() } else { IndexGroup::new(number) };
    if group.get() == number {
        Ok(ObjectCount(number).encode_to_vec()?)
    } else {
        Err(CodecError::InvalidFields(format!("{number:#x}, but its parts encode to {group}")))
    }
}

fn parts(of: FieldReader<'_>) -> Result<Group, CodecError> {
    let no = |what: &str, word: &str| CodecError::InvalidFields(format!("unknown {what} {word}"));
    let addressings = [Addressing::Logical, Addressing::Index];
    let word = of.word("addressing")?;
    let addressing = addressings.into_iter().find(|&one| addressing(one) == word);
    let addressing = addressing.ok_or_else(|| no("addressing", word))?;
    let instance = of.number("instance")?;
    match of.word("task")? {
        "COM" => {
            let access = match of.word("access")? {
                "object" => Access::Object,
                "element" => Access::Element,
                other => return Err(no("access", other)),
            };
            let table = match of.word("table")? {
                "axis" => ComTable::Axis,
                "channel" => ComTable::Channel,
                other => return Err(no("table", other)),
            };
            Ok(Group::Com(ComGroup { addressing, access, table, instance }))
        }
        "SDA/GEO" => {
            let (class, attribute) = (of.word("class")?, of.word("attribute")?);
            let known = Class::ALL.into_iter().find(|&one| hyphenated(one) == class);
            let class = known.ok_or_else(|| no("class", class))?;
            let known = Attribute::ALL.into_iter().find(|&one| hyphenated(one) == attribute);
            let attribute = known.ok_or_else(|| no("attribute", attribute))?;
            Ok(Group::Class(ClassGroup { addressing, class, attribute, instance }))
        }
        other => Err(no("task", other)),
    }
}

pub(super) fn encode_offset(of: FieldReader<'_>, context: &Context) -> Result<Vec<u8>, CodecError> {
    let stride = stride(context)?;
    let offset = IndexOffset::for_axis(stride, of.number("axis")?, of.number("element")?)?;
    Ok(ObjectCount(offset.get()).encode_to_vec()?)
}

fn stride(context: &Context) -> Result<AxisStride, CodecError> {
    match context.stride {
        Some(0x1_0000) => Ok(AxisStride::X10000),
        Some(0x1000) => Ok(AxisStride::X1000),
        other => Err(CodecError::Unsupported(format!("the axis stride {other:?}"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A group is its base plus a number of at most 255.
    #[test]
    fn a_group_belongs_to_its_base() {
        for base in [0x12_0200, 0x13_0200, 0x12_1300, 0x02_1300] {
            let of = |group| of_base(IndexGroup::new(base), IndexGroup::new(group));
            assert_eq!(of(base).unwrap(), IndexGroup::new(base));
            assert_eq!(of(base + 1).unwrap(), IndexGroup::new(base + 1));
            for other in [base - 1, base + 0x100, 0] {
                assert!(matches!(of(other), Err(CodecError::Error(_))), "{base:#x}, {other:#x}");
            }
        }
    }
}
