//! Builds the model from the file and checks it.

mod channels;
mod items;
mod lists;
mod parameters;
mod parse;
mod programs;
mod variables;

use std::collections::BTreeSet;

use self::channels::{Channels, INSTANCES_MAX};
pub(in crate::simulator) use self::parameters::kind as parameter_kind;
use self::parse::text;
use self::variables::AXIS_NAME_MAX;
use super::document::{AxisTable, Document};
use super::error::Source;
use super::{AxisModel, Model, ModelError, Settings};
use crate::edition::{CncVersion, Edition};
use crate::number::to_usize;
use crate::text::in_words;

pub(super) fn build(source: Source<'_>, settings: Settings) -> Result<Model, ModelError> {
    let document: Document = toml::from_str(source.text).map_err(|error| {
        let reason = match error.message() {
            // Explain the error in the words of TOML.
            "invalid type: map, expected a sequence" => {
                "expected a list of tables, with the name in double brackets: [[channel]]"
            }
            reason => &in_words(reason, "table"),
        };
        // An error without a position is reported at line 1.
        source.error(&error.span().unwrap_or_default(), reason)
    })?;
    let edition = match &document.edition {
        Some(name) => {
            Edition::by_name(name.get_ref()).map_err(|why| source.error(&name.span(), why))?
        }
        None => Edition::English,
    };
    let version = match &document.cnc_version {
        Some(text) => {
            let parsed = CncVersion::new(text.get_ref());
            Some(parsed.map_err(|why| source.error(&text.span(), why))?)
        }
        None => None,
    };
    let spindles = match &document.spindles {
        Some(count) if to_usize(*count.get_ref()) > INSTANCES_MAX => {
            return Err(source.error(&count.span(), "expected at most 255 spindles"));
        }
        Some(count) => to_usize(*count.get_ref()),
        None => 0,
    };
    let axes = axes(source, &document.axis)?;
    let platform = items::objects(source, &document.platform.objects, None, 1)?;
    let platform_axis =
        items::objects(source, &document.platform_axis.objects, Some("number"), axes.len())?;
    let channel_axis =
        items::objects(source, &document.channel_axis.objects, Some("place"), axes.len())?;
    let places: usize = document.channel.iter().map(|channel| channel.places.len()).sum();
    let axis_variables =
        variables::of_axes(source, &document.channel_axis.variables, axes.len() + places)?;
    let classes =
        items::classes(source, &document.class, axes.len(), document.channel.len(), spindles)?;
    let (edition, version) = (settings.edition.unwrap_or(edition), settings.version.or(version));
    let channels = Channels {
        source,
        axes: &axes,
        platform: &platform,
        axis_variables: &axis_variables,
        version,
    }
    .build(&document.channel)?;
    let mut model = Model {
        edition,
        version,
        channels,
        axes,
        spindles,
        platform,
        platform_axis,
        channel_axis,
        axis_variables,
        classes,
        platform_list: Default::default(),
        axis_lists: Vec::new(),
    };
    lists::fill(source, &document, &mut model)?;
    Ok(model)
}

fn axes(source: Source<'_>, tables: &[AxisTable]) -> Result<Vec<AxisModel>, ModelError> {
    let (mut axes, mut numbers) = (Vec::new(), BTreeSet::new());
    for (place, table) in (1_u32..).zip(tables) {
        let span = table.name.span();
        if axes.len() >= INSTANCES_MAX {
            return Err(source.error(&span, "expected at most 255 platform axes"));
        }
        let name = text(source, &table.name)?;
        let apart = |byte: &u8| b".[]".contains(byte);
        if name.as_bytes().is_empty() || name.as_bytes().iter().any(apart) {
            return Err(source.error(&span, "expected a name of an axis, without . [ ]"));
        }
        if name.as_bytes().len() >= AXIS_NAME_MAX {
            let why = format!("the name of an axis has at most {} bytes", AXIS_NAME_MAX - 1);
            return Err(source.error(&span, why));
        }
        let (number, span) = match &table.number {
            Some(number) => (*number.get_ref(), number.span()),
            None => (place, span),
        };
        if number == 0 {
            return Err(source.error(&span, "expected a logical axis number greater than 0"));
        }
        if !numbers.insert(number) {
            return Err(source.error(&span, format!("two axes have the logical number {number}")));
        }
        axes.push(AxisModel { name, number });
    }
    Ok(axes)
}
