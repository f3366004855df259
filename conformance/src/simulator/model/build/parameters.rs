//! Builds and checks dynamic parameters.

use std::collections::{BTreeSet, HashMap};

use ads_cnc::dynamic::{DynamicKind, DynamicValue};
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::{CncString, VariablePath};
use toml::Spanned;

use super::super::document::ParameterRow;
use super::super::error::Source;
use super::super::item::{Item, Objects};
use super::super::{ModelError, Parameter, Times};
use super::parse::{text, time};
use crate::text::plural;

/// Maximum number of parameters of a channel: a request for one of them examines all, and others wait
/// meanwhile.
const PARAMETERS_MAX: usize = 10_000;

/// Builds the parameters of a channel. `objects` are the objects of the channel, which the key
/// `while` of a parameter can name.
pub(super) fn of_channel(
    source: Source<'_>,
    rows: &[ParameterRow],
    objects: &Objects,
) -> Result<Vec<Parameter>, ModelError> {
    if let Some(row) = rows.get(PARAMETERS_MAX) {
        let count = plural(rows.len(), "parameter");
        let why = format!("{count} of a channel; the maximum is {PARAMETERS_MAX}");
        return Err(source.error(&row.name.span(), why));
    }
    let (mut parameters, mut names) = (Vec::new(), BTreeSet::new());
    // In reverse, so that the first of several objects with the same name remains.
    let named = objects.items.iter().enumerate().rev();
    let named: HashMap<String, (usize, &Item)> =
        named.map(|(place, item)| (item.name.to_string(), (place, item))).collect();
    for row in rows {
        let span = row.name.span();
        let name = text(source, &row.name)?;
        let kind = kind(&name).map_err(|why| source.error(&span, why))?;
        let needs = row.r#while.as_ref().map(|object| {
            let why = match named.get(object.get_ref()) {
                // Each request compares the object with 0, which takes long for a long text.
                Some((_, item)) if item.is_text() => {
                    format!("expected an object with a number; {:?} is a STRING", object.get_ref())
                }
                Some((place, _)) => return Ok(*place),
                None => format!("the channel has no own object {:?}", object.get_ref()),
            };
            Err(source.error(&object.span(), why))
        });
        if !names.insert(name.clone()) {
            return Err(source.error(&span, format!("{name} is configured twice")));
        }
        let (value, needs) = (DynamicValue::from(row.value), needs.transpose()?);
        let times = times(source, row)?;
        parameters.push(Parameter { kind, name, value, needs, times });
    }
    Ok(parameters)
}

fn times(source: Source<'_>, row: &ParameterRow) -> Result<Times, ModelError> {
    let time = |given: &Option<Spanned<String>>| {
        given.as_ref().map(|given| time(source, given)).transpose()
    };
    let (comes, goes, period) = (time(&row.comes)?, time(&row.goes)?, time(&row.period)?);
    let times = Times::new(comes.unwrap_or_default(), goes, period);
    times.map_err(|why| {
        let last = row.period.as_ref().or(row.goes.as_ref()).or(row.comes.as_ref());
        source.error(&last.map_or_else(|| row.name.span(), Spanned::span), why)
    })
}

/// The kind of the parameter with this name; an error message if the name is too long, or if no
/// kind has such names.
pub(in crate::simulator) fn kind(name: &CncString) -> Result<DynamicKind, String> {
    if name.as_bytes().len() >= DYNAMIC_NAME_MAX {
        return Err(format!(
            "expected a name of at most {DYNAMIC_NAME_MAX} bytes, including a NUL"
        ));
    }
    if let Some(rest) = name.as_bytes().strip_prefix(b"P")
        && !rest.is_empty()
    {
        return Ok(DynamicKind::P);
    }
    let kind = [DynamicKind::VL, DynamicKind::VP, DynamicKind::VS].into_iter().find(|kind| {
        let path = VariablePath::from_text(name.as_cnc_str());
        path.is_ok_and(|path| path.kind().text().to_string() == kind.to_string())
    });
    kind.ok_or_else(|| "expected a name that begins with P, V.L., V.P. or V.S.".to_owned())
}
