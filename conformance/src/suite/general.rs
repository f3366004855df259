//! Cases of general requirements (GEN): tasks and ports, numbering, sizes of types, and code page
//! of names.

use ads_cnc::address::{Channel, ChannelAxis, Class, IndexGroup};
use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::{
    AxisHandleByName, CountObjects, CountVariables, FindInstance, HandleByName, ReadByHandle,
    Request,
};
use ads_cnc::sda::ObjectAddress;
use ads_cnc::{Description, Kind, U32List};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, RawCall, name_of, name_on_axes};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, IfPresent as _, Needs, Step, assumed};
use crate::number::to_u32;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("gen-ports-answer", &[GEN_4], Needs::Queries, ports_answer,
        "A task answers at each claimed port"),
    case("gen-tasks-apart", &[GEN_4], Needs::Malformed, tasks_apart,
        "A task answers at its own port, not at the port of another task"),
    case("gen-type-sizes", &[GEN_5], Needs::Queries, type_sizes,
        "The size of a variable is the size of its type times the number of its elements"),
    case("gen-numbering", &[GEN_6, ADR_2], Needs::Queries, numbering,
        "Channels are counted from 1, spindles from 0"),
    case("gen-no-channel-0", &[GEN_6], Needs::Malformed, no_channel_0,
        "Channel number 0, channel rank 0 and axis index 0 do not exist"),
    case("gen-names-found", &[GEN_3], Needs::Queries, names_found,
        "A name is found by the characters of its description, including non-ASCII characters"),
];

/// A claimed port must exist; other cases judge the replies of its task.
fn ports_answer(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    for port in [AmsPort::GEO, AmsPort::SDA, AmsPort::COM] {
        if !probe.target.profile.has_port(port) {
            continue;
        }
        let of_com = CountObjects::new(channel).into();
        let of_class = FindInstance::new(Class::Decoder, channel.number().into(), 0).into();
        let request: Request<'_> = if port == AmsPort::COM { of_com } else { of_class };
        let call = RawCall::new(request)?.with(|call| call.port = port);
        let Some(exchange) = probe.call(&call).if_applicable()? else { continue };
        let nobody = exchange.reply().is_some_and(|reply| {
            [reply.ams_error, reply.result].contains(&AdsError::TARGET_PORT_NOT_FOUND)
        });
        // A claimed port must exist even if the manuals do not state its number.
        probe.check(GEN_4, !nobody, || format!("a task at port {}", port.0), &exchange);
    }
    Ok(())
}

fn tasks_apart(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let of_com: Request<'_> = CountObjects::new(channel).into();
    let of_sda: Request<'_> = CountVariables::new(channel, Kind::V_E).into();
    for (request, ports) in [(of_com, &[AmsPort::SDA, AmsPort::GEO][..]), (of_sda, &[AmsPort::COM])]
    {
        if !probe.may(request)? {
            continue;
        }
        let valid = RawCall::new(request)?;
        for &port in ports {
            let what = format!("{} at port {}", request.function().spec().name, port.0);
            probe.rejects(GEN_4, &what, valid.with(|call| call.port = port), &valid)?;
        }
    }
    probe.finish("neither COM nor SDA is claimed")
}

fn type_sizes(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            let Some(size) = variable.var_type.element_size() else { continue };
            probe.set_subject(&variable.name.text);
            let whole = variable.dimensions.iter().fold(size, |all, &n| all.saturating_mul(n));
            let name = &variable.name.text;
            let read = ReadByHandle::new(channel, variable.handle, U32List::EMPTY);
            // Another case judges whether the value can be read.
            let Some(value) = probe.try_ask(read)? else { continue };
            // If only one of the two sizes differs, the description or the value is wrong, not the
            // size of the type.
            let read = to_u32(value.len());
            let sized = [variable.size, read].contains(&whole);
            let expected = || format!("{} for {}", plural(whole, "byte"), variable.var_type);
            let found =
                || format!("{name}: {} described, {read} read", plural(variable.size, "byte"));
            probe.check(GEN_5, sized, expected, found);
        }
    }
    Ok(())
}

fn numbering(probe: &mut Probe<'_>) -> Step {
    let find = |probe: &mut Probe<'_>, class, channel| -> Step<Option<ObjectAddress>> {
        Ok(probe.address_of(class, channel, 0).if_applicable()?.flatten())
    };
    // The check uses the decoder, because the manual states that the decoder's variables belong to
    // SDA.
    let first = u32::from(probe.channel()?.number());
    if let Some(there) =
        find(probe, Class::Decoder, first)?.filter(|one| *one != ObjectAddress::NONE)
    {
        let zero = find(probe, Class::Decoder, 0)?;
        let none = zero.is_none_or(|zero| zero == ObjectAddress::NONE);
        let found = || format!("{zero:?}; channel {first} has {there:?}");
        probe.check(GEN_6, none, "no decoder in channel 0", found);
    }
    if probe.target.profile.spindles.is_some_and(|spindles| spindles > 0) {
        // If the profile does not claim the request for the address of an instance, this check is
        // left out.
        if let Some(zero) = probe.address_of(Class::Spindle, 0, 0).if_applicable()? {
            let there = zero.is_some_and(|zero| zero != ObjectAddress::NONE);
            let found = || format!("{zero:?}");
            probe.check([GEN_6, ADR_2], there, "a first spindle at index 0", found);
        }
    }
    probe.finish("the target names no instance")
}

fn no_channel_0(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let request: Request<'_> = CountVariables::new(channel, Kind::V_E).into();
    let valid = RawCall::new(request)?;
    for group in [0x12_2300, 0x02_2300] {
        let invalid = valid.with(|call| call.index_group = IndexGroup::new(group));
        let what = format!("the variables of channel 0 in group {group:#x}");
        probe.rejects(GEN_6, &what, &invalid, &valid)?;
    }
    let Some(variables) = probe.variables(channel).if_known()? else { return Ok(()) };
    let Some(name) = variables.iter().find_map(name_on_axes) else { return Ok(()) };
    let axis = ChannelAxis::new(1)?;
    let request: Request<'_> =
        AxisHandleByName { channel, axis, name: name.as_cnc_str().into() }.into();
    let valid = RawCall::new(request)?;
    let offset = ads_cnc::address::IndexOffset::new(valid.index_offset.get() & 0xFFFF);
    probe.rejects(GEN_6, "a name at place 0", valid.with(|call| call.index_offset = offset), &valid)
}

/// Whether a name has non-ASCII characters, or a `?`, which a CNC may return in place of such a
/// character.
fn depends_on_code_page(name: &[u8]) -> bool {
    name.iter().any(|byte| !byte.is_ascii() || *byte == b'?')
}

/// Whether the text is UTF-8 with non-ASCII characters.
fn is_utf_8(text: &[u8]) -> bool {
    !text.is_ascii() && std::str::from_utf8(text).is_ok()
}

/// Whether the first name that does not depend on the code page has a handle in the channel; also
/// true if no such name exists. If this name has no handle, the missing handle of another name does
/// not show a wrong code page.
fn finds_plain_names(probe: &mut Probe<'_>, channel: Channel, all: &[Description]) -> Step<bool> {
    let plain = all.iter().find(|one| !depends_on_code_page(one.name.text.as_bytes()));
    let Some(plain) = plain else { return Ok(true) };
    Ok(probe.try_ask(HandleByName { channel, name: name_of(plain) })?.is_some())
}

fn names_found(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let variables = probe.variables(channel)?;
        if !finds_plain_names(probe, channel, &variables)? {
            continue;
        }
        for variable in variables {
            let name = variable.name.text.as_bytes();
            if !depends_on_code_page(name) {
                continue;
            }
            let by_name = HandleByName { channel, name: name_of(&variable) };
            let found = probe.try_ask(by_name)?.is_some();
            let expected = || format!("a handle of {}", variable.name.text);
            probe.check(GEN_3, found, expected, "the name is not found");
            // Bytes that are valid UTF-8 may also be intended as CP1252, so this check is assumed.
            let text = Hex(name.to_vec());
            probe.check(assumed(GEN_3), !is_utf_8(name), "one byte per character", text);
        }
    }
    probe.finish("no name has a non-ASCII character")
}

#[cfg(test)]
mod tests {
    use std::net::SocketAddr;
    use std::sync::Arc;
    use std::time::Duration;

    use ads_cnc::operation::{Call, Function};

    use super::*;
    use crate::client::{Client, Target};
    use crate::gate::Gate;
    use crate::judge::Verdict;
    use crate::profile::Profile;
    use crate::simulator::{Cnc, LocalCnc, NET_ID, ReplyData, Responder};
    use crate::suite::kit::TargetState;

    /// A CNC that describes its SGN16 variables as SGN32.
    #[derive(Debug)]
    struct Wrong(Cnc);

    impl Responder for Wrong {
        fn answer(&self, call: &Call<'_>) -> ReplyData {
            let mut bytes = self.0.answer(call)?;
            let function = call.dispatch().map(|request| request.function());
            if function == Ok(Function::DescribeByIndex) && bytes[4] == 4 {
                bytes[4] = 6;
            }
            Ok(bytes)
        }

        fn pass(&self, time: Duration) {
            self.0.pass(time);
        }
    }

    /// The size of a variable of the type SGN32 is a part of GEN-5 at the level *must*.
    #[test]
    fn a_wrong_size_of_a_number_fails() {
        let cnc = Wrong(Cnc::with_default_model().unwrap().with_stopped_clock());
        let target = Target::local(SocketAddr::from(([127, 0, 0, 1], 0)), NET_ID);
        let cnc = LocalCnc::new(Arc::new(cnc), NET_ID);
        let client = Client::in_process(target, Gate::queries(), cnc).unwrap();
        let mut target = TargetState::new(client, Profile::DEVICE);
        let mut probe = Probe::new(&mut target);
        type_sizes(&mut probe).unwrap();
        let judgements = probe.record.judgements;
        assert!(judgements.iter().any(|one| one.verdict == Verdict::Fail), "{judgements:?}");
    }

    #[test]
    fn characters_of_several_bytes_are_seen() {
        assert!(is_utf_8("Länge".as_bytes()));
        assert!(!is_utf_8(b"L\xE4nge") && !is_utf_8(b"Lange") && !is_utf_8(b"\xB0C"));
        assert!(
            depends_on_code_page(b"L?nge")
                && depends_on_code_page(b"L\xE4nge")
                && !depends_on_code_page(b"Lange")
        );
    }
}
