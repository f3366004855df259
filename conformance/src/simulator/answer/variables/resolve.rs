//! Resolves a kind and an index, a handle or a name to a variable, and a name also to a parameter.

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::ads::AdsError;
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::Function;
use ads_cnc::{CncStr, CncString, Handle, Kind, U32List, VariablePath};
use ads_cnc_vectors::ids::*;

use super::AnsweringCnc;
use crate::edition::Feature;
use crate::number::to_usize;
use crate::simulator::model::{ChannelModel, Variable, VariableRef, handle_at, parameter_kind};

/// The result of resolving a name on the channel interface.
pub(super) enum Resolved {
    Variable(VariableRef),
    /// A V.P, V.L or V.S parameter, in an edition and a version that have these kinds of variables.
    Parameter,
}

/// The error for an unknown name or kind, a kind that the function does not serve, or a missing
/// place on the axis interface. Also for the name of an element where only that of a variable is
/// allowed.
pub(super) const UNKNOWN: AdsError = AdsError::SYMBOL_NOT_FOUND;

impl AnsweringCnc<'_> {
    /// Checks whether the edition and the version of the CNC have a function for a kind of
    /// variables.
    pub(super) fn permit(&self, function: Function, kind: Kind<'_>) -> Result<(), AdsError> {
        let answer = self.model.edition.permits(function, kind, self.model.version);
        match (answer.available, function) {
            (true, _) => Ok(()),
            // A variable of this kind may exist, but has no handle.
            (false, Function::HandleByName) if answer.requirement == VAR_18.as_str() => {
                Err(AdsError::INVALID_DATA)
            }
            (false, _) => Err(UNKNOWN),
        }
    }

    /// The variables of a kind in the order of their indices; for V.A, only the variables of places
    /// (axis indices of the channel) with an axis.
    pub(super) fn of_kind(
        &self,
        channel: usize,
        kind: Kind<'_>,
    ) -> impl Iterator<Item = VariableRef> + use<'_> {
        let model = self.model.channels.get(channel);
        // A kind may be padded with NULs, so only its text is compared.
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
            places.clone().map(move |place| VariableRef::Axis { place, variable })
        });
        own.iter().copied().map(VariableRef::Channel).chain(of_axes)
    }

    pub(super) fn by_index(
        &self,
        channel: usize,
        kind: Kind<'_>,
        index: u32,
    ) -> Result<VariableRef, AdsError> {
        self.of_kind(channel, kind).nth(to_usize(index)).ok_or(AdsError::INVALID_DATA)
    }

    pub(super) fn by_handle(
        &self,
        channel: usize,
        handle: Handle,
    ) -> Result<VariableRef, AdsError> {
        let channel = self.model.channels.get(channel);
        let at = channel.and_then(|channel| channel.by_handle.get(&handle.0));
        at.copied().ok_or(AdsError::INVALID_DATA)
    }

    /// Resolves a name on the channel interface to a variable and the indices of an element, or to
    /// a parameter. Fails with an invalid offset if the version of the CNC does not have the
    /// function.
    pub(super) fn named<'n>(
        &self,
        function: Function,
        channel: usize,
        name: CncStr<'n>,
    ) -> Result<(Resolved, U32List<'n>), AdsError> {
        if let (Some(version), Some(feature)) = (self.model.version, Feature::of(function))
            && !version.has(feature).available
        {
            return Err(AdsError::INVALID_OFFSET);
        }
        let path = VariablePath::from_text(name).map_err(|_| UNKNOWN)?;
        self.permit(function, path.kind())?;
        let model = self.model.channels.get(channel).ok_or(AdsError::INVALID_GROUP)?;
        let (whole, indices) = (CncString::from(path.variable().text()), path.elements());
        if let Some(place) = model.variables.named(whole.as_bytes()) {
            return Ok((Resolved::Variable(VariableRef::Channel(place)), indices));
        }
        if path.kind() == Kind::V_A {
            let at = self.of_named_axis(channel, model, whole.as_bytes()).ok_or(UNKNOWN)?;
            return Ok((Resolved::Variable(at), indices));
        }
        let (kind, name) = parameter(name)?;
        let found = self.state.parameters(channel, kind).any(|one| one.parameter.name == name);
        if found { Ok((Resolved::Parameter, U32List::EMPTY)) } else { Err(UNKNOWN) }
    }

    /// Resolves a name with an axis name after the last dot.
    pub(super) fn of_named_axis(
        &self,
        channel: usize,
        model: &ChannelModel,
        whole: &[u8],
    ) -> Option<VariableRef> {
        let dot = whole.iter().rposition(|&byte| byte == b'.')?;
        let (name, axis) = whole.split_at_checked(dot)?;
        let axis = axis.strip_prefix(b".")?;
        let variable = self.model.axis_variables.named(name)?;
        let place = (0..model.places.len()).find(|&place| {
            let axis_model = self.state.axis_at(channel, place);
            let axis_model = axis_model.and_then(|axis_model| self.model.axes.get(axis_model));
            axis_model.is_some_and(|axis_model| axis_model.name.as_bytes() == axis)
        })?;
        Some(VariableRef::Axis { place, variable })
    }

    /// Resolves a name on the axis interface, for the axis at a place of the channel.
    pub(super) fn of_axis<'n>(
        &self,
        function: Function,
        channel: Channel,
        axis: ChannelAxis,
        name: CncStr<'n>,
    ) -> Result<(usize, VariableRef, U32List<'n>), AdsError> {
        let channel = self.channel(channel)?;
        let path = VariablePath::from_text(name).map_err(|_| UNKNOWN)?;
        self.permit(function, path.kind())?;
        let places = self.model.channels.get(channel).map_or(0, |channel| channel.places.len());
        let place = usize::from(axis.index()).checked_sub(1).filter(|&place| place < places);
        let whole = CncString::from(path.variable().text());
        let variable = self.model.axis_variables.named(whole.as_bytes()).ok_or(UNKNOWN)?;
        let at = VariableRef::Axis { place: place.ok_or(UNKNOWN)?, variable };
        Ok((channel, at, path.elements()))
    }

    pub(super) fn variable(&self, channel: usize, at: VariableRef) -> Result<&Variable, AdsError> {
        let variable = match at {
            VariableRef::Channel(place) => {
                self.model.channels.get(channel).and_then(|one| one.variables.list.get(place))
            }
            VariableRef::Axis { variable, .. } => self.model.axis_variables.list.get(variable),
        };
        variable.ok_or(AdsError::INVALID_DATA)
    }

    /// The name of a variable on the channel interface, where the name of an axis variable ends
    /// with the name of the axis.
    pub(super) fn name(&self, channel: usize, at: VariableRef) -> Result<CncString, AdsError> {
        let variable = self.variable(channel, at)?;
        let VariableRef::Axis { place, .. } = at else { return Ok(variable.name.clone()) };
        let axis = self.state.axis_at(channel, place);
        let axis = axis.and_then(|axis| self.model.axes.get(axis)).ok_or(UNKNOWN)?;
        let path = VariablePath::from_text(variable.name.as_cnc_str()).map_err(|_| UNKNOWN)?;
        path.with_axis(axis.name.as_cnc_str()).map_err(|_| UNKNOWN)
    }

    /// The handle of a variable; 0 if the variable is accessible by name only.
    pub(super) fn handle(&self, channel: usize, at: VariableRef) -> Result<Handle, AdsError> {
        let handle = self.variable(channel, at)?.handle.unwrap_or(Handle(0));
        let number = self.model.channels.get(channel).map_or(0, |channel| channel.number);
        Ok(match at {
            VariableRef::Channel(_) => handle,
            VariableRef::Axis { place, .. } => {
                let place = u8::try_from(place.saturating_add(1)).unwrap_or(u8::MAX);
                handle_at(handle, number, place)
            }
        })
    }
}

/// The kind and the name, if the name can be that of a V.P, V.L or V.S parameter; an error for any
/// other name.
pub(super) fn parameter(name: CncStr<'_>) -> Result<(DynamicKind, CncString), AdsError> {
    let name = CncString::from(name);
    match parameter_kind(&name) {
        Ok(kind) if kind != DynamicKind::P => Ok((kind, name)),
        _ => Err(UNKNOWN),
    }
}
