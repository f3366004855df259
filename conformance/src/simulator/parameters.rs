//! The state of the dynamic parameters of a channel.

use std::time::Duration;

use ads_cnc::dynamic::{DynamicKind, DynamicValue};
use ads_cnc::{CncStr, CncString};

use super::model::Parameter;

#[derive(Clone, Debug)]
pub(super) struct ParameterState {
    pub(super) parameter: Parameter,
    pub(super) value: DynamicValue,
    /// The number of times that the parameter was created before according to its times; `None` at
    /// times at which it does not exist.
    life: Option<u128>,
}

/// All parameters of a channel, including those that currently do not exist.
#[derive(Clone, Debug)]
pub(super) struct ParameterStates {
    all: Vec<ParameterState>,
    /// Whether no parameter has times at which it is created or deleted, which is the usual case.
    are_always: bool,
}

impl ParameterState {
    fn new(parameter: Parameter) -> Self {
        Self { value: parameter.value, life: parameter.times.life(Duration::ZERO), parameter }
    }

    pub(super) fn name(&self) -> CncStr<'_> {
        self.parameter.name.as_cnc_str()
    }
}

impl ParameterStates {
    /// The parameters in their initial state.
    pub(super) fn new(parameters: &[Parameter]) -> Self {
        Self::of(parameters.iter().cloned().map(ParameterState::new).collect())
    }

    fn of(all: Vec<ParameterState>) -> Self {
        let are_always = all.iter().all(|one| one.parameter.times.is_always());
        Self { all, are_always }
    }

    /// Creates and deletes the parameters whose times have come. A parameter that is created again
    /// has its initial value, even if it was written before (assumed). [`reset`](Self::reset) does
    /// the same for parameters that an object creates.
    pub(super) fn advance(&mut self, now: Duration) {
        // Return early, because this function is called at every access to the CNC.
        if self.are_always {
            return;
        }
        for one in &mut self.all {
            let life = one.parameter.times.life(now);
            if life.is_some() && life != one.life {
                one.value = one.parameter.value;
            }
            one.life = life;
        }
    }

    /// Gives the parameters for which `is_deleted` returns true their initial values, which they
    /// have when they are created again.
    pub(super) fn reset(&mut self, is_deleted: impl Fn(&Parameter) -> bool) {
        for one in &mut self.all {
            if is_deleted(&one.parameter) {
                one.value = one.parameter.value;
            }
        }
    }

    /// Replaces the parameters of a kind.
    pub(super) fn replace(&mut self, kind: DynamicKind, new: Vec<Parameter>) {
        let mut all = std::mem::take(&mut self.all);
        all.retain(|one| one.parameter.kind != kind);
        all.extend(new.into_iter().map(ParameterState::new));
        *self = Self::of(all);
    }

    /// The parameters that currently exist according to their times, in the order of their indices.
    pub(super) fn at_their_time(&self) -> impl Iterator<Item = &ParameterState> {
        self.all.iter().filter(|one| one.life.is_some())
    }

    /// The value of the parameter with this name, even if it currently does not exist.
    pub(super) fn value_mut(&mut self, name: &CncString) -> Option<&mut DynamicValue> {
        self.all.iter_mut().find(|one| one.parameter.name == *name).map(|one| &mut one.value)
    }
}
