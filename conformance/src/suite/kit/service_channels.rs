//! Finds the channels with the Service Interface.

use ads_cnc::address::Channel;
use ads_cnc::operation::ReadByName;
use ads_cnc::service::ServiceVariable;

use crate::edition::Feature;
use crate::judge::{Step, Stop};
use crate::profile::{Claim, Section};
use crate::suite::kit::Probe;

/// The channels with the Service Interface: all claimed channels if the version in the profile has
/// the Service Interface. If the profile leaves this open, those claimed channels in which a
/// variable of the Service Interface is described or REQUEST_STATE can be read. Ends the case as
/// not applicable if the profile does not claim the Service Interface, or if no channel has it.
pub(crate) fn service_channels(probe: &mut Probe<'_>) -> Step<Vec<Channel>> {
    let profile = &probe.target.profile;
    let lacks = |why| Err(Stop::not_applicable(why));
    if !profile.has_section(Section::Service) {
        return lacks("the profile does not claim the Service Interface");
    }
    match profile.has(Feature::ServiceInterface) {
        Claim::Yes => probe.channels(),
        Claim::No => lacks("the version has no Service Interface"),
        Claim::Open => {
            let mut there = Vec::new();
            for channel in probe.channels()? {
                let name = ServiceVariable::RequestState.name();
                let state = ReadByName::new(channel, name)?;
                let described = probe.variables(channel).unwrap_or_default();
                let mut names = described.iter().map(|one| one.name.text.to_string());
                let described = names.any(|name| ServiceVariable::by_name(&name).is_some());
                if described || probe.try_ask(state)?.is_some() {
                    there.push(channel);
                }
            }
            if there.is_empty() {
                lacks("no channel has the Service Interface, which only some versions have")
            } else {
                Ok(there)
            }
        }
    }
}
