//! Dynamic parameters that are also variables.

use ads_cnc::CncString;
use ads_cnc::dynamic::{DynamicCount, DynamicKind, DynamicName};
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{CountDynamic, DynamicNameByIndex, ReadByName};

use crate::edition::{Edition, Feature};
use crate::judge::{Step, Stop};
use crate::profile::Claim;
use crate::suite::kit::Probe;

/// The names of the V.P, V.L and V.S that currently exist in the first channel. Of each kind, these
/// are the names at the first 64 indices that can be read and requested.
fn dynamic_names(probe: &mut Probe<'_>) -> Step<Vec<(DynamicKind, CncString)>> {
    let channel = probe.channel()?;
    let mut all = Vec::new();
    for kind in DynamicKind::ALL.into_iter().filter(|kind| *kind != DynamicKind::P) {
        let count: Option<DynamicCount> = probe.try_read(CountDynamic::new(channel, kind))?;
        for index in 1..=count.map_or(0, |count| count.0.min(64)) {
            let request = DynamicNameByIndex::new(channel, kind, index)?;
            let name = probe.try_read::<DynamicName>(request)?.map(|name| name.name.text);
            // A name without space for its NUL cannot be requested.
            let name = name.filter(|name| name.as_bytes().len() < DYNAMIC_NAME_MAX);
            all.extend(name.map(|name| (kind, name)));
        }
    }
    Ok(all)
}

/// Whether any V.P, V.L or V.S of [`dynamic_names`] can be read by name as a variable, as the
/// German edition states for certain versions.
pub(crate) fn has_dynamic_variables(probe: &mut Probe<'_>) -> Step<bool> {
    let (channel, all) = (probe.channel()?, dynamic_names(probe)?);
    for (_, name) in &all {
        let name = name.as_cnc_str().into();
        if probe.try_ask(ReadByName { channel, name })?.is_some() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The V.P, V.L and V.S of [`dynamic_names`], if they are also variables. Ends the case as not
/// applicable if there are none, or if the edition or version in the profile has them only as
/// parameters. If the version leaves this open, the case is also not applicable if the first of
/// them cannot be read by name as a variable.
pub(crate) fn dynamic_among_variables(
    probe: &mut Probe<'_>,
) -> Step<Vec<(DynamicKind, CncString)>> {
    let profile = &probe.target.profile;
    let lacks = |why| Err(Stop::not_applicable(why));
    if profile.edition != Edition::German {
        return lacks("in this edition V.P, V.L and V.S are only parameters");
    }
    let claim = profile.has(Feature::DynamicVariables);
    if claim == Claim::No {
        return lacks("in this version V.P, V.L and V.S are only parameters");
    }
    let (channel, all) = (probe.channel()?, dynamic_names(probe)?);
    let Some((_, name)) = all.first() else {
        return lacks("no V.P, V.L or V.S exists at the moment");
    };
    let by_name = ReadByName { channel, name: name.as_cnc_str().into() };
    if claim == Claim::Open && probe.try_ask(by_name)?.is_none() {
        return lacks(
            "V.P, V.L and V.S are not variables of the target; only some versions have them",
        );
    }
    Ok(all)
}
