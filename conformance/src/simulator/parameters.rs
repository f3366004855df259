//! The current dynamic parameters of a channel.

use std::time::Duration;

use ads_cnc::dynamic::{DynamicKind, DynamicValue};
use ads_cnc::{CncStr, CncString};

use super::model::Parameter;

#[derive(Clone, Debug)]
pub(super) struct ParameterState {
    pub(super) is: Parameter,
    pub(super) value: DynamicValue,
    /// The number of times that the parameter was created before; `None` while it does not exist.
    life: Option<u128>,
}

/// All parameters of a channel, including those that currently do not exist.
#[derive(Clone, Debug)]
pub(super) struct ParameterStates(Vec<ParameterState>);

impl ParameterState {
    fn new(is: Parameter) -> Self {
        Self { value: is.value, life: is.times.life(Duration::ZERO), is }
    }

    pub(super) fn name(&self) -> CncStr<'_> {
        self.is.name.as_cnc_str()
    }
}

impl ParameterStates {
    /// The parameters in their initial state.
    pub(super) fn new(parameters: &[Parameter]) -> Self {
        Self(parameters.iter().cloned().map(ParameterState::new).collect())
    }

    /// Creates and deletes parameters that are due. A parameter that is created again has its
    /// initial value, even if it was written to before (assumed).
    pub(super) fn advance(&mut self, now: Duration) {
        // This runs for every request, so skip parameters that always exist, as most do.
        for one in self.0.iter_mut().filter(|one| !one.is.times.is_always()) {
            let life = one.is.times.life(now);
            if life.is_some() && life != one.life {
                one.value = one.is.value;
            }
            one.life = life;
        }
    }

    /// Replaces the parameters of a kind.
    pub(super) fn replace(&mut self, kind: DynamicKind, new: Vec<Parameter>) {
        self.0.retain(|one| one.is.kind != kind);
        self.0.extend(new.into_iter().map(ParameterState::new));
    }

    /// The parameters that currently exist, in the order of their indices.
    pub(super) fn at_their_time(&self) -> impl Iterator<Item = &ParameterState> {
        self.0.iter().filter(|one| one.life.is_some())
    }

    /// The value of the parameter with this name, even if it currently does not exist.
    pub(super) fn value_mut(&mut self, name: &CncString) -> Option<&mut DynamicValue> {
        self.0.iter_mut().find(|one| one.is.name == *name).map(|one| &mut one.value)
    }
}
