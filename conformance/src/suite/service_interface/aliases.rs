//! The five variables by handle and by name, and in different channels.

use ads_cnc::address::Channel;
use ads_cnc::operation::{HandleByName, ReadByHandle, WriteByHandle};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{Handle, U32List};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::interface::{NONE, ONE, WIDE, read_variable, within, within_at, write_variable};
use crate::judge::{Checks as _, Step};
use crate::suite::kit::{Probe, service_channels};
use crate::values::until_nul;

fn handle_of(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: ServiceVariable,
) -> Step<Option<Handle>> {
    let name = HandleByName::new(channel, variable.name())?;
    probe.try_read(name)
}

/// Texts of any length, written by name and read by handle, and vice versa.
pub(super) fn by_handle(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, Response};
    within(probe, |probe, channel, _| {
        for variable in [Request, Response] {
            let Some(handle) = handle_of(probe, channel, variable)? else { continue };
            for len in [127_usize, 0, 1, 20, 21, 64, 126, 127] {
                let letters = (b'a'..=b'z').cycle().skip(len);
                let value: Vec<u8> = letters.take(len).chain([0]).collect();
                let name = variable.name();
                let expected = || format!("{len} characters of {name} by its handle");
                write_variable(probe, channel, variable, &value)?;
                let read = ReadByHandle::new(channel, handle, U32List::EMPTY);
                let read = probe.try_ask(read)?.unwrap_or_default();
                let same = until_nul(&read) == until_nul(&value);
                probe.check(SVC_1, same, expected, || Hex(read));
                write_variable(probe, channel, variable, b"\0")?;
                let write = WriteByHandle::new(channel, handle, U32List::EMPTY, &value);
                probe.send(write)?;
                let read = read_variable(probe, channel, variable)?;
                let same = until_nul(&read) == until_nul(&value);
                probe.check(SVC_1, same, expected, || Hex(read));
            }
        }
        Ok(())
    })
}

/// A service answers in one channel, while a program sends a request in another.
pub(super) fn channels_apart(probe: &mut Probe<'_>) -> Step {
    use ServiceVariable::{Request, RequestState, Response, ResponseState, Uuid};
    let all = service_channels(probe)?;
    for &asking in &all {
        let Some(&answered) = all.iter().find(|other| **other != asking) else { continue };
        within_at(probe, asking, |probe, asking, cnc| {
            within_at(probe, answered, |probe, answered, _| {
                let held: [(ServiceVariable, &[u8]); 4] = [
                    (Uuid, b"560AACBF-6335-44a9-895A-8B27F3ED5E47\0"),
                    (Request, b"asked here\0"),
                    (Response, b"answered here\0"),
                    (RequestState, &ONE),
                ];
                for number in [asking.number(), answered.number()] {
                    for (variable, value) in held {
                        let done =
                            cnc.with_service(number, |service| service.write(variable, value));
                        done??;
                    }
                }
                let others: [(ServiceVariable, &[u8]); 5] = [
                    (Uuid, b"other\0"),
                    (Request, b"other\0"),
                    (Response, b"other\0"),
                    (ResponseState, &WIDE),
                    (RequestState, &NONE),
                ];
                for (written, value) in others {
                    write_variable(probe, answered, written, value)?;
                    for (variable, value) in held {
                        let read = read_variable(probe, asking, variable)?;
                        let expected = || {
                            format!(
                                "{} of {} in channel {}, whatever is written in channel {}",
                                Hex(value.to_vec()),
                                variable.name(),
                                asking.number(),
                                answered.number()
                            )
                        };
                        let same = until_nul(&read) == until_nul(value);
                        probe.check([SVC_1, SVC_4], same, expected, || Hex(read.clone()));
                    }
                }
                Ok(())
            })
        })?;
    }
    probe.finish("one channel has the Service Interface")
}
