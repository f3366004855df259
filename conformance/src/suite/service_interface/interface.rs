//! The Service Interface of a channel, read and written over ADS and used from within.

use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, WriteByName};
use ads_cnc::service::ServiceVariable;

use crate::judge::{Step, Stop};
use crate::suite::kit::{Probe, service_channels, with_reply};

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

/// All bytes differ.
pub(super) const WIDE: [u8; 4] = [0x63, 0x12, 0x34, 0x56];

/// Uses the first interface from both sides, and restores its initial state.
pub(super) fn within(
    probe: &mut Probe<'_>,
    then: impl FnOnce(&mut Probe<'_>, Channel, &crate::simulator::Cnc) -> Step,
) -> Step {
    let lacks = || Stop::not_applicable("no channel has the Service Interface");
    let channel = service_channels(probe)?.into_iter().next().ok_or_else(lacks)?;
    within_at(probe, channel, then)
}

/// Like [`within`], for any channel.
pub(super) fn within_at(
    probe: &mut Probe<'_>,
    channel: Channel,
    then: impl FnOnce(&mut Probe<'_>, Channel, &crate::simulator::Cnc) -> Step,
) -> Step {
    let cnc = probe.cnc()?;
    let number = channel.number();
    // The model's own script is stopped meanwhile.
    let script = cnc.with_script(number, |script| script.cloned())?;
    let empty = || -> Step {
        cnc.set_script(number, None)?;
        Ok(cnc.with_service(number, |service| service.reset())?)
    };
    empty()?;
    let done = then(probe, channel, &cnc);
    empty()?;
    cnc.set_script(number, script)?;
    done
}
