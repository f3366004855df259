//! Defects of texts (GEN, COM, VAR).

use ads_cnc::text::cp1252_to_char;
use ads_cnc_vectors::ids::*;

use super::json::{numbers, texts};
use super::row::{CodecDefect, CodecFault, row};

const NAMES: [&str; 4] =
    ["variable-kind", "variable-index-kind", "variable-name", "dynamic-name-request"];

/// The bytes of a stream, with the final NUL changed if the stream is `of`.
fn nul(stream: &str, of: &str, mut bytes: Vec<u8>) -> Vec<u8> {
    if stream == of && bytes.len() > 1 && bytes.last() == Some(&0) {
        bytes.pop();
    }
    bytes
}

#[rustfmt::skip]
pub(super) const ROWS: &[CodecDefect] = &[
    row("codec.text.question-marks", &[GEN_3],
        "characters beyond ASCII are read and written as question marks",
        CodecFault::Value(|_, value| {
            texts(value, |bytes| {
                bytes.into_iter().map(|byte| if byte.is_ascii() { byte } else { b'?' }).collect()
            })
        })),
    row("codec.text.utf-8", &[GEN_3], "texts are read and written in UTF-8", CodecFault::Value(|_, value| {
        texts(value, |bytes| {
            let text: String = bytes.iter().map(|byte| cp1252_to_char(*byte)).collect();
            text.into_bytes()
        })
    })),
    row("codec.text.seven-bits", &[GEN_3], "the highest bit of each character is dropped",
        CodecFault::Value(|_, value| {
            texts(value, |bytes| bytes.into_iter().map(|byte| byte & 0x7F).collect())
        })),
    row("codec.text.upper-case", &[VAR_9, DYN_3, SDA_6, COM_2, SVC_9],
        "texts are read and written in upper case",
        CodecFault::Value(|_, value| texts(value, |bytes| bytes.to_ascii_uppercase()))),
    row("codec.text.cut-20", &[SDA_6, VAR_4], "texts have 20 characters at most",
        CodecFault::Value(|_, value| {
            texts(value, |mut bytes| {
                bytes.truncate(20);
                bytes
            })
        })),
    row("codec.text.service-cut", &[SVC_1, VAR_13], "values of strings have 80 characters at most",
        CodecFault::Value(|stream, value| {
            if stream.starts_with("variable-value") || stream == "variable-name-write" {
                texts(value, |mut bytes| {
                    bytes.truncate(80);
                    bytes
                });
            }
        })),
    row("codec.text.service-uuid", &[SVC_9], "UUIDs are read and written in upper case",
        CodecFault::Value(|_, value| {
            texts(value, |bytes| match bytes.len() {
                36 => bytes.to_ascii_uppercase(),
                _ => bytes,
            })
        })),
    row("codec.nul.missing.variable-kind", &[VAR_1], "kinds are written without a NUL",
        CodecFault::Bytes(|stream, bytes| nul(stream, NAMES[0], bytes))),
    row("codec.nul.missing.variable-index-kind", &[VAR_3],
        "kinds after an index are written without a NUL",
        CodecFault::Bytes(|stream, bytes| nul(stream, NAMES[1], bytes))),
    row("codec.nul.missing.variable-name", &[VAR_9], "names are written without a NUL",
        CodecFault::Bytes(|stream, bytes| nul(stream, NAMES[2], bytes))),
    row("codec.nul.missing.variable-name-write", &[VAR_13],
        "names before a value are written without a NUL",
        CodecFault::Bytes(|stream, mut bytes| {
            let nul = bytes.iter().position(|byte| *byte == 0);
            if let Some(nul) = nul.filter(|_| stream == "variable-name-write") {
                bytes.remove(nul);
            }
            bytes
        })),
    row("codec.nul.double.variable-name-write", &[VAR_13],
        "two NULs are written after a name before a value",
        CodecFault::Bytes(|stream, mut bytes| {
            let nul = bytes.iter().position(|byte| *byte == 0);
            if let Some(nul) = nul.filter(|_| stream == "variable-name-write") {
                bytes.insert(nul, 0);
            }
            bytes
        })),
    row("codec.nul.field.variable-name-write", &[VAR_13],
        "a value is written after a name field of 256 bytes",
        CodecFault::Bytes(|stream, mut bytes| {
            let nul = bytes.iter().position(|byte| *byte == 0);
            if let Some(nul) = nul.filter(|_| stream == "variable-name-write") {
                let padding = 255_usize.saturating_sub(nul);
                bytes.splice(nul..nul, vec![0; padding]);
            }
            bytes
        })),
    row("codec.descriptor.blanks", &[COM_2], "texts of descriptors are padded with blanks",
        CodecFault::Bytes(|stream, mut bytes| {
            if stream.starts_with("object-descriptor") {
                for record in bytes.chunks_exact_mut(84) {
                    let texts = record.iter_mut().skip(20).filter(|byte| **byte == 0);
                    texts.for_each(|byte| *byte = b' ');
                }
            }
            bytes
        })),
    row("codec.descriptor.access-inverted", &[COM_2], "write access of a descriptor is inverted",
        CodecFault::Value(|_, value| {
            if let Some(access) = value.get_mut("write_access") {
                numbers(access, &["UNS16"], |number| i128::from(number == 0));
            }
        })),
];
