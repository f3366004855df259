//! Builds the configurations of the NC programs of a channel: of the streaming program, and of the
//! program that sends requests to services.

use std::time::Duration;

use ads_cnc::service::ServiceId;
use toml::{Spanned, Value};

use super::super::ModelError;
use super::super::document::{RequestRow, ServiceTable, StreamingTable};
use super::super::error::Source;
use super::parse::{text, time};
use crate::simulator::program::{
    Pace, ParsePaceError, ProgramConfig, Repeat, Script, ScriptConfig, ServiceRequest, Start, Wait,
};
use crate::text::some_time;

/// Builds the configuration of the streaming program. By default, the program restarts after each
/// program end, because no documented ADS function can start it.
pub(super) fn streaming(
    source: Source<'_>,
    table: &StreamingTable,
) -> Result<ProgramConfig, ModelError> {
    let mut config = ProgramConfig { start: Start::Again, ..ProgramConfig::default() };
    if let Some(file) = &table.file {
        config.name.clone_from(file);
    }
    if let Some(start) = &table.start {
        config.start = match start.get_ref().as_str() {
            "again" => Start::Again,
            "once" => Start::Once,
            "by-hand" => Start::ByHand,
            other => {
                let why = format!("expected again, once or by-hand, found {other:?}");
                return Err(source.error(&start.span(), why));
            }
        };
    }
    if let Some(given) = &table.pace {
        config.pace = pace(given.get_ref()).map_err(|why| source.error(&given.span(), why))?;
    }
    Ok(config)
}

fn pace(given: &Value) -> Result<Pace, ParsePaceError> {
    match given {
        Value::Integer(lines) => lines.to_string().parse(),
        Value::String(text) => text.parse(),
        _ => Err(ParsePaceError),
    }
}

/// Builds the configuration of the program that sends requests to services.
pub(super) fn service(
    source: Source<'_>,
    table: &ServiceTable,
) -> Result<ScriptConfig, ModelError> {
    let rows = table.requests.get_ref();
    if rows.is_empty() {
        return Err(source.error(&table.requests.span(), "expected at least one request"));
    }
    let repeat = match &table.times {
        Some(times) if *times.get_ref() == 0 => {
            return Err(source.error(&times.span(), "expected at least 1"));
        }
        Some(times) => Repeat::Times(*times.get_ref()),
        None => Repeat::Endless,
    };
    let pause = table.pause.as_ref().map(|given| time(source, given)).transpose()?;
    let cycle = table
        .cycle
        .as_ref()
        .map(|given| some_time(given.get_ref()).map_err(|why| source.error(&given.span(), why)));
    Ok(ScriptConfig {
        requests: rows.iter().map(|row| request(source, row)).collect::<Result<_, _>>()?,
        repeat,
        pause: pause.unwrap_or(Duration::from_secs(1)),
        cycle: cycle.transpose()?.unwrap_or(Duration::from_millis(1)),
    })
}

fn request(source: Source<'_>, row: &RequestRow) -> Result<ServiceRequest, ModelError> {
    let uuid = ServiceId::new(row.uuid.get_ref());
    let uuid = uuid.map_err(|error| source.error(&row.uuid.span(), error))?;
    let text = text(source, &row.request)?;
    let wait = row.wait.as_ref().map(Spanned::get_ref);
    let request = ServiceRequest {
        uuid,
        text,
        state: row.state.as_ref().map_or(1, |state| *state.get_ref()),
        wait: wait.map_or(Wait::Loop, |wait| Wait::Cycle { p1: wait.p1, p2: wait.p2, p3: wait.p3 }),
    };
    let alone = ScriptConfig {
        requests: vec![request.clone()],
        repeat: Repeat::Times(1),
        pause: Duration::ZERO,
        cycle: Duration::ZERO,
    };
    if let Err(invalid) = Script::new(alone) {
        // Find the position in the file of the value that is invalid.
        let timer = wait.is_some_and(|wait| wait.p2.is_some() && wait.p3.is_none());
        let span = match (&row.state, &row.wait) {
            (Some(state), _) if *state.get_ref() == 0 => state.span(),
            (_, Some(wait)) if timer => wait.span(),
            _ => row.request.span(),
        };
        return Err(source.error(&span, invalid.error));
    }
    Ok(request)
}
