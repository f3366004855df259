//! Samples of ADS requests, replies and headers (see [`super::samples`]).

use super::Sample;
use super::samples::sample;

pub(super) const AMS_TCP_HEADER: &[Sample] = &[
    sample("ams-command", &[("reserved", b"\0\0"), ("length", b"\x2c\0\0\0")]),
    sample("port-open", &[("reserved", b"\0\x10"), ("length", b"\x02\0\0\0")]),
];

pub(super) const AMS_HEADER: &[Sample] = &[
    sample(
        "read",
        &[
            ("target_net_id", b"\x7f\0\0\x01\x01\x01"),
            ("target_port", b"\x29\x02"),
            ("source_net_id", b"\xc0\0\x02\x07\x01\x01"),
            ("source_port", b"\x01\x80"),
            ("command", b"\x02\0"),
            ("state_flags", b"\x04\0"),
            ("data_length", b"\x0c\0\0\0"),
            ("error", b"\0\0\0\0"),
            ("invoke_id", b"\x01\0\0\0"),
        ],
    ),
    // Arbitrary numbers, such as an undocumented command, which the codec keeps.
    sample(
        "unknown",
        &[
            ("target_net_id", b"\x01\x02\x03\x04\x05\x06"),
            ("target_port", b"\x07\x08"),
            ("source_net_id", b"\x09\x0a\x0b\x0c\x0d\x0e"),
            ("source_port", b"\x0f\x10"),
            ("command", b"\x11\x12"),
            ("state_flags", b"\x13\x14"),
            ("data_length", b"\x15\x16\x17\x18"),
            ("error", b"\x19\x1a\x1b\x1c"),
            ("invoke_id", b"\x1d\x1e\x1f\x20"),
        ],
    ),
];

pub(super) const READ_REQUEST: &[Sample] = &[sample(
    "descriptor-printed",
    &[
        ("index_group", b"\x01\x01\x13\0"),
        ("index_offset", b"\x10\0\0\0"),
        ("length", b"\x54\0\0\0"),
    ],
)];

pub(super) const READ_REPLY: &[Sample] = &[
    sample("count", &[("result", b"\0\0\0\0"), ("length", b"\x04\0\0\0"), ("data", b"\x10\0\0\0")]),
    sample("no-data", &[("result", b"\0\0\0\0"), ("length", b"\0\0\0\0")]),
    sample("error-alone", &[("result", b"\x02\x07\0\0")]),
    sample("error-no-data", &[("result", b"\x03\x07\0\0"), ("length", b"\0\0\0\0")]),
    sample(
        "error-with-data",
        &[("result", b"\x05\x07\0\0"), ("length", b"\x03\0\0\0"), ("data", b"\0\xaa\xff")],
    ),
];

pub(super) const WRITE_REQUEST: &[Sample] = &[
    sample(
        "single-block-printed",
        &[
            ("index_group", b"\x01\x01\x12\0"),
            ("index_offset", b"\x01\0\0\0"),
            ("length", b"\x01\0\0\0"),
            ("data", b"\x01"),
        ],
    ),
    sample(
        "no-data",
        &[
            ("index_group", b"\xff\xff\xff\xff"),
            ("index_offset", b"\0\0\0\x80"),
            ("length", b"\0\0\0\0"),
        ],
    ),
];

pub(super) const WRITE_REPLY: &[Sample] = &[
    sample("success", &[("result", b"\0\0\0\0")]),
    sample("rejected", &[("result", b"\x04\x07\0\0")]),
];

pub(super) const READ_WRITE_REQUEST: &[Sample] = &[
    sample(
        "count-printed",
        &[
            ("index_group", b"\x01\x23\x12\0"),
            ("index_offset", b"\x44\0\0\0"),
            ("read_length", b"\x04\0\0\0"),
            ("write_length", b"\x04\0\0\0"),
            ("data", b"V.E\0"),
        ],
    ),
    sample(
        "no-data",
        &[
            ("index_group", b"\0\x39\x12\0"),
            ("index_offset", b"\0\0\0\0"),
            ("read_length", b"\xff\xff\xff\xff"),
            ("write_length", b"\0\0\0\0"),
        ],
    ),
];

pub(super) const READ_WRITE_REPLY: &[Sample] = &[
    sample(
        "handle-printed",
        &[("result", b"\0\0\0\0"), ("length", b"\x04\0\0\0"), ("data", b"\x04\0\0\x02")],
    ),
    sample("no-data", &[("result", b"\0\0\0\0"), ("length", b"\0\0\0\0")]),
    sample("error-alone", &[("result", b"\x10\x07\0\0")]),
    sample(
        "error-with-data",
        &[("result", b"\x06\x07\0\0"), ("length", b"\x01\0\0\0"), ("data", b"\0")],
    ),
];

pub(super) const DEVICE_INFO_REPLY: &[Sample] = &[
    sample(
        "named",
        &[
            ("result", b"\0\0\0\0"),
            ("major", b"\x03"),
            ("minor", b"\x01"),
            ("build", b"\x39\x0c"),
            ("name", b"CNC\0\0\0\0\0\0\0\0\0\0\0\0\0"),
        ],
    ),
    // The name fills its field. The result is an error, but all fields are present.
    sample(
        "error-with-all",
        &[
            ("result", b"\x05\x07\0\0"),
            ("major", b"\xff"),
            ("minor", b"\0"),
            ("build", b"\0\x80"),
            ("name", b"0123456789abcdef"),
        ],
    ),
];

pub(super) const DEVICE_STATE_REPLY: &[Sample] = &[
    sample("run", &[("result", b"\0\0\0\0"), ("ads_state", b"\x05\0"), ("device_state", b"\0\0")]),
    sample(
        "unknown",
        &[("result", b"\x01\x07\0\0"), ("ads_state", b"\xfe\xff"), ("device_state", b"\x01\x80")],
    ),
];
