//! Answers requests for variables with flexible data type (VAR).

mod resolve;

use std::borrow::Cow;

use ads_cnc::ads::AdsError;
use ads_cnc::dynamic::DynamicValue;
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, AxisWriteByName, CountVariables, DescribeByIndex,
    DescribeByName, DescribeExtended, Function, HandleByName, ReadByHandle, ReadByName,
    WriteByHandle, WriteByName,
};
use ads_cnc::{
    DescriptionByNameRef, DescriptionRef, ExtendedReply, Handle, Kind, TextRef, U32List, ValueRef,
    VariableAccess, VariableCount, VariableType,
};

use self::resolve::{Resolved, UNKNOWN, parameter};
use super::{AnsweringCnc, ReplyData, encode};
use crate::number::to_u32;
use crate::simulator::content::{check_size, copy_padded};
use crate::simulator::model::VariableRef;

impl AnsweringCnc<'_> {
    pub(super) fn count_variables(&self, op: &CountVariables<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        self.permit(Function::CountVariables, op.kind)?;
        let count = if op.kind.text().is_empty() {
            let kinds = [Kind::V_E, Kind::V_G, Kind::V_A];
            kinds.iter().map(|kind| self.of_kind(channel, *kind).count()).sum()
        } else {
            self.of_kind(channel, op.kind).count()
        };
        encode(VariableCount(to_u32(count)))
    }

    pub(super) fn describe_by_index(&self, op: &DescribeByIndex<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        self.permit(Function::DescribeByIndex, op.kind)?;
        let at = self.by_index(channel, op.kind, op.index)?;
        let (variable, name) = (self.variable(channel, at)?, self.name(channel, at)?);
        encode(DescriptionRef {
            handle: self.handle(channel, at)?,
            var_type: variable.var_type,
            access: variable.access,
            size: to_u32(variable.initial.size),
            dimensions: variable.dimensions.as_slice().into(),
            name: TextRef::from(name.as_cnc_str()),
        })
    }

    pub(super) fn describe_extended(&self, op: &DescribeExtended<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        self.permit(Function::DescribeExtended, op.kind)?;
        let at = self.by_index(channel, op.kind, op.index)?;
        // V.G and V.A have no extended description (VAR-16).
        encode(ExtendedReply(self.variable(channel, at)?.extended))
    }

    pub(super) fn describe_by_name(&self, op: &DescribeByName<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        let (named, indices) = self.named(Function::DescribeByName, channel, op.name.text())?;
        let Resolved::Variable(at) = named else {
            // It is assumed that the description of a parameter has no handle.
            return encode(DescriptionByNameRef {
                handle: Handle(0),
                var_type: VariableType::REAL64,
                access: VariableAccess::READ_WRITE,
                size: 8,
                dimensions: [].as_slice().into(),
            });
        };
        if !indices.is_empty() {
            return Err(UNKNOWN);
        }
        let variable = self.variable(channel, at)?;
        encode(DescriptionByNameRef {
            handle: self.handle(channel, at)?,
            var_type: variable.var_type,
            access: variable.access,
            size: to_u32(variable.initial.size),
            dimensions: variable.dimensions.as_slice().into(),
        })
    }

    pub(super) fn handle_by_name(&self, op: &HandleByName<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        match self.named(Function::HandleByName, channel, op.name.text())? {
            // A handle belongs to the variable, not to an element.
            (Resolved::Variable(at), indices) if indices.is_empty() => {
                encode(self.handle(channel, at)?)
            }
            _ => Err(UNKNOWN),
        }
    }

    pub(super) fn read_by_handle(&self, op: &ReadByHandle<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        self.read(channel, self.by_handle(channel, op.handle)?, op.indices)
    }

    pub(super) fn write_by_handle(&mut self, op: &WriteByHandle<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        let at = self.by_handle(channel, op.handle)?;
        self.write(channel, at, op.indices, op.value.as_bytes())
    }

    pub(super) fn read_by_name(&self, op: &ReadByName<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        match self.named(Function::ReadByName, channel, op.name.text())? {
            (Resolved::Variable(at), indices) => self.read(channel, at, indices),
            (Resolved::Parameter, _) => {
                let (kind, name) = parameter(op.name.text())?;
                let found =
                    self.state.parameters(channel, kind).find(|one| one.parameter.name == name);
                encode(found.ok_or(UNKNOWN)?.value)
            }
        }
    }

    pub(super) fn write_by_name(&mut self, op: &WriteByName<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        match self.named(Function::WriteByName, channel, op.name)? {
            (Resolved::Variable(at), indices) => {
                self.write(channel, at, indices, op.value.as_bytes())
            }
            (Resolved::Parameter, _) => {
                let (_, name) = parameter(op.name)?;
                tracing::debug!(channel, %name, "write to a parameter");
                let value = op.value.as_bytes().try_into().map_err(|_| AdsError::INVALID_SIZE)?;
                let channel = self.state.channels.get_mut(channel);
                let found = channel.and_then(|one| one.parameters.value_mut(&name));
                *found.ok_or(UNKNOWN)? = DynamicValue::from_bits(u64::from_le_bytes(value));
                Ok(Vec::new())
            }
        }
    }

    pub(super) fn axis_handle_by_name(&self, op: &AxisHandleByName<'_>) -> ReplyData {
        let name = op.name.text();
        let (channel, at, indices) =
            self.of_axis(Function::AxisHandleByName, op.channel, op.axis, name)?;
        if indices.is_empty() { encode(self.handle(channel, at)?) } else { Err(UNKNOWN) }
    }

    pub(super) fn axis_read_by_name(&self, op: &AxisReadByName<'_>) -> ReplyData {
        let name = op.name.text();
        let (channel, at, indices) =
            self.of_axis(Function::AxisReadByName, op.channel, op.axis, name)?;
        self.read(channel, at, indices)
    }

    pub(super) fn axis_write_by_name(&mut self, op: &AxisWriteByName<'_>) -> ReplyData {
        let (channel, at, indices) =
            self.of_axis(Function::AxisWriteByName, op.channel, op.axis, op.name)?;
        self.write(channel, at, indices, op.value.as_bytes())
    }

    /// The value of a variable or of one of its elements; zeros for a place (axis index of the
    /// channel) without an axis (SDA-11).
    fn read(&self, channel: usize, at: VariableRef, indices: U32List<'_>) -> ReplyData {
        let variable = self.variable(channel, at)?;
        let part = variable.part(indices).ok_or(AdsError::INVALID_DATA)?;
        let value = match (at, variable.service) {
            (VariableRef::Channel(_), Some(service)) => {
                let channel = self.state.channels.get(channel).ok_or(AdsError::INVALID_GROUP)?;
                let mut value = channel.service.read(service).to_vec();
                value.resize(variable.initial.size, 0);
                Some(Cow::Owned(value))
            }
            (VariableRef::Channel(place), None) => {
                self.state.variables(channel).and_then(|values| values.get(place)).map(Cow::from)
            }
            (VariableRef::Axis { place, variable }, _) => {
                let values = self.state.axis_variables(channel, place);
                values.and_then(|values| values.get(variable)).map(Cow::from)
            }
        };
        let value = value.unwrap_or_else(|| Cow::Owned(vec![0; variable.initial.size]));
        encode(ValueRef { bytes: value.get(part).ok_or(AdsError::INVALID_DATA)? })
    }

    fn write(
        &mut self,
        channel: usize,
        at: VariableRef,
        indices: U32List<'_>,
        bytes: &[u8],
    ) -> ReplyData {
        let variable = self.variable(channel, at)?;
        if tracing::enabled!(tracing::Level::DEBUG)
            && let (Ok(name), Some(model)) =
                (self.name(channel, at), self.model.channels.get(channel))
        {
            tracing::debug!(channel = model.number, %name, "write to a variable");
        }
        let part = variable.part(indices).ok_or(AdsError::INVALID_DATA)?;
        if !variable.is_writable() {
            return Err(AdsError::INVALID_ACCESS);
        }
        let service = variable.service;
        check_size(bytes, part.len(), variable.is_text(indices))?;
        let value = match (at, service) {
            (VariableRef::Channel(_), Some(service)) => {
                let channel = self.state.channels.get_mut(channel);
                let interface = &mut channel.ok_or(AdsError::INVALID_GROUP)?.service;
                return match interface.write(service, bytes) {
                    Ok(()) => Ok(Vec::new()),
                    Err(_) => Err(AdsError::INVALID_SIZE),
                };
            }
            (VariableRef::Channel(place), None) => {
                self.state.variables_mut(channel).and_then(|values| values.get_mut(place))
            }
            (VariableRef::Axis { place, variable }, _) => {
                let values = self.state.axis_variables_mut(channel, place);
                values.and_then(|values| values.get_mut(variable))
            }
        };
        // The variables of a place without an axis cannot be written.
        copy_padded(
            value.and_then(|value| value.get_mut(part)).ok_or(AdsError::INVALID_DATA)?,
            bytes,
        );
        Ok(Vec::new())
    }
}
