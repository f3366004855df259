//! The Service Interface.

use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByName, WriteByName};
use ads_cnc::service::ServiceVariable;

use crate::target::{Check, Target};

/// The value of a variable; empty if the read is rejected.
pub(crate) fn read_variable(
    target: &Target,
    channel: u8,
    variable: ServiceVariable,
) -> Check<Vec<u8>> {
    let request = ReadByName::new(Channel::new(channel.into())?, variable.name())?;
    Ok(target.ask(request)?.unwrap_or_default())
}

/// Whether a write is accepted.
pub(crate) fn write_variable(
    target: &Target,
    channel: u8,
    variable: ServiceVariable,
    value: &[u8],
) -> Check<bool> {
    let request = WriteByName::new(Channel::new(channel.into())?, variable.name(), value)?;
    Ok(target.ask(request)?.is_ok())
}
