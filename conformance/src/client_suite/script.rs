//! The replies of the CNC in a scenario.

use std::collections::BTreeMap;

use ads_cnc::address::Channel;
use ads_cnc::ads::{AdsError, AmsHeader, FrameRef, WriteReply};
use ads_cnc::operation::{Call, Function, HandleByName, Request, WriteByName};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{Decode as _, Encode as _, Handle};

use super::literal::Literal;
use super::tamper::{SendStep, Tamper};
use crate::simulator::{Cnc, DATA_MAX, NET_ID};

/// Number of reads of RESPONSE_STATE after which the simulated service writes its response.
const POLLS: usize = 2;

/// The replies of the CNC in a scenario.
#[derive(Debug)]
pub(super) struct ScenarioScript {
    /// The CNC whose replies the script changes.
    pub(super) cnc: Cnc,
    /// The function whose replies are changed, and the change.
    pub(super) tamper: Option<(Function, Tamper)>,
    /// The writes to the program stream that the script rejects: the number of the write, counted
    /// from 0, and the error.
    pub(super) rejections: Vec<(usize, AdsError)>,
    /// A request printed in the manuals, to which the script replies with the printed bytes.
    pub(super) literal: Option<Literal>,
    /// The response of the simulated service; `None` if no service responds.
    pub(super) response: Option<&'static str>,
    looks: Option<usize>,
    streamed: usize,
    /// The last reply of each connection, if `tamper` is set.
    last: BTreeMap<usize, Vec<u8>>,
}

impl ScenarioScript {
    /// A script that sends the replies of the CNC unchanged.
    pub(super) const fn new(cnc: Cnc) -> Self {
        Self {
            cnc,
            tamper: None,
            rejections: Vec::new(),
            literal: None,
            response: None,
            looks: None,
            streamed: 0,
            last: BTreeMap::new(),
        }
    }

    /// The steps that send the reply to a frame on this connection.
    pub(super) fn answer(
        &mut self,
        connection: usize,
        frame: &[u8],
    ) -> Result<Vec<SendStep>, String> {
        if let Some(literal) = &self.literal
            && let Some(reply) = literal.reply(frame)
        {
            return Ok(vec![SendStep::Send(reply)]);
        }
        let split = FrameRef::split(frame, DATA_MAX).map_err(|error| error.to_string())?;
        let (request, _) = split.ok_or("cut")?;
        let call = Call::from_frame(&request).ok().flatten();
        let dispatched = call.as_ref().and_then(|call| call.dispatch().ok());
        let mut reply = Vec::new();
        match dispatched.as_ref().and_then(|dispatched| self.rejection(dispatched)) {
            Some(error) => reply = write_reply(request.header(), error).unwrap_or_default(),
            None => self.cnc.respond(NET_ID, &request, &mut reply),
        }
        if let Some(dispatched) = &dispatched {
            self.host(dispatched);
        }
        let Some((at, tamper)) = self.tamper else { return Ok(vec![SendStep::Send(reply)]) };
        let before = self.last.insert(connection, reply.clone());
        Ok(match dispatched {
            Some(one) if one.function() == at => tamper.steps(&reply, before.as_deref()),
            _ => vec![SendStep::Send(reply)],
        })
    }

    /// The error with which the script rejects a request; `None` unless the request is a write to
    /// the program stream that must be rejected. Counts these writes.
    fn rejection(&mut self, dispatched: &Request<'_>) -> Option<AdsError> {
        let Request::WriteProgramStream(_) = dispatched else { return None };
        let number = self.streamed;
        self.streamed = number.saturating_add(1);
        self.rejections
            .iter()
            .find(|(rejections, _)| *rejections == number)
            .map(|(_, error)| *error)
    }

    /// Simulates the service: after [`POLLS`] reads of RESPONSE_STATE, it writes the response to
    /// the client's request.
    fn host(&mut self, dispatched: &Request<'_>) {
        let Some(response) = self.response else { return };
        match self.service_variable(dispatched) {
            Some((ServiceVariable::RequestState, Some(state))) => {
                self.looks = state.iter().any(|&byte| byte != 0).then_some(0);
            }
            Some((ServiceVariable::ResponseState, None)) => {
                let Some(looks) = self.looks.as_mut() else { return };
                *looks = looks.saturating_add(1);
                if *looks >= POLLS {
                    self.looks = None;
                    self.write_variable(ServiceVariable::Response, response.as_bytes());
                    self.write_variable(ServiceVariable::RequestState, &[0; 4]);
                    self.write_variable(ServiceVariable::ResponseState, &[1, 0, 0, 0]);
                }
            }
            _ => {}
        }
    }

    /// The variable of the Service Interface that a request reads or writes, by its name or by its
    /// handle in channel 1, and the written value; `None` for a read.
    pub(super) fn service_variable<'a>(
        &self,
        dispatched: &'a Request<'_>,
    ) -> Option<(ServiceVariable, Option<&'a [u8]>)> {
        let by_name = |name: &str| ServiceVariable::by_name(name);
        let by_handle = |handle: Handle| {
            let all = ServiceVariable::ALL.into_iter();
            all.into_iter().find(|one| self.handle(one.name()) == Some(handle))
        };
        match dispatched {
            Request::ReadByName(read) => Some((by_name(&read.name.text().to_string())?, None)),
            Request::WriteByName(write) => {
                Some((by_name(&write.name.to_string())?, Some(write.value.as_bytes())))
            }
            Request::ReadByHandle(read) => Some((by_handle(read.handle)?, None)),
            Request::WriteByHandle(write) => {
                Some((by_handle(write.handle)?, Some(write.value.as_bytes())))
            }
            _ => None,
        }
    }

    fn handle(&self, name: &str) -> Option<Handle> {
        let dispatched = HandleByName::new(Channel::new(1).ok()?, name).ok()?;
        Handle::decode(&self.ask(dispatched)?).ok()
    }

    /// Writes a variable of the Service Interface of channel 1 as the partner of the client.
    pub(super) fn write_variable(&self, variable: ServiceVariable, value: &[u8]) {
        let write = Channel::new(1)
            .ok()
            .and_then(|channel| WriteByName::new(channel, variable.name(), value).ok());
        let _written = write.and_then(|write| self.ask(write));
    }

    /// The unchanged reply of the CNC to a request; `None` if the CNC rejects the request.
    pub(super) fn ask<'a>(&self, request: impl Into<Request<'a>>) -> Option<Vec<u8>> {
        let request = request.into();
        let mut buf = vec![0; request.encoded_len()];
        let call = request.encode(&mut buf).ok()?;
        self.cnc.answer(&call).ok()
    }
}

/// A Write reply with an error that the script returns instead of the simulated CNC.
fn write_reply(dispatched: AmsHeader, result: AdsError) -> Option<Vec<u8>> {
    let data = WriteReply { result }.encode_to_vec().ok()?;
    FrameRef::new(dispatched.response(), &data).ok()?.encode_to_vec().ok()
}
