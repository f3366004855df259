//! Iterates over variables.

use ads_cnc::Description;
use ads_cnc::address::Channel;

use crate::judge::{Step, applicable};
use crate::suite::kit::{Probe, element_size};

/// Calls a function for every variable that the cases read and whose whole value fits into a reply,
/// in every claimed channel.
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

/// Maximum number of arrays of all channels in a sample, because several elements of each array are
/// read separately.
const ARRAYS_MAX: u32 = 64;

/// Calls a function for the arrays among the variables of [`each_variable`]; in a sample, for at
/// most [`ARRAYS_MAX`] arrays. The last argument of the function is the size of an element in
/// bytes. An array whose elements have no known size is left out.
pub(crate) fn each_array(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, &Description, usize) -> Step,
) -> Step {
    let mut arrays = Vec::new();
    each_variable(probe, |_, channel, variable| {
        let size = element_size(variable).filter(|_| !variable.dimensions.is_empty());
        arrays.extend(size.map(|size| (channel, variable.clone(), size)));
        Ok(())
    })?;
    applicable(!arrays.is_empty(), "no variable is an array")?;
    for (channel, variable, size) in probe.target.sample.among(arrays, ARRAYS_MAX) {
        probe.set_subject(&variable.name.text);
        judge(probe, channel, &variable, size)?;
    }
    probe.end_subject();
    Ok(())
}
