//! Variables on the axis interface: the axis indices at which a name has a handle, and the
//! addresses of the variables.

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::operation::AxisHandleByName;
use ads_cnc::{CncString, Description, Handle, VariablePath};

use crate::judge::Step;
use crate::objects::ValueAddress;
use crate::suite::kit::Probe;

/// The highest axis index of a channel that the cases request on the axis interface to find the
/// indices with a handle. A run without a profile, if it may write, treats the axis indices up to
/// this one, in all channels but the first, as possibly without an axis.
pub(crate) const PLACES_MAX: u32 = 64;
/// A search continues after at most this number of consecutive axis indices without a handle: the
/// CNC need not return a handle at an axis index without an axis.
pub(crate) const GAP_MAX: u32 = 4;

/// Maximum number of names of axis variables of a channel in a sample, because each name is
/// requested at many axis indices.
const NAMES_MAX: u32 = 32;

/// An axis index at which a name has a handle, and this handle.
pub(crate) struct AxisHandle {
    pub(crate) axis: ChannelAxis,
    pub(crate) handle: Handle,
}

/// The axis indices of a channel at which a name has a handle, in ascending order, each with this
/// handle. The search ends at [`PLACES_MAX`], or after more than [`GAP_MAX`] consecutive indices
/// without a handle.
pub(crate) fn answering_places(
    probe: &mut Probe<'_>,
    channel: Channel,
    name: &CncString,
) -> Step<Vec<AxisHandle>> {
    let mut all = Vec::new();
    let mut gap = 0_u32;
    for place in 1..=PLACES_MAX {
        let axis = ChannelAxis::new(place)?;
        let name = name.as_cnc_str().into();
        match probe.try_read::<Handle>(AxisHandleByName { channel, axis, name })? {
            Some(handle) => {
                all.push(AxisHandle { axis, handle });
                gap = 0;
            }
            None => gap = gap.saturating_add(1),
        }
        if gap > GAP_MAX {
            break;
        }
    }
    Ok(all)
}

/// The address of a variable on the axis interface, with the first axis index that returns the
/// handle in the variable's description. `None` if no requested index returns this handle, or if
/// the name does not end with an axis.
pub(crate) fn axis_address(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: &Description,
) -> Step<Option<ValueAddress>> {
    let Some(name) = name_on_axes(variable) else { return Ok(None) };
    let places = answering_places(probe, channel, &name)?;
    let own = places.into_iter().find(|at| at.handle == variable.handle);
    Ok(own.map(|at| ValueAddress::Axis { channel, axis: at.axis, name }))
}

/// The axis variables of a channel that the cases read: for each, its name on the axis interface
/// (without the axis) and its description.
pub(crate) fn axis_variables(
    probe: &mut Probe<'_>,
    channel: Channel,
) -> Step<Vec<(CncString, Description)>> {
    let all = probe.variables(channel)?;
    let of_axes = all.into_iter().filter_map(|one| Some((name_on_axes(&one)?, one)));
    let mut of_axes: Vec<(CncString, Description)> = of_axes.collect();
    let names = axis_names(&of_axes).into_iter().cloned().collect();
    let names: Vec<CncString> = probe.target.sample.among(names, NAMES_MAX);
    of_axes.retain(|(name, _)| names.contains(name));
    Ok(of_axes)
}

pub(crate) fn axis_names(described: &[(CncString, Description)]) -> Vec<&CncString> {
    let mut names: Vec<&CncString> = described.iter().map(|(name, _)| name).collect();
    names.sort_by_key(|name| name.as_bytes());
    names.dedup();
    names
}

/// The name of a variable on the axis interface (without the axis); `None` if the variable is not
/// an axis variable.
pub(crate) fn name_on_axes(variable: &Description) -> Option<CncString> {
    let path = VariablePath::from_text(variable.name.text.as_cnc_str()).ok()?;
    path.axis().and_then(|_| path.without_axis().ok())
}
