//! Lists all objects of a CNC: those of the COM task by their descriptors, and the elements of the
//! SDA and GEO tasks by their attributes.
//!
//!     cargo run --example list_objects -- 127.0.0.1:48898 127.0.0.1.1.1

mod transport;

use ads_cnc::address::{Channel, Class, ElementAddress, PlatformAxis};
use ads_cnc::operation::*;
use transport::{Cnc, Result};

/// The most channels, axes and spindles that are asked for.
const MOST: u32 = 32;

fn main() -> Result<()> {
    let cnc = Cnc::from_args()?;
    println!("{:<10} {:<10} {:<40} {:<8} {:>6} unit", "group", "offset", "name", "type", "bytes");
    for number in 1..=MOST {
        com(&cnc, Channel::new(number)?.into())?;
        com(&cnc, PlatformAxis::new(number)?.into())?;
    }
    for class in Class::ALL {
        // Numbers that a class does not take are answered by "none".
        for channel in 0..=MOST {
            for axis in 0..=MOST {
                let mut reply = Vec::new();
                let query = FindInstance::new(class, channel, axis);
                // Some devices answer with an error instead.
                let Ok(found) = cnc.call(&query, &mut reply) else { continue };
                if let Some(first) = found.first_element()? {
                    elements(&cnc, first)?;
                }
            }
        }
    }
    Ok(())
}

/// The objects of one list; a channel or axis that is not there has none.
fn com(cnc: &Cnc, list: ObjectList) -> Result<()> {
    let mut reply = Vec::new();
    let Ok(count) = cnc.call(&CountObjects::new(list), &mut reply) else { return Ok(()) };
    if count.0 == 0 {
        return Ok(());
    }
    for object in cnc.call(&ReadDescriptors::new(list, 1, count.0)?, &mut reply)?.iter() {
        let (group, offset) = (object.index_group(), object.index_offset());
        let (name, of_type, size) = (object.name(), object.type_name(), object.size());
        println!("{group:<#10} {offset:<#10} {name:<40} {of_type:<8} {size:>6}");
    }
    Ok(())
}

/// The elements of one instance.
fn elements(cnc: &Cnc, first: ElementAddress) -> Result<()> {
    let mut reply = Vec::new();
    let count = cnc.call(&CountElements::new(first), &mut reply)?.0;
    for place in 1..=count {
        let element = first.following(place)?;
        let (mut name, mut of_type, mut unit) = (Vec::new(), Vec::new(), Vec::new());
        let name = cnc.call(&ReadElementName::new(element), &mut name)?.text.text();
        let of_type = cnc.call(&ReadElementType::new(element), &mut of_type)?.text.text();
        let unit = cnc.call(&ReadElementUnit::new(element), &mut unit)?.text.text();
        let size = cnc.call(&ReadElementLength::new(element), &mut reply)?.get();
        let group = element.group(ads_cnc::address::Attribute::Content);
        let offset = element.index_offset();
        println!("{group:<#10} {offset:<#10} {name:<40} {of_type:<8} {size:>6} {unit}");
    }
    Ok(())
}
