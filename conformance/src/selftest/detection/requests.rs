//! Every request that a mode may send, to tell two CNCs apart.
//!
//! The requests follow from the function table, from what the asked CNC says it has, from boundary
//! values and from short sequences; never from the cases of the suite. Two CNCs that answer all of
//! them alike are asked the same, so equal digests mean equal answers.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::address::{
    Addressing, Channel, ChannelAxis, Class, ElementAddress, IndexGroup, IndexOffset, PlatformAxis,
    Spindle,
};
use ads_cnc::ads::{AmsPort, DeviceInfoReply, DeviceStateReply};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, AxisWriteByName, Call, CountDynamic, CountElements,
    CountObjects, CountVariables, DescribeByIndex, DescribeByName, DescribeExtended,
    DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, FindInstance, Function,
    HandleByName, ObjectList, ReadByHandle, ReadByName, ReadDescriptors, ReadElement,
    ReadElementLength, ReadElementName, ReadElementType, ReadElementUnit, ReadElementWriteFlag,
    ReadObject, Request, Service, Task, WriteByHandle, WriteByName, WriteElement, WriteObject,
    WriteProgramStream,
};
use ads_cnc::sda::ObjectAddress;
use ads_cnc::service::ServiceVariable;
use ads_cnc::{
    CncStr, CncString, Decode, DescriptionRef, DescriptorsRef, Handle, Kind, U32List,
    VariableAccess,
};

use crate::client::{Client, Inquiry};
use crate::exchange::ExchangeError;
use crate::simulator::Cnc;
use crate::simulator::program::digest;
use crate::text::hex::compact;
use crate::values::until_nul;

/// Channel numbers and ranks that are asked for; a CNC with more is asked for these alone.
const CHANNELS: [u32; 14] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 255];
/// Axes, places and spindles that are asked for.
const AXES: [u32; 7] = [1, 2, 3, 4, 5, 6, 255];
/// The most entries of a list that are asked for, whatever its number says.
const LISTED_MAX: u32 = 150;
/// Numbers whose low byte or low half is a small one.
const WIDE: [u32; 3] = [0x101, 0x1_0001, u32::MAX];
/// Names that no model lists: by name only, of the Service Interface, and unknown ones.
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
/// How many requests of a function are also sent malformed.
const MALFORMED_EACH: usize = 6;

#[derive(Clone)]
struct Variable {
    channel: Channel,
    name: CncString,
    handle: Option<Handle>,
    dimensions: Vec<u32>,
    writable: bool,
}

/// A content with an address that was found, of an object or an element.
struct ContentAddress {
    group: IndexGroup,
    offset: IndexOffset,
    element: Option<ElementAddress>,
    size: u32,
}

/// A CNC that is asked, and the digest of each answer.
pub(super) struct Dialogue<'t> {
    client: Client,
    cnc: Arc<Cnc>,
    right: Option<&'t [u64]>,
    answers: Vec<u64>,
    difference: Option<String>,
    malformed: BTreeMap<Function, usize>,
    variables: Vec<Variable>,
    contents: Vec<ContentAddress>,
}

/// What came of asking everything.
pub(super) struct RecordedAnswers {
    pub(super) answers: Vec<u64>,
    /// The first request that was answered otherwise than by the CNC it was compared with.
    pub(super) difference: Option<String>,
}

/// Asks a CNC everything that its client's gate lets through; up to the first answer that is not
/// this one of another CNC, if there is one to compare with.
pub(super) fn ask_everything(
    client: Client,
    cnc: Arc<Cnc>,
    right: Option<&[u64]>,
) -> RecordedAnswers {
    let mut dialogue = Dialogue {
        client,
        cnc,
        right,
        answers: Vec::new(),
        difference: None,
        malformed: BTreeMap::new(),
        variables: Vec::new(),
        contents: Vec::new(),
    };
    dialogue.everything();
    let Dialogue { answers, mut difference, .. } = dialogue;
    if difference.is_none() && right.is_some_and(|right| right.len() != answers.len()) {
        difference = Some("the end: the other CNC is asked more".to_owned());
    }
    RecordedAnswers { answers, difference }
}

impl Dialogue<'_> {
    fn everything(&mut self) {
        self.queries();
        if self.client.gate().may_let_writes_pass() {
            self.writes();
            self.streams();
            self.services();
        }
        // Again: some answers differ only after others, or after writes. And in time.
        self.queries();
        for _ in 0..12 {
            self.cnc.pass(Duration::from_secs(1));
            self.channels().into_iter().for_each(|channel| self.parameters(channel));
        }
    }

    fn queries(&mut self) {
        self.variables.clear();
        self.contents.clear();
        for port in [Task::Geo, Task::Sda, Task::Com].map(Task::port) {
            self.inquire::<DeviceInfoReply>(port);
            self.inquire::<DeviceStateReply>(port);
        }
        for channel in self.channels() {
            self.variables(channel);
            self.parameters(channel);
            self.axes(channel);
        }
        self.objects();
        self.elements();
    }

    /// Sends a request that the gate lets through; the data of a success.
    fn ask<'a>(&mut self, request: impl Into<Request<'a>>) -> Option<Vec<u8>> {
        let request = request.into();
        let mut buf = vec![0; request.encoded_len()];
        let call = request.encode(&mut buf).ok()?;
        let data = self.call(&call);
        let sent = self.malformed.entry(request.function()).or_default();
        *sent += 1;
        if *sent <= MALFORMED_EACH && self.client.gate().lets_malformed_pass() {
            self.spoilt(&call, data.as_ref().map_or(0, Vec::len));
        }
        data
    }

    /// What one request becomes by one fault each.
    fn spoilt(&mut self, call: &Call<'_>, answered: usize) {
        let longer = [call.data, &[0]].concat();
        let shorter = |count: usize| call.data.get(..call.data.len().checked_sub(count)?);
        let data = [Some(&longer[..]), shorter(1), shorter(4), Some(&[][..])];
        for data in data.into_iter().flatten() {
            self.call(&Call { data, ..*call });
        }
        for service in [Service::Read, Service::Write, Service::ReadWrite] {
            self.call(&Call { service, ..*call });
        }
        for port in [0, 550, 551, 552, 553, 554, 10_000, 65_535].map(AmsPort) {
            self.call(&Call { port, ..*call });
        }
        let answered = u32::try_from(answered).unwrap_or(u32::MAX);
        for read_length in [0, 1, answered.saturating_sub(1), answered, u32::MAX] {
            self.call(&Call { read_length, ..*call });
        }
        for bit in 0..32 {
            let flipped = |number: u32| number ^ 1_u32.wrapping_shl(bit);
            let index_group = IndexGroup::new(flipped(call.index_group.get()));
            self.call(&Call { index_group, ..*call });
            let index_offset = IndexOffset::new(flipped(call.index_offset.get()));
            self.call(&Call { index_offset, ..*call });
        }
    }

    fn call(&mut self, call: &Call<'_>) -> Option<Vec<u8>> {
        if self.difference.is_some() {
            return None;
        }
        let exchange = self.client.call(call);
        let fault = match &exchange.outcome {
            Err(ExchangeError::Refused(_) | ExchangeError::Unsendable(_)) => return None,
            Err(fault) => fault.to_string(),
            Ok(_) => String::new(),
        };
        let violations = exchange.violations.iter().map(|one| one.what.as_str());
        let said: Vec<&str> = violations.chain([fault.as_str()]).collect();
        self.record(&exchange.received, &said.join("\n"), || {
            let spec = call.dispatch().map(|request| request.function().spec().name);
            let data = compact::show(call.data);
            format!("{} to port {}: {exchange} [{data}]", spec.unwrap_or("no function"), call.port)
        });
        exchange.answer().and_then(|answer| answer.success()).map(<[u8]>::to_vec)
    }

    fn inquire<R: Inquiry>(&mut self, port: AmsPort) {
        if self.difference.is_none() {
            let inquired = self.client.inquire::<R>(port);
            let said = inquired.outcome.as_ref().err().map(ToString::to_string);
            self.record(&inquired.received, &said.unwrap_or_default(), || inquired.to_string());
        }
    }

    fn record(&mut self, received: &[u8], said: &str, request: impl FnOnce() -> String) {
        let answer = digest(&[received, said.as_bytes()].concat());
        let right = self.right.is_none_or(|right| right.get(self.answers.len()) == Some(&answer));
        if !right {
            self.difference = Some(request());
        }
        self.answers.push(answer);
    }

    /// The channels that answer at all, by number and by rank.
    fn channels(&mut self) -> Vec<Channel> {
        let numbers = CHANNELS.iter().filter_map(|&number| Channel::new(number).ok());
        let ranks = CHANNELS.iter().filter_map(|&rank| Channel::by_index(rank).ok());
        numbers
            .chain(ranks)
            .filter(|&channel| {
                let variables = self.ask(CountVariables::new(channel, Kind::V_E));
                let parameters = self.ask(CountDynamic::new(channel, DynamicKind::P));
                variables.or(parameters).is_some()
            })
            .collect()
    }

    fn variables(&mut self, channel: Channel) {
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

    /// By name, by the handle of that name and by the described one, whole and in parts.
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
            // Both handles are the same as a rule: the parts are then asked for once.
            let parts =
                if first == 0 || by_name.map(Handle) != Some(handle) { &parts[..] } else { &[] };
            for part in [&[][..]].into_iter().chain(parts.iter().map(Vec::as_slice)) {
                self.ask(ReadByHandle::new(*channel, handle, U32List::from(part)));
            }
        }
    }

    fn named(&mut self, channel: Channel, name: &str) {
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

    fn parameters(&mut self, channel: Channel) {
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

    /// The axis interface of a channel.
    fn axes(&mut self, channel: Channel) {
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

    /// Names of V.A with and without their axis, and one that is not there.
    fn axis_names(&self, channel: Channel) -> Vec<String> {
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

    fn objects(&mut self) {
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

    fn elements(&mut self) {
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

    /// The same of the other task that has the classes.
    fn of_geo<'a>(&mut self, request: impl Into<Request<'a>>) {
        let request = request.into();
        let mut buf = vec![0; request.encoded_len()];
        if let Ok(call) = request.encode(&mut buf) {
            self.call(&Call { port: AmsPort::GEO, ..call });
        }
    }

    /// Each writable value: another one, too short and too long ones, and the one before again.
    fn writes(&mut self) {
        for variable in std::mem::take(&mut self.variables) {
            if variable.writable {
                self.write_variable(&variable);
            }
        }
        for content in std::mem::take(&mut self.contents) {
            let ContentAddress { group, offset, element, size } = content;
            let read = |dialogue: &mut Self| match element {
                Some(element) => {
                    ReadElement::new(element, size).ok().and_then(|op| dialogue.ask(op))
                }
                None => ReadObject::new(group, offset, size).ok().and_then(|op| dialogue.ask(op)),
            };
            let Some(before) = read(self) else { continue };
            for value in others(&before).into_iter().chain([before]) {
                match element {
                    Some(element) => {
                        WriteElement::new(element, &value).ok().and_then(|op| self.ask(op));
                    }
                    None => {
                        WriteObject::new(group, offset, &value).ok().and_then(|op| self.ask(op));
                    }
                }
                read(self);
                let neighbour = IndexOffset::new(offset.get().saturating_add(1));
                if let (None, Ok(op)) = (element, ReadObject::new(group, neighbour, 256)) {
                    self.ask(op);
                }
            }
        }
        for channel in self.channels() {
            self.variables(channel);
            for name in self.axis_names(channel) {
                for axis in AXES.iter().filter_map(|&axis| ChannelAxis::new(axis).ok()) {
                    let Ok(read) = AxisReadByName::new(channel, axis, &name) else { continue };
                    let Some(before) = self.ask(read) else { continue };
                    for value in others(&before).into_iter().chain([before]) {
                        let Ok(op) = AxisWriteByName::new(channel, axis, &name, &value) else {
                            continue;
                        };
                        self.ask(op);
                        for place in (1..=3).filter_map(|place| ChannelAxis::new(place).ok()) {
                            let read = AxisReadByName::new(channel, place, &name).ok();
                            read.and_then(|op| self.ask(op));
                        }
                    }
                }
            }
        }
    }

    fn write_variable(&mut self, variable: &Variable) {
        let Variable { channel, name, handle, dimensions, .. } = variable;
        let text = name.to_string();
        let mut names = vec![text.clone()];
        names.extend(parts(dimensions).iter().map(|part| format!("{text}{}", brackets(part))));
        for name in &names {
            let Ok(read) = ReadByName::new(*channel, name) else { continue };
            let Some(before) = self.ask(read) else { continue };
            for value in others(&before).into_iter().chain([before]) {
                if let Ok(op) = WriteByName::new(*channel, name, &value) {
                    self.ask(op);
                    self.read_back(*channel, &text, *handle);
                }
            }
        }
        let by_name = HandleByName::new(*channel, &text).ok();
        let by_name = by_name.and_then(|op| self.ask(op)).and_then(|data| number(&data));
        let Some(handle) = by_name.map(Handle) else { return };
        for part in [Vec::new()].into_iter().chain(parts(dimensions)) {
            let indices = U32List::from(&part[..]);
            let Some(before) = self.ask(ReadByHandle::new(*channel, handle, indices)) else {
                continue;
            };
            for value in others(&before).into_iter().chain([before]) {
                self.ask(WriteByHandle::new(*channel, handle, indices, &value));
                self.read_back(*channel, &text, Some(handle));
            }
        }
    }

    /// A variable after a write: whole, by name and by handle, and in all other channels.
    fn read_back(&mut self, channel: Channel, name: &str, handle: Option<Handle>) {
        let others = [Channel::new(1).ok(), Channel::new(2).ok()].into_iter().flatten();
        for channel in [channel].into_iter().chain(others) {
            if let Ok(op) = ReadByName::new(channel, name) {
                self.ask(op);
            }
        }
        if let Some(handle) = handle {
            self.ask(ReadByHandle::new(channel, handle, U32List::EMPTY));
        }
    }

    /// NC text: complete lines, one without its end, too much at once, and more than there is room
    /// for.
    fn streams(&mut self) {
        let long = [&[b'X'; 990][..], b"\r\n"].concat();
        let longer = [&[b'X'; 991][..], b"\r\n"].concat();
        let texts: [&[u8]; 8] = [
            b"N10 X1\r\n",
            b"N20 X2\r\nN30 X3\r\n",
            b"N40 X4",
            b"N50 $WHILE 1\r\n",
            b"N60: X1\r\nN70 $GOTO N60\r\n",
            b"N80 M30\r\nN90 X9\r\n",
            &long,
            &longer,
        ];
        for channel in self.channels() {
            for text in texts.into_iter().chain([&long[..]; 6]) {
                self.ask(WriteProgramStream::new(channel, text));
            }
            self.cnc.pass(Duration::from_secs(5));
            for text in texts {
                self.ask(WriteProgramStream::new(channel, text));
                self.cnc.pass(Duration::from_secs(1));
            }
        }
    }

    /// The variables of the Service Interface, in the order of a service and in others.
    fn services(&mut self) {
        let writes: [(ServiceVariable, &[u8]); 8] = [
            (ServiceVariable::Uuid, b"560AACBF-6335-44a9-895A-8B27F3ED5E47\0"),
            (ServiceVariable::Request, b"3\0"),
            (ServiceVariable::RequestState, &[1, 0, 0, 0]),
            (ServiceVariable::Response, b"1.732051\0"),
            (ServiceVariable::RequestState, &[0, 0, 0, 0]),
            (ServiceVariable::ResponseState, &[1, 0, 0, 0]),
            (ServiceVariable::RequestState, &[2, 1, 0, 0]),
            (ServiceVariable::ResponseState, &[3, 1, 0, 0]),
        ];
        for channel in self.channels() {
            for (variable, value) in writes {
                if let Ok(op) = WriteByName::new(channel, variable.name(), value) {
                    self.ask(op);
                }
                for variable in ServiceVariable::ALL {
                    self.named(channel, variable.name());
                }
            }
        }
    }
}

/// Values to write where this one is: all bits inverted, each byte another, too short, too long.
fn others(value: &[u8]) -> Vec<Vec<u8>> {
    let inverted = value.iter().map(|byte| !byte).collect();
    let flipped = value.iter().map(|byte| byte ^ 1).collect();
    let longer = [value, &[0]].concat();
    let shorter = value.split_last().map_or(&[][..], |(_, rest)| rest).to_vec();
    vec![inverted, flipped, shorter, longer, Vec::new()]
}

/// Index lists for an array: of the first and the last element and one in between, one index beyond
/// each dimension, and one index too many.
fn parts(dimensions: &[u32]) -> Vec<Vec<u32>> {
    let mut parts: Vec<Vec<u32>> = [0, 1, u32::MAX]
        .map(|at| dimensions.iter().map(|&count| at.min(count.saturating_sub(1))).collect())
        .into();
    for beyond in 0..dimensions.len() {
        let each = dimensions.iter().enumerate();
        parts.push(each.map(|(at, &count)| if at == beyond { count } else { 0 }).collect());
        parts.push(dimensions.iter().enumerate().map(|(at, _)| u32::from(at == beyond)).collect());
    }
    parts.push(vec![0; dimensions.len() + 1]);
    parts.sort_unstable();
    parts.dedup();
    parts.retain(|part| !part.is_empty());
    parts
}

/// Indices as a name has them.
fn brackets(indices: &[impl Display]) -> String {
    indices.iter().map(|index| format!("[{index}]")).collect()
}

fn number(data: &[u8]) -> Option<u32> {
    data.first_chunk().map(|bytes| u32::from_le_bytes(*bytes))
}
