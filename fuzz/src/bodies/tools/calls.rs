//! Calls to the simulated CNC, and their frames.

use ads_cnc::Encode as _;
use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsAddr, AmsHeader, AmsNetId, AmsPort, FrameRef};
use ads_cnc::operation::{AdsService, Call};
use ads_cnc_conformance::simulator::NET_ID;

use super::Input;

/// The ports to which calls of a session are sent.
pub(super) const PORTS: [u16; 4] = [552, 553, 551, 851];

/// Reads a call: indices of the port and the service (1 byte each), group and offset (4 bytes each), read
/// length (2 bytes), length of the data (1 byte), data.
pub(super) fn call<'a>(input: &mut Input<'a>, ports: &[u16]) -> Call<'a> {
    let port = AmsPort(*input.choose(ports));
    let service = *input.choose(&[AdsService::Read, AdsService::Write, AdsService::ReadWrite]);
    let index_group = IndexGroup::new(input.long());
    let index_offset = IndexOffset::new(input.long());
    let read_length = input.word().into();
    let data = input.piece();
    let data = if service == AdsService::Read { &[] } else { data };
    Call { port, service, index_group, index_offset, read_length, data }
}

/// Writes a call in the form that [`call`] reads; `port` is an index into the list of ports.
pub(super) fn written(call: &Call<'_>, port: usize) -> Vec<u8> {
    let byte = |number: usize| u8::try_from(number).expect("short data");
    let service = match call.service {
        AdsService::Read => 0,
        AdsService::Write => 1,
        AdsService::ReadWrite => 2,
    };
    let mut bytes = vec![byte(port), service];
    bytes.extend(call.index_group.get().to_le_bytes());
    bytes.extend(call.index_offset.get().to_le_bytes());
    bytes.extend(&call.read_length.to_le_bytes()[..2]);
    bytes.push(byte(call.data.len()));
    bytes.extend(call.data);
    bytes
}

/// Writes a call as a record of a session: of kind 1, or of kind 6, for which the target checks the
/// effect of the call.
pub(crate) fn write_call(kind: u8, call: &Call<'_>) -> Vec<u8> {
    let port = PORTS.iter().position(|port| *port == call.port.0).unwrap_or(3);
    let mut bytes = vec![kind];
    bytes.extend(written(call, port));
    if kind == 1 {
        bytes.extend(7_u32.to_le_bytes());
    }
    bytes
}

/// The frame of a call to the CNC.
pub(crate) fn frame(call: &Call<'_>, invoke_id: u32) -> Vec<u8> {
    let payload = call.encode_to_vec().expect("short data");
    let target = AmsAddr { net_id: NET_ID, port: call.port };
    let source = AmsAddr { net_id: AmsNetId([127, 0, 0, 1, 1, 2]), port: AmsPort(0x8001) };
    let header = AmsHeader::request(target, source, call.service.command(), invoke_id);
    FrameRef::new(header, &payload).and_then(|frame| frame.encode_to_vec()).expect("a frame")
}
