//! The cases of calls of each function: they are dispatched, rejected and encoded.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::dynamic::{DynamicIndex, DynamicNameRequestRef};
use ads_cnc::operation::{AdsService, Call};
use ads_cnc::sda::ObjectAddressQuery;
use ads_cnc::streaming::ProgramStreamRef;
use ads_cnc::{
    ContentRef, Decode, HandleReadRef, HandleWriteRef, NameWriteRef, NoData, VariableIndexKindRef,
    VariableKindRef, VariableNameRef,
};

use crate::case::{Case, Limit, Work, each};
use crate::hand;

/// The number of calls in a run.
const CALLS: usize = 100;

/// One byte more than content can have.
const TOO_LONG: &[u8] = &[0; ads_cnc::limits::ADS_DATA_MAX + 1];

macro_rules! functions {
    ($(
        $subject:literal at ($port:literal, $service:ident, $group:literal, $offset:literal, $length:literal)
            with $data:expr, not $bad:expr, as $stream:ty, by hand $function:ident $parameters:tt;
    )+) => {
        pub(super) const FUNCTIONS: &[Case] = &[$(
            Case::new(concat!("call: ", $subject), "dispatch", || {
                each!([call(row!($port $service $group $offset $length), $data); CALLS], |call| call.dispatch())
            }),
            Case::new(concat!("call: ", $subject), "the data alone", || {
                each!([&$data[..]; CALLS], |bytes| <$stream>::decode(bytes))
            }),
            Case::new(concat!("call: ", $subject), "rejection of data", || {
                each!([call(row!($port $service $group $offset $length), $bad); CALLS], |call| call.dispatch())
            })
            .within(&[Limit::Over("dispatch", 200.0)]),
            Case::new(concat!("call: ", $subject), "encode", || {
                encode(call(row!($port $service $group $offset $length), $data))
            })
            // All operations share the code that builds a call, which needs more instructions.
            .within(&[Limit::Instructions("encode by hand", 4.0)]),
            Case::new(concat!("call: ", $subject), "encode by hand", || {
                encode_by_hand(hand::requests::Request::$function $parameters)
            }),
        )+];

        #[cfg(test)]
        const BY_HAND: &[(Call<'static>, &[u8], hand::requests::Request<'static>)] = &[$(
            (
                call(row!($port $service $group $offset $length), $data),
                $bad,
                hand::requests::Request::$function $parameters,
            ),
        )+];
    };
}

macro_rules! row {
    ($port:literal $service:ident $group:literal $offset:literal $length:literal) => {
        ($port, AdsService::$service, $group, $offset, $length)
    };
}

functions! {
    "number of objects" at (553, Read, 0x13_0101, 0, 4)
        with b"", not b"\0", as NoData, by hand CountObjects { group: 0x13_0101 };
    "object descriptors" at (553, Read, 0x13_0101, 1, 840)
        with b"", not b"\0", as NoData,
        by hand ReadDescriptors { group: 0x13_0101, first: 1, read_length: 840 };
    "number of variable elements" at (552, ReadWrite, 0x12_2301, 0x44, 4)
        with b"V.E\0", not b"V.E", as VariableKindRef<'_>,
        by hand CountVariables { channel: 1, kind: b"V.E" };
    "variable description by index" at (552, ReadWrite, 0x12_2301, 0x45, 2048)
        with b"\x02\0\0\0V.E\0", not b"\x02\0\0\0V.E", as VariableIndexKindRef<'_>,
        by hand DescribeByIndex { channel: 1, index: 2, kind: b"V.E" };
    "variable handle by name" at (552, ReadWrite, 0x12_2301, 0x46, 4)
        with b"V.E.vartest\0", not b"V.E.vartest", as VariableNameRef<'_>,
        by hand HandleByName { channel: 1, name: b"V.E.vartest" };
    "read variable value by handle" at (552, ReadWrite, 0x12_2301, 0x47, 2048)
        with b"\x41\x23\x01\x20\x01\0\0\0\x04\0\0\0", not b"\x41\x23\x01\x20\x02\0\0\0\x04\0\0\0",
        as HandleReadRef<'_>,
        by hand ReadByHandle { channel: 1, handle: 0x2001_2341, indices: &[4] };
    "read variable value by name" at (552, ReadWrite, 0x12_2301, 0x48, 2048)
        with b"V.E.Testvar[3]\0", not b"V.E.Testvar[3]", as VariableNameRef<'_>,
        by hand ReadByName { channel: 1, name: b"V.E.Testvar[3]" };
    "write variable value by handle" at (552, Write, 0x12_2301, 0x49, 0)
        with b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7B\0\0\0", not b"\x34\x12\0\x02\x01\0\0\0\x04\0\0",
        as HandleWriteRef<'_>,
        by hand WriteByHandle { channel: 1, handle: 0x200_1234, indices: &[4], value: b"\x7B\0\0\0" };
    "write variable value by name" at (552, Write, 0x12_2301, 0x4A, 0)
        with b"V.E.test[4]\0\x7B\0\0\0", not b"V.E.test[4]", as NameWriteRef<'_>,
        by hand WriteByName { channel: 1, name: b"V.E.test[4]", value: b"\x7B\0\0\0" };
    "extended variable description by index" at (552, ReadWrite, 0x12_2301, 0x4B, 2048)
        with b"\x03\0\0\0V.E\0", not b"\x03\0\0\0V.E", as VariableIndexKindRef<'_>,
        by hand DescribeExtended { channel: 1, index: 3, kind: b"V.E" };
    "variable description by name" at (552, ReadWrite, 0x12_2301, 0x4C, 2048)
        with b"V.E.Variable_3\0", not b"V.E.Variable_3", as VariableNameRef<'_>,
        by hand DescribeByName { channel: 1, name: b"V.E.Variable_3" };
    "axis variable handle by name" at (552, ReadWrite, 0x12_2301, 0x2_0004, 4)
        with b"V.A.WCS\0", not b"V.A.WCS", as VariableNameRef<'_>,
        by hand AxisHandleByName { channel: 1, axis: 2, name: b"V.A.WCS" };
    "read axis variable value by name" at (552, ReadWrite, 0x12_2301, 0x2_0005, 2048)
        with b"V.A.WCS\0", not b"V.A.WCS", as VariableNameRef<'_>,
        by hand AxisReadByName { channel: 1, axis: 2, name: b"V.A.WCS" };
    "write axis variable value by name" at (552, Write, 0x12_2301, 0x2_0006, 0)
        with b"V.A.WCS\0\x77\xBE\x9F\x1A\x2F\xDD\x5E\x40", not b"V.A.WCS", as NameWriteRef<'_>,
        by hand AxisWriteByName {
            channel: 1, axis: 2, name: b"V.A.WCS", value: b"\x77\xBE\x9F\x1A\x2F\xDD\x5E\x40",
        };
    "number of dynamic parameters" at (552, Read, 0x12_2301, 3, 4)
        with b"", not b"\0", as NoData, by hand CountDynamic { channel: 1, kind: 1 };
    "dynamic parameter name by index" at (552, ReadWrite, 0x12_2301, 0x1B, 96)
        with b"\x01\0\0\0", not b"\0\0\0\0", as DynamicIndex,
        by hand DynamicNameByIndex { channel: 1, kind: 0, index: 1 };
    "dynamic parameter value by name" at (552, ReadWrite, 0x12_2301, 0x1F, 8)
        with b"V.L.name\0", not b"", as DynamicNameRequestRef<'_>,
        by hand DynamicValueByName { channel: 1, kind: 1, name: b"V.L.name" };
    "dynamic parameter value by index" at (552, ReadWrite, 0x12_2301, 0x23, 8)
        with b"\x01\0\0\0", not b"\0\0\0\0", as DynamicIndex,
        by hand DynamicValueByIndex { channel: 1, kind: 2, index: 1 };
    "object address" at (552, ReadWrite, 0x12_3900, 0, 8)
        with b"\x01\0\0\0\0\0\0\0", not b"\x01\0\0\0\0\0\0", as ObjectAddressQuery,
        by hand FindInstance { group: 0x12_3900, channel: 1, axis: 0 };
    "number of element types" at (552, Read, 0x12_3301, 0, 4)
        with b"", not b"\0", as NoData, by hand CountElements { group: 0x12_3301, offset: 0 };
    "element content" at (552, Read, 0x12_3301, 1, 1)
        with b"", not b"\0", as NoData,
        by hand ReadElement { group: 0x12_3301, offset: 1, length: 1 };
    "write element content" at (552, Write, 0x12_3301, 1, 0)
        with b"\x01", not TOO_LONG, as ContentRef<'_>,
        by hand WriteElement { group: 0x12_3301, offset: 1, content: b"\x01" };
    "element name" at (552, Read, 0x12_3401, 1, 256)
        with b"", not b"\0", as NoData, by hand ReadElementName { group: 0x12_3401, offset: 1 };
    "element type" at (552, Read, 0x12_3501, 1, 256)
        with b"", not b"\0", as NoData, by hand ReadElementType { group: 0x12_3501, offset: 1 };
    "element length" at (552, Read, 0x12_3601, 1, 4)
        with b"", not b"\0", as NoData, by hand ReadElementLength { group: 0x12_3601, offset: 1 };
    "element unit" at (552, Read, 0x12_3701, 1, 256)
        with b"", not b"\0", as NoData, by hand ReadElementUnit { group: 0x12_3701, offset: 1 };
    "element write flag" at (552, Read, 0x12_3801, 1, 1)
        with b"", not b"\0", as NoData, by hand ReadElementWriteFlag { group: 0x12_3801, offset: 1 };
    "data streaming" at (553, Write, 0x12_0101, 0x90, 0)
        with b"N10 M30\r\n", not b"", as ProgramStreamRef<'_>,
        by hand WriteProgramStream { channel: 1, packet: b"N10 M30\r\n" };
    "object content" at (553, Read, 0x12_0101, 1, 4)
        with b"", not b"\0", as NoData,
        by hand ReadObject { group: 0x12_0101, offset: 1, length: 4 };
    "write object content" at (553, Write, 0x12_0101, 1, 0)
        with b"\x01", not TOO_LONG, as ContentRef<'_>,
        by hand WriteObject { group: 0x12_0101, offset: 1, content: b"\x01" };
}

/// Declares cases of a request for a handle by name, without a fault and with one fault each.
macro_rules! rejections {
    ($( $implementation:literal: $port:literal $service:ident $group:literal $offset:literal; )+) => {
        pub(super) const REJECTIONS: &[Case] = &[$(
            Case::new("one fault", $implementation, || {
                let data = b"V.E.vartest\0";
                each!([call(row!($port $service $group $offset 4), data); CALLS], |call| call.dispatch())
            })
            // Rejecting an address may cost more than success, because dispatch scans the whole
            // table first.
            .within(&[Limit::Over("none", 1000.0)]),
        )+];
    };
}

rejections! {
    "none": 552 ReadWrite 0x12_2301 0x46;
    "port": 851 ReadWrite 0x12_2301 0x46;
    "group": 552 ReadWrite 0xF005 0x46;
    "group of another task": 552 ReadWrite 0x13_0101 0x46;
    "offset": 552 ReadWrite 0x12_2301 0x4E;
    "offset of no channel": 552 ReadWrite 0x12_2300 0x46;
    "service": 552 Write 0x12_2301 0x46;
}

const fn call(
    (port, service, group, offset, read_length): (u16, AdsService, u32, u32, u32),
    data: &'static [u8],
) -> Call<'static> {
    let (index_group, index_offset) = (IndexGroup::new(group), IndexOffset::new(offset));
    Call { port: AmsPort(port), service, index_group, index_offset, read_length, data }
}

fn encode(call: Call<'static>) -> Work {
    let mut buf = [0; 256];
    each!([call.dispatch().unwrap(); CALLS], |request| request.encode(&mut buf))
}

fn encode_by_hand(request: hand::requests::Request<'static>) -> Work {
    let mut buf = [0; 256];
    each!([request; CALLS], |request| request.encode(&mut buf))
}

#[cfg(test)]
mod tests {
    use ads_cnc::operation::DispatchError;

    use super::*;

    /// The handwritten code encodes the same calls as the codec.
    #[test]
    fn encoded_by_hand_is_the_same_call() {
        assert_eq!(FUNCTIONS.len(), 5 * ads_cnc::operation::Function::ALL.len());
        for (call, _, by_hand) in BY_HAND {
            let request = call.dispatch().unwrap();
            let (mut buf, mut other) = ([0; 256], [0; 256]);
            assert_eq!(request.encode(&mut buf), Ok(*call));
            let encoded = by_hand.encode(&mut other).unwrap();
            assert_eq!(encoded.port, call.port.0);
            assert_eq!(encoded.service as u16, call.service.command().0);
            assert_eq!(encoded.index_group, call.index_group.get());
            assert_eq!(encoded.index_offset, call.index_offset.get());
            assert_eq!((encoded.read_length, encoded.data), (call.read_length, call.data));
            let none = (request.encode(&mut []), by_hand.encode(&mut []));
            assert_eq!(none.0.is_ok(), none.1.is_ok(), "{call:?}");
        }
    }

    /// The calls measured as rejected are rejected because of their data.
    #[test]
    fn data_is_rejected() {
        for (call, data, _) in BY_HAND {
            let error_of = Call { data, ..*call }.dispatch().unwrap_err();
            assert!(matches!(error_of, DispatchError::Stream(_)), "{call:?}: {error_of}");
        }
    }
}
