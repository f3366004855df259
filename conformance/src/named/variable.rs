//! Finds variables and parameters by their names.

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{CountVariables, DescribeByIndex, DescribeByName};
use ads_cnc::value::DataType;
use ads_cnc::{CncStr, CncString, DescriptionRef, Handle, Kind, VariablePath};

use super::Lookup;
use crate::number::to_usize;
use crate::objects::{ListedValue, ReportedAccess, ValueAddress, ValueList};
use crate::session::{Session, ToolError};
use crate::values::Type;

/// The kinds that the list of a found variable can name; any other kind is named `V`.
const KINDS: [&str; 4] = ["V.E", "V.G", "V.A", "V.CYC"];

/// Whether the name is that of a variable or a parameter.
pub(super) fn is_named(name: &str) -> bool {
    name.starts_with("V.") || kind_of_parameter(name).is_some()
}

fn kind_of_parameter(name: &str) -> Option<DynamicKind> {
    let of_prefix =
        [("V.L.", DynamicKind::VL), ("V.P.", DynamicKind::VP), ("V.S.", DynamicKind::VS)];
    if let Some((_, kind)) = of_prefix.into_iter().find(|(prefix, _)| name.starts_with(prefix)) {
        return Some(kind);
    }
    let number = name.strip_prefix('P')?;
    number.starts_with(|digit: char| digit.is_ascii_digit()).then_some(DynamicKind::P)
}

/// Describes the error in a name, and quotes the part of the name before the error.
fn reason(name: &str, error: &ads_cnc::Error) -> String {
    let error_text = error.to_string();
    let what = match error.kind() {
        ads_cnc::ErrorKind::Truncated if name.matches('[').count() > name.matches(']').count() => {
            "\"]\" is missing"
        }
        ads_cnc::ErrorKind::Truncated => "incomplete",
        _ => error_text.rsplit(": ").next().unwrap_or_default(),
    };
    // Each character is one byte in CP1252, so the offset of the error is in characters.
    let offset = to_usize(error.offset());
    let front: String = name.chars().take(offset).collect();
    if front.is_empty() {
        format!("{what}, at the beginning")
    } else {
        format!("{what}, after \"{front}\"")
    }
}

/// The variable or parameter with the address that its name determines; sends no request.
pub(super) fn unasked(lookup: &Lookup) -> Result<ListedValue, ToolError> {
    let Lookup { name, channel, axis, ty, .. } = lookup;
    let text: CncString = name.parse().map_err(ToolError::Unsendable)?;
    let hint = |ty: &Option<DataType>| ty.map_or(Type::UNKNOWN, Type::hinted);
    match (kind_of_parameter(name), axis) {
        (Some(kind), None) => match ty {
            Some(other) if *other != DataType::Real64 => Err(ToolError::Usage(format!(
                "{name} is a parameter, which is always a REAL64, not a {other}; omit --type"
            ))),
            _ => Ok(ListedValue::of_parameter(*channel, kind, text)),
        },
        _ => {
            let path = VariablePath::new(name).map_err(|error| {
                let indices = name.replace(',', "][");
                let hint = if indices != *name && VariablePath::new(&indices).is_ok() {
                    format!("; did you mean {indices}?")
                } else {
                    String::new()
                };
                let reason = reason(name, &error);
                ToolError::Usage(format!("{name} is not the name of a variable: {reason}{hint}"))
            })?;
            let kind = path.kind().text().to_string();
            if axis.is_some() && kind != "V.A" {
                let why = format!("--axis is for V.A variables only, and {name} is of {kind}");
                return Err(ToolError::Usage(why));
            }
            let kind = KINDS.into_iter().find(|known| *known == kind).unwrap_or("V");
            let list = ValueList::Variables {
                kind,
                channel: channel.number(),
                axis: axis.map(ChannelAxis::index),
            };
            let (channel, name) = (*channel, text.clone());
            let address = match *axis {
                Some(axis) => ValueAddress::Axis { channel, axis, name },
                None => ValueAddress::Name { channel, name },
            };
            Ok(ListedValue {
                list,
                address,
                name: text,
                ty: hint(ty),
                unit: None,
                access: ReportedAccess::Unknown,
                handle: None,
            })
        }
    }
}

/// The variable with the type of `lookup`. Without such a type, the type is that of the description
/// by name. For an axis, or if the CNC returns no description by name, it is that of the
/// descriptions by index. It is unknown if no description is found. A parameter has its fixed type.
pub(super) fn find(session: &mut Session, lookup: &Lookup) -> Result<ListedValue, ToolError> {
    let object = unasked(lookup)?;
    if lookup.ty.is_some() || matches!(object.address, ValueAddress::Parameter { .. }) {
        return Ok(object);
    }
    let (channel, axis) = (lookup.channel, lookup.axis);
    let path = VariablePath::from_text(object.name.as_cnc_str()).map_err(ToolError::Unsendable)?;
    let reason = match axis {
        None => described(session, channel, &path)?,
        Some(_) => None,
    };
    let reason = match reason {
        Some(reason) => Some(reason),
        None => {
            // Fail early if the variable does not exist.
            session.read(&object.address)?;
            listed(session, channel, &path, axis.is_some())?
        }
    };
    let Some(DescribedVariable { ty, access, handle }) = reason else { return Ok(object) };
    let indices = path.elements();
    let ty = if indices.is_empty() {
        ty
    } else {
        let invalid = |why| ToolError::Usage(format!("{}: {why}", path.text()));
        ty.element(indices).map_err(invalid)?
    };
    Ok(ListedValue { ty, access, handle, ..object })
}

/// The fields of a description that [`find`] uses.
struct DescribedVariable {
    ty: Type,
    access: ReportedAccess,
    handle: Option<Handle>,
}

/// Reads the description by name; `None` if the CNC returns an ADS error or a reply that cannot be
/// decoded: a CNC need not have this function, which is documented online only.
fn described(
    session: &mut Session,
    channel: Channel,
    path: &VariablePath<'_>,
) -> Result<Option<DescribedVariable>, ToolError> {
    let describe = DescribeByName { channel, name: path.variable().text().into() };
    match session.call(&describe) {
        Ok(variable) => Ok(Some(DescribedVariable {
            ty: Type::of_variable(variable.var_type, variable.dimensions, variable.size),
            access: ReportedAccess::of_variable(variable.access),
            // The handle is 0 if the variable is accessible by name only.
            handle: Some(variable.handle).filter(|handle| handle.0 != 0),
        })),
        Err(ToolError::Ads { .. } | ToolError::Reply(_)) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Searches the descriptions by index of the variable's kind; `None` for a kind without indices, if
/// no description has the name, and if the CNC returns an ADS error. The axis interface is assumed
/// to have the V.A variables of the channel interface, without the axis in their names.
fn listed(
    session: &mut Session,
    channel: Channel,
    path: &VariablePath<'_>,
    of_axis: bool,
) -> Result<Option<DescribedVariable>, ToolError> {
    let kind = path.kind();
    if ![Kind::V_E, Kind::V_G, Kind::V_A].iter().any(|known| known.text() == kind.text()) {
        return Ok(None);
    }
    let count = match session.call(&CountVariables::new(channel, kind)) {
        Ok(count) => count.0,
        Err(ToolError::Ads { .. }) => return Ok(None),
        Err(error) => return Err(error),
    };
    let wanted = path.variable();
    for index in 0..count {
        match session.call(&DescribeByIndex::new(channel, index, kind)) {
            Ok(variable) if is_it(&variable, wanted.text(), of_axis) => {
                return Ok(Some(DescribedVariable {
                    ty: Type::of_variable(variable.var_type, variable.dimensions, variable.size),
                    access: ReportedAccess::of_variable(variable.access),
                    // For an axis, the search ignores the axis in the name, so the handle may
                    // belong to another axis.
                    handle: Some(variable.handle).filter(|_| !of_axis),
                }));
            }
            Ok(_) | Err(ToolError::Reply(_)) => {}
            // The number of variables may have decreased in the meantime.
            Err(ToolError::Ads { .. }) => return Ok(None),
            Err(error) => return Err(error),
        }
    }
    Ok(None)
}

fn is_it(variable: &DescriptionRef<'_>, wanted: CncStr<'_>, of_axis: bool) -> bool {
    let name = variable.name.text();
    if of_axis {
        VariablePath::from_text(name)
            .and_then(|path| path.without_axis())
            .is_ok_and(|name| name.as_cnc_str() == wanted)
    } else {
        name == wanted
    }
}
