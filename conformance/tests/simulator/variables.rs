//! Checks of variables and dynamic parameters: replies are compared with the model and the internal
//! state of the CNC.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind, DynamicName, DynamicValue};
use ads_cnc::limits::TEXT_MAX;
use ads_cnc::operation::{
    CountDynamic, CountVariables, DescribeByIndex, DescribeExtended, DynamicNameByIndex,
    DynamicValueByIndex, DynamicValueByName, ReadByName, WriteByName,
};
use ads_cnc::{Description, ExtendedReply, Kind, VariableAccess, VariableCount};

use crate::checks::checks;
use crate::target::{CheckResult, TestCnc, ensure, same};

checks! {
    variables_are_described_as_configured,
    values_have_their_lowest_byte_first,
    variables_without_a_handle_are_written_by_name,
    parameters_come_and_go,
}

/// Compares the descriptions of all V.E and V.G variables of every channel with the model, and the
/// values of read-only variables.
fn variables_are_described_as_configured(target: &TestCnc) -> CheckResult {
    for number in target.channels() {
        let channel = Channel::new(number.into())?;
        let (external, global) = target.cnc().model().configured(number.into());
        for (kind, configured) in [(Kind::V_E, external), (Kind::V_G, global)] {
            let count = target.read::<VariableCount>(CountVariables::new(channel, kind))?.0;
            same(
                format_args!("the number of {kind:?}"),
                usize::try_from(count)?,
                configured.len(),
            )?;
            let mut described = Vec::new();
            for index in 0..count {
                let one = target.read::<Description>(DescribeByIndex::new(channel, index, kind))?;
                let extended =
                    target.read::<ExtendedReply>(DescribeExtended::new(channel, index, kind))?;
                described.push((one, extended));
            }
            for one in &configured {
                let name = &one.name;
                let found = described.iter().find(|(found, _)| found.name.text == *name);
                ensure(found.is_some(), format_args!("{name} is not described"))?;
                let Some((found, extended)) = found else { continue };
                same(name, found.var_type, one.var_type)?;
                same(name, found.access, one.access)?;
                same(name, usize::try_from(found.size)?, one.size)?;
                same(name, &found.dimensions[..], &one.dimensions[..])?;
                same(name, extended, &ExtendedReply(one.extended))?;
                if one.access == VariableAccess::READ_ONLY {
                    let name = one.name.as_cnc_str().into();
                    let value = target.ask(ReadByName { channel, name })??;
                    same(name.text(), &value, &one.value)?;
                }
            }
        }
    }
    Ok(())
}

fn values_have_their_lowest_byte_first(target: &TestCnc) -> CheckResult {
    for variable in target.cnc().current_variables() {
        let channel = Channel::new(variable.channel.into())?;
        if variable.var_type.element_size().is_some() && variable.name.as_bytes().len() < TEXT_MAX {
            let name = variable.name.as_cnc_str().into();
            let value = target.ask(ReadByName { channel, name })??;
            same(&variable.name, value, variable.value)?;
        }
    }
    for parameter in target.cnc().current_parameters() {
        let channel = Channel::new(parameter.channel.into())?;
        let (kind, name) = (parameter.kind, parameter.name.as_cnc_str().into());
        let value = target.ask(DynamicValueByName { channel, kind, name })??;
        same(&parameter.name, value, parameter.value.to_le_bytes().to_vec())?;
    }
    Ok(())
}

fn variables_without_a_handle_are_written_by_name(target: &TestCnc) -> CheckResult {
    let mut written = 0;
    for number in target.channels() {
        let channel = Channel::new(number.into())?;
        for name in target.cnc().written_by_name_only(number) {
            let read = ReadByName { channel, name: name.as_cnc_str().into() };
            let new: Vec<u8> = target.ask(read)??.iter().map(|byte| byte ^ 1).collect();
            let name = name.as_cnc_str();
            target.ask(WriteByName { channel, name, value: new[..].into() })??;
            same(name, target.ask(read)??, new)?;
            written += 1;
        }
    }
    ensure(written > 0, "no such variable")
}

/// Number of parameters, which is larger than fits into a byte.
const MANY: u32 = 300;

const fn prefix(kind: DynamicKind) -> &'static str {
    match kind {
        DynamicKind::P => "P",
        DynamicKind::VL => "V.L.",
        DynamicKind::VP => "V.P.",
        DynamicKind::VS => "V.S.",
    }
}

/// The name and the value of the parameter at an index of the list.
fn parameter(kind: DynamicKind, place: u32) -> (String, f64) {
    let mut name = format!("{}{place}", prefix(kind));
    // Each tenth name has the maximum length, including the NUL.
    if place.is_multiple_of(10) {
        name += &"x".repeat(95 - name.len());
    }
    // The values have various magnitudes, and many digits.
    let value = match place % 4 {
        0 => f64::from(place) * 1e-300,
        1 => f64::from(place) / 3.0,
        2 => f64::from(place) * -1e200,
        _ => f64::from(place) + 0.125,
    };
    (name, value)
}

/// Sets and deletes parameters in the last channel, as an NC program does.
fn parameters_come_and_go(target: &TestCnc) -> CheckResult {
    let number = *target.channels().last().expect("a channel");
    let channel = Channel::new(number.into())?;
    for kind in DynamicKind::ALL {
        let set = |all: &[(String, f64)]| -> CheckResult {
            let named: Vec<(&str, f64)> =
                all.iter().map(|(name, value)| (name.as_str(), *value)).collect();
            target.cnc().set_parameters(number, kind, &named)?;
            are_listed(target, channel, kind, all)
        };
        let mut all: Vec<(String, f64)> = (1..=MANY).map(|place| parameter(kind, place)).collect();
        set(&all)?;
        // After the first parameter is deleted, the indices of the others are one less.
        let (gone, _) = all.remove(0);
        set(&all)?;
        let by_name = target.ask(DynamicValueByName::new(channel, kind, &gone)?)?;
        ensure(by_name.is_err(), format_args!("{gone}, which is deleted, has a value"))?;
        all.insert(0, (format!("{}7654", prefix(kind)), -7.5));
        set(&all)?;
        set(&[])?;
    }
    Ok(())
}

/// Checks the number of parameters, and the names and values at some indices, such as the ends of
/// the list.
fn are_listed(
    target: &TestCnc,
    channel: Channel,
    kind: DynamicKind,
    all: &[(String, f64)],
) -> CheckResult {
    let count = target.read::<DynamicCount>(CountDynamic::new(channel, kind))?.0;
    same(format_args!("the number of {kind:?}"), usize::try_from(count)?, all.len())?;
    for index in [1, 2, 10, 11, 127, 128, 255, 256, 257, count] {
        let Some((name, value)) = (index as usize).checked_sub(1).and_then(|at| all.get(at)) else {
            continue;
        };
        let by_index = DynamicNameByIndex::new(channel, kind, index)?;
        let at_index = |read: DynamicName| read.name.text.to_string();
        same(format_args!("the name at {index}"), at_index(target.read(by_index)?), name.clone())?;
        // A request that is rejected does not affect later replies.
        target.ask(DynamicNameByIndex::new(channel, kind, count + 1)?)?.err();
        same(format_args!("the name at {index}"), at_index(target.read(by_index)?), name.clone())?;
        let by_name = target.read::<DynamicValue>(DynamicValueByName::new(channel, kind, name)?)?;
        let by_index =
            target.read::<DynamicValue>(DynamicValueByIndex::new(channel, kind, index)?)?;
        same(name, (by_name.get(), by_index.get()), (*value, *value))?;
    }
    Ok(())
}
