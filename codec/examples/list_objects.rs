//! Lists the objects of the COM task of a CNC by their descriptors, and the elements of the classes
//! by their attributes. The port of the SDA task is used for all classes. Channels, axes and
//! spindles are queried up to the number `MOST`.
//!
//!     cargo run -p ads-cnc --example list_objects -- 127.0.0.1:48898 127.0.0.1.1.1

mod transport;

use std::fmt::Display;

use ads_cnc::address::{Attribute, Channel, Class, ElementAddress, PlatformAxis};
use ads_cnc::operation::*;
use transport::{Cnc, Result, unless_rejected};

/// The highest number of a channel, axis or spindle that is queried.
const MOST: u32 = 32;

fn main() -> Result<()> {
    let cnc = Cnc::from_args()?;
    row(["group", "offset", "name", "type", "bytes", "unit"]);
    for number in 1..=MOST {
        com(&cnc, Channel::new(number)?.into())?;
        com(&cnc, PlatformAxis::new(number)?.into())?;
    }
    for class in Class::ALL {
        // For numbers that a class does not support, the reply is "no instance".
        for channel in 0..=MOST {
            for axis in 0..=MOST {
                let mut reply = Vec::new();
                let query = FindInstance::new(class, channel, axis);
                // A device may return an ADS error instead of this reply.
                let Some(found) = unless_rejected(cnc.call(&query, &mut reply))? else { continue };
                if let Some(first) = found.first_element()? {
                    elements(&cnc, first)?;
                }
            }
        }
    }
    Ok(())
}

/// Prints the objects of one list; prints nothing if the list is empty or the CNC rejects the
/// request for the number of objects.
fn com(cnc: &Cnc, list: ObjectList) -> Result<()> {
    let mut reply = Vec::new();
    let count = unless_rejected(cnc.call(&CountObjects::new(list), &mut reply))?;
    let Some(count @ 1..) = count.map(u32::from) else { return Ok(()) };
    for object in cnc.call(&ReadDescriptors::new(list, 1, count)?, &mut reply)? {
        let size = object.size();
        let (group, offset) = (object.index_group(), object.index_offset());
        row::<&dyn Display>([&group, &offset, &object.name(), &object.type_name(), &size, &""]);
    }
    Ok(())
}

/// Prints the elements of one instance, except the first, whose content is the number of the
/// others.
fn elements(cnc: &Cnc, first: ElementAddress) -> Result<()> {
    let mut reply = Vec::new();
    let count = cnc.call(&CountElements::new(first)?, &mut reply)?.0;
    for index in 1..=count {
        let element = first.nth(index)?;
        let (mut name, mut of_type, mut unit) = (Vec::new(), Vec::new(), Vec::new());
        let name = cnc.call(&ReadElementName::new(element), &mut name)?.text;
        let of_type = cnc.call(&ReadElementType::new(element), &mut of_type)?.text;
        let unit = cnc.call(&ReadElementUnit::new(element), &mut unit)?.text;
        let size = cnc.call(&ReadElementLength::new(element), &mut reply)?.get();
        let group = element.group(Attribute::Content);
        row::<&dyn Display>([&group, &element.index_offset(), &name, &of_type, &size, &unit]);
    }
    Ok(())
}

fn row<T: Display>(columns: [T; 6]) {
    let [group, offset, name, of_type, size, unit] = columns.map(|column| column.to_string());
    println!("{group:<10} {offset:<10} {name:<40} {of_type:<8} {size:>6} {unit}");
}
