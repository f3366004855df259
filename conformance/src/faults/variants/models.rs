//! Valid variants with other models: channels, axes, objects and variables.

use super::row::{unprinted, with_names};
use crate::faults::cnc::{CncDefect, CncFault, fault};

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    model("different.model",
        "the CNC has one channel and one axis, and other objects, variables and elements", MODEL),
    model("different.model-bare",
        "the CNC has one channel with one object and one variable, no axes and no streaming", BARE),
    model("different.model-channel-3", "the only channel has the number 3", THIRD),
    model("different.model-many",
        "the CNC has twelve channels, none with the number 4, and axes in another order", MANY),
];

/// A variant that uses another data model.
const fn model(id: &'static str, what: &'static str, model: &'static str) -> CncDefect {
    unprinted(fault(id, &[], what, CncFault::Model(model)))
}

/// A CNC of an old version with few features: no axis, no writable object, no streaming, no Service
/// Interface.
const BARE: &str = with_names!(
    r#"
cnc-version = "V2.11.2010.0"

[[channel]]
number = 1
objects = [{ name = "state", type = "LWORD", offset = 1, value = 5 }]
variables = [{ name = "V.E.only", type = "REAL64", value = 0.5 }]
[channel.streaming]
file = ""
[class.position-controller.axis]
name = "LR {}"
[class.interpolator.channel]
name = "IPO {}"
[class.interpolator.axis]
name = "IPO axis {}"
[class.spindle.each]
name = "S {}"
"#
);

/// A CNC whose first channel is not channel 1, which the manuals name for the objects of the
/// platform.
const THIRD: &str = with_names!(
    r#"
[platform]
objects = [{ name = "cycle", type = "DWORD", offset = 0x251, value = 1000 }]

[[axis]]
name = "X"

[[channel]]
number = 3
places = [1]
objects = [{ name = "state", type = "LWORD", offset = 1, writable = true, value = 5 }]
variables = [{ name = "V.E.only", type = "REAL64", writable = true, value = 0.5 }]
[class.position-controller.axis]
name = "LR {}"
[class.interpolator.channel]
name = "IPO {}"
[class.interpolator.axis]
name = "IPO axis {}"
"#
);

/// A CNC with twelve channels, none of which has the number 4, and with the axes in another order.
const MANY: &str = with_names!(
    r#"
spindles = 3

[[axis]]
name = "Z"
[[axis]]
name = "Y"
number = 7
[[axis]]
name = "X"
number = 12
[[axis]]
name = "W"

[channel-axis]
objects = [{ name = "position", type = "LREAL", offset = 4, values = [1.0, 2.0, 3.0, 4.0] }]
variables = [{ name = "V.A.POS", type = "REAL64", values = [1.5, 2.5, 3.5, 4.5] }]

[[channel]]
number = 1
places = [12, 0, 1]
objects = [
  { name = "mc_program_stream_w", type = "STRING", offset = 0x90, size = 4094, writable = true },
  { name = "word", type = "INT", offset = 0x12, writable = true, value = -3 },
  { name = "text", type = "STRING", offset = 0x13, size = 80, writable = true, value = "as it is" },
]
variables = [
  { name = "V.E.texts", type = "STRING", dimensions = [3], size = 16, writable = true },
  { name = "V.E.cube", type = "SGN16", dimensions = [2, 2, 2], writable = true },
  { name = "V.E.s[0].t", type = "BOOLEAN", writable = true },
  { name = "V.E.s[1].t", type = "BOOLEAN", writable = true },
  { name = "V.G.long", type = "REAL64", dimensions = [255], writable = true },
]
parameters = [{ name = "P99", value = 1.0 }, { name = "P100", value = 2.0 }, { name = "V.L.x", value = 0.0 }]
[channel.streaming]
start = "by-hand"

[[channel]]
number = 2
places = [7]
[[channel]]
number = 3
places = [4]
[[channel]]
number = 5
[[channel]]
number = 6
[[channel]]
number = 7
[[channel]]
number = 8
[[channel]]
number = 9
[[channel]]
number = 10
[[channel]]
number = 11
[[channel]]
number = 12
[[channel]]
number = 13

[class.interpolator.channel]
name = "ipo {}"
elements = [{ name = "override", type = "UNS16", unit = "%", writable = true, value = 100 }]
[class.interpolator.axis]
name = "ipo axis {}"
elements = [{ name = "target", type = "REAL64", unit = "mm", value = 1.25 }]
[class.spindle.each]
name = "spindle {}"
elements = [{ name = "speed", type = "REAL32", unit = "1/min" }]
[class.position-controller.axis]
name = "LR {}"
"#
);

/// A CNC with one channel and one axis, and with other objects, variables and elements.
const MODEL: &str = r#"
cnc-version = "V4.29.0"

[[axis]]
name = "A"

[[channel]]
number = 1
places = [1]
objects = [
  { name = "small_state_r", type = "DWORD", offset = 7, value = 5 },
  { name = "mc_program_stream_w", type = "STRING", offset = 0x90, size = 4094, writable = true },
]
variables = [
  { name = "V.E.small", type = "UNS16", writable = true, value = 3 },
  { name = "V.E.pair", type = "SGN32", dimensions = [2], writable = true, value = [1, -1] },
]
parameters = [{ name = "P10", value = 1.5 }]
[channel.streaming]
pace = "1000 lines/s"

[class.hld.channel]
name = "HLD {}"
elements = [{ name = "small", type = "UNS32", unit = "-", writable = true, value = 9 }]
[class.position-controller.axis]
name = "LR {}"
[class.interpolator.channel]
name = "IPO {}"
[class.interpolator.axis]
name = "IPO axis {}"
[class.decoder.channel]
name = "SDA {}"
[class.decoder.axis]
name = "SDA axis {}"
[class.hld.axis]
name = "HLD axis {}"
[class.path-preparation.channel]
name = "BV {}"
[class.path-preparation.axis]
name = "BV axis {}"
[class.spindle.each]
name = "S {}"
"#;
