//! Defects of texts and descriptors (GEN, COM, DYN, SDA, SVC, VAR).

use ads_cnc::text::cp1252_to_char;
use ads_cnc_vectors::ids::*;

use super::json::{numbers, texts};
use super::row::{CodecDefect, CodecFault, row};

/// The bytes of a stream, without the final NUL if the stream is `of` and has more than one byte.
fn nul(stream: &str, of: &str, mut bytes: Vec<u8>) -> Vec<u8> {
    if stream == of && bytes.len() > 1 && bytes.last() == Some(&0) {
        bytes.pop();
    }
    bytes
}

#[rustfmt::skip]
pub(super) const ROWS: &[CodecDefect] = &[
    row("codec.text.question-marks", &[GEN_3],
        "the codec replaces characters beyond ASCII in texts by question marks",
        CodecFault::Value(|_, value| {
            texts(value, |bytes| {
                bytes.into_iter().map(|byte| if byte.is_ascii() { byte } else { b'?' }).collect()
            })
        })),
    row("codec.text.utf-8", &[GEN_3],
        "the codec uses UTF-8 instead of CP1252 for texts",
        CodecFault::Value(|_, value| {
            texts(value, |bytes| {
                let text: String = bytes.iter().map(|byte| cp1252_to_char(*byte)).collect();
                text.into_bytes()
            })
        })),
    row("codec.text.seven-bits", &[GEN_3],
        "the codec drops the highest bit of each character of a text",
        CodecFault::Value(|_, value| {
            texts(value, |bytes| bytes.into_iter().map(|byte| byte & 0x7F).collect())
        })),
    row("codec.text.upper-case", &[VAR_9, DYN_3, SDA_6, COM_2, SVC_9],
        "the codec converts texts to upper case",
        CodecFault::Value(|_, value| texts(value, |bytes| bytes.to_ascii_uppercase()))),
    row("codec.text.cut-20", &[SDA_6, VAR_4], "the codec cuts texts to 20 characters",
        CodecFault::Value(|_, value| {
            texts(value, |mut bytes| {
                bytes.truncate(20);
                bytes
            })
        })),
    row("codec.text.service-cut", &[SVC_1, VAR_13],
        "the codec cuts texts in values and in writes by name to 80 characters",
        CodecFault::Value(|stream, value| {
            if stream.starts_with("variable-value") || stream == "variable-name-write" {
                texts(value, |mut bytes| {
                    bytes.truncate(80);
                    bytes
                });
            }
        })),
    row("codec.text.service-uuid", &[SVC_9],
        "the codec converts texts of 36 characters, such as UUIDs, to upper case",
        CodecFault::Value(|_, value| {
            texts(value, |bytes| match bytes.len() {
                36 => bytes.to_ascii_uppercase(),
                _ => bytes,
            })
        })),
    row("codec.nul.missing.variable-kind", &[VAR_1],
        "the codec omits the NUL after the kind in a request for a number of variables",
        CodecFault::Bytes(|stream, bytes| nul(stream, "variable-kind", bytes))),
    row("codec.nul.missing.variable-index-kind", &[VAR_3],
        "the codec omits the NUL after the kind in a request by index",
        CodecFault::Bytes(|stream, bytes| nul(stream, "variable-index-kind", bytes))),
    row("codec.nul.missing.variable-name", &[VAR_9],
        "the codec omits the NUL after the name in a query by name",
        CodecFault::Bytes(|stream, bytes| nul(stream, "variable-name", bytes))),
    row("codec.nul.missing.variable-name-write", &[VAR_13],
        "the codec omits the NUL between the name and the value in a write by name",
        CodecFault::Bytes(|stream, mut bytes| {
            let nul = bytes.iter().position(|byte| *byte == 0);
            if let Some(nul) = nul.filter(|_| stream == "variable-name-write") {
                bytes.remove(nul);
            }
            bytes
        })),
    row("codec.nul.double.variable-name-write", &[VAR_13],
        "the codec writes two NULs between the name and the value in a write by name",
        CodecFault::Bytes(|stream, mut bytes| {
            let nul = bytes.iter().position(|byte| *byte == 0);
            if let Some(nul) = nul.filter(|_| stream == "variable-name-write") {
                bytes.insert(nul, 0);
            }
            bytes
        })),
    row("codec.nul.field.variable-name-write", &[VAR_13],
        "the codec pads the name in a write by name to 256 bytes",
        CodecFault::Bytes(|stream, mut bytes| {
            let nul = bytes.iter().position(|byte| *byte == 0);
            if let Some(nul) = nul.filter(|_| stream == "variable-name-write") {
                let padding = 255_usize.saturating_sub(nul);
                bytes.splice(nul..nul, vec![0; padding]);
            }
            bytes
        })),
    row("codec.descriptor.blanks", &[COM_2],
        "the codec pads the texts of a descriptor with blanks instead of NULs",
        CodecFault::Bytes(|stream, mut bytes| {
            if stream.starts_with("object-descriptor") {
                for record in bytes.chunks_exact_mut(84) {
                    let texts = record.iter_mut().skip(20).filter(|byte| **byte == 0);
                    texts.for_each(|byte| *byte = b' ');
                }
            }
            bytes
        })),
    row("codec.descriptor.access-inverted", &[COM_2],
        "the codec inverts the write access in a descriptor",
        CodecFault::Value(|_, value| {
            if let Some(access) = value.get_mut("write_access") {
                numbers(access, &["UNS16"], |number| i128::from(number == 0));
            }
        })),
];
