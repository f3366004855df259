//! Judges a request alone.

use ads_cnc::ads::{AdsError, AmsHeader, AmsPort, StateFlags};
use ads_cnc::layout::Stream;
use ads_cnc::operation::{AdsService, Call, DispatchError, Function, Request};
use ads_cnc::{CncStr, ErrorKind, VariablePath};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::requirement;

use super::observation::Observation;
use super::topic::{Topic, TopicRecords};
use crate::ads_service;
use crate::judge::{Checks as _, Rule, assumed, online};
use crate::text::plural;
use crate::values::until_nul;

impl TopicRecords {
    /// Judges the AMS header of a request. `is_repeated`: whether an earlier request, which may
    /// still be without a reply, has the same invoke ID; `None` if unknown.
    pub(crate) fn request_headers(
        &mut self,
        observation: &dyn Observation,
        header: &AmsHeader,
        is_repeated: Option<bool>,
    ) {
        let mut record = self.on(Topic::ClientFrames, observation);
        let flags = header.state_flags;
        let found = || format!("state flags {:#06x}", flags.0);
        record.check(ADS_5, flags == StateFlags::REQUEST, "state flags 0x0004", found);
        let is_free = header.error == AdsError::NO_ERROR;
        let found = || format!("AMS error {:#x}", header.error);
        record.check(ADS_5, is_free, "no AMS error in a request", found);
        if let Some(is_repeated) = is_repeated {
            let found =
                || format!("the invoke ID {:#x} of a request without a reply", header.invoke_id);
            let expected = "an invoke ID that no pending request has";
            record.check(assumed(ADS_5), !is_repeated, expected, found);
        }
    }

    /// Judges a request. Returns its service and address as text if it is not judged, because no
    /// function is found for it or because it may access content at this address (SDA-12).
    pub(crate) fn request(
        &mut self,
        observation: &dyn Observation,
        call: &Call<'_>,
    ) -> Option<String> {
        match call.dispatch() {
            Ok(request) => {
                self.on(Topic::ClientPorts, observation).pass(port_rule(call.port));
                documented(self, observation, call, &request);
                None
            }
            Err(DispatchError::Stream(error)) => {
                if let Some(function) = function_at(call) {
                    let spec = function.spec();
                    let clause = error.field().spec().map(|spec| spec.clause);
                    let known = clause.filter(|id| requirement(id).is_some());
                    let rule = match error.kind() {
                        ErrorKind::TooMany => VAR_24.into(),
                        ErrorKind::TooLong if function == Function::WriteProgramStream => {
                            STM_2.into()
                        }
                        // The read length is too small for the reply. The required read length is
                        // assumed.
                        ErrorKind::BufferTooSmall => assumed(COM_3),
                        _ => Rule::of(known.unwrap_or(spec.clause)),
                    };
                    let expected = || format!("the request of {:?}", spec.name);
                    self.on(Topic::of_request(function), observation)
                        .check(rule, false, expected, error);
                }
                None
            }
            Err(rejection) => {
                let other = if call.port == AmsPort::COM { AmsPort::SDA } else { AmsPort::COM };
                let elsewhere = Call { port: other, ..*call };
                let is_elsewhere = match elsewhere.dispatch() {
                    Ok(_) => true,
                    Err(DispatchError::Stream(_) | DispatchError::Service { .. }) => {
                        matches!(rejection, DispatchError::Group(_))
                    }
                    Err(_) => false,
                };
                if let Some(function) = function_at(&elsewhere).filter(|_| is_elsewhere) {
                    let spec = function.spec();
                    let expected = || format!("port {} for {}", spec.task.port(), spec.name);
                    let mut record = self.on(Topic::ClientPorts, observation);
                    record
                        .check(port_rule(other), false, expected, || format!("port {}", call.port));
                    return None;
                }
                if matches!(rejection, DispatchError::Service { .. }) {
                    return wrong_service(self, observation, call, rejection);
                }
                let Call { port, service, index_group, index_offset, .. } = call;
                Some(format!("{service} {index_group}, {index_offset} at {port}"))
            }
        }
    }
}

/// The rule for the port of a task. The sample programs of the manuals use the port of COM; the
/// ports of SDA and GEO are documented online.
fn port_rule(port: AmsPort) -> Rule {
    if port == AmsPort::COM { GEN_4.into() } else { online(GEN_4) }
}

/// The function at the index group and index offset of a call, whatever the port of the call.
/// Access to content must have the service of the call; other functions may have any service, and
/// take precedence.
pub(crate) fn function_at(call: &Call<'_>) -> Option<Function> {
    let group = call.index_group.parts()?;
    let mut all = Function::ALL.iter().copied().filter(|function| {
        let spec = function.spec();
        spec.group.contains(group) && spec.offset.contains(call.index_offset)
    });
    // A function takes precedence over content at the same address (SDA-12).
    let first = all.clone().find(|function| !function.spec().is_content());
    first.or_else(|| all.find(|function| function.spec().service == call.service))
}

/// Judges a call of a function by the wrong service. A Read, or any call at the address of data
/// streaming, may instead access content whose address is also that of a function (SDA-12). Such a
/// call is not judged; its service and address are returned as text.
fn wrong_service(
    records: &mut TopicRecords,
    observation: &dyn Observation,
    call: &Call<'_>,
    rejection: DispatchError,
) -> Option<String> {
    let function = function_at(call)?;
    let spec = function.spec();
    let content = call.service == AdsService::Read || function == Function::WriteProgramStream;
    if content {
        let Call { port, service, index_group, index_offset, .. } = call;
        return Some(format!("{service} {index_group}, {index_offset} at {port}"));
    }
    let mut record = records.on(Topic::of_request(function), observation);
    record.check(
        Rule::of(spec.clause),
        false,
        || format!("{} for {}", spec.service, spec.name),
        || rejection,
    );
    None
}

/// Judges a request that the codec decodes.
fn documented(
    records: &mut TopicRecords,
    observation: &dyn Observation,
    call: &Call<'_>,
    request: &Request<'_>,
) {
    let function = request.function();
    let spec = function.spec();
    let case = Topic::of_request(function);
    let mut record = records.on(case, observation);
    record.pass(Rule::of(spec.clause));
    if let Some(clause) = spec.request.map(|stream| stream.layout().clause)
        && requirement(clause).is_some()
    {
        record.pass(Rule::of(clause));
    }
    if let Request::DynamicValueByName(request) = request {
        let ended = request.name.tail().is_some();
        record.check(assumed(DYN_3), ended, "a name with a NUL", "a name without a NUL");
    }
    if let Request::ReadByHandle(_) | Request::WriteByHandle(_) = request {
        record.pass(VAR_24);
    }
    if let Some(reply) = spec.reply.filter(|reply| reply.layout().is_fixed()) {
        let least = reply.layout().max;
        let rule = assumed(ads_service::clause(call.service));
        let asked = call.read_length;
        let mut record = records.on(Topic::ClientServices, observation);
        let expected = || {
            format!("a read length of at least {}, the length of the reply", plural(least, "byte"))
        };
        let found = || format!("a read length of {asked} bytes");
        record.check(rule, asked >= least, expected, found);
    }
    let mut record = records.on(case, observation);
    if let Some(name) = name_of(function, call) {
        let path = VariablePath::from_text(name);
        let found = path.err().map(|error| format!("{name}: {error}")).unwrap_or_default();
        record.check(
            assumed(VAR_20),
            found.is_empty(),
            "a name with the structure that the manual describes",
            found,
        );
    }
}

/// The name of a variable in a request of this function.
pub(super) fn name_of<'a>(function: Function, call: &Call<'a>) -> Option<CncStr<'a>> {
    match function.spec().request {
        Some(Stream::VariableName | Stream::VariableNameWrite) => {
            CncStr::from_bytes(until_nul(call.data)).ok()
        }
        _ => None,
    }
}
