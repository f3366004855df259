//! Variables with flexible data type (VAR).

use std::borrow::Cow;

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::ads::AdsError;
use ads_cnc::dynamic::{DynamicKind, DynamicValue};
use ads_cnc::edition::Feature;
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, AxisWriteByName, CountVariables, DescribeByIndex,
    DescribeByName, DescribeExtended, Function, HandleByName, ReadByHandle, ReadByName,
    WriteByHandle, WriteByName,
};
use ads_cnc::{
    CncStr, CncString, DescriptionByNameRef, DescriptionRef, ExtendedReply, Handle, Kind, Numbers,
    TextRef, ValueRef, VariableAccess, VariableCount, VariablePath, VariableType,
};

use super::{Answer, Running, encode};
use crate::cnc::content::{check_size, put};
use crate::cnc::model::{At, ChannelModel, Variable, handle_at};
use crate::cnc::{to_len, to_u32};

/// What a name on the channel interface stands for.
enum Named {
    Variable(At),
    /// A V.P, V.L or V.S, in editions that have them here.
    Parameter,
}

/// A refusal of a name that stands for nothing.
const UNKNOWN: AdsError = AdsError::SYMBOL_NOT_FOUND;

impl Running<'_> {
    pub(super) fn count_variables(&self, op: &CountVariables<'_>) -> Answer {
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

    pub(super) fn describe_by_index(&self, op: &DescribeByIndex<'_>) -> Answer {
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

    pub(super) fn describe_extended(&self, op: &DescribeExtended<'_>) -> Answer {
        let channel = self.channel(op.channel)?;
        self.permit(Function::DescribeExtended, op.kind)?;
        let at = self.by_index(channel, op.kind, op.index)?;
        // V.G and V.A have none (VAR-16).
        encode(ExtendedReply(self.variable(channel, at)?.extended))
    }

    /// Not there on a CNC too old for it, as the manuals reserve it.
    pub(super) fn describe_by_name(&self, op: &DescribeByName<'_>) -> Answer {
        let channel = self.channel(op.channel)?;
        let version = self.model.version;
        if !version.is_none_or(|version| version.has(Feature::DescriptionByName).yes) {
            return Err(AdsError::INVALID_OFFSET);
        }
        let (named, indices) = self.named(Function::DescribeByName, channel, op.name.text())?;
        let Named::Variable(at) = named else {
            // What a parameter is; that it has no handle is assumed.
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

    pub(super) fn handle_by_name(&self, op: &HandleByName<'_>) -> Answer {
        let channel = self.channel(op.channel)?;
        match self.named(Function::HandleByName, channel, op.name.text())? {
            // A handle is the variable's, not an element's.
            (Named::Variable(at), indices) if indices.is_empty() => {
                encode(self.handle(channel, at)?)
            }
            _ => Err(UNKNOWN),
        }
    }

    pub(super) fn read_by_handle(&self, op: &ReadByHandle<'_>) -> Answer {
        let channel = self.channel(op.channel)?;
        self.read(channel, self.by_handle(channel, op.handle)?, op.indices)
    }

    pub(super) fn write_by_handle(&mut self, op: &WriteByHandle<'_>) -> Answer {
        let channel = self.channel(op.channel)?;
        let at = self.by_handle(channel, op.handle)?;
        self.write(channel, at, op.indices, op.value)
    }

    pub(super) fn read_by_name(&self, op: &ReadByName<'_>) -> Answer {
        let channel = self.channel(op.channel)?;
        match self.named(Function::ReadByName, channel, op.name.text())? {
            (Named::Variable(at), indices) => self.read(channel, at, indices),
            (Named::Parameter, _) => {
                let (kind, name) = parameter(op.name.text())?;
                let found = self.state.parameters(channel, kind).find(|one| one.is.name == name);
                encode(found.ok_or(UNKNOWN)?.value)
            }
        }
    }

    pub(super) fn write_by_name(&mut self, op: &WriteByName<'_>) -> Answer {
        let channel = self.channel(op.channel)?;
        match self.named(Function::WriteByName, channel, op.name)? {
            (Named::Variable(at), indices) => self.write(channel, at, indices, op.value),
            (Named::Parameter, _) => {
                let (_, name) = parameter(op.name)?;
                let value = op.value.try_into().map_err(|_| AdsError::INVALID_SIZE)?;
                let channel = self.state.channels.get_mut(channel);
                let found = channel.and_then(|one| one.parameters.value_mut(&name));
                *found.ok_or(UNKNOWN)? = DynamicValue::from_bits(u64::from_le_bytes(value));
                Ok(Vec::new())
            }
        }
    }

    pub(super) fn axis_handle_by_name(&self, op: &AxisHandleByName<'_>) -> Answer {
        let name = op.name.text();
        let (channel, at, indices) =
            self.of_axis(Function::AxisHandleByName, op.channel, op.axis, name)?;
        if indices.is_empty() { encode(self.handle(channel, at)?) } else { Err(UNKNOWN) }
    }

    pub(super) fn axis_read_by_name(&self, op: &AxisReadByName<'_>) -> Answer {
        let name = op.name.text();
        let (channel, at, indices) =
            self.of_axis(Function::AxisReadByName, op.channel, op.axis, name)?;
        self.read(channel, at, indices)
    }

    pub(super) fn axis_write_by_name(&mut self, op: &AxisWriteByName<'_>) -> Answer {
        let (channel, at, indices) =
            self.of_axis(Function::AxisWriteByName, op.channel, op.axis, op.name)?;
        self.write(channel, at, indices, op.value)
    }

    /// Whether edition and version have a function for a kind.
    fn permit(&self, function: Function, kind: Kind<'_>) -> Result<(), AdsError> {
        let answer = self.model.edition.permits(function, kind, self.model.version);
        match (answer.yes, function) {
            (true, _) => Ok(()),
            // It is there, but has no handle.
            (false, Function::HandleByName) if answer.clause == "VAR-18" => {
                Err(AdsError::INVALID_DATA)
            }
            (false, _) => Err(UNKNOWN),
        }
    }

    /// The variables of a kind in the order of their indices; V.A of axes that are there.
    fn of_kind(&self, channel: usize, kind: Kind<'_>) -> impl Iterator<Item = At> + use<'_> {
        let model = self.model.channels.get(channel);
        // NULs may pad a kind: its text counts.
        let is = |known: Kind<'_>| kind.text() == known.text();
        let own = match model {
            Some(model) if is(Kind::V_E) => model.external.as_slice(),
            Some(model) if is(Kind::V_G) => model.global.as_slice(),
            _ => &[],
        };
        let of_axes = if is(Kind::V_A) { self.model.axis_variables.list.len() } else { 0 };
        let places = (0..model.map_or(0, |model| model.places.len()))
            .filter(move |&place| self.state.axis_at(channel, place).is_some());
        let of_axes = (0..of_axes).flat_map(move |variable| {
            places.clone().map(move |place| At::Place { place, variable })
        });
        own.iter().copied().map(At::Own).chain(of_axes)
    }

    fn by_index(&self, channel: usize, kind: Kind<'_>, index: u32) -> Result<At, AdsError> {
        self.of_kind(channel, kind).nth(to_len(index)).ok_or(AdsError::INVALID_DATA)
    }

    fn by_handle(&self, channel: usize, handle: Handle) -> Result<At, AdsError> {
        let channel = self.model.channels.get(channel);
        let at = channel.and_then(|channel| channel.by_handle.get(&handle.0));
        at.copied().ok_or(AdsError::INVALID_DATA)
    }

    /// What a name on the channel interface means, and the element that it selects.
    fn named<'n>(
        &self,
        function: Function,
        channel: usize,
        name: CncStr<'n>,
    ) -> Result<(Named, Numbers<'n>), AdsError> {
        let path = VariablePath::from_text(name).map_err(|_| UNKNOWN)?;
        self.permit(function, path.kind())?;
        let model = self.model.channels.get(channel).ok_or(AdsError::INVALID_GROUP)?;
        let (whole, indices) = (CncString::from(path.variable().text()), path.elements());
        if let Some(place) = model.variables.named(whole.as_bytes()) {
            return Ok((Named::Variable(At::Own(place)), indices));
        }
        if path.kind() == Kind::V_A {
            let at = self.of_named_axis(channel, model, whole.as_bytes()).ok_or(UNKNOWN)?;
            return Ok((Named::Variable(at), indices));
        }
        let (kind, name) = parameter(name)?;
        let found = self.state.parameters(channel, kind).any(|one| one.is.name == name);
        if found { Ok((Named::Parameter, Numbers::EMPTY)) } else { Err(UNKNOWN) }
    }

    /// The variable in front of the last dot, of the axis whose name is behind it.
    fn of_named_axis(&self, channel: usize, model: &ChannelModel, whole: &[u8]) -> Option<At> {
        let dot = whole.iter().rposition(|&byte| byte == b'.')?;
        let (name, axis) = whole.split_at_checked(dot)?;
        let axis = axis.strip_prefix(b".")?;
        let variable = self.model.axis_variables.named(name)?;
        let place = (0..model.places.len()).find(|&place| {
            let there = self.state.axis_at(channel, place);
            let there = there.and_then(|there| self.model.axes.get(there));
            there.is_some_and(|there| there.name.as_bytes() == axis)
        })?;
        Some(At::Place { place, variable })
    }

    /// What a name on the axis interface means: of whatever axis is at the place.
    fn of_axis<'n>(
        &self,
        function: Function,
        channel: Channel,
        axis: ChannelAxis,
        name: CncStr<'n>,
    ) -> Result<(usize, At, Numbers<'n>), AdsError> {
        let channel = self.channel(channel)?;
        let path = VariablePath::from_text(name).map_err(|_| UNKNOWN)?;
        self.permit(function, path.kind())?;
        let places = self.model.channels.get(channel).map_or(0, |channel| channel.places.len());
        let place = usize::from(axis.place()).checked_sub(1).filter(|&place| place < places);
        let whole = CncString::from(path.variable().text());
        let variable = self.model.axis_variables.named(whole.as_bytes()).ok_or(UNKNOWN)?;
        let at = At::Place { place: place.ok_or(UNKNOWN)?, variable };
        Ok((channel, at, path.elements()))
    }

    fn variable(&self, channel: usize, at: At) -> Result<&Variable, AdsError> {
        let variable = match at {
            At::Own(place) => {
                self.model.channels.get(channel).and_then(|one| one.variables.list.get(place))
            }
            At::Place { variable, .. } => self.model.axis_variables.list.get(variable),
        };
        variable.ok_or(AdsError::INVALID_DATA)
    }

    /// With the axis's name behind it, if it is one's.
    fn name(&self, channel: usize, at: At) -> Result<CncString, AdsError> {
        let variable = self.variable(channel, at)?;
        let At::Place { place, .. } = at else { return Ok(variable.name.clone()) };
        let axis = self.state.axis_at(channel, place);
        let axis = axis.and_then(|axis| self.model.axes.get(axis)).ok_or(UNKNOWN)?;
        let path = VariablePath::from_text(variable.name.as_cnc_str()).map_err(|_| UNKNOWN)?;
        path.with_axis(axis.name.as_cnc_str()).map_err(|_| UNKNOWN)
    }

    /// The handle; 0 for what is by name only.
    fn handle(&self, channel: usize, at: At) -> Result<Handle, AdsError> {
        let handle = self.variable(channel, at)?.handle.unwrap_or(Handle(0));
        let number = self.model.channels.get(channel).map_or(0, |channel| channel.number);
        Ok(match at {
            At::Own(_) => handle,
            At::Place { place, .. } => {
                let place = u8::try_from(place.saturating_add(1)).unwrap_or(u8::MAX);
                handle_at(handle, number, place)
            }
        })
    }

    /// The value of a variable or of one of its elements; blank where no axis is (SDA-11).
    fn read(&self, channel: usize, at: At, indices: Numbers<'_>) -> Answer {
        let variable = self.variable(channel, at)?;
        let part = variable.part(indices).ok_or(AdsError::INVALID_DATA)?;
        let value = match (at, variable.service) {
            (At::Own(_), Some(service)) => {
                let channel = self.state.channels.get(channel).ok_or(AdsError::INVALID_GROUP)?;
                let mut value = channel.service.read(service).to_vec();
                value.resize(variable.initial.size, 0);
                Some(Cow::Owned(value))
            }
            (At::Own(place), None) => {
                self.state.variables(channel).and_then(|values| values.get(place)).map(Cow::from)
            }
            (At::Place { place, variable }, _) => {
                let values = self.state.axis_variables(channel, place);
                values.and_then(|values| values.get(variable)).map(Cow::from)
            }
        };
        let value = value.unwrap_or_else(|| Cow::Owned(vec![0; variable.initial.size]));
        encode(ValueRef { bytes: value.get(part).ok_or(AdsError::INVALID_DATA)? })
    }

    fn write(&mut self, channel: usize, at: At, indices: Numbers<'_>, bytes: &[u8]) -> Answer {
        let variable = self.variable(channel, at)?;
        let part = variable.part(indices).ok_or(AdsError::INVALID_DATA)?;
        if !variable.is_writable() {
            return Err(AdsError::INVALID_ACCESS);
        }
        let service = variable.service;
        check_size(bytes, part.len(), variable.is_text(indices))?;
        let value = match (at, service) {
            (At::Own(_), Some(service)) => {
                let channel = self.state.channels.get_mut(channel);
                let interface = &mut channel.ok_or(AdsError::INVALID_GROUP)?.service;
                return match interface.write(service, bytes) {
                    Ok(()) => Ok(Vec::new()),
                    Err(_) => Err(AdsError::INVALID_SIZE),
                };
            }
            (At::Own(place), None) => {
                self.state.variables_mut(channel).and_then(|values| values.get_mut(place))
            }
            (At::Place { place, variable }, _) => {
                let values = self.state.axis_variables_mut(channel, place);
                values.and_then(|values| values.get_mut(variable))
            }
        };
        // Where no axis is there is nothing to be written.
        put(value.and_then(|value| value.get_mut(part)).ok_or(AdsError::INVALID_DATA)?, bytes);
        Ok(Vec::new())
    }
}

/// The kind and the name of a V.P, V.L or V.S.
fn parameter(name: CncStr<'_>) -> Result<(DynamicKind, CncString), AdsError> {
    let name = CncString::from(name);
    match crate::cnc::model::parameter_kind(&name) {
        Ok(kind) if kind != DynamicKind::P => Ok((kind, name)),
        _ => Err(UNKNOWN),
    }
}
