//! Cases of the Service Interface: its variables, and the effects of writes to them.

mod aliases;
mod interface;
mod program;
mod variables;

use ads_cnc::VariableType;
use ads_cnc::address::Channel;
use ads_cnc::operation::{HandleByName, ReadByName, WriteByName};
use ads_cnc::service::ServiceVariable;
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use self::interface::{NONE, ONE, WIDE, read_variable, within, write_variable};
use crate::edition::Feature;
use crate::judge::{Checks as _, Needs, Rule, Step, Stop, assumed};
use crate::objects::ValueAddress;
use crate::suite::kit::{Probe, WriteCheck, service_channels};
use crate::suite::row::{CaseRow, case};
use crate::values::until_nul;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("service-variables", &[SVC_1, SVC_11], Needs::Queries, variables,
        "A channel with the interface has its five variables, and in them what they hold"),
    case("service-response", &[SVC_1, SVC_3, SVC_4], Needs::Writes, response,
        "A service writes its response and its state, and a request's state takes it back"),
    case("service-longest", &[SVC_1], Needs::Simulator, variables::longest,
        "REQUEST and RESPONSE hold 128 bytes, and no more"),
    case("service-texts", &[SVC_1], Needs::Simulator, variables::texts,
        "A text of any length and of any characters is read as it was written"),
    case("service-variables-apart", &[SVC_1, SVC_3], Needs::Simulator, variables::apart,
        "Each of the variables is its own, by name and by handle"),
    case("service-texts-by-handle", &[SVC_1], Needs::Simulator, aliases::by_handle,
        "A text of any length is written and read by its handle as by its name"),
    case("service-channels-apart", &[SVC_1, SVC_4], Needs::Simulator, aliases::channels_apart,
        "What is answered in one channel changes nothing that is asked in another"),
    case("service-asked-by-a-program", &[SVC_3, SVC_4], Needs::Simulator, request_states,
        "When a program writes REQUEST_STATE, the interface takes the last answer back"),
    case("service-asks-last", &[SVC_12], Needs::Simulator, program::asks_last,
        "A program writes REQUEST_STATE when UUID and REQUEST are there, and not before"),
    case("service-square-root", &[SVC_4, SVC_6, SVC_8, SVC_9, SVC_12],
        Needs::Simulator, program::square_root,
        "A program asks for square roots, waits, and has the answers of the service"),
];

fn variables(probe: &mut Probe<'_>) -> Step {
    let version = probe.target.profile.cnc_version;
    let since = version.map(|version| version.has(Feature::ServiceInterface));
    let of_version = since
        .filter(|answer| answer.available)
        .map(|answer| if answer.assumed { assumed(SVC_11) } else { SVC_11.into() });
    for channel in service_channels(probe)? {
        let described = probe.variables(channel)?;
        for variable in ServiceVariable::ALL {
            let name = variable.name();
            let mut rules: Vec<Rule> = vec![SVC_1.into()];
            rules.extend(of_version);
            let request = ReadByName::new(channel, name)?;
            let value = probe.ask(&rules, request)?;
            probe.ask(&rules, HandleByName::new(channel, name)?)?;
            let found = || format!("{} bytes of {name}", value.len());
            if variable.var_type() == VariableType::UNS32 {
                probe.check(SVC_1, value.len() == 4, "a state of 4 bytes", found);
            } else {
                let fits = !value.is_empty() && value.len() <= 128;
                probe.check(SVC_1, fits, "a text of at most 128 bytes", found);
            }
            let own = described.iter().find(|one| one.name.text.as_cnc_str() == name);
            let Some(own) = own else { continue };
            let found = || format!("{:?} of {name}", own.var_type);
            let expected = || format!("{:?}", variable.var_type());
            probe.check(SVC_1, own.var_type == variable.var_type(), expected, found);
        }
    }
    Ok(())
}

fn response(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{RequestState, Response, ResponseState};
    let may = |probe: &mut Probe<'_>, channel: Channel| -> Step<bool> {
        probe.may(WriteByName::new(channel, Response.name(), &b"\0"[..])?)
    };
    for channel in service_channels(probe)? {
        if !may(probe, channel)? {
            continue;
        }
        if read_variable(probe, channel, RequestState)? != NONE {
            return Err(Stop::inconclusive("a program is asking a service: it is left alone"));
        }
        let before = (
            read_variable(probe, channel, Response)?,
            read_variable(probe, channel, ResponseState)?,
        );
        if before.0.is_empty() || before.1.is_empty() {
            return Err(Stop::inconclusive(
                "the response could not be read, so it could not be restored",
            ));
        }
        // The response is restored before the state, which tells a program that there is a
        // response.
        with_restoring(probe, (channel, ResponseState, &before.1), |probe| {
            with_restoring(probe, (channel, Response, &before.0), |probe| answer(probe, channel))
        })?;
        let after = (
            read_variable(probe, channel, Response)?,
            read_variable(probe, channel, ResponseState)?,
        );
        let same = (until_nul(&after.0), &after.1) == (until_nul(&before.0), &before.1);
        probe.check(SVC_1, same, "the old response again", || format!("{after:02x?}"));
    }
    probe.finish("no service may be answered for")
}

/// Runs a function that changes a variable, and restores the old value.
fn with_restoring(
    probe: &mut Probe<'_>,
    (channel, variable, was): (Channel, ServiceVariable, &[u8]),
    change: impl FnOnce(&mut Probe<'_>) -> Step,
) -> Step {
    let name = variable.name().parse()?;
    let place = ValueAddress::Name { channel, name };
    let is_text = variable.var_type() == VariableType::STRING;
    let what = variable.name().to_string();
    let write_check = WriteCheck { what: &what, rules: &[], is_text, name: None };
    probe.changing(&write_check, &place, was, change, |probe| {
        write_variable(probe, channel, variable, was)?;
        probe.is_as_before(&place, was, is_text)
    })
}

/// Answers like a service, without a request.
fn answer(probe: &mut Probe<'_>, channel: Channel) -> Step {
    use ServiceVariable::{RequestState, Response, ResponseState};
    let taken = write_variable(probe, channel, Response, b"nobody asked\0")?;
    probe.check(SVC_1, taken, "a response taken", "an error");
    let read = read_variable(probe, channel, Response)?;
    let same = until_nul(&read) == b"nobody asked";
    probe.check(SVC_1, same, "the response as written", || Hex(read));
    // Any number: its meaning is agreed between program and service.
    for state in [ONE, WIDE, [0, 0, 0, 0x80]] {
        let taken = write_variable(probe, channel, ResponseState, &state)?;
        probe.check(SVC_1, taken, "a response state taken", "an error");
        let read = read_variable(probe, channel, ResponseState)?;
        probe.check(SVC_1, read == state, || Hex(state.to_vec()), || Hex(read));
    }
    let read = read_variable(probe, channel, RequestState)?;
    probe.check(SVC_4, read == NONE, "no request any more", || Hex(read));
    // That any write of REQUEST_STATE has this effect, over ADS too, is assumed.
    write_variable(probe, channel, RequestState, &NONE)?;
    let read = read_variable(probe, channel, ResponseState)?;
    probe.check(assumed(SVC_3), read == NONE, "the response state taken back", || Hex(read));
    Ok(())
}

fn request_states(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, RequestState, Response, ResponseState};
    within(probe, |probe, channel, cnc| {
        let write = |variable, value: &[u8]| -> Step {
            let written =
                cnc.with_service(channel.number(), |service| service.write(variable, value));
            Ok(written??)
        };
        write(Request, b"1\0")?;
        write(RequestState, &ONE)?;
        write_variable(probe, channel, Response, b"one\0")?;
        let read = read_variable(probe, channel, RequestState)?;
        let expected = "the request until it is answered";
        probe.check(assumed(SVC_4), read == ONE, expected, || Hex(read));
        write_variable(probe, channel, ResponseState, &ONE)?;
        // When REQUEST_STATE becomes 0 is assumed; that it does is stated.
        let read = read_variable(probe, channel, RequestState)?;
        probe.check(assumed(SVC_4), read == NONE, "the request is over", || Hex(read));
        write(RequestState, &[2, 0, 0, 0])?;
        let read = read_variable(probe, channel, ResponseState)?;
        probe.check(SVC_3, read == NONE, "the last response state taken back", || Hex(read));
        let read = read_variable(probe, channel, RequestState)?;
        probe.check(SVC_3, read == [2, 0, 0, 0], "the new request", || Hex(read));
        Ok(())
    })
}
