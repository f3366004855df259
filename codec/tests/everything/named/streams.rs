//! Calls the functions of streams, lists, names of variables, texts, and the tables of streams.

use ads_cnc::*;

use super::{ROOM, any, cnc, seen, text};

pub(super) fn runs(bytes: &[u8]) -> Result<(), Error> {
    texts(bytes);
    let handle: Handle = Decode::decode(bytes)?;
    let prefix: Result<(DescriptionRef<'_>, &[u8]), Error> = Decode::decode_prefix(bytes);
    seen(prefix.is_ok());
    seen(ExtendedDescription::decode(bytes).map(|it| ExtendedDescription::to_bytes(&it)));
    seen(Encode::encoded_len(&handle));
    seen(Encode::encode(&handle, &mut [0; 4]));
    descriptors(bytes)?;
    names(bytes)?;
    if let Err(error) = Handle::decode(bytes) {
        seen((Error::kind(&error), Error::field(&error), Error::offset(&error)));
        seen((Error::expected(&error), Error::found(&error)));
    }
    seen(VariableAccess::name(VariableAccess(any(1))));
    seen(Synchronisation::name(Synchronisation(any(1))));
    seen(Validity::name(Validity(any(1))));
    seen(VariableAccess::is_writable(VariableAccess(any(1))));
    seen(WriteAccess::name(WriteAccess(any(1))));
    seen(ads::AdsState::name(ads::AdsState(any(1))));
    seen(ads::Command::name(ads::Command(any(1))));
    seen(ads::StateFlags::name(ads::StateFlags(any(1))));
    seen(ads::AdsError::name(ads::AdsError(any(1))));
    seen(ads::AdsError::into_result(ads::AdsError(any(1))));
    seen(VariableType::name(VariableType(any(1))));
    seen(VariableType::data_type(VariableType(any(1))));
    seen(VariableType::element_size(VariableType(any(1))));
    seen(WriteAccess::is_writable(WriteAccess(any(1))));
    let count = sda::ElementLength::new(any(7));
    seen(sda::ElementLength::get(count));
    seen(sda::ElementWriteFlag::decode(bytes).map(sda::ElementWriteFlag::is_writable));
    let value = dynamic::DynamicValue::from_bits(any(7));
    seen((dynamic::DynamicValue::get(value), dynamic::DynamicValue::to_bits(value)));
    seen((Handle::to_bytes(&Handle(any(1))), ObjectCount::to_bytes(&ObjectCount(any(1)))));
    seen(VariableCount::to_bytes(&VariableCount(any(1))));
    seen(sda::ElementCount::to_bytes(&sda::ElementCount(any(1))));
    seen(sda::ElementWriteFlag::to_bytes(&sda::ElementWriteFlag(any(1))));
    seen(dynamic::DynamicCount::to_bytes(&dynamic::DynamicCount(any(1))));
    seen(dynamic::DynamicValue::to_bytes(dynamic::DynamicValue::from_bits(any(1))));
    seen(ads::ReadRequest::decode(bytes).map(|stream| ads::ReadRequest::to_bytes(&stream)));
    seen(ads::WriteReply::decode(bytes).map(|stream| ads::WriteReply::to_bytes(&stream)));
    seen(
        ads::DeviceStateReply::decode(bytes).map(|stream| ads::DeviceStateReply::to_bytes(&stream)),
    );
    seen(ads::AmsTcpHeader::decode(bytes).map(|stream| ads::AmsTcpHeader::to_bytes(&stream)));
    let query = sda::ObjectAddressQuery::decode(bytes);
    seen(query.map(|stream| sda::ObjectAddressQuery::to_bytes(&stream)));
    let address = sda::ObjectAddress::decode(bytes)?;
    seen(sda::ObjectAddress::to_bytes(&address));
    seen(sda::ObjectAddress::first_element(&address));
    frames(bytes)
}

fn frames(bytes: &[u8]) -> Result<(), Error> {
    if let Ok(Some((frame, len))) = ads::FrameRef::split(bytes, any(64)) {
        seen((ads::FrameRef::data(&frame), len));
        let header = ads::FrameRef::header(&frame);
        seen(ads::FrameRef::new(header, any(bytes)));
        seen((ads::AmsHeader::response(header), ads::AmsHeader::to_bytes(&header)));
        seen(ads::AmsHeader::request(header.target, header.source, header.command, any(1)));
        if let Ok(Some(call)) = operation::Call::from_frame(&frame) {
            let mut buf = [0; ROOM];
            seen((call.encoded_len(), call.encode(&mut buf)));
        }
    }
    seen(ads::AdsError::is_ok(ads::AdsError(any(7))));
    let reply = ads::DeviceInfoReply::decode(bytes)?;
    seen((ads::DeviceInfoReply::name(&reply), ads::DeviceInfoReply::to_bytes(&reply)));
    Ok(())
}

fn texts(bytes: &[u8]) {
    let text = cnc(bytes);
    seen((CncStr::len(&text), CncStr::is_empty(&text)));
    seen(CncStr::bytes(&text).fold(0, u8::wrapping_add));
    seen(CncStr::chars(&text).map(text::char_to_cp1252).filter(Option::is_some).count());
    seen(CncStr::new(super::text(bytes, "text")));
    seen(text == *super::text(bytes, "text"));
    for &byte in bytes {
        seen(text::cp1252_to_char(byte));
        seen(text::char_to_cp1252(text::cp1252_to_char(byte)));
    }
    let field = TextRef::with_tail(text, any(Some(bytes)));
    seen((TextRef::field_len(&field), TextRef::text(&field), TextRef::tail(&field)));
    seen(TextRef::new(super::text(bytes, "text")));
    let kind = Kind::from_field(field);
    seen((Kind::text(&kind), Kind::field(&kind)));
}

fn descriptors(bytes: &[u8]) -> Result<(), Error> {
    let text = text(bytes, "DINT");
    let made = Descriptor::new(text, any("DINT"))?;
    seen(Descriptor::from_text(cnc(bytes), cnc(bytes)));
    let made = Descriptor::with_id(made, any(1));
    let place = (address::IndexGroup::new(any(1)), address::IndexOffset::new(any(1)));
    let made = Descriptor::with_content(made, place.0, place.1);
    let made = Descriptor::with_size(made, any(4));
    let made = Descriptor::with_not_assigned(made, any(4));
    let made = Descriptor::with_write_access(made, WriteAccess(any(1)));
    seen((Descriptor::id(&made), Descriptor::index_group(&made), Descriptor::index_offset(&made)));
    seen((Descriptor::not_assigned(&made), Descriptor::size(&made)));
    seen((Descriptor::write_access(&made), Descriptor::data_type(&made)));
    seen((Descriptor::name(&made), Descriptor::type_name(&made), Descriptor::type_size(&made)));
    seen(Descriptor::to_bytes(&made));
    let view = Descriptor::as_ref(&made);
    seen((DescriptorRef::id(&view), DescriptorRef::index_group(&view)));
    seen((DescriptorRef::index_offset(&view), DescriptorRef::not_assigned(&view)));
    seen((DescriptorRef::size(&view), DescriptorRef::to_owned(view)));
    seen((DescriptorRef::write_access(&view), DescriptorRef::data_type(&view)));
    seen((DescriptorRef::name(&view), DescriptorRef::type_name(&view)));
    seen(DescriptorRef::type_size(&view));
    let list = DescriptorsRef::decode(bytes)?;
    seen((DescriptorsRef::len(&list), DescriptorsRef::is_empty(&list)));
    let part = DescriptorsRef::slice(&list, any(1), any(3));
    seen(DescriptorsRef::get(&part, any(1)));
    DescriptorsRef::iter(&part).for_each(seen);
    Ok(())
}

fn names(bytes: &[u8]) -> Result<(), Error> {
    let numbers = [any(1), any(2)];
    let numbers = U32List::from(&numbers);
    seen((U32List::len(&numbers), U32List::is_empty(&numbers), U32List::get(&numbers, any(1))));
    U32List::iter(&numbers).for_each(seen);
    let kind = Kind::new(text(bytes, "V.E"))?;
    let mut buf = [0; ROOM];
    let part = PathPart { name: cnc(bytes), indices: numbers };
    seen(VariablePath::write(kind, [part, part], &mut buf));
    seen(VariablePath::from_text(cnc(bytes)));
    let path = VariablePath::new(text(bytes, "V.A.AX[1].a"))?;
    seen((VariablePath::text(&path), VariablePath::kind(&path), VariablePath::axis(&path)));
    seen((VariablePath::variable(&path), VariablePath::elements(&path).len()));
    VariablePath::parts(&path).for_each(seen);
    seen(VariablePath::write_element(&path, numbers, &mut buf));
    seen(VariablePath::write_axis(&path, cnc(bytes), &mut buf));
    seen(VariablePath::write_without_axis(&path, &mut buf));
    Ok(())
}

pub(super) fn tables(bytes: &[u8]) -> Result<(), Error> {
    let name = text(bytes, "name");
    for stream in layout::Stream::all() {
        let table = layout::Stream::layout(stream);
        seen(layout::Layout::is_fixed(table));
        let field = layout::Field::whole(stream);
        seen((layout::Field::name(field), layout::Field::spec(field)));
        seen(layout::Subject::name(layout::Field::subject(field)));
        seen((layout::Field::stream(field), layout::Field::by_name(stream, name)));
        layout::Stream::fields(stream).for_each(seen);
        seen(layout::Stream::walk(stream, bytes, |segment| seen(segment.bytes)));
        let parts = bytes.chunks(4).map(|part| (any(field), part));
        seen(layout::Stream::join(stream, parts, &mut [0; ROOM]));
    }
    seen(layout::Stream::by_name(name));
    Ok(())
}
