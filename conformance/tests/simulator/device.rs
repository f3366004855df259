//! Checks of device information, of error numbers, and of the replies to queries of various
//! functions.

use ads_cnc::Decode as _;
use ads_cnc::Kind;
use ads_cnc::address::{Channel, IndexGroup, IndexOffset};
use ads_cnc::ads::{AdsError, AdsState, AmsPort, Command, DeviceInfoReply, DeviceStateReply};
use ads_cnc::operation::{
    AdsService, Call, CountObjects, CountVariables, HandleByName, Request, WriteByName,
};

use crate::checks::checks;
use crate::target::{CheckResult, TestCnc, same};

checks! {
    each_task_has_the_information_of_the_program,
    errors_have_their_numbers,
    each_query_has_its_own_answer,
}

fn each_task_has_the_information_of_the_program(target: &TestCnc) -> CheckResult {
    for port in [AmsPort::COM, AmsPort::SDA, AmsPort::GEO] {
        let (_, data) = target.frame(port, Command::READ_DEVICE_INFO, &[])?;
        let info = DeviceInfoReply::decode(&data)?;
        let version = format!("{}.{}.{}", info.major, info.minor, info.build);
        same("the version", &*version, env!("CARGO_PKG_VERSION"))?;
        same("the name", info.name, *b"ads-cnc serve\0\0\0")?;
        let (_, data) = target.frame(port, Command::READ_STATE, &[])?;
        let state = DeviceStateReply::decode(&data)?;
        same("the state", (state.ads_state, state.device_state), (AdsState::RUN, 0))?;
    }
    Ok(())
}

/// The error numbers in response frames are those that [`Cnc::answer`] returns.
fn errors_have_their_numbers(target: &TestCnc) -> CheckResult {
    let channel = Channel::new(1)?;
    let requests: [Request<'_>; 3] = [
        CountObjects::new(channel).into(),
        WriteByName::new(channel, "V.E.nobody_has_this", &[0; 4][..])?.into(),
        CountVariables::new(channel, Kind::V_E).into(),
    ];
    for request in requests {
        let mut data = vec![0; request.encoded_len()];
        let call = request.encode(&mut data)?;
        // Requests an object, a variable or a function that does not exist.
        let call = match request {
            Request::WriteByName(_) => call,
            _ => Call { index_offset: IndexOffset::new(0xFFFF), ..call },
        };
        same("the error number", target.call(&call)?, target.cnc().answer(&call))?;
        if let Request::CountVariables(_) = request {
            let elsewhere = Call { port: AmsPort(1), ..call };
            let error = Err(AdsError::TARGET_PORT_NOT_FOUND);
            same("the error of a port without a task", target.call(&elsewhere)?, error)?;
        }
    }
    Ok(())
}

/// Queries, most of them of channel 6, which has the rank 3; some of them of channel 2 or of no
/// channel.
#[rustfmt::skip]
const QUERIES: [(AdsService, u32, u32, &[u8]); 18] = [
    (AdsService::Read, 0x13_0106, 0, b""),
    (AdsService::Read, 0x13_0106, 1, b""),
    (AdsService::Read, 0x12_0106, 1, b""),
    (AdsService::ReadWrite, 0x12_2306, 0x44, b"V.E\0"),
    (AdsService::ReadWrite, 0x12_2306, 0x45, b"\0\0\0\0V.E\0"),
    (AdsService::ReadWrite, 0x12_2306, 0x46, b"V.E.array\0"),
    (AdsService::ReadWrite, 0x12_2306, 0x48, b"V.E.array[1]\0"),
    (AdsService::ReadWrite, 0x12_2306, 0x4B, b"\0\0\0\0V.E\0"),
    (AdsService::ReadWrite, 0x12_2306, 0x4C, b"V.E.array\0"),
    (AdsService::ReadWrite, 0x12_2306, 0x1_0004, b"V.A.ACT_POS\0"),
    (AdsService::ReadWrite, 0x12_2306, 0x1_0005, b"V.A.ACT_POS\0"),
    (AdsService::Read, 0x12_2306, 0x02, b""),
    (AdsService::ReadWrite, 0x12_2302, 0x1B, b"\x01\0\0\0"),
    (AdsService::ReadWrite, 0x12_2302, 0x1C, b"P1\0"),
    (AdsService::ReadWrite, 0x12_2302, 0x1D, b"\x01\0\0\0"),
    (AdsService::ReadWrite, 0x12_2900, 0, b"\x06\0\0\0\0\0\0\0"),
    (AdsService::Read, 0x12_3306, 0, b""),
    (AdsService::Read, 0x12_3306, 1, b""),
];

/// The CNC replies to each query as [`Cnc::answer`] does without a defect: by number and by rank, for an
/// unknown channel, axis, index and name, and with a short read length.
fn each_query_has_its_own_answer(target: &TestCnc) -> CheckResult {
    let attributes =
        (0x12_3406..=0x12_3806).step_by(0x100).map(|group| (AdsService::Read, group, 1, &b""[..]));
    let handle = Request::from(HandleByName::new(Channel::new(6)?, "V.E.array")?);
    let by_handle = [&target.ask(handle)??[..], &[1, 0, 0, 0, 1, 0, 0, 0]].concat();
    let by_handle = (AdsService::ReadWrite, 0x12_2306, 0x47, &by_handle[..]);
    for (service, group, offset, data) in QUERIES.into_iter().chain(attributes).chain([by_handle]) {
        let port = if group & 0x0F00 < 0x300 { AmsPort::COM } else { AmsPort::SDA };
        let mut other = data.to_vec();
        other.iter_mut().take(1).for_each(|byte| *byte ^= 0x80);
        let groups = [group, group - 0x10_0003, group - 0x10_0000, group + 0x40];
        let in_groups = groups.map(|group| (group, offset, data));
        let elsewhere = [(group, offset + 0x64_0000, data), (group, offset, &other[..])];
        for (group, offset, data) in in_groups.into_iter().chain(elsewhere) {
            let (index_group, index_offset) = (IndexGroup::new(group), IndexOffset::new(offset));
            for read_length in [252, 1] {
                let call = Call { port, service, index_group, index_offset, read_length, data };
                same(format!("{call:?}"), target.call(&call)?, target.cnc().answer(&call))?;
            }
        }
    }
    Ok(())
}
