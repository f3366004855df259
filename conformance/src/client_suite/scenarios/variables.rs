//! Scenarios with variables and dynamic parameters.

use ads_cnc_vectors::ids::*;
use serde_json::{Value, json};

use crate::client_suite::Scenario;
use crate::client_suite::scenario::{ExpectedRequest, both, read, write};

/// Index group of the decoder of channel 1, which serves the variables.
const GROUP: u32 = 0x12_2301;

fn named(offset: u32, name: &[u8], least: u32) -> ExpectedRequest {
    let ask = both(GROUP, offset, &[name, b"\0"].concat(), least).of(VAR_14, VAR_9);
    // A client may pad a name with NULs to 256 bytes.
    let mut padded = name.to_vec();
    padded.resize(256, 0);
    ask.also(&padded)
}

/// A scenario that reads the value of a variable by its name.
fn value(id: &str, title: &str, name: &str, ty: &str, size: u32) -> Scenario {
    // The characters of these names have the same codes in CP1252 as in Latin-1, whose codes are
    // those of Unicode.
    let latin1 = name.chars().map(|one| u8::try_from(one).expect("a name in Latin-1"));
    let name_bytes: Vec<u8> = latin1.collect();
    Scenario::new(format!("client-read-{id}"), title, format!("read-by-name 1 {name} {ty}"))
        .asks(named(0x48, &name_bytes, size))
}

fn written(id: &str, title: &str, action: &str, name: &[u8], bytes: &[u8]) -> Scenario {
    let data = [name, b"\0", bytes].concat();
    Scenario::new(format!("client-write-{id}"), title, action)
        .asks(write(552, GROUP, 0x4A, &data).of(VAR_13, VAR_13))
}

pub(super) fn scenarios() -> Vec<Scenario> {
    let mut all = kinds();
    all.extend(by_name());
    all.extend(by_handle());
    all.extend(of_axes());
    all.extend(dynamic());
    all
}

fn kinds() -> Vec<Scenario> {
    let count = |group, kind: &[u8]| both(group, 0x44, kind, 4).of(VAR_2, VAR_1);
    let indexed =
        |offset, data: &[u8], least, place| both(GROUP, offset, data, least).of(place, VAR_3);
    vec![
        Scenario::new(
            "client-count-variables",
            "The client reads the number of V.E variables",
            "count-variables 1 V.E",
        )
        .asks(count(GROUP, b"V.E\0"))
        .gives(123),
        Scenario::new(
            "client-count-all",
            "The client reads the number of variables of all kinds",
            "count-variables 1 all",
        )
        .asks(count(GROUP, b"\0").tolerating(b""))
        .expect(crate::client_suite::scenario::ExpectedAnswer::Done),
        Scenario::new(
            "client-count-variables-6",
            "The client reads the number of V.E variables of channel 6",
            "count-variables 6 V.E",
        )
        .asks(count(0x12_2306, b"V.E\0"))
        .gives(2),
        Scenario::new("client-describe", "The client reads a description", "describe 1 2 V.E")
            .asks(indexed(0x45, b"\x02\0\0\0V.E\0", 39, VAR_4))
            .gives(json!({"name": "V.E.Variable_3", "handle": 0x200_0002, "type": 1,
                "access": 1, "size": 2, "dimensions": [2]})),
        Scenario::new(
            "client-describe-elementary",
            "The client reads a description without dimensions",
            "describe 1 4 V.E",
        )
        .asks(indexed(0x45, b"\x04\0\0\0V.E\0", 32, VAR_4))
        .gives(json!({"name": "V.E.vartest", "handle": 0x200_0004, "type": 5, "access": 2,
            "size": 2, "dimensions": []})),
        Scenario::new(
            "client-describe-extended",
            "The client reads an extended description",
            "describe-extended 1 3 V.E",
        )
        .asks(indexed(0x4B, b"\x03\0\0\0V.E\0", 8, VAR_15))
        .gives(json!({"synchronisation": 2, "validity": 2})),
        Scenario::new(
            "client-describe-extended-none",
            "The client accepts that V.G has no extended description",
            "describe-extended 1 0 V.G",
        )
        .asks(indexed(0x4B, b"\0\0\0\0V.G\0", 0, VAR_16))
        .by(VAR_16)
        .gives(Value::Null),
    ]
}

fn by_name() -> Vec<Scenario> {
    let long = format!("V.E.name_of_255_characters_{}", "x".repeat(228));
    vec![
        value("array", "The client reads an array", "V.E.Testvar", "SGN32[5]", 20)
            .gives(json!([123, 234, 345, 456, 567])),
        value("element", "The client reads an element of an array", "V.E.Testvar[3]", "SGN32", 4)
            .gives(456),
        value("signed", "The client reads a negative number", "V.E.matrix[1][2]", "SGN16", 2)
            .gives(23),
        value(
            "negative",
            "The client reads an array of negative numbers",
            "V.E.array_sgn32",
            "SGN32[5]",
            20,
        )
        .gives(json!([-1, 0, 1, i32::MIN, i32::MAX])),
        value(
            "unsigned",
            "The client reads an array of unsigned numbers",
            "V.E.struct.array_uns32",
            "UNS32[3]",
            12,
        )
        .gives(json!([0, 1, u32::MAX])),
        value("real", "The client reads a REAL64", "V.E.trajectory.vector.y", "REAL64", 8)
            .by(GEN_1)
            .gives(-2.25),
        value("tiny", "The client reads a REAL64 near 0", "V.E.trajectory.vector.z", "REAL64", 8)
            .by(GEN_1)
            .gives(1e-300),
        value("boolean", "The client reads a BOOLEAN", "V.E.boolean", "BOOLEAN", 1).gives(true),
        value("cp1252", "The client sends a name as CP1252", "V.E.Länge", "REAL64", 8)
            .by(GEN_3)
            .gives(1234.5),
        value("long-name", "The client sends a name of 255 characters", &long, "UNS08", 1)
            .by(VAR_9)
            .gives(255),
        value("text", "The client reads a text up to its NUL", "V.E.text", "STRING", 21)
            .by(crate::judge::assumed(VAR_22))
            .gives("Länge 5€"),
        value("matrix", "The client reads a matrix row by row", "V.E.matrix", "SGN16[2,3]", 12)
            .by(crate::judge::assumed(VAR_21))
            .gives(json!([[11, 12, 13], [21, 22, 23]])),
        value(
            "structure",
            "The client reads an element of an array in a structure",
            "V.G.NP[0].V[1]",
            "REAL64",
            8,
        )
        .gives(2.0),
        value("cycle", "The client reads a V.CYC variable by its name", "V.CYC.count", "UNS32", 4)
            .gives(42),
        written(
            "element",
            "The client writes an element of an array",
            "write-by-name 1 V.E.test[4] SGN32 123",
            b"V.E.test[4]",
            &[123, 0, 0, 0],
        ),
        written(
            "array",
            "The client writes an array",
            "write-by-name 1 V.E.test SGN32[5] 1,-1,2,-2,3",
            b"V.E.test",
            b"\x01\0\0\0\xFF\xFF\xFF\xFF\x02\0\0\0\xFE\xFF\xFF\xFF\x03\0\0\0",
        ),
        written(
            "real",
            "The client writes a REAL64 to a variable with a CP1252 name",
            "write-by-name 1 V.E.Länge REAL64 -0.5",
            b"V.E.L\xE4nge",
            b"\0\0\0\0\0\0\xE0\xBF",
        ),
        written(
            "boolean",
            "The client writes FALSE as 0",
            "write-by-name 1 V.E.boolean BOOLEAN FALSE",
            b"V.E.boolean",
            &[0],
        ),
        text("V.E.text", "Grün", b"Gr\xFCn"),
    ]
}

/// A scenario that writes a text. The client may write the text with a NUL, padded with NULs, or
/// without a NUL, because the manuals do not specify the end of the text.
fn text(name: &str, text: &str, bytes: &[u8]) -> Scenario {
    let front = [name.as_bytes(), b"\0", bytes].concat();
    let with = |zeros: usize| {
        let mut data = front.clone();
        data.resize(front.len() + zeros, 0);
        data
    };
    let ask = write(552, GROUP, 0x4A, &with(1)).of(VAR_13, VAR_13).also(&with(0));
    let filled = with(21_usize.saturating_sub(bytes.len()));
    let action = format!("write-by-name 1 {name} STRING {text}");
    Scenario::new("client-write-text", "The client writes a text as CP1252", action)
        .asks(ask.also(&filled))
}

fn by_handle() -> Vec<Scenario> {
    let whole = b"\x34\x12\0\x02\0\0\0\0";
    let one = b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0";
    let read = |data: &[u8], least| both(GROUP, 0x47, data, least).of(VAR_14, VAR_11);
    let write = |data: &[u8]| write(552, GROUP, 0x49, data).of(VAR_12, VAR_12);
    vec![
        Scenario::new(
            "client-handle",
            "The client requests a handle by name",
            "handle 1 V.E.vartest",
        )
        .asks(named(0x46, b"V.E.vartest", 4).of(VAR_10, VAR_9))
        .gives(0x200_0004),
        Scenario::new(
            "client-handle-read",
            "The client reads an array by its handle",
            "read-by-handle 1 33559092 - SGN32[5]",
        )
        .asks(read(whole, 20))
        .gives(json!([123, 234, 345, 456, 567])),
        Scenario::new(
            "client-handle-read-element",
            "The client reads an element of an array by its handle",
            "read-by-handle 1 33559092 4 SGN32",
        )
        .asks(read(one, 4))
        .gives(567),
        Scenario::new(
            "client-handle-write",
            "The client writes an array by its handle",
            "write-by-handle 1 33559092 - SGN32[5] 5,4,3,2,1",
        )
        .asks(write(&[whole, &b"\x05\0\0\0\x04\0\0\0\x03\0\0\0\x02\0\0\0\x01\0\0\0"[..]].concat())),
        Scenario::new(
            "client-handle-write-element",
            "The client writes an element of an array by its handle",
            "write-by-handle 1 33559092 4 SGN32 123",
        )
        .asks(write(&[&one[..], &[123, 0, 0, 0]].concat())),
    ]
}

fn of_axes() -> Vec<Scenario> {
    let axis = |offset, least| named(offset, b"V.A.WCS", least).of(VAR_26, VAR_9);
    vec![
        Scenario::new(
            "client-axis-handle",
            "The client requests the handle of an axis variable",
            "axis-handle 1 2 V.A.WCS",
        )
        .asks(axis(0x2_0004, 4))
        .gives(0x0102_001B),
        Scenario::new(
            "client-axis-read",
            "The client reads an axis variable",
            "read-axis 1 2 V.A.WCS REAL64",
        )
        .asks(axis(0x2_0005, 8))
        .gives(1234.2),
        Scenario::new(
            "client-axis-read-3",
            "The client reads an axis variable of another axis",
            "read-axis 1 3 V.A.WCS REAL64",
        )
        .asks(axis(0x3_0005, 8))
        .gives(-3.5),
        Scenario::new(
            "client-axis-write",
            "The client writes an axis variable",
            "write-axis 1 2 V.A.WCS REAL64 -2.5",
        )
        .asks(write(552, GROUP, 0x2_0006, b"V.A.WCS\0\0\0\0\0\0\0\x04\xC0").of(VAR_26, VAR_13)),
    ]
}

fn dynamic() -> Vec<Scenario> {
    let mut all = Vec::new();
    // `count_at` is the index offset of the number of parameters, `names_at` that of their names.
    for (kind, id, count_at, names_at, count, name, place, parameter) in [
        ("P", "p", 2, 0x1B, 1, "P1", 1_u8, 4711.0),
        ("V.L", "vl", 3, 0x1E, 1, "V.L.depth", 1, 2.5),
        ("V.P", "vp", 4, 0x21, 2, "V.P.offset", 2, -0.125),
        ("V.S", "vs", 5, 0x24, 1, "V.S.radius", 1, 6.25),
    ] {
        let index = [place, 0, 0, 0];
        let zeroed = [name.as_bytes(), b"\0"].concat();
        let mut padded = zeroed.clone();
        padded.resize(96, 0);
        all.extend([
            Scenario::new(
                format!("client-count-parameters-{id}"),
                format!("The client reads the number of {kind} parameters"),
                format!("count-parameters 1 {kind}"),
            )
            .asks(read(552, GROUP, count_at, 4).of(DYN_1, DYN_1))
            .gives(count),
            Scenario::new(
                format!("client-parameter-name-{id}"),
                format!("The client requests the name of a {kind} parameter, counted from 1"),
                format!("parameter-name 1 {kind} {place}"),
            )
            .asks(both(GROUP, names_at, &index, 96).of(DYN_2, DYN_5))
            .gives(name),
            Scenario::new(
                format!("client-parameter-value-{id}"),
                format!("The client reads a {kind} parameter by its name"),
                format!("parameter-by-name 1 {kind} {name}"),
            )
            .asks(
                both(GROUP, names_at + 1, &zeroed, 8)
                    .of(DYN_3, DYN_6)
                    .also(&padded)
                    .tolerating(name.as_bytes()),
            )
            .gives(parameter),
            Scenario::new(
                format!("client-parameter-index-{id}"),
                format!("The client reads a {kind} parameter by its index"),
                format!("parameter-by-index 1 {kind} {place}"),
            )
            .asks(both(GROUP, names_at + 2, &index, 8).of(DYN_4, DYN_5))
            .gives(parameter),
        ]);
    }
    all
}
