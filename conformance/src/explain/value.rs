//! Makes the rows of an explanation from the bytes of a field.

use ads_cnc::address::IndexGroup;
use ads_cnc::ads::{AdsError, Command, StateFlags};
use ads_cnc::layout::{Segment, Stream, Type};
use ads_cnc::value::DataType;
use ads_cnc::{Synchronisation, Validity, VariableAccess, VariableType};

use super::codes::{self, number, quoted, text};
use super::explanation::{ExplainedFault, ExplainedField, ExplainedStream};
use super::typed;
use crate::number::to_usize;
use crate::text::plural;
use crate::value_format::ValueFormat;

/// Maximum length in bytes of a value of unknown type that is shown as every type of its size
/// except STRING.
const GUESSED: usize = 8;

/// Adds the rows of a segment to its part.
pub(super) fn add(
    part: &mut ExplainedStream,
    stream: Stream,
    segment: &Segment<'_>,
    values: &ValueFormat,
) {
    let mut row = row(segment);
    match segment.field.spec().map(|spec| spec.ty) {
        Some(Type::String) => row.value = text(segment.bytes),
        Some(Type::Bytes) if is_value(stream, &row.field) => {
            return value(part, row, segment.bytes, values);
        }
        Some(Type::Bytes) => row.value = plural(segment.bytes.len(), "byte"),
        Some(ty) => interpret(&mut row, stream, ty, segment.bytes),
        None => {}
    }
    part.rows.push(row);
}

/// The row of a segment, without its value.
pub(super) fn row(segment: &Segment<'_>) -> ExplainedField {
    let mut row = ExplainedField::new(
        to_usize(segment.offset),
        segment.bytes,
        segment.field.name(),
        String::new(),
    );
    (row.record, row.item) = (segment.record, segment.item);
    if let Some(spec) = segment.field.spec() {
        (row.ty, row.meaning, row.clause) = (spec.ty.to_string(), spec.meaning, spec.clause);
    }
    row
}

fn is_value(stream: Stream, field: &str) -> bool {
    field == "value" || stream == Stream::Content
}

/// Sets the value of a row to the number, BOOLEAN or NetId in `bytes`, and adds the meaning of a
/// code.
fn interpret(row: &mut ExplainedField, stream: Stream, ty: Type, bytes: &[u8]) {
    match (ty, bytes) {
        (Type::NetId, _) => {
            let numbers: Vec<String> = bytes.iter().map(u8::to_string).collect();
            row.value = numbers.join(".");
        }
        (Type::Real64, _) => {
            let bits = bytes.first_chunk().map_or(0, |le| u64::from_le_bytes(*le));
            row.value = format!("{:?}", f64::from_bits(bits));
        }
        (Type::Boolean, [byte]) => row.value = codes::boolean(*byte),
        _ => {
            let read = bytes.iter().rev().fold(0_u32, |sum, &byte| (sum << 8) | u32::from(byte));
            row.value = number(read);
            codes_of(row, stream, read);
        }
    }
}

/// Adds the meaning of a number to its row, if the field has known codes.
fn codes_of(row: &mut ExplainedField, stream: Stream, read: u32) {
    let low = u16::try_from(read).unwrap_or_default();
    let name = match (stream, row.field.as_str()) {
        (_, "index_group") if read == 0 => Some("none".to_owned()),
        (_, "index_group") => {
            row.value = format!("{read:#x}");
            row.notes.push(super::describe(IndexGroup::new(read)));
            None
        }
        (_, "index_offset" | "handle" | "id" | "invoke_id") => None,
        (Stream::AmsHeader, "target_port" | "source_port") => codes::port(low),
        (Stream::AmsHeader, "command") => {
            Some(codes::command(Command(low)).unwrap_or("no known command").to_owned())
        }
        (Stream::AmsHeader, "state_flags") => {
            row.value = format!("{read:#06x}");
            let name = codes::state_flags(StateFlags(low));
            Some(name.unwrap_or("neither request nor response").to_owned())
        }
        (_, "error" | "result") => {
            let known = codes::ads_error(AdsError(read));
            if read != 0 {
                row.notes.push("the error numbers of a CNC are not documented (ADS-7)".to_owned());
            }
            Some(known.unwrap_or("an error").to_owned())
        }
        (Stream::VariableDescription | Stream::VariableDescriptionByName, "type") => {
            Some(VariableType(read).name().unwrap_or("not a type of the manuals").to_owned())
        }
        (_, "access") => {
            Some(VariableAccess(read).name().unwrap_or("not a code of the manuals").to_owned())
        }
        (_, "synchronisation") => {
            Some(Synchronisation(read).name().unwrap_or("not a code of the manuals").to_owned())
        }
        (_, "validity") => {
            Some(Validity(read).name().unwrap_or("not a code of the manuals").to_owned())
        }
        (_, "write_access") => Some(if read == 0 { "read-only" } else { "writable" }.to_owned()),
        _ => None,
    };
    if let Some(name) = name {
        row.value = format!("{} {name}", row.value);
    }
}

/// Adds a value or content. If the type that the user has specified fits the bytes, adds a row for
/// each element; if it does not fit, one row and a fault. Without a type, adds one row with a note
/// that shows the bytes as the types that [`guesses`] finds.
fn value(part: &mut ExplainedStream, mut row: ExplainedField, all: &[u8], values: &ValueFormat) {
    let Some(ty) = values.ty else {
        row.value = plural(all.len(), "byte");
        let guesses = guesses(all);
        if !guesses.is_empty() {
            row.notes.push(format!("the stream does not contain the type; possible: {guesses}"));
        } else if !all.is_empty() {
            row.notes.push("the stream does not contain the type".to_owned());
        }
        part.rows.push(row);
        return;
    };
    // After indices, the value is a single element of the variable.
    let one = part.rows.iter().any(|before| before.field == "indices");
    let dimensions = if one { &[][..] } else { values.dimensions.as_slice() };
    match typed::elements(ty, dimensions, all) {
        Ok(elements) => {
            if dimensions.len() > 1 {
                part.notes.push("the last index changes fastest (VAR-21, assumed)".to_owned());
            }
            let (mut rest, mut at) = (all, row.offset);
            for (item, element) in (0..).zip(elements) {
                let (bytes, after) = rest.split_at_checked(element.len).unwrap_or((rest, &[]));
                let field = format!("{}{}", row.field, element.place);
                part.rows.push(ExplainedField {
                    item,
                    ty: ty.name().to_owned(),
                    meaning: if item == 0 { row.meaning } else { "" },
                    clause: row.clause,
                    ..ExplainedField::new(at, bytes, &field, element.value)
                });
                (rest, at) = (after, at.saturating_add(element.len));
            }
        }
        Err(error) => {
            // The error names another table, and its offset is relative to the value.
            row.value = plural(all.len(), "byte");
            let shape: String = dimensions.iter().map(|length| format!("[{length}]")).collect();
            let mut fault = ExplainedFault::of(&error, 0);
            let reason = fault.text.split_once(": ").map_or("", |(_, reason)| reason);
            let offset = row.offset.saturating_add(fault.offset);
            let (field, ty) = (row.field.clone(), ty.name());
            fault.text = format!("{field} at offset {offset}, as {ty}{shape}: {reason}");
            (fault.field, fault.offset) = (field, offset);
            part.rows.push(row);
            part.push_fault(fault);
        }
    }
}

/// Formats at most `GUESSED` bytes as each type of their size except STRING. Formats more bytes, up
/// to 128, as a STRING if all are graphic ASCII characters, spaces or NULs.
fn guesses(all: &[u8]) -> String {
    if all.is_empty() || all.len() > GUESSED {
        let shown = all.iter().all(|byte| byte.is_ascii_graphic() || matches!(byte, b' ' | 0));
        return if shown && !all.is_empty() && all.len() <= 128 {
            format!("STRING {}", quoted(all))
        } else {
            String::new()
        };
    }
    let mut all_of_them = Vec::new();
    let numbers = DataType::ALL.into_iter().filter(|ty| *ty != DataType::String);
    for ty in numbers {
        if let Ok(elements) = typed::elements(ty, &[], all) {
            let name = ty.name();
            all_of_them.extend(elements.into_iter().map(|one| format!("{name} {}", one.value)));
        }
    }
    all_of_them.join(", ")
}
