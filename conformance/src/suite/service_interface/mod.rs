//! Cases of the Service Interface: its variables, and the effects of writes to them.

mod interface;
mod texts;

use ads_cnc::address::Channel;
use ads_cnc::operation::{HandleByName, ReadByName};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{VariableAccess, VariableType};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use self::interface::{NONE, ONE, WIDE, in_each_channel, read_variable, write_variable};
use crate::edition::Feature;
use crate::judge::{Checks as _, Needs, Rule, Step, assumed};
use crate::suite::kit::{Probe, service_channels};
use crate::suite::row::{CaseRow, case};
use crate::text::plural;
use crate::values::until_nul;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("service-variables", &[SVC_1, SVC_11, VAR_6], Needs::Queries, variables,
        "A channel with the Service Interface has its five variables with valid values"),
    case("service-response", &[SVC_1, SVC_3, SVC_4, VAR_13], Needs::Writes, response,
        "A service writes response and response state; a new request state resets the latter"),
    case("service-longest", &[SVC_1, VAR_13], Needs::Writes, texts::longest,
        "REQUEST and RESPONSE hold at most 128 bytes"),
    case("service-texts", &[SVC_1, VAR_13], Needs::Writes, texts::texts,
        "A text of any length and any characters is read back unchanged"),
    case("service-variables-apart", &[SVC_1, SVC_3, VAR_13], Needs::Writes, texts::apart,
        "A write to one variable of the Service Interface changes no other"),
    case("service-request", &[SVC_1, SVC_2, VAR_13], Needs::Writes, texts::request,
        "REQUEST and REQUEST_STATE keep the written values until a service answers"),
    case("service-texts-by-handle", &[SVC_1, VAR_13], Needs::Writes, texts::by_handle,
        "A text of any length is written and read by handle and by name alike"),
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
            let value = probe.ask(&rules[..], request)?;
            probe.ask(&rules[..], HandleByName::new(channel, name)?)?;
            let found = || format!("{} of {name}", plural(value.len(), "byte"));
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
            // A type number without a name violates VAR-5, which another case judges.
            let is_other = own.var_type.name().is_some() && own.var_type != variable.var_type();
            probe.check(SVC_1, !is_other, expected, found);
            // A service writes RESPONSE and RESPONSE_STATE, so their access must be READ_WRITE.
            if [ServiceVariable::Response, ServiceVariable::ResponseState].contains(&variable) {
                let written = own.access == VariableAccess::READ_WRITE;
                let found = || format!("access {} of {name}", own.access.0);
                probe.check(VAR_6, written, "READ_WRITE", found);
            }
        }
    }
    Ok(())
}

fn response(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{RequestState, Response, ResponseState};
    // The response is restored before the response state, because a response state other than 0
    // tells an NC program that a response exists.
    in_each_channel(probe, &[ResponseState, Response, RequestState], answer)
}

/// Writes a response like a service, although no request exists, and checks the effects.
fn answer(probe: &mut Probe<'_>, channel: Channel) -> Step {
    use ServiceVariable::{RequestState, Response, ResponseState};
    let accepted = write_variable(probe, channel, Response, b"unrequested\0")?;
    probe.check(SVC_1, accepted, "the response accepted", "an error");
    let read = read_variable(probe, channel, Response)?;
    let same = until_nul(&read) == b"unrequested";
    probe.check(SVC_1, same, "the response as written", || Hex(read));
    // The response state may be any number, because program and service agree on its meaning.
    for state in [ONE, WIDE, [0, 0, 0, 0x80]] {
        let accepted = write_variable(probe, channel, ResponseState, &state)?;
        probe.check(SVC_1, accepted, "the response state accepted", "an error");
        let read = read_variable(probe, channel, ResponseState)?;
        probe.check(SVC_1, read == state, || Hex(state.to_vec()), || Hex(read));
    }
    let read = read_variable(probe, channel, RequestState)?;
    probe.check(SVC_4, read == NONE, "request state 0 after the response", || Hex(read));
    // It is assumed that a write of REQUEST_STATE over ADS, even of 0, resets RESPONSE_STATE.
    write_variable(probe, channel, RequestState, &NONE)?;
    let kept = read_variable(probe, channel, Response)?;
    let same = until_nul(&kept) == b"unrequested";
    probe.check(SVC_3, same, "the same response after the reset of its state", || Hex(kept));
    let read = read_variable(probe, channel, ResponseState)?;
    probe.check(assumed(SVC_3), read == NONE, "response state 0 after a new request state", || {
        Hex(read)
    });
    Ok(())
}
