//! What a server makes of a call.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{Call, Service};

use crate::common;
use crate::{Defect, Outcome};

/// A call: port (2 bytes), service (1), group, offset and read length (4 each), data.
///
/// Dispatch refuses it, or finds a request that encodes to the same call and is dispatched to
/// itself.
pub(crate) fn dispatch(data: &[u8], defect: Defect) -> Outcome {
    let Some(call) = read_call(data) else { return Outcome::unread() };
    let bent = common::check_call_bent(&call, |again| {
        if defect.is(1) {
            again.index_group = IndexGroup::new(again.index_group.get() & !0x10_0000);
        }
        if defect.is(2) && again.data.len() > 8 {
            again.data = &again.data[..8];
        }
    });
    match bent {
        Ok(()) => Outcome::accepted(data),
        Err(refusal) => Outcome::refused(format!("{refusal:?}")),
    }
}

pub(crate) const DISPATCH_DEFECTS: &[&str] = &[
    "a logical group is encoded as one by index",
    "what is behind the eighth byte of a request is lost",
];

/// Reads a call as [`dispatch`] has it.
pub(crate) fn read_call(bytes: &[u8]) -> Option<Call<'_>> {
    let (&port, bytes) = bytes.split_first_chunk()?;
    let (&service, bytes) = bytes.split_first()?;
    let (&group, bytes) = bytes.split_first_chunk()?;
    let (&offset, bytes) = bytes.split_first_chunk()?;
    let (&read_length, data) = bytes.split_first_chunk()?;
    let service = *SERVICES.get(usize::from(service))?;
    Some(Call {
        port: AmsPort(u16::from_le_bytes(port)),
        service,
        index_group: IndexGroup::new(u32::from_le_bytes(group)),
        index_offset: IndexOffset::new(u32::from_le_bytes(offset)),
        read_length: u32::from_le_bytes(read_length),
        // A Read carries none.
        data: if service == Service::Read { &[] } else { data },
    })
}

/// Writes a call so that [`read_call`] reads it.
pub(crate) fn write_call(call: &Call<'_>) -> Vec<u8> {
    let mut bytes = call.port.0.to_le_bytes().to_vec();
    let service = SERVICES.iter().position(|&service| service == call.service);
    bytes.extend(service.and_then(|place| u8::try_from(place).ok()));
    for number in [call.index_group.get(), call.index_offset.get(), call.read_length] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(call.data);
    bytes
}

const SERVICES: [Service; 3] = [Service::Read, Service::Write, Service::ReadWrite];
