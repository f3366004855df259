//! Judges each request of a client: whether the CNC has such a function, and its headers.

use std::fmt;

use ads_cnc::Error;
use ads_cnc::ads::{AdsError, AmsPort, Command, FrameRef, StateFlags};
use ads_cnc::operation::{Call, DispatchError, Effect, Function, Request, Task};
use ads_cnc_vectors::ids::*;

use super::findings::Findings;
use super::test_server::RecordedExchange;
use crate::judge::{Rule, assumed};
use crate::simulator::{DATA_MAX, NET_ID};
use crate::wire_service::{self, service_of};

/// Connection and invoke ID of the previous request.
pub(super) type PreviousRequest = Option<(usize, Option<Vec<u8>>)>;

/// Judges each request, and its invoke ID together with that of the previous request.
pub(super) fn judge(
    exchanges: &[RecordedExchange],
    before: &mut PreviousRequest,
    findings: &mut Findings,
) {
    for exchange in exchanges {
        one(exchange, findings);
        let id = exchange.request.get(34..38).map(<[u8]>::to_vec);
        if let Some((_, last)) = before.take().filter(|(of, _)| *of == exchange.connection) {
            // With a constant invoke ID a client cannot detect a late reply.
            let passed = last.is_none() || last != id;
            let expected = "another invoke ID than that of the request before";
            findings.check(assumed(ADS_5), passed, Some(exchange), expected, "the same");
        }
        *before = Some((exchange.connection, id));
    }
}

fn one(exchange: &RecordedExchange, findings: &mut Findings) {
    let frame = match FrameRef::split(&exchange.request, DATA_MAX) {
        Ok(Some((frame, _))) => frame,
        Ok(None) => {
            let found = || format!("{} bytes of a frame, and no more", exchange.request.len());
            findings.check(ADS_5, false, Some(exchange), "a whole frame", found);
            return;
        }
        Err(error) => {
            findings.check(ADS_5, false, Some(exchange), "a frame", error);
            return;
        }
    };
    let header = frame.header();
    let mut check = |passed: bool, expected: &str, found: fmt::Arguments<'_>| {
        findings.check(ADS_5, passed, Some(exchange), expected, found);
    };
    let flags = header.state_flags;
    check(flags == StateFlags::REQUEST, "state flags 0x0004", format_args!("{:#06x}", flags.0));
    let error = header.error;
    check(error == AdsError::NO_ERROR, "error 0", format_args!("{error:#x}"));
    let net_id = header.target.net_id;
    check(net_id == NET_ID, "the NetId it was told", format_args!("{net_id}"));
    let command = header.command.0;
    check((1..=9).contains(&command), "a command from 1 to 9", format_args!("{command}"));
    let port = header.target.port;
    let has_task = Task::from_port(port).is_some();
    findings.check(GEN_4, has_task, Some(exchange), "port 551, 552 or 553", || port);
    let service = service_of(header.command).map(wire_service::clause);
    let service = service.map_or(Rule::CLIENT, Rule::from);
    match Call::from_frame(&frame) {
        Err(error) => {
            let expected = || format!("a request of {}", name(header.command));
            findings.check(service, false, Some(exchange), expected, error);
        }
        Ok(None) => {
            let harmless = [Command::READ_DEVICE_INFO, Command::READ_STATE];
            let expected = "Read, Write, ReadWrite, ReadDeviceInfo or ReadState";
            let passed = harmless.contains(&header.command);
            findings.check(Rule::CLIENT, passed, Some(exchange), expected, || name(header.command));
        }
        Ok(Some(call)) => {
            findings.check(service, true, Some(exchange), "", "");
            if !has_task {
                return;
            }
            match call.dispatch() {
                Ok(request) => {
                    let rule = Rule::of(request.function().spec().clause);
                    findings.check(rule, true, Some(exchange), "", "");
                }
                Err(refusal) => {
                    let rule = clause(&call, refusal);
                    findings.check(
                        rule,
                        false,
                        Some(exchange),
                        "a request that a CNC knows",
                        || refusal,
                    );
                }
            }
        }
    }
}

fn name(command: Command) -> String {
    match service_of(command) {
        Some(service) => service.to_string(),
        None => format!("command {}", command.0),
    }
}

/// The requirement that is broken by a request without a function.
pub(super) fn clause(call: &Call<'_>, refusal: DispatchError) -> Rule {
    match refusal {
        DispatchError::Port(_) => GEN_4.into(),
        DispatchError::Group(_) => {
            let other = match call.port {
                AmsPort::COM => AmsPort::SDA,
                _ => AmsPort::COM,
            };
            let elsewhere = Call { port: other, ..*call }.dispatch();
            match (elsewhere, call.port) {
                // The request would be valid for another task.
                (Ok(_) | Err(DispatchError::Stream(_) | DispatchError::Service { .. }), _) => {
                    GEN_4.into()
                }
                (_, AmsPort::COM) => ADR_3.into(),
                _ => ADR_5.into(),
            }
        }
        DispatchError::Offset(_) => match call.port {
            AmsPort::COM => COM_5.into(),
            _ => SDA_4.into(),
        },
        DispatchError::Service { .. } => at(call).unwrap_or(ADS_4.into()),
        DispatchError::Stream(error) => {
            of_field(&error).or_else(|| at(call)).unwrap_or(ADS_4.into())
        }
        _ => Rule::CLIENT,
    }
}

fn of_field(error: &Error) -> Option<Rule> {
    error.field().spec().map(|spec| Rule::of(spec.clause))
}

/// The requirement of the function at an address.
fn at(call: &Call<'_>) -> Option<Rule> {
    let group = call.index_group.parts()?;
    let here = Function::ALL.iter().map(|function| function.spec()).find(|spec| {
        !spec.is_content() && spec.group.contains(group) && spec.offset.contains(call.index_offset)
    });
    here.map(|spec| Rule::of(spec.clause))
}

/// Calls a function with the decoded request of an exchange, if it is one.
pub(super) fn with_request<T>(
    exchange: &RecordedExchange,
    then: impl FnOnce(&Request<'_>) -> T,
) -> Option<T> {
    let (frame, _) = FrameRef::split(&exchange.request, DATA_MAX).ok()??;
    let request = Call::from_frame(&frame).ok()??.dispatch().ok()?;
    Some(then(&request))
}

/// The function of a request that changes the state of the CNC.
pub(super) fn writes(exchange: &RecordedExchange) -> Option<Rule> {
    with_request(exchange, |request| {
        let spec = request.function().spec();
        (spec.effect != Effect::Query).then(|| Rule::of(spec.clause))
    })?
}
