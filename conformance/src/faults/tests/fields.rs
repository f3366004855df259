//! A defect of a field changes its stream and no other.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef};
use ads_cnc::operation::{AdsService, Call};

use crate::faults::{Faulty, by_id};
use crate::simulator::{Cnc, NET_ID, Responder as _};

fn faulty(id: &str) -> Faulty {
    Faulty::new(Cnc::with_default_model().unwrap(), Some(by_id(id).unwrap()))
}

fn call(group: u32, offset: u32, read_length: u32, data: &[u8]) -> Call<'_> {
    Call {
        port: AmsPort::SDA,
        service: AdsService::ReadWrite,
        index_group: IndexGroup::new(group),
        index_offset: IndexOffset::new(offset),
        read_length,
        data,
    }
}

#[test]
fn a_defect_shows_in_its_stream_only() {
    let with = |id: &str, offset, data: &[u8]| {
        let cnc = faulty(id);
        cnc.answer(&call(0x12_2301, offset, 2048, data))
    };
    let read = b"\x41\x23\x01\x20\x01\0\0\0\x04\0\0\0";
    // The defect changes the request: the next element, another handle, no index instead of one.
    assert_eq!(with("variable-handle-read.indices.flip", 0x47, read), Ok(vec![15, 0, 0, 0]));
    let handle = with("variable-handle-read.handle.flip", 0x47, read);
    assert_eq!(handle, Err(AdsError::INVALID_DATA));
    let count = with("variable-handle-read.index_count.flip", 0x47, read);
    assert_eq!(count, Err(AdsError::INVALID_SIZE));
    // The defect changes the reply of its function, but not the reply of another function.
    assert_eq!(with("variable-count.count.flip", 0x44, b"V.E\0"), Ok(vec![122, 0, 0, 0]));
    assert_eq!(with("variable-count.count.flip", 0x46, b"V.E.vartest\0"), Ok(vec![4, 0, 0, 2]));
}

/// Defects also change the replies to requests for elements, and the data of writes.
#[test]
fn a_defect_shows_in_elements_and_writes() {
    let read = |group| Call { service: AdsService::Read, ..call(group, 1, 256, &[]) };
    let length = faulty("element-length.length.flip").answer(&read(0x12_3601));
    assert_eq!(length, Ok(vec![0, 0, 0, 0]));
    assert_eq!(faulty("content.content.invert").answer(&read(0x12_3301)), Ok(vec![0xFE]));
    // The defect changes the written value from 0x7B to 0x7A.
    let cnc = faulty("variable-name-write.value.flip");
    let write = call(0x12_2301, 0x4A, 0, b"V.E.test[4]\0\x7B\0\0\0");
    assert_eq!(cnc.answer(&Call { service: AdsService::Write, ..write }), Ok(vec![]));
    let element = cnc.answer(&call(0x12_2301, 0x48, 4, b"V.E.test[4]\0"));
    assert_eq!(element, Ok(vec![0x7A, 0, 0, 0]));
}

#[test]
fn a_defect_shows_in_headers() {
    /// Number of V.E variables: group, offset, read length, write length, data.
    const COUNT: &[u8] = b"\x01\x23\x12\0\x44\0\0\0\x04\0\0\0\x04\0\0\0V.E\0";
    let ask = |id: &str| {
        let client = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8001) };
        let target = AmsAddr { net_id: NET_ID, port: AmsPort::SDA };
        let header = AmsHeader::request(target, client, Command::READ_WRITE, 0x0102_0304);
        let data_length = u32::try_from(COUNT.len()).unwrap();
        let frame = FrameRef::new(AmsHeader { data_length, ..header }, COUNT).unwrap();
        let mut bytes = Vec::new();
        faulty(id).respond(NET_ID, &frame, &mut bytes);
        bytes
    };
    assert_eq!(ask("ams-header.invoke_id.flip")[34..38], 0x0102_0305_u32.to_le_bytes());
    assert_eq!(ask("read-write-reply.result.flip")[38], 1);
    // The CNC receives offset 0x45 instead of 0x44, and rejects the request with error 0x705.
    assert_eq!(ask("read-write-request.index_offset.flip")[38..40], [5, 7]);
    assert_eq!(ask("ams-tcp-header.length.flip")[..6], [0, 0, 45, 0, 0, 0]);
}
