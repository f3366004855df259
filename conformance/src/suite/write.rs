//! Cases that write variables, and undo it.

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::operation::{AxisHandleByName, HandleByName, Request, WriteByHandle, WriteByName};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{
    CncString, Decode as _, Description, Handle, Numbers, VariableAccess, VariablePath,
    VariableType,
};
use ads_cnc_vectors::Hex;

use super::case::{Case, Rule, Step, Stop, assumed};
use super::declare;
use super::names::dynamic_among_variables;
use super::place::{Place, Trial};
use super::probe::{Probe, harness};
use super::variable::name_of;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "write-by-handle",
            "What is written by a handle is read back, and the old value after it",
            ["VAR-6", "VAR-10", "VAR-12", "VAR-17"],
            Writes,
            by_handle
        ),
        declare!(
            "write-by-name",
            "What is written by a name is read back by name and by handle",
            ["VAR-6", "VAR-13", "VAR-17"],
            Writes,
            by_name
        ),
        declare!(
            "write-elements-by-handle",
            "An index writes the element of that place, and no other",
            ["VAR-12"],
            Writes,
            elements_by_handle
        ),
        declare!(
            "write-elements-by-name",
            "A name with [index] writes the element of that place, and no other",
            ["VAR-13", "VAR-20"],
            Writes,
            elements_by_name
        ),
        declare!(
            "write-axis-variable",
            "What is written on the axis interface is read with the axis behind the name",
            ["VAR-17", "VAR-26"],
            Writes,
            axis_variables
        ),
        declare!(
            "write-by-name-only",
            "What is by name only is written by its name",
            ["VAR-18"],
            Writes,
            by_name_only
        ),
        declare!(
            "write-dynamic-by-name",
            "V.P, V.L and V.S are written among the variables, by name",
            ["VAR-19"],
            Writes,
            dynamic_by_name
        ),
        declare!(
            "write-read-only",
            "A variable that is READ_ONLY takes no value",
            ["VAR-6"],
            Writes,
            read_only
        ),
        declare!(
            "write-wrong-size",
            "A value of another size than the variable's is answered by an error",
            ["VAR-12", "VAR-13"],
            MalformedWrites,
            wrong_size
        ),
        declare!(
            "write-unknown",
            "What is not there takes no value",
            ["VAR-12", "VAR-13", "ADS-4"],
            MalformedWrites,
            unknown
        ),
    ]
}

/// What writing a variable of the Service Interface leads to has cases of its own.
fn is_of_service(variable: &Description) -> bool {
    ServiceVariable::by_name(&variable.name.text.to_string()).is_some()
}

/// Every variable of this access of every channel.
fn each(
    probe: &mut Probe<'_>,
    access: VariableAccess,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, &Description) -> Step<bool>,
) -> Step {
    let mut any = false;
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            if variable.access == access && !is_of_service(&variable) {
                any |= judge(probe, channel, &variable)?;
            }
        }
    }
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("nothing of it may be written".to_owned())),
    }
}

fn trial<'t>(variable: &Description, what: &'t str, rules: &'t [Rule]) -> Trial<'t> {
    let is_text = variable.var_type == VariableType::STRING;
    Trial { what, rules, is_text }
}

/// The handle of a name, asked for by it: a file that names it allows the handle then.
fn handle_of(probe: &mut Probe<'_>, channel: Channel, variable: &Description) -> Step<Handle> {
    let data = probe.try_ask(HandleByName { channel, name: name_of(variable) })?;
    let handle = data.and_then(|data| Handle::decode(&data).ok());
    Ok(handle.unwrap_or(variable.handle))
}

fn by_handle(probe: &mut Probe<'_>) -> Step {
    each(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let handle = handle_of(probe, channel, variable)?;
        let place = Place::Handle { channel, handle, indices: Vec::new() };
        let name = variable.name.text.to_string();
        if !probe.may_write(&place, &name)? {
            return Ok(false);
        }
        let rules = ["VAR-12", "VAR-17", "VAR-6", "VAR-10"].map(Rule::from);
        probe.try_write(&trial(variable, &name, &rules), &place, |_, _, _| Ok(()))?;
        Ok(true)
    })
}

fn by_name(probe: &mut Probe<'_>) -> Step {
    each(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let place = Place::Name { channel, name: variable.name.text.clone() };
        let name = variable.name.text.to_string();
        if !probe.may_write(&place, &name)? {
            return Ok(false);
        }
        let handle = variable.handle;
        let by_handle = Place::Handle { channel, handle, indices: Vec::new() };
        let rules = ["VAR-13", "VAR-17", "VAR-6"].map(Rule::from);
        probe.try_write(&trial(variable, &name, &rules), &place, |probe, _, new| {
            let read = probe.value_at(&by_handle)?.unwrap_or_default();
            let same = read == new || variable.var_type == VariableType::STRING;
            let expected = format!("{} of {name} by its handle", Hex(new.to_vec()));
            probe.check("VAR-13", same, expected, Hex(read));
            Ok(())
        })?;
        Ok(true)
    })
}

/// The first and the last place of an array.
fn ends(variable: &Description) -> Vec<Vec<u32>> {
    let first = vec![0; variable.dimensions.len()];
    let last = variable.dimensions.iter().map(|n| n.saturating_sub(1)).collect();
    if first == last { vec![first] } else { vec![first, last] }
}

fn elements(
    probe: &mut Probe<'_>,
    rules: impl Fn(&Description) -> Vec<Rule>,
    place_of: impl Fn(&mut Probe<'_>, Channel, &Description, Vec<u32>) -> Step<Option<Place>>,
) -> Step {
    each(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let mut any = false;
        let whole = Place::Handle { channel, handle: variable.handle, indices: Vec::new() };
        let arrays = if variable.dimensions.is_empty() { Vec::new() } else { ends(variable) };
        for indices in arrays {
            let name = format!("{}{indices:?}", variable.name.text);
            let at_end = indices.iter().any(|&index| index > 0);
            let Some(place) = place_of(probe, channel, variable, indices)? else { continue };
            if !probe.may_write(&place, &variable.name.text.to_string())? {
                continue;
            }
            any = true;
            let before = probe.value_at(&whole)?.unwrap_or_default();
            let rules = rules(variable);
            let trial = trial(variable, &name, &rules);
            probe.try_write(&trial, &place, |probe, old, new| {
                // The one element, at its end of the whole, and nothing else.
                let mut expected = before.clone();
                let size = old.len();
                let start = if at_end { expected.len().saturating_sub(size) } else { 0 };
                let part = expected.get_mut(start..start.saturating_add(size));
                part.unwrap_or_default().iter_mut().zip(new).for_each(|(byte, new)| *byte = *new);
                let after = probe.value_at(&whole)?.unwrap_or_default();
                for &rule in trial.rules {
                    let shown = Hex(expected.clone());
                    probe.check(rule, after == expected, shown, Hex(after.clone()));
                }
                Ok(())
            })?;
        }
        Ok(any)
    })
}

/// More dimensions than one are assumed, and how texts lie in an array.
fn of_order(variable: &Description, ids: &[&'static str]) -> Vec<Rule> {
    let is_assumed = variable.dimensions.len() > 1 || variable.var_type == VariableType::STRING;
    ids.iter().map(|&id| if is_assumed { assumed(id) } else { id.into() }).collect()
}

fn elements_by_handle(probe: &mut Probe<'_>) -> Step {
    let rules = |variable: &Description| of_order(variable, &["VAR-12"]);
    elements(probe, rules, |probe, channel, variable, indices| {
        let handle = handle_of(probe, channel, variable)?;
        Ok(Some(Place::Handle { channel, handle, indices }))
    })
}

fn elements_by_name(probe: &mut Probe<'_>) -> Step {
    let rules = |variable: &Description| of_order(variable, &["VAR-13", "VAR-20"]);
    elements(probe, rules, |_, channel, variable, indices| {
        let path = VariablePath::from_text(variable.name.text.as_cnc_str()).ok();
        let name = path.and_then(|path| path.element(indices.as_slice().into()).ok());
        Ok(name.map(|name| Place::Name { channel, name }))
    })
}

/// The most places of a channel that are looked at.
const PLACES_MAX: u32 = 64;

fn axis_variables(probe: &mut Probe<'_>) -> Step {
    each(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let path = VariablePath::from_text(variable.name.text.as_cnc_str()).ok();
        let path = path.filter(|path| path.axis().is_some());
        let Some(name) = path.and_then(|path| path.without_axis().ok()) else { return Ok(false) };
        for place in 1..=PLACES_MAX {
            let axis = ChannelAxis::new(place).map_err(harness)?;
            let request = AxisHandleByName { channel, axis, name: name.as_cnc_str().into() };
            let Some(data) = probe.try_ask(request)? else { break };
            if Handle::decode(&data) != Ok(variable.handle) {
                continue;
            }
            let at = Place::Axis { channel, axis, name: name.clone() };
            if !probe.may_write(&at, &name.to_string())? {
                break;
            }
            let named = Place::Name { channel, name: variable.name.text.clone() };
            let what = format!("{name} of place {place}");
            let rules = ["VAR-26", "VAR-17"].map(Rule::from);
            probe.try_write(&trial(variable, &what, &rules), &at, |probe, _, new| {
                let read = probe.value_at(&named)?.unwrap_or_default();
                let expected = format!("{} of {}", Hex(new.to_vec()), variable.name.text);
                probe.check("VAR-26", read == new, expected, Hex(read));
                Ok(())
            })?;
            return Ok(true);
        }
        Ok(false)
    })
}

/// Writes what has no handle. That it may be written is not said, but for "with restrictions".
fn by_names(probe: &mut Probe<'_>, rule: &'static str, names: Vec<CncString>) -> Step {
    let channel = probe.channel()?;
    let mut any = false;
    for name in names {
        let what = name.to_string();
        let place = Place::Name { channel, name };
        if probe.may_write(&place, &what)? {
            any = true;
            let rules = [assumed(rule)];
            let trial = Trial { what: &what, rules: &rules, is_text: false };
            probe.try_write(&trial, &place, |_, _, _| Ok(()))?;
        }
    }
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("nothing of it may be written".to_owned())),
    }
}

fn by_name_only(probe: &mut Probe<'_>) -> Step {
    let names = probe.session.profile.by_name_only.clone();
    let names: Result<Vec<CncString>, _> = names.iter().map(|name| name.parse()).collect();
    by_names(probe, "VAR-18", names.map_err(harness)?)
}

fn dynamic_by_name(probe: &mut Probe<'_>) -> Step {
    let all = dynamic_among_variables(probe)?;
    by_names(probe, "VAR-19", all.into_iter().map(|(_, name)| name).collect())
}

/// Something that may be written, to hold a refusal against.
fn writable(probe: &mut Probe<'_>) -> Step<(Channel, Description)> {
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            let place = Place::Name { channel, name: variable.name.text.clone() };
            let is_writable = variable.access == VariableAccess::READ_WRITE
                && variable.dimensions.is_empty()
                && variable.var_type != VariableType::STRING
                && !is_of_service(&variable);
            if is_writable && probe.may_write(&place, &variable.name.text.to_string())? {
                return Ok((channel, variable));
            }
        }
    }
    Err(Stop::NotApplicable("no number may be written".to_owned()))
}

fn read_only(probe: &mut Probe<'_>) -> Step {
    let (at, known) = writable(probe)?;
    let sibling = Place::Name { channel: at, name: known.name.text.clone() };
    each(probe, VariableAccess::READ_ONLY, |probe, channel, variable| {
        let name = variable.name.text.to_string();
        let handle = handle_of(probe, channel, variable)?;
        let mut any = false;
        for place in [
            Place::Name { channel, name: variable.name.text.clone() },
            Place::Handle { channel, handle, indices: Vec::new() },
        ] {
            if probe.may_write(&place, &name)? {
                any = true;
                let rules = [Rule::from("VAR-6")];
                probe.write_refused(&trial(variable, &name, &rules), &place, Some(&sibling))?;
            }
        }
        Ok(any)
    })
}

/// Sends a write that must be refused, and one that differs by the fault only and must not be.
fn refused(
    probe: &mut Probe<'_>,
    rule: Rule,
    what: &str,
    bad: Request<'_>,
    good: Request<'_>,
) -> Step {
    let accepted = probe.send(good)?;
    if accepted.answer().is_none_or(|answer| answer.success().is_none()) {
        let why = format!("what differs by that alone is refused too: {}", accepted.result());
        return Err(Stop::Inconclusive(why));
    }
    let exchange = probe.send(bad)?;
    let refused = exchange.answer().is_some_and(|answer| answer.success().is_none());
    probe.check(rule, refused, format!("an error number for {what}"), exchange.result());
    probe.send(good).map(drop)
}

fn wrong_size(probe: &mut Probe<'_>) -> Step {
    let (channel, known) = writable(probe)?;
    let name = known.name.text.as_cnc_str();
    let place = Place::Name { channel, name: known.name.text.clone() };
    let Some(value) = probe.value_at(&place)? else { return Ok(()) };
    let longer = [&value[..], &[0]].concat();
    let shorter = value.get(1..).unwrap_or_default();
    for other in [&longer[..], shorter, &[]] {
        let what = format!("{} bytes for the {} of {name}", other.len(), value.len());
        let by_handle = |value| WriteByHandle::new(channel, known.handle, Numbers::EMPTY, value);
        let (bad, good) = (by_handle(other).into(), by_handle(&value).into());
        refused(probe, assumed("VAR-12"), &what, bad, good)?;
        let by_name = |value| WriteByName { channel, name, value };
        refused(probe, assumed("VAR-13"), &what, by_name(other).into(), by_name(&value).into())?;
    }
    Ok(())
}

fn unknown(probe: &mut Probe<'_>) -> Step {
    let (channel, known) = writable(probe)?;
    let name = known.name.text.as_cnc_str();
    let place = Place::Name { channel, name: known.name.text.clone() };
    let Some(value) = probe.value_at(&place)? else { return Ok(()) };
    let variables = probe.variables(channel)?;
    let free =
        [0, 1, u32::MAX].into_iter().find(|&free| variables.iter().all(|one| one.handle.0 != free));
    let by_handle = |handle, indices: &'static [u32]| {
        Request::from(WriteByHandle::new(channel, handle, indices.into(), &value))
    };
    let good = by_handle(known.handle, &[]);
    if let Some(free) = free {
        let what = format!("a write to the handle {free:#x}");
        refused(probe, "ADS-4".into(), &what, by_handle(Handle(free), &[]), good)?;
    }
    refused(probe, "VAR-12".into(), "an index of no array", by_handle(known.handle, &[0]), good)?;
    let by_name = |name| Request::from(WriteByName { channel, name, value: &value });
    let good = by_name(name);
    for unknown in ["V.E.no such variable", ""] {
        let what = format!("a write to the name {unknown:?}");
        let bad = by_name(ads_cnc::CncStr::new(unknown).map_err(harness)?);
        refused(probe, "ADS-4".into(), &what, bad, good)?;
    }
    let element: CncString = format!("{name}[0]").parse().map_err(harness)?;
    refused(probe, "VAR-13".into(), "an element of no array", by_name(element.as_cnc_str()), good)
}
