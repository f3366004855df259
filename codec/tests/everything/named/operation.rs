//! Calls the functions of operations, and those of the table of functions.

use ads_cnc::address::{Channel, ChannelAxis, ElementAddress, IndexGroup, IndexOffset};
use ads_cnc::operation::{AdsService, Request, Task};
use ads_cnc::*;

use super::{ROOM, any, seen, text};

/// Calls the methods of the trait `Operation` on the operation, such as `decode_reply` with the
/// bytes as the reply. Returns the operation; `None` for an error.
fn ask<'a, T: operation::Operation + Into<Request<'a>>>(
    op: Result<T, Error>,
    bytes: &[u8],
) -> Option<T> {
    let (op, mut buf) = (op.ok()?, [0; ROOM]);
    seen((operation::Operation::index_group(&op), operation::Operation::index_offset(&op)));
    seen((operation::Operation::read_length(&op), operation::Operation::encoded_len(&op)));
    seen((operation::Operation::port(&op), operation::Operation::service(&op)));
    seen(operation::Operation::encode(&op, &mut buf));
    seen(operation::Operation::call(&op, &mut buf));
    seen(operation::Operation::decode_reply(&op, bytes).is_ok());
    Some(op)
}

fn request(request: Request<'_>, bytes: &[u8]) {
    let mut buf = [0; ROOM];
    seen((operation::Request::function(&request), operation::Request::encoded_len(&request)));
    seen(operation::Request::decode_reply(&request, bytes));
    if let Ok(call) = operation::Request::encode(&request, &mut buf) {
        seen(operation::Call::dispatch(&call).map_err(operation::DispatchError::ads_error));
    }
}

pub(super) fn makers(bytes: &[u8]) -> Result<(), Error> {
    let (channel, axis) = (Channel::new(any(1))?, ChannelAxis::new(any(1))?);
    let (name, kind) = (text(bytes, "V.E.a"), Kind::new(text(bytes, "V.E"))?);
    let (handle, number) = (Handle(any(1)), any(1));
    let indices = [any(3)];
    let indices = U32List::from(&indices);
    ask(operation::AxisHandleByName::new(channel, axis, name), bytes);
    ask(operation::AxisReadByName::new(channel, axis, name), bytes);
    ask(operation::AxisWriteByName::new(channel, axis, name, bytes), bytes);
    ask(operation::HandleByName::new(channel, name), bytes);
    ask(operation::ReadByName::new(channel, name), bytes);
    ask(operation::WriteByName::new(channel, name, bytes), bytes);
    ask(operation::DescribeByName::new(channel, name), bytes);
    ask(Ok(operation::DescribeByIndex::new(channel, number, kind)), bytes);
    ask(Ok(operation::DescribeExtended::new(channel, number, kind)), bytes);
    ask(Ok(operation::CountVariables::new(channel, kind)), bytes);
    ask(Ok(operation::ReadByHandle::new(channel, handle, indices)), bytes);
    ask(Ok(operation::WriteByHandle::new(channel, handle, indices, bytes)), bytes);
    ask(Ok(operation::WriteProgramStream::new(channel, bytes)), bytes);
    let of = any(dynamic::DynamicKind::VL);
    ask(Ok(operation::CountDynamic::new(channel, of)), bytes);
    ask(operation::DynamicNameByIndex::new(channel, of, number), bytes);
    ask(operation::DynamicValueByIndex::new(channel, of, number), bytes);
    ask(operation::DynamicValueByName::new(channel, of, name), bytes);
    let find = operation::FindInstance::new(any(address::Class::Hld), number, number);
    let find = ask(Ok(operation::FindInstance::by_index(find)), bytes);
    seen(find.map(|op| operation::FindInstance::class_group(&op)));
    seen(find.map(|op| operation::FindInstance::query(&op)));

    ask(Ok(operation::CountObjects::new(channel)), bytes);
    let read = ask(operation::ReadDescriptors::new(channel, number, any(2)), bytes);
    if let Some(read) = read {
        let list = operation::ReadDescriptors::list(&read);
        seen((operation::ObjectList::index_group(list), operation::ObjectList::parts(list)));
        seen((operation::ReadDescriptors::first(&read), operation::ReadDescriptors::count(&read)));
    }
    let (group, offset) = (IndexGroup::new(any(0x12_0101)), IndexOffset::new(any(1)));
    let read = ask(operation::ReadObject::new(group, offset, any(4)), bytes);
    let write = ask(operation::WriteObject::new(group, offset, bytes), bytes);
    seen(read.map(|op| operation::ReadObject::address(&op)));
    if let Some(op) = write {
        seen((operation::WriteObject::address(&op), operation::WriteObject::content(&op)));
    }
    if let Ok(object) = DescriptorRef::decode(bytes) {
        seen((operation::ReadObject::of(object), operation::WriteObject::of(object, any(true))));
    }
    arguments(channel, handle, bytes)?;
    elements(ElementAddress::for_channel(channel, any(address::Class::Hld), any(1))?, bytes);

    Ok(())
}

/// Converts names and values of several of the types that constructors accept, and makes writes
/// with these values.
fn arguments(channel: Channel, handle: Handle, bytes: &[u8]) -> Result<(), Error> {
    let text = text(bytes, "V.E.a");
    let path = VariablePath::new(text)?;
    seen((operation::IntoName::into_name(text), operation::IntoName::into_name(path)));
    seen(operation::IntoName::into_name(path.text()));
    let value = |value: operation::WriteValue<'_>| {
        seen(operation::WriteValue::as_bytes(&value).len());
        ask(Ok(operation::WriteByHandle::new(channel, handle, &[1, 2], value)), bytes);
    };
    value(any(1_i8).into());
    value(any(1_u8).into());
    value(any(1_i16).into());
    value(any(1_u16).into());
    value(any(1_i32).into());
    value(any(1_u32).into());
    value(any(1_i64).into());
    value(any(1_u64).into());
    value(any(1.0_f32).into());
    value(any(1.0_f64).into());
    value(any(true).into());
    value(value::Boolean(any(1)).into());
    value(ValueRef { bytes }.into());
    value(ContentRef { bytes }.into());
    Ok(())
}

fn elements(element: ElementAddress, bytes: &[u8]) {
    let count = ask(operation::CountElements::new(element), bytes);
    seen(count.map(|op| operation::CountElements::element(&op)));
    let read = ask(operation::ReadElement::new(element, any(4)), bytes);
    seen(read.map(|op| operation::ReadElement::element(&op)));
    let write = ask(operation::WriteElement::new(element, bytes), bytes);
    seen(write.map(|op| operation::WriteElement::element(&op)));
    if let Some(op) = write {
        seen(operation::WriteElement::content(&op));
    }
    ask(Ok(operation::ReadElementName::new(element)), bytes);
    ask(Ok(operation::ReadElementType::new(element)), bytes);
    ask(Ok(operation::ReadElementLength::new(element)), bytes);
    ask(Ok(operation::ReadElementUnit::new(element)), bytes);
    let flag = operation::ReadElementWriteFlag::new(element);
    ask(Ok(flag), bytes);
    request(flag.into(), bytes);
}

pub(super) fn rules(bytes: &[u8]) -> Result<(), Error> {
    let (group, offset) = (IndexGroup::new(any(0x12_2301)), IndexOffset::new(any(0x46)));
    for function in operation::Function::ALL.iter().copied() {
        let spec = operation::Function::spec(function);
        seen(operation::FunctionSpec::is_content(spec));
        seen(operation::GroupRule::example(spec.group));
        seen(operation::OffsetRule::contains(spec.offset, offset));
        seen(group.parts().map(|parts| operation::GroupRule::contains(spec.group, parts)));
    }
    for service in [AdsService::Read, AdsService::Write, AdsService::ReadWrite] {
        seen(operation::AdsService::command(service));
    }
    for task in [Task::Com, Task::Geo, Task::Sda].map(any) {
        let (port, service) = (operation::Task::port(task), any(AdsService::ReadWrite));
        seen(operation::Task::from_port(ads::AmsPort(any(port.0))));
        let (index_group, index_offset, read_length) = (group, offset, any(4));
        let call =
            operation::Call { port, service, index_group, index_offset, read_length, data: bytes };
        match operation::Call::dispatch(&call) {
            Ok(found) => request(found, bytes),
            Err(error_of) => seen(operation::DispatchError::ads_error(error_of)),
        }
    }
    Ok(())
}
