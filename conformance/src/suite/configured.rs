//! Cases that compare the simulated CNC with its model, which cannot be read over ADS.

use std::collections::HashMap;

use ads_cnc::address::Channel;
use ads_cnc::operation::{CountVariables, DescribeByIndex, DescribeExtended, ReadByName};
use ads_cnc::{Description, ExtendedReply, Kind, VariableAccess, VariableCount};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, VARIABLES_MAX};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step};
use crate::simulator::ConfiguredVariable;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("var-as-configured",
        &[VAR_2, VAR_3, VAR_4, VAR_5, VAR_6, VAR_7, VAR_8, VAR_14, VAR_15, VAR_16],
        Needs::Simulator, as_configured,
        "V.E and V.G are described, and what is READ_ONLY is read, as they are configured"),
];

fn as_configured(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    for channel in probe.channels()? {
        let (external, global) = cnc.model().configured(channel.number().into());
        for (kind, configured) in [(Kind::V_E, external), (Kind::V_G, global)] {
            let found = listed(probe, channel, kind)?;
            let number = || format!("{} of channel {}", configured.len(), channel.number());
            let same = found.len() == configured.len();
            probe.check(VAR_2, same, number, found.len());
            for one in &configured {
                let found = found.get(&one.name.to_string());
                let expected = || format!("a description of {}", one.name);
                probe.check(VAR_3, found.is_some(), expected, "none");
                let Some((described, extended)) = found else { continue };
                compare_description(probe, one, described);
                let shown = |extended: &ExtendedReply| format!("{extended:?} of {}", one.name);
                let expected = ExtendedReply(one.extended);
                let rule = if one.extended.is_some() { VAR_15 } else { VAR_16 };
                // That a variable without it is answered with success is assumed.
                let none = one.extended.is_none() && extended.is_none();
                let same = none || extended.as_ref() == Some(&expected);
                let found = extended.as_ref().map_or_else(|| "none".to_owned(), shown);
                probe.check(rule, same, shown(&expected), found);
                if one.access == VariableAccess::READ_ONLY {
                    let name = one.name.as_cnc_str().into();
                    let value = probe.try_ask(ReadByName { channel, name })?.unwrap_or_default();
                    let expected = || format!("{} of {}", Hex(one.value.clone()), one.name);
                    probe.check(VAR_14, value == one.value, expected, || Hex(value));
                }
            }
        }
    }
    Ok(())
}

type Described = HashMap<String, (Description, Option<ExtendedReply>)>;

/// The descriptions by name, each with the extended description of the same index.
fn listed(probe: &mut Probe<'_>, channel: Channel, kind: Kind<'_>) -> Step<Described> {
    let count: Option<VariableCount> = probe.try_read(CountVariables::new(channel, kind))?;
    let mut all = HashMap::new();
    for index in 0..count.map_or(0, |count| count.0.min(VARIABLES_MAX)) {
        let found: Option<Description> =
            probe.try_read(DescribeByIndex::new(channel, index, kind))?;
        let Some(found) = found else { continue };
        let extended = probe.try_read(DescribeExtended::new(channel, index, kind))?;
        all.insert(found.name.text.to_string(), (found, extended));
    }
    Ok(all)
}

fn compare_description(probe: &mut Probe<'_>, one: &ConfiguredVariable, found: &Description) {
    let name = &one.name;
    let expected = || format!("{:?} of {name}", one.var_type);
    let same = found.var_type == one.var_type;
    probe.check(VAR_5, same, expected, || format!("{:?}", found.var_type));
    let expected = || format!("{:?} of {name}", one.access);
    let same = found.access == one.access;
    probe.check(VAR_6, same, expected, || format!("{:?}", found.access));
    let expected = || format!("{} bytes of {name}", one.size);
    let same = usize::try_from(found.size) == Ok(one.size);
    probe.check(VAR_8, same, expected, found.size);
    let expected = || format!("{:?} of {name}", one.dimensions);
    let rule = if one.dimensions.is_empty() { VAR_7 } else { VAR_4 };
    let same = found.dimensions == one.dimensions;
    probe.check(rule, same, expected, || format!("{:?}", found.dimensions));
}
