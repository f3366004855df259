//! Conditions that decide which functions can have a generated defect.

use ads_cnc::address::Attribute;
use ads_cnc::layout::Type;
use ads_cnc::operation::{Effect, FunctionSpec, GroupRule, OffsetRule};

use super::super::cnc::first;

pub(super) fn has_reply(spec: &FunctionSpec) -> bool {
    spec.reply.is_some()
}

/// Whether the reply has more than one field.
pub(super) fn has_fields(spec: &FunctionSpec) -> bool {
    spec.reply.is_some_and(|reply| reply.layout().fields.len() > 1)
}

/// Whether the end of the reply is specified exactly: its last field is not a text, whose NUL is
/// optional.
pub(super) fn has_end(spec: &FunctionSpec) -> bool {
    let last = spec.reply.and_then(|reply| reply.layout().fields.last());
    last.is_some_and(|field| field.ty != Type::String)
}

/// Whether the function is a query whose index group can contain a channel, by its number or by its
/// rank.
pub(super) fn has_rank(spec: &FunctionSpec) -> bool {
    !matches!(spec.group, GroupRule::Instances) && spec.effect == Effect::Query
}

/// Whether `has_rank` is true, and a channel of the default model whose rank is not its number has
/// data for the function. No such channel has dynamic parameters (DYN-2 to DYN-4).
pub(super) fn differs_by_rank(spec: &FunctionSpec) -> bool {
    has_rank(spec) && !matches!(spec.clause, "DYN-2" | "DYN-3" | "DYN-4")
}

/// Whether channel 1 of the default model can accept a request for another channel and reply
/// differently. It rejects the handles of other channels, and the extended descriptions of
/// variables with the same index are equal in all channels.
pub(super) fn differs_by_channel(spec: &FunctionSpec) -> bool {
    first(spec.request) != b"handle" && spec.clause != "VAR-15" && !is_alike(spec)
}

/// Whether the simulated CNC with the default model sends the same reply for every channel and
/// every axis of a class. These are the replies with the number, types, lengths, units and write
/// flags of elements.
pub(super) fn is_alike(spec: &FunctionSpec) -> bool {
    matches!(spec.group, GroupRule::Elements(attribute) if attribute != Attribute::Name)
        && !spec.is_content()
}

/// Whether the defects that accept an unknown channel or axis are generated for the function. They
/// are not generated if `is_alike` is true, nor for `FindInstance`, which answers an unknown
/// instance with the address (0, 0) instead of an error.
pub(super) fn has_unknown(spec: &FunctionSpec) -> bool {
    !matches!(spec.group, GroupRule::Instances) && !is_alike(spec)
}

pub(super) fn has_axis(spec: &FunctionSpec) -> bool {
    matches!(spec.group, GroupRule::Instances | GroupRule::Elements(_) | GroupRule::ComContent)
        || matches!(spec.offset, OffsetRule::OfAxis(_))
}

pub(super) fn has_index(spec: &FunctionSpec) -> bool {
    matches!(spec.offset, OffsetRule::AtLeast(_)) && !matches!(spec.group, GroupRule::ComContent)
        || matches!(first(spec.request), b"index" | b"handle")
        || matches!(spec.clause, "VAR-13" | "VAR-14")
}

/// Whether the index offset or the request of the function states a kind of variables or
/// parameters.
pub(super) fn has_kind(spec: &FunctionSpec) -> bool {
    matches!(spec.offset, OffsetRule::OfKind(_)) || is_of_kind(spec)
}

/// Whether the request ends with a kind of variables.
pub(super) fn is_of_kind(spec: &FunctionSpec) -> bool {
    let fields = spec.request.map_or(&[][..], |request| request.layout().fields);
    fields.last().is_some_and(|field| field.name == "kind")
}

pub(super) fn is_attribute(spec: &FunctionSpec) -> bool {
    matches!(spec.group, GroupRule::Elements(_))
        && !spec.is_content()
        && !matches!(spec.offset, OffsetRule::FirstElement)
}

/// Whether the function is a write, including the write of data streaming.
pub(super) fn writes(spec: &FunctionSpec) -> bool {
    spec.effect != Effect::Query
}
