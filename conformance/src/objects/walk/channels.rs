//! Finds the active channels.

use ads_cnc::address::{Channel, Class};
use ads_cnc::operation::{CountVariables, FindInstance};
use ads_cnc::{Kind, VariableCount};

use super::Walker;
use super::walker::{GAP, NUMBER_MAX};

/// The active channels in ascending order of their numbers. `is_there` checks whether a channel
/// exists; its last argument is whether at least one channel, requested by its rank, has COM
/// objects.
pub(crate) fn active_channels<W: Walker>(
    walker: &mut W,
    mut is_there: impl FnMut(&mut W, Channel, bool) -> Result<bool, W::Error>,
) -> Result<Vec<Channel>, W::Error> {
    let (mut ranks, mut has_objects) = (0_usize, false);
    for rank in (1..=NUMBER_MAX).map_while(|rank| Channel::by_index(rank).ok()) {
        let is_listed = walker.count_objects(rank)?.is_some();
        has_objects |= is_listed;
        // If COM reports no objects for a rank, but objects for an earlier rank, the channel may
        // still have variables in SDA.
        if !is_listed && (!has_objects || !has_variables(walker, rank)?) {
            break;
        }
        ranks = ranks.saturating_add(1);
    }
    let (mut found, mut gap) = (Vec::new(), 0_u32);
    for number in (1..=NUMBER_MAX).map_while(|number| Channel::new(number).ok()) {
        if found.len() >= ranks && (ranks > 0 || gap >= GAP) {
            break;
        }
        let is_there = is_there(walker, number, has_objects)?;
        gap = if is_there { 0 } else { gap.saturating_add(1) };
        found.extend(is_there.then_some(number));
    }
    Ok(found)
}

/// Whether a channel has variables of the kinds V.E, V.G or V.A.
pub(crate) fn has_variables<W: Walker>(walker: &mut W, channel: Channel) -> Result<bool, W::Error> {
    let count: Option<VariableCount> = walker.decoded(CountVariables::new(channel, Kind::ALL))?;
    Ok(count.is_some_and(|count| count.0 > 0))
}

/// The request for the address of a channel's decoder. A channel has a decoder even if it has no
/// objects.
pub(crate) fn decoder_of(channel: Channel) -> FindInstance {
    FindInstance::new(Class::Decoder, channel.number().into(), 0)
}
