//! Device information, and error numbers.

use ads_cnc::Decode as _;
use ads_cnc::Kind;
use ads_cnc::address::{Channel, IndexOffset};
use ads_cnc::ads::{AdsError, AdsState, AmsPort, Command, DeviceInfoReply, DeviceStateReply};
use ads_cnc::operation::{Call, CountObjects, CountVariables, Request, WriteByName};

use crate::checks::checks;
use crate::target::{Check, Target, same};

checks! {
    each_task_has_the_information_of_the_program,
    errors_have_their_numbers,
}

fn each_task_has_the_information_of_the_program(target: &Target) -> Check {
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

/// In the frame they are those that the CNC answers with.
fn errors_have_their_numbers(target: &Target) -> Check {
    let channel = Channel::new(1)?;
    let requests: [Request<'_>; 3] = [
        CountObjects::new(channel).into(),
        WriteByName::new(channel, "V.E.nobody_has_this", &[0; 4][..])?.into(),
        CountVariables::new(channel, Kind::V_E).into(),
    ];
    for request in requests {
        let mut data = vec![0; request.encoded_len()];
        let call = request.encode(&mut data)?;
        // An object, a variable or a function that does not exist.
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
