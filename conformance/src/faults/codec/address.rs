//! Defects of addresses and names (ADR, GEN, VAR).

use ads_cnc_vectors::ids::*;
use serde_json::Value as Json;

use super::json::{lists, numbers, words};
use super::row::{CodecDefect, CodecFault, row};

#[rustfmt::skip]
pub(super) const ROWS: &[CodecDefect] = &[
    row("codec.address.index-logical", &[ADR_1],
        "the codec exchanges logical addressing and addressing by index in index groups",
        CodecFault::Value(|_, value| words(value, "addressing", &[("logical", "index")]))),
    row("codec.address.object-element", &[ADR_4],
        "the codec exchanges object access and element access in index groups of COM",
        CodecFault::Value(|_, value| words(value, "access", &[("object", "element")]))),
    row("codec.address.table", &[ADR_3],
        "the codec exchanges channels and platform axes in index groups of COM",
        CodecFault::Value(|_, value| words(value, "table", &[("channel", "axis")]))),
    row("codec.address.classes", &[ADR_5],
        "the codec exchanges HLD with path preparation, and interpolator with decoder",
        CodecFault::Value(|_, value| {
            words(value, "class", &[("hld", "path-preparation"), ("interpolator", "decoder")]);
        })),
    row("codec.address.attributes", &[ADR_6],
        "the codec exchanges the attributes name and type, and length and unit",
        CodecFault::Value(|_, value| words(value, "attribute", &[("name", "type"), ("length", "unit")]))),
    row("codec.address.instance-from-0", &[GEN_6, ADR_2],
        "the codec reads and writes channels, axes and spindles in index groups one too low",
        CodecFault::Value(|stream, value| match value.get_mut("instance") {
            Some(instance) if stream == "index-group" => {
                numbers(instance, &["UNS08"], |number| number.saturating_sub(1));
            }
            _ => {}
        })),
    row("codec.address.spindle-from-1", &[ADR_2, GEN_6],
        "the codec counts spindles in index groups from 1",
        CodecFault::Value(|_, value| {
            let spindle = value.pointer("/class/value").and_then(Json::as_str) == Some("spindle");
            if let (true, Some(instance)) = (spindle, value.get_mut("instance")) {
                numbers(instance, &["UNS08"], |number| number.saturating_add(1));
            }
        })),
    row("codec.address.index-unknown", &[ADR_12],
        "the codec does not split index groups without the bit of logical addressing into parts",
        CodecFault::Value(|_, value| {
            let index = value.pointer("/addressing/value").and_then(Json::as_str) == Some("index");
            if let (true, Json::Object(fields)) = (index, value) {
                fields.retain(|name, _| name == "index_group");
            }
        })),
    row("codec.address.stride-10000", &[ADR_8],
        "the codec uses the stride 0x10000 even if another stride is given",
        CodecFault::Around(|correct, question| {
            let mut other = question.clone();
            other.context.stride = question.context.stride.as_ref().map(|_| "0x10000".to_owned());
            correct(&other)
        })),
    row("codec.address.stride-1000", &[ADR_7],
        "the codec uses the stride 0x1000 even if another stride is given",
        CodecFault::Around(|correct, question| {
            let mut other = question.clone();
            other.context.stride = question.context.stride.as_ref().map(|_| "0x1000".to_owned());
            correct(&other)
        })),
    row("codec.address.axis-swapped", &[ADR_7, ADR_8],
        "the codec exchanges axis and element of an index offset",
        CodecFault::Swaps("index-offset", "axis", "element")),
    row("codec.path.reversed", &[VAR_20],
        "the codec reverses the order of the parts of a variable's name",
        CodecFault::Value(|stream, value| {
            if stream == "variable-path" {
                lists(value, "parts", |items| items.reverse());
            }
        })),
    row("codec.path.indices-lost", &[VAR_20], "the codec drops the indices in a variable's name",
        CodecFault::Value(|stream, value| {
            if stream == "variable-path" {
                lists(value, "indices", Vec::clear);
            }
        })),
    row("codec.path.structures-lost", &[VAR_20],
        "the codec keeps only the kind and the last part of a variable's name",
        CodecFault::Value(|stream, value| {
            if stream == "variable-path" {
                lists(value, "parts", |items| {
                    let before = items.len().saturating_sub(1);
                    items.drain(..before);
                });
            }
        })),
];
