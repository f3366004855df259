//! Where variables are on the axis interface: at which places a name answers, and by which a variable
//! is reached.

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::operation::AxisHandleByName;
use ads_cnc::{CncString, Description, Handle, VariablePath};

use super::place::Place;
use super::probe::Probe;
use crate::judge::Step;

/// The most places of a channel that are looked at.
pub(super) const PLACES_MAX: u32 = 64;
/// The most places without an axis in between: such a place need not answer.
const GAP_MAX: u32 = 4;

/// A place at which a name answers.
pub(super) struct At {
    pub(super) axis: ChannelAxis,
    pub(super) handle: Handle,
}

/// All places of a channel at which a name answers with a handle.
pub(super) fn answering(
    probe: &mut Probe<'_>,
    channel: Channel,
    name: &CncString,
) -> Step<Vec<At>> {
    let mut all = Vec::new();
    let mut gap = 0_u32;
    for place in 1..=PLACES_MAX {
        let axis = ChannelAxis::new(place)?;
        let name = name.as_cnc_str().into();
        match probe.try_read::<Handle>(AxisHandleByName { channel, axis, name })? {
            Some(handle) => {
                all.push(At { axis, handle });
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

/// The place at which a variable of an axis has the handle that it is described with.
pub(super) fn place_of(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: &Description,
) -> Step<Option<Place>> {
    let path = VariablePath::from_text(variable.name.text.as_cnc_str()).ok();
    let path = path.filter(|path| path.axis().is_some());
    let Some(name) = path.and_then(|path| path.without_axis().ok()) else { return Ok(None) };
    let places = answering(probe, channel, &name)?;
    let own = places.into_iter().find(|at| at.handle == variable.handle);
    Ok(own.map(|at| Place::Axis { channel, axis: at.axis, name }))
}
