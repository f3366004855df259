//! The dynamic parameters of a channel as they are now.

use std::time::Duration;

use ads_cnc::dynamic::{DynamicKind, DynamicValue};
use ads_cnc::{CncStr, CncString};

use super::model::Parameter;

#[derive(Clone, Debug)]
pub(super) struct ParameterState {
    pub(super) is: Parameter,
    pub(super) value: DynamicValue,
    /// The life that it has at this time; none if it is not there.
    life: Option<u128>,
}

/// All of a channel, those too that are not there now.
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
    /// As at the start.
    pub(super) fn new(parameters: &[Parameter]) -> Self {
        Self(parameters.iter().cloned().map(ParameterState::new).collect())
    }

    /// Lets come and go what did by now. What comes again is made anew: it has the value of the
    /// start, whatever was written to it before (assumed).
    pub(super) fn advance(&mut self, now: Duration) {
        // Most are always there, and this is done for every request.
        for one in self.0.iter_mut().filter(|one| !one.is.times.is_always()) {
            let life = one.is.times.life(now);
            if life.is_some() && life != one.life {
                one.value = one.is.value;
            }
            one.life = life;
        }
    }

    /// Others of this kind instead.
    pub(super) fn replace(&mut self, kind: DynamicKind, new: Vec<Parameter>) {
        self.0.retain(|one| one.is.kind != kind);
        self.0.extend(new.into_iter().map(ParameterState::new));
    }

    /// Those whose time is, in the order of their indices.
    pub(super) fn at_their_time(&self) -> impl Iterator<Item = &ParameterState> {
        self.0.iter().filter(|one| one.life.is_some())
    }

    /// The value of the parameter with this name, there or not.
    pub(super) fn value_mut(&mut self, name: &CncString) -> Option<&mut DynamicValue> {
        self.0.iter_mut().find(|one| one.is.name == *name).map(|one| &mut one.value)
    }
}
