use ads_cnc::ads::{AmsAddr, AmsPort};

use super::*;
use crate::gate::NET_ID;
use crate::simulator::Cnc;

const CLIENT: AmsAddr = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8001) };

/// The data of a ReadWrite for the number of V.E variables: group, offset, read length, write
/// length, data.
const COUNT: &[u8] = b"\x01\x23\x12\0\x44\0\0\0\x04\0\0\0\x04\0\0\0V.E\0";

fn request(command: Command, port: u16, data: &[u8]) -> AmsHeader {
    let target = AmsAddr { net_id: NET_ID, port: AmsPort(port) };
    let data_length = u32::try_from(data.len()).unwrap();
    AmsHeader { data_length, ..AmsHeader::request(target, CLIENT, command, 0x0102_0304) }
}

fn respond(cnc: &Cnc, header: AmsHeader, data: &[u8]) -> Option<(AmsHeader, Vec<u8>)> {
    let mut bytes = Vec::new();
    cnc.respond(NET_ID, &FrameRef::new(header, data).unwrap(), &mut bytes);
    if bytes.is_empty() {
        return None;
    }
    let (frame, len) = FrameRef::split(&bytes, DATA_MAX).unwrap().unwrap();
    assert_eq!(len, bytes.len());
    Some((frame.header(), frame.data().to_vec()))
}

fn ask(command: Command, port: u16, data: &[u8]) -> (AmsHeader, Vec<u8>) {
    let cnc = Cnc::with_default_model().unwrap();
    respond(&cnc, request(command, port, data), data).unwrap()
}

#[test]
fn a_response_has_the_addresses_of_the_request_swapped() {
    let (header, data) = ask(Command::READ_WRITE, 552, COUNT);
    let expected = AmsHeader {
        target: CLIENT,
        source: AmsAddr { net_id: NET_ID, port: AmsPort::SDA },
        state_flags: StateFlags::RESPONSE,
        data_length: 12,
        ..request(Command::READ_WRITE, 552, COUNT)
    };
    assert_eq!(header, expected);
    assert_eq!(data, [0, 0, 0, 0, 4, 0, 0, 0, 123, 0, 0, 0]);
}

#[test]
fn invalid_requests_are_answered_with_errors() {
    // The reply has the error number, and the length 0 in place of data.
    let rejected = |error: u8| vec![error, 7, 0, 0, 0, 0, 0, 0];
    assert_eq!(ask(Command::READ_WRITE, 553, COUNT).1, rejected(2));
    assert_eq!(ask(Command::READ_WRITE, 552, &COUNT[..19]).1, rejected(5));
    assert_eq!(ask(Command::READ, 552, &COUNT[..12]).1, rejected(1));
    assert_eq!(ask(Command::READ, 552, &[]).1, rejected(5));
    // Writes to a writable object and to a read-only object.
    let write = b"\x01\x01\x12\0\x01\0\0\0\x01\0\0\0\x01";
    assert_eq!(ask(Command::WRITE, 553, write).1, [0, 0, 0, 0]);
    let write = b"\x01\x01\x12\0\x03\0\0\0\x01\0\0\0\x01";
    assert_eq!(ask(Command::WRITE, 553, write).1, [4, 7, 0, 0]);
    for command in [0, 5, 7, 8, 10, 0xFFFF] {
        assert_eq!(ask(Command(command), 552, &[]).1, [1, 7, 0, 0], "{command}");
    }
    // The reply has a notification handle of 0.
    assert_eq!(ask(Command::ADD_NOTIFICATION, 552, &[0; 40]).1, rejected(1));
}

#[test]
fn device_info_and_state_are_answered() {
    for port in [551, 552, 553] {
        let info = ask(Command::READ_DEVICE_INFO, port, &[]).1;
        let minor: u8 = env!("CARGO_PKG_VERSION_MINOR").parse().unwrap();
        assert_eq!(info[..8], [0, 0, 0, 0, 0, minor, 0, 0]);
        assert_eq!(info[8..], *b"ads-cnc serve\0\0\0");
        assert_eq!(ask(Command::READ_STATE, port, &[]).1, [0, 0, 0, 0, 5, 0, 0, 0]);
    }
    assert_eq!(ask(Command::READ_DEVICE_INFO, 552, &[0]).1[..4], [5, 7, 0, 0]);
    assert_eq!(ask(Command::READ_STATE, 552, &[0]).1[..4], [5, 7, 0, 0]);
    assert_eq!(ask(Command::READ_STATE, 10000, &[]).0.error, AdsError::TARGET_PORT_NOT_FOUND);
}

#[test]
fn replies_are_appended() {
    let cnc = Cnc::with_default_model().unwrap();
    let frame = FrameRef::new(request(Command::READ_WRITE, 552, COUNT), COUNT).unwrap();
    let mut answers = vec![0xAA; 3];
    for times in 1..4 {
        cnc.respond(NET_ID, &frame, &mut answers);
        assert_eq!(answers.len(), 3 + times * 50);
    }
    assert_eq!(answers[3..53], answers[103..]);
    assert_eq!(answers[..3], [0xAA; 3]);
}

#[test]
fn ams_errors_have_no_data() {
    let (header, data) = ask(Command::READ_WRITE, 851, COUNT);
    assert_eq!((header.error, data.len()), (AdsError::TARGET_PORT_NOT_FOUND, 0));

    let cnc = Cnc::with_default_model().unwrap();
    let mut other = request(Command::READ_WRITE, 552, COUNT);
    other.target.net_id = AmsNetId([10, 0, 0, 1, 1, 1]);
    let (header, data) = respond(&cnc, other, COUNT).unwrap();
    assert_eq!((header.error, data.len()), (AdsError::TARGET_MACHINE_NOT_FOUND, 0));
    assert_eq!((header.source, header.target), (other.target, CLIENT));
}

#[test]
fn a_response_is_not_answered() {
    let cnc = Cnc::with_default_model().unwrap();
    let header =
        AmsHeader { state_flags: StateFlags::RESPONSE, ..request(Command::READ_WRITE, 552, COUNT) };
    assert_eq!(respond(&cnc, header, COUNT), None);
}
