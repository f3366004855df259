//! Cases that write and read the variables of the Service Interface.

use ads_cnc::operation::{HandleByName, ReadByHandle, WriteByHandle};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{Handle, U32List, VariableType};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::interface::{ONE, WIDE, for_each_text, in_each_channel, read_variable, write_variable};
use crate::judge::{Checks as _, Step};
use crate::suite::kit::{Probe, with_reply};
use crate::suite::texts::UNASSIGNED;
use crate::text::plural;
use crate::values::until_nul;

pub(super) fn longest(probe: &mut Probe<'_>) -> Step {
    let sends_longer = probe.target.client.gate().lets_malformed_pass();
    for_each_text(probe, |probe, channel, variable| {
        let value = [&[b'x'; 127][..], b"\0"].concat();
        let accepted = write_variable(probe, channel, variable, &value)?;
        probe.check(SVC_1, accepted, "127 characters and a NUL accepted", "an error");
        let read = read_variable(probe, channel, variable)?;
        probe.check(SVC_1, read == value, "128 bytes as written", || Hex(read));
        if sends_longer {
            let longer = [&[b'y'; 128][..], b"\0"].concat();
            let accepted = write_variable(probe, channel, variable, &longer)?;
            probe.check(SVC_1, !accepted, "129 bytes rejected", "accepted");
            let read = read_variable(probe, channel, variable)?;
            probe.check(SVC_1, read == value, "the text written before, unchanged", || Hex(read));
        }
        Ok(())
    })
}

/// Returns `len` printable characters of CP1252 in ascending order, starting with the printable
/// character that has the index `first`; the first printable character follows the last one.
fn characters(first: u8, len: usize) -> Vec<u8> {
    let all = (b' '..=0xFF).filter(|byte| *byte != 0x7F && !UNASSIGNED.contains(byte));
    let mut all: Vec<u8> = all.collect();
    let before = usize::from(first).checked_rem(all.len()).unwrap_or_default();
    all.rotate_left(before);
    all.into_iter().cycle().take(len).collect()
}

pub(super) fn texts(probe: &mut Probe<'_>) -> Step {
    for_each_text(probe, |probe, channel, variable| {
        for len in [127, 0, 1, 20, 21, 32, 36, 63, 64, 80, 100, 126, 127] {
            let mut value = characters(u8::try_from(len).unwrap_or_default(), len);
            value.push(0);
            let accepted = write_variable(probe, channel, variable, &value)?;
            let what = format!("{} of {}", plural(len, "character"), variable.name());
            probe.check(SVC_1, accepted, || format!("{what} accepted"), "an error");
            let read = read_variable(probe, channel, variable)?;
            let same = until_nul(&read) == until_nul(&value);
            probe.check(SVC_1, same, || format!("{what} as written"), || Hex(read));
        }
        Ok(())
    })
}

/// Writes texts of several lengths by name and reads them by handle, and vice versa.
pub(super) fn by_handle(probe: &mut Probe<'_>) -> Step {
    for_each_text(probe, |probe, channel, variable| {
        let name = variable.name();
        let handle = probe.try_read::<Handle>(HandleByName::new(channel, name)?)?;
        let Some(handle) = handle else { return Ok(()) };
        for len in [127_usize, 0, 1, 20, 21, 64, 126, 127] {
            let letters = (b'a'..=b'z').cycle().skip(len);
            let value: Vec<u8> = letters.take(len).chain([0]).collect();
            let expected = || format!("{} of {name} by its handle", plural(len, "character"));
            write_variable(probe, channel, variable, &value)?;
            let read = ReadByHandle::new(channel, handle, U32List::EMPTY);
            let read = probe.try_ask(read)?.unwrap_or_default();
            let same = until_nul(&read) == until_nul(&value);
            probe.check(SVC_1, same, expected, || Hex(read));
            write_variable(probe, channel, variable, b"\0")?;
            let write = WriteByHandle::new(channel, handle, U32List::EMPTY, &value);
            if !probe.may(write)? {
                continue;
            }
            with_reply(probe.send(write)?)?;
            let read = read_variable(probe, channel, variable)?;
            let same = until_nul(&read) == until_nul(&value);
            probe.check(SVC_1, same, expected, || Hex(read));
        }
        Ok(())
    })
}

/// The UUID of the square root service, an example in the manuals (SVC-9).
const UUID: &[u8] = b"560AACBF-6335-44a9-895A-8B27F3ED5E47\0";

/// Requests a service with a UUID that no service should have, and checks that REQUEST and
/// REQUEST_STATE keep the written values.
pub(super) fn request(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, RequestState, ResponseState, Uuid};
    const NO_SERVICE: &[u8] = b"00000000-0000-0000-0000-000000000000\0";
    // A write of REQUEST_STATE changes RESPONSE_STATE, too.
    let variables = [ResponseState, Uuid, Request, RequestState];
    in_each_channel(probe, &variables, |probe, channel| {
        write_variable(probe, channel, Uuid, NO_SERVICE)?;
        write_variable(probe, channel, Request, b"a request\0")?;
        let written = read_variable(probe, channel, Request)?;
        for state in [ONE, WIDE] {
            write_variable(probe, channel, RequestState, &state)?;
            let read = read_variable(probe, channel, RequestState)?;
            let expected = || Hex(state.to_vec());
            probe.check([SVC_1, VAR_13], read == state, expected, || Hex(read));
            let read = read_variable(probe, channel, Request)?;
            let expected = || Hex(written.clone());
            probe.check(SVC_2, read == written, expected, || Hex(read));
        }
        Ok(())
    })
}

/// Checks that a write to one variable changes none of the variables that were written before it.
/// REQUEST_STATE is not written, so that no service is requested.
pub(super) fn apart(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, Response, ResponseState, Uuid};
    in_each_channel(probe, &[ResponseState, Response, Request, Uuid], |probe, channel| {
        let mut all: Vec<(ServiceVariable, &[u8])> = Vec::new();
        for (variable, value) in [
            (Uuid, UUID),
            (Request, b"the request\0"),
            (Response, b"the response\0"),
            (ResponseState, &WIDE),
        ] {
            write_variable(probe, channel, variable, value)?;
            all.push((variable, value));
            for &(one, written) in &all {
                let read = read_variable(probe, channel, one)?;
                let is_text = one.var_type() == VariableType::STRING;
                let same = read == written || is_text && until_nul(&read) == until_nul(written);
                let rule = if one == ResponseState { SVC_3 } else { SVC_1 };
                let expected = || format!("{} of {}", Hex(written.to_vec()), one.name());
                probe.check(rule, same, expected, || Hex(read));
            }
        }
        // Neither a read nor a write of UUID or REQUEST resets the response state.
        for value in [&b"another\0"[..], b"the request\0"] {
            write_variable(probe, channel, Request, value)?;
            write_variable(probe, channel, Uuid, UUID)?;
            let read = read_variable(probe, channel, ResponseState)?;
            probe.check(
                SVC_3,
                read == WIDE,
                "the response state until the next request state",
                || Hex(read),
            );
        }
        Ok(())
    })
}
