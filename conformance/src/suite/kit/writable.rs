//! Values to which cases write, and whether the target accepts a request.

use ads_cnc::address::{Channel, ElementAddress};
use ads_cnc::operation::{
    HandleByName, ReadElementName, ReadElementType, ReadElementWriteFlag, Request, WriteByHandle,
    WriteByName,
};
use ads_cnc::sda::{ElementText, ElementWriteFlag};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{CncStr, Description, Handle, U32List, VariableAccess, VariableType};

use crate::judge::{Rule, Step, Stop, applicable};
use crate::objects::ValueAddress;
use crate::suite::kit::{Instance, NOTHING_WRITABLE, Probe, WriteCheck, name_of};

/// Whether a variable belongs to the Service Interface. Writes to these variables have side
/// effects, so only the cases of the Service Interface write them.
pub(crate) fn is_of_service(variable: &Description) -> bool {
    ServiceVariable::by_name(&variable.name.text.to_string()).is_some()
}

/// Calls a function for every variable that the cases read and that has this access, in every
/// claimed channel, except the variables of the Service Interface. If `judge` has noted no value
/// that may be written and recorded no check, the case ends as not applicable.
pub(crate) fn each_of_access(
    probe: &mut Probe<'_>,
    access: VariableAccess,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, &Description) -> Step,
) -> Step {
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            if variable.access == access && !is_of_service(&variable) {
                judge(probe, channel, &variable)?;
            }
        }
    }
    probe.finish(NOTHING_WRITABLE)
}

/// Whether the gate and the profile permit a write of a whole variable at this address. An array of
/// texts is not written as a whole: no document states how the texts follow each other, and a
/// device that keeps only the first one would lose the others.
pub(crate) fn may_write_whole(
    probe: &mut Probe<'_>,
    address: &ValueAddress,
    variable: &Description,
) -> Step<bool> {
    let is_text_array =
        variable.var_type == VariableType::STRING && !variable.dimensions.is_empty();
    Ok(!is_text_array && probe.may_write(address, &variable.name.text.to_string())?)
}

pub(crate) fn write_check<'t>(
    variable: &'t Description,
    what: &'t str,
    rules: &'t [Rule],
) -> WriteCheck<'t> {
    let is_text = variable.var_type == VariableType::STRING;
    WriteCheck { what, rules, is_text, name: Some(&variable.name.text) }
}

/// Requests the handle of a variable by its name, which also helps to confirm the handle to the
/// gate. If the target returns no handle, returns the handle in the description.
pub(crate) fn handle_of(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: &Description,
) -> Step<Handle> {
    let handle = probe.try_read::<Handle>(HandleByName { channel, name: name_of(variable) })?;
    Ok(handle.unwrap_or(variable.handle))
}

/// A writable number with its current value, which a rejected write must not change.
pub(crate) struct WritableNumber {
    pub(crate) channel: Channel,
    pub(crate) variable: Description,
    pub(crate) value: Vec<u8>,
}

impl WritableNumber {
    pub(crate) fn address(&self) -> ValueAddress {
        ValueAddress::Name { channel: self.channel, name: self.variable.name.text.clone() }
    }

    pub(crate) fn name(&self) -> CncStr<'_> {
        self.variable.name.text.as_cnc_str()
    }

    pub(crate) fn by_handle<'v>(&self, indices: U32List<'v>, value: &'v [u8]) -> Request<'v> {
        WriteByHandle::new(self.channel, self.variable.handle, indices, value).into()
    }

    pub(crate) fn by_name<'v>(&'v self, value: &'v [u8]) -> Request<'v> {
        WriteByName { channel: self.channel, name: self.name(), value: value.into() }.into()
    }
}

/// For each type except STRING, the first variable that may be written, can be read by name with
/// the described size, is not an array and does not belong to the Service Interface. Ends the case
/// as not applicable if there are none. Other cases judge the other variables.
pub(crate) fn writable_numbers(probe: &mut Probe<'_>) -> Step<Vec<WritableNumber>> {
    let mut all: Vec<WritableNumber> = Vec::new();
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            let is_number = variable.access == VariableAccess::READ_WRITE
                && variable.dimensions.is_empty()
                && variable.var_type != VariableType::STRING
                && !is_of_service(&variable);
            let of_type = all.iter().any(|known| known.variable.var_type == variable.var_type);
            let address = ValueAddress::Name { channel, name: variable.name.text.clone() };
            if !is_number
                || of_type
                || !probe.may_write(&address, &variable.name.text.to_string())?
            {
                continue;
            }
            let value = probe.value_at(&address)?.unwrap_or_default();
            if u32::try_from(value.len()) == Ok(variable.size) {
                all.push(WritableNumber { channel, variable, value });
            }
        }
    }
    applicable(!all.is_empty(), "no number may be written")?;
    Ok(all)
}

/// Whether the target accepts a request. A missing reply fails `rule` and ends the case.
pub(crate) fn is_taken(
    probe: &mut Probe<'_>,
    rule: impl Into<Rule>,
    what: &str,
    request: Request<'_>,
) -> Step<bool> {
    let exchange = probe.send(request)?;
    if exchange.reply().is_none() {
        let expected = || format!("a reply to {what}");
        probe.require(rule.into(), false, expected, &exchange)?;
    }
    Ok(exchange.success().is_some())
}

/// Ends the case as inconclusive unless the target accepts `valid`: the request that the caller
/// checks, but without the fault. A missing reply fails `rule` and ends the case.
pub(crate) fn require_taken(
    probe: &mut Probe<'_>,
    rule: impl Into<Rule>,
    valid: Request<'_>,
) -> Step {
    if is_taken(probe, rule, "the same request without the fault", valid)? {
        Ok(())
    } else {
        Err(Stop::inconclusive("the device rejects the same request without the fault too"))
    }
}

/// An element that the [gate](crate::gate) and the profile permit to write, with its name and
/// whether it is a text.
pub(crate) struct WritableElement {
    pub(crate) instance: Instance,
    pub(crate) element: ElementAddress,
    pub(crate) address: ValueAddress,
    pub(crate) what: String,
    pub(crate) is_text: bool,
}

/// Of the elements that the cases read, those that have this write flag and a readable length, and
/// that the gate and the profile permit to write. Elements at axis indices that have no axis, or
/// may have none, are left out.
pub(crate) fn elements_with_flag(
    probe: &mut Probe<'_>,
    is_writable: bool,
) -> Step<Vec<WritableElement>> {
    let mut all = Vec::new();
    for instance in probe.instances()? {
        if probe.is_at_empty_place(&instance) {
            continue;
        }
        for element in instance.elements() {
            all.extend(named(probe, &instance, element, is_writable)?);
        }
    }
    Ok(all)
}

fn named(
    probe: &mut Probe<'_>,
    instance: &Instance,
    element: ElementAddress,
    is_writable: bool,
) -> Step<Option<WritableElement>> {
    let text = |probe: &mut Probe<'_>, request: Request<'static>| -> Step<String> {
        let text: Option<ElementText> = probe.try_read(request)?;
        Ok(text.map(|text| text.text.text.to_string()).unwrap_or_default())
    };
    let flag: Option<ElementWriteFlag> = probe.try_read(ReadElementWriteFlag::new(element))?;
    if flag.map(ElementWriteFlag::is_writable) != Some(is_writable) {
        return Ok(None);
    }
    let Some(length) = probe.length_of(element)? else { return Ok(None) };
    let address = ValueAddress::of_element(element, length);
    let name = text(probe, ReadElementName::new(element).into())?;
    if address.read().is_err() || !probe.may_write(&address, &name)? {
        return Ok(None);
    }
    let is_text = text(probe, ReadElementType::new(element).into())? == "STRING";
    let (what, instance) = (format!("{name} of {instance}"), instance.clone());
    Ok(Some(WritableElement { instance, element, address, what, is_text }))
}
