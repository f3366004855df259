//! Calls as a CNC receives them: their parts are written by hand, not encoded by the codec.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{AdsService, Call, Function};

/// A call, and the function to which it is dispatched.
pub(crate) struct CallSample {
    pub(crate) slug: &'static str,
    pub(crate) function: Function,
    pub(crate) call: Call<'static>,
}

const fn read(slug: &'static str, function: Function, place: (u32, u32, u32)) -> CallSample {
    sample(slug, function, 553, AdsService::Read, place, b"")
}

const fn sda(slug: &'static str, function: Function, place: (u32, u32, u32)) -> CallSample {
    sample(slug, function, 552, AdsService::Read, place, b"")
}

const fn variable(
    slug: &'static str,
    function: Function,
    place: (u32, u32, u32),
    data: &'static [u8],
) -> CallSample {
    sample(slug, function, 552, AdsService::ReadWrite, place, data)
}

const fn write(
    slug: &'static str,
    function: Function,
    offset: u32,
    data: &'static [u8],
) -> CallSample {
    sample(slug, function, 552, AdsService::Write, (0x12_2301, offset, 0), data)
}

const fn sample(
    slug: &'static str,
    function: Function,
    port: u16,
    service: AdsService,
    (group, offset, read_length): (u32, u32, u32),
    data: &'static [u8],
) -> CallSample {
    let call = Call {
        port: AmsPort(port),
        service,
        index_group: IndexGroup::new(group),
        index_offset: IndexOffset::new(offset),
        read_length,
        data,
    };
    CallSample { slug, function, call }
}

/// At least one call of each function, and for some functions also a call that addresses its
/// instance by index. `printed` in a slug marks a call with values that a manual prints.
pub(crate) const CALLS: &[CallSample] = &[
    read("objects-of-channel-1", Function::CountObjects, (0x13_0101, 0, 4)),
    read("objects-of-platform", Function::CountObjects, (0x13_0100, 0, 4)),
    read("objects-of-axis-2", Function::CountObjects, (0x13_0202, 0, 4)),
    read("objects-by-index", Function::CountObjects, (0x3_0102, 0, 4)),
    read("descriptor-printed", Function::ReadDescriptors, (0x13_0101, 0x10, 84)),
    read("descriptors-two-by-index", Function::ReadDescriptors, (0x3_0101, 1, 168)),
    read("descriptor-odd-length", Function::ReadDescriptors, (0x13_0101, 1, 100)),
    variable("count-printed", Function::CountVariables, (0x12_2301, 0x44, 4), b"V.E\0"),
    variable("count-all", Function::CountVariables, (0x12_2301, 0x44, 4), b"\0"),
    variable("count-all-of-nothing", Function::CountVariables, (0x12_2301, 0x44, 4), b""),
    variable(
        "description-printed",
        Function::DescribeByIndex,
        (0x12_2301, 0x45, 2048),
        b"\x02\0\0\0V.E\0",
    ),
    variable("handle-printed", Function::HandleByName, (0x12_2301, 0x46, 4), b"V.E.vartest\0"),
    variable(
        "read-by-handle-printed-element",
        Function::ReadByHandle,
        (0x12_2301, 0x47, 2048),
        b"\x41\x23\x01\x20\x01\0\0\0\x04\0\0\0",
    ),
    variable(
        "read-by-handle-printed-array",
        Function::ReadByHandle,
        (0x12_2301, 0x47, 2048),
        b"\x34\x12\x00\x02\0\0\0\0",
    ),
    variable(
        "read-by-name-printed-element",
        Function::ReadByName,
        (0x12_2301, 0x48, 2048),
        b"V.E.Testvar[3]\0",
    ),
    variable(
        "read-by-name-by-index-padded",
        Function::ReadByName,
        (0x2_2302, 0x48, 2048),
        b"V.E.Testvar\0\0\0\0",
    ),
    // The GEO task also serves the classes. This is an assumption (ADR-10).
    sample(
        "handle-from-geo",
        Function::HandleByName,
        551,
        AdsService::ReadWrite,
        (0x12_2306, 0x46, 4),
        b"V.A.ACT_POS.X\0",
    ),
    variable(
        "extended-printed",
        Function::DescribeExtended,
        (0x12_2301, 0x4B, 2048),
        b"\x03\0\0\0V.E\0",
    ),
    variable(
        "axis-handle-printed",
        Function::AxisHandleByName,
        (0x12_2301, 0x2_0004, 4),
        b"V.A.WCS\0",
    ),
    variable(
        "axis-read-printed",
        Function::AxisReadByName,
        (0x12_2301, 0x2_0005, 2048),
        b"V.A.WCS\0",
    ),
    write(
        "write-by-handle-printed-element",
        Function::WriteByHandle,
        0x49,
        b"\x34\x12\x00\x02\x01\0\0\0\x04\0\0\0\x7b\0\0\0",
    ),
    write(
        "write-by-handle-printed-array",
        Function::WriteByHandle,
        0x49,
        b"\x34\x12\x00\x02\0\0\0\0\x7b\0\0\0\xea\0\0\0\x59\x01\0\0\xc8\x01\0\0\x37\x02\0\0",
    ),
    write("write-by-name-printed-element", Function::WriteByName, 0x4A, b"V.E.test[4]\0\x7b\0\0\0"),
    write(
        "axis-write-printed",
        Function::AxisWriteByName,
        0x2_0006,
        b"V.A.WCS\0\x77\xbe\x9f\x1a\x2f\xdd\x5e\x40",
    ),
    variable(
        "description-by-name",
        Function::DescribeByName,
        (0x12_2301, 0x4C, 2048),
        b"V.E.Variable_3\0",
    ),
    sda("parameters-printed", Function::CountDynamic, (0x12_2301, 0x02, 4)),
    sda("variables-v.l", Function::CountDynamic, (0x12_2301, 0x03, 4)),
    sda("variables-v.p-by-index", Function::CountDynamic, (0x2_2302, 0x04, 4)),
    sda("variables-v.s", Function::CountDynamic, (0x12_2301, 0x05, 4)),
    variable(
        "parameter-name-printed",
        Function::DynamicNameByIndex,
        (0x12_2301, 0x1B, 96),
        b"\x01\0\0\0",
    ),
    variable("v.s-name", Function::DynamicNameByIndex, (0x12_2301, 0x24, 96), b"\xff\xff\xff\xff"),
    variable("parameter-printed", Function::DynamicValueByName, (0x12_2301, 0x1C, 8), b"P1\0"),
    variable("parameter-without-nul", Function::DynamicValueByName, (0x12_2301, 0x1C, 8), b"P1"),
    variable("v.l-value", Function::DynamicValueByName, (0x12_2301, 0x1F, 8), b"V.L.name\0"),
    variable("v.p-by-index", Function::DynamicValueByIndex, (0x12_2301, 0x23, 8), b"\x01\0\0\0"),
    variable(
        "instance-printed-channel",
        Function::FindInstance,
        (0x12_3900, 0, 8),
        b"\x01\0\0\0\0\0\0\0",
    ),
    variable(
        "instance-printed-decoder-axis",
        Function::FindInstance,
        (0x12_2900, 0, 8),
        b"\x01\0\0\0\x02\0\0\0",
    ),
    variable("instance-spindle", Function::FindInstance, (0x2_5900, 0, 8), b"\0\0\0\0\0\0\0\0"),
    variable("instance-by-index", Function::FindInstance, (0x2_3900, 0, 8), b"\x01\0\0\0\0\0\0\0"),
    sda("elements-of-channel", Function::CountElements, (0x12_3301, 0, 4)),
    sda("elements-of-decoder-axis", Function::CountElements, (0x12_2301, 0x2_0000, 4)),
    sda("elements-of-spindle", Function::CountElements, (0x2_5302, 0, 4)),
    sda("content-printed", Function::ReadElement, (0x12_3301, 1, 1)),
    // With the stride 0x1000, offset 0x1000 is element 0 of axis 1. With the stride 0x10000, which
    // dispatch uses, it is element 0x1000 (E-01).
    sda("content-platform-axis", Function::ReadElement, (0x12_3300, 0x1000, 4)),
    sda("content-position-controller", Function::ReadElement, (0x12_0300, 0x1_0001, 8)),
    sda("content-of-reserved-offset", Function::ReadElement, (0x12_2301, 0x4D, 4)),
    sda("name-printed", Function::ReadElementName, (0x12_3401, 1, 256)),
    sda("name-of-function", Function::ReadElementName, (0x12_2401, 0x44, 256)),
    sda("type-printed", Function::ReadElementType, (0x12_3501, 1, 256)),
    sda("length-printed", Function::ReadElementLength, (0x12_3601, 1, 4)),
    sda("unit-printed", Function::ReadElementUnit, (0x12_3701, 1, 256)),
    sda("write-flag-printed", Function::ReadElementWriteFlag, (0x12_3801, 1, 1)),
    sample(
        "write-content",
        Function::WriteElement,
        552,
        AdsService::Write,
        (0x12_3301, 1, 0),
        b"\x01",
    ),
    sample(
        "stream",
        Function::WriteProgramStream,
        553,
        AdsService::Write,
        (0x12_0101, 0x90, 0),
        b"N10 M30\r\n",
    ),
    sample(
        "stream-printed-by-index",
        Function::WriteProgramStream,
        553,
        AdsService::Write,
        (0x2_0101, 0x90, 0),
        b"N10 M30\r\n",
    ),
    read("object-printed-platform", Function::ReadObject, (0x12_0100, 0x251, 4)),
    read("object-printed-axis", Function::ReadObject, (0x12_0201, 0x1_0001, 4)),
    read("object-printed-channel", Function::ReadObject, (0x12_0101, 1, 4)),
    // Offset 0x90 is the program stream only in the groups of channels. In the group of the
    // platform, it is an object.
    read("object-platform-0x90", Function::ReadObject, (0x12_0100, 0x90, 4)),
    sample(
        "write-object-printed",
        Function::WriteObject,
        553,
        AdsService::Write,
        (0x12_0101, 1, 0),
        b"\x01",
    ),
];
