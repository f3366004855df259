//! Valid variants of elements and dynamic parameters.

use ads_cnc::address::{Attribute, Class};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Call, Function};

use super::row::unprinted;
use crate::faults::cnc::{
    CncDefect, CncFault, ReplyData, Upstream, absent, class, empty_place, fault, function, group,
    is, number, offset, on, row, text, within_length,
};

const ATTRIBUTES: &[Function] = &[
    Function::ReadElementType,
    Function::ReadElementLength,
    Function::ReadElementUnit,
    Function::ReadElementWriteFlag,
];

/// Whether a call requests the number of elements: a Read in the group of contents at an offset
/// whose lowest 12 bits are 0. In the groups of attributes, such an offset has another meaning.
fn is_number(call: &Call<'_>) -> bool {
    let of_content = class(call).is_some_and(|at| at.attribute == Attribute::Content);
    of_content && call.service == AdsService::Read && offset(call) & 0xFFF == 0
}

/// Changes the stride of the axes from 0x10000 to 0x1000 in the classes for which the manuals do
/// not print a stride.
fn strided(cnc: &Upstream<'_>, call: &Call<'_>) -> ReplyData {
    let of = |at: Class| {
        matches!(at, Class::PositionController | Class::Interpolator | Class::PathPreparation)
    };
    let is_other = class(call).is_some_and(|at| of(at.class));
    match (is_other, function(call)) {
        (false, _) => cnc.answer(call),
        (true, Some(Function::FindInstance)) => number(cnc.answer(call), 4, |offset| offset >> 4),
        (true, _) => {
            let (axis, element) = (offset(call) >> 12, offset(call) & 0xFFF);
            cnc.at(call, group(call), axis << 16 | element)
        }
    }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    unprinted(row("different.number-counts-first", &[],
        "the number of elements counts element 0 too",
        |cnc, call| if is_number(call) {
            number(cnc.answer(call), 0, |count| count.wrapping_add(1))
        } else {
            cnc.answer(call)
        })),
    unprinted(row("different.number-2-bytes", &[], "the number of elements takes 2 bytes",
        |cnc, call| match (is_number(call), function(call), offset(call) & 0xFFF) {
            (true, ..) => within_length(
                call,
                cnc.whole(call).map(|mut bytes| {
                    bytes.truncate(2);
                    bytes
                }),
            ),
            (_, Some(Function::ReadElementLength), 0) => cnc.answer(call).map(|_| vec![2, 0, 0, 0]),
            _ => cnc.answer(call),
        })),
    row("different.first-without-attributes", &[],
        "element 0 has no type, length, unit and write flag",
        |cnc, call| if is(call, ATTRIBUTES) && offset(call) & 0xFFF == 0 {
            Err(AdsError::INVALID_OFFSET)
        } else {
            cnc.answer(call)
        }),
    on("different.first-writable", &[], "the write flag of element 0 is TRUE",
        &[Function::ReadElementWriteFlag], |cnc, call| match offset(call) & 0xFFF {
            0 => cnc.answer(call).map(|_| vec![1]),
            _ => cnc.answer(call),
        }),
    row("different.hld-axes-of-first", &[], "the HLD of other channels than the first has no axes",
        |cnc, call| absent(cnc, call, |class, channel, axis| class == 0x3000 && channel > 1 && axis > 0)),
    row("different.path-preparation-without-axes", &[], "path preparation has no axes",
        |cnc, call| absent(cnc, call, |class, _, axis| class == 0x4000 && axis > 0)),
    row("different.blank-number", &[],
        "the number of elements at an axis index without an axis is 0",
        |cnc, call| if is_number(call) && empty_place(call) {
            cnc.answer(call).map(|bytes| vec![0; bytes.len()])
        } else {
            cnc.answer(call)
        }),
    row("different.blank-real", &[],
        "a REAL64 at an axis index without an axis is not a number (NaN)",
        |cnc, call| if is(call, &[Function::ReadElement]) && empty_place(call) {
            cnc.answer(call).map(|bytes| match bytes.len() {
                8 => vec![0xFF; 8],
                _ => bytes,
            })
        } else {
            cnc.answer(call)
        }),
    row("different.axes-of-0x1000", &[],
        "axes in position controller, interpolator and path preparation have the stride 0x1000",
        strided),
    on("different.name-as-it-ends", &[],
        "the CNC rejects a parameter name with more bytes after its first NUL",
        &[Function::DynamicValueByName],
        |cnc, call| if call.data.len() > text(call.data).len() + 1 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    unprinted(fault("different.come-and-go", &[],
        "the CNC has channels 1 and 4, with parameters that are repeatedly created and deleted",
        CncFault::Model(MODEL))),
];

/// A CNC with the channels 1 and 4, and with some parameters that exist only for a part of each
/// period.
const MODEL: &str = r#"
cnc-version = "V4.29.0"
spindles = 1

[[axis]]
name = "X"
number = 7
[[axis]]
name = "C"
number = 3
[[axis]]
name = "A"
number = 12

[platform-axis]
objects = [{ name = "actual_r", type = "LREAL", offset = 5, values = [1.5, 2.5, 3.5] }]

[channel-axis]
variables = [{ name = "V.A.ACT_POS", type = "REAL64", values = [1.0, 2.0, 3.0] }]

[[channel]]
number = 1
places = [3, 0]
objects = [{ name = "override_w", type = "WORD", offset = 4, writable = true, value = 500 }]
variables = [{ name = "V.E.one", type = "REAL64", writable = true, value = 0.5 }]
parameters = [
  { name = "P5", value = 1.5, comes = "3ms", goes = "11ms", period = "19ms" },
  { name = "P6", value = 2.5 },
  { name = "V.L.x", value = 3.5, comes = "0ms", goes = "5ms", period = "7ms" },
  { name = "V.P.always", value = 4.5 },
  { name = "V.S.at_times", value = 5.5, comes = "10ms", goes = "20ms", period = "30ms" },
]

[[channel]]
number = 4
places = [7, 12]
objects = [{ name = "override_w", type = "WORD", offset = 4, writable = true, value = 500 }]
variables = [{ name = "V.E.one", type = "REAL64", writable = true, value = 1.5 }]

[class.position-controller.axis]
name = "LR {}"
elements = [{ name = "pos", type = "SGN32", unit = "0.1um", values = [1, 2, 3] }]

[class.decoder.channel]
name = "DEC {}"
elements = [{ name = "line", type = "UNS32", unit = "", value = 77 }]

[class.spindle.each]
name = "SPINDLE {}"
elements = [{ name = "speed", type = "REAL32", unit = "rpm", writable = true, value = 1.0 }]
"#;
