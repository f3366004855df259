//! Reads a variable by its name. The program learns the type of the variable from the CNC.
//!
//!     cargo run -p ads-cnc --example read_variable -- 127.0.0.1:48898 127.0.0.1.1.1 1 V.E.Testvar

mod transport;

use std::env;

use ads_cnc::address::Channel;
use ads_cnc::operation::{CountVariables, DescribeByIndex, DescribeByName, ReadByName};
use ads_cnc::{DescriptionByName, VariablePath};
use transport::{Cnc, Result, unless_rejected};

fn main() -> Result<()> {
    let cnc = Cnc::from_args()?;
    let channel = Channel::new(env::args().nth(3).ok_or("no channel")?.parse()?)?;
    let name = env::args().nth(4).ok_or("no name")?;
    let path = VariablePath::new(&name)?;

    // An element `V.E.Testvar[3]` has the description of its array, `V.E.Testvar`.
    let description = describe(&cnc, channel, path.variable())?;
    let shape = description.shape()?;
    let shape = if path.elements().is_empty() { shape } else { shape.element_shape() };

    let mut reply = Vec::new();
    let value = cnc.call(&ReadByName::new(channel, &name)?, &mut reply)?;
    let dimensions: String = shape.dimensions().iter().map(|size| format!("[{size}]")).collect();
    println!("{name}: {}{dimensions}", shape.data_type());
    for element in shape.elements(value.bytes)? {
        println!("  {element}");
    }
    Ok(())
}

/// Reads the description of a variable by its name. If the CNC rejects this request, for example
/// because an older CNC lacks this function, searches the descriptions of all variables of the same
/// kind.
fn describe(cnc: &Cnc, channel: Channel, path: VariablePath<'_>) -> Result<DescriptionByName> {
    let mut reply = Vec::new();
    if let Some(found) =
        unless_rejected(cnc.call(&DescribeByName::new(channel, path)?, &mut reply))?
    {
        return Ok(found.to_owned());
    }
    let kind = path.kind();
    let count = cnc.call(&CountVariables::new(channel, kind), &mut reply)?.0;
    for index in 0..count {
        let found = cnc.call(&DescribeByIndex::new(channel, index, kind), &mut reply)?;
        if found.name.text() == path.text() {
            return Ok(found.without_name().to_owned());
        }
    }
    Err(format!("no such variable: {path}").into())
}
