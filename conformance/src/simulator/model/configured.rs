//! The V.E and V.G variables of a model in their initial state, for comparison with replies.

use ads_cnc::{CncString, ExtendedDescription, VariableAccess, VariableType};

use super::Model;
use super::variable::Variable;

/// A variable of a channel in its initial state.
#[derive(Clone, Debug)]
pub struct ConfiguredVariable {
    pub name: CncString,
    pub var_type: VariableType,
    pub access: VariableAccess,
    /// Size of the whole value in bytes.
    pub size: usize,
    pub dimensions: Vec<u32>,
    /// The extended description; only for V.E.
    pub extended: Option<ExtendedDescription>,
    /// The bytes of the initial value.
    pub value: Vec<u8>,
}

impl Model {
    /// The V.E variables and the V.G variables of the channel with this logical number, each in the
    /// order of their indices.
    pub fn configured(&self, channel: u32) -> (Vec<ConfiguredVariable>, Vec<ConfiguredVariable>) {
        let found =
            self.channels.iter().enumerate().find(|(_, one)| u32::from(one.number) == channel);
        let Some((place, channel)) = found else { return (Vec::new(), Vec::new()) };
        let of = |variables: &[usize]| {
            let variables = variables.iter().filter_map(|&at| channel.variables.list.get(at));
            variables.map(|one| configured(one, place)).collect()
        };
        (of(&channel.external), of(&channel.global))
    }
}

fn configured(variable: &Variable, place: usize) -> ConfiguredVariable {
    ConfiguredVariable {
        name: variable.name.clone(),
        var_type: variable.var_type,
        access: variable.access,
        size: variable.initial.size,
        dimensions: variable.dimensions.clone(),
        extended: variable.extended,
        value: variable.initial.of(place),
    }
}
