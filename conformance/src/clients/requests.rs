//! Judges each request of a client: whether the CNC has such a function, and its headers.

use std::fmt;

use ads_cnc::Error;
use ads_cnc::ads::{AdsError, AmsPort, Command, FrameRef, StateFlags};
use ads_cnc::operation::{Call, DispatchError, Effect, Function, Request, Task};

use super::findings::Findings;
use super::test_server::Turn;
use crate::judge::{CLIENT, assumed};
use crate::simulator::{DATA_MAX, NET_ID};
use crate::wire_service::{self, service_of};

/// Connection and invoke ID of the previous request.
pub(super) type Before = Option<(usize, Option<Vec<u8>>)>;

/// Judges each request, and its invoke ID together with that of the previous request.
pub(super) fn judge(turns: &[Turn], before: &mut Before, findings: &mut Findings) {
    for turn in turns {
        one(turn, findings);
        let id = turn.request.get(34..38).map(<[u8]>::to_vec);
        if let Some((_, last)) = before.take().filter(|(of, _)| *of == turn.connection) {
            // With a constant invoke ID a client cannot detect a late reply.
            let kept = last.is_none() || last != id;
            let expected = "another invoke ID than that of the request before";
            findings.check(assumed("ADS-5"), kept, Some(turn), expected, "the same");
        }
        *before = Some((turn.connection, id));
    }
}

fn one(turn: &Turn, findings: &mut Findings) {
    let frame = match FrameRef::split(&turn.request, DATA_MAX) {
        Ok(Some((frame, _))) => frame,
        Ok(None) => {
            let found = || format!("{} bytes of a frame, and no more", turn.request.len());
            findings.check("ADS-5", false, Some(turn), "a whole frame", found);
            return;
        }
        Err(error) => {
            findings.check("ADS-5", false, Some(turn), "a frame", error);
            return;
        }
    };
    let header = frame.header();
    let mut check = |kept: bool, expected: &str, found: fmt::Arguments<'_>| {
        findings.check("ADS-5", kept, Some(turn), expected, found);
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
    findings.check("GEN-4", has_task, Some(turn), "port 551, 552 or 553", || port);
    let service = service_of(header.command).map(wire_service::clause);
    match Call::from_frame(&frame) {
        Err(error) => {
            let expected = || format!("a request of {}", name(header.command));
            findings.check(service.unwrap_or(CLIENT), false, Some(turn), expected, error);
        }
        Ok(None) => {
            let harmless = [Command::READ_DEVICE_INFO, Command::READ_STATE];
            let expected = "Read, Write, ReadWrite, ReadDeviceInfo or ReadState";
            let kept = harmless.contains(&header.command);
            findings.check(CLIENT, kept, Some(turn), expected, || name(header.command));
        }
        Ok(Some(call)) => {
            findings.check(service.unwrap_or(CLIENT), true, Some(turn), "", "");
            if !has_task {
                return;
            }
            match call.dispatch() {
                Ok(request) => {
                    findings.check(request.function().spec().clause, true, Some(turn), "", "");
                }
                Err(refusal) => {
                    let rule = clause(&call, refusal);
                    findings
                        .check(rule, false, Some(turn), "a request that a CNC knows", || refusal);
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
pub(super) fn clause(call: &Call<'_>, refusal: DispatchError) -> &'static str {
    match refusal {
        DispatchError::Port(_) => "GEN-4",
        DispatchError::Group(_) => {
            let other = match call.port {
                AmsPort::COM => AmsPort::SDA,
                _ => AmsPort::COM,
            };
            let elsewhere = Call { port: other, ..*call }.dispatch();
            match (elsewhere, call.port) {
                // The request would be valid for another task.
                (Ok(_) | Err(DispatchError::Stream(_) | DispatchError::Service { .. }), _) => {
                    "GEN-4"
                }
                (_, AmsPort::COM) => "ADR-3",
                _ => "ADR-5",
            }
        }
        DispatchError::Offset(_) => match call.port {
            AmsPort::COM => "COM-5",
            _ => "SDA-4",
        },
        DispatchError::Service { .. } => at(call).unwrap_or("ADS-4"),
        DispatchError::Stream(error) => of_field(&error).or_else(|| at(call)).unwrap_or("ADS-4"),
        _ => CLIENT,
    }
}

fn of_field(error: &Error) -> Option<&'static str> {
    error.field().spec().map(|spec| spec.clause)
}

/// The requirement of the function at an address.
fn at(call: &Call<'_>) -> Option<&'static str> {
    let group = call.index_group.parts()?;
    let here = Function::ALL.iter().map(|function| function.spec()).find(|spec| {
        !spec.is_content() && spec.group.contains(group) && spec.offset.contains(call.index_offset)
    });
    here.map(|spec| spec.clause)
}

/// Calls a function with the decoded request of an exchange, if it is one.
pub(super) fn with_request<T>(turn: &Turn, then: impl FnOnce(&Request<'_>) -> T) -> Option<T> {
    let (frame, _) = FrameRef::split(&turn.request, DATA_MAX).ok()??;
    let request = Call::from_frame(&frame).ok()??.dispatch().ok()?;
    Some(then(&request))
}

/// The function of a request that changes the state of the CNC.
pub(super) fn writes(turn: &Turn) -> Option<&'static str> {
    with_request(turn, |request| {
        let spec = request.function().spec();
        (spec.effect != Effect::Query).then_some(spec.clause)
    })?
}
