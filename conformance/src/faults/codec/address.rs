//! Defects of addresses and names (ADR, VAR).

use ads_cnc_vectors::ids::*;
use serde_json::Value as Json;

use super::json::{lists, numbers, words};
use super::row::{CodecDefect, CodecFault, row};

#[rustfmt::skip]
pub(super) const ROWS: &[CodecDefect] = &[
    row("codec.address.index-logical", &[ADR_1],
        "groups with the bit of logical addressing are by index, those without logical",
        CodecFault::Value(|_, value| words(value, "addressing", &[("logical", "index")]))),
    row("codec.address.object-element", &[ADR_4], "object access of COM is taken for element access",
        CodecFault::Value(|_, value| words(value, "access", &[("object", "element")]))),
    row("codec.address.table", &[ADR_3], "tables of COM: that of channels is taken for that of axes",
        CodecFault::Value(|_, value| words(value, "table", &[("channel", "axis")]))),
    row("codec.address.classes", &[ADR_5], "HLD is taken for path preparation, interpolator for decoder",
        CodecFault::Value(|_, value| {
            words(value, "class", &[("hld", "path-preparation"), ("interpolator", "decoder")]);
        })),
    row("codec.address.attributes", &[ADR_6], "name is taken for type, length for unit",
        CodecFault::Value(|_, value| words(value, "attribute", &[("name", "type"), ("length", "unit")]))),
    row("codec.address.instance-from-0", &[GEN_6, ADR_2],
        "instances are counted from 0, spindles from -1",
        CodecFault::Value(|stream, value| match value.get_mut("instance") {
            Some(instance) if stream == "index-group" => {
                numbers(instance, &["UNS08"], |number| number.saturating_sub(1));
            }
            _ => {}
        })),
    row("codec.address.spindle-from-1", &[ADR_2, GEN_6], "spindles are counted from 1",
        CodecFault::Value(|_, value| {
            let spindle = value.pointer("/class/value").and_then(Json::as_str) == Some("spindle");
            if let (true, Some(instance)) = (spindle, value.get_mut("instance")) {
                numbers(instance, &["UNS08"], |number| number.saturating_add(1));
            }
        })),
    row("codec.address.index-unknown", &[ADR_12],
        "groups without the bit of logical addressing are numbers and nothing else",
        CodecFault::Value(|_, value| {
            let index = value.pointer("/addressing/value").and_then(Json::as_str) == Some("index");
            if let (true, Json::Object(fields)) = (index, value) {
                fields.retain(|name, _| name == "index_group");
            }
        })),
    row("codec.address.stride-10000", &[ADR_8], "the stride is 0x10000 whatever is said",
        CodecFault::Around(|correct, question| {
            let mut other = question.clone();
            other.context.stride = question.context.stride.as_ref().map(|_| "0x10000".to_owned());
            correct(&other)
        })),
    row("codec.address.stride-1000", &[ADR_7], "the stride is 0x1000 whatever is said",
        CodecFault::Around(|correct, question| {
            let mut other = question.clone();
            other.context.stride = question.context.stride.as_ref().map(|_| "0x1000".to_owned());
            correct(&other)
        })),
    row("codec.address.axis-swapped", &[ADR_7, ADR_8],
        "the axis of an index offset is taken for the element",
        CodecFault::Swaps("index-offset", "axis", "element")),
    row("codec.path.reversed", &[VAR_20], "the parts of a name come in reverse order",
        CodecFault::Value(|stream, value| {
            if stream == "variable-path" {
                lists(value, "parts", |items| items.reverse());
            }
        })),
    row("codec.path.indices-lost", &[VAR_20], "indices in names are lost",
        CodecFault::Value(|stream, value| {
            if stream == "variable-path" {
                lists(value, "indices", Vec::clear);
            }
        })),
    row("codec.path.structures-lost", &[VAR_20], "of a name there is the kind and the last part",
        CodecFault::Value(|stream, value| {
            if stream == "variable-path" {
                lists(value, "parts", |items| {
                    let before = items.len().saturating_sub(1);
                    items.drain(..before);
                });
            }
        })),
];
