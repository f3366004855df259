//! Index groups, index offsets and names, parsed into their parts; index offsets are also built.

use codec::address::{
    Access, Addressing, Attribute, AxisStride, Class, ComTable, Group, IndexGroup, IndexOffset,
};
use codec::{CncStr, VariablePath};

use crate::error::{AdsCncError, Fault, told};
use crate::memory::{AdsCncBytes, bytes, put, put_item, to_u32};
use crate::request::CLASSES;
use crate::stream::AdsCncField;

/// The parts of an index group, as words.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct AdsCncGroup {
    /// "COM" or "SDA/GEO".
    pub task: AdsCncBytes,
    /// "element" or "object".
    pub access: AdsCncBytes,
    /// "index" or "logical".
    pub addressing: AdsCncBytes,
    /// For COM: "channel" or "axis".
    pub table: AdsCncBytes,
    /// For SDA and GEO: the class.
    pub object_class: AdsCncBytes,
    /// For SDA and GEO: the attribute of the element.
    pub attribute: AdsCncBytes,
    /// The number or index of the channel, axis or spindle; 0 if the group has none.
    pub instance: u32,
}

/// Names of attributes that the codec displays but does not return as `&str`. A test compares them
/// with the displayed names.
pub(crate) const ATTRIBUTES: [&str; 7] =
    ["content", "name", "type", "length", "unit", "write flag", "object address"];
const ALL_ATTRIBUTES: [Attribute; 7] = Attribute::ALL;

fn word(text: &str) -> AdsCncBytes {
    AdsCncBytes::of(text.as_bytes())
}

/// Returns the item of `names` that has the same index as `one` has in `all`.
fn name<T: PartialEq>(all: impl IntoIterator<Item = T>, names: &[&str], one: &T) -> AdsCncBytes {
    let found = all.into_iter().zip(names).find(|(it, _)| it == one);
    found.map_or(AdsCncBytes::NONE, |(_, name)| word(name))
}

/// Parses an index group; returns false if it is not documented.
///
/// # Safety
/// `parts` is null or points to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_group(index_group: u32, parts: *mut AdsCncGroup) -> bool {
    let Some(group) = IndexGroup::new(index_group).parts() else { return false };
    let none = AdsCncBytes::NONE;
    let (addressing, found) = match group {
        Group::Com(com) => (
            com.addressing,
            AdsCncGroup {
                task: word("COM"),
                access: word(if com.access == Access::Object { "object" } else { "element" }),
                addressing: none,
                table: word(if com.table == ComTable::Axis { "axis" } else { "channel" }),
                object_class: none,
                attribute: none,
                instance: com.instance.into(),
            },
        ),
        Group::Class(class) => (
            class.addressing,
            AdsCncGroup {
                task: word("SDA/GEO"),
                access: word("element"),
                addressing: none,
                table: none,
                object_class: name(Class::ALL, &CLASSES, &class.class),
                attribute: name(ALL_ATTRIBUTES, &ATTRIBUTES, &class.attribute),
                instance: class.instance.into(),
            },
        ),
    };
    let by = if addressing == Addressing::Index { "index" } else { "logical" };
    // SAFETY: the caller's contract.
    unsafe { put(parts, AdsCncGroup { addressing: word(by), ..found }) };
    true
}

fn stride(number: u32) -> Result<AxisStride, Fault> {
    match number {
        0x1_0000 => Ok(AxisStride::X10000),
        0x1000 => Ok(AxisStride::X1000),
        _ => Err(Fault::Argument("stride")),
    }
}

/// Converts an axis and an element to an index offset.
///
/// # Safety
/// `offset` and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_offset(
    stride: u32,
    axis: u32,
    element: u32,
    offset: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let make = || -> Result<(), Fault> {
        let made = IndexOffset::for_axis(self::stride(stride)?, axis, element)?;
        // SAFETY: the caller's contract.
        unsafe { put(offset, made.get()) };
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(make(), error) }
}

/// Converts an index offset to its axis and element.
///
/// # Safety
/// `axis`, `element` and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_offset_parts(
    stride: u32,
    offset: u32,
    axis: *mut u32,
    element: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let read = || -> Result<(), Fault> {
        let found = IndexOffset::new(offset).axis_and_element(self::stride(stride)?)?;
        // SAFETY: the caller's contract.
        unsafe {
            put(axis, found.0);
            put(element, found.1);
        }
        Ok(())
    };
    // SAFETY: the caller's contract.
    unsafe { told(read(), error) }
}

/// Parses the name of a variable.
///
/// # Safety
/// `name` points to `length` bytes, `parts` is null or points to memory for `room` values; `count`
/// and `error` are null or point to memory for one value.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ads_cnc_path(
    name: *const u8,
    length: u32,
    parts: *mut AdsCncField,
    room: u32,
    count: *mut u32,
    error: *mut AdsCncError,
) -> bool {
    let take = || -> Result<(), Fault> {
        // SAFETY: the caller's contract.
        let name = unsafe { bytes(name, length)? };
        let path = VariablePath::from_text(CncStr::from_bytes(name)?)?;
        let mut found = 0_u32;
        let mut give = |field, record, item, (offset, length): (usize, usize), number| {
            let (offset, length) = (to_u32(offset), to_u32(length));
            let part = AdsCncField { field, record, item, offset, length, number };
            // SAFETY: the caller's contract.
            unsafe { put_item(parts, room, found, part) };
            found = found.saturating_add(1);
        };
        let kind = path.kind().text().len();
        give(0, 0, 0, (0, kind), 0);
        let mut end = kind;
        for (record, part) in (0..).zip(path.parts()) {
            // The name of a part begins after the dot that follows the indices of the previous
            // part.
            let rest = name.get(end..).unwrap_or_default();
            let dot = rest.iter().position(|byte| *byte == b'.').unwrap_or(0);
            let at = end.saturating_add(dot).saturating_add(1);
            give(1, record, 0, (at, part.name.len()), 0);
            end = at.saturating_add(part.name.len());
            for (item, index) in (0..).zip(part.indices) {
                give(2, record, item, (end, 0), index);
            }
        }
        // SAFETY: the caller's contract.
        unsafe { put(count, found) };
        match found > room && !parts.is_null() {
            true => Err(Fault::Room(found, room)),
            false => Ok(()),
        }
    };
    // SAFETY: the caller's contract.
    unsafe { told(take(), error) }
}
