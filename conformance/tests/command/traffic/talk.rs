//! Conversations with the simulated CNC, recorded by the client, from which tests make captures.

use crate::common::file::MemoryFile;
use ads_cnc::Kind;
use ads_cnc::address::{Channel, Class, ElementAddress};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{
    CountDynamic, CountElements, CountObjects, CountVariables, DescribeByIndex, DescribeExtended,
    DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, FindInstance, HandleByName,
    ReadByHandle, ReadByName, ReadDescriptors, ReadElement, ReadElementLength, ReadElementName,
    ReadElementType, ReadElementUnit, ReadElementWriteFlag, ReadObject,
};
use ads_cnc::{Decode as _, Description, Encode as _, U32List};
use ads_cnc_conformance::capture::Capture;
use ads_cnc_conformance::faults::{Faulty, FieldDefect};
use ads_cnc_conformance::gate::Gate;
use ads_cnc_conformance::session::Session;
use ads_cnc_conformance::simulator::Cnc;

use super::maker::{Link, Message, messages, pcap, segments};

/// Runs `talk` with a simulated CNC with this defect; returns the bytes that each side sent.
pub(crate) fn conversation(
    defect: Option<&FieldDefect>,
    talk: impl FnOnce(&mut Session),
) -> Vec<Message> {
    let seeded = defect.cloned().map(Into::into);
    let cnc = Faulty::new(Cnc::with_default_model().unwrap(), seeded.as_ref());
    let memory = MemoryFile::default();
    let capture = Capture::new(Box::new(memory.clone())).unwrap();
    let session = Session::simulated(cnc, Gate::queries()).unwrap();
    let mut session = session.with_capture(capture);
    talk(&mut session);
    drop(session);
    let bytes = memory.0.lock().unwrap();
    messages(&bytes)
}

/// The conversation as a capture at the default port of AMS/TCP.
pub(crate) fn recorded(defect: Option<&FieldDefect>, talk: impl FnOnce(&mut Session)) -> Vec<u8> {
    pcap(&segments(&conversation(defect, talk), 1460, (1, 1)), Link::Ethernet)
}

/// Sends queries about objects, variables, elements and parameters; ignores missing replies.
pub(crate) fn everything(session: &mut Session) {
    let channel = Channel::new(1).unwrap();
    objects(session, channel);
    variables(session, channel);
    elements(session, channel);
    parameters(session, channel);
}

/// A short conversation, which reads two numbers.
pub(crate) fn a_little(session: &mut Session) {
    let channel = Channel::new(1).unwrap();
    let _ = session.call(&CountObjects::new(channel)).is_ok();
    let _ = session.call(&CountVariables::new(channel, Kind::V_E)).is_ok();
}

fn objects(session: &mut Session, channel: Channel) {
    let _ = session.call(&CountObjects::new(channel)).is_ok();
    let mut contents = Vec::new();
    for first in 1..=6 {
        if let Ok(all) = session.call(&ReadDescriptors::new(channel, first, 1).unwrap()) {
            contents
                .extend(all.iter().map(|one| (one.index_group(), one.index_offset(), one.size())));
        }
    }
    let _ = session.call(&ReadDescriptors::new(channel, 1, 4).unwrap()).is_ok();
    for (group, offset, size) in contents {
        if let Ok(read) = ReadObject::new(group, offset, size) {
            let _ = session.call(&read).is_ok();
        }
    }
}

fn variables(session: &mut Session, channel: Channel) {
    for kind in [Kind::ALL, Kind::V_G, Kind::V_E, Kind::V_A] {
        let _ = session.call(&CountVariables::new(channel, kind)).is_ok();
    }
    let mut described = Vec::new();
    for kind in [Kind::V_G, Kind::V_E, Kind::V_A] {
        let count = session.call(&CountVariables::new(channel, kind)).map_or(0, |count| count.0);
        for index in 0..count.clamp(1, 8) {
            if let Ok(one) = session.call(&DescribeByIndex::new(channel, index, kind)) {
                described.push(Description::decode(&one.encode_to_vec().unwrap()).unwrap());
            }
            let _ = session.call(&DescribeExtended::new(channel, index, kind)).is_ok();
        }
    }
    for one in described {
        let name = one.name.text.to_string();
        let Ok(by_name) = HandleByName::new(channel, &name) else { continue };
        let handle = session.call(&by_name).unwrap_or(one.handle);
        let _ = session.call(&ReadByHandle::new(channel, handle, U32List::EMPTY)).is_ok();
        if !one.dimensions.is_empty() {
            let first = vec![0; one.dimensions.len()];
            let read = ReadByHandle::new(channel, handle, U32List::from(&first[..]));
            let _ = session.call(&read).is_ok();
        }
        let _ = session.call(&ReadByName::new(channel, &name).unwrap()).is_ok();
    }
}

fn elements(session: &mut Session, channel: Channel) {
    for class in [Class::Hld, Class::Interpolator, Class::Decoder] {
        let _ = session.call(&FindInstance::new(class, 1, 0)).is_ok();
        let first = ElementAddress::for_channel(channel, class, 0).unwrap();
        let _ = session.call(&CountElements::new(first).unwrap()).is_ok();
        let _ = session.call(&ReadElementName::new(first)).is_ok();
    }
    for place in 1..=3 {
        let element = ElementAddress::for_channel(channel, Class::Hld, place).unwrap();
        let _ = session.call(&ReadElementName::new(element)).is_ok();
        let _ = session.call(&ReadElementType::new(element)).is_ok();
        let _ = session.call(&ReadElementUnit::new(element)).is_ok();
        let _ = session.call(&ReadElementWriteFlag::new(element)).is_ok();
        let _ = session.call(&ReadElementLength::new(element)).is_ok();
        if let Ok(length) = session.call(&ReadElementLength::new(element)) {
            let length = length.get();
            if let Ok(read) = ReadElement::new(element, length) {
                let _ = session.call(&read).is_ok();
            }
        }
    }
}

fn parameters(session: &mut Session, channel: Channel) {
    for kind in DynamicKind::ALL {
        let _ = session.call(&CountDynamic::new(channel, kind)).is_ok();
        let name = DynamicNameByIndex::new(channel, kind, 1).unwrap();
        let name = session.call(&name).map(|name| name.name.text().to_string());
        if let Ok(by_name) = DynamicValueByName::new(channel, kind, name.as_deref().unwrap_or("P1"))
        {
            let _ = session.call(&by_name).is_ok();
        }
        let _ = session.call(&DynamicValueByIndex::new(channel, kind, 1).unwrap()).is_ok();
        let _ = session.call(&CountDynamic::new(channel, kind)).is_ok();
    }
}
