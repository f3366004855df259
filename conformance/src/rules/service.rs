//! The variables of the Service Interface: sizes and order of access.

use ads_cnc::limits::SERVICE_TEXT_MAX;
use ads_cnc::operation::{Reply, Request};
use ads_cnc::service::ServiceVariable;
use ads_cnc_vectors::ids::*;

use super::knowledge::{ExchangeJudge, ObservedInterface};
use super::requests::name_of;
use super::topic::{Topic, TopicRecord};
use crate::judge::{Checks as _, assumed};
use crate::text::plural;

impl ExchangeJudge<'_> {
    pub(super) fn service(&mut self, request: &Request<'_>, reply: Option<&Reply<'_>>) {
        let group = self.call.index_group.get();
        let handle = match request {
            Request::ReadByHandle(read) => Some(read.handle.0),
            Request::WriteByHandle(write) => Some(write.handle.0),
            _ => None,
        };
        let by_handle = handle.and_then(|handle| self.cnc.variables.name_of(group, handle));
        let name = by_handle.map(str::to_owned);
        let name =
            name.or_else(|| name_of(request.function(), self.call).map(|name| name.to_string()));
        let variable = name.as_deref().and_then(ServiceVariable::by_name);
        let (Some(variable), Some(reply)) = (variable, reply) else { return };
        let written = match request {
            Request::WriteByHandle(write) => Some(write.value.as_bytes()),
            Request::WriteByName(write) => Some(write.value.as_bytes()),
            Request::ReadByHandle(_) | Request::ReadByName(_) => None,
            _ => return,
        };
        let is_lost = self.cnc.is_lost;
        let new = || ObservedInterface { is_lost, ..ObservedInterface::default() };
        let interface = self.cnc.services.entry(group).or_insert_with(new);
        match (written, reply) {
            (Some(value), _) => {
                let mut record = self.records.on(Topic::ClientService, self.observation);
                form(&mut record, variable, value);
                interface.write(&mut record, variable, value);
            }
            (None, Reply::Value(value)) => {
                let mut record = self.records.on(Topic::CncService, self.observation);
                form(&mut record, variable, value.bytes);
                interface.read(&mut record, variable, value.bytes);
            }
            _ => {}
        }
    }
}

/// Checks the size of a value: REQUEST and RESPONSE have at most 128 bytes, a state has 4 bytes.
/// The size of UUID is not checked.
fn form(record: &mut TopicRecord<'_>, variable: ServiceVariable, value: &[u8]) {
    let length = value.len();
    let found = || format!("{} of {}", plural(length, "byte"), variable.name());
    match variable {
        ServiceVariable::RequestState | ServiceVariable::ResponseState => {
            record.check(SVC_1, length == 4, "an UNS32", found);
        }
        ServiceVariable::Uuid => {}
        _ => {
            record.check(SVC_1, length <= SERVICE_TEXT_MAX, "at most 128 bytes", found);
        }
    }
}

fn is_set(value: &[u8]) -> bool {
    value.iter().any(|byte| *byte != 0)
}

impl ObservedInterface {
    fn read(&mut self, record: &mut TopicRecord<'_>, variable: ServiceVariable, value: &[u8]) {
        match variable {
            ServiceVariable::RequestState => {
                if is_set(value) && self.answered {
                    // The previous request is answered, so this is a new request.
                    *self = Self::default();
                }
                self.read_state = is_set(value);
            }
            ServiceVariable::Uuid => self.read_id = true,
            // The service may have answered already, so a value other than 0 proves nothing.
            ServiceVariable::ResponseState if self.has_request && !is_set(value) => {
                record.pass(assumed(SVC_3));
            }
            _ => {}
        }
    }

    fn write(&mut self, record: &mut TopicRecord<'_>, variable: ServiceVariable, value: &[u8]) {
        match variable {
            ServiceVariable::Uuid => self.wrote_id = true,
            ServiceVariable::Request => self.wrote_request = true,
            ServiceVariable::RequestState if is_set(value) => {
                // The client acts as the NC program.
                let found = "REQUEST_STATE before UUID and REQUEST";
                let passed = self.is_lost || self.wrote_id && self.wrote_request;
                record.check(SVC_12, passed, "UUID and REQUEST before REQUEST_STATE", found);
                *self = Self { has_request: true, ..Self::default() };
            }
            ServiceVariable::RequestState => {
                let found = "REQUEST_STATE after RESPONSE_STATE, which it resets";
                record.check(
                    assumed(SVC_4),
                    !self.answered,
                    "RESPONSE_STATE as the last write",
                    found,
                );
                self.reset = true;
            }
            ServiceVariable::Response => self.response = true,
            ServiceVariable::ResponseState => {
                self.has_request = false;
                let found = "RESPONSE_STATE = 0, for which the program waits forever";
                record.check(SVC_5, is_set(value), "a number other than 0", found);
                if !is_set(value) {
                    return;
                }
                let found = "RESPONSE_STATE before RESPONSE";
                let passed = self.is_lost || self.response;
                record.check(SVC_5, passed, "RESPONSE before RESPONSE_STATE", found);
                let found = "a response to a request that was not read";
                let passed = self.is_lost || self.read_state && self.read_id;
                record.check(
                    SVC_2,
                    passed,
                    "UUID and REQUEST_STATE read before the response",
                    found,
                );
                self.answered = true;
            }
        }
    }
}
