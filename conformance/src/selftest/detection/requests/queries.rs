//! Queries of the values that the CNC lists, at most `LISTED_MAX` of each list, and queries with
//! similar names, indices and addresses.

use ads_cnc::address::{
    Addressing, Channel, ChannelAxis, Class, ElementAddress, IndexGroup, IndexOffset, PlatformAxis,
    Spindle,
};
use ads_cnc::ads::AmsPort;
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, Call, CountDynamic, CountElements, CountObjects,
    CountVariables, DescribeByIndex, DescribeByName, DescribeExtended, DynamicNameByIndex,
    DynamicValueByIndex, DynamicValueByName, FindInstance, HandleByName, ObjectList, ReadByHandle,
    ReadByName, ReadDescriptors, ReadElement, ReadElementLength, ReadElementName, ReadElementType,
    ReadElementUnit, ReadElementWriteFlag, ReadObject, Request,
};
use ads_cnc::sda::ObjectAddress;
use ads_cnc::service::ServiceVariable;
use ads_cnc::{
    CncStr, CncString, Decode, DescriptionRef, DescriptorsRef, Handle, Kind, U32List,
    VariableAccess,
};

use super::{AXES, CHANNELS, ContentAddress, ReplyRecorder, Variable, brackets, number, parts};
use crate::values::until_nul;

/// Maximum number of entries of a list that are requested.
const LISTED_MAX: u32 = 150;
/// A number whose low byte is 1, a number whose low 16 bits are 1, and the largest number.
const WIDE: [u32; 3] = [0x101, 0x1_0001, u32::MAX];
/// Names that are requested in each channel in addition to the listed names: variables that are
/// accessible by name only, a parameter, a kind, a structure, and unknown names.
const NAMES: [&str; 12] = [
    "V.CYC.count",
    "V.CYC.matrix",
    "V.L.depth",
    "V.P.count",
    "V.S.radius",
    "P1",
    "V.E",
    "V.E.unknown",
    "V.E.Testvarx",
    "V.E.struct1",
    "V.G.unknown[1]",
    "V.A.UNKNOWN",
];

impl ReplyRecorder<'_> {
    pub(super) fn variables(&mut self, channel: Channel) {
        let kinds = ["V.G", "V.E", "V.A", "", "V.P", "V.L", "V.S", "V.CYC", "V.X", "v.e", "V"];
        let first = self.variables.len();
        for text in kinds {
            let Ok(kind) = Kind::new(text) else { continue };
            let count = self.ask(CountVariables::new(channel, kind)).and_then(|data| number(&data));
            let listed = count.unwrap_or_default().min(LISTED_MAX);
            for index in (0..=listed).chain(count).chain(WIDE) {
                let data = self.ask(DescribeByIndex::new(channel, index, kind));
                self.ask(DescribeExtended::new(channel, index, kind));
                let found = data.as_ref().and_then(|data| DescriptionRef::decode(data).ok());
                if let Some(found) = found.filter(|_| index < listed) {
                    self.variables.push(Variable {
                        channel,
                        name: CncString::from(found.name.text()),
                        handle: Some(found.handle),
                        dimensions: found.dimensions.iter().collect(),
                        writable: found.access == VariableAccess::READ_WRITE,
                    });
                }
            }
        }
        let services = ServiceVariable::ALL.map(|variable| variable.name().to_string());
        let unlisted = NAMES.iter().map(|name| (*name).to_owned()).chain(services);
        let unlisted = unlisted.filter_map(|name| name.parse::<CncString>().ok());
        self.variables.extend(unlisted.map(|name| Variable {
            channel,
            name,
            handle: None,
            dimensions: Vec::new(),
            writable: true,
        }));
        let found = self.variables.get(first..).unwrap_or_default().to_vec();
        for variable in &found {
            self.variable(variable);
        }
    }

    /// Reads the whole value of a variable and some of its elements: by name, by the handle that
    /// the CNC returns for the name, and by the handle in the description.
    fn variable(&mut self, variable: &Variable) {
        let Variable { channel, name, handle, dimensions, .. } = variable;
        let text = name.to_string();
        let mut names = vec![text.clone(), text.to_lowercase(), format!("{text}.x")];
        let parts = parts(dimensions);
        names.extend(parts.iter().map(|part| format!("{text}{}", brackets(part))));
        for name in &names {
            self.named(*channel, name);
        }
        let by_name = HandleByName::new(*channel, &text).ok();
        let by_name = by_name.and_then(|op| self.ask(op)).and_then(|data| number(&data));
        let handles = [by_name.map(Handle), *handle].into_iter().flatten();
        for (first, handle) in handles.enumerate() {
            // The two handles are usually equal: then the elements are read only once.
            let parts =
                if first == 0 || by_name.map(Handle) != Some(handle) { &parts[..] } else { &[] };
            for part in [&[][..]].into_iter().chain(parts.iter().map(Vec::as_slice)) {
                self.ask(ReadByHandle::new(*channel, handle, U32List::from(part)));
            }
        }
    }

    pub(super) fn named(&mut self, channel: Channel, name: &str) {
        if let Ok(op) = ReadByName::new(channel, name) {
            self.ask(op);
        }
        if let Ok(op) = HandleByName::new(channel, name) {
            self.ask(op);
        }
        if let Ok(op) = DescribeByName::new(channel, name) {
            self.ask(op);
        }
    }

    pub(super) fn parameters(&mut self, channel: Channel) {
        for kind in DynamicKind::ALL {
            let count = self.ask(CountDynamic::new(channel, kind)).and_then(|data| number(&data));
            let listed = count.unwrap_or_default().min(LISTED_MAX);
            let mut names = vec!["P1".to_owned(), "P2".to_owned(), format!("{kind}.unknown")];
            for index in (1..=listed + 1).chain(WIDE) {
                let name = DynamicNameByIndex::new(channel, kind, index).ok();
                let name = name.and_then(|op| self.ask(op));
                let text =
                    name.as_deref().map(until_nul).and_then(|text| CncStr::from_bytes(text).ok());
                names.extend(text.map(|text| text.to_string()));
                if let Ok(op) = DynamicValueByIndex::new(channel, kind, index) {
                    self.ask(op);
                }
            }
            for name in names {
                for name in [name.to_lowercase(), format!("{name}x"), name] {
                    if let Ok(op) = DynamicValueByName::new(channel, kind, &name) {
                        self.ask(op);
                    }
                }
            }
        }
    }

    /// Reads the variables of the axis interface of a channel, by name and by handle.
    pub(super) fn axes(&mut self, channel: Channel) {
        for name in self.axis_names(channel) {
            for axis in AXES.iter().filter_map(|&axis| ChannelAxis::new(axis).ok()) {
                if let Ok(op) = AxisReadByName::new(channel, axis, &name) {
                    self.ask(op);
                }
                let handle = AxisHandleByName::new(channel, axis, &name).ok();
                let handle = handle.and_then(|op| self.ask(op)).and_then(|data| number(&data));
                if let Some(handle) = handle {
                    self.ask(ReadByHandle::new(channel, Handle(handle), U32List::EMPTY));
                }
            }
        }
    }

    /// The names of the V.A variables of a channel, with and without the axis, and unknown names.
    pub(super) fn axis_names(&self, channel: Channel) -> Vec<String> {
        let mine = self.variables.iter().filter(|one| one.channel == channel);
        let full = mine.map(|one| one.name.to_string()).filter(|name| name.starts_with("V.A."));
        let mut names: Vec<String> = full.collect();
        let short = names.iter().filter_map(|name| name.rsplit_once('.'));
        let short: Vec<String> = short.map(|(name, _)| name.to_owned()).collect();
        names.extend(short);
        names.sort_unstable();
        names.dedup();
        names
    }

    pub(super) fn objects(&mut self) {
        let channels = CHANNELS.iter().flat_map(|&number| {
            [Channel::new(number).ok(), Channel::by_index(number).ok()].into_iter().flatten()
        });
        let axes = AXES.iter().filter_map(|&axis| PlatformAxis::new(axis).ok());
        let lists: Vec<ObjectList> = [ObjectList::PLATFORM]
            .into_iter()
            .chain(channels.map(ObjectList::from))
            .chain(axes.map(ObjectList::from))
            .collect();
        for list in lists {
            let Some(count) = self.ask(CountObjects::new(list)) else { continue };
            let count = number(&count).unwrap_or_default();
            let listed = count.min(LISTED_MAX);
            let singles = (1..=listed + 1).chain([count.saturating_add(1)]).chain(WIDE);
            let ranges = [(1, 2), (1, listed), (1, 252), (listed, 2), (2, listed), (WIDE[0], 3)];
            for (first, many) in singles.map(|first| (first, 1)).chain(ranges) {
                let Ok(op) = ReadDescriptors::new(list, first, many) else { continue };
                let Some(data) = self.ask(op) else { continue };
                let Ok(found) = DescriptorsRef::decode(&data) else { continue };
                for object in found.iter().filter(|_| many == 1) {
                    let (group, offset) = (object.index_group(), object.index_offset());
                    self.contents.push(ContentAddress {
                        group,
                        offset,
                        element: None,
                        size: object.size(),
                    });
                    self.object(group, offset, object.size());
                }
            }
        }
    }

    fn object(&mut self, group: IndexGroup, offset: IndexOffset, size: u32) {
        let by_rank = IndexGroup::new(group.get() ^ 0x10_0000);
        let next_axis = IndexOffset::new(offset.get().saturating_add(0x1_0000));
        let short_stride = IndexOffset::new(offset.get().saturating_add(0x1000));
        for (group, offset, size) in [
            (group, offset, size),
            (group, offset, 4096),
            (group, offset, size.saturating_sub(1)),
            (by_rank, offset, size),
            (group, next_axis, size),
            (group, short_stride, size),
        ] {
            if let Ok(op) = ReadObject::new(group, offset, size) {
                self.ask(op);
            }
        }
    }

    pub(super) fn elements(&mut self) {
        for class in Class::ALL {
            let mut addresses: Vec<ElementAddress> = Vec::new();
            for channel in [0].into_iter().chain(CHANNELS) {
                for axis in [0].into_iter().chain(AXES).chain(WIDE) {
                    let query = FindInstance::new(class, channel, axis);
                    let found = self.ask(query).and_then(|data| ObjectAddress::decode(&data).ok());
                    addresses.extend(found.and_then(|found| found.first_element().ok().flatten()));
                    self.ask(query.by_index());
                }
            }
            let channels = CHANNELS.iter().filter_map(|&number| Channel::new(number).ok());
            let ranks = CHANNELS.iter().filter_map(|&rank| Channel::by_index(rank).ok());
            for channel in channels.chain(ranks) {
                addresses.extend(ElementAddress::for_channel(channel, class, 0).ok());
                for axis in AXES.iter().filter_map(|&axis| ChannelAxis::new(axis).ok()) {
                    addresses.extend(ElementAddress::for_axis(channel, class, axis, 0).ok());
                }
            }
            let spindles = [0].into_iter().chain(AXES).filter_map(|index| Spindle::new(index).ok());
            let spindles = spindles.filter(|_| class == Class::Spindle);
            addresses.extend(spindles.filter_map(|one| ElementAddress::for_spindle(one, 0).ok()));
            addresses.sort_unstable_by_key(|one| {
                let parts = one.class_group();
                (parts.instance, parts.addressing == Addressing::Index, one.index_offset().get())
            });
            addresses.dedup();
            for address in addresses {
                self.instance(address);
            }
        }
    }

    fn instance(&mut self, first: ElementAddress) {
        let count = CountElements::new(first).ok().and_then(|op| self.ask(op));
        let name = self.ask(ReadElementName { element: first });
        if count.is_none() && name.is_none() {
            return;
        }
        let count = count.as_deref().and_then(number).unwrap_or_default().min(LISTED_MAX);
        for place in 0..=count.saturating_add(1) {
            let Ok(element) = first.nth(place) else { continue };
            self.ask(ReadElementName { element });
            self.ask(ReadElementType { element });
            self.ask(ReadElementUnit { element });
            self.ask(ReadElementWriteFlag { element });
            let size = self.ask(ReadElementLength { element });
            let size = size.map_or(8, |data| {
                data.iter().rev().fold(0_u32, |size, &byte| size.wrapping_shl(8) | u32::from(byte))
            });
            let content = ContentAddress {
                group: element.group(ads_cnc::address::Attribute::Content),
                offset: element.index_offset(),
                element: Some(element),
                size,
            };
            self.contents.push(content);
            for length in [size, size.saturating_sub(1), 256] {
                let Ok(op) = ReadElement::new(element, length) else { continue };
                self.ask(op);
                self.of_geo(op);
            }
        }
    }

    /// Sends the request to the port of GEO instead of SDA.
    fn of_geo<'a>(&mut self, request: impl Into<Request<'a>>) {
        let request = request.into();
        let mut buf = vec![0; request.encoded_len()];
        if let Ok(call) = request.encode(&mut buf) {
            self.call(&Call { port: AmsPort::GEO, ..call });
        }
    }
}
