//! Reads, writes and restores the variables of the Service Interface of a channel.

use ads_cnc::VariableType;
use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, WriteByName};
use ads_cnc::service::ServiceVariable;
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Step, Stop};
use crate::objects::ValueAddress;
use crate::suite::kit::{Probe, WriteCheck, service_channels, with_reply};
use crate::values::until_nul;

pub(super) fn read_variable(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: ServiceVariable,
) -> Step<Vec<u8>> {
    let request = ReadByName::new(channel, variable.name())?;
    let exchange = with_reply(probe.send(request)?)?;
    let value = exchange.success();
    Ok(value.unwrap_or_default().to_vec())
}

pub(super) fn write_variable(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: ServiceVariable,
    value: &[u8],
) -> Step<bool> {
    let request = WriteByName::new(channel, variable.name(), value)?;
    let exchange = with_reply(probe.send(request)?)?;
    Ok(exchange.success().is_some())
}

pub(super) const ONE: [u8; 4] = [1, 0, 0, 0];

pub(super) const NONE: [u8; 4] = [0; 4];

/// A value whose bytes all differ.
pub(super) const WIDE: [u8; 4] = [0x63, 0x12, 0x34, 0x56];

/// The variables that contain the texts of a request and its response.
const TEXTS: [ServiceVariable; 2] = [ServiceVariable::Request, ServiceVariable::Response];

/// Calls a function for each channel with the Service Interface in which all these variables may be
/// written, and then restores the variables, the last one first. The case is inconclusive unless
/// REQUEST_STATE is 0, because another value shows that an NC program has requested a service.
pub(super) fn in_each_channel(
    probe: &mut Probe<'_>,
    variables: &[ServiceVariable],
    mut then: impl FnMut(&mut Probe<'_>, Channel) -> Step,
) -> Step {
    for channel in service_channels(probe)? {
        let mut may = true;
        for variable in variables {
            let address = ValueAddress::Name { channel, name: variable.name().parse()? };
            may &= probe.may_write(&address, variable.name())?;
        }
        if !may {
            continue;
        }
        if read_variable(probe, channel, ServiceVariable::RequestState)? != NONE {
            return Err(Stop::inconclusive(
                "a program has requested a service, so nothing is written",
            ));
        }
        restoring(probe, channel, variables, &mut |probe| then(probe, channel))?;
    }
    probe.finish("no variable of the Service Interface may be written")
}

/// Like [`in_each_channel`], but separately for each variable in [`TEXTS`].
pub(super) fn for_each_text(
    probe: &mut Probe<'_>,
    mut then: impl FnMut(&mut Probe<'_>, Channel, ServiceVariable) -> Step,
) -> Step {
    for variable in TEXTS {
        match in_each_channel(probe, &[variable], |probe, channel| then(probe, channel, variable)) {
            Err(Stop::NotApplicable(_)) => {}
            done => done?,
        }
    }
    probe.finish("no text of the Service Interface may be written")
}

fn restoring(
    probe: &mut Probe<'_>,
    channel: Channel,
    variables: &[ServiceVariable],
    then: &mut dyn FnMut(&mut Probe<'_>) -> Step,
) -> Step {
    let Some((&variable, others)) = variables.split_first() else { return then(probe) };
    let mut was = read_variable(probe, channel, variable)?;
    if was.is_empty() {
        let name = variable.name();
        return Err(Stop::Inconclusive(format!(
            "{name} could not be read, so it could not be restored"
        )));
    }
    let address = ValueAddress::Name { channel, name: variable.name().parse()? };
    let is_text = variable.var_type() == VariableType::STRING;
    if is_text {
        // The text is restored without its padding, because a device may reject more bytes than the
        // text has.
        was = [until_nul(&was), b"\0"].concat();
    }
    let write_check = WriteCheck { what: variable.name(), rules: &[], is_text, name: None };
    probe.changing(
        &write_check,
        &address,
        &was,
        |probe| restoring(probe, channel, others, then),
        |probe| {
            write_variable(probe, channel, variable, &was)?;
            let same = probe.is_as_before(&address, &was, is_text)?;
            let found = || format!("another value of {}", variable.name());
            probe.check([SVC_1, VAR_13], same, "the original value, written back", found);
            Ok(same)
        },
    )
}
