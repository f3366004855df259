//! What the model says of variables, for who holds answers against it.

use ads_cnc::{CncString, ExtendedDescription, VariableAccess, VariableType};

use super::Model;
use super::variable::Variable;

/// A variable of a channel, as it is at the start.
#[derive(Clone, Debug)]
pub(crate) struct Configured {
    pub(crate) name: CncString,
    pub(crate) var_type: VariableType,
    pub(crate) access: VariableAccess,
    /// Bytes of all of it.
    pub(crate) size: usize,
    pub(crate) dimensions: Vec<u32>,
    /// What only V.E has.
    pub(crate) extended: Option<ExtendedDescription>,
    pub(crate) value: Vec<u8>,
}

impl Model {
    /// V.E and V.G of the channel with this logical number, in the order of their indices.
    pub(crate) fn configured(&self, channel: u32) -> (Vec<Configured>, Vec<Configured>) {
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

fn configured(variable: &Variable, place: usize) -> Configured {
    Configured {
        name: variable.name.clone(),
        var_type: variable.var_type,
        access: variable.access,
        size: variable.initial.size,
        dimensions: variable.dimensions.clone(),
        extended: variable.extended,
        value: variable.initial.of(place),
    }
}
