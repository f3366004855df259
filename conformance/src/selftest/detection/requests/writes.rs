//! Writes of the writable values and of the Service Interface, each followed by reads, and writes
//! of NC programs, as far as the gate allows them.

use std::time::Duration;

use ads_cnc::address::{Channel, ChannelAxis, Class, ComTable, Group, IndexGroup, IndexOffset};
use ads_cnc::operation::{
    AxisReadByName, AxisWriteByName, HandleByName, Operation as _, ReadByHandle, ReadByName,
    ReadElement, ReadObject, WriteByHandle, WriteByName, WriteElement, WriteObject,
    WriteProgramStream,
};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{Handle, U32List};

use super::configurable::by_number;
use super::{AXES, ContentAddress, ReplyRecorder, Variable, brackets, number, parts};

impl ReplyRecorder<'_> {
    /// Writes two other values and then the original value to each listed value for which the gate
    /// allows a write, except at the axis indices in `unwritten_places`.
    pub(super) fn writes(&mut self) {
        for variable in std::mem::take(&mut self.variables) {
            if variable.writable {
                self.write_variable(&variable);
            }
        }
        for content in std::mem::take(&mut self.contents) {
            let ContentAddress { group, offset, element, size } = content;
            if self.is_unwritten(group, offset) {
                continue;
            }
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
                    if self.is_unwritten(read.index_group(), read.index_offset()) {
                        continue;
                    }
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

    /// Whether the address belongs to an axis index to which the suite does not write.
    fn is_unwritten(&self, group: IndexGroup, offset: IndexOffset) -> bool {
        let instance = match by_number(group).parts() {
            Some(Group::Com(com)) if com.table == ComTable::Channel => com.instance,
            Some(Group::Class(class)) if class.class != Class::Spindle => class.instance,
            _ => return false,
        };
        self.unwritten_places.contains(&(instance.into(), offset.get() >> 16))
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

    /// Reads a whole variable after a write: by name in its channel and in channels 1 and 2, and by
    /// handle.
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

    /// Writes NC text: complete lines, a line without its end, and more bytes than fit into the
    /// buffer.
    pub(super) fn streams(&mut self) {
        let long = [&[b'X'; 990][..], b"\r\n"].concat();
        let texts: [&[u8]; 7] = [
            b"N10 X1\r\n",
            b"N20 X2\r\nN30 X3\r\n",
            b"N40 X4",
            b"N50 $WHILE 1\r\n",
            b"N60: X1\r\nN70 $GOTO N60\r\n",
            b"N80 M30\r\nN90 X9\r\n",
            &long,
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

    /// Writes the variables of the Service Interface in the order in which an NC program and a
    /// service write them, and reads all five variables after each write.
    pub(super) fn services(&mut self) {
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

/// Two other values of the same size: all bits inverted, and the lowest bit of each byte inverted.
fn others(value: &[u8]) -> [Vec<u8>; 2] {
    [value.iter().map(|byte| !byte).collect(), value.iter().map(|byte| byte ^ 1).collect()]
}
