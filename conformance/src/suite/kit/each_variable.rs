//! Iterates over variables.

use ads_cnc::Description;
use ads_cnc::address::Channel;

use crate::judge::{Step, applicable};
use crate::suite::kit::{Probe, element_size};

/// Calls a function for every variable of every channel.
pub(crate) fn each_variable(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, &Description) -> Step,
) -> Step {
    for channel in probe.channels()? {
        for variable in probe.readable(channel)? {
            probe.set_subject(&variable.name.text);
            judge(probe, channel, &variable)?;
        }
    }
    probe.end_subject();
    Ok(())
}

/// Calls a function for every array.
pub(crate) fn each_array(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, &Description, usize) -> Step,
) -> Step {
    let mut any = false;
    each_variable(probe, |probe, channel, variable| match element_size(variable) {
        Some(size) if !variable.dimensions.is_empty() => {
            any = true;
            judge(probe, channel, variable, size)
        }
        _ => Ok(()),
    })?;
    applicable(any, "no variable is an array")
}
