//! Valid variants of behaviour that the manuals do not specify.

use ads_cnc::ads::{AdsError, FrameRef};
use ads_cnc::operation::{AdsService, Call, Function};

use super::row::{sent, unprinted, with_names};
use crate::faults::cnc::{
    CncDefect, CncFault, LOGICAL, NAMED, ReplyData, Upstream, after_nul, descriptions, each, fault,
    function, group, is, measured, name_in, offset, on, row, set_u32, text, u32_at,
};

const STREAM: &[Function] = &[Function::WriteProgramStream];

/// If the CNC does not find the name in the request, replaces it by the listed name that differs
/// only in case.
fn any_case(cnc: &Upstream<'_>, call: &Call<'_>) -> ReplyData {
    let answer = cnc.answer(call);
    if !is(call, NAMED) || answer != Err(AdsError::SYMBOL_NOT_FOUND) {
        return answer;
    }
    let asked = text(call.data);
    let (base, rest) =
        asked.split_at(asked.iter().rposition(|&byte| byte == b'[').unwrap_or(asked.len()));
    let mut listed = [&b"V.E"[..], b"V.G", b"V.A"]
        .into_iter()
        .flat_map(|kind| descriptions(cnc, group(call), kind));
    match listed.find(|found| name_in(found).eq_ignore_ascii_case(base)) {
        Some(found) => {
            let tail = call.data.get(asked.len()..).unwrap_or_default();
            cnc.with(call, &[name_in(&found), rest, tail].concat())
        }
        None => answer,
    }
}

/// The size in bytes of the STRING that a call writes by name; `None` for other calls, and for the
/// variables of the Service Interface.
fn writes_text(cnc: &Upstream<'_>, call: &Call<'_>) -> Option<usize> {
    if !is(call, &[Function::WriteByName]) || call.data.starts_with(b"V.G.SERVICE.") {
        return None;
    }
    let name = [text(call.data), &[0]].concat();
    let bare = match name.iter().rposition(|&byte| byte == b'[') {
        Some(at) if name.ends_with(b"]\0") => [name.get(..at).unwrap_or_default(), &[0]].concat(),
        _ => name.clone(),
    };
    let described = cnc.ask(group(call), 0x4C, &bare).ok()?;
    let size = cnc.ask(group(call), 0x48, &name).ok()?.len();
    (u32_at(&described, 4) == Some(9)).then_some(size)
}

/// The reply with a REAL64 changed by a little more at each read, like the position of a moving
/// axis.
fn moved(cnc: &Upstream<'_>, answer: ReplyData) -> ReplyData {
    answer.map(|bytes| match bytes.first_chunk::<8>() {
        Some(value) if bytes.len() == 8 => {
            let mut memory = cnc.memory();
            memory.count = memory.count.wrapping_add(1);
            let now = f64::from_le_bytes(*value) + f64::from(memory.count) / 8.0;
            now.to_le_bytes().to_vec()
        }
        _ => bytes,
    })
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("different.contents-just", &[],
        "the CNC rejects a read of an object whose read length is not the size of the object",
        &[Function::ReadObject], |cnc, call| cnc.answer(call).and_then(|bytes| {
            let len = u32::try_from(bytes.len()).unwrap_or_default();
            if len == call.read_length { Ok(bytes) } else { Err(AdsError::INVALID_SIZE) }
        })),
    row("different.parameters-any-kind", &[],
        "a parameter is found by its name at the offset of any kind: P, V.L, V.P or V.S",
        |cnc, call| match (is(call, &[Function::DynamicValueByName]), cnc.answer(call)) {
            (true, Err(AdsError::SYMBOL_NOT_FOUND)) => {
                let found = [0x1C, 0x1F, 0x22, 0x25].map(|at| cnc.at(call, group(call), at));
                found.into_iter().find(Result::is_ok).unwrap_or(Err(AdsError::SYMBOL_NOT_FOUND))
            }
            (_, answer) => answer,
        }),
    row("different.names-any-case", &[],
        "the case of letters in names of variables does not matter",
        any_case),
    unprinted(row("different.ids-elsewhere", &[], "the IDs of objects are large and in no order",
        |cnc, call| each(cnc, call, |record| {
            let id = u32_at(record, 0).unwrap_or_default();
            set_u32(record, 0, id.wrapping_mul(0x9E37_79B1) | 0x8000_0000);
        }))),
    row("different.stream-read-empty", &[],
        "a read of the stream object returns zeros up to the read length, at most 4094 bytes",
        |cnc, call| {
            let stream = group(call) & 0xEF_FF00 == 0x02_0100 && offset(call) == 0x90;
            match (stream && call.service == AdsService::Read, cnc.answer(call)) {
                (true, Err(_)) => {
                    let len = call.read_length.min(4094);
                    Ok(vec![0; usize::try_from(len).unwrap_or_default()])
                }
                (_, answer) => answer,
            }
        }),
    row("different.stream-busy", &[],
        "the CNC temporarily rejects every third stream write, even if it would fit",
        |cnc, call| if is(call, STREAM) && (1..=992).contains(&call.data.len()) {
            let mut memory = cnc.memory();
            memory.count = memory.count.wrapping_add(1);
            if memory.count % 3 == 0 {
                return Err(AdsError::INVALID_DATA);
            }
            drop(memory);
            cnc.answer(call)
        } else {
            cnc.answer(call)
        }),
    sent("different.errors-with-zeros",
        "the reply to a rejected Read or ReadWrite has zeros up to the read length, at most 64",
        |_, request: &FrameRef<'_>, mut bytes| {
            let asked = u32_at(request.data(), 8).unwrap_or_default().min(64);
            let rejected = matches!(u32_at(&bytes, 38), Some(1..));
            if rejected && bytes.len() == 46 && matches!(request.header().command.0, 2 | 9) {
                set_u32(&mut bytes, 42, asked);
                bytes.resize(usize::try_from(asked).unwrap_or_default().saturating_add(46), 0);
            }
            measured(bytes)
        }),
    row("different.descriptors-by-index", &[],
        "descriptors that are read in addressing by index state groups in addressing by index",
        |cnc, call| if group(call) & LOGICAL == 0 {
            each(cnc, call, |record| {
                let all = u32_at(record, 12).unwrap_or_default();
                let own = all & 0x0F_FF00;
                // Descriptors of the platform (instance 0) keep their group.
                if all & 0xFF != 0 && own == group(call) & 0x0E_FF00 {
                    set_u32(record, 12, own | group(call) & 0xFF);
                }
            })
        } else {
            cnc.answer(call)
        }),
    row("different.platform-elsewhere", &[],
        "descriptors of platform objects have the other group, 0x120100 or 0x120101",
        |cnc, call| each(cnc, call, |record| {
            let (at, offset) = (u32_at(record, 12), u32_at(record, 16));
            if matches!(offset, Some(0x251 | 0x252)) {
                set_u32(record, 12, at.unwrap_or_default() ^ 1);
            }
        })),
    unprinted(row("different.axes-move", &[],
        "the position of an axis changes between any two reads",
        |cnc, call| match (function(call), group(call) & 0xEF_FF00) {
            (Some(Function::ReadObject), 0x02_0200) if offset(call) & 0xFFFF == 1 => {
                moved(cnc, cnc.answer(call))
            }
            (Some(Function::ReadObject), 0x02_0100)
                if offset(call) >= 0x1_0000 && offset(call) & 0xFFFF == 1 =>
            {
                moved(cnc, cnc.answer(call))
            }
            (Some(Function::ReadElement), 0x02_0300) if offset(call) & 0xFFFF == 1 => {
                moved(cnc, cnc.answer(call))
            }
            (Some(Function::ReadByName | Function::AxisReadByName), _)
                if call.data.starts_with(b"V.A.ACT_POS") =>
            {
                moved(cnc, cnc.answer(call))
            }
            (Some(Function::ReadByHandle), _)
                if u32_at(call.data, 0).is_some_and(|one| one & 0xFF00_00FF == 0x0100_001A) =>
            {
                moved(cnc, cnc.answer(call))
            }
            _ => cnc.answer(call),
        })),
    row("different.texts-whole", &[],
        "the CNC rejects a write by name to a STRING with fewer bytes than its size",
        |cnc, call| match writes_text(cnc, call) {
            Some(size) if after_nul(call.data).len() < size => Err(AdsError::INVALID_SIZE),
            _ => cnc.answer(call),
        }),
    row("different.texts-ended", &[], "the CNC rejects a write by name to a STRING without a NUL",
        |cnc, call| match writes_text(cnc, call) {
            Some(_) if !after_nul(call.data).contains(&0) => Err(AdsError::INVALID_SIZE),
            _ => cnc.answer(call),
        }),
    unprinted(fault("different.model-numbers", &[],
        "the CNC has channels 1, 9 and 255, axes with large numbers, and five read-only spindles",
        CncFault::Model(NUMBERS))),
];

/// A CNC with the channel number 255 and an object at the offset 0xFFFF, with axis numbers up to
/// 65535, and with extreme values.
const NUMBERS: &str = with_names!(
    r#"
cnc-version = "V3.1.3100.0"
edition = "de-1.051"
spindles = 5

[[axis]]
name = "X1"
number = 65535
[[axis]]
name = "SCHLITTEN"
number = 40000
[[axis]]
name = "C"
number = 3

[platform]
objects = [{ name = "platform_dint_w", type = "DINT", offset = 0xFFFF, writable = true, value = -7 }]
[platform-axis]
objects = [{ name = "position_r", type = "REAL", offset = 0x77, values = [1.5, 2.5, 3.5] }]
[channel-axis]
objects = [
  { name = "position_r", type = "LREAL", offset = 0x33, values = [1.5, 2.5, 3.5] },
  { name = "number_r", type = "DWORD", offset = 0x34, is = "axis-number" },
]
variables = [{ name = "V.A.OFFSETS", type = "REAL64", dimensions = [2], writable = true }]

[[channel]]
number = 1
places = [3, 0, 65535]
objects = [
  { name = "sint_w", type = "SINT", offset = 0xFFFE, writable = true, value = -1 },
  { name = "mc_program_stream_w", type = "STRING", offset = 0x90, size = 4094, writable = true },
]
variables = [
  { name = "V.E.deep.er[7].and[1].deeper", type = "UNS32", dimensions = [1], writable = true },
  { name = "V.G.one", type = "STRING", size = 1, writable = true },
]
parameters = [{ name = "V.S.PI", value = 3.141592653589793 }, { name = "P4294967295", value = -0.0 }]

[[channel]]
number = 9
places = [40000]
parameters = [{ name = "V.P.alone", value = 1e300 }]

[[channel]]
number = 255
objects = [{ name = "lint_w", type = "LINT", offset = 0x1, writable = true, value = -1 }]
variables = [{ name = "V.E.b", type = "BOOLEAN", dimensions = [1, 1, 1], writable = true }]

[class.interpolator.channel]
name = "IPO {}"
[class.interpolator.axis]
name = "IPO axis {}"
elements = [{ name = "distance", type = "REAL64", unit = "mm" }]
[class.position-controller.axis]
name = "LR {}"
elements = [{ name = "number", type = "UNS16", unit = "-", is = "axis-number" }]
[class.spindle.each]
name = "S {}"
elements = [{ name = "speed", type = "REAL32", unit = "1/min", values = [1.0, 2.0, 3.0, 4.0, 5.0] }]
"#
);
