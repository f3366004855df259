//! Defects of numbers and lists (COM, DYN, SDA, VAR).

use ads_cnc_vectors::ids::*;
use serde_json::Value as Json;

use super::json::{each, lists, numbers};
use super::row::{CodecDefect, CodecFault, row};

#[rustfmt::skip]
pub(super) const ROWS: &[CodecDefect] = &[
    row("codec.element.flag-inverted", &[SDA_9], "the codec inverts the write flag of an element",
        CodecFault::Value(|stream, value| {
            if stream == "element-write-flag" {
                numbers(value, &["BOOLEAN"], |number| i128::from(number == 0));
            }
        })),
    row("codec.element.length-one-byte", &[SDA_8],
        "the codec uses only the lowest byte of the length of an element",
        CodecFault::Value(|stream, value| {
            if stream == "element-length" {
                numbers(value, &["UNS32", "UNS16", "UNS08"], |number| number & 0xFF);
            }
        })),
    row("codec.list.indices-reversed", &[VAR_11, VAR_12],
        "the codec reverses the order of the indices in requests by handle",
        CodecFault::Value(|stream, value| {
            if stream != "variable-path" {
                lists(value, "indices", |items| items.reverse());
            }
        })),
    row("codec.list.indices-first", &[VAR_11, VAR_12],
        "the codec keeps only the first index in requests by handle",
        CodecFault::Value(|stream, value| {
            if stream != "variable-path" {
                lists(value, "indices", |items| items.truncate(1));
            }
        })),
    row("codec.list.indices-none", &[VAR_11],
        "the codec omits the indices in a read by handle",
        CodecFault::Value(|stream, value| {
            if stream == "variable-handle-read" {
                lists(value, "indices", Vec::clear);
            }
        })),
    row("codec.list.dimensions-reversed", &[VAR_4],
        "the codec reverses the order of the dimensions in a description",
        CodecFault::Value(|_, value| lists(value, "dimensions", |items| items.reverse()))),
    row("codec.list.dimensions-first", &[VAR_4],
        "the codec keeps only the first dimension in a description",
        CodecFault::Value(|_, value| lists(value, "dimensions", |items| items.truncate(1)))),
    row("codec.list.elements-reversed", &[VAR_14],
        "the codec reverses the order of the elements of a value",
        CodecFault::Value(|_, value| lists(value, "value", |items| items.reverse()))),
    row("codec.list.elements-first", &[VAR_14], "the codec keeps only the first element of a value",
        CodecFault::Value(|_, value| lists(value, "value", |items| items.truncate(1)))),
    row("codec.list.descriptors-same", &[COM_3],
        "the codec replaces each descriptor in a list by the first",
        CodecFault::Value(|_, value| {
            lists(value, "descriptors", |items| {
                let first = items.first().cloned();
                items.iter_mut().for_each(|item| *item = first.clone().unwrap_or_default());
            })
        })),
    row("codec.list.descriptors-reversed", &[COM_3],
        "the codec reverses the order of the descriptors in a list",
        CodecFault::Value(|_, value| lists(value, "descriptors", |items| items.reverse()))),
    row("codec.list.descriptors-last-missing", &[COM_3],
        "the codec omits the last of several descriptors",
        CodecFault::Value(|_, value| {
            lists(value, "descriptors", |items| {
                if items.len() > 1 {
                    items.pop();
                }
            })
        })),
    row("codec.number.unsigned-31-bit", &[VAR_5, VAR_14],
        "the codec clears the highest bit of each UNS32",
        CodecFault::Value(|_, value| numbers(value, &["UNS32"], |number| number & 0x7FFF_FFFF))),
    row("codec.number.unsigned-signed", &[VAR_5, VAR_14],
        "the codec treats UNS08, UNS16 and UNS32 as signed numbers",
        CodecFault::Value(|_, value| {
            numbers(value, &["UNS32"], |number| {
                if number >> 31 == 1 { number.wrapping_sub(1 << 32) } else { number }
            });
            numbers(value, &["UNS16"], |number| {
                if number >> 15 == 1 { number.wrapping_sub(1 << 16) } else { number }
            });
            numbers(value, &["UNS08"], |number| {
                if number >> 7 == 1 { number.wrapping_sub(1 << 8) } else { number }
            });
        })),
    row("codec.number.signed-unsigned", &[VAR_5, VAR_14],
        "the codec treats signed integers of 1, 2 and 4 bytes as unsigned numbers",
        CodecFault::Value(|_, value| {
            numbers(value, &["SGN32", "DINT"], |number| number.rem_euclid(1 << 32));
            numbers(value, &["SGN16", "INT"], |number| number.rem_euclid(1 << 16));
            numbers(value, &["SGN08", "SINT"], |number| number.rem_euclid(1 << 8));
        })),
    row("codec.number.content-signed", &[COM_5], "the codec drops the sign of integers in contents",
        CodecFault::Value(|stream, value| {
            if stream == "content" {
                let signed = ["SGN08", "SGN16", "SGN32", "SINT", "INT", "DINT", "LINT"];
                numbers(value, &signed, i128::abs);
            }
        })),
    row("codec.number.types-from-0", &[VAR_5],
        "the codec counts the type codes of variables from 0 instead of 1",
        CodecFault::Value(|stream, value| {
            if let (true, Some(kind)) = (stream.starts_with("variable-desc"), value.get_mut("type"))
            {
                numbers(kind, &["UNS32"], |number| number.saturating_sub(1));
            }
        })),
    row("codec.number.access-from-0", &[VAR_6],
        "the codec counts the access codes of variables from 0 instead of 1",
        CodecFault::Value(|stream, value| {
            if let (true, Some(access)) =
                (stream.starts_with("variable-desc"), value.get_mut("access"))
            {
                numbers(access, &["UNS32"], |number| number.saturating_sub(1));
            }
        })),
    row("codec.real.narrow", &[DYN_3, VAR_14, COM_5],
        "the codec reduces a REAL64 to the precision of a REAL32",
        CodecFault::Value(|_, value| {
            each(value, &mut |one| {
                let bits =
                    one.get("bits").and_then(Json::as_str).and_then(|it| it.strip_prefix("0x"));
                let bits =
                    bits.filter(|bits| bits.len() == 16).map(|bits| u64::from_str_radix(bits, 16));
                if let Some(Ok(bits)) = bits {
                    // Clears the low 29 of the 52 bits of the fraction, so that a REAL32 can
                    // represent the fraction.
                    let bits = bits & !0x1FFF_FFFF;
                    one.insert("bits".to_owned(), Json::String(format!("{bits:#018x}")));
                    one.insert(
                        "value".to_owned(),
                        Json::String(format!("{:?}", f64::from_bits(bits))),
                    );
                }
            })
        })),
    row("codec.number.indices-in-bytes", &[VAR_11],
        "the codec writes the length of the indices in bytes instead of their number",
        CodecFault::Bytes(|stream, mut bytes| {
            if let (true, Some(count)) = (stream == "variable-handle-read", bytes.get_mut(4)) {
                *count = count.wrapping_mul(4);
            }
            bytes
        })),
];
