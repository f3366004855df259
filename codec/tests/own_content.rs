//! Tests of functions for applications: `to_bytes` of fixed streams, content that is decoded member
//! by member, and streams in sequence.

use ads_cnc::ErrorKind::*;
use ads_cnc::ads::*;
use ads_cnc::layout::Stream;
use ads_cnc::sda::{ElementCount, ElementWriteFlag, ObjectAddress};
use ads_cnc::value::Reader;
use ads_cnc::*;

use super::common::{fault, fault_of};

#[test]
fn to_bytes_equals_encode() {
    macro_rules! check {
        ($( $type:ty, $bytes:expr; )+) => { $(
            let bytes = $bytes;
            assert_eq!(<$type>::decode(&bytes).unwrap().to_bytes(), bytes);
        )+ };
    }
    check! {
        Handle, [4, 0, 0, 2];
        ObjectCount, [9, 0, 0, 1];
        VariableCount, [9, 0, 0, 1];
        ElementCount, [9, 0, 0, 1];
        ElementWriteFlag, [7];
        ObjectAddress, [1, 2, 3, 4, 5, 6, 7, 8];
        WriteReply, [3, 7, 0, 0];
        ReadRequest, [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
        DeviceStateReply, [0, 0, 0, 0, 5, 0, 1, 0];
        dynamic::DynamicValue, [1, 2, 3, 4, 5, 6, 7, 8];
        AmsHeader, std::array::from_fn::<u8, 32, _>(|at| u8::try_from(at).unwrap());
        DeviceInfoReply, std::array::from_fn::<u8, 24, _>(|at| u8::try_from(at).unwrap());
        Descriptor, std::array::from_fn::<u8, 84, _>(|at| u8::try_from(at).unwrap());
    }
}

#[derive(Debug, PartialEq)]
struct Tool<'a> {
    number: u32,
    is_locked: bool,
    name: CncStr<'a>,
    rest: &'a [u8],
}

impl<'a> Decode<'a> for Tool<'a> {
    const STREAM: Stream = Stream::Content;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(bytes);
        let (number, is_locked) = (input.read()?, input.read()?);
        let (name, rest) = (input.text(4)?.text(), input.bytes(2)?);
        input.finish()?;
        Ok(Self { number, is_locked, name, rest })
    }
}

/// The error of a member has the offset of the member.
#[test]
fn content_is_decoded_member_by_member() {
    let bytes = b"\x07\0\0\0\x01ab\0\xFF\x01\x02";
    let tool = Tool::decode(bytes).unwrap();
    let name = CncStr::new("ab").unwrap();
    assert_eq!(tool, Tool { number: 7, is_locked: true, name, rest: &[1, 2] });
    for (len, at, expected) in
        [(0, 0, 4), (3, 0, 4), (4, 4, 1), (5, 5, 4), (8, 5, 4), (9, 9, 2), (10, 9, 2)]
    {
        let wanted = fault(Truncated, "content", at, (expected, len - at));
        assert_eq!(fault_of(Tool::decode(&bytes[..len])), wanted);
    }
    let longer = [&bytes[..], b"x"].concat();
    assert_eq!(fault_of(Tool::decode(&longer)), fault(Trailing, "stream", 11, (11, 12)));
    // By default, `decode_prefix` decodes content to the end of the bytes.
    assert!(Tool::decode_prefix(bytes).unwrap().1.is_empty());
    assert!(Tool::decode_prefix(&longer).is_err());

    let mut input = Reader::new(&longer);
    assert_eq!(input.read::<u64>().map(|_| input.rest()), Ok(&longer[8..]));
    assert_eq!((input.rest(), input.finish()), (&[][..], Ok(())));
}

#[test]
fn streams_in_sequence_are_decoded() {
    let bytes = b"\x04\0\0\x02\x01\0\0\0\x09\0\0\0V.E.a\0\x2A\0";
    let (read, rest) = HandleReadRef::decode_prefix(bytes).unwrap();
    let (write, rest) = NameWriteRef::decode_prefix(rest).unwrap();
    assert_eq!((read.handle, write.name.to_string()), (Handle(0x200_0004), "V.E.a".to_owned()));
    assert_eq!((write.value, rest), (&[42, 0][..], &[][..]));
    // A truncated count and a count that exceeds the maximum of the stream are errors.
    let cut = HandleReadRef::decode_prefix(&bytes[..6]).map(|_| ());
    assert_eq!(fault_of(cut), fault(Truncated, "index_count", 4, (4, 2)));
    let many = [&bytes[..4], &[0xFF; 8000]].concat();
    assert!(HandleReadRef::decode_prefix(&many).is_err());
}
