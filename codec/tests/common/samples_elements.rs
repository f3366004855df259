//! Samples of content, of the addresses of instances, of the attributes of elements, of dynamic
//! parameters, of descriptions by name and of NC text.

use super::samples::{Sample, padded, sample};

pub(super) const CONTENT: &[Sample] = &[
    sample("printed", &[("content", b"\x01")]),
    sample("text", &[("content", b"path_1\0\0behind")]),
    sample("nothing", &[]),
];

pub(super) const OBJECT_ADDRESS_QUERY: &[Sample] = &[
    sample("printed-channel-2", &[("channel", b"\x02\0\0\0"), ("axis", b"\0\0\0\0")]),
    sample("printed-platform-axis", &[("channel", b"\0\0\0\0"), ("axis", b"\x01\0\0\0")]),
    sample("more-than-8-bits", &[("channel", b"\0\x01\0\0"), ("axis", b"\xff\xff\xff\xff")]),
];

pub(super) const OBJECT_ADDRESS: &[Sample] = &[
    sample(
        "printed-platform-axis",
        &[("index_group", b"\0\x33\x12\0"), ("index_offset", b"\0\x10\0\0")],
    ),
    sample("none", &[("index_group", b"\0\0\0\0"), ("index_offset", b"\0\0\0\0")]),
];

pub(super) const ELEMENT_TEXT: &[Sample] = &[
    sample("printed-name", &[("text", b"feedhold.enable\0")]),
    sample("printed-unit-open", &[("text", b"-")]),
    sample("empty", &[]),
    sample("bytes-behind-the-nul", &[("text", b"\xb5m\0/s\0")]),
    sample("padded-to-the-limit", &[("text", &padded::<256>(b"BOOLEAN"))]),
];

pub(super) const ELEMENT_LENGTH: &[Sample] = &[
    sample("four-bytes", &[("length", b"\x01\0\0\0")]),
    sample("two-bytes", &[("length", b"\x08\x01")]),
    sample("one-byte", &[("length", b"\xff")]),
];

pub(super) const ELEMENT_WRITE_FLAG: &[Sample] =
    &[sample("printed", &[("flag", b"\0")]), sample("true-kept", &[("flag", b"\x80")])];

pub(super) const DYNAMIC_NAME: &[Sample] = &[
    sample("printed", &[("name", b"P1\0")]),
    sample("open", &[("name", b"V.L.L\xe4nge")]),
    sample("lone-nul", &[("name", b"\0")]),
    sample("bytes-behind-the-nul", &[("name", b"V.S.a\0b\0")]),
    sample("padded-to-the-limit", &[("name", &padded::<96>(b"V.P.name"))]),
];

pub(super) const DYNAMIC_NAME_REQUEST: &[Sample] = &[
    sample("printed", &[("name", b"P1\0")]),
    sample("open", &[("name", b"V.L.name")]),
    sample("padded", &[("name", b"V.S.a\0\0\0")]),
    sample("padded-to-the-limit", &[("name", &padded::<96>(b"V.P.name"))]),
];

pub(super) const DYNAMIC_VALUE: &[Sample] = &[
    sample("printed", &[("value", b"\0\0\0\0\0\x67\xb2\x40")]),
    sample("not-a-number", &[("value", b"\x01\0\0\0\0\0\xf4\xff")]),
];

pub(super) const VARIABLE_DESCRIPTION_BY_NAME: &[Sample] = &[
    sample(
        "printed-without-its-name",
        &[
            ("handle", b"\x02\0\0\x02"),
            ("type", b"\x01\0\0\0"),
            ("access", b"\x01\0\0\0"),
            ("size", b"\x02\0\0\0"),
            ("dimension_count", b"\x01\0\0\0"),
            ("dimensions", b"\x02\0\0\0"),
        ],
    ),
    sample(
        "elementary",
        &[
            ("handle", b"\x1b\0\x02\x01"),
            ("type", b"\x08\0\0\0"),
            ("access", b"\x02\0\0\0"),
            ("size", b"\x08\0\0\0"),
            ("dimension_count", b"\0\0\0\0"),
        ],
    ),
    sample(
        "matrix",
        &[
            ("handle", b"\xff\xff\xff\xff"),
            ("type", b"\x4d\0\0\0"),
            ("access", b"\0\0\0\x80"),
            ("size", b"\x18\0\0\0"),
            ("dimension_count", b"\x02\0\0\0"),
            ("dimensions", b"\x02\0\0\0"),
            ("dimensions", b"\x03\0\0\0"),
        ],
    ),
];

pub(super) const PROGRAM_STREAM: &[Sample] = &[
    sample("two-lines", &[("data", b"N10 G01 X200 F1000\r\nN20 M30\r\n")]),
    // The stream is valid; the CNC reports the missing line end when it reads the line (STM-5).
    sample("no-line-end", &[("data", b"N10 G01 X200")]),
];
