//! A simulated CNC whose state the checks can read.

use std::error::Error;
use std::fmt;

use ads_cnc::ads::{AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, FrameRef};
use ads_cnc::operation::{Call, Request};
use ads_cnc::{Decode, Encode as _};
use ads_cnc_conformance::ads_service::decode_reply;
use ads_cnc_conformance::faults::{Faulty, SeededDefect};
use ads_cnc_conformance::simulator::{Cnc, DEFAULT_MODEL, Model, NET_ID, Responder as _, Settings};

/// The reason why a check fails.
pub(crate) struct Failed(pub(crate) String);

impl fmt::Debug for Failed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl<E: Error> From<E> for Failed {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

pub(crate) type CheckResult<T = ()> = Result<T, Failed>;

/// Fails unless the found value is equal to the expected value.
pub(crate) fn same<T: PartialEq + fmt::Debug>(
    what: impl fmt::Display,
    found: T,
    expected: T,
) -> CheckResult {
    if found == expected {
        return Ok(());
    }
    Err(Failed(format!("{what}: expected {expected:02x?}, found {found:02x?}")))
}

/// Fails unless the condition is true.
pub(crate) fn ensure(condition: bool, what: impl fmt::Display) -> CheckResult {
    if condition { Ok(()) } else { Err(Failed(what.to_string())) }
}

/// The data of a successful reply, or the error number.
pub(crate) type Reply = Result<Vec<u8>, AdsError>;

/// A CNC with a stopped clock, optionally with a defect, that receives requests in frames.
pub(crate) struct TestCnc(Faulty);

impl TestCnc {
    pub(crate) fn new(seed: Option<&SeededDefect>) -> Self {
        let edition = seed.and_then(|seed| seed.edition);
        Self::with_settings(seed, Settings { edition, version: None })
    }

    pub(crate) fn with_settings(seed: Option<&SeededDefect>, settings: Settings) -> Self {
        let model = Model::with_settings(DEFAULT_MODEL, "the default model", settings).unwrap();
        Self(Faulty::new(Cnc::new(model).with_stopped_clock(), seed))
    }

    pub(crate) fn cnc(&self) -> &Cnc {
        self.0.cnc()
    }

    /// The numbers of the active channels.
    pub(crate) fn channels(&self) -> Vec<u8> {
        let all = self.cnc().model().profile().channels;
        all.iter().map(|&number| u8::try_from(number).unwrap()).collect()
    }

    pub(crate) fn ask<'a>(&self, request: impl Into<Request<'a>>) -> CheckResult<Reply> {
        let request = request.into();
        let mut data = vec![0; request.encoded_len()];
        self.call(&request.encode(&mut data)?)
    }

    /// The data of a successful reply, decoded as a stream.
    pub(crate) fn read<'a, T>(&self, request: impl Into<Request<'a>>) -> CheckResult<T>
    where
        T: for<'b> Decode<'b>,
    {
        let data = self.ask(request)??;
        Ok(T::decode(&data)?)
    }

    pub(crate) fn call(&self, call: &Call<'_>) -> CheckResult<Reply> {
        let payload = call.encode_to_vec()?;
        let (header, payload) = self.frame(call.port, call.service.command(), &payload)?;
        if !header.error.is_ok() {
            return Ok(Err(header.error));
        }
        let (result, data) = decode_reply(call.service, &payload)?;
        Ok(if result.is_ok() { Ok(data.unwrap_or_default().to_vec()) } else { Err(result) })
    }

    /// Header and data of the reply to a command.
    pub(crate) fn frame(
        &self,
        port: AmsPort,
        command: Command,
        payload: &[u8],
    ) -> CheckResult<(AmsHeader, Vec<u8>)> {
        let source = AmsAddr { net_id: AmsNetId([127, 0, 0, 1, 1, 2]), port: AmsPort(0x8001) };
        let header = AmsHeader::request(AmsAddr { net_id: NET_ID, port }, source, command, 1);
        let mut received = Vec::new();
        self.0.respond(NET_ID, &FrameRef::new(header, payload)?, &mut received);
        let split = FrameRef::split(&received, 0x1_0000)?;
        let (frame, _) = split.ok_or_else(|| Failed("no whole frame".to_owned()))?;
        Ok((frame.header(), frame.data().to_vec()))
    }
}
