//! Finds objects and elements by their names.

use ads_cnc::CncString;

use super::Lookup;
use crate::objects::{ListedValue, Options, Pattern, walk};
use crate::session::{Session, ToolError};
use crate::values::Type;

/// Maximum number of objects that an error about an ambiguous name lists.
const SHOWN: usize = 12;

/// Searches all lists that `lookup` selects. No match, and more than one match, are errors.
pub(super) fn find(session: &mut Session, lookup: &Lookup) -> Result<ListedValue, ToolError> {
    let Lookup { name, channel, lists, offset, ty, .. } = lookup;
    let wanted: CncString = name.parse().map_err(ToolError::Unsendable)?;
    let options = Options {
        channels: vec![*channel],
        lists: lists.clone(),
        names: Some(Pattern::whole(name)),
        ..Options::default()
    };
    let mut found = walk(session, &options, &mut |_| {})?;
    if found.is_cut {
        // The search is incomplete: another object may have the same name.
        let why = found.notes.pop().unwrap_or_default();
        return Err(ToolError::Enough(format!("the search for {name} is incomplete: {why}")));
    }
    found.objects.retain(|object| {
        let at = object.address.content().map(|(_, offset)| offset.get());
        object.name == wanted && (offset.is_none() || *offset == at)
    });
    match (found.objects.pop(), found.objects.as_slice()) {
        (Some(object), []) => Ok(match ty {
            Some(ty) => {
                let size = object.ty.size;
                let taken = Type::hinted(*ty);
                let taken = size.map_or(taken.clone(), |size| taken.fitted(size));
                ListedValue { ty: taken, ..object }
            }
            None => object,
        }),
        (Some(last), others) => {
            let all: Vec<&ListedValue> = others.iter().chain([&last]).collect();
            Err(ToolError::Usage(several(name, &all)))
        }
        (None, _) => Err(ToolError::Absent(absent(lookup))),
    }
}

fn several(name: &str, all: &[&ListedValue]) -> String {
    let mut why = format!("{} objects have the name {name}; select one:", all.len());
    for object in all.iter().take(SHOWN) {
        let ListedValue { list, address, .. } = object;
        let offset = address.content().map(|(_, offset)| offset.to_string()).unwrap_or_default();
        let alone = all.iter().filter(|other| other.list == *list).count() == 1;
        let offset = if alone { String::new() } else { format!(" --offset {offset}") };
        why.push_str(&format!("\n  --of \"{list}\"{offset}"));
    }
    let more = all.len().saturating_sub(SHOWN);
    if more > 0 {
        why.push_str(&format!("\n  and {more} more; browse --filter \"{name}\" lists them"));
    }
    why
}

fn absent(lookup: &Lookup) -> String {
    let Lookup { name, channel, lists, offset, .. } = lookup;
    let number = channel.number();
    let place = match (lists, offset) {
        (None, None) => format!("of channel {number}, the platform, its axes and spindles"),
        _ => "there".to_owned(),
    };
    format!("no object or element {place} has the name {name} (case-sensitive)")
}
