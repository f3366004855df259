//! The values of the five variables.

use ads_cnc::operation::{HandleByName, ReadByHandle, WriteByHandle};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{Handle, U32List, VariableType};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::interface::{NONE, WIDE, read_variable, within, write_variable};
use crate::judge::{Checks as _, Step};
use crate::suite::kit::Probe;
use crate::values::until_nul;

pub(super) fn longest(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, Response};
    within(probe, |probe, channel, _| {
        for variable in [Request, Response] {
            let mut value = vec![b'x'; 127];
            value.push(0);
            let taken = write_variable(probe, channel, variable, &value)?;
            probe.check(SVC_1, taken, "127 characters and a NUL taken", "an error");
            let read = read_variable(probe, channel, variable)?;
            probe.check(SVC_1, read == value, "128 bytes as written", || Hex(read));
            let mut longer = vec![b'y'; 128];
            longer.push(0);
            let taken = write_variable(probe, channel, variable, &longer)?;
            probe.check(SVC_1, !taken, "129 bytes refused", "taken");
            let read = read_variable(probe, channel, variable)?;
            probe.check(SVC_1, read == value, "what was there before", || Hex(read));
        }
        Ok(())
    })
}

/// Bytes that are characters, `len` of them from `first` on.
fn characters(first: u8, len: usize) -> Vec<u8> {
    let no_character = [0x81, 0x8D, 0x8F, 0x90, 0x9D];
    let all = (b' '..=0xFF).filter(|byte| *byte != 0x7F && !no_character.contains(byte));
    let mut all: Vec<u8> = all.collect();
    let before = usize::from(first).checked_rem(all.len()).unwrap_or_default();
    all.rotate_left(before);
    all.into_iter().cycle().take(len).collect()
}

pub(super) fn texts(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, Response};
    within(probe, |probe, channel, _| {
        for variable in [Request, Response] {
            for len in [127, 0, 1, 20, 21, 32, 36, 63, 64, 80, 100, 126, 127] {
                let mut value = characters(u8::try_from(len).unwrap_or_default(), len);
                value.push(0);
                let taken = write_variable(probe, channel, variable, &value)?;
                let what = format!("{len} characters of {}", variable.name());
                probe.check(SVC_1, taken, || format!("{what} taken"), "an error");
                let read = read_variable(probe, channel, variable)?;
                let same = until_nul(&read) == until_nul(&value);
                probe.check(SVC_1, same, || format!("{what} as written"), || Hex(read));
            }
        }
        Ok(())
    })
}

/// The UUID of the square root service.
const UUID: &[u8] = b"560AACBF-6335-44a9-895A-8B27F3ED5E47";

/// A write to one variable changes no other, except that the states reset each other.
pub(super) fn apart(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    within(probe, |probe, channel, _| {
        let mut all: Vec<(ServiceVariable, Vec<u8>)> = Vec::new();
        // In an order in which no write resets another.
        for (variable, value) in [
            (RequestState, NONE.to_vec()),
            (Uuid, [UUID, b"\0"].concat()),
            (Request, b"the request\0".to_vec()),
            (Response, b"the response\0".to_vec()),
            (ResponseState, WIDE.to_vec()),
        ] {
            write_variable(probe, channel, variable, &value)?;
            all.push((variable, value));
            for (one, written) in &all {
                let read = read_variable(probe, channel, *one)?;
                let is_text = one.var_type() == VariableType::STRING;
                let same = read == *written || is_text && until_nul(&read) == until_nul(written);
                let rule = if *one == ResponseState { SVC_3 } else { SVC_1 };
                let expected = || format!("{} of {}", Hex(written.clone()), one.name());
                probe.check(rule, same, expected, || Hex(read));
            }
        }
        // A read resets no state, nor does a write to another variable.
        for value in [&b"another\0"[..], b"the request\0"] {
            write_variable(probe, channel, Request, value)?;
            write_variable(probe, channel, Uuid, &[UUID, b"\0"].concat())?;
            let read = read_variable(probe, channel, ResponseState)?;
            probe.check(SVC_3, read == WIDE, "the response state until the next", || Hex(read));
        }
        for (variable, _) in all {
            let name = HandleByName::new(channel, variable.name())?;
            let handle = probe.try_read::<Handle>(name)?;
            let Some(handle) = handle else { continue };
            let by_name = read_variable(probe, channel, variable)?;
            let request = ReadByHandle::new(channel, handle, U32List::EMPTY);
            let by_handle = probe.try_ask(request)?.unwrap_or_default();
            let same = until_nul(&by_handle) == until_nul(&by_name);
            let expected = || format!("{} of {}", Hex(by_name), variable.name());
            probe.check(SVC_1, same, expected, || Hex(by_handle));
            // In the opposite order.
            if variable == Response {
                let write =
                    WriteByHandle::new(channel, handle, U32List::EMPTY, &b"by handle\0"[..]);
                probe.send(write)?;
                let read = read_variable(probe, channel, variable)?;
                let same = until_nul(&read) == b"by handle";
                probe.check(SVC_1, same, "what was written by handle", || Hex(read));
            }
        }
        Ok(())
    })
}
