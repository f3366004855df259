//! Executes the actions of the client protocol.

use ads_cnc::address::{Channel, ChannelAxis, Class, ElementAddress, Spindle};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, AxisWriteByName, CountDynamic, CountElements, CountObjects,
    CountVariables, DescribeByIndex, DescribeExtended, DynamicNameByIndex, DynamicValueByIndex,
    DynamicValueByName, FindInstance, HandleByName, ReadByHandle, ReadByName, ReadDescriptors,
    ReadElement, ReadElementLength, ReadElementName, ReadElementType, ReadElementUnit,
    ReadElementWriteFlag, ReadObject, WriteByHandle, WriteByName, WriteElement, WriteObject,
};
use ads_cnc::value::DataType;
use ads_cnc::{CncStr, Descriptor, Handle, Kind, U32List};
use serde_json::{Value, json};

use super::connection::Connection;
use super::error::ActionError;
use super::{ClientFault, service, streaming};
use crate::client_suite::Action;
use crate::client_suite::message::DONE;
use crate::codec::hyphenated;
use crate::text::plural;
use crate::values::{self, Type};

/// Maximum number of descriptors in one request.
const AT_ONCE: u32 = 64;

/// Iterates over the arguments of an action.
struct Arguments<'a>(std::slice::Iter<'a, String>);

impl<'a> Arguments<'a> {
    fn text(&mut self) -> Result<&'a str, ActionError> {
        self.0.next().map(String::as_str).ok_or_else(|| "an argument is missing".into())
    }

    fn number(&mut self) -> Result<u32, ActionError> {
        Ok(self.text()?.parse()?)
    }

    fn channel(&mut self) -> Result<Channel, ActionError> {
        Ok(Channel::new(self.number()?)?)
    }

    fn axis(&mut self) -> Result<ChannelAxis, ActionError> {
        Ok(ChannelAxis::new(self.number()?)?)
    }

    /// Parses a type such as `SGN32` or `SGN16[2,3]`.
    fn data_type(&mut self) -> Result<Type, ActionError> {
        let text = self.text()?;
        let (name, dimensions) = match text.strip_suffix(']').and_then(|text| text.split_once('['))
        {
            Some((name, dimensions)) => (name, numbers(dimensions)?),
            None => (text, Vec::new()),
        };
        let known = DataType::by_name(CncStr::new(name)?).ok_or("unknown type")?;
        Ok(match known {
            DataType::String if dimensions.is_empty() => Type::hinted(known),
            known => Type::known(known, dimensions),
        })
    }

    fn parameters(&mut self) -> Result<DynamicKind, ActionError> {
        let text = self.text()?;
        let known = DynamicKind::ALL.into_iter().find(|one| one.to_string() == text);
        Ok(known.ok_or("unknown kind")?)
    }

    /// Parses a class such as `path-preparation`.
    fn class(&mut self) -> Result<Class, ActionError> {
        let name = self.text()?;
        let known = Class::ALL.into_iter().find(|one| hyphenated(one) == name);
        Ok(known.ok_or("unknown class")?)
    }
}

fn numbers(text: &str) -> Result<Vec<u32>, ActionError> {
    text.split(',').map(|one| Ok(one.trim().parse()?)).collect()
}

fn to_json(wire: &Connection, ty: &Type, bytes: &[u8]) -> Result<Value, ActionError> {
    let mut ty = ty.clone();
    if wire.has(ClientFault::Unsigned) {
        ty.data_type = ty.data_type.map(|data_type| match data_type {
            DataType::Sgn16 => DataType::Uns16,
            DataType::Sgn32 => DataType::Uns32,
            other => other,
        });
    }
    values::value_of(&ty, bytes)
        .ok_or_else(|| format!("{} cannot be a {ty}", plural(bytes.len(), "byte")).into())
}

pub(super) fn act(wire: &mut Connection, action: &Action) -> Result<Value, ActionError> {
    let mut args = Arguments(action.args.iter());
    let args = &mut args;
    let mut reply = Vec::new();
    Ok(match action.action.as_str() {
        "count-objects" => wire.call(&CountObjects::new(args.channel()?), &mut reply)?.0.into(),
        "list-objects" => list(wire, args.channel()?)?.iter().map(descriptor).collect(),
        "read-object" => {
            let object = object(wire, args)?;
            let (group, offset) = (object.index_group(), object.index_offset());
            let read = ReadObject::new(group, offset, object.size())?;
            let bytes = wire.call(&read, &mut reply)?.bytes;
            to_json(wire, &content(&object), bytes)?
        }
        "write-object" => {
            let object = object(wire, args)?;
            let bytes = values::parse(&content(&object), args.text()?)?;
            let (group, offset) = (object.index_group(), object.index_offset());
            wire.call(&WriteObject::new(group, offset, &bytes)?, &mut reply)?;
            DONE
        }
        "count-variables" => {
            let (channel, kind) = (args.channel()?, args.text()?);
            let kind = if kind == "all" { Kind::ALL } else { Kind::new(kind)? };
            wire.call(&CountVariables::new(channel, kind), &mut reply)?.0.into()
        }
        "describe" => {
            let (channel, index, kind) =
                (args.channel()?, args.number()?, Kind::new(args.text()?)?);
            let found = wire.call(&DescribeByIndex::new(channel, index, kind), &mut reply)?;
            json!({
                "name": found.name.text().to_string(),
                "handle": found.handle.0,
                "type": found.var_type.0,
                "access": found.access.0,
                "size": found.size,
                "dimensions": found.dimensions.iter().collect::<Vec<u32>>(),
            })
        }
        "describe-extended" => {
            let (channel, index, kind) =
                (args.channel()?, args.number()?, Kind::new(args.text()?)?);
            let found = wire.call(&DescribeExtended::new(channel, index, kind), &mut reply)?;
            match found.0 {
                None if wire.has(ClientFault::NothingIsError) => {
                    return Err("the extended description is empty".into());
                }
                None => Value::Null,
                Some(found) => json!({
                    "synchronisation": found.synchronisation.0,
                    "validity": found.validity.0,
                }),
            }
        }
        "handle" => {
            let (channel, name) = (args.channel()?, args.text()?);
            wire.call(&HandleByName::new(channel, name)?, &mut reply)?.0.into()
        }
        "read-by-name" => {
            let (channel, name, ty) = (args.channel()?, args.text()?, args.data_type()?);
            let bytes = wire.call(&ReadByName::new(channel, name)?, &mut reply)?.bytes;
            to_json(wire, &ty, bytes)?
        }
        "write-by-name" => {
            let (channel, name, ty) = (args.channel()?, args.text()?, args.data_type()?);
            let bytes = values::parse(&ty, args.text()?)?;
            wire.call(&WriteByName::new(channel, name, &bytes)?, &mut reply)?;
            DONE
        }
        "read-by-handle" | "write-by-handle" => by_handle(wire, action, args)?,
        "axis-handle" => {
            let (channel, axis, name) = (args.channel()?, args.axis()?, args.text()?);
            wire.call(&AxisHandleByName::new(channel, axis, name)?, &mut reply)?.0.into()
        }
        "read-axis" => {
            let (channel, axis, name) = (args.channel()?, args.axis()?, args.text()?);
            let ty = args.data_type()?;
            let bytes = wire.call(&AxisReadByName::new(channel, axis, name)?, &mut reply)?.bytes;
            to_json(wire, &ty, bytes)?
        }
        "write-axis" => {
            let (channel, axis, name) = (args.channel()?, args.axis()?, args.text()?);
            let bytes = values::parse(&args.data_type()?, args.text()?)?;
            wire.call(&AxisWriteByName::new(channel, axis, name, &bytes)?, &mut reply)?;
            DONE
        }
        "count-parameters" => {
            let op = CountDynamic::new(args.channel()?, args.parameters()?);
            wire.call(&op, &mut reply)?.0.into()
        }
        "parameter-name" => {
            let (channel, kind) = (args.channel()?, args.parameters()?);
            let op = DynamicNameByIndex::new(channel, kind, args.number()?)?;
            wire.call(&op, &mut reply)?.name.text().to_string().into()
        }
        "parameter-by-name" => {
            let (channel, kind) = (args.channel()?, args.parameters()?);
            let op = DynamicValueByName::new(channel, kind, args.text()?)?;
            wire.call(&op, &mut reply)?.get().into()
        }
        "parameter-by-index" => {
            let (channel, kind) = (args.channel()?, args.parameters()?);
            let op = DynamicValueByIndex::new(channel, kind, args.number()?)?;
            wire.call(&op, &mut reply)?.get().into()
        }
        "find-instance" => {
            let (class, channel, axis) = (args.class()?, args.number()?, args.number()?);
            let found = wire.call(&FindInstance::new(class, channel, axis), &mut reply)?;
            let (group, offset) = (found.index_group.get(), found.index_offset.get());
            let is_none = (group, offset) == (0, 0) && !wire.has(ClientFault::NoneIsZero);
            if is_none { Value::Null } else { json!([group, offset]) }
        }
        "stream" => streaming::stream(wire, args.channel()?, args.text()?)?,
        "serve-echo" => {
            let (channel, uuid) = (args.channel()?, args.text()?);
            let (requests, seconds) = (args.number()?, args.text()?.parse()?);
            service::serve(wire, channel, uuid, requests, seconds)?
        }
        "ask-service" => service::ask(wire, args.channel()?, args.text()?, args.text()?)?,
        _ => return element(wire, action, args),
    })
}

fn by_handle(
    wire: &mut Connection,
    action: &Action,
    args: &mut Arguments<'_>,
) -> Result<Value, ActionError> {
    let (channel, handle) = (args.channel()?, Handle(args.number()?));
    let indices = match args.text()? {
        "-" => Vec::new(),
        some => numbers(some)?,
    };
    let (indices, ty, mut reply) =
        (U32List::from(indices.as_slice()), args.data_type()?, Vec::new());
    if action.action == "read-by-handle" {
        let bytes = wire.call(&ReadByHandle::new(channel, handle, indices), &mut reply)?.bytes;
        return to_json(wire, &ty, bytes);
    }
    let bytes = values::parse(&ty, args.text()?)?;
    wire.call(&WriteByHandle::new(channel, handle, indices, &bytes), &mut reply)?;
    Ok(DONE)
}

fn list(wire: &mut Connection, channel: Channel) -> Result<Vec<Descriptor>, ActionError> {
    let (mut all, mut reply) = (Vec::new(), Vec::new());
    let count = wire.call(&CountObjects::new(channel), &mut reply)?.0;
    let mut next = 1_u32;
    while next <= count {
        let left = count.saturating_sub(next).saturating_add(1);
        let read = ReadDescriptors::new(
            channel,
            next,
            left.min(if wire.has(ClientFault::OneByOne) { 1 } else { AT_ONCE }),
        )?;
        let found = wire.call(&read, &mut reply)?;
        let before = all.len();
        all.extend(found.iter().map(|object| object.to_owned()));
        match u32::try_from(all.len().saturating_sub(before))? {
            0 => return Err("no descriptors, although the list has more objects".into()),
            more => next = next.saturating_add(more),
        }
    }
    Ok(all)
}

fn descriptor(object: &Descriptor) -> Value {
    json!({
        "name": object.name().to_string(),
        "type": object.type_name().to_string(),
        "size": object.size(),
        "writable": object.write_access().0 != 0,
        "group": object.index_group().get(),
        "offset": object.index_offset().get(),
    })
}

fn object(wire: &mut Connection, args: &mut Arguments<'_>) -> Result<Descriptor, ActionError> {
    let (channel, name) = (args.channel()?, args.text()?);
    let found = list(wire, channel)?.into_iter().find(|object| object.name() == name);
    found.ok_or_else(|| "no such object".into())
}

fn content(object: &Descriptor) -> Type {
    Type::of_content(object.type_name(), object.size())
}

/// Executes an action on an element. The client requests the address of position controllers, of
/// axes of the HLD and of instances of the platform from the CNC, and calculates all other
/// addresses.
fn element(
    wire: &mut Connection,
    action: &Action,
    args: &mut Arguments<'_>,
) -> Result<Value, ActionError> {
    let (class, channel, axis) = (args.class()?, args.number()?, args.number()?);
    let number = if action.action == "count-elements" { 0 } else { args.number()? };
    let mut reply = Vec::new();
    let at = match (class, channel, axis) {
        (Class::Spindle, spindle, _) => {
            ElementAddress::for_spindle(Spindle::new(spindle)?, number)?
        }
        (Class::PositionController, ..) | (Class::Hld, _, 1..) | (_, 0, _) => {
            let found = wire.call(&FindInstance::new(class, channel, axis), &mut reply)?;
            let first = found.first_element()?.ok_or("no such instance")?;
            first.nth(number)?
        }
        (_, channel, 0) => ElementAddress::for_channel(Channel::new(channel)?, class, number)?,
        (_, channel, axis) => {
            let axis = ChannelAxis::new(axis)?;
            ElementAddress::for_axis(Channel::new(channel)?, class, axis, number)?
        }
    };
    Ok(match action.action.as_str() {
        "count-elements" => wire.call(&CountElements::new(at)?, &mut reply)?.0.into(),
        "element-name" => {
            wire.call(&ReadElementName::new(at), &mut reply)?.text.text().to_string().into()
        }
        "element-type" => {
            wire.call(&ReadElementType::new(at), &mut reply)?.text.text().to_string().into()
        }
        "element-unit" => {
            wire.call(&ReadElementUnit::new(at), &mut reply)?.text.text().to_string().into()
        }
        "element-length" => wire.call(&ReadElementLength::new(at), &mut reply)?.get().into(),
        "element-writable" => {
            wire.call(&ReadElementWriteFlag::new(at), &mut reply)?.is_writable().into()
        }
        "read-element" => {
            let ty = args.data_type()?;
            let length = ty.size.ok_or("the length of a text is unknown")?;
            let bytes = wire.call(&ReadElement::new(at, length)?, &mut reply)?.bytes;
            to_json(wire, &ty, bytes)?
        }
        "write-element" => {
            let bytes = values::parse(&args.data_type()?, args.text()?)?;
            wire.call(&WriteElement::new(at, &bytes)?, &mut reply)?;
            DONE
        }
        other => return Err(format!("unknown action: {other}").into()),
    })
}
