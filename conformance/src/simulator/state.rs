//! The state of the simulated CNC, which requests, NC programs and the passage of time change.

use std::time::Duration;

use ads_cnc::address::{Addressing, Class};
use ads_cnc::ads::AdsError;
use ads_cnc::dynamic::DynamicKind;

use super::model::{AxisModel, ChannelModel, Item, Model, Parameter, Variables, class_place};
use super::owner::Owner;
use super::parameters::{ParameterState, ParameterStates};
use super::program::service::ServiceInterface;
use super::program::{Policy, Script, StreamingProgram};

/// The contents of the objects or elements of an owner, or the values of variables, in the order of
/// the model.
pub(super) type Contents = Vec<Vec<u8>>;

#[derive(Debug)]
pub(super) struct CncState {
    /// The channels in the order of the model.
    pub(super) channels: Vec<ChannelState>,
    axes: Vec<AxisState>,
    spindles: Vec<Contents>,
    platform: Contents,
}

/// The state of a channel.
#[derive(Debug)]
pub(super) struct ChannelState {
    pub(super) active: bool,
    /// The axis at each place (axis index) of the channel, as its index in the model; `None`
    /// without an axis.
    pub(super) places: Vec<Option<usize>>,
    objects: Contents,
    /// The values of the variables; `service` stores those of the Service Interface, whose items
    /// here are not used.
    variables: Contents,
    elements: [Contents; 6],
    pub(super) parameters: ParameterStates,
    pub(super) service: ServiceInterface,
    /// The streaming program, including the buffer of the streaming interface.
    pub(super) program: StreamingProgram,
    /// The NC program that sends requests to services, if any.
    pub(super) script: Option<Script>,
}

/// The state of an axis, which the axis keeps when it is assigned to another place.
#[derive(Clone, Debug)]
struct AxisState {
    /// The contents of the COM objects that the axis has as a platform axis.
    objects: Contents,
    /// The contents of the COM objects that the axis has at a place of a channel.
    of_place: Contents,
    variables: Contents,
    elements: [Contents; 6],
}

fn items(items: &[Item], instance: usize) -> Contents {
    items.iter().map(|item| item.initial.of(instance)).collect()
}

fn variables(variables: &Variables, instance: usize) -> Contents {
    variables.list.iter().map(|variable| variable.initial.of(instance)).collect()
}

impl CncState {
    /// The initial state.
    pub(super) fn new(model: &Model, policy: Policy) -> Self {
        let channel = |(place, channel): (usize, &ChannelModel)| ChannelState {
            active: channel.active,
            places: channel.places.clone(),
            objects: items(&channel.objects.items, place),
            variables: variables(&channel.variables, place),
            elements: Class::ALL.map(|class| {
                model
                    .class(class)
                    .map(|class| items(&class.channel.items, place))
                    .unwrap_or_default()
            }),
            parameters: ParameterStates::new(&channel.parameters),
            service: ServiceInterface::new(),
            program: StreamingProgram::with_policy(channel.program.clone(), policy),
            // This succeeds, because the model was checked.
            script: channel
                .script
                .clone()
                .and_then(|script| Some(Script::new(script).ok()?.with_policy(policy))),
        };
        let axis = |(place, _): (usize, &AxisModel)| AxisState {
            objects: items(&model.platform_axis.items, place),
            of_place: items(&model.channel_axis.items, place),
            variables: variables(&model.axis_variables, place),
            elements: Class::ALL.map(|class| {
                model.class(class).map(|class| items(&class.axis.items, place)).unwrap_or_default()
            }),
        };
        let spindles = model.class(Class::Spindle).map(|class| class.channel.items.as_slice());
        Self {
            channels: model.channels.iter().enumerate().map(channel).collect(),
            axes: model.axes.iter().enumerate().map(axis).collect(),
            spindles: (0..model.spindles)
                .map(|index| items(spindles.unwrap_or_default(), index))
                .collect(),
            platform: items(&model.platform.items, 0),
        }
    }

    /// Advances the parameters and programs of all channels to this time.
    pub(super) fn advance(&mut self, now: Duration) {
        for channel in &mut self.channels {
            channel.parameters.advance(now);
            channel.program.advance(now);
            if let Some(script) = &mut channel.script {
                script.advance(now, &mut channel.service);
            }
        }
    }

    /// The index of the active channel with this number or, with addressing by index, with this
    /// rank among the active channels (ADR-11).
    pub(super) fn channel(
        &self,
        model: &Model,
        addressing: Addressing,
        number: u8,
    ) -> Result<usize, AdsError> {
        let mut active = self.channels.iter().enumerate().filter(|(_, channel)| channel.active);
        let found = match addressing {
            Addressing::Logical => active.find(|(place, _)| {
                model.channels.get(*place).is_some_and(|channel| channel.number == number)
            }),
            Addressing::Index => {
                let before = usize::from(number).checked_sub(1);
                before.and_then(|before| active.nth(before))
            }
        };
        found.map(|(place, _)| place).ok_or(AdsError::INVALID_GROUP)
    }

    /// Whether this is the first active channel, whose list includes the platform's objects.
    pub(super) fn is_first(&self, channel: usize) -> bool {
        self.channels.iter().position(|one| one.active) == Some(channel)
    }

    /// The axis at a place of a channel, as its index in the model; `None` without an axis.
    pub(super) fn axis_at(&self, channel: usize, place: usize) -> Option<usize> {
        *self.channels.get(channel)?.places.get(place)?
    }

    /// Contents of the objects or elements of an owner; `None` for a place without an axis, and for
    /// an owner that does not exist.
    pub(super) fn values(&self, owner: Owner) -> Option<&Contents> {
        match owner {
            Owner::Platform => Some(&self.platform),
            Owner::Channel(channel) => self.channels.get(channel).map(|channel| &channel.objects),
            Owner::Axis(axis) => self.axes.get(axis).map(|axis| &axis.objects),
            Owner::Place { channel, place } => {
                self.axes.get(self.axis_at(channel, place)?).map(|axis| &axis.of_place)
            }
            Owner::ClassChannel(class, channel) => {
                self.channels.get(channel)?.elements.get(class_place(class))
            }
            Owner::ClassAxis(class, axis) => self.axes.get(axis)?.elements.get(class_place(class)),
            Owner::ClassPlace { class, channel, place } => {
                let axis = self.axes.get(self.axis_at(channel, place)?)?;
                axis.elements.get(class_place(class))
            }
            Owner::Spindle(spindle) => self.spindles.get(spindle),
        }
    }

    /// Changes the content of an object or element; `None` if the content does not exist, for
    /// example at a place without an axis. While the content of a channel's object is 0, the
    /// parameters that need the object do not exist; they get their initial values.
    pub(super) fn change(
        &mut self,
        owner: Owner,
        index: usize,
        change: impl FnOnce(&mut [u8]),
    ) -> Option<()> {
        change(self.values_mut(owner)?.get_mut(index)?);
        if let Owner::Channel(channel) = owner {
            self.channels.get_mut(channel)?.reset_parameters();
        }
        Some(())
    }

    /// Like `values`, but mutable.
    fn values_mut(&mut self, owner: Owner) -> Option<&mut Contents> {
        match owner {
            Owner::Platform => Some(&mut self.platform),
            Owner::Channel(channel) => {
                self.channels.get_mut(channel).map(|channel| &mut channel.objects)
            }
            Owner::Axis(axis) => self.axes.get_mut(axis).map(|axis| &mut axis.objects),
            Owner::Place { channel, place } => {
                let axis = self.axis_at(channel, place)?;
                self.axes.get_mut(axis).map(|axis| &mut axis.of_place)
            }
            Owner::ClassChannel(class, channel) => {
                self.channels.get_mut(channel)?.elements.get_mut(class_place(class))
            }
            Owner::ClassAxis(class, axis) => {
                self.axes.get_mut(axis)?.elements.get_mut(class_place(class))
            }
            Owner::ClassPlace { class, channel, place } => {
                let axis = self.axis_at(channel, place)?;
                self.axes.get_mut(axis)?.elements.get_mut(class_place(class))
            }
            Owner::Spindle(spindle) => self.spindles.get_mut(spindle),
        }
    }

    /// Values of the variables of a channel.
    pub(super) fn variables(&self, channel: usize) -> Option<&Contents> {
        self.channels.get(channel).map(|channel| &channel.variables)
    }

    /// Like `variables`, but mutable.
    pub(super) fn variables_mut(&mut self, channel: usize) -> Option<&mut Contents> {
        self.channels.get_mut(channel).map(|channel| &mut channel.variables)
    }

    /// Values of V.A of the axis at a place; `None` for a place without an axis.
    pub(super) fn axis_variables(&self, channel: usize, place: usize) -> Option<&Contents> {
        self.axes.get(self.axis_at(channel, place)?).map(|axis| &axis.variables)
    }

    /// Like `axis_variables`, but mutable.
    pub(super) fn axis_variables_mut(
        &mut self,
        channel: usize,
        place: usize,
    ) -> Option<&mut Contents> {
        let axis = self.axis_at(channel, place)?;
        self.axes.get_mut(axis).map(|axis| &mut axis.variables)
    }

    /// The parameters of a kind that currently exist, in the order of their indices.
    pub(super) fn parameters(
        &self,
        channel: usize,
        kind: DynamicKind,
    ) -> impl Iterator<Item = &ParameterState> {
        let channel = self.channels.get(channel);
        let parameters = channel.into_iter().flat_map(ChannelState::present);
        parameters.filter(move |parameter| parameter.parameter.kind == kind)
    }

    /// Assigns the axis with this logical number to a place of a channel. The axis leaves its
    /// previous place, and the previous axis of this place then has no place. The number 0 removes
    /// the axis from the place.
    ///
    /// Fails without a change if the axis or the place does not exist, or if another place of the
    /// channel has an axis with the same name: the variables of both axes would have equal names.
    pub(super) fn exchange(
        &mut self,
        model: &Model,
        channel: usize,
        place: usize,
        number: u32,
    ) -> Result<(), AdsError> {
        let rejected = AdsError::INVALID_DATA;
        let axis = match number {
            0 => None,
            _ => {
                let found = model.axes.iter().position(|axis| axis.number == number);
                Some(found.ok_or(rejected)?)
            }
        };
        let places = &self.channels.get(channel).ok_or(rejected)?.places;
        if place >= places.len() {
            return Err(rejected);
        }
        let name = |axis: usize| model.axes.get(axis).map(|axis| &axis.name);
        let mut others = places.iter().enumerate().filter(|(other, _)| *other != place);
        let same_name = |other: usize| Some(other) != axis && axis.and_then(name) == name(other);
        if axis.is_some() && others.any(|(_, other)| other.is_some_and(same_name)) {
            return Err(rejected);
        }
        for left in self.channels.iter_mut().flat_map(|channel| &mut channel.places) {
            *left = left.filter(|left| Some(*left) != axis);
        }
        if let Some(at) = self.channels.get_mut(channel).and_then(|one| one.places.get_mut(place)) {
            *at = axis;
        }
        Ok(())
    }
}

impl ChannelState {
    fn present(&self) -> impl Iterator<Item = &ParameterState> {
        let parameters = self.parameters.at_their_time();
        parameters.filter(move |one| !is_deleted(&one.parameter, &self.objects))
    }

    fn reset_parameters(&mut self) {
        self.parameters.reset(|parameter| is_deleted(parameter, &self.objects));
    }
}

/// Whether the content of the object that the parameter needs is 0; false if the parameter needs no
/// object.
fn is_deleted(parameter: &Parameter, objects: &[Vec<u8>]) -> bool {
    parameter.needs.is_some_and(|object| {
        let content = objects.get(object);
        content.is_none_or(|content| content.iter().all(|&byte| byte == 0))
    })
}
