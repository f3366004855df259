//! Builds and checks objects and elements.

use ads_cnc::address::Class;
use ads_cnc::limits::TEXT_MAX;
use ads_cnc::{CncString, Descriptor};
use toml::{Spanned, Value};

use super::super::document::{ClassesTable, ElementRow, ElementTable, ObjectRow};
use super::super::error::Source;
use super::super::item::{
    ClassModel, ContentSource, Elements, Initial, InitialValues, Item, Objects,
};
use super::super::types::{self, NamedType, TypeNames};
use super::super::{ModelError, class_place};
use super::parse::text;
use crate::number::to_usize;
use crate::text::plural;

/// Maximum size of a content in bytes, so that the content fits into a frame of the simulated CNC
/// after result and length.
const CONTENT_MAX: usize = 0xFFF8;

/// Maximum number of bytes of memory for all values of a model. A short file can declare large values
/// for hundreds of axes, channels and spindles.
const MEMORY_MAX: usize = 64 * 1024 * 1024;

/// Approximate number of bytes of memory that a value needs in addition to its size.
const VALUE_OVERHEAD: usize = 64;

/// Size in bytes of a STRING without a declared size (VAR-25).
pub(super) const STRING_DEFAULT: u32 = 21;

/// Objects must have offsets below this value, because the offsets from this value on belong to
/// axes.
const OFFSET_OF_AXES: u32 = 0x1_0000;
/// The elements of an axis of the HLD must have numbers below this value, because the numbers from
/// this value on belong to the next axis.
const HLD_AXIS_STRIDE: usize = 0x1000;

/// A declared value of an object, element or variable.
pub(super) struct DeclaredValue<'a> {
    pub(super) source: Source<'a>,
    pub(super) types: TypeNames,
    pub(super) of_type: &'a Spanned<String>,
    pub(super) size: Option<&'a Spanned<u32>>,
    /// Number of elements of an array; `None` for a single value.
    pub(super) count: Option<usize>,
    pub(super) value: Option<&'a Spanned<Value>>,
    pub(super) values: Option<&'a Spanned<Vec<Value>>>,
    /// Maximum size of the value in bytes.
    pub(super) max: usize,
    /// Number of owners of the item, such as axes, each of which has its own value.
    pub(super) owners: usize,
}

impl DeclaredValue<'_> {
    /// The type, and the initial values.
    pub(super) fn read(&self) -> Result<(NamedType, Initial), ModelError> {
        let of_type = self.of_type;
        let error = |why: String| self.source.error(&of_type.span(), why);
        let ty = self.types.find(of_type.get_ref()).map_err(error)?;
        let each = match (ty.data_type.size(), self.size) {
            (Some(size), None) => to_usize(size),
            (Some(_), Some(size)) => {
                let why = format!("size is only for a STRING; {} has a fixed size", ty.name);
                return Err(self.source.error(&size.span(), why));
            }
            (None, None) => to_usize(STRING_DEFAULT),
            (None, Some(size)) if *size.get_ref() == 0 => {
                return Err(self.source.error(&size.span(), "the size of a STRING includes a NUL"));
            }
            (None, Some(size)) => to_usize(*size.get_ref()),
        };
        let size = each.saturating_mul(self.count.unwrap_or(1));
        if size > self.max {
            return Err(error(format!(
                "{} of value; the maximum is {}",
                plural(size, "byte"),
                self.max
            )));
        }
        // Check the memory before values are allocated. The model keeps the initial values as well.
        let initial = self.values.map_or(1, |values| values.get_ref().len());
        let count = self.owners.saturating_add(initial);
        let memory = size.saturating_add(VALUE_OVERHEAD).saturating_mul(count);
        let memory = memory.saturating_add(self.source.memory.get());
        if memory > MEMORY_MAX {
            return Err(error(format!(
                "with the {} of this item, the values of the model need {} of memory; the maximum is \
                 {MEMORY_MAX}",
                plural(count, "value"),
                plural(memory, "byte")
            )));
        }
        self.source.memory.set(memory);
        let values = match (self.value, self.values) {
            (Some(_), Some(values)) => {
                return Err(self.source.error(&values.span(), "expected either value or values"));
            }
            (None, None) => InitialValues::Same(vec![0; size]),
            (Some(value), None) => {
                InitialValues::Same(self.bytes(ty, each, value.get_ref(), &value.span())?)
            }
            (None, Some(values)) => {
                let span = values.span();
                let bytes = |value| self.bytes(ty, each, value, &span);
                InitialValues::Each(values.get_ref().iter().map(bytes).collect::<Result<_, _>>()?)
            }
        };
        Ok((ty, Initial { size, values }))
    }

    fn bytes(
        &self,
        ty: NamedType,
        each: usize,
        value: &Value,
        span: &std::ops::Range<usize>,
    ) -> Result<Vec<u8>, ModelError> {
        let bytes = types::bytes(ty.data_type, each, self.count, value);
        bytes.map_err(|why| self.source.error(span, why))
    }
}

/// The source of the content that the key `is` declares. `of` specifies the owner of the item:
/// "number" for a platform axis, "place" for an axis of a channel, `None` for any other owner.
fn meaning(
    source: Source<'_>,
    is: Option<&Spanned<String>>,
    writable: bool,
    of: Option<&'static str>,
) -> Result<ContentSource, ModelError> {
    let Some(is) = is else { return Ok(ContentSource::Value) };
    let error = |why: &str| Err(source.error(&is.span(), why));
    match (is.get_ref().as_str(), of) {
        ("axis-number", None) => error("axis-number is only for objects and elements of axes"),
        ("axis-number", Some("number")) if writable => {
            error("not writable: axes are exchanged in channels, not on the platform")
        }
        ("axis-number", Some(_)) => Ok(ContentSource::AxisNumber),
        _ => error("expected axis-number"),
    }
}

/// Checks that an item whose content is an axis number has an integer type of at least two bytes.
fn holds_numbers(
    source: Source<'_>,
    item: &Item,
    span: &Spanned<String>,
) -> Result<(), ModelError> {
    let whole = !matches!(item.type_name, "STRING" | "REAL" | "LREAL" | "REAL32" | "REAL64");
    if item.meaning == ContentSource::Value || whole && item.initial.size >= 2 {
        return Ok(());
    }
    Err(source.error(&span.span(), "axis-number needs an integer type of at least two bytes"))
}

/// The objects of each of `owners`; for `of`, see [`meaning`].
pub(super) fn objects(
    source: Source<'_>,
    rows: &[ObjectRow],
    of: Option<&'static str>,
    owners: usize,
) -> Result<Objects, ModelError> {
    let mut objects = Objects::default();
    for row in rows {
        let name = text(source, &row.name)?;
        let (ty, initial) = DeclaredValue {
            source,
            types: TypeNames::Object,
            of_type: &row.r#type,
            size: row.size.as_ref(),
            count: None,
            value: row.value.as_ref(),
            values: row.values.as_ref(),
            max: CONTENT_MAX,
            owners,
        }
        .read()?;
        // The codec checks the length of names.
        Descriptor::new(row.name.get_ref(), ty.name)
            .map_err(|error| source.error(&row.name.span(), error))?;
        let meaning = meaning(source, row.is.as_ref(), row.writable, of)?;
        let unit = CncString::default();
        let (type_name, writable) = (ty.name, row.writable);
        let item = Item { name, type_name, unit, writable, meaning, initial };
        holds_numbers(source, &item, &row.r#type)?;
        let (element, span) = (*row.offset.get_ref(), row.offset.span());
        if element >= OFFSET_OF_AXES {
            return Err(source.error(&span, "offsets from 0x10000 on belong to axes"));
        }
        if let (Some(id), Some(_)) = (&row.id, of) {
            return Err(
                source.error(&id.span(), "no id: each axis has its own object with its own ID")
            );
        }
        if objects.by_element.insert(element, objects.items.len()).is_some() {
            return Err(source.error(&span, format!("two objects have the offset {element:#x}")));
        }
        objects.items.push(item);
        objects.elements.push(element);
    }
    Ok(objects)
}

pub(super) fn classes(
    source: Source<'_>,
    tables: &ClassesTable,
    axes: usize,
    channels: usize,
    spindles: usize,
) -> Result<[ClassModel; 6], ModelError> {
    let mut classes: [ClassModel; 6] = Default::default();
    let none = ElementTable::default();
    let parts = [
        (Class::PositionController, &none, &tables.position_controller.axis),
        (Class::Interpolator, &tables.interpolator.channel, &tables.interpolator.axis),
        (Class::Decoder, &tables.decoder.channel, &tables.decoder.axis),
        (Class::Hld, &tables.hld.channel, &tables.hld.axis),
        (Class::PathPreparation, &tables.path_preparation.channel, &tables.path_preparation.axis),
        (Class::Spindle, &tables.spindle.each, &none),
    ];
    for (class, channel, axis) in parts {
        // These classes contain the platform axes, whose order is fixed, so they cannot be
        // exchanged.
        let on_platform = matches!(class, Class::PositionController | Class::Hld);
        let of = Some(if on_platform { "number" } else { "place" });
        let max = if class == Class::Hld { HLD_AXIS_STRIDE } else { 0x1_0000 };
        // Channels also have, without an address, the elements of spindles.
        let channel = elements(source, channel, None, 0x1_0000, channels.saturating_add(spindles))?;
        let axis = elements(source, axis, of, max, axes)?;
        if let Some(part) = classes.get_mut(class_place(class)) {
            *part = ClassModel { channel, axis };
        }
    }
    Ok(classes)
}

fn elements(
    source: Source<'_>,
    table: &ElementTable,
    of: Option<&'static str>,
    max: usize,
    owners: usize,
) -> Result<Elements, ModelError> {
    let mut elements = Elements::default();
    if let Some(name) = &table.name {
        text(source, name)?;
        // Leave room for the number of the instance.
        if name.get_ref().chars().count() > 200 {
            return Err(source.error(&name.span(), "expected at most 200 characters"));
        }
        elements.name.clone_from(name.get_ref());
    }
    for row in &table.elements {
        if elements.items.len() >= max - 1 {
            return Err(source.error(
                &row.name.span(),
                "too many elements: this number belongs to another axis",
            ));
        }
        elements.items.push(element(source, row, of, owners)?);
    }
    Ok(elements)
}

fn element(
    source: Source<'_>,
    row: &ElementRow,
    of: Option<&'static str>,
    owners: usize,
) -> Result<Item, ModelError> {
    let (name, unit) = (text(source, &row.name)?, row.unit.as_ref());
    let unit = unit.map(|unit| Ok((text(source, unit)?, unit.span()))).transpose()?;
    let (unit, unit_span) = unit.unwrap_or_default();
    for (text, span) in [(&name, row.name.span()), (&unit, unit_span)] {
        if text.as_bytes().len() >= TEXT_MAX {
            return Err(source.error(&span, "expected at most 255 characters"));
        }
    }
    let (ty, initial) = DeclaredValue {
        source,
        types: TypeNames::Element,
        of_type: &row.r#type,
        size: row.size.as_ref(),
        count: None,
        value: row.value.as_ref(),
        values: row.values.as_ref(),
        max: CONTENT_MAX,
        owners,
    }
    .read()?;
    let meaning = meaning(source, row.is.as_ref(), row.writable, of)?;
    let (type_name, writable) = (ty.name, row.writable);
    let item = Item { name, type_name, unit, writable, meaning, initial };
    holds_numbers(source, &item, &row.r#type)?;
    Ok(item)
}
