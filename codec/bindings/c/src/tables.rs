//! The tables: functions, streams, fields and types, by number and by name.

use codec::layout::{Field, FieldSpec, Size, Stream, Type};
use codec::operation::{AdsService, Effect, Function, GroupRule, OffsetRule};
use codec::value::DataType;

use crate::ADS_CNC_NONE;
use crate::memory::{AdsCncBytes, bytes, put, to_u32, to_usize};
use crate::request::operation_name;

/// A function of the CNC.
#[repr(C)]
pub struct AdsCncFunctionInfo {
    /// The name in reports, such as "read variable value by name".
    pub name: AdsCncBytes,
    /// The name in programs, such as "ReadByName".
    pub operation: AdsCncBytes,
    /// The AMS port of its task.
    pub port: u32,
    /// The AMS command: 2 Read, 3 Write, 9 ReadWrite.
    pub command: u32,
    /// `ADS_CNC_EFFECT_NONE` and so on.
    pub effect: u32,
    /// The stream of the request; `ADS_CNC_NONE` if it has no data.
    pub request: u32,
    /// The stream of the reply; `ADS_CNC_NONE` if it has no data.
    pub reply: u32,
    /// The number of arguments.
    pub argument_count: u32,
    /// The arguments: `ADS_CNC_CHANNEL` and so on.
    pub arguments: [u32; 8],
}

/// A stream.
#[repr(C)]
pub struct AdsCncStreamInfo {
    /// The name, such as "variable-description".
    pub name: AdsCncBytes,
    /// A short description.
    pub title: AdsCncBytes,
    /// The maximum length in bytes.
    pub max: u32,
    /// The number of fields.
    pub field_count: u32,
    /// 1 if the stream consists of one or more records with these fields.
    pub repeats: u32,
}

/// A field of a stream.
#[repr(C)]
pub struct AdsCncFieldInfo {
    /// The name.
    pub name: AdsCncBytes,
    /// A short description.
    pub meaning: AdsCncBytes,
    /// The ID of the requirement that defines the field.
    pub clause: AdsCncBytes,
    /// `ADS_CNC_NUMBER` and so on.
    pub kind: u32,
    /// The size of the field or of one item of a list in bytes; 0 if it varies.
    pub size: u32,
    /// 1 if the field counts the items or bytes of the next one.
    pub is_count: u32,
    /// 1 if the field is a list: each number is a separate item.
    pub is_list: u32,
}

/// A type of values.
#[repr(C)]
pub struct AdsCncType {
    /// The name for variables and elements, such as "SGN32".
    pub name: AdsCncBytes,
    /// The name for objects, such as "DINT".
    pub object_name: AdsCncBytes,
    /// The code in a description; 0 if variables do not use the type.
    pub code: u32,
    /// `ADS_CNC_TYPE_BOOLEAN` and so on.
    pub kind: u32,
    /// The size of an element in bytes; 0 for text.
    pub size: u32,
}

/// The names of arguments, from `ADS_CNC_CHANNEL` on.
const ARGUMENTS: [&str; 12] = [
    "channel",
    "axis",
    "index",
    "count",
    "size",
    "handle",
    "index_group",
    "index_offset",
    "kind",
    "name",
    "value",
    "indices",
];

pub(crate) fn function(number: u32) -> Option<Function> {
    Function::ALL.get(to_usize(number)).copied()
}

pub(crate) fn stream(number: u32) -> Option<Stream> {
    Stream::all().nth(to_usize(number))
}

pub(crate) fn stream_number(stream: Stream) -> u32 {
    position(Stream::all(), |it| it == stream)
}

pub(crate) fn field(stream: Stream, number: u32) -> Option<Field> {
    stream.fields().nth(to_usize(number))
}

pub(crate) fn field_number(field: Field) -> u32 {
    field.stream().map_or(ADS_CNC_NONE, |stream| position(stream.fields(), |it| it == field))
}

fn position<T>(mut all: impl Iterator<Item = T>, is: impl Fn(T) -> bool) -> u32 {
    all.position(is).map_or(ADS_CNC_NONE, to_u32)
}

fn text(text: &str) -> AdsCncBytes {
    AdsCncBytes::of(text.as_bytes())
}

/// The argument for a field of the stream of a request; 0 for a count, which is not an argument.
pub(crate) fn argument(field: Field) -> u32 {
    let name = match field.name() {
        "content" | "data" => "value",
        name => name,
    };
    (1..).zip(ARGUMENTS).find(|(_, it)| *it == name).map_or(0, |(number, _)| number)
}

/// The arguments that a function needs and their number: those in its address, those in its data,
/// and the one that determines its read length. The optional `by_index`, and `axis` for a list of
/// objects, are not among them.
fn arguments(function: Function) -> ([u32; 8], u32) {
    let spec = function.spec();
    let group: &[u32] = match spec.group {
        GroupRule::Instances => &[9],
        GroupRule::Elements(_) | GroupRule::ComContent => &[7, 8],
        _ => &[1],
    };
    let offset: &[u32] = match (spec.group, spec.offset) {
        (GroupRule::ComObjects, OffsetRule::AtLeast(_)) => &[3],
        (_, OffsetRule::OfAxis(_)) => &[2],
        (_, OffsetRule::OfKind(_)) => &[9],
        _ => &[],
    };
    let data = spec.request.into_iter().flat_map(Stream::fields).map(argument);
    let length: &[u32] = match spec.reply {
        Some(Stream::ObjectDescriptors) => &[4],
        Some(Stream::Content) => &[5],
        _ => &[],
    };
    let (mut found, mut count) = ([0; 8], 0_u32);
    let address = group.iter().chain(offset).copied();
    let all = address.chain(data).chain(length.iter().copied()).filter(|it| *it > 0);
    for (slot, argument) in found.iter_mut().zip(all) {
        (*slot, count) = (argument, count.saturating_add(1));
    }
    (found, count)
}

fn stream_or_none(stream: Option<Stream>) -> u32 {
    stream.map_or(ADS_CNC_NONE, stream_number)
}

fn field_info(row: &FieldSpec, next: Option<&FieldSpec>) -> AdsCncFieldInfo {
    let each = match row.size {
        Size::Items { each, .. } => each,
        Size::Fixed(size)
        | Size::FixedOnSuccess(size)
        | Size::OptionalFixed(size)
        | Size::Padded(size) => size,
        Size::NonZero => 4,
        _ => 0,
    };
    let is_items = |row: &FieldSpec| matches!(row.size, Size::Items { .. });
    AdsCncFieldInfo {
        name: text(row.name),
        meaning: text(row.meaning),
        clause: text(row.clause),
        kind: match row.ty {
            Type::Uns08 | Type::Uns16 | Type::Uns32 | Type::Unsigned => 1,
            Type::Boolean => 2,
            Type::Real64 => 3,
            Type::String => 4,
            Type::NetId => 5,
            _ => 6,
        },
        size: if each == 1 && is_items(row) { 0 } else { each },
        is_count: next.is_some_and(is_items).into(),
        is_list: (is_items(row) && each > 1).into(),
    }
}

/// Writes the information to memory of the caller and returns true; returns false for `None`.
///
/// # Safety
/// `out` is null or points to memory for one value.
unsafe fn give<T>(info: Option<T>, out: *mut T) -> bool {
    let is_there = info.is_some();
    if let Some(info) = info {
        // SAFETY: the caller's contract.
        unsafe { put(out, info) };
    }
    is_there
}

/// The number of the function with this name, in reports or in programs; `ADS_CNC_NONE` if no
/// function has it.
///
/// # Safety
/// `name` points to `length` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_function(name: *const u8, length: u32) -> u32 {
    // SAFETY: the caller's contract.
    let Ok(name) = (unsafe { bytes(name, length) }) else { return ADS_CNC_NONE };
    let is =
        |it: Function| [it.spec().name, operation_name(it)].iter().any(|it| it.as_bytes() == name);
    position(Function::ALL.iter().copied(), is)
}

/// The number of the stream with this name; `ADS_CNC_NONE` if no stream has it.
///
/// # Safety
/// `name` points to `length` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_stream(name: *const u8, length: u32) -> u32 {
    // SAFETY: the caller's contract.
    let Ok(name) = (unsafe { bytes(name, length) }) else { return ADS_CNC_NONE };
    position(Stream::all(), |it| it.layout().name.as_bytes() == name)
}

/// The number of the field with this name; `ADS_CNC_NONE` if no field of the stream has it.
///
/// # Safety
/// `name` points to `length` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_field(stream: u32, name: *const u8, length: u32) -> u32 {
    // SAFETY: the caller's contract.
    let Ok(name) = (unsafe { bytes(name, length) }) else { return ADS_CNC_NONE };
    let Some(stream) = self::stream(stream) else { return ADS_CNC_NONE };
    position(stream.fields(), |it| it.name().as_bytes() == name)
}

/// Writes the information about a function to `info`; returns false if no function has this number.
///
/// # Safety
/// `info` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_function_info(number: u32, info: *mut AdsCncFunctionInfo) -> bool {
    let found = function(number).map(|function| {
        let spec = function.spec();
        let (arguments, argument_count) = arguments(function);
        AdsCncFunctionInfo {
            name: text(spec.name),
            operation: text(operation_name(function)),
            port: spec.task.port().0.into(),
            command: spec.service.command().0.into(),
            effect: match spec.effect {
                Effect::Query => 0,
                Effect::Write => 1,
                _ => 2,
            },
            request: stream_or_none(spec.request),
            reply: stream_or_none(spec.reply),
            argument_count,
            arguments,
        }
    });
    // SAFETY: the caller's contract.
    unsafe { give(found, info) }
}

/// Writes the name of an argument to `name`; returns false if no argument has this number.
///
/// # Safety
/// `name` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_argument_name(number: u32, name: *mut AdsCncBytes) -> bool {
    let at = to_usize(number).checked_sub(1);
    // SAFETY: the caller's contract.
    unsafe { give(at.and_then(|at| ARGUMENTS.get(at)).map(|it| text(it)), name) }
}

/// Writes the information about a stream to `info`; returns false if no stream has this number.
///
/// # Safety
/// `info` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_stream_info(number: u32, info: *mut AdsCncStreamInfo) -> bool {
    let found = stream(number).map(|stream| {
        let layout = stream.layout();
        AdsCncStreamInfo {
            name: text(layout.name),
            title: text(layout.title),
            max: layout.max,
            field_count: to_u32(layout.fields.len()),
            repeats: layout.repeats.into(),
        }
    });
    // SAFETY: the caller's contract.
    unsafe { give(found, info) }
}

/// Writes the information about a field to `info`; returns false if the stream has no field with
/// this number.
///
/// # Safety
/// `info` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_field_info(
    stream: u32,
    number: u32,
    info: *mut AdsCncFieldInfo,
) -> bool {
    let found = self::stream(stream).and_then(|stream| {
        let mut rows = stream.layout().fields.iter().skip(to_usize(number));
        Some(field_info(rows.next()?, rows.next()))
    });
    // SAFETY: the caller's contract.
    unsafe { give(found, info) }
}

/// Writes the information about a type to `info`; returns false if no type has this number.
///
/// # Safety
/// `info` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_type(number: u32, info: *mut AdsCncType) -> bool {
    let found = DataType::ALL.get(to_usize(number)).map(|it| AdsCncType {
        name: text(it.name()),
        object_name: text(it.object_name()),
        code: it.var_type().map_or(0, |code| code.0),
        kind: match it {
            DataType::Boolean => 0,
            DataType::Uns08 | DataType::Uns16 | DataType::Uns32 | DataType::Lword => 1,
            DataType::Sgn08 | DataType::Sgn16 | DataType::Sgn32 | DataType::Lint => 2,
            DataType::Real32 | DataType::Real64 => 3,
            _ => 4,
        },
        size: it.size().unwrap_or(0),
    });
    // SAFETY: the caller's contract.
    unsafe { give(found, info) }
}

pub(crate) fn service(command: u32) -> Option<AdsService> {
    [AdsService::Read, AdsService::Write, AdsService::ReadWrite]
        .into_iter()
        .find(|it| u32::from(it.command().0) == command)
}
