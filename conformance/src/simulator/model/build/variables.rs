//! Builds and checks variables.

use std::collections::HashMap;

use ads_cnc::limits::{HANDLE_VALUE_MAX, NAME_MAX, NAME_VALUE_MAX, VARIABLE_MAX};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{
    CncString, DescriptionRef, ExtendedDescription, Handle, Kind, Synchronisation, TextRef,
    Validity, VariableAccess, VariablePath, VariableType,
};
use toml::Spanned;

use super::super::ModelError;
use super::super::document::VariableRow;
use super::super::error::Source;
use super::super::item::{Initial, InitialValues};
use super::super::types::TypeNames;
use super::super::variable::{Variable, Variables};
use super::items::DeclaredValue;
use super::parse::text;
use crate::number::{to_u32, to_usize};
use crate::text::plural;

/// Number of bytes that are reserved for a dot and the name of an axis, which follow the name of an
/// axis variable.
pub(super) const AXIS_NAME_MAX: usize = 64;

/// Builds and checks a variable.
fn variable(source: Source<'_>, row: &VariableRow, owners: usize) -> Result<Variable, ModelError> {
    let span = row.name.span();
    let name: CncString = text(source, &row.name)?;
    let path = VariablePath::from_text(name.as_cnc_str());
    let path = path.map_err(|error| source.error(&span, error))?;
    if !path.elements().is_empty() {
        return Err(source.error(&span, "expected the name of a variable, not of an element"));
    }
    let dimensions = row.dimensions.as_ref().map(|of| of.get_ref().clone()).unwrap_or_default();
    let mut count = dimensions.iter().map(|&elements| to_usize(elements));
    let count = count.try_fold(1_usize, |count, elements| count.checked_mul(elements));
    let Some(count) = count.filter(|&count| count > 0) else {
        let of = row.dimensions.as_ref().map(Spanned::span).unwrap_or(span);
        return Err(source.error(&of, "a dimension is 0, or there are too many elements"));
    };
    let (ty, initial) = DeclaredValue {
        source,
        types: TypeNames::Variable,
        of_type: &row.r#type,
        size: row.size.as_ref(),
        count: Some(count).filter(|_| !dimensions.is_empty()),
        value: row.value.as_ref(),
        values: row.values.as_ref(),
        max: VARIABLE_MAX,
        owners,
    }
    .read()?;
    let access = if row.writable { VariableAccess::READ_WRITE } else { VariableAccess::READ_ONLY };
    let extended = extended(source, row, path.kind() == Kind::V_E)?;
    let variable = Variable {
        handle: row.handle.as_ref().map(|handle| Handle(*handle.get_ref())),
        var_type: ty.data_type.var_type().unwrap_or(VariableType::STRING),
        access,
        dimensions,
        initial,
        extended,
        service: None,
        name,
    };
    // The codec checks the name and the dimensions.
    encodes(&description(&variable)).map_err(|why| source.error(&span, why))?;
    Ok(variable)
}

fn description(variable: &Variable) -> DescriptionRef<'_> {
    DescriptionRef {
        handle: Handle(0),
        var_type: variable.var_type,
        access: variable.access,
        size: to_u32(variable.initial.size),
        dimensions: variable.dimensions.as_slice().into(),
        name: TextRef::from(variable.name.as_cnc_str()),
    }
}

/// The extended description, which only V.E has; the defaults are the values in the example of the
/// manual.
fn extended(
    source: Source<'_>,
    row: &VariableRow,
    external: bool,
) -> Result<Option<ExtendedDescription>, ModelError> {
    if !external {
        return match row.synchronisation.as_ref().or(row.validity.as_ref()) {
            Some(given) => Err(source.error(&given.span(), "only V.E has extended descriptions")),
            None => Ok(None),
        };
    }
    let unknown = |given: &Spanned<String>, names: &str| {
        source.error(&given.span(), format!("expected {names}, found {:?}", given.get_ref()))
    };
    let synchronisation = match &row.synchronisation {
        None => Synchronisation::SYNCHRONIZED,
        Some(given) => match given.get_ref().as_str() {
            "NO_SYNC" => Synchronisation::NO_SYNC,
            "SYNCHRONIZED" => Synchronisation::SYNCHRONIZED,
            _ => return Err(unknown(given, "NO_SYNC or SYNCHRONIZED")),
        },
    };
    let validity = match &row.validity {
        None => Validity::GLOBAL,
        Some(given) => match given.get_ref().as_str() {
            "CHANNEL" => Validity::CHANNEL,
            "GLOBAL" => Validity::GLOBAL,
            _ => return Err(unknown(given, "CHANNEL or GLOBAL")),
        },
    };
    Ok(Some(ExtendedDescription { synchronisation, validity }))
}

/// Builds the variables of V.A. `owners` is the number of axes, which have the values, and of places,
/// which have the handles.
pub(super) fn of_axes(
    source: Source<'_>,
    rows: &[VariableRow],
    owners: usize,
) -> Result<Variables, ModelError> {
    let mut variables = Variables::default();
    for (number, row) in (0_u32..).zip(rows) {
        let span = row.name.span();
        let mut variable = variable(source, row, owners)?;
        if !starts_with(&variable.name, "V.A.") {
            return Err(source.error(&span, "expected a V.A variable"));
        }
        if variable.name.as_bytes().len() > NAME_MAX - AXIS_NAME_MAX {
            let why = format!("with the name of an axis, the name exceeds {NAME_MAX} characters");
            return Err(source.error(&span, why));
        }
        if variable.handle.is_none() && number > 0xFF {
            let why = "only the first 256 axis variables have a default handle; expected a handle";
            return Err(source.error(&span, why));
        }
        let handle = variable.handle.unwrap_or(Handle(0xC000_0000 | number));
        if handle.0 & 0x00FF_FF00 != 0 {
            let why = "expected 0 in bits 8 to 23, which are the place and the channel";
            return Err(source.error(&handle_span(row), why));
        }
        variable.handle = Some(handle);
        add(source, row, &mut variables, variable)?;
    }
    Ok(variables)
}

/// Builds the V.E, V.G and V.CYC variables of a channel and, if `service`, the five variables of
/// its Service Interface.
pub(super) fn of_channel(
    source: Source<'_>,
    number: u8,
    rows: &[VariableRow],
    service: bool,
) -> Result<Variables, ModelError> {
    let mut variables = Variables::default();
    let mut of_kinds = HashMap::new();
    for row in rows {
        let span = row.name.span();
        let mut variable = variable(source, row, 1)?;
        let named = |kind| starts_with(&variable.name, kind);
        let (external, global, cyclic) = (named("V.E."), named("V.G."), named("V.CYC."));
        if !(external || global || cyclic) {
            let why = "expected V.E, V.G or V.CYC; V.A variables belong to axes, and V.P, \
                       V.L and V.S are parameters";
            return Err(source.error(&span, why));
        }
        if cyclic {
            if let Some(handle) = &row.handle {
                return Err(
                    source.error(&handle.span(), "no handle: V.CYC is accessible by name only")
                );
            }
        } else {
            let index = of_kinds.entry(global).or_insert(0_u32);
            variable.handle.get_or_insert(handle(number, global, *index));
            *index += 1;
        }
        if let Some(values) = &row.values {
            return Err(
                source.error(&values.span(), "values is only for items with several instances")
            );
        }
        if service
            && ServiceVariable::ALL
                .iter()
                .any(|one| variable.name.as_bytes() == one.name().as_bytes())
        {
            return Err(source.error(&span, "the variables of the Service Interface are built in"));
        }
        add(source, row, &mut variables, variable)?;
    }
    let index = of_kinds.get(&true).copied().unwrap_or(0);
    for (index, one) in (index..).zip(ServiceVariable::ALL).filter(|_| service) {
        let place = variables.list.len();
        variables.by_name.insert(one.name().as_bytes().to_vec(), place);
        variables.list.push(service_variable(one, handle(number, true, index)));
    }
    Ok(variables)
}

/// The default handle of a V.G (`global`) or V.E variable, which is unique in its channel unless
/// another variable declares the same handle.
fn handle(channel: u8, global: bool, index: u32) -> Handle {
    let kind: u32 = if global { 0x8000_0000 } else { 0x4000_0000 };
    Handle(kind | u32::from(channel) << 22 | index)
}

fn service_variable(one: ServiceVariable, handle: Handle) -> Variable {
    let size = match one.var_type() {
        VariableType::STRING => ads_cnc::limits::SERVICE_TEXT_MAX,
        _ => 4,
    };
    Variable {
        name: one.name().parse().unwrap_or_default(),
        handle: Some(handle),
        var_type: one.var_type(),
        access: VariableAccess::READ_WRITE,
        dimensions: Vec::new(),
        initial: Initial { size, values: InitialValues::Same(vec![0; size]) },
        extended: None,
        service: Some(one),
    }
}

fn add(
    source: Source<'_>,
    row: &VariableRow,
    variables: &mut Variables,
    variable: Variable,
) -> Result<(), ModelError> {
    let size = variable.initial.size;
    // If a value without dimensions is writable, one request must be able to write it, also a
    // request with the name.
    let most = NAME_VALUE_MAX.saturating_sub(variable.name.as_bytes().len()).min(HANDLE_VALUE_MAX);
    if row.writable && variable.dimensions.is_empty() && size > most {
        let why = format!("{} of value; at most {most} can be written", plural(size, "byte"));
        return Err(source.error(&row.name.span(), why));
    }
    let place = variables.list.len();
    if variables.by_name.insert(variable.name.as_bytes().to_vec(), place).is_some() {
        return Err(
            source.error(&row.name.span(), format!("{} is configured twice", variable.name))
        );
    }
    variables.list.push(variable);
    Ok(())
}

pub(super) fn handle_span(row: &VariableRow) -> std::ops::Range<usize> {
    row.handle.as_ref().map_or_else(|| row.name.span(), Spanned::span)
}

fn starts_with(name: &CncString, kind: &str) -> bool {
    name.as_bytes().starts_with(kind.as_bytes())
}

/// Checks that a value can be encoded.
fn encodes(what: &impl ads_cnc::Encode) -> Result<(), String> {
    what.encode_to_vec().map(drop).map_err(|error| error.to_string())
}
