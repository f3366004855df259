//! Tests of frames on a TCP stream, which arrive in pieces of any length (ADS-5).

use ads_cnc::ErrorKind::*;
use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{
    AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef, StateFlags,
};
use ads_cnc::operation::{AdsService, Call};
use ads_cnc::{Decode as _, Encode as _};
use proptest::prelude::*;

use super::common::{
    Fault, SPLIT, check_frames, check_split, check_verdicts_stay, fault, frame,
    frame_header as header,
};
use super::kept;

/// A frame is returned when its last byte has arrived, and encodes to the same bytes.
#[test]
fn a_frame_is_returned_when_it_is_complete() {
    let bytes = frame(b"twelve bytes");
    for cut in 0..bytes.len() {
        assert_eq!(FrameRef::split(&bytes[..cut], 12), Ok(None), "{cut}");
    }
    let (frame, len) = FrameRef::split(&bytes, 12).unwrap().unwrap();
    assert_eq!((frame.header(), len), (AmsHeader::decode(&header()).unwrap(), 50));
    assert_eq!(frame.data(), b"twelve bytes");
    let mut buf = [0; 50];
    assert_eq!(frame.encode(&mut buf), Ok(&bytes[..]));
    assert_eq!(frame.encode(&mut [0; 49]).unwrap_err().kind(), BufferTooSmall);
    assert_eq!(FrameRef::new(frame.header(), frame.data()), Ok(frame));
}

const TARGET: AmsAddr = AmsAddr { net_id: AmsNetId([192, 0, 2, 7, 1, 1]), port: AmsPort::SDA };
const SOURCE: AmsAddr = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8001) };

/// A call encodes to the request of its service, and is decoded from a frame (ADS-1, ADS-2, ADS-3).
#[test]
fn a_call_encodes_to_the_request_of_its_service() {
    let call = |service, data| Call {
        port: AmsPort::SDA,
        service,
        index_group: IndexGroup::new(0x12_2301),
        index_offset: IndexOffset::new(0x46),
        read_length: if service == AdsService::Write { 0 } else { 4 },
        data,
    };
    for (call, command, bytes) in [
        (call(AdsService::Read, b""), Command::READ, &b"\x01\x23\x12\0\x46\0\0\0\x04\0\0\0"[..]),
        (call(AdsService::Write, b"ab"), Command::WRITE, b"\x01\x23\x12\0\x46\0\0\0\x02\0\0\0ab"),
        (
            call(AdsService::ReadWrite, b"abc"),
            Command::READ_WRITE,
            b"\x01\x23\x12\0\x46\0\0\0\x04\0\0\0\x03\0\0\0abc",
        ),
    ] {
        let mut buf = [0; 32];
        assert_eq!((call.encode(&mut buf), call.encoded_len()), (Ok(bytes), bytes.len()));
        let frame =
            |command| FrameRef::new(AmsHeader::request(TARGET, SOURCE, command, 7), bytes).unwrap();
        assert_eq!(Call::from_frame(&frame(command)), Ok(Some(call)));
        assert_eq!(Call::from_frame(&frame(Command::READ_STATE)), Ok(None));
        let header = AmsHeader::request(TARGET, SOURCE, command, 7);
        // `from_frame` ignores the state flags; a tool that decodes both directions must check them
        // itself.
        let flagged = AmsHeader { state_flags: StateFlags::RESPONSE, ..header };
        assert_eq!(Call::from_frame(&FrameRef::new(flagged, bytes).unwrap()), Ok(Some(call)));
        let cut = FrameRef::new(header, &bytes[..bytes.len() - 1]).unwrap();
        assert_eq!(Call::from_frame(&cut).unwrap_err().kind(), Truncated);
    }
    let error = call(AdsService::Read, b"a").encode(&mut [0; 32]).unwrap_err();
    assert_eq!((error.kind(), error.expected(), error.found()), (Trailing, 12, 13));
}

#[test]
fn the_header_of_a_response_matches_its_request() {
    let request = AmsHeader::request(TARGET, SOURCE, Command::WRITE, 7);
    let wanted = AmsHeader {
        target: TARGET,
        source: SOURCE,
        command: Command::WRITE,
        state_flags: StateFlags(0x0004),
        data_length: 0,
        error: AdsError(0),
        invoke_id: 7,
    };
    assert_eq!(request, wanted);
    let of_data = AmsHeader { data_length: 4, error: AdsError(7), ..request };
    let wanted =
        AmsHeader { target: SOURCE, source: TARGET, state_flags: StateFlags(0x0005), ..wanted };
    assert_eq!(of_data.response(), wanted);
}

/// A fault in the AMS/TCP header is reported when its 6 bytes have arrived, and a fault in the AMS
/// header when 38 bytes have arrived, whatever bytes follow.
#[test]
fn a_fault_is_reported_as_soon_as_its_bytes_arrive() {
    for (at, byte, seen, wanted) in [
        (1, 0x10, 6, fault(Mismatch, "reserved", 0, (0, 0x1000))),
        (2, 31, 6, fault(OutOfRange, "length", 2, (32, 31))),
        (2, 32 + 13, 6, fault(TooLong, "length", 2, (32 + 12, 32 + 13))),
        (5, 0xFF, 6, fault(TooLong, "length", 2, (32 + 12, 0xFF00_002C))),
        (26, 11, 38, fault(Mismatch, "data_length", 26, (12, 11))),
        (29, 1, 38, fault(Mismatch, "data_length", 26, (12, 0x0100_000C))),
    ] {
        let mut bytes = frame(b"twelve bytes");
        bytes[at] = byte;
        for cut in 0..bytes.len() {
            let split = FrameRef::split(&bytes[..cut], 12).map_err(Fault::of);
            let now = if cut < seen { Ok(None) } else { Err(wanted) };
            assert_eq!(split, now, "byte {at}, cut {cut}");
        }
    }
}

/// The sum of a huge length and the length of the header does not overflow to a small number.
#[test]
fn lengths_do_not_wrap() {
    let mut bytes = frame(b"");
    bytes[2..6].copy_from_slice(&[0xFF; 4]);
    let error = FrameRef::split(&bytes, u32::MAX).unwrap_err();
    // The length exceeds the maximum length of a frame, and is rejected before it is compared with
    // `data_length`.
    assert_eq!((error.kind(), error.offset()), (TooLong, 2));
    let most = u32::try_from(ads_cnc::limits::ADS_DATA_MAX + 16 + 32).unwrap();
    bytes[2..6].copy_from_slice(&most.to_le_bytes());
    let error = FrameRef::split(&bytes, u32::MAX).unwrap_err();
    assert_eq!((error.kind(), error.offset()), (Mismatch, 26));
}

fn config() -> ProptestConfig {
    kept::cases(256, file!())
}

proptest! {
    #![proptest_config(config())]

    /// Frames in sequence are returned one by one, wherever the stream is cut into pieces.
    #[test]
    fn frames_are_returned_in_order(
        datas in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..40), 1..5),
        cuts in prop::collection::vec(any::<prop::sample::Index>(), 0..6),
        left in 0..38_usize,
    ) {
        let frames: Vec<_> = datas.iter().map(|data| frame(data)).collect();
        let bytes = [&frames.concat()[..], &frame(b"")[..left]].concat();
        let mut cuts: Vec<_> = cuts.iter().map(|cut| cut.index(bytes.len() + 1)).collect();
        cuts.extend([0, bytes.len()]);
        cuts.sort_unstable();
        let pieces = cuts.windows(2).map(|cut| &bytes[cut[0]..cut[1]]);
        let (found, rest) = check_frames(pieces, 64, SPLIT);
        prop_assert_eq!((found, rest), (frames, Ok(bytes[bytes.len() - left..].to_vec())));
    }

    #[test]
    fn more_bytes_do_not_change_a_frame_or_a_fault(
        mut bytes in prop::collection::vec(any::<u8>(), 0..60).prop_map(|data| frame(&data)),
        change in prop::option::of((0..38usize, any::<u8>())),
    ) {
        if let Some((at, byte)) = change {
            bytes[at] = byte;
        }
        check_verdicts_stay(&bytes, 64, SPLIT);
        let _ = check_split(&bytes, 8, SPLIT);
    }
}

/// A frame of maximum length is split and encoded; a frame with one more byte is rejected.
#[cfg(feature = "alloc")]
#[test]
fn the_longest_frame_is_accepted_and_a_longer_one_rejected() {
    let most = ads_cnc::limits::ADS_DATA_MAX + 16;
    let data = vec![7; most];
    let header = FrameRef::split(&frame(&[]), u32::MAX).unwrap().unwrap().0.header();
    let bytes = FrameRef::new(header, &data).unwrap().encode_to_vec().unwrap();
    let (frame, len) = FrameRef::split(&bytes, u32::MAX).unwrap().unwrap();
    assert_eq!((frame.data().len(), len), (most, bytes.len()));
    let again = FrameRef::new(frame.header(), frame.data()).unwrap().encode_to_vec();
    assert_eq!(again.as_deref(), Ok(&bytes[..]));

    let more = vec![7; most + 1];
    assert_eq!(FrameRef::new(header, &more).unwrap_err().kind(), TooLong);
    let mut lying = bytes;
    let len = u32::try_from(most + 33).unwrap().to_le_bytes();
    lying[2..6].copy_from_slice(&len);
    assert_eq!(FrameRef::split(&lying, u32::MAX).unwrap_err().kind(), TooLong);
}
