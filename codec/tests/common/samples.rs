//! Samples: valid bytes of every stream except `NoData`, written by hand field by field, not by an
//! encoder.

use ads_cnc::layout::Stream;

use super::samples_ads::*;
use super::samples_elements::*;

/// A valid stream, split by hand into its fields. A list of numbers occurs once for each number; a
/// field without bytes may be left out.
pub(crate) struct Sample {
    pub(crate) slug: &'static str,
    pub(crate) fields: &'static [(&'static str, &'static [u8])],
}

impl Sample {
    pub(crate) fn bytes(&self) -> Vec<u8> {
        self.fields.iter().flat_map(|(_, bytes)| bytes.iter().copied()).collect()
    }

    /// The name, the offset and the bytes of each field that is not empty.
    pub(crate) fn places(&self) -> impl Iterator<Item = (&'static str, usize, &'static [u8])> {
        let mut at = 0;
        self.fields.iter().filter(|(_, bytes)| !bytes.is_empty()).map(move |&(name, bytes)| {
            at += bytes.len();
            (name, at - bytes.len(), bytes)
        })
    }
}

pub(crate) fn each_sample() -> impl Iterator<Item = (Stream, &'static Sample)> {
    let of = |&(stream, samples): &(Stream, &'static [Sample])| {
        samples.iter().map(move |sample| (stream, sample))
    };
    SAMPLES.iter().flat_map(of)
}

pub(super) const fn sample(
    slug: &'static str,
    fields: &'static [(&'static str, &'static [u8])],
) -> Sample {
    Sample { slug, fields }
}

/// `text` in `N` bytes, padded with NULs.
pub(super) const fn padded<const N: usize>(text: &[u8]) -> [u8; N] {
    let mut bytes = [0; N];
    let mut at = 0;
    while at < text.len() {
        bytes[at] = text[at];
        at += 1;
    }
    bytes
}

/// The samples of every stream except `NoData`.
pub(crate) const SAMPLES: &[(Stream, &[Sample])] = &[
    (Stream::AmsTcpHeader, AMS_TCP_HEADER),
    (Stream::AmsHeader, AMS_HEADER),
    (Stream::ReadRequest, READ_REQUEST),
    (Stream::ReadReply, READ_REPLY),
    (Stream::WriteRequest, WRITE_REQUEST),
    (Stream::WriteReply, WRITE_REPLY),
    (Stream::ReadWriteRequest, READ_WRITE_REQUEST),
    (Stream::ReadWriteReply, READ_WRITE_REPLY),
    (Stream::ObjectCount, &[sample("sixteen", &[("count", b"\x10\0\0\0")])]),
    (Stream::ObjectDescriptor, OBJECT_DESCRIPTOR),
    (Stream::ObjectDescriptors, OBJECT_DESCRIPTORS),
    (Stream::VariableKind, VARIABLE_KIND),
    (Stream::VariableCount, &[sample("printed", &[("count", b"\x7b\0\0\0")])]),
    (Stream::VariableIndexKind, VARIABLE_INDEX_KIND),
    (Stream::VariableDescription, VARIABLE_DESCRIPTION),
    (Stream::VariableName, VARIABLE_NAME),
    (Stream::VariableHandle, &[sample("printed", &[("handle", b"\x04\0\0\x02")])]),
    (Stream::VariableHandleWrite, VARIABLE_HANDLE_WRITE),
    (Stream::VariableNameWrite, VARIABLE_NAME_WRITE),
    (Stream::VariableExtendedDescription, VARIABLE_EXTENDED_DESCRIPTION),
    (Stream::Content, CONTENT),
    (Stream::ObjectAddressQuery, OBJECT_ADDRESS_QUERY),
    (Stream::ObjectAddress, OBJECT_ADDRESS),
    (Stream::ElementCount, &[sample("nine", &[("count", b"\x09\0\0\0")])]),
    (Stream::ElementText, ELEMENT_TEXT),
    (Stream::ElementLength, ELEMENT_LENGTH),
    (Stream::ElementWriteFlag, ELEMENT_WRITE_FLAG),
    (Stream::DynamicCount, &[sample("printed", &[("count", b"\x01\0\0\0")])]),
    (Stream::DynamicIndex, &[sample("printed", &[("index", b"\x01\0\0\0")])]),
    (Stream::DynamicName, DYNAMIC_NAME),
    (Stream::DynamicNameRequest, DYNAMIC_NAME_REQUEST),
    (Stream::DynamicValue, DYNAMIC_VALUE),
    (Stream::VariableDescriptionByName, VARIABLE_DESCRIPTION_BY_NAME),
    (Stream::ProgramStream, PROGRAM_STREAM),
    (Stream::VariableHandleRead, VARIABLE_HANDLE_READ),
    (Stream::VariableValue, VARIABLE_VALUE),
    (Stream::DeviceInfoReply, DEVICE_INFO_REPLY),
    (Stream::DeviceStateReply, DEVICE_STATE_REPLY),
];

const OBJECT_DESCRIPTOR: &[Sample] = &[
    sample(
        "printed",
        &[
            ("id", b"\x52\0\0\0"),
            ("size", b"\x01\0\0\0"),
            ("write_access", b"\0\0"),
            ("not_assigned", b"\0\0"),
            ("index_group", b"\x01\x01\x12\0"),
            ("index_offset", b"\x03\0\0\0"),
            ("name", &padded::<32>(b"mc_active_single_block_r")),
            ("type", &padded::<32>(b"BOOL")),
        ],
    ),
    // Unusual values that a codec must keep, such as write access 0x0100, two unassigned bytes,
    // bytes after a NUL, and a name of 32 bytes without a NUL.
    sample(
        "kept",
        &[
            ("id", b"\xff\xff\xff\xff"),
            ("size", b"\x08\0\0\0"),
            ("write_access", b"\0\x01"),
            ("not_assigned", b"\xca\xfe"),
            ("index_group", b"\x02\x02\x12\0"),
            ("index_offset", b"\x01\0\x01\0"),
            ("name", b"a_name_of_thirty-two_characters."),
            ("type", b"LREAL\0\x81\x8d\x8f\x90\x9d\xe4\xf6\xfc\xdf\x80 of another read"),
        ],
    ),
];

const OBJECT_DESCRIPTORS: &[Sample] = &[sample(
    "two",
    &[
        ("id", b"\x01\0\0\0"),
        ("size", b"\x04\0\0\0"),
        ("write_access", b"\x01\0"),
        ("not_assigned", b"\0\0"),
        ("index_group", b"\0\x01\x12\0"),
        ("index_offset", b"\x51\x02\0\0"),
        ("name", &padded::<32>(b"first_of_the_platform")),
        ("type", &padded::<32>(b"DINT")),
        ("id", b"\x02\0\0\0"),
        ("size", b"\x15\0\0\0"),
        ("write_access", b"\0\0"),
        ("not_assigned", b"\0\0"),
        ("index_group", b"\x01\x01\x12\0"),
        ("index_offset", b"\x01\0\x01\0"),
        ("name", &padded::<32>(b"name_of_an_axis")),
        ("type", &padded::<32>(b"STRING")),
    ],
)];

const VARIABLE_KIND: &[Sample] = &[
    sample("printed", &[("kind", b"V.E\0")]),
    sample("all", &[("kind", b"\0")]),
    sample("all-of-nothing", &[]),
    sample("padded", &[("kind", b"V.A\0\0\0\0\0")]),
    sample("padded-to-the-limit", &[("kind", &padded::<256>(b"V.G"))]),
];

const VARIABLE_INDEX_KIND: &[Sample] = &[
    sample("printed", &[("index", b"\x02\0\0\0"), ("kind", b"V.E\0")]),
    sample("no-kind", &[("index", b"\0\0\0\0"), ("kind", b"\0")]),
    sample(
        "padded-to-the-limit",
        &[("index", b"\xff\xff\xff\xff"), ("kind", &padded::<256>(b"V.A"))],
    ),
];

const VARIABLE_DESCRIPTION: &[Sample] = &[
    sample(
        "printed",
        &[
            ("handle", b"\x02\0\0\x02"),
            ("type", b"\x01\0\0\0"),
            ("access", b"\x01\0\0\0"),
            ("size", b"\x02\0\0\0"),
            ("dimension_count", b"\x01\0\0\0"),
            ("dimensions", b"\x02\0\0\0"),
            ("name", b"V.E.Variable_3\0"),
        ],
    ),
    sample(
        "elementary-lone-nul",
        &[
            ("handle", b"\x1b\0\x02\x01"),
            ("type", b"\x08\0\0\0"),
            ("access", b"\x02\0\0\0"),
            ("size", b"\x08\0\0\0"),
            ("dimension_count", b"\0\0\0\0"),
            ("name", b"\0"),
        ],
    ),
    // A matrix with codes that the manuals do not document. Its name ends without a NUL at the end
    // of the stream.
    sample(
        "matrix-open-name",
        &[
            ("handle", b"\xff\xff\xff\xff"),
            ("type", b"\x4d\0\0\0"),
            ("access", b"\0\0\0\x80"),
            ("size", b"\x18\0\0\0"),
            ("dimension_count", b"\x02\0\0\0"),
            ("dimensions", b"\x02\0\0\0"),
            ("dimensions", b"\x03\0\0\0"),
            ("name", b"V.E.L\xe4nge\x81\x9d"),
        ],
    ),
    sample(
        "three-dimensions-bytes-behind-the-nul",
        &[
            ("handle", b"\x01\0\0\0"),
            ("type", b"\x09\0\0\0"),
            ("access", b"\x02\0\0\0"),
            ("size", b"\x78\0\0\0"),
            ("dimension_count", b"\x03\0\0\0"),
            ("dimensions", b"\x01\0\0\0"),
            ("dimensions", b"\x02\0\0\0"),
            ("dimensions", b"\x03\0\0\0"),
            ("name", b"V.G.NAME\0riable_3\0\0"),
        ],
    ),
    sample(
        "padded-to-the-limit",
        &[
            ("handle", b"\x02\0\0\x02"),
            ("type", b"\x07\0\0\0"),
            ("access", b"\x01\0\0\0"),
            ("size", b"\x04\0\0\0"),
            ("dimension_count", b"\0\0\0\0"),
            ("name", &padded::<256>(b"V.G.WZ_AKT.SPDL_AX_NR")),
        ],
    ),
];

const VARIABLE_NAME: &[Sample] = &[
    sample("printed", &[("name", b"V.E.vartest\0")]),
    sample("empty", &[("name", b"\0")]),
    sample("every-hard-byte", &[("name", b"V.E.\x81\x8d\x8f\x90\x9d\x80\xe4\xff\x01\x7f\0")]),
    sample("padded", &[("name", b"V.E.Testvar[3]\0\0\0")]),
    sample("padded-to-the-limit", &[("name", &padded::<256>(b"V.E.Testvar"))]),
];

const VARIABLE_HANDLE_READ: &[Sample] = &[
    sample(
        "printed-element",
        &[
            ("handle", b"\x41\x23\x01\x20"),
            ("index_count", b"\x01\0\0\0"),
            ("indices", b"\x04\0\0\0"),
        ],
    ),
    sample("printed-array", &[("handle", b"\x34\x12\x00\x02"), ("index_count", b"\0\0\0\0")]),
    sample(
        "three-indices",
        &[
            ("handle", b"\0\0\0\0"),
            ("index_count", b"\x03\0\0\0"),
            ("indices", b"\0\0\0\0"),
            ("indices", b"\xff\xff\xff\xff"),
            ("indices", b"\x01\x02\x03\x04"),
        ],
    ),
];

const VARIABLE_VALUE: &[Sample] = &[
    sample("printed-element", &[("value", b"\x4d\x01\0\0")]),
    sample(
        "printed-array",
        &[("value", b"\x7b\0\0\0\xea\0\0\0\x59\x01\0\0\xc8\x01\0\0\x37\x02\0\0")],
    ),
    sample("printed-real", &[("value", b"\xcd\xcc\xcc\xcc\xcc\x48\x93\x40")]),
    sample("text", &[("value", b"G01 X10\0\0behind")]),
    sample("nothing", &[]),
];

const VARIABLE_HANDLE_WRITE: &[Sample] = &[
    sample(
        "printed-element",
        &[
            ("handle", b"\x34\x12\x00\x02"),
            ("index_count", b"\x01\0\0\0"),
            ("indices", b"\x04\0\0\0"),
            ("value", b"\x7b\0\0\0"),
        ],
    ),
    sample(
        "printed-array",
        &[
            ("handle", b"\x34\x12\x00\x02"),
            ("index_count", b"\0\0\0\0"),
            ("value", b"\x7b\0\0\0\xea\0\0\0\x59\x01\0\0\xc8\x01\0\0\x37\x02\0\0"),
        ],
    ),
    sample("nothing-to-write", &[("handle", b"\x01\0\0\0"), ("index_count", b"\0\0\0\0")]),
];

const VARIABLE_NAME_WRITE: &[Sample] = &[
    sample("printed-element", &[("name", b"V.E.test[4]\0"), ("value", b"\x7b\0\0\0")]),
    sample(
        "printed-array",
        &[
            ("name", b"V.E.test\0"),
            ("value", b"\x7b\0\0\0\xea\0\0\0\x59\x01\0\0\xc8\x01\0\0\x37\x02\0\0"),
        ],
    ),
    sample(
        "printed-axis",
        &[("name", b"V.A.WCS\0"), ("value", b"\x77\xbe\x9f\x1a\x2f\xdd\x5e\x40")],
    ),
    sample("nothing-to-write", &[("name", b"V.E.L\xe4nge\0")]),
];

const VARIABLE_EXTENDED_DESCRIPTION: &[Sample] = &[
    sample("printed", &[("synchronisation", b"\x02\0\0\0"), ("validity", b"\x02\0\0\0")]),
    sample("unknown", &[("synchronisation", b"\0\0\0\x80"), ("validity", b"\x4d\0\0\0")]),
    sample("none", &[]),
];
